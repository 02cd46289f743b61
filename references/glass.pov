#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.4, 0.4, 0.4> }
camera { perspective
  location <3, -6, 4>
  direction <-0.3989023128068564, 0.7978046256137128, -0.4520892878477706>
  right <0.7292102256521591, 0.36460511282607966, -5.551115123125783e-17>
  up <-0.12362554935239872, 0.24725109870479745, 0.5454068353782298> }
background { rgb <0.2, 0.3, 0.45> }
light_source { <-4, -5.000000000000001, 7> rgb <0.9, 0.9, 0.9> }
// ball
sphere { <0, 0, 1>, 1
  material { texture { pigment { rgb <1, 1, 1> filter 1 } finish { ambient rgb <0, 0, 0> diffuse 0 } } interior { ior 1.5 fade_power 1001 fade_distance 2 fade_color rgb <0, 0.7, 0.39999998> } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { 
    checker
    texture { pigment { rgb <0.40000004, 1, 0.6> } finish { ambient rgb <0.1, 0.1, 0.1> diffuse 0.4 } }
    texture { pigment { rgb <1, 1, 1> } finish { ambient rgb <0.16000001, 0.16000001, 0.16000001> diffuse 0.64000005 } }
    matrix <5, 0, 0, 0, 5, 0, 0, 0, 1, 0, 0, -0.5> } } }
