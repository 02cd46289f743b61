// What `lekalo new` writes: one commented scene for each kind of work. A suite comes with a scene that it tests.
#pragma once

namespace lekalo::command {

struct StartingFile {
  const char* kind;
  const char* text;  // NAME stands for the name of the file without its ending
};

inline constexpr StartingFile kStartingFiles[] = {
    {"picture", R"(# NAME: a picture, ray-traced.
#   lekalo render NAME.yaml            makes NAME.png
#   lekalo render NAME.yaml --set r=1  with another value of a parameter
#   lekalo check NAME.yaml             all mistakes at once
lekalo: 1
info: { title: NAME }

parameters: { R: 2, r: 0.7 }           # named numbers; formulas may use them everywhere

geometry:                              # named curves, surfaces, bodies, in any order; 'lekalo types' lists them
  section: { type: circle, center: [R, 0, 0], radius: r, normal: y }
  ring: { type: revolution_surface, of: section, axis: z }
  floor: { type: plane, origin: [0, 0, -r], size: [30, 30] }

materials:
  copper: { type: conductor, metal: Cu, roughness: 0.2 }
  paper: { type: diffuse, color: '#d9d4c8' }

objects:                               # what is shown; left out: everything that nothing else uses
  - { shape: ring, material: copper }
  - { shape: floor, material: paper }

# Without `lights` the shipped studio gives light.
camera: { type: perspective, from: [4, -7, 4.5], at: [0, 0, 0], field_of_view: 36 }
image: { size: [720, 480], samples: 16 }   # samples: more are smoother and take longer
outputs: [NAME.png]                    # .exr holds all that is known of each pixel
)"},
    {"drawing", R"(# NAME: a drawing of lines, hidden ones dashed, with dimensions and labels.
#   lekalo draw NAME.yaml              makes NAME.svg and NAME.pdf
#   lekalo draw NAME.yaml --latex      texts in NAME.tex, for LaTeX to set
lekalo: 1
info: { title: NAME, unit: mm }

parameters: { width: 40, height: 12, bore: 5 }

geometry:
  block: { type: box, size: [width, 30, height], center: [0, 0, height/2] }
  drill: { type: cylinder_body, center: [8, 0, -1], radius: bore, height: height + 2 }
  part: { type: difference, of: block, minus: drill }
  rim: { type: circle, center: [8, 0, height], radius: bore }

objects:
  # Which lines are drawn, and how: thick, thin, hairline, dashed, ... or { width: 0.5 mm, color: '#0072b2' }.
  - { shape: part, lines: { sharp: thick, silhouette: thick, hidden: dashed } }

camera: { type: parallel, view: isometric }
drawing:
  annotations:
    - { type: linear_dimension, from: [-width/2, -15, 0], to: [width/2, -15, 0], along: x, offset: -8 mm }
    - { type: point, at: [8, 0, height], label: '$C$' }     # $...$: TeX's formulas
image: { size: [100 mm, auto], margin: 4 mm }
outputs: [NAME.svg, NAME.pdf]
)"},
    {"graph", R"(# NAME: graphs of functions with axes and a legend.
#   lekalo draw NAME.yaml              makes NAME.svg and NAME.pdf
lekalo: 1
info: { title: NAME }

parameters: { damping: 0.3 }

geometry:                              # y of x, or { x: ..., y: ... } of t
  wave: { type: formula_curve, y: exp(-damping*x)*cos(3*x), domain: [0, 2*pi] }
  envelope: { type: formula_curve, y: exp(-damping*x), domain: [0, 2*pi] }

objects:
  - { shape: wave, legend: '$e^{-ax}\cos 3x$', lines: { curve: { like: thick, color: '#0072b2' } } }
  - { shape: envelope, legend: '$e^{-ax}$', lines: { curve: { like: thin, color: '#d55e00' } } }

camera: { type: graph }                # or the window: { type: graph, x: [0, 7], y: [-1, 1] }
drawing:
  axes: { x: { label: '$x$' }, y: { grid: true } }
  legend: { side: above }
image: { size: [100 mm, 70 mm], margin: 3 mm }
outputs: [NAME.svg, NAME.pdf]
)"},
    {"plate", R"(# NAME: a plate of several panels on one page.
#   lekalo draw NAME.yaml              makes NAME.svg and NAME.pdf
lekalo: 1
info: { title: NAME, unit: mm }

geometry:
  block: { type: box, size: [40, 30, 12], center: [0, 0, 6] }
  drill: { type: cylinder_body, center: [8, 0, -1], radius: 5, height: 14 }
  part: { type: difference, of: block, minus: drill }
  rim: { type: circle, center: [8, 0, 12], radius: 5 }

objects:                               # in every panel that has no objects of its own
  - { shape: part, lines: { sharp: thick, silhouette: thick, hidden: dashed } }

panels:
  front:
    camera: { view: front }
    drawing: { annotations: { type: linear_dimension, from: [20, -15, 0], to: [20, -15, 12], along: z, offset: -6 mm } }
  top:
    camera: { view: top }
    drawing: { annotations: { type: diameter_dimension, of: rim, leader: 60 } }
  corner: { camera: { view: isometric } }

layout: { rows: [[front, corner], [top, empty]], scale: 1, gap: 8 mm }
image: { size: [150 mm, auto], margin: 4 mm }
outputs: [NAME.svg, NAME.pdf]
)"},
    {"suite", R"(# NAME: regression tests of pictures and numbers.
#   lekalo test NAME.yaml                                      runs them
#   lekalo test NAME.yaml --accept torus --reason 'looked at'  makes what the test shows its golden picture, which the
#                                                              first run lacks
lekalo_suite: 1

golden: NAME_golden                    # NAME_golden/TEST.exr, to be committed, and why each is right
results: NAME_results                  # what a run makes; never committed

defaults:                              # of every test that does not say it itself
  size: [160, 120]
  samples: 4
  compare: { metric: flip, mean: 0.01, maximum: 0.3 }

tests:
  - name: torus                        # of radii 3 and 1: its area is 12 pi^2, its volume 6 pi^2
    scene: NAME_scene.yaml
    expect: [{ measure: torus, area: 12*pi^2, volume: 6*pi^2, tolerance: 1e-9 }]
  # The same shape as triangles looks the same: no golden picture is needed.
  - { name: as_mesh, scene: NAME_scene.yaml, representation: mesh, against: torus, compare: { metric: flip, mean: 0.02 } }
)"},
};

inline constexpr const char* kSceneOfSuite = R"(# The scene that NAME.yaml tests.
lekalo: 1
parameters: { R: 3, r: 1 }
geometry:
  torus: { type: torus_body, major_radius: R, minor_radius: r }
)";

}  // namespace lekalo::command
