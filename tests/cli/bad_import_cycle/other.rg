module other
import "frame.rg"
