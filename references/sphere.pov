#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.4, 0.4, 0.4> }
camera { perspective
  location <3, -6, 4>
  direction <-0.3989023128068564, 0.7978046256137128, -0.4520892878477706>
  right <0.7292102256521591, 0.36460511282607966, -5.551115123125783e-17>
  up <-0.12362554935239872, 0.24725109870479745, 0.5454068353782298> }
background { rgb <1, 1, 1> }
light_source { <-4, -5.000000000000001, 7> rgb <0.9, 0.9, 0.9> }
// thing
sphere { <0, 0, 1>, 1
  material { texture { pigment { rgb <1, 0.43749997, 0.25> } finish { ambient rgb <0.24000001, 0.24000002, 0.24000001> diffuse 0.56 phong 0.4 phong_size 30 } } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { pigment { rgb <0.967742, 1, 0.9354839> } finish { ambient rgb <0.18599999, 0.186, 0.18599999> diffuse 0.434 } } } }
