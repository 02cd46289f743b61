"""Drawings: which lines an SVG holds, how hidden ones look, the same bytes again, formats, errors."""

import math
import os
import re
import unittest
import xml.etree.ElementTree as tree

from program import ProgramTest, SCENE_ERROR, USAGE

BLOCK = """lekalo: 1
geometry: { block: { type: box, size: [1, 2, 3] } }
objects: [{ shape: block, lines: { sharp: thick, hidden: dashed } }]
camera: { view: isometric }
image: { size: [60 mm, 80 mm] }
outputs: block.svg
"""
PATH = "{http://www.w3.org/2000/svg}path"
GROUP = "{http://www.w3.org/2000/svg}g"


class Draw(ProgramTest):
    def paths(self, name):
        """Of every class of groups its paths."""
        found = {}
        for group in tree.fromstring(self.bytes_of(name)).iter(GROUP):
            if group.get("class"):
                found.setdefault(group.get("class"), []).extend(group.findall(PATH))
        return {name: paths for name, paths in found.items() if paths}

    def test_a_block(self):
        """Nine edges seen, three behind, as straight lines on a sheet in millimetres."""
        self.write("block.yaml", BLOCK)
        out, errors = self.run_program("draw", "block.yaml", "--stats")
        self.assertIn("block.svg", errors)
        self.assertIn("12 lines in 12 pieces", errors)
        root = tree.fromstring(self.bytes_of("block.svg"))
        self.assertEqual((root.get("width"), root.get("height"), root.get("viewBox")), ("60mm", "80mm", "0 0 60 80"))
        paths = self.paths("block.svg")
        edges = {name: sum(path.get("d").count(" L") for path in of) for name, of in paths.items()}
        self.assertEqual(edges, {"sharp": 9, "sharp hidden layers-1": 3})
        # At three corners just two of the edges seen meet: they are one path there. The hidden ones meet in one corner.
        self.assertEqual(len(paths["sharp"]), 6)
        self.assertEqual(len(paths["sharp hidden layers-1"]), 3)
        for path in paths["sharp"] + paths["sharp hidden layers-1"]:
            self.assertRegex(path.get("d"), r"^M[-\d. ]+( L[-\d. ]+)+$")
        self.assertTrue(all(path.get("stroke-dasharray") for path in paths["sharp hidden layers-1"]))
        self.assertFalse(any(path.get("stroke-dasharray") for path in paths["sharp"]))

    def test_curves_as_polygons(self):
        """A circle as the polygon of a sag or of an angle, in drawings as long as the sag says and inscribed."""
        for mesh, sides in (("sag: 0.1", 7), ("angle: 30", 12), ("sag: 0.1, angle: 30", 12), ("sag: 0.01, angle: 90", 23)):
            self.write("rim.yaml", "lekalo: 1\ngeometry: { rim: { type: circle, radius: 1 } }\nobjects: { shape: rim, "
                       f"representation: mesh, mesh: {{ {mesh} }}, lines: {{ curve: thick }} }}\n"
                       "image: { size: [60 mm, auto] }\n")
            self.run_program("draw", "rim.yaml", "-o", "rim.svg", "--quiet")
            corners = [tuple(map(float, pair)) for path in self.paths("rim.svg")["curve"]
                       for pair in re.findall(r"([-\d.]+) ([-\d.]+)", path.get("d"))]
            self.assertEqual(len(set(corners)), sides, mesh)
            x, y = (sum(pair[k] for pair in set(corners)) / sides for k in (0, 1))
            radii = [math.dist(pair, (x, y)) for pair in corners]
            self.assert_near(radii, [radii[0]] * len(radii), 0.01)

    def test_same_bytes(self):
        self.write("block.yaml", BLOCK)
        self.run_program("draw", "block.yaml", "-o", "one.svg", "-o", "two.svg", "--quiet")
        self.run_program("draw", "block.yaml", "--quiet")
        self.assertEqual(self.bytes_of("one.svg"), self.bytes_of("two.svg"))
        self.assertEqual(self.bytes_of("one.svg"), self.bytes_of("block.svg"))

    def test_a_ring(self):
        """Two closed outlines seen from above, circles."""
        self.write("ring.yaml", """lekalo: 1
geometry: { ring: { type: torus_surface, major_radius: 3, minor_radius: 1 } }
objects: [{ shape: ring, lines: { silhouette: thick } }]
camera: { view: top }
""")
        self.run_program("draw", "ring.yaml", "--quiet")
        outlines = self.paths("ring.svg")["silhouette"]
        self.assertEqual(len(outlines), 2)
        sizes = []
        for path in outlines:
            self.assertTrue(path.get("d").endswith(" Z"))
            self.assertNotIn(" C", path.get("d"))
            radii = re.findall(r" A([\d.]+) ([\d.]+) ", path.get("d"))
            self.assertEqual(len(radii), 4)
            sizes.append(float(radii[0][0]))
            for x, y in radii:
                self.assertEqual(x, y)
        self.assertAlmostEqual(max(sizes) / min(sizes), 2, places=4)  # (3 + 1) / (3 - 1)

    def test_formats(self):
        """PDF and PNG of the same drawing: page size, text as text, fonts embedded, no clock."""
        labelled = BLOCK.replace("block.svg", "[block.svg, block.pdf, { file: block.png, kind: drawing }]")
        self.write("block.yaml", labelled + "drawing: { annotations: [{ type: label, at: [0, 0, 0], "
                   "text: 'Куб $\\mathbf{p}_{12}$' }] }\n")
        self.run_program("draw", "block.yaml", "--quiet")
        pdf = self.bytes_of("block.pdf")
        self.assertTrue(pdf.startswith(b"%PDF-"))
        self.assertNotIn(b"CreationDate", pdf)
        text = self.bytes_of("block.svg").decode()
        self.assertIn(">Куб </tspan>", text)
        self.assertIn(">12</tspan>", text)
        self.assertEqual(text.count("@font-face"), 2)
        self.assertEqual(self.bytes_of("block.png")[:8], b"\x89PNG\r\n\x1a\n")
        self.run_program("draw", "block.yaml", "-o", "again.pdf", "-o", "again.png", "--quiet")
        self.assertEqual(self.bytes_of("again.pdf"), pdf)
        self.assertEqual(self.bytes_of("again.png"), self.bytes_of("block.png"))
        self.run_program("draw", "block.yaml", "-o", "outlines.svg", "--outlines", "--quiet")
        self.assertNotIn("<text", self.bytes_of("outlines.svg").decode())

    def test_short_arcs_and_large_parameters(self):
        """Domains of a few numbers, between whose ends there is soon no middle, have an end, too."""
        self.write("short.yaml", "lekalo: 1\ngeometry:\n"
                   "  arc: { type: circle, radius: 1, arc: [90, 90.00000000000001] }\n"
                   "  far: { type: formula_curve, point: [t - 1e15, (t - 1e15)^2, 0], domain: [1e15, 1e15 + 1] }\n"
                   "  frame: { type: circle, radius: 2 }\n"
                   "objects: [{ shape: arc }, { shape: far }, { shape: frame }]\noutputs: short.svg\n")
        self.run_program("draw", "short.yaml", "--quiet")
        self.assertTrue(self.paths("short.svg"))

    def test_errors(self):
        self.write("block.yaml", BLOCK)
        self.assertIn("'x.exr': draw writes", self.run_program("draw", "block.yaml", "-o", "x.exr", code=USAGE)[1])
        self.write("wrong.yaml", BLOCK + "drawing: { annotations: [{ type: label, at: [0, 0, 0], text: '$\\aplha$' }] }\n")
        errors = self.run_program("draw", "wrong.yaml", code=SCENE_ERROR)[1]
        self.assertIn("labels do not know '\\aplha' (did you mean 'alpha'?)", errors)

    def scene(self, geometry, objects, camera="{ view: isometric }"):
        self.write("scene.yaml", f"lekalo: 1\ngeometry: {{ {geometry} }}\nobjects: [{objects}]\n"
                   f"camera: {camera}\n")
        return "scene.yaml"

    def test_lines_that_cannot_be(self):
        """Kinds that a shape cannot have, and unbounded surfaces, are errors with a place and a hint; check finds them."""
        cases = (("b: { type: box, size: [1, 1, 1] }", "{ shape: b, lines: { curve: thick } }",
                  "'box' has no lines 'curve'", "it has boundary, sharp,"),
                 ("c: { type: circle, radius: 1 }", "{ shape: c, lines: { sharp: thick } }",
                  "'circle' has no lines 'sharp'", "it has curve"),
                 ("p: { type: plane }", "{ shape: p, lines: { section: { planes: [{ normal: x }] } } }",
                  "the surface is unbounded", "give the surface a domain"),
                 ("s: { type: hyperbolic_paraboloid, semi_axes: [1, 1] }", "{ shape: s, lines: { self_intersection: thin } }",
                  "the surface is unbounded", "give the surface a domain"),
                 ("s: { type: hyperbolic_paraboloid, semi_axes: [1, 1] }, b: { type: ball, radius: 1 }",
                  "{ shape: b, lines: { intersection: { with: s } } }", "what is met is an unbounded surface",
                  "give the surface a domain"),
                 ("i: { type: implicit, formula: x^2 + y^2 + z^2 - 1, ball: { radius: 1.5 } }",
                  "{ shape: i, transform: { scale: 2 }, lines: { parameter: { at_u: 3 } } }",
                  "'implicit' has no lines 'parameter'", "it has boundary, sharp,"),
                 ("t: { type: tube, of: { type: circle, radius: 2 }, radius: 0.3 }", "{ shape: t, lines: { parameter: {} } }",
                  "parameter lines need 'at_u' or 'at_v'", "how many, or where: parameter:"),
                 ("t: { type: tube, of: { type: circle, radius: 2 }, radius: 0.3 }",
                  "{ shape: t, lines: { parameter: { at_u: -2 } } }", "expected a count between 1 and 10000, found -2",
                  "a list says where: [-2]"))
        for geometry, objects, message, hint in cases:
            scene = self.scene(geometry, objects)
            for command in (("draw", scene, "-o", "x.svg"), ("check", scene)):
                errors = self.run_program(*command, code=SCENE_ERROR)[1]
                self.assertRegex(errors, r"scene\.yaml:3:\d+: ")
                self.assertIn(message, errors)
                self.assertIn("hint: " + hint, errors)
        # Of a list it is enough that one has them.
        self.run_program("draw", self.scene("b: { type: box, size: [1, 1, 1] }, c: { type: circle, radius: 1 }",
                                            "{ shape: [b, c], lines: { curve: thick, sharp: thick } }"), "-o", "x.svg")

    def test_what_is_left_out_has_a_name(self):
        tube = "t: { type: tube, of: { type: segment, from: [-2, 0, 0], to: [2, 0, 0] }, radius: 0.3 }, " \
               "s: { type: hyperbolic_paraboloid, semi_axes: [1, 1] }, " \
               "h: { type: intersection, of: [t, { type: half_space, normal: x }] }"
        scene = self.scene(tube, "{ shape: t, lines: { self_intersection: thin } }, "
                           "{ shape: h, lines: { parameter: { at_u: 3 } } }, { shape: s, lines: { boundary: thick } }")
        errors = self.run_program("draw", scene, "-o", "x.svg")[1]
        for words in ("parameter lines of half-spaces", "self-intersections of 't'", "lines of 's', which is unbounded"):
            self.assertIn(words, errors)
        # The formula jumps; kinks are known.
        scene = self.scene("i: { type: implicit, formula: 'abs(x) + abs(y) + abs(z) - 1', ball: { radius: 1.5 } }",
                           "{ shape: i, lines: { silhouette: thick, sharp: thick } }")
        self.assertNotIn("warning", self.run_program("draw", scene, "-o", "x.svg")[1])
        scene = self.scene("i: { type: implicit, formula: 'z - 0.3*floor(2*x)', ball: { radius: 1.5 } }",
                           "{ shape: i, lines: { silhouette: thick } }")
        self.assertIn("not all lines are known: they nearly touch or coincide ('i')",
                      self.run_program("draw", scene, "-o", "x.svg")[1])

    def test_parameter_lines_of_solids(self):
        """Of a tube as of a solid of two: five circles, the nearest end's seen whole, and one of three lines in front."""
        tube = "t: { type: tube, of: { type: segment, from: [-2, 0, 0], to: [2, 0, 0] }, radius: 0.3, caps: flat }, " \
               "b: { type: ball, radius: 0.2 }, s: { type: union, of: [t, b] }"
        for shape in "ts":
            scene = self.scene(tube, "{ shape: %s, lines: { parameter: { at_u: 5, at_v: 3 }, hidden: show } }" % shape)
            self.assertNotIn("note", self.run_program("draw", scene, "-o", "x.svg")[1])
            paths = self.paths("x.svg")
            self.assertEqual(len(paths["parameter"]), 5 + 1)
            self.assertEqual(len(paths["parameter hidden layers-1"]), 4 + 2)

    def test_a_helix_about_a_torus(self):
        """Twelve turns go behind the torus and come back: in each the line is seen once and hidden once."""
        scene = self.scene("ring: { type: torus_surface, major_radius: 3, minor_radius: 1 }, wound: { type: surface_curve, "
                           "of: ring, image: { type: segment, from: [0, 0], to: [2*pi, 24*pi] } }",
                           "{ shape: ring, lines: { silhouette: thin } }, "
                           "{ shape: wound, lines: { curve: thin, hidden: faded } }",
                           "{ type: parallel, from: [10, -6, 9], at: [0, 0, 0], height: 8.4 }")
        self.run_program("draw", scene, "-o", "x.svg")
        paths = self.paths("x.svg")
        # The line ends where it begins: as many pieces as changes.
        self.assertEqual({name: len(of) for name, of in paths.items() if name.startswith("curve")},
                         {"curve": 12, "curve hidden layers-1": 12})

    def test_shapes_shown_twice(self):
        """Nothing is missing where a shape meets itself: two objects of one, a bore that is filled and cut again."""
        surface = "s: { type: formula_surface, z: 'x^2 - y^2', domain: { u: [-1, 1], v: [-1, 1] } }"
        bore = ("b: { type: box, size: [2, 2, 1], corner: [-1, -1, 0] }, y: { type: cylinder_body, radius: 0.5, height: 1 }, "
                "d: { type: difference, of: b, minus: y }, f: { type: union, of: [d, y] }, "
                "g: { type: difference, of: f, minus: y }")
        for geometry, objects in ((surface, "{ shape: s }, { shape: s, name: again, lines: { boundary: thick } }"),
                                  (surface + ", t: { type: group, of: { shape: s } }",
                                   "{ shape: s, transform: { translate: x } }, { shape: t, transform: { translate: x } }"),
                                  (bore, "{ shape: g }"), (bore, "{ shape: d }, { shape: y }")):
            self.scene(geometry, objects)
            self.write("filled.yaml", (self.folder / "scene.yaml").read_text() + "drawing: { ground: fill }\n")
            self.assertNotIn("warning", self.run_program("draw", "filled.yaml", "-o", "x.svg")[1])

    def test_annotations_follow_the_object(self):
        def texts(object):
            self.write("scene.yaml", f"""lekalo: 1
geometry:
  b: {{ type: box, size: [4, 3, 2] }}
  h: {{ type: cylinder_body, center: [2, 1.5, -1], radius: 0.5, height: 4 }}
  d: {{ type: difference, of: b, minus: h }}
objects: [{{ shape: d{object} }}]
camera: {{ type: parallel, view: top, frame: d }}
drawing: {{ annotations: [{{ type: diameter_dimension, of: d.h.side }}, {{ type: label, at: {{ of: d.b.z_max, u: 1, v: 1 }}, text: top }}] }}
image: {{ size: [80 mm, auto] }}
""")
            self.run_program("draw", "scene.yaml", "-o", "d.svg")
            svg = (self.folder / "d.svg").read_text()
            numbers = re.findall(r"-?\d+\.?\d*", svg[svg.index('class="lines"'):])
            return [float(n) for n in numbers]
        # A cap shows the solid's boundary in its place.
        for clip in ("", ", clip: { through: [0, 0, 1.9], normal: z, cap: true }"):
            there, moved = texts(clip), texts(clip + ", transform: { translate: [10, 0, 0] }")
            self.assertGreater(len(there), 30)
            self.assertEqual(len(there), len(moved))
            for a, b in zip(there, moved):
                self.assert_near(a, b, 2e-3)

    def test_annotations_follow_what_is_made_of_theirs(self):
        """Of operands, by their names and those of places on them; a frame; what is shown itself stays."""
        def texts(transform, body_transform=""):
            self.write("scene.yaml", f"""lekalo: 1
geometry:
  b: {{ type: box, size: [4, 3, 2] }}
  h: {{ type: cylinder_body, center: [2, 1.5, -1], radius: 0.5, height: 4 }}
  P: {{ of: b.z_max, u: 1, v: 1 }}
  d: {{ type: difference, of: b, minus: h{body_transform} }}
  e: {{ type: union, of: d }}
objects: [{{ shape: e{transform} }}]
camera: {{ type: parallel, view: top, frame: e }}
drawing:
  annotations:
    - {{ type: label, at: {{ of: b.z_max, u: 1, v: 1 }}, text: A, side: left }}
    - {{ type: label, at: P, text: B, side: right }}
    - {{ type: diameter_dimension, of: h.side }}
    - {{ type: frame, frame: {{ origin: P, x: {{ of: b.z_max, u: 1, v: 1, vector: du }}, z: {{ of: b.z_max, u: 1, v: 1, vector: normal }} }}, length: 1 }}
image: {{ size: [80 mm, auto] }}
""")
            self.assertNotIn("not in the drawing", self.run_program("draw", "scene.yaml", "-o", "d.svg")[1])
            svg = (self.folder / "d.svg").read_text()
            numbers = re.findall(r"-?\d+\.?\d*", svg[svg.index('class="lines"'):])
            return [float(n) for n in numbers]
        there = texts("")
        self.assertGreater(len(there), 60)
        for moved in (texts(", transform: { translate: [10, 5, 1] }"), texts("", ", transform: { translate: [-20, 0, 3] }"),
                      texts(", transform: { translate: [1, 5, 1] }", ", transform: { translate: [-20, 0, 3] }")):
            self.assertEqual(len(there), len(moved))
            for a, b in zip(there, moved):
                self.assert_near(a, b, 2e-3)

    def test_closed_plane_curves_are_filled(self):
        """A disc about a ball, seen from above and from the side of its plane; a region of a graph."""
        disc = """lekalo: 1
geometry: { c: { type: circle, radius: 1.5 }, b: { type: ball, radius: 1 } }
objects: [{ shape: c, fill: { color: '#ff0000' } }, { shape: b, fill: { color: '#0000ff' } }]
drawing: { ground: fill }
camera: { view: top }
image: { size: [40 mm, 40 mm], margin: 0 mm }
"""
        def filled(scene, color):
            self.write("scene.yaml", scene)
            self.assertNotIn("warning", self.run_program("draw", "scene.yaml", "-o", "x.svg", "-o", "x.pdf", "-o", "x.tikz")[1])
            return [path.get("d") for path in tree.fromstring(self.bytes_of("x.svg")).iter(PATH) if path.get("fill") == color]
        ring, = filled(disc, "#ff0000")
        ball, = filled(disc, "#0000ff")
        radii = sorted({round(float(r), 3) for r in re.findall(r"A([\d.]+)", ring)})
        self.assertEqual((ring.count("M"), ball.count("M")), (2, 1))
        self.assert_near(radii[1] / radii[0], 1.5, 1e-3)
        # The near half of the disc hides a part of the ball, which is seen above and below.
        oblique = disc.replace("view: top", "view: { azimuth: 0, elevation: 30 }")
        ring, = filled(oblique, "#ff0000")
        ball, = filled(oblique, "#0000ff")
        self.assertEqual((ring.count("M"), ball.count("M")), (1, 2))
        graph = """lekalo: 1
geometry:
  area: { type: polyline, closed: true, points: [[1, 0], [3, 0], [3, 2], [1, 1]] }
objects: [{ shape: area, fill: { color: '#ff0000' } }]
camera: { type: graph, x: [0, 4], y: [0, 2] }
drawing: { ground: fill, axes: { x: {}, y: {} } }
image: { size: [80 mm, 60 mm] }
"""
        area, = filled(graph, "#ff0000")
        self.assertEqual(len(set(re.findall(r"[\d.]+ [\d.]+", area))), 4)

    def test_fills_that_are_not_in_the_drawing(self):
        scene = """lekalo: 1
geometry: { c: { type: CURVE } }
objects: [{ shape: c, fill: { color: red } }]
drawing: { ground: GROUND }
"""
        for curve, ground, words in (("circle, radius: 1, arc: [0, 90]", "fill", "the fill of 'c': the profile is open"),
                                     ("circle, radius: 1", "none", "ground: fill"),
                                     ("polyline, closed: true, points: [[0, 0], [2, 2], [2, 0], [0, 1]]", "fill", "meets itself")):
            self.write("scene.yaml", scene.replace("CURVE", curve).replace("GROUND", ground))
            self.assertIn(words, self.run_program("draw", "scene.yaml", "-o", "x.svg")[1])

    def test_words_of_others_lead_to_ours(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  a: { type: line, from: [0, 0, 0], to: [1, 0, 0] }\n  b: { type: cube, size: [1, 1, 1] }\n"
                                 "objects: [b]\ncamera: { type: perspective, position: [4, 4, 4], look_at: [0, 0, 0], fov: 40 }\n")
        told = self.run_program("check", "scene.yaml", code=3)[1]
        for word in ("'segment'", "'box'", "'from'", "'at'", "'field_of_view'"):
            self.assertIn(word, told)

    def test_hints_name_words_fields_and_points(self):
        """A word that is no style, a list where fields are wanted, a curve where a point is, a family of points."""
        def said(line):
            self.write("scene.yaml", "lekalo: 1\ngeometry:\n  c: { type: circle, radius: 1 }\n  b: { type: box, size: [1, 1, 1] }\n" + line)
            return self.run_program("check", "scene.yaml", code=3)[1]
        told = said("objects: [{ shape: b, lines: { sharp: thick, hidden: dash } }]\n")
        self.assertIn("unknown word 'dash'", told)
        self.assertIn("hint: one of show, drop, dashed, thin, faded, or the name of a style", told)
        self.assertIn("(did you mean 'mine'?)", said("styles: { mine: {} }\nobjects: [{ shape: b, lines: { sharp: thick, hidden: mien } }]\n"))
        self.assertIn("hint: its fields are boundary, sharp, smooth", said("objects: [{ shape: b, lines: [sharp] }]\n"))
        self.assertIn("hint: a point on it: { of: c, t: 0.5 }",
                      said("drawing: { annotations: [{ type: label, at: c, text: a }] }\n"))
        self.assertIn("hint: on the page: { page: [5 mm, 8 mm] }",
                      said("drawing: { annotations: [{ type: label, at: [5 mm, 8 mm], text: a }] }\n"))
        self.assertIn("hint: write { dash: [1.5 mm, 0.75 mm] }", said("objects: [{ shape: c, lines: { curve: dashed } }]\n"))
        self.assertIn("{ repeat: { k: 0..5 }, of: a_curve, t: k }", said("  p: { repeat: { k: 0..2 }, type: point, at: [k, 0] }\n"))
        # All faces of a body with few.
        self.assertIn("b.z_max", said("  f: { type: fillet_body, of: b, fillets: { edges: { of_face: top }, radius: 0.1 } }\n"))

    def test_sides_are_filled_with_their_own_materials(self):
        """A bowl shows its outside in front and its inside behind."""
        self.scene("s: { type: formula_surface, z: '0.9*x^2 + 0.9*y^2', domain: { u: [-1, 1], v: [-1, 1] } }",
                   "{ shape: s, material: { type: diffuse, color: red }, back_material: { type: diffuse, color: blue } }")
        self.write("filled.yaml", (self.folder / "scene.yaml").read_text() + "drawing: { ground: fill }\n")
        self.run_program("draw", "filled.yaml", "-o", "x.svg")
        text = (self.folder / "x.svg").read_text()
        for color in ("#ff0000", "#0000ff"):
            self.assertEqual(text.count(f'fill="{color}"'), 1, color)

    def test_stages_add_up(self):
        """To what all of it takes; edges of a solid are found once for all panels."""
        part = ("a: { type: box, size: [6, 2.4, 2], corner: [-3, -1.2, 0] }, b: { type: box, size: [4.4, 4, 2], corner: "
                "[-2.2, -2, 0] }, h: { type: cylinder_body, center: [0, 0, -1], radius: 0.8, height: 4 }, "
                "u: { type: union, of: [a, b] }, p: { type: difference, of: u, minus: h }")
        self.scene(part, "{ shape: p }")
        self.write("panels.yaml", (self.folder / "scene.yaml").read_text() + "panels: { p: { camera: { view: front } }, "
                   "q: { camera: { view: top } }, r: { camera: { view: left } } }\n")
        lines = {}
        # Views without solids are found side by side.
        self.write("side_by_side.yaml", "lekalo: 1\ngeometry: { t: { type: torus_surface, major_radius: 2, minor_radius: 1 } }\n"
                   "panels: { p: { camera: { view: isometric } }, q: { camera: { view: { azimuth: 20, elevation: 30 } } } }\n")
        for name in ("scene", "panels", "side_by_side"):
            errors = self.run_program("draw", f"{name}.yaml", "-o", "x.svg", "--stats")[1]
            seconds = {what: float(time) for what, time in re.findall(r"([a-z ]+) ([\d.]+) s", errors)}
            whole = seconds.pop(" in all")
            self.assert_near(sum(seconds.values()), whole, 0.004)
            lines[name] = seconds[" lines"]
        self.assertLess(lines["panels"], 3 * lines["scene"] + 0.05)

    def test_creases(self):
        """The corner of a turned polyline is a ring, seen from outside and through the mouth; silhouettes end there."""
        scene = self.scene("v: { type: revolution_surface, axis: z, of: { type: polyline, "
                           "points: [[1, 0, 0], [2, 0, 2], [1, 0, 4]] } }",
                           "{ shape: v, lines: { sharp: thick, silhouette: thick, boundary: thick } }")
        errors = self.run_program("draw", scene, "-o", "x.svg")[1]
        self.assertNotIn("warning", errors)
        paths = self.paths("x.svg")
        self.assertEqual(len(paths["sharp"]), 2)
        self.assertEqual(len(paths["silhouette"]), 4)

    def test_names_that_latex_does_not_take(self):
        self.write("a.yaml", "lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\n")
        for name in "a%.pdf", "{a.pdf", "a\n\\include x.pdf", "a$x$.pdf":
            errors = self.run_program("draw", "a.yaml", "--latex", "-o", name, code=USAGE)[1]
            self.assertIn("LaTeX takes no file with # % $ \\ { } \" in its name", errors)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.yaml"])

    def test_characters_that_latex_does_not_have(self):
        self.write("a.yaml", "lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\n"
                   "drawing: { annotations: [{ type: label, at: [0, 0], text: 'aǎ' }] }\n")
        errors = self.run_program("draw", "a.yaml", "--latex", code=SCENE_ERROR)[1]
        self.assertIn("the text 'aǎ': LaTeX's fonts do not have the character 'ǎ' (U+01CE)", errors)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["a.yaml"])

    def test_the_same_bytes_in_any_time_zone(self):
        self.write("a.yaml", "lekalo: 1\ninfo: { title: A }\ngeometry: { c: { type: circle, radius: 1 } }\n")
        bytes_of_zones = set()
        for zone in "UTC", "Asia/Kolkata", "America/Los_Angeles", "<+0545>-5:45":
            os.environ["TZ"] = zone
            self.addCleanup(os.environ.pop, "TZ", None)
            self.run_program("draw", "a.yaml", "-o", "a.pdf", "-o", "a.svg", "-o", "a.png", "--quiet")
            bytes_of_zones.add((self.bytes_of("a.pdf"), self.bytes_of("a.svg"), self.bytes_of("a.png")))
        self.assertEqual(len(bytes_of_zones), 1)

    def test_characters_that_xml_forbids(self):
        """U+FFFE and U+FFFF (XML 1.0, 2.2), as they are and as escapes; whatever else a title holds is read back."""
        for title in '"a\\uFFFE"', '"a\\uffff"', "'a\uFFFE'", "'a\uFFFF'":
            self.write("a.yaml", f"lekalo: 1\ninfo: {{ title: {title} }}\n")
            self.assertRegex(self.run_program("check", "a.yaml", code=SCENE_ERROR)[1], "a.yaml:2:[0-9]+: the character U\\+FFF[EF] is not allowed")
        title = 'é<&>"\uFFFD\uE000\U00010000\U0001FFFE|'
        self.write("a.yaml", f"lekalo: 1\ninfo: {{ title: '{title}' }}\ngeometry: {{ c: {{ type: circle, radius: 1 }} }}\n")
        self.run_program("draw", "a.yaml", "--quiet")
        self.assertEqual(tree.parse(self.folder / "a.svg").getroot()[0].text, title)


if __name__ == "__main__":
    unittest.main()
