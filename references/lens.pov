#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.4, 0.4, 0.4> }
camera { perspective
  location <2, -6, 3.2>
  direction <-0.2940858488375231, 0.8822575465125693, -0.36760731104690386>
  right <0.7734442432038212, 0.2578147477346071, -5.551115123125783e-17>
  up <-0.07108093962221607, 0.2132428188666483, 0.5686475169777284> }
background { rgb <0.2, 0.3, 0.45> }
light_source { <-4, -5, 7> rgb <0.9, 0.9, 0.9> }
// lens
intersection {
sphere { <-0.9, 0.65, 1>, 1.15 }
sphere { <-0.9, -0.65, 1>, 1.15 }
  material { texture { pigment { rgb <1, 1, 1> filter 1 } finish { ambient rgb <0, 0, 0> diffuse 0 } } interior { ior 1.5 fade_power 1001 fade_distance 3.3333333 fade_color rgb <0, 0.6666667, 0.33333337> } } }
// block
difference {
box { <0, 0, 0>, <1, 1, 1> matrix <0, 0, 1.2, 0, 1, 0, 1, 0, 0, 0.5, -0.6, 0.05> }
sphere { <1, -0.1, 0.65>, 0.35 }
  material { texture { pigment { rgb <1, 1, 1> filter 1 } finish { ambient rgb <0, 0, 0> diffuse 0 } } interior { ior 1.5 fade_power 1001 fade_distance 3.3333333 fade_color rgb <0, 0.6666667, 0.33333337> } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { 
    checker
    texture { pigment { rgb <0.40000004, 1, 0.6> } finish { ambient rgb <0.1, 0.1, 0.1> diffuse 0.4 } }
    texture { pigment { rgb <1, 1, 1> } finish { ambient rgb <0.16000001, 0.16000001, 0.16000001> diffuse 0.64000005 } }
    matrix <20, 0, 0, 0, 20, 0, 0, 0, 1, 0, 0, -0.5> } } }
