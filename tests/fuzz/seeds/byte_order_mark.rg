extent n = runtime(64)
graph frame() { pass p : compute { dispatch host } }
