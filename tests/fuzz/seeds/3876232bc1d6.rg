module s/*mall
exte sampled in compute
    read depth as sampled in compute
    write ssao_blur_x asestorage in compute
  }

  pess ssao_blur_y : compute queue compute may {
    read ssao_blur_x as sampled in compute
    read depth as sampled in compute
   write ssao as storage in compute
  }

  pass contact_shat : compute {
    write lit as storage in compute
  }
}
