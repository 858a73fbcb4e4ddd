module tiles
extent view = runtime(64, 64) max(64, 64)
spectrum kinds {
  sun
  soft requires sun
  lamps
  modes 3
  profile "tiles.json"
}
graph frame() {
  buffer masks : u32[ceil(view / 8).area]
  buffer shown : u32[view.area] readback
  pass mark : compute {
    write masks as storage
  }
  pass start : transfer {
    fill shown 0
  }
  pass shade : compute {
    shader   "shade.comp" group 8 8 1
    spectrum kinds by masks
    update   shown as storage disjoint
    dispatch over view
  }
}
