#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.4, 0.4, 0.4> }
camera { perspective
  location <3, -6, 4>
  direction <-0.3989023128068564, 0.7978046256137128, -0.4520892878477706>
  right <0.7292102256521591, 0.36460511282607966, -5.551115123125783e-17>
  up <-0.12362554935239872, 0.24725109870479745, 0.5454068353782298> }
background { rgb <0.2, 0.3, 0.45> }
light_source { <-4, -5, 7> rgb <0.9, 0.9, 0.9> }
// ball
sphere { <0, 0, 1>, 1
  material { texture { pigment { rgb <1, 1, 1> } finish { ambient rgb <0.040000003, 0.040000003, 0.040000003> diffuse 0.16000001 phong 0.5 phong_size 60 reflection { rgb <0.8, 0.75, 0.7> } } } } }
// small
sphere { <1.3, -1.2, 0.4>, 0.4
  material { texture { pigment { rgb <1, 0.43749997, 0.25> } finish { ambient rgb <0.24000001, 0.24000002, 0.24000001> diffuse 0.56 phong 0.4 phong_size 30 } } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { 
    checker
    texture { pigment { rgb <1, 0.2857143, 0.2857143> } finish { ambient rgb <0.14, 0.14, 0.14> diffuse 0.56 } }
    texture { pigment { rgb <1, 1, 1> } finish { ambient rgb <0.16000001, 0.16000001, 0.16000001> diffuse 0.64000005 } }
    matrix <8, 0, 0, 0, 8, 0, 0, 0, 1, 0, 0, -0.5> } } }
