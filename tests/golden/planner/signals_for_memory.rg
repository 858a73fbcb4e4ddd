// What a signal names for memory is what clocks rest on, and what it comes after through barriers behind a release need not be named.
module q
graph frame(surface backbuffer: rgba8 1920x1080)
{
  image r0_0  : rgba16f 1920x1080
  image r1_0  : r32f 960x540
  image r1_1  : r32f 960x540
  image r2_0  : r32f 480x270
  image r3_0  : r32f 480x270
  image r3_1  : rgba16f 480x270
  image r4_0  : r32f 480x270
  image r5_0  : rgba8 1920x1080
  image r6_0  : rgba16f 960x540
  image r7_0  : r32f 960x540
  image r7_1  : rgba8 960x540
  image r9_0  : rgba8 480x270
  image r10_0 : rgba8 960x540
  image r11_0 : rgba16f 960x540
  image r11_1 : r32f 960x540
  image r12_0 : r32f 960x540
  image r13_0 : rgba8 480x270
  image r14_0 : rgba16f 1920x1080
  image r14_1 : rgba16f 1920x1080
  image r15_0 : r32f 1920x1080
  image r16_0 : rgba8 960x540
  image r16_1 : rgba16f 960x540
  image r17_0 : rgba8 960x540
  image r18_0 : rgba16f 960x540
  image r19_0 : r32f 960x540
  image r19_1 : rgba8 960x540
  image r20_0 : r32f 480x270
  image r21_0 : rgba16f 1920x1080
  image r22_0 : r32f 960x540
  image r22_1 : r32f 960x540
  image r23_0 : r32f 1920x1080
  image r23_1 : rgba16f 1920x1080
  image r24_0 : d32f 960x540
  image r24_1 : r32f 960x540
  image r25_0 : d32f 960x540
  image r25_1 : rgba16f 960x540
  image r26_0 : r32f 960x540
  image r27_0 : rgba8 480x270
  image r27_1 : rgba8 480x270
  image r28_0 : d32f 1920x1080
  image r29_0 : rgba8 960x540
  image r30_0 : r32f 480x270
  image r30_1 : rgba16f 480x270
  image r31_0 : r32f 480x270
  image r32_1 : rgba8 1920x1080
  image r33_0 : d32f 480x270
  image r34_0 : r32f 480x270
  image r35_0 : r32f 960x540
  image r35_1 : r32f 960x540
  image r36_0 : rgba16f 960x540
  image r36_1 : rgba8 960x540
  image r37_1 : r32f 1920x1080
  image r38_0 : r32f 1920x1080
  image r38_1 : r32f 1920x1080
  image r39_0 : rgba16f 1920x1080
  image r40_0 : d32f 960x540
  image r40_1 : rgba8 960x540
  image r41_0 : rgba16f 960x540
  image r42_0 : rgba8 1920x1080
  image r43_0 : d32f 1920x1080
  image r43_1 : r32f 1920x1080
  image r44_0 : rgba8 1920x1080
  image r44_1 : r32f 1920x1080
  image r45_0 : rgba16f 480x270
  image r45_1 : r32f 480x270
  image r46_0 : rgba8 960x540
  image r46_1 : rgba8 960x540
  image r48_0 : r32f 960x540
  image r49_0 : rgba8 960x540
  image r50_0 : rgba8 1920x1080
  image r50_1 : d32f 1920x1080
  image r51_0 : d32f 960x540
  image r51_1 : r32f 960x540
  image r52_0 : rgba16f 1920x1080
  image r53_0 : rgba8 960x540
  image r53_1 : rgba8 960x540
  image r54_0 : rgba8 960x540
  image r55_0 : rgba8 960x540
  image r55_1 : rgba16f 960x540
  image r56_0 : rgba8 480x270
  image r57_0 : d32f 960x540
  image r58_0 : rgba16f 480x270
  image r59_0 : r32f 960x540
  image r59_1 : r32f 960x540
  image r60_0 : rgba16f 480x270
  image r61_0 : rgba8 960x540
  image r62_1 : rgba8 1920x1080
  image r63_0 : rgba8 960x540
  image r64_0 : rgba8 480x270
  image r65_0 : d32f 960x540
  image r65_1 : r32f 960x540
  image r66_0 : d32f 960x540
  image r67_0 : rgba16f 480x270
  image r68_0 : rgba8 1920x1080
  image r68_1 : r32f 1920x1080
  image r69_0 : rgba8 1920x1080
  image r69_1 : r32f 1920x1080
  image r70_0 : rgba8 960x540
  image r70_1 : d32f 960x540
  image r71_0 : d32f 480x270
  image r72_0 : d32f 1920x1080
  image r75_0 : r32f 1920x1080
  image r76_0 : rgba8 480x270
  image r76_1 : rgba8 480x270
  image r77_0 : r32f 480x270
  image r78_0 : rgba8 960x540
  image r78_1 : r32f 960x540
  image r79_0 : rgba16f 960x540
  image r79_1 : r32f 960x540
  image r85_0 : r32f 1920x1080
  pass p0 : raster {
    color  r0_0 covers
  }
  pass p1 : compute {
    write  r1_1 as storage in compute
  }
  pass p2 : raster {
    read   r0_0 as sampled in fragment
    color  r2_0 covers
  }
  pass p3 : raster {
    color  r3_0 covers
  }
  pass p4 : compute {
    write  r4_0 as storage in compute
  }
  pass p5 : raster {
  }
  pass p6 : raster {
    color  r6_0 covers
  }
  pass p7 : raster {
    read   r0_0 as sampled in fragment
    color  r7_0 covers
  }
  pass p9 : raster {
    color  r9_0 covers
  }
  pass p10 : raster {
  }
  pass p11 : compute {
    write  r11_1 as storage in compute
  }
  pass p12 : raster {
    color  r12_0 covers
  }
  pass p13 : raster {
    color  r13_0 covers
  }
  pass p14 : raster {
    read   r7_0 as sampled in fragment
    color  r14_0 covers
  }
  pass p15 : raster {
  }
  pass p16 : raster {
    read   r13_0 as sampled in fragment
    color  r16_0 covers
    color  r16_1 covers
  }
  pass p17 : raster {
    color  r17_0 covers
  }
  pass p18 : compute {
    write  r18_0 as storage in compute
  }
  pass p19 : compute queue compute may {
    write  r19_1 as storage in compute
  }
  pass p20 : compute {
    write  r20_0 as storage in compute
  }
  pass p21 : compute {
  }
  pass p22 : raster {
    read   r14_0 as sampled in fragment
    color  r22_0 covers
    color  r22_1 covers
  }
  pass p23 : raster {
    read   r18_0 as sampled in fragment
    color  r23_1 covers
  }
  pass p24 : raster {
    depth  r24_0 clear 0.0
    color  r24_1 covers
  }
  pass p25 : raster {
    depth  r25_0 clear 0.0
    color  r25_1 covers
  }
  pass p26 : raster {
    color  r26_0 covers
  }
  pass p27 : raster {
  }
  pass p28 : raster {
    depth  r28_0 clear 0.0
  }
  pass p29 : raster {
  }
  pass p30 : compute {
    write  r30_0 as storage in compute
  }
  pass p31 : raster {
    color  r31_0 covers
  }
  pass p32 : raster {
    color  r32_1 covers
  }
  pass p33 : raster {
    read   r17_0 as sampled in fragment
    color  r34_0 covers
  }
  pass p35 : compute {
    write  r35_0 as storage in compute
    write  r35_1 as storage in compute
  }
  pass p36 : compute {
    read   r30_0 as sampled in compute
    write  r36_0 as storage in compute
  }
  pass p37 : compute {
  }
  pass p38 : raster {
    color  r38_0 covers
    color  r38_1 covers
  }
  pass p39 : compute queue compute may {
    write  r39_0 as storage in compute
  }
  pass p40 : raster {
    depth  r40_0 clear 0.0
  }
  pass p41 : raster {
    color  r41_0 covers
  }
  pass p42 : raster {
    read   r41_0 as sampled in fragment
    color  r42_0 covers
  }
  pass p43 : raster {
    read   r42_0 as sampled in fragment
    depth  r43_0 clear 0.0
    color  r43_1 covers
    color  r44_0 covers
  }
  pass p45 : raster {
    color  r45_0 covers
    color  r45_1 covers
  }
  pass p46 : raster {
    read   r32_1 as sampled in fragment
    color  r46_0 covers
  }
  pass p47 : compute {
  }
  pass p49 : raster {
  }
  pass p50 : raster {
    color  r50_0 covers
    depth  r50_1 clear 0.0
  }
  pass p51 : raster {
    read   r44_0 as sampled in fragment
    color  r51_1 covers
  }
  pass p52 : raster {
    read   r41_0 as sampled in fragment
    color  r52_0 covers
  }
  pass p53 : compute {
    write  r53_0 as storage in compute
    write  r53_1 as storage in compute
  }
  pass p54 : raster {
    color  r54_0 covers
  }
  pass p55 : raster {
    color  r55_0 covers
  }
  pass p56 : raster {
    color  r56_0 covers
  }
  pass p57 : raster {
    depth  r57_0 clear 0.0
  }
  pass p58 : compute {
    read   r50_0 as sampled in compute
    write  r58_0 as storage in compute
  }
  pass p59 : compute queue compute may {
    read   r53_0 as sampled in compute
    write  r59_0 as storage in compute
    write  r59_1 as storage in compute
  }
  pass p60 : raster {
    read   r58_0 as sampled in fragment
    color  r60_0 covers
  }
  pass p61 : raster {
    color  r61_0 covers
  }
  pass p62 : raster {
    color  r62_1 covers
  }
  pass p63 : compute {
    read   r61_0 as sampled in compute
    write  r63_0 as storage in compute
  }
  pass p64 : raster {
    color  r64_0 covers
  }
  pass p65 : raster {
    read   r52_0 as sampled in fragment
    read   r62_1 as sampled in fragment
    depth  r65_0 clear 0.0
  }
  pass p66 : raster {
    depth  r66_0 clear 0.0
  }
  pass p67 : raster {
    color  r67_0 covers
  }
  pass p68 : raster {
  }
  pass p69 : raster {
    read   r59_1 as sampled in fragment
    color  r69_0 covers
  }
  pass p70 : raster {
    read   r64_0 as sampled in fragment
    color  r70_0 covers
    depth  r70_1 clear 0.0
  }
  pass p71 : raster {
    read   r65_0 as sampled in fragment
    depth  r71_0 clear 0.0
  }
  pass p72 : raster {
  }
  pass p73 : compute {
  }
  pass p74 : raster {
  }
  pass p76 : raster {
    read   r71_0 as sampled in fragment
    read   r63_0 as sampled in fragment
    read   r70_0 as sampled in fragment
    color  r76_1 covers
  }
  pass p78 : compute {
    read   r76_1 as sampled in compute
    write  r78_0 as storage in compute
  }
  pass p79 : compute queue compute may {
    read   r69_0 as sampled in compute
    write  r79_1 as storage in compute
  }
  pass p80 : raster {
    read   r79_1 as sampled in fragment
    read   r78_0 as sampled in fragment
    color  r85_0 covers
  }
  pass present : raster {
    read   r85_0 as sampled in fragment
    color  backbuffer covers
  }
}
