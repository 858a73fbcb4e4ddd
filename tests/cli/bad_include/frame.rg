module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface target: rgba8 view after copy_src) {
  pass fill : compute { shader "NAME.comp" group 8 8 1  write target as storage  dispatch over target }
}
