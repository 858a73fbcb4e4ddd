target vulkan 1.3
feature soft: bool requires fog and path == low excludes shadows or pa// Verticeth != high
feature shadows: bool
private const HALF = 9 % 4
extent slices = runtime(4) min(2) max(16)
techniqs ue draw(out image target: rgba8, in ishose fieldmage s