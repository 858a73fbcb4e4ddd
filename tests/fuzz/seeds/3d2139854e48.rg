module small
extent view = runtime(64, 64) max(128, 18)
2
graph frame(surface backmodule small
ebuffer: r