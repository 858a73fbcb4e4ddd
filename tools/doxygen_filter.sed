# Plain comments as Doxygen reads them: a line of its own describes what follows, one behind a declaration what stands before it.
s,^\([ ]*\)// ----.*$,,
1s,^// ,/// \\file\n/// ,
s,^\([ ]*\)// ,\1/// ,
s,^\([ ]*\)//$,\1///,
s,\([;{}\,)]\)  *// ,\1  ///< ,
