"""Drawings on their page: what has room there, which way lines are written, what their elements are called."""

import re
import unittest
import xml.etree.ElementTree as tree

from program import ProgramTest, SCENE_ERROR, USAGE

SVG = "{http://www.w3.org/2000/svg}"
CIRCLE = """lekalo: 1
geometry: { c: { type: circle, radius: 1 } }
camera: { view: top }
image: { size: [80 mm, 60 mm], margin: 4 mm }
"""


class Page(ProgramTest):
    def drawn(self, scene, *arguments):
        """The root of the scene's SVG file and what the program says."""
        self.write("scene.yaml", scene)
        errors = self.run_program("draw", "scene.yaml", "-o", "scene.svg", *arguments)[1]
        return tree.fromstring(self.bytes_of("scene.svg")), errors

    def of_class(self, root, name):
        return [group for group in root.iter(SVG + "g") if group.get("class") == name]

    def places(self, root):
        """Of all paths the points that they go through or are drawn by."""
        found = []
        for path in root.iter(SVG + "path"):
            data = re.sub(r"A\S+ \S+ \S+ \S+ \S+ ", "L", path.get("d"))
            numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", data)]
            found += list(zip(numbers[::2], numbers[1::2]))
        return found

    def box(self, root):
        """Of all paths."""
        places = self.places(root)
        return min(x for x, _ in places), min(y for _, y in places), max(x for x, _ in places), max(y for _, y in places)

    def texts(self, root):
        return ["".join(text.itertext()) for text in root.iter(SVG + "text")]

    def radius(self, root):
        path = self.of_class(root, "curve")[0].find(SVG + "path")
        return float(re.search(r" A([\d.]+)", path.get("d")).group(1))

    def annotated(self, *annotations):
        return CIRCLE + "drawing: { annotations: [" + ", ".join(annotations) + "] }\n"

    # ---------------------------------------------------------------- room for annotations

    def test_room_for_dimensions(self):
        """A dimension that reaches three radii away leaves the circle as large as it can be."""
        root, _ = self.drawn(self.annotated("{ type: linear_dimension, from: [0, 0], to: [0, -3] }"))
        self.assertEqual(self.texts(root), ["3"])
        # 4 radii and 3 mm in 52 mm.
        self.assert_near(self.radius(root), (52 - 3) / 4, 0.6)
        lo_x, lo_y, hi_x, hi_y = self.box(root)
        self.assertTrue(lo_x >= 4 and lo_y >= 4 and hi_x <= 76 and hi_y <= 56, (lo_x, lo_y, hi_x, hi_y))

    def test_room_for_what_stands_outside(self):
        for annotation, name, words in (
                ("{ type: point, at: [3, 0], label: B }", "point", ["B"]),
                ("{ type: brace, from: [3, 0], to: [3, -2], label: B }", "brace", ["B"]),
                ("{ type: leader, at: [1, 0], to: [4, 2], text: B }", "leader", ["B"]),
                ("{ type: label, at: [0, 5], text: B }", "label", ["B"])):
            root, errors = self.drawn(self.annotated(annotation))
            self.assertNotIn("not in the drawing", errors)
            self.assertEqual(self.texts(root), words, annotation)
            self.assertTrue(self.of_class(root, name) or self.of_class(root, "mark"), annotation)
            lo_x, lo_y, hi_x, hi_y = self.box(root)
            self.assertTrue(lo_x >= 4 and lo_y >= 4 and hi_x <= 76 and hi_y <= 56, (annotation, self.box(root)))
            self.assertGreater(self.radius(root), 6, annotation)

    def test_room_for_several(self):
        root, _ = self.drawn(self.annotated("{ type: arrow, from: [0, 0], to: [-6, 0] }",
                                            "{ type: linear_dimension, from: [0, 0], to: [0, -5] }"))
        self.assertEqual(self.texts(root), ["5"])
        heads = [path for path in self.of_class(root, "arrow")[0].findall(SVG + "path") if path.get("fill")]
        self.assertEqual(len(heads), 1)
        lo_x, lo_y, hi_x, hi_y = self.box(root)
        self.assertTrue(lo_x >= 4 and lo_y >= 4 and hi_x <= 76 and hi_y <= 56, (lo_x, lo_y, hi_x, hi_y))

    def test_annotations_alone(self):
        """Without objects the annotations fill the page."""
        root, _ = self.drawn("""lekalo: 1
objects: []
drawing:
  annotations:
    - { type: point, at: [0, 0], label: A }
    - { type: point, at: [30, 0], label: B }
    - { type: brace, from: [0, 0], to: [30, 0], label: l }
    - { type: label, at: [10, 15], text: far }
    - { type: angle, at: [0, 0], from: [30, 0], to: [10, 15], label: a }
camera: { view: top }
image: { size: [80 mm, 60 mm], margin: 4 mm }
""")
        self.assertEqual(sorted(self.texts(root)), ["A", "B", "a", "far", "l"])
        marks = [path for group in self.of_class(root, "mark") for path in group.findall(SVG + "path")]
        self.assertEqual(len(marks), 2)
        lo_x, lo_y, hi_x, hi_y = self.box(root)
        self.assertTrue(lo_x >= 4 and lo_y >= 4 and hi_x <= 76 and hi_y <= 56, (lo_x, lo_y, hi_x, hi_y))
        self.assertGreater(hi_x - lo_x, 60)

    def test_behind_the_eye(self):
        """Nothing is drawn at the mirrored pictures of points behind the eye, and that is said."""
        root, errors = self.drawn("""lekalo: 1
geometry: { s: { type: sphere_surface, radius: 1 } }
camera: { type: perspective, from: [0.3, -4, 1], at: [0, 0, 0] }
drawing:
  annotations:
    - { type: linear_dimension, from: [0, -3, 0], to: [0, -6, 0] }
    - { type: angle_dimension, at: [0, 0, 0], from: [0, -6, 0], to: [1, 0, 0] }
    - { type: brace, from: [-1, 0, 0], to: [-1, -9, 0], label: L }
    - { type: leader, at: [0, 0, 1], to: [1, -9, 1], text: pole }
    - { type: angle, at: [0, -5, 0], from: [1, -5, 0], to: [0, -5, 1], label: x }
    - { type: point, at: [0, 0, 1], label: N }
image: { size: [120 mm, 90 mm] }
""")
        self.assertEqual(self.texts(root), ["N"])
        for kind in ("linear_dimension", "angle_dimension", "brace", "leader", "angle"):
            self.assertIn(f"{kind} at points behind the eye", errors)
            self.assertFalse(self.of_class(root, kind))

    # ---------------------------------------------------------------- lines and their elements

    def test_eye_on_lines(self):
        """Lines towards the eye are points: nothing is drawn, least of all millions of cubics."""
        cone = """lekalo: 1
geometry: { s: { type: cone_surface, radius: 1, height: 2 } }
objects: [{ shape: s, lines: { silhouette: thick, boundary: thick, parameter: { at_u: 12, at_v: 7 }, hidden: dashed } }]
camera: { type: perspective, from: [0, 0, 2], at: [0, 0, 0], up: y }
image: { size: [120 mm, 90 mm], margin: 3 mm }
"""
        self.drawn(cone)
        self.assertLess(len(self.bytes_of("scene.svg")), 20000)
        root, _ = self.drawn("""lekalo: 1
geometry: { s: { type: segment, from: [-3, 0, 0], to: [8, 0, 0] } }
camera: { type: perspective, from: [5, 0, 0], at: [0, 0.5, 0.2] }
""")
        self.assertEqual(list(root.iter(SVG + "path")), [])

    def test_straight_lines(self):
        """The edges of a block are lines in every file, closed loops where they are."""
        root, _ = self.drawn("""lekalo: 1
geometry: { b: { type: box, center: [0, 0, 0], size: [2, 2, 2] } }
objects: [{ shape: b, lines: { sharp: thick, hidden: dashed } }]
camera: { type: perspective, from: [3, 0, 0], at: [0, 0, 0], field_of_view: 80 }
image: { size: [120 mm, 90 mm], margin: 3 mm }
""")
        for path in root.iter(SVG + "path"):
            self.assertRegex(path.get("d"), r"^M[-\d. ]+( L[-\d. ]+)+( Z)?$")
        front = self.of_class(root, "sharp")[0].findall(SVG + "path")
        self.assertEqual(len(front), 1)
        self.assertTrue(front[0].get("d").endswith(" Z"))

    def test_corners_are_closed(self):
        """Where three edges of a pen meet they have round ends; where two do they are one path; dashes keep their ends."""
        root, _ = self.drawn("""lekalo: 1
geometry: { b: { type: box, size: [1, 1, 1] } }
objects: [{ shape: b, lines: { sharp: { width: 2 mm, color: blue }, hidden: dashed } }]
camera: { view: isometric }
image: { size: [60 mm, 60 mm] }
""")
        edges = self.of_class(root, "sharp")[0].findall(SVG + "path")
        self.assertEqual(len(edges), 6)
        self.assertEqual({path.get("stroke-linecap") for path in edges}, {"round"})
        hidden = self.of_class(root, "sharp hidden layers-1")[0].findall(SVG + "path")
        self.assertEqual({path.get("stroke-linecap") for path in hidden}, {None})
        # A free end is none.
        root, _ = self.drawn(CIRCLE.replace("c: { type: circle, radius: 1 }",
                                            "c: { type: segment, from: [0, 0], to: [1, 0] }"))
        self.assertIsNone(next(root.iter(SVG + "path")).get("stroke-linecap"))

    def test_names(self):
        """Every element has an id of its own that XML allows, made of object and kind."""
        root, _ = self.drawn("""lekalo: 1
geometry:
  block: { type: box, size: [1, 2, 3] }
  balls: { repeat: { i: 0..1 }, type: ball, center: [3, 3 * i, 1], radius: 1 }
objects:
  - { shape: block, name: '1st block & more', lines: { sharp: thick, hidden: dashed } }
  - { shape: balls, lines: { silhouette: thick, parameter: { at_u: 4, at_v: 3 } } }
  - { shape: block, name: lines, transform: { translate: [-3, 0, 0] }, lines: { sharp: thick } }
camera: { view: isometric }
drawing:
  ground: fill
  annotations:
    - { type: label, at: [0, 0, 0], text: here }
    - { type: label, at: [3, 0, 1], text: there }
image: { size: [60 mm, 80 mm] }
""")
        ids = [element.get("id") for element in root.iter() if element.get("id")]
        self.assertEqual(len(ids), len(set(ids)))
        for name in ids:
            self.assertRegex(name, r"^[A-Za-z_][\w.-]*$")
        for element in root.iter():
            if element.get("class") not in (None, "paper") or element.tag == SVG + "path":
                self.assertTrue(element.get("id"))
        for name in ("lines", "hidden", "_1st_block___more", "_1st_block___more-sharp", "_1st_block___more-sharp-1",
                     "_1st_block___more-hidden", "balls", "balls-silhouette-1", "balls-silhouette_2-1", "lines_2",
                     "lines-sharp-1"):
            self.assertIn(name, ids)
        # Object groups hold what the object has, kind by kind.
        balls = next(group for group in root.iter(SVG + "g") if group.get("id") == "balls")
        self.assertEqual({group.get("class") for group in balls}, {"parameter", "silhouette"})

    def test_names_in_panels(self):
        root, _ = self.drawn(CIRCLE + "panels: { left: {}, right: { camera: { view: bottom } } }\n")
        ids = [element.get("id") for element in root.iter() if element.get("id")]
        self.assertEqual(len(ids), len(set(ids)))
        for name in ("left", "left-c", "left-c-curve-1", "right", "right-c", "right-c-curve-1"):
            self.assertIn(name, ids)


if __name__ == "__main__":
    unittest.main()
