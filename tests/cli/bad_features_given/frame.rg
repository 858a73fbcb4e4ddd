module small
extent view = runtime(64, 64) max(128, 128)
feature taa: bool
feature quality: { low, high }

graph first(surface backbuffer: rgba8 view after copy_src)
{
  image lit : rgba16f view
  when taa { pass extra : compute { write lit as storage in compute  dispatch host  keep } }
  when quality == high { pass more : compute { write lit as storage in compute  dispatch host  keep } }
  pass clear_it : transfer { clear backbuffer 0 }
}

graph second(surface backbuffer: rgba8 view after copy_src)
{
  pass clear_it : transfer { clear backbuffer 0 }
}
