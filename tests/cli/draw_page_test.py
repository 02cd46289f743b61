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


if __name__ == "__main__":
    unittest.main()
