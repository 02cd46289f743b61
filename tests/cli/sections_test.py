"""Sections of drawings: what is taken away, what is hatched, where it is marked; sections of solids in numbers."""

import math
import re
import unittest

from program import ProgramTest

PART = """
  block: { type: box, size: [4, 4, 4] }
  bore: { type: cylinder_body, radius: 1, axis: { through: [2, 2, 0], along: z }, heights: [-1, 5] }
  part: { type: difference, of: block, minus: bore }
"""


class Sections(ProgramTest):
    def draw(self, objects, drawing="", panels="", view="front"):
        self.write("s.yaml", f"lekalo: 1\ngeometry: {PART}objects: {objects}\ncamera: {{ view: {view} }}\n{drawing}{panels}"
                   "image: { size: [80 mm, auto] }\n")
        self.run_program("draw", "s.yaml", "-o", "s.svg")
        return (self.folder / "s.svg").read_text()

    def hatching(self, svg):
        """The hatching lines of the cut faces, as (x, y, x, y)."""
        group = re.search(r'class="section_hatch".*?</g>', svg, re.S)
        self.assertIsNotNone(group, svg[:2000])
        numbers = r"([-\d.]+)[ ,]([-\d.]+)"
        return [tuple(map(float, found)) for found in re.findall(rf'd="M ?{numbers} ?L ?{numbers}', group.group(0))]

    def test_cut_faces_alone_are_hatched(self):
        section = "[{ shape: part, section: { planes: { through: [2, 2, 2], normal: -y }, hatch: { angle: 0, spacing: 1 mm } } }]"
        lines = self.hatching(self.draw(section))
        # The front is 4 wide, the bore 2: each hatching line is one of the two walls, a quarter of the whole width long.
        lengths = [abs(line[2] - line[0]) for line in lines]
        self.assertGreater(len(lengths), 20)
        self.assert_near(max(lengths), min(lengths), 0.02)
        wide = max(max(line[0], line[2]) for line in lines) - min(min(line[0], line[2]) for line in lines)
        self.assert_near(max(lengths) / wide, 0.25, 1e-3)

    def test_what_is_not_hatched_or_cut(self):
        plane = "planes: { through: [2, 2, 2], normal: -y }"
        self.assertNotIn("section_hatch", self.draw(f"[{{ shape: part, section: {{ {plane}, hatch: none }} }}]"))
        self.assertNotIn("section_hatch", self.draw(f"[{{ shape: part, section_hatch: none, section: {{ {plane} }} }}]"))
        panels = f"panels: {{ a: {{ section: {{ {plane}, title: A }} }} }}\n"
        self.assertIn("section_hatch", self.draw("[{ shape: part }]", panels=panels))
        self.assertNotIn("section_hatch", self.draw("[{ shape: part, section: none }]", panels=panels))

    def test_stepped_paths_in_both_directions(self):
        path = "[[0, 3], [2, 3], [2, 1], [4, 1]]"
        back = "[[4, 1], [2, 1], [2, 3], [0, 3]]"
        both = [self.draw(f"[{{ shape: part, section: {{ path: {p}, towards: -y }} }}]") for p in (path, back)]
        self.assertIn("section_hatch", both[0])
        self.assertEqual(*both)

    def test_operands_do_not_show_in_cut_faces(self):
        """A plane through the axes of two cylinders that are one body: no outline of one crosses the other's cut."""
        def length(through):
            self.write("s.yaml", f"""lekalo: 1
geometry:
  a: {{ type: cylinder_body, radius: 1, height: 4 }}
  b: {{ type: cylinder_body, center: [-2, 0, 2], normal: x, radius: 0.6, height: 4 }}
  u: {{ type: union, of: [a, b] }}
objects: [{{ shape: u, section: {{ planes: {{ normal: -y, through: [0, {through}, 0] }} }} }}]
camera: {{ view: front }}
image: {{ size: [80 mm, auto] }}
""")
            self.run_program("draw", "s.yaml", "-o", "s.svg")
            svg = (self.folder / "s.svg").read_text()
            lines = svg[svg.index('class="lines"'):]
            total = 0
            for path in re.findall(r' d="([^"]*)"', lines):
                points = [tuple(map(float, p)) for p in re.findall(r"(-?[\d.]+)[ ,](-?[\d.]+)", path)]
                total += sum(math.dist(a, b) for a, b in zip(points, points[1:] + points[:1] * ("Z" in path)))
            return total
        self.assert_near(length(0) / length(0.02), 1, 2e-3)

    def test_steps_are_no_edges(self):
        """The plane between two others is not drawn where the section is looked at, in pictures from other sides it is."""
        def upright(view):
            """Shares of the picture's width at which upright edges stand."""
            svg = self.draw("[{ shape: part, section: { path: [[0, 2], [3.6, 2], [3.6, 1], [4, 1]], towards: -y } }]", view=view)
            paths = [[tuple(map(float, place)) for place in re.findall(r"[ML] ?([-\d.]+)[ ,]([-\d.]+)", path)]
                     for path in re.findall(r'<path id="[^"]*-sharp-\d+"[^>]* d="([^"]*)"', svg)]
            across = [x for path in paths for x, _ in path]
            return {round((a[0] - min(across)) / (max(across) - min(across)), 2) for path in paths
                    for a, b in zip(path, path[1:]) if abs(a[0] - b[0]) < 1e-3 and abs(a[1] - b[1]) > 5}

        self.assertEqual(upright("front"), {0, 1})  # the walls of the bore are silhouettes
        self.assertIn(0.9, upright("{ azimuth: -90, elevation: 30 }"))

    def test_center_lines_of_what_is_left(self):
        def axes(section):
            svg = self.draw(f"[{{ shape: part, section: {{ {section} }} }}]", drawing="drawing: { center_lines: true }\n")
            return {x for x in re.findall(r'd="M([\d.]+) [^"]*" [^>]*stroke-dasharray', svg)}

        self.assertEqual(axes("planes: { through: [2, 2, 2], normal: -y }"), {"40"})
        # The bore is taken away; a round tool has no axis of its own.
        self.assertEqual(axes("planes: { through: [2, 3.5, 2], normal: -y }"), set())
        tool = "{ type: cylinder_body, radius: 0.3, axis: { through: [0.5, 0, 0], along: z }, heights: [-1, 5] }"
        self.assertEqual(axes(f"cut_away: {tool}"), {"40"})

    def test_center_lines_are_as_long_as_what_is_left(self):
        """A tool that passes through a low plate beside a high wall."""
        self.write("s.yaml", """lekalo: 1
geometry:
  plate: { type: box, size: [4, 4, 1] }
  wall: { type: box, size: [1, 4, 4], corner: [3, 0, 0] }
  tool: { type: cylinder_body, radius: 0.5, center: [1.5, 2, -1], height: 6 }
  part: { type: difference, of: { type: union, of: [plate, wall] }, minus: tool }
drawing: { center_lines: true }
info: { unit: mm }
panels: { a: { camera: { view: front } } }
layout: { rows: [[a]], scale: 10 }
image: { size: [80 mm, auto] }
""")
        self.run_program("draw", "s.yaml", "-o", "s.svg")
        svg = (self.folder / "s.svg").read_text()
        pieces = re.findall(r'd="M35 ([\d.]+) L35 ([\d.]+)" [^>]*stroke-dasharray', svg)
        heights = [float(y) for piece in pieces for y in piece]
        self.assert_near(max(heights) - min(heights), 10 + 2 * 3, 1e-3)  # 10 mm to a unit, and 3 mm beyond at each end

    def test_families_and_groups_are_cut_as_one(self):
        listed = "[{ type: ball, radius: 1 }, { type: ball, center: [3, 0, 0], radius: 1 }, { type: ball, center: [6, 0, 0], radius: 1 }]"
        for shape in listed, "{ type: group, of: [{ shape: %s }] }" % listed:
            for x in 3, 1.5:  # through the second; between the first and the second
                self.draw(f"[{{ shape: {shape}, section: {{ planes: {{ through: [{x}, 0, 0], normal: -x }} }} }}]")
            for through, message in ((9, "leaves nothing"), (-9, "does not cut")):
                self.write("e.yaml", f"lekalo: 1\nobjects: [{{ shape: {shape}, section: "
                           f"{{ planes: {{ through: [{through}, 0, 0], normal: -x }} }} }}]\n")
                self.assertIn(message, self.run_program("check", "e.yaml", code=3)[1])

    def test_capped_clips_stay_closed(self):
        both = self.draw("[{ shape: block, clip: { through: [2, 0, 0], normal: x, cap: true }, "
                         "section: { planes: { through: [0, 2, 0], normal: -y }, hatch: { angle: 0 } } }]")
        self.assertGreater(len(self.hatching(both)), 5)
        # The same solid by half-spaces, seen from where its cap is.
        pictures = []
        for look in ("clip: { through: [2, 0, 0], normal: x, cap: true }, shape: block",
                     "shape: { type: intersection, of: [block, { type: half_space, through: [2, 0, 0], normal: x }] }"):
            self.write("c.yaml", f"""lekalo: 1
geometry: {PART}objects: [{{ {look}, section: {{ planes: {{ through: [0, 2, 0], normal: -y }} }} }}]
camera: {{ view: {{ azimuth: 30, elevation: 20 }} }}
image: {{ size: [40, 30], samples: 4 }}
""")
            self.run_program("render", "c.yaml", "-o", "c.png")
            pictures.append((self.folder / "c.png").read_bytes())
        self.assertEqual(*pictures)

    def test_errors(self):
        for section, message in (("{ hatch: none }", "one of 'planes', 'path' and 'cut_away'"),
                                 ("{ planes: { through: [0, 9, 0], normal: y } }", "does not cut"),
                                 ("{ planes: { through: [0, 9, 0], normal: -y } }", "leaves nothing"),
                                 ("{ path: [[0, 2], [4, 2]] }", "needs 'towards'"),
                                 ("{ path: [[0, 3], [3, 3], [3, 1], [2, 1]], towards: -y }", "goes back"),
                                 ("{ path: [[0, 3], [0, 3], [4, 3]], towards: -y }", "the one before"),
                                 ("{ path: [[2, 0], [2, 4]], towards: -y }", "does not lead across"),
                                 ("{ path: [[2, 4], [2, 2], [4, 2]], towards: -y }", "ends along"),
                                 ("{ cut_away: block, towards: x }", "goes with 'path'")):
            self.write("e.yaml", f"lekalo: 1\ngeometry: {PART}objects: [{{ shape: part, section: {section} }}]\n")
            self.assertIn(message, self.run_program("check", "e.yaml", code=3)[1], section)

        self.write("e.yaml", f"lekalo: 1\ngeometry: {PART}objects: [{{ shape: part }}]\n"
                   "panels: { a: { section: { planes: { through: [2, 2, 2], normal: -y }, title: '$A' } } }\n")
        text = (self.folder / "e.yaml").read_text().replace("'$A'", "A")
        for plane, message in (("{ through: [2, 9, 2], normal: -y }", "leaves nothing"),
                               ("{ through: [2, 9, 2], normal: y }", "cuts none")):
            self.write("p.yaml", text.replace("{ through: [2, 2, 2], normal: -y }", plane))
            said = self.run_program("check", "p.yaml", code=3)[1]
            self.assertIn(message, said)
            self.assertIn("section", said)
        self.assertIn("this $ has no partner", self.run_program("check", "e.yaml", code=3)[1])

    def test_sections_of_solids_in_numbers(self):
        self.write("n.yaml", f"""lekalo: 1
geometry: {PART}  ball: {{ type: implicit, formula: x^2 + y^2 + z^2 - 1, ball: {{ radius: 1.5 }} }}
  pipe: {{ type: cylinder_surface, radius: 1, height: 3 }}
""")
        # By its boundary: of each branch.
        found = self.json_of("measure", "n.yaml", "part", "--section", "0,0,2,0,0,1")
        self.assert_near(sum(branch["length"] for branch in found["branches"]), 16 + 2 * math.pi, 1e-9)
        found = self.json_of("measure", "n.yaml", "part", "--section", "0,2,0,0,1,0")
        self.assert_near(sum(branch["length"] for branch in found["branches"]), 4 * 1 + 4 * 4, 1e-9)
        found = self.json_of("measure", "n.yaml", "ball", "--section", "0,0,0.6,0,0,1")
        self.assert_near(found["length"], 2 * math.pi * 0.8, 1e-8)
        found = self.json_of("measure", "n.yaml", "ball", "--silhouette", "0,0,-1")
        self.assert_near(found["length"], 2 * math.pi, 1e-8)

    def test_table_of_a_section_in_space_and_in_its_plane(self):
        self.write("t.yaml", "lekalo: 1\ngeometry: { pipe: { type: cylinder_surface, radius: 1, height: 3 } }\n")
        (branch,) = self.json_of("measure", "t.yaml", "pipe", "--section", "0,0,1,0,0,2", "--samples", 9)["branches"]
        for row in branch["samples"]:
            self.assert_near(row["point"][2], 1, 1e-12)
            self.assert_near(math.hypot(*row["in_plane"]), 1, 1e-12)
        self.assertIn("in the plane", self.run_program("measure", "t.yaml", "pipe", "--section", "0,0,1,0,0,2")[0])


if __name__ == "__main__":
    unittest.main()
