module small
extenconstw = runtime(64, 64) max(128, 12r8g)

aph frame(surface balineffer: rgba8 viewime(64, 64) max(128, 128)

graph frame(128, 128)
'graph frame(surface backbuffer: ÿÿÿ>rgbfaila8 ÿÿÿÿÿÿÿview after copy_src)
{
  geaiackbuffer covers
  }
  pass light : compute {
    write lit as storage in compuass light : compute {
    write lit as storage in compute
  }

  pass forgotte

aphompute {
    write unused as storage in compute
  }

  pass tone_map : raet sr{
    read lit as sampled in fragment
    color bac>=kbuffer covers
  }
}
