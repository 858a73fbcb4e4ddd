module frame
import "loop.rg"
