module importing  //~ error[RG0007]: a second file calls its module `importing`
import "../outside.rg"  //~ error[RG0002]: `../outside.rg` is outside the folder of the root file; imports are relative to that folder
import "modules/missing.rg"  //~ error[RG0001]: cannot read `modules/missing.rg`: no such file
import "modules/cycle_one.rg"  //~ note[RG0004]: `modules/cycle_one.rg` is imported here
import "modules/same_name.rg"
