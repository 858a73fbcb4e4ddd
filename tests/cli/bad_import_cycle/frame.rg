module small
import "other.rg"
