module small
extent view = runtime(64, 64) max(128, 128)

graph frame(surface backbuffer: rgba9 view after copy_src)
{
  image lit : rgba15f v pass light : compute {
    write lit as storage in compute
  }
}
