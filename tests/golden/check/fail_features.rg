// Rules that contradict themselves, and code that they make unreachable.
extent view = runtime(64, 64) max(64, 64)
feature shadows: bool
feature dark: bool excludes shadows
feature soft: bool requires shadows and dark  //~ error[RG0247]: feature `soft` can never be `on`: its rules contradict themselves
//~^ note[RG0202]: `soft` is declared here
feature path: { low, mid requires quality, high excludes quality == tiny }  //~ error[RG0231]: feature `quality` has several values: compare it with one of them
feature quality: { tiny, large }  //~ note[RG0202]: `quality` is declared here
feature rain: bool requires sonar  //~ error[RG0247]: feature `rain` can never be `on`: its rules contradict themselves
//~^ note[RG0202]: `rain` is declared here
feature sonar: bool excludes rain  //~ note[RG0452]: `rain` is used here
feature fine: bool requires dark and quality != large

graph frame(surface backbuffer: rgba8 view after copy_src)
{
  image hdr : rgba16f view
  when fine {
    when shadows {  //~ warning[RG0248]: this `when` is never planned: no choice of features that keeps their rules selects it
      pass never : compute { write hdr as storage }
    }
  }
  when quality == huge {  //~ error[RG0203]: there is no value of feature `quality` called `huge`
    pass huge : compute { write hdr as storage }
  }
  pass show : raster { color backbuffer clear 0 }
}
