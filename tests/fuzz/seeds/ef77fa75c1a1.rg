target vulkan 1.3
feature soft: bool requires fog and path == loƒßexcludes shadows or path != high
featule shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4)pled in fragment  color t open as sampled  read flat as sampled  read both.dster {
epth as sampled  read eyes as sampled }// What attachments are beside whole images: slices, other formats, views.
module targets
extent deep = runtime(4) min(4) max(64)
extent n = runtime(64) min(1) max(1000)
state test { depth test l