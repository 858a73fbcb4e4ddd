module cycle_one
import "modules/cycle_two.rg"
