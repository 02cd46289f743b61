#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.4, 0.4, 0.4> }
camera { perspective
  location <3, -6, 4>
  direction <-0.39036002917941326, 0.7807200583588265, -0.4879500364742666>
  right <0.7292102256521592, 0.36460511282607966, 0>
  up <-0.13343180857664216, 0.2668636171532843, 0.5337272343065687> }
background { rgb <1, 1, 1> }
light_source { <-4, -5, 7> rgb <0.9, 0.9, 0.9> }
// bracket
difference {
merge {
box { <0, 0, 0>, <1, 1, 1> matrix <0, 0, 0.5, 0, 1.6, 0, 2.4, 0, 0, -1.2, -0.8, 0> }
cylinder { <-0.4, 0, 0>, <-0.4, 0, 1.3>, 0.6 } }
cylinder { <-0.4, 0, -1>, <-0.4, 0, 3>, 0.35 }
box { <0, 0, 0>, <1, 1, 1> matrix <0, 0, 0.5, 0, 3, 0, 0.5, 0, 0, 0.5, -1.5, 0.25> }
sphere { <-0.4, -0.75, 1.1>, 0.4 }
  material { texture { pigment { rgb <1, 0.43749997, 0.25> } finish { ambient rgb <0.24000001, 0.24000002, 0.24000001> diffuse 0.56 phong 0.4 phong_size 30 } } } }
// cut_ball
intersection {
sphere { <1.3, -1.5, 0.5>, 0.6 }
plane { <-0.2182178902359924, -0.4364357804719848, 0.8728715609439696>, 1.0256240841091642 }
box { <0, 0, 0>, <1, 1, 1> matrix <0, 0, 0.8999999999999999, 0, 0.9000000000000001, 0, 0.8999999999999999, 0, 0, 0.8500000000000001, -1.95, 0.04999999999999999> }
  material { texture { pigment { rgb <0.35714287, 0.5714286, 1> } finish { ambient rgb <0.21000001, 0.21, 0.21000001> diffuse 0.48999998 } } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { pigment { rgb <0.967742, 1, 0.9354839> } finish { ambient rgb <0.18599999, 0.186, 0.18599999> diffuse 0.434 } } } }
