extent n = runtime(64)  /* as C has
them */ max(128)
graph frame() { pass p : compute { dispatch host } } /* open