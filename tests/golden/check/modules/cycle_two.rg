module cycle_two
import "modules/cycle_one.rg"  //~ error[RG0003]: `modules/cycle_one.rg` imports itself, directly or through others
