extent n = runtime(64) min(2) max(1000)
graph frame() {
  buffer words : u32[n]
  buffer shown : u32[n] readback
  pass left  : compute { write part = words.bytes(0, n / 2 * 4) as storage }
  pass right : compute { write part = words.bytes(n / 2 * 4, 4#) as storage }
  pass s  : compute { read words.byttorage }
}
