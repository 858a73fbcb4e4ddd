module small
import "parts/nothing.rg"
