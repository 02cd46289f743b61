"""Drawings on their page: what has room there, which way lines are written, what their elements are called."""

import math
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
        return [place for path in root.iter(SVG + "path") for place in self.places_of(path)]

    def places_of(self, path):
        data = re.sub(r"A\S+ \S+ \S+ \S+ \S+ ", "L", path.get("d"))
        numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", data)]
        return list(zip(numbers[::2], numbers[1::2]))

    def place_of_text(self, root, words=None):
        """Of the one text, or of that with these words: where it begins, and by how much it is turned."""
        group, = [group for group in root.iter(SVG + "g") if group.find(SVG + "text") is not None and
                  words in (None, "".join(group.find(SVG + "text").itertext()))]
        numbers = [float(x) for x in re.findall(r"-?[\d.]+(?:e-?\d+)?", group.get("transform"))]
        return tuple(numbers[:2]), numbers[2] if len(numbers) > 2 else 0

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

    def test_arrows_on_closed_curves(self):
        """Where a circle or a polygon begins, along its last side or back along its first."""
        circle = "{ type: circle, radius: 1 }"
        polygon = "{ type: polyline, points: [[1, 0], [0, 1], [-1, 0]], closed: true }"
        for geometry, arrows, way in ((circle, "end", (0, -1)), (circle, "start", (0, 1)), (polygon, "end", (1, 0)),
                                      (polygon, "start", (math.sqrt(0.5), math.sqrt(0.5)))):
            root, _ = self.drawn(f"lekalo: 1\ngeometry: {{ c: {geometry} }}\nobjects: {{ shape: c, lines: {{ curve: "
                                 f"{{ arrows: {arrows}, arrow_size: 3 mm }} }} }}\ncamera: {{ view: top }}\n"
                                 "image: { size: [80 mm, 60 mm] }\n")
            head, = [self.places_of(path) for path in root.iter(SVG + "path") if path.get("fill") not in (None, "none")]
            tip, a, b = head[:3]
            found = [(tip[k] - 0.5 * (a[k] + b[k])) / 3 for k in (0, 1)]
            self.assert_near(found, way, 0.1)  # a chord of 3 mm of a circle of 30

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

    def test_cameras_that_frame_some(self):
        """What a camera leaves out of its picture gets no room; a dimension of what it frames does."""
        scene = """lekalo: 1
geometry: { c: { type: circle, radius: 1 }, far: { type: circle, center: [40, 0], radius: 1 } }
camera: { view: top, frame: [c], margin: 0 }
image: { size: [80 mm, 60 mm], margin: 4 mm }
"""
        root, _ = self.drawn(scene)
        self.assert_near(self.radius(root), 26, 0.1)
        self.assertIsNone(self.of_class(root, "lines")[0].get("clip-path"))
        # What goes on beyond the picture ends at it, not somewhere in the margin.
        root, _ = self.drawn(scene.replace("far: { type: circle, center: [40, 0], radius: 1 }",
                                           "far: { type: segment, from: [0, 0], to: [40, 0] }"))
        self.assertEqual(self.of_class(root, "lines")[0].get("clip-path"), "url(#clip)")
        root, _ = self.drawn(scene + "drawing: { annotations: "
                             "[{ type: linear_dimension, from: [-1, 0], to: [1, 0], offset: -30 mm }] }\n")
        self.assertEqual(self.texts(root), ["2"])
        self.assertGreater(self.radius(root), 15)
        lo_x, lo_y, hi_x, hi_y = self.box(root)
        self.assertTrue(lo_x >= 4 and lo_y >= 4 and hi_x <= 76 and hi_y <= 56, (lo_x, lo_y, hi_x, hi_y))

    def test_solids_are_framed_by_what_is_left(self):
        """Of operations on solids the picture holds what they leave, as large as it can be: 52 mm high or 72 mm wide."""
        balls = [f"{{ type: ball, center: [{x}, 0, 0], radius: 5 }}" for x in (-4, 4)]
        mast = "{ type: box, corner: [0, 0, 0], size: [0.1, 0.1, 9] }"
        for solid, width, height in (
                ("intersection, of: [%s, %s]" % tuple(balls), 2, 6),
                ("difference, of: { type: union, of: [{ type: box, corner: [0, 0, 0], size: [9, 9, 1] }, %s] }, minus: "
                 "{ type: box, corner: [5, -1, -1], size: [9, 19, 9] }" % mast, 5, 9),
                ("intersection, of: [{ type: box, corner: [-4.5, -4.5, -4.5], size: [9, 9, 9] }, "
                 "{ type: half_space, through: [0, 0, 3], normal: z }, "
                 "{ type: half_space, through: [2, 0, 0], normal: x }, { type: half_space, through: [-2, 0, 0], normal: -x }]",
                 4, 7.5)):
            root, _ = self.drawn(f"""lekalo: 1
geometry: {{ s: {{ type: {solid} }} }}
camera: {{ view: front, margin: 0 }}
image: {{ size: [80 mm, 60 mm], margin: 4 mm }}
""")
            lo_x, lo_y, hi_x, hi_y = self.box(root)
            scale = min(72 / width, 52 / height)
            self.assert_near(hi_y - lo_y, scale * height, 0.1)
            # Outlines in between are known by their ends alone.
            self.assertLess(hi_x - lo_x, scale * width + 0.1)
            self.assertTrue(lo_x >= 3.8 and lo_y >= 3.8 and hi_x <= 76.2 and hi_y <= 56.2, (solid, self.box(root)))

    def test_behind_the_eye(self):
        """Nothing is drawn at the mirrored pictures of points behind the eye; what is not there is said, once each."""
        root, errors = self.drawn("""lekalo: 1
geometry: { s: { type: sphere_surface, radius: 1 }, b: { type: bezier_curve, points: [[2, 2, 0], [0, -9, 0]] } }
objects:
  - { shape: s }
  - { shape: b, show: { control_polygon: { label: '$p_%i$' } } }
camera: { type: perspective, from: [0.3, -4, 1], at: [0, 0, 0] }
drawing:
  annotations:
    - { type: linear_dimension, from: [0, -3, 0], to: [0, -6, 0] }
    - { type: angle_dimension, at: [0, 0, 0], from: [0, -6, 0], to: [1, 0, 0] }
    - { type: brace, from: [-1, 0, 0], to: [-1, -9, 0], label: L }
    - { type: leader, at: [0, 0, 1], to: [1, -9, 1], text: pole }
    - { type: angle, at: [0, -5, 0], from: [1, -5, 0], to: [0, -5, 1], label: x }
    - { type: point, at: [0, 0, 1], label: N }
    - { type: point, at: [0, -5, 1], label: P }
    - { type: label, at: [0, -5, 1], text: '$q_1$' }
    - { type: arrow, from: [0, -6, 1], to: [0, -9, 1] }
    - { type: arrow, from: [0, 0, 1], to: [0, -9, 1], label: F }
    - { type: light_path, from: [0, -6, 0], to: [0, -9, 0], bounces: 0 }
image: { size: [120 mm, 90 mm] }
""")
        self.assertEqual(sorted(self.texts(root)), ["N", "p0"])
        for kind in ("linear_dimension", "angle_dimension", "brace", "leader", "angle", "light_path"):
            self.assertFalse(self.of_class(root, kind))
        notes = re.findall("note: not in the drawing: (.*)", errors)
        self.assertEqual(notes, ["signs of 'b' at points behind the eye", "texts of 'b' at points behind the eye",
                                 "linear_dimension at points behind the eye (scene.yaml:9)",
                                 "angle_dimension at points behind the eye (scene.yaml:10)",
                                 "brace 'L' at points behind the eye (scene.yaml:11)",
                                 "leader 'pole' at points behind the eye (scene.yaml:12)",
                                 "angle 'x' at points behind the eye (scene.yaml:13)",
                                 "point 'P' at points behind the eye (scene.yaml:15)",
                                 "label '$q_1$' at points behind the eye (scene.yaml:16)",
                                 "arrow at points behind the eye (scene.yaml:17)",
                                 "arrow 'F' as far as it is at points behind the eye (scene.yaml:18)",
                                 "light_path at points behind the eye (scene.yaml:19)"])

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

    # ---------------------------------------------------------------- size and part of the page

    def test_crop(self):
        """The part that the scene or --crop names, in the page's pixels; the drawing stays where it is."""
        whole, _ = self.drawn("lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\nimage: { size: [80, 80] }\n")
        part, _ = self.drawn("lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\n"
                             "image: { size: [80, 80], crop: [0, 0, 40, 20] }\n")
        pixel = 25.4 / 96
        box = [float(x) for x in part.get("viewBox").split()]
        self.assert_near(box, [0, 0, 40 * pixel, 20 * pixel], 1e-3)
        self.assert_near(float(part.get("width").removesuffix("mm")), 40 * pixel, 1e-3)
        self.assertEqual([path.get("d") for path in whole.iter(SVG + "path")],
                         [path.get("d") for path in part.iter(SVG + "path")])
        part, _ = self.drawn("lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\nimage: { size: [80, 80] }\n",
                             "--crop", "40,40,80,60", "-o", "part.png", "-o", "part.pdf")
        self.assert_near([float(x) for x in part.get("viewBox").split()],
                         [40 * pixel, 40 * pixel, 40 * pixel, 20 * pixel], 1e-3)
        self.assertEqual(self.png_size("part.png"), (40, 20))
        self.assertIn(b"/MediaBox [ 0 0 30 15 ]", self.bytes_of("part.pdf"))
        errors = self.run_program("draw", "scene.yaml", "--crop", "40,40,90,60", code=USAGE)[1]
        self.assertIn("does not lie inside", errors)

    def png_size(self, name):
        data = self.bytes_of(name)
        return int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")

    def test_size(self):
        """So many pixels; the page keeps its width, lines and texts theirs."""
        scene = CIRCLE + "drawing: { annotations: [{ type: label, at: [0, 0], text: a }] }\n"
        for size, page in (("400x300", (80, 60)), ("300x300", (80, 80))):
            root, _ = self.drawn(scene, "--size", size, "--threads", "1", "-o", "scene.png")
            self.assertEqual((root.get("width"), root.get("height")), (f"{page[0]}mm", f"{page[1]}mm"))
            self.assertEqual(self.png_size("scene.png"), tuple(int(x) for x in size.split("x")))
            self.assertEqual(next(root.iter(SVG + "path")).get("stroke-width"), "0.5")
        self.run_program("draw", "scene.yaml", "--size", "300", code=USAGE)

    def test_automatic_sides_have_their_margins(self):
        """What is between the margins has the content's shape, whichever side is given; pictures have no margins."""
        scene = """lekalo: 1
geometry: { f: { type: plane, domain: { u: [0, 10], v: [0, 3] } } }
objects: { shape: f, lines: { boundary: thick } }
camera: { view: top, margin: 0 }
image: { size: SIZE, margin: 8 mm }
"""
        for size, page, content in (("[80 mm, auto]", (80, 35.2), (64, 19.2)), ("[auto, 35.2 mm]", (80, 35.2), (64, 19.2)),
                                    ("[302, auto]", (79.904, 35.171), (63.904, 19.171))):
            root, _ = self.drawn(scene.replace("SIZE", size))
            self.assert_near([float(root.get(side).removesuffix("mm")) for side in ("width", "height")], page, 0.01)
            lo_x, lo_y, hi_x, hi_y = self.box(root)
            whole_pixels = 0.05 if "mm" in size else 0.5
            self.assert_near((hi_x - lo_x, hi_y - lo_y), content, whole_pixels)
            self.assert_near((lo_x, lo_y), (8, 8), whole_pixels)
        self.write("wide.yaml", scene.replace("SIZE", "[80 mm, auto]") + "outputs: [{ file: a.svg, width: 160 mm }]\n")
        self.run_program("draw", "wide.yaml")
        root = tree.fromstring(self.bytes_of("a.svg"))
        self.assert_near(float(root.get("height").removesuffix("mm")), 0.3 * 144 + 16, 0.01)
        # The height is free, so that only the width must hold the margins.
        self.drawn(scene.replace("SIZE", "[80 mm, auto]").replace("8 mm", "13 mm"))
        self.write("thick.yaml", scene.replace("SIZE", "[80 mm, auto]").replace("8 mm", "40 mm"))
        errors = self.run_program("draw", "thick.yaml", code=SCENE_ERROR)[1]
        self.assertIn("thick.yaml:5:39: a margin of 40 mm leaves nothing of a page 80.0 mm wide", errors)
        self.assertIn("hint: less than 39.5 mm", errors)
        self.write("picture.yaml", scene.replace("SIZE", "[100, auto]"))
        self.run_program("render", "picture.yaml", "-o", "a.png")
        self.assertEqual(self.bytes_of("a.png")[16:24].hex(), f"{100:08x}{30:08x}")

    def test_places_on_the_page(self):
        """They count from the page's lower left corner, whatever the margin."""
        root, _ = self.drawn(self.annotated("{ type: point, at: { page: [10 mm, 20 mm] }, marker: square }"))
        point = self.of_class(root, "point")[0]
        x, y = self.box(point)[0] + self.box(point)[2], self.box(point)[1] + self.box(point)[3]
        self.assert_near([x / 2, y / 2], [10, 40], 1e-3)

    # ---------------------------------------------------------------- what does not fit

    def test_too_large(self):
        """What does not fit is an error of the scene: where, and what would."""
        panels = """lekalo: 1
geometry: { b: { type: box, size: [1, 1, 1] } }
panels: { a: { camera: { view: top } }, b: { camera: { view: front } } }
layout: { rows: [[a, b]], scale: SCALE }
image: { size: [80 mm, auto] }
"""
        self.write("wide.yaml", panels.replace("SCALE", "50"))
        errors = self.run_program("draw", "wide.yaml", code=SCENE_ERROR)[1]
        self.assertIn("wide.yaml:4:34: the panels do not fit at this scale: they need ", errors)
        scale = re.search(r"hint: scale: ([\d.]+) fits", errors).group(1)
        self.write("fits.yaml", panels.replace("SCALE", scale))
        self.run_program("draw", "fits.yaml")
        self.write("next.yaml", panels.replace("SCALE", str(1.1 * float(scale))))
        self.run_program("draw", "next.yaml", code=SCENE_ERROR)
        self.write("margin.yaml", CIRCLE.replace("margin: 4 mm", "margin: 30 mm"))
        errors = self.run_program("draw", "margin.yaml", code=SCENE_ERROR)[1]
        self.assertIn("margin.yaml:4:40: a margin of 30 mm leaves nothing of a page of 80.0 x 60.0 mm", errors)
        self.assertIn("hint: less than 29.5 mm", errors)
        self.write("panels.yaml", panels.replace(", scale: SCALE", "").replace("auto]", "auto], margin: 45 mm"))
        errors = self.run_program("draw", "panels.yaml", code=SCENE_ERROR)[1]
        self.assertIn("panels.yaml:5:39: margins and gaps leave no room for 2 panels in a row and 1 in a column on "
                      "a page 80.0 mm wide", errors)

    # ---------------------------------------------------------------- angles, texts of dimensions

    PLAN = """lekalo: 1
geometry: { p: { type: plane, domain: { u: [0, 4], v: [0, 3] } } }
objects: { shape: p, lines: { boundary: thick } }
camera: { type: parallel, view: VIEW }
drawing: { annotations: [ANNOTATIONS] }
image: { size: [80 mm, auto], margin: 4 mm }
"""

    def planned(self, view, *annotations):
        """The picture, and where the plane's points fall, by its corners (0, 0), (4, 0), (0, 3)."""
        root, _ = self.drawn(self.PLAN.replace("VIEW", view).replace("ANNOTATIONS", ", ".join(annotations)))
        sides = [self.places(group) for group in self.of_class(root, "boundary")]
        corners = sorted({(round(x, 3), round(y, 3)) for side in sides for x, y in side})
        self.assertEqual(len(corners), 4, corners)
        return root, corners

    def test_angle_dimensions_in_oblique_views(self):
        """The arc is a circle in the plane of the angle, its end on the line beyond the nearer point."""
        root, corners = self.planned("{ azimuth: -60, elevation: 30 }",
                                     "{ type: angle_dimension, at: [4, 0, 0], from: [0, 0, 0], to: [4, 3, 0] }")
        far, apex, near = corners[0], max(corners, key=lambda p: p[1]), corners[-1]
        x = [(far[k] - apex[k]) / 4 for k in (0, 1)]
        y = [(near[k] - apex[k]) / 3 for k in (0, 1)]

        def in_plane(place):
            a, b = place[0] - apex[0], place[1] - apex[1]
            det = x[0] * y[1] - x[1] * y[0]
            return (a * y[1] - b * y[0]) / det, (x[0] * b - x[1] * a) / det

        # Millimetres of a scene unit across the sight: what lies along x is seen by sqrt(1 - (cos 30 sin 60)^2) of it.
        unit = (x[0] ** 2 + x[1] ** 2) ** 0.5 / (1 - (0.75 ** 0.5 * 0.5) ** 2) ** 0.5
        radius = 3 + 8 / unit
        paths = [path for group in self.of_class(root, "angle_dimension") for path in group.findall(SVG + "path")]
        tips = sorted(in_plane(self.places_of(path)[0]) for path in paths if path.get("fill"))
        for tip, expected in zip(tips, ((0, radius), (radius, 0))):
            self.assert_near(tip[0], expected[0], 2e-3)
            self.assert_near(tip[1], expected[1], 2e-3)
        line, = [path for path in paths if re.fullmatch(r"M\S+ \S+ L\S+ \S+", path.get("d"))]
        begin, end = map(in_plane, self.places_of(line))
        self.assert_near(begin[0], 0, 2e-3)
        self.assertTrue(3 < begin[1] < radius < end[1], (begin, end))

    def test_straight_angles(self):
        """A half circle in the plane across the way of sight, counterclockwise from the first side."""
        for view in ("top", "{ azimuth: -60, elevation: 30 }"):
            for first, second, above in (("[1, 0, 0]", "[-1, 0, 0]", True), ("[-1, 0, 0]", "[1, 0, 0]", False)):
                sides = f"at: [0, 0, 0], from: {first}, to: {second}"
                root, _ = self.drawn(CIRCLE.replace("view: top", f"view: {view}") + "drawing: { annotations: ["
                                     f"{{ type: angle, {sides}, label: a }}, {{ type: angle_dimension, {sides} }}] }}\n")
                self.assertEqual(sorted(self.texts(root)), ["180°", "a"])
                arc = self.places(self.of_class(root, "angle")[0])
                lo, hi = min(y for _, y in arc), max(y for _, y in arc)
                level = 0.5 * (arc[0][1] + arc[-1][1])
                self.assertGreater(level - lo if above else hi - level, 5, (view, arc))
        # Seen end-on it is nothing.
        root, _ = self.drawn(self.annotated("{ type: angle, at: [0, 0], from: [0, 0, 1], to: [0, 0, -1], label: a }"))
        self.assertEqual(self.texts(root), [])

    def test_annotations_of_no_size(self):
        """Where parameters make one so small, the rest is drawn, and a note says what is not."""
        scene = self.annotated("{ type: arrow, from: [0, 0], to: [h, 0] }") + "parameters: { h: 0 }\n"
        root, errors = self.drawn(scene)
        self.assertIn("arrow of no size", errors)
        self.assertTrue(self.of_class(root, "curve"))

    def test_annotations_seen_end_on(self):
        """Where nothing of one is seen a note says so; its name does not stand alone."""
        seen = ("{ type: linear_dimension, from: [0, 0, 0], to: [1, 0, 0] }, { type: arrow, from: [0, 0, 0], to: [1, 0, 0], "
                "label: x }, { type: diameter_dimension, of: c }")
        hidden = ("{ type: linear_dimension, from: [0, 0, 0], to: [0, 0, 3] }, { type: arrow, from: [0, 0, 0], to: [0, 0, 3], "
                  "label: z }, { type: brace, from: [0, 0, 0], to: [0, 0, 3], label: b }")
        root, errors = self.drawn(self.annotated(seen, hidden))
        for what in ("linear_dimension", "arrow 'z'", "brace 'b'"):
            self.assertIn(f"note: not in the drawing: {what} seen end on (scene.yaml:", errors)
        self.assertEqual(errors.count("not in the drawing"), 3)
        self.assertNotIn("z", self.texts(root))
        panels = "panels: { a: { camera: { view: top } }, b: { camera: { view: front } } }\n"
        errors = self.drawn(self.annotated(hidden) + panels)[1]
        self.assertRegex(errors, "arrow 'z' seen end on .*, in the panel 'a'\n")
        self.assertEqual(errors.count("not in the drawing"), 3)

    def test_short_dimensions(self):
        """A text that does not fit between the arrows stands upon the line's continuation, along any direction."""
        for to, turn in (("[1.2, 1, 0]", 0), ("[1, 1.2, 0]", 90), ("[1.15, 1.15, 0]", 45)):
            root, _ = self.planned("top", f"{{ type: linear_dimension, from: [1, 1, 0], to: {to}, offset: 3 mm }}")
            (x, y), turned = self.place_of_text(root)
            self.assert_near(turned, -turn, 1e-3)
            paths = [path for group in self.of_class(root, "linear_dimension") for path in group.findall(SVG + "path")]
            way = math.cos(math.radians(turn)), -math.sin(math.radians(turn))

            def farthest(paths):
                return max(a * way[0] + b * way[1] for path in paths for a, b in self.places_of(path))

            begin = x * way[0] + y * way[1]
            heads = [path for path in paths if path.get("fill")]
            self.assertEqual(len(heads), 2)
            tips = [self.places_of(head)[0] for head in heads]  # the heads lie outside of both
            self.assert_near(math.dist(*(self.places_of(head)[1] for head in heads)),
                             math.dist(*tips) + 2 * math.dist(tips[0], self.places_of(heads[0])[1]), 0.2)
            self.assertGreater(begin, farthest(heads))
            # The line goes on under the text.
            self.assertGreater(farthest(paths), begin + 3)

    def boxes_of_texts(self, root):
        """Of level texts: about 0.5 em for each digit, 0.25 em for a point, 0.65 em high."""
        boxes = []
        for group in root.iter(SVG + "g"):
            if (text := group.find(SVG + "text")) is not None:
                (x, y), turned = self.place_of_text(group)
                self.assertEqual(turned, 0)
                em = float(next(text.iter(SVG + "tspan")).get("font-size"))
                width = sum(0.25 if c == "." else 0.5 for c in "".join(text.itertext())) * em
                boxes.append((x, y - 0.65 * em, x + width, y))
        return boxes

    def test_crowded_dimensions(self):
        """Numbers of chains and of dimensions on one line stand apart, each over a line of its own, and on the page."""
        chain = [f"{{ type: linear_dimension, from: [{x}, 0, 0], to: [{x + 0.125}, 0, 0], offset: -8 mm, decimals: 3 }}"
                 for x in (0, 0.125, 0.25)]
        above = [f"{{ type: linear_dimension, from: [0, 3, 0], to: [{x}, 3, 0], offset: 8 mm, decimals: 3 }}"
                 for x in (3.125, 3.25, 3.375)]
        root, errors = self.drawn(self.PLAN.replace("VIEW", "top").replace("ANNOTATIONS", ", ".join(chain + above)))
        self.assertNotIn("warning", errors)
        boxes = self.boxes_of_texts(root)
        self.assertEqual(len(boxes), 6)
        width, height = (float(root.get(side).removesuffix("mm")) for side in ("width", "height"))
        for k, a in enumerate(boxes):
            self.assertTrue(a[0] >= 0 and a[1] >= 0 and a[2] <= width and a[3] <= height, a)
            for b in boxes[:k]:
                self.assertFalse(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3], (a, b))
        # Under each a level line, 0.7 mm and what letters need below.
        level = [(p, q) for path in root.iter(SVG + "path") if path.get("stroke")
                 for p, q in [self.places_of(path)[:2]] if len(self.places_of(path)) == 2 and abs(p[1] - q[1]) < 1e-6]
        for lo_x, _, hi_x, y in boxes:
            self.assertTrue(any(min(p[0], q[0]) < lo_x + 0.1 and max(p[0], q[0]) > hi_x - 0.1 and 0.5 < p[1] - y < 2
                                for p, q in level), (lo_x, y))

    def test_texts_of_angles_find_room(self):
        """Without a side they avoid what stands in the middle of the arc; with one they stand where it says."""
        arc = "{ type: angle, at: [0, 0], from: [1, 0], to: [-1, 0.02], label: a, radius: 10 mm SIDE }"
        for side, free in (("", True), (", side: above", False)):
            root, _ = self.drawn(self.annotated(arc.replace("SIDE", side), "{ type: point, at: [0, 0.6] }",
                                                "{ type: arrow, from: [0, 0], to: [0, 2] }"))
            (x, y), _ = self.place_of_text(root)
            middle = min(self.places(self.of_class(root, "arrow")[0]))[0]
            self.assertEqual(abs(x + 0.7 - middle) > 1, free, (x, y))

    def test_texts_avoid_dimensions(self):
        """Lines of dimensions are lines too."""
        root, _ = self.drawn(self.PLAN.replace("VIEW", "isometric").replace(
            "ANNOTATIONS", "{ type: label, at: [4, 0], text: E }, "
            "{ type: linear_dimension, from: [0, 0], to: [4, 0], offset: -8 mm }, "
            "{ type: linear_dimension, from: [4, 0], to: [4, 3], offset: -8 mm }"))
        self.assert_on_no_line(root, self.place_of_text(root, "E")[0], (2, 2))

    def assert_on_no_line(self, root, place, size):
        """No straight line runs through the rectangle of this size over the beginning of a text."""
        x, y = place
        for line in (self.places_of(path) for path in root.iter(SVG + "path") if path.get("stroke")):
            for begin, end in zip(line, line[1:]):
                for part in range(201):
                    at = [a + (b - a) * part / 200 for a, b in zip(begin, end)]
                    self.assertFalse(x < at[0] < x + size[0] and y - size[1] < at[1] < y, (x, y, line))

    def test_texts_avoid_grids(self):
        """Lines across a graph are lines too: (2, 0.9) is beside one and below another."""
        root, _ = self.drawn("""lekalo: 1
geometry: { f: { type: formula_curve, point: [t, sin(t)], domain: [0, 6] } }
camera: { type: graph }
drawing:
  axes: { x: { grid: true, ticks: 0..6 }, y: { grid: true, ticks: [-1, -0.5, 0, 0.5, 1] } }
  annotations: [{ type: point, at: [2, sin(2)], label: E }, { type: linear_dimension, from: [1, 0], to: [3, 0], text: F, offset: -4 mm }]
image: { size: [80 mm, 60 mm] }
""")
        for words, size in (("E", (2, 2)), ("F", (1.5, 1.5))):
            self.assert_on_no_line(root, self.place_of_text(root, words)[0], size)

    def test_letters_of_cutting_planes_avoid_dimensions(self):
        """A dimension whose line lies upon an arrow: that one's letter stands beside it."""
        places = {}
        for offset in ("8 mm", "6 mm"):
            root, _ = self.drawn(f"""lekalo: 1
geometry: {{ plate: {{ type: box, size: [10, 6, 2] }} }}
objects: [{{ shape: plate }}]
panels:
  aa: {{ camera: {{ view: front }}, section: {{ planes: {{ through: [0, 3, 0], normal: -y }}, title: A }} }}
  top:
    camera: {{ view: top }}
    drawing: {{ annotations: [{{ type: cutting_plane, of: aa }}, {{ type: linear_dimension, from: [0, 0, 2], to: [0, 6, 2], offset: {offset} }}] }}
layout: {{ rows: [[aa], [top]], gap: 4 mm }}
image: {{ size: [90 mm, 100 mm] }}
""")
            letters = [group for group in root.iter(SVG + "g") if "".join(group.itertext()) == "A" and group.get("transform")]
            self.assertEqual(len(letters), 2)
            places[offset] = [[float(x) for x in re.findall(r"-?[\d.]+", letter.get("transform"))[:2]] for letter in letters]
            for place in places[offset]:
                self.assert_on_no_line(root, place, (2, 2))
        # Beyond the thick end, or below it.
        self.assertLess(places["6 mm"][0][0], places["6 mm"][1][0] - 1)
        self.assertNotEqual(*[round(place[1], 2) for place in places["6 mm"]])

    def test_pages_are_transparency_groups_where_they_must(self):
        """pdfTeX warns of several figures with groups on a page."""
        opaque = CIRCLE + "outputs: page.pdf\nobjects: [{ shape: c, lines: { curve: { width: 1 mm, opacity: OPACITY } } }]\n"
        for opacity, groups in (("1", False), ("0.5", True)):
            self.write("scene.yaml", opaque.replace("OPACITY", opacity))
            self.run_program("draw", "scene.yaml")
            self.assertEqual(b"/S /Transparency" in self.bytes_of("page.pdf"), groups)

    def test_diameters_of_cones(self):
        """That of the wider end is measured, of what a cut has left of it; from the side its line is the end's."""
        cone = """lekalo: 1
geometry:
  k: { type: cone_body, radius: 6, top_radius: 2, height: 10 }
  c: { type: difference, of: k, minus: { type: box, size: [20, 20, 10], center: [0, 0, 0] } }
drawing: { annotations: [{ type: diameter_dimension, of: %s }] }
camera: { view: %s }
image: { size: [80 mm, 60 mm], margin: 4 mm }
"""
        for body, number in (("k", "⌀12"), ("c", "⌀8"), ("k.side", "⌀12")):
            self.assertEqual(self.texts(self.drawn(cone % (body, "top"))[0]), [number])
        root, _ = self.drawn(cone % ("k", "front"))
        line = self.places(self.of_class(root, "diameter_dimension")[0])
        self.assertGreater(max(x for x, _ in line) - min(x for x, _ in line), 30)

    def test_numbers_of_round_dimensions_avoid_lines(self):
        """Beside the circle is a line: the number stands beyond it, at the end of a longer line."""
        far = []
        for x in (1.72, -1.72):
            root, _ = self.drawn(self.annotated("{ type: arrow, from: [-3, 0], to: [-2, 0] }, { type: arrow, from: [2, 1], "
                                                "to: [3, 1] }, { type: arrow, from: [%g, -1], to: [%g, 1] }" % (x, x),
                                                "{ type: radius_dimension, of: c, leader: 0 }"))
            far.append(self.place_of_text(root, "R1")[0][0])
        self.assertGreater(far[0], far[1] + 1.9)

    def test_numbers_of_angles_stand_at_their_arc(self):
        """Also where lines are beside the arc: there, or at the end of a leader."""
        root, _ = self.drawn("""lekalo: 1
geometry: { tri: { type: polygon, points: [[0, 0], [40, 0], [0, 30]] } }
drawing:
  annotations:
    - { type: linear_dimension, from: [0, 0], to: [0, 30] }
    - { type: angle_dimension, at: [40, 0], from: [0, 30], to: [0, 0] }
camera: { view: top }
image: { size: [90 mm, 60 mm], margin: 3 mm }
""")
        group = self.of_class(root, "angle_dimension")
        (x, y), _ = self.place_of_text(root, "36.87°")
        arc = [place for one in group for path in one.findall(SVG + "path") for place in self.places_of(path)]
        self.assertLess(min(max(px - x - 9, x - px, 0) + max(py - y, y - 3 - py, 0) for px, py in arc), 6)

    # ---------------------------------------------------------------- numbers, graphs, notes

    def test_small_models_have_numbers(self):
        root, _ = self.drawn("""lekalo: 1
geometry:
  c: { type: circle, radius: 5e-5 }
drawing:
  annotations:
    - { type: linear_dimension, from: [0, 0], to: [1e-4, 0] }
    - { type: linear_dimension, from: [0, 0], to: [0, 1e-4], decimals: 2 }
    - { type: radius_dimension, of: c }
camera: { view: top }
""")
        self.assertEqual(sorted(self.texts(root)), ["0", "0.0001", "R5·10−5"])

    def test_graphs_are_cut_with_their_labels(self):
        """A control point beyond the range has no label; a legend in a corner lies on a ground of its own."""
        graph = """lekalo: 1
geometry: { b: { type: bezier_curve, points: [[-3, 1], [-1, 3], [1, -3], [3, 1]] } }
objects:
  - { shape: b, lines: { curve: thick }, show: { control_polygon: { label: '$p_%i$' } }, legend: Bezier }
camera: { type: graph, x: [-4, 4], y: [-2, 2] }
drawing:
  axes: { x: { ticks: none }, y: { ticks: none } }
  legend: { side: SIDE }
  annotations: [{ type: label, at: [0, -2.2], text: under }]
"""
        root, _ = self.drawn(graph.replace("SIDE", "below"))
        self.assertEqual(sorted(self.texts(root)), ["Bezier", "p0", "p3", "under"])
        marks = [path for group in self.of_class(root, "mark") for path in group.findall(SVG + "path")]
        self.assertEqual(len(marks), 2)
        grounds = [path for path in self.of_class(root, "legend")[0].findall(SVG + "path") if path.get("fill")]
        self.assertEqual(grounds, [])
        root, _ = self.drawn(graph.replace("SIDE", "above right"))
        grounds = [path for path in self.of_class(root, "legend")[0].findall(SVG + "path") if path.get("fill")]
        self.assertEqual([path.get("fill") for path in grounds], ["#ffffff"])

    def ticks(self, axes, curve="point: [t, sin(t), 0], domain: [0, 6.28]"):
        """The numbers at the axes of a curve's graph, and what the program says."""
        root, errors = self.drawn(f"""lekalo: 1
geometry: {{ f: {{ type: formula_curve, {curve} }} }}
camera: {{ type: graph }}
drawing: {{ axes: {axes} }}
image: {{ size: [80 mm, 50 mm], margin: 3 mm }}
""")
        texts = [text for group in self.of_class(root, "tick") for text in self.texts(group)]
        return texts, errors

    def legend(self, side, count, text="curve %i", panels=""):
        """A drawing with so many entries; the boxes of their samples and texts by their beginnings."""
        root, errors = self.drawn("lekalo: 1\ngeometry: { c: { repeat: { i: 1..%d }, type: circle, radius: i } }\n"
                                  "objects: { shape: c, legend: '%s' }\n"
                                  "camera: { view: top }\ndrawing: { legend: { side: %s, title: Circles } }\n"
                                  "image: { size: [80 mm, 60 mm], margin: 4 mm }\n%s" % (count, text, side, panels))
        samples = [self.places(group) for group in self.of_class(root, "legend")]
        texts = {words: self.place_of_text(root, words)[0] for words in self.texts(root)} if not panels else {}
        return errors, [place for places in samples for place in places], texts, root

    def apart(self, numbers):
        """Those that are more than 1 apart, in order."""
        kept = []
        for number in sorted(numbers):
            if not kept or number > kept[-1] + 1:
                kept.append(number)
        return kept

    def test_legends_stay_on_the_page(self):
        """Entries that are too many for a row or a column stand in several, in order, and leave room for the picture."""
        for side in ("below", "above", "right", "left", "below right"):
            for count in (9, 14):
                errors, samples, texts, root = self.legend(side, count)
                # Within the circles no corner is free of them.
                self.assertEqual(errors.count("warning"), errors.count("warning: the legend covers lines"), (side, count))
                self.assertEqual("covers" in errors, side == "below right", (side, count))
                self.assertEqual(set(texts), {"Circles", *(f"curve {i}" for i in range(count))})
                for x, y in [*samples, *texts.values()]:
                    self.assertTrue(4 - 1e-6 <= x <= 76 and 4 - 1e-6 <= y <= 56, (side, count, x, y))
                # Each text is 13 mm long, more or less, and 4 mm high.
                places = [texts[f"curve {i}"] for i in range(count)]
                for k, (x, y) in enumerate(places):
                    self.assertLess(x + 12, 76 + 1)
                    for a, b in places[:k]:
                        self.assertTrue(abs(y - b) > 3.5 or abs(x - a) > 12 + 7, (side, k))
                columns, lines = (self.apart(place[axis] for place in places) for axis in (0, 1))
                across = side in ("below", "above")
                for k, (x, y) in enumerate(places):
                    row, column = divmod(k, len(columns)) if across else divmod(k, len(lines))[::-1]
                    self.assertLess(abs(x - columns[column]) + abs(y - lines[row]), 1.5, (side, k))
                self.assertLess(texts["Circles"][1], min(lines))
        # A few stand in one row, or in one column.
        _, _, texts, _ = self.legend("below", 3)
        self.assertEqual(len(self.apart(y for words, (_, y) in texts.items() if words != "Circles")), 1)
        _, _, texts, _ = self.legend("right", 5)
        self.assertEqual(len(self.apart(x for words, (x, _) in texts.items() if words != "Circles")), 1)

    def beside_legend(self, side, size, camera="view: top", more=""):
        """A cross of two lines, 8 x 2, with a legend; the page's width and height in millimetres."""
        root, errors = self.drawn("lekalo: 1\ninfo: { unit: mm }\n"
                                  "geometry: { a: { type: segment, from: [0, 0], to: [8, 2] },\n"
                                  "  b: { type: segment, from: [0, 2], to: [8, 0] } }\n"
                                  "objects: [{ shape: a, legend: first }, { shape: b, legend: 'the second' }]\n"
                                  f"camera: {{ {camera} }}\nimage: {{ size: {size}, margin: 2 mm }}\n" + more)
        return root, errors, [float(root.get(name).removesuffix("mm")) for name in ("width", "height")]

    def test_legends_leave_the_page_as_it_is(self):
        """With annotations, cameras of all kinds, and in panels, whatever the side."""
        for side in ("above", "below", "left", "right", "above left", "below right"):
            drawing = f"drawing: {{ legend: {{ side: {side} }}, annotations: [{{ type: point, at: [0, 0] }}] }}\n"
            for camera in ("view: top", "type: perspective, from: [4, -8, 9], at: [4, 1, 0], field_of_view: 60"):
                for panels, count in (("", 1), ("panels: { p: {}, q: {} }\nlayout: { rows: [[p], [q]] }\n", 2)):
                    root, errors, size = self.beside_legend(side, "[84 mm, 72 mm]", camera, drawing + panels)
                    self.assertEqual(size, [84, 72])
                    self.assertNotIn("not on", errors)
                    self.assertEqual(self.texts(root), count * ["first", "the second"])
                    for x, y in (self.place_of_group(group) for group in self.of_class(root, "legend") if group.find(
                            SVG + "text") is not None):
                        self.assertTrue(2 <= x <= 82 and 2 <= y <= 70, (side, camera, x, y))

    def place_of_group(self, group):
        return [float(x) for x in re.findall(r"-?[\d.]+", group.get("transform"))[:2]]

    def test_automatic_pages_grow_by_their_legend(self):
        """The lines are as wide as the page whatever stands above or below, as high whatever stands beside them."""
        def lines(root):
            places = [place for group in self.of_class(root, "curve") for place in self.places(group)]
            return [max(place[k] for place in places) - min(place[k] for place in places) for k in (0, 1)]
        plain, _, (_, height) = self.beside_legend("below", "[84 mm, auto]")
        for side, size in (("below", "[84 mm, auto]"), ("above", "[84 mm, auto]"), ("right", "[auto, 42 mm]"),
                           ("left", "[auto, 42 mm]")):
            plain, _, before = self.beside_legend(side, size)
            for annotations in ("", ", annotations: [{ type: point, at: [4, 1] }]"):
                root, errors, after = self.beside_legend(
                    side, size, more=f"drawing: {{ legend: {{ side: {side} }}{annotations} }}\n")
                self.assertNotIn("warning", errors)
                grown, kept = (1, 0) if "84" in size else (0, 1)
                self.assertEqual(after[kept], before[kept])
                # One row of texts, 12 pt high, or samples beside texts, with 3 mm between.
                self.assertGreater(after[grown], before[grown] + 5)
                # But for half a millimetre that is left free for the width of lines.
                self.assert_near(lines(root), lines(plain), 0.015 * max(lines(plain)))
        # Beside a flat picture the page is as high as the legend; panels have their legends' room.
        for panels in ("", "panels: { p: {} }\nlayout: { rows: [[p]] }\n",
                       "panels: { p: {} }\nlayout: { rows: [[p]], scale: 2 }\n"):
            for side in ("above", "below", "left", "right"):
                root, errors, _ = self.beside_legend(
                    side, "[60 mm, auto]", more=f"drawing: {{ legend: {{ side: {side} }} }}\n" + panels)
                self.assertNotIn("warning", errors)
                if "scale" in panels:
                    self.assert_near(lines(root), [16, 4], 1e-3)

    def test_legends_in_corners(self):
        """One that would cover a line takes a corner that is free; where none is, that is said."""
        diagonal = ("lekalo: 1\ngeometry: { a: { type: segment, from: [0, 0], to: [8, 6] } }\n"
                    "objects: { shape: a, legend: first }\ncamera: { view: top }\nimage: { size: [80 mm, 60 mm] }\n")
        for side, right, below in (("above left", False, False), ("below right", True, True), ("above right", False, False),
                                   ("below left", False, False)):
            root, errors = self.drawn(diagonal + f"drawing: {{ legend: {{ side: {side} }} }}\n")
            (x, y), _ = self.place_of_text(root, "first")
            self.assertEqual((x > 40, y > 30), (right, below), side)
            self.assertNotIn("warning", errors)
        cross = diagonal.replace("geometry: {", "geometry: { b: { type: segment, from: [0, 6], to: [8, 0] },").replace(
            "objects: { shape: a, legend: first }", "objects: [{ shape: a, legend: first }, { shape: b }]")
        root, errors = self.drawn(cross + "drawing: { legend: { side: below left } }\n")
        (x, y), _ = self.place_of_text(root, "first")
        self.assertEqual((x > 40, y > 30), (False, True))
        self.assertIn("warning: the legend covers lines, which run through all corners", errors)

    def test_legends_that_do_not_fit(self):
        long = "a curve of which very many words have to be said in this legend %i"
        for panels, edges in (("", "the page 80.0 mm"),
                              ("panels: { a: {}, b: {} }\nlayout: { rows: [[a, b]], gap: 4 mm }\n", "the panel 34.0 mm")):
            errors = self.legend("below", 2, long, panels)[0]
            self.assertRegex(errors, r"warning: the text 'a curve of which [a-z ]+\.\.\.' does not fit: it is [\d.]+ mm "
                             "wide, " + edges + "; a shorter text, a smaller `text_size` or a larger page has room for it")

    def test_ticks_at_the_ends(self):
        """What is found of the range is exact: the summits of a sine, which no sample meets, have their ticks."""
        self.assertEqual(self.ticks("{ y: { ticks: [-1, 0, 1] } }")[0], ["−1", "0", "1"])
        texts, errors = self.ticks("{ x: { ticks: [0, 3, 6.28, 9] } }")
        self.assertEqual(texts, ["0", "3", "6.28"])
        self.assertIn("note: not in the drawing: the tick 9 of the x axis, which shows 0 to 6.28", errors)

    def test_automatic_ticks_are_several(self):
        self.assertEqual(self.ticks("{ y: {} }")[0], ["−1", "0", "1"])
        for top in (1, 2, 3, 4, 6, 7, 9, 11, 13, 19, 29):
            curve = f"point: [{top} * t, 0.01 * {top} * t^2, 0], domain: [0.1, 1]"
            for axis in "xy":
                self.assertGreaterEqual(len(self.ticks(f"{{ {axis}: {{}} }}", curve)[0]), 3, (axis, curve))

    def test_numbers_of_ticks(self):
        """Each mark has a number of its own; what is very large or small has a power of ten, the same for all."""
        for y, numbers in [("100000 + 0.2*x", ["99999.6", "99999.8", "100000", "100000.2", "100000.4"]),
                           ("1e9 + x", ["999999998", "1000000000", "1000000002"]),
                           ("5e5*x", ["−106", "0", "106"]),
                           ("1e-7*x", ["−2·10−7", "0", "2·10−7"])]:
            self.assertEqual(self.ticks("{ y: {} }", f"y: {y}, domain: [-2, 2]")[0], numbers)
        self.assertEqual(self.ticks("{ x: { ticks: [0, 1/3, pi] } }")[0], ["0", "0.333333", "3.14159"])

    def test_texts_of_ticks(self):
        """Instead of numbers; where they cover one another it is said."""
        texts, errors = self.ticks("{ x: { ticks: [0, pi/2, pi], texts: ['$0$', '$\\pi/2$', '$\\pi$'] } }")
        self.assertEqual((texts, "warning" in errors), (["0", "π/2", "π"], False))
        errors = self.ticks("{ x: { ticks: 0..6 }, y: { ticks: [-0.8, -0.4, 0, 0.01, 0.02] } }")[1]
        self.assertIn("warning: the texts at the ticks of the y axis cover one another: of 5 have room 3", errors)
        self.assertNotIn("x axis", errors)
        self.write("wrong.yaml", "lekalo: 1\ngeometry: { f: { type: formula_curve, y: x, domain: [0, 1] } }\n"
                   "camera: { type: graph }\ndrawing: { axes: { x: { ticks: [0, 1], texts: [a] } } }\n")
        self.assertIn("1 texts for 2 marks", self.run_program("check", "wrong.yaml", code=SCENE_ERROR)[1])

    def test_numbers_in_texts(self):
        """Decimals, and powers of ten, in a formula or not."""
        root, _ = self.drawn(self.annotated("{ type: label, at: [0, 0], text: '%.2(1/3), %.1(2), $%(1e-9)$, %(2.5e20), %.2(-0.001)' }"))
        self.assertEqual(self.texts(root), ["0.33, 2.0, 10−9, 2.5·1020, 0.00"])

    def test_panels_without_a_place(self):
        """A panel that the layout does not name is said to be left out, unless it has a file of its own."""
        scene = """lekalo: 1
geometry: { b: { type: box, size: [1, 1, 1] } }
panels: { a: { camera: { view: top } }, b: { camera: { view: front } }, c: { camera: { view: left } } }
layout: { rows: [[a, empty]] }
outputs: [a.svg, { file: c.svg, panel: c }]
"""
        errors = self.drawn(scene)[1]
        self.assertIn("note: not in the drawing: the panel 'b', which `rows` of the layout do not name\n", errors)

    def test_titles_have_room(self):
        views = CIRCLE.replace("60 mm], margin: 4 mm", "auto]") + ("panels: { a: { title: One }, b: { title: Two } }\n"
                                                                   "layout: { rows: [[a], [b]] }\n")
        self.assertNotIn("over the page", self.drawn(views)[1])

    def test_titles_stand_above_what_is_drawn(self):
        """Not above control points or corners of boxes; in their own panels, of families too; of graphs above the picture."""
        def tops(root, panel):
            group, = [group for group in root.iter(SVG + "g") if group.get("data-object") == panel]
            return self.box(group)[1], self.place_of_text(group, "One")[0][1]
        peak = """lekalo: 1
geometry:
  s: { type: bezier_surface, points: [[[0,0,0],[0,1,0],[0,2,0]],[[1,0,0],[1,1,9],[1,2,0]],[[2,0,0],[2,1,0],[2,2,0]]] }
objects: { shape: s, lines: { silhouette: thick, boundary: thick, hidden: drop } }
panels: { a: { repeat: { i: 0..1 }, camera: { view: { azimuth: 20, elevation: 35 } }, title: One } }
layout: { rows: [[a.0], [a.1]] }
image: { size: [60 mm, 80 mm], margin: 2 mm }
"""
        root, said = self.drawn(peak)
        self.assertNotIn("warning", said)
        for panel, begin in (("a.0", 2), ("a.1", 38)):
            drawn, title = tops(root, panel)
            self.assertLess(abs(drawn - title - 3), 1.2, panel)  # 3 mm, and what letters have below the line
            self.assertGreater(title, begin, panel)
        graph = """lekalo: 1
geometry: { q: { type: formula_curve, y: x^2, domain: [-2, 2] } }
objects: { shape: q }
panels: { a: { camera: { type: graph }, title: One }, b: { camera: { type: graph, y: [0, 1] }, title: One } }
drawing: { axes: { y: { label: y } } }
image: { size: [120 mm, 60 mm], margin: 3 mm }
"""
        root, said = self.drawn(graph)
        self.assertNotIn("warning", said)
        for panel in "ab":
            self.assertGreater(tops(root, panel)[1], 3)

    def test_narrow_columns(self):
        self.write("scene.yaml", CIRCLE + "panels: { a: {}, b: {} }\nlayout: { rows: [[a, b]], columns: [1, 0.001] }\n")
        said = self.run_program("draw", "scene.yaml", "-o", "scene.svg", code=SCENE_ERROR)[1]
        self.assertIn("of the `columns` of the layout the narrowest has 0.0", said)

    def test_combs_jump_at_joints(self):
        """A segment and an arc of radius 2: the tooth at their joint is 1/2 long; no envelope leans over the segment."""
        root, _ = self.drawn("""lekalo: 1
geometry:
  c: { type: composite_curve, of: [{ type: segment, from: [0, 0], to: [3, 0] }, { type: circle, center: [3, 2], radius: 2, arc: [-90, 0] }] }
objects: [{ shape: c, show: { comb: { scale: -1, count: 8 } } }]
camera: { view: top }
image: { size: [80 mm, auto] }
""")
        line, = self.of_class(root, "curve")
        xs, ys = zip(*self.places(line))
        unit = (max(xs) - min(xs)) / 5
        joint, foot = min(xs) + 3 * unit, max(ys)
        comb = [self.places_of(path) for group in self.of_class(root, "comb") for path in group.iter(SVG + "path")]
        self.assert_near([y for path in comb for x, y in path if x < joint - 0.01], [foot] * sum(
            x < joint - 0.01 for path in comb for x, _ in path), 0.01)
        (a, b), = [step for path in comb for step in zip(path, path[1:])
                   if abs(step[0][0] - joint) + abs(step[1][0] - joint) < 0.02]
        self.assert_near(abs(a[1] - b[1]), 0.5 * unit, 0.02)
        self.assert_near(max(a[1], b[1]), foot, 0.02)

    def test_named_styles_keep_heads(self):
        """Of arrows and dimensions, unless a style says otherwise."""
        def heads(annotation, styles=""):
            root, _ = self.drawn(self.annotated(annotation) + styles)
            return sum(path.get("d").endswith("Z") for path in root.iter(SVG + "path"))
        bare = heads("{ type: label, at: [0, 0], text: a }")
        arrow = "{ type: arrow, from: [-1, 0], to: [1, 0], style: %s }"
        for style in ("thin", "axis", "{ like: axis }", "{ color: red }"):
            self.assertEqual(heads(arrow % style), bare + 1, style)
        self.assertEqual(heads(arrow % "plain", "styles: { plain: { arrows: none } }\n"), bare)
        self.assertEqual(heads(arrow % "{ like: thin, arrows: both }"), bare + 2)
        self.assertEqual(heads("{ type: linear_dimension, from: [-1, 0], to: [1, 0], style: thin }"), bare + 2)

    def test_panels_stand_in_the_order_of_the_scene(self):
        root, _ = self.drawn(CIRCLE.replace("camera: { view: top }", "panels: { z: { title: one, camera: { view: top } }, "
                                            "a: { title: two, camera: { view: top } } }"))
        self.assertLess(self.place_of_text(root, "one")[0][0], self.place_of_text(root, "two")[0][0])

    def test_views_of_a_row_are_aligned(self):
        """By what they show, whatever annotations one of them has."""
        root, _ = self.drawn("""lekalo: 1
geometry: { b: { type: box, size: [20, 10, 8] } }
info: { unit: mm }
panels:
  front: { camera: { view: front }, drawing: { annotations: [{ type: leader, at: [3, 0, 8], to: [5, 0, 20], text: a }] } }
  side: { camera: { view: left } }
layout: { rows: [[front, side]], scale: 1 }
image: { size: [100 mm, auto] }
""")
        front, side = [self.places(group) for panel in self.of_class(root, "panel")
                       for group in self.of_class(panel, "sharp")]
        for which in (min, max):
            self.assert_near(which(y for _, y in front), which(y for _, y in side), 1e-3)

    def test_titles_of_a_row_have_one_baseline(self):
        root, _ = self.drawn(CIRCLE.replace("camera: { view: top }", """panels:
  a: { title: cone, camera: { view: top } }
  b: { title: group, camera: { view: top } }
  c: { title: upper, camera: { view: top }, objects: [{ shape: { type: ellipse, semi_axes: [1, 1.1] } }] }"""))
        heights = [self.place_of_text(root, words)[0][1] for words in ("cone", "group", "upper")]
        self.assert_near(heights, [heights[0]] * 3, 1e-3)

    def test_texts_of_leaders_turn_from_lines(self):
        """A line stands to the right of the leader's end: its text is above."""
        scene = """lekalo: 1
geometry: { s: { type: segment, from: [1, -1], to: [1, 1] }, t: { type: segment, from: [-1, -1], to: [-1, 1] } }
camera: { view: top }
drawing: { annotations: [{ type: leader, at: [-1, 0], to: [0.8, 0.1], text: words%s }] }
image: { size: [80 mm, auto] }
"""
        beside, _ = self.drawn(scene % ", side: right")
        above, _ = self.drawn(scene % "")
        (_, y), _ = self.place_of_text(beside, "words")
        (_, higher), _ = self.place_of_text(above, "words")
        self.assertLess(higher, y - 1)

    def test_center_lines_of_circles(self):
        """Of circles, and of arcs that make one together; none of other arcs. Each passes the circle by 3 mm."""
        for curves, count in (("c: { type: circle, radius: 1 }", 2),
                              ("a: { type: circle, radius: 1, arc: [0, 180] }, b: { type: circle, radius: 1, arc: [180, 360] }", 2),
                              ("a: { type: circle, radius: 1, arc: [0, 180] }", 0),
                              ("a: { type: ellipse, semi_axes: [2, 1] }", 0)):
            root, _ = self.drawn("lekalo: 1\ngeometry: { %s }\ncamera: { view: top }\ndrawing: { center_lines: true }\n"
                                 "image: { size: [80 mm, auto] }\n" % curves)
            lines = [self.places_of(path) for group in self.of_class(root, "center_line") for path in group.iter(SVG + "path")]
            self.assertEqual(len(lines), count, curves)
            if count:
                xs = [x for group in self.of_class(root, "curve") for x, _ in self.places(group)]
                self.assert_near(max(x for line in lines for x, _ in line) - max(xs), 3, 0.01)

    def test_texts_beyond_the_page(self):
        """What goes over an edge is named, with what has room for it; what a graph places itself stays on the page."""
        def warnings(margin, *annotations):
            scene = self.annotated(*annotations).replace("4 mm", f"{margin} mm")
            return re.findall("warning: (.*)", self.drawn(scene)[1])
        self.assertEqual(warnings(4, "{ type: label, at: [0, 0], text: short }"), [])
        held = "; `page` holds it there, whatever the margin$"
        beyond = warnings(4, "{ type: label, at: { page: [500 mm, 5 mm] }, text: a, side: right }")[0]
        self.assertRegex(beyond, "^the text 'a' is not on the page: it stands .* of 80.0 x 60.0 mm" + held)
        self.assert_near(float(re.search("stands ([0-9.]+) mm beyond the right edge", beyond).group(1)), 420, 0.2)
        over = warnings(4, "{ type: label, at: { page: [78 mm, 5 mm] }, text: corner, side: right }")[0]
        self.assertRegex(over, "^the text 'corner' goes [0-9.]+ mm over the page's right edge" + held)
        wide = warnings(4, "{ type: label, at: [0, 0], text: '" + 20 * "wide " + "' }")[0]
        self.assertRegex(wide, "^the text 'wide .*' does not fit: it is [0-9.]+ mm wide, the page 80.0 mm; a shorter text")
        graph = """lekalo: 1
geometry: { N: { repeat: { i: 0..3 }, type: basis_function, degree: 2, knots: [0, 0, 0, 1, 2, 2, 2], index: i } }
objects: [{ shape: N, legend: '$N_%i$' }]
camera: { type: graph }
drawing:
  axes: { x: { ticks: 0..2, label: LABEL }, y: { ticks: [0, 1] } }
  legend: { side: above }
  annotations: [{ type: knots, of: N.0, label: '$t_%i$', multiplicity: once, marker: plus }]
image: { size: [80 mm, 50 mm], margin: MARGIN mm }
"""
        for margin in "02":
            self.assertNotIn("warning", self.drawn(graph.replace("MARGIN", margin).replace("LABEL", "x"))[1])
        label = "{ type: label, at: [2, 0.5], text: end, side: right }"
        at_the_end = graph.replace("LABEL", "x").replace("annotations: [", f"annotations: [{label}, ")
        over = self.drawn(at_the_end.replace("MARGIN", "2"))[1]
        enough = r"the text 'end' goes [0-9.]+ mm over the page's right edge; `margin: ([0-9.]+) mm` gives it room"
        self.assertNotIn("warning", self.drawn(at_the_end.replace("MARGIN", re.search(enough, over).group(1)))[1])
        # Beside a graph that is not in the middle of the page.
        named = graph.replace("LABEL", "x").replace("[0, 1]", "[0, 1], label: " + 25 * "n")
        over = self.drawn(named.replace("MARGIN", "0"))[1]
        self.assertRegex(over, "the text 'n+' goes [0-9.]+ mm over .*; a larger page or a smaller `text_size` has room")

    def test_notes_on_lights(self):
        """The studio is named where something is lit by it."""
        self.assertNotIn("studio", self.drawn(CIRCLE)[1])
        self.assertIn("studio", self.drawn(CIRCLE + "drawing: { ground: shaded }\n", "--size", "40x30")[1])


if __name__ == "__main__":
    unittest.main()
