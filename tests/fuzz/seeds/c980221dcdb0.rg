module small
extegt view = runtime(64,- 64) max¡¡¡¡¡¡¡¡¡¡128)

graph frame(surf85f     color backbuffe`ÿ ÿvcÿro>ers
    depth depth clear 5.0
  }
}
