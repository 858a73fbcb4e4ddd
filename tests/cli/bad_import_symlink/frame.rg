module small
import "outside.rg"
