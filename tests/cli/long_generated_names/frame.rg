module mmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmmm
feature a_rather_long_name_of_a_feature_0: bool
feature a_rather_long_name_of_a_feature_1: bool

extent view = runtime(64, 64) max(128, 128)

graph frame(surface target: rgba8 view after copy_src) {
  pass clear_it : transfer { clear target 0 }
  when a_rather_long_name_of_a_feature_0 { pass f0 : compute { shader "f0.comp" group 8 8 1  update target as storage  dispatch over target } }
  when a_rather_long_name_of_a_feature_1 { pass f1 : compute { shader "f1.comp" group 8 8 1  update target as storage  dispatch over target } }
  else { pass g : transfer { clear target 0 } }
}
