#version 3.7;
global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 9 ambient_light rgb <0.3, 0.3, 0.3> }
camera { orthographic
  location <5, -5, 5>
  direction <-0.5888877111146444, 0.5888877111146444, -0.5535544484477658>
  right <3.771236166328254, 3.771236166328254, 0>
  up <-1.5656884170135772, 1.5656884170135772, 3.3312519510927174> }
background { rgb <1, 1, 1> }
light_source { <-75.80414669868952, -45.48248801921371, 152.00829339737905> rgb <1, 1, 1> parallel point_at <0, 0, 0.4> }
// thing
box { <0, 0, 0>, <1, 1, 1> matrix <0, 0, 0.8, 0, 1, 0, 1.2, 0, 0, -0.6, -0.5, 0>
  material { texture { pigment { rgb <1, 0.43749997, 0.25> } finish { ambient rgb <0.24000001, 0.24000002, 0.24000001> diffuse 0.56 phong 0.4 phong_size 30 } } } }
// ground
plane { <0, 0, 1>, 0
  material { texture { pigment { rgb <0.967742, 1, 0.9354839> } finish { ambient rgb <0.18599999, 0.186, 0.18599999> diffuse 0.434 } } } }
