"""Detail views: where they are cut, at which scale, what they are called, and their marks; balloons."""

import re
import unittest

from program import ProgramTest, SCENE_ERROR

SCENE = """lekalo: 1
geometry: { block: { type: box, size: [20, 10, 8] } }
objects: { shape: block, lines: { sharp: { width: 0.5 mm }, hidden: drop } }
panels:
  front: { camera: { view: front }, drawing: { annotations: [{ type: detail_circle, of: b }] } }
  b: { camera: { view: front }, detail: { around: [20, 0, 8], radius: 2, DETAIL } }
layout: { rows: [[front, b]]SCALE }
info: { unit: mm }
image: { size: [140 mm, auto] }
"""
CIRCLE = r'<circle cx="([-\d.]+)" cy="([-\d.]+)" r="([-\d.]+)"/>'


class Details(ProgramTest):
    def scene(self, detail="scale: 5, title: B", scale=", scale: 1"):
        text = SCENE.replace("DETAIL", detail) if detail else SCENE.replace(", DETAIL", "")
        return self.write("s.yaml", text.replace("SCALE", scale))

    def draw(self, *of_scene):
        self.run_program("draw", self.scene(*of_scene), "-o", "s.svg")
        return (self.folder / "s.svg").read_text()

    def clip(self, svg):
        found = re.findall(CIRCLE, svg)
        self.assertTrue(found, svg[:3000])
        self.assertEqual(len(set(found)), 1)
        return tuple(map(float, found[0]))

    def panel(self, svg, name):
        return re.split(r'class="panel"', svg)[{"front": 1, "b": 2}[name]]

    def edges(self, panel):
        """Ends of the paths of the sharp edges, in millimetres, and their widths."""
        group = re.search(r'class="sharp".*?</g>', panel, re.S).group(0)
        ends = [tuple(map(float, pair)) for pair in re.findall(r"[ML] ?([-\d.]+)[ ,]([-\d.]+)", group)]
        return ends, set(re.findall(r'stroke-width="([\d.]+)"', group))

    def test_it_is_cut_at_its_circle_at_its_scale(self):
        svg = self.draw()
        x, y, r = self.clip(svg)
        self.assert_near(r, 10, 1e-3)  # 2 mm, five times as large
        (ends, widths), (seen, same) = self.edges(self.panel(svg, "b")), self.edges(self.panel(svg, "front"))
        self.assertEqual(widths, same)
        # The corner is the middle of the circle; the block goes on to its left and below, over the circle.
        self.assert_near([max(p[0] for p in ends), min(p[1] for p in ends)], [x, y], 2e-3)
        self.assertLess(min(p[0] for p in ends), x - 10)
        self.assertGreater(max(p[1] for p in ends), y + 10)
        self.assert_near(max(p[0] for p in seen) - min(p[0] for p in seen), 20, 2e-3)

    def test_its_mark_in_the_other_view(self):
        svg = self.draw()
        front = self.panel(svg, "front")
        corner = self.edges(front)[0]
        group = re.search(r'class="detail_circle".*?</g>', front, re.S).group(0)
        right, top = max(p[0] for p in corner), min(p[1] for p in corner)
        start = tuple(map(float, re.search(r'd="M ?([-\d.]+)[ ,]([-\d.]+)', group).groups()))
        self.assert_near(start, [right + 2, top], 2e-3)
        self.assertRegex(front, r">B</tspan>")
        self.assertNotIn("detail_circle", self.panel(svg, "b"))

    def test_titles(self):
        for detail, title in (("scale: 5, title: B", "B (5:1)"), ("scale: 0.5, title: B", "B (1:2)"), ("scale: 2", "2:1"),
                              ("scale: 0.3, title: B", "B (1:3.333)"), ("scale: 10/3", "3.333:1")):
            self.assertIn(f">{title}</tspan>", self.draw(detail), detail)
        self.assertIn(">B</tspan>", self.panel(self.draw("title: B", ""), "b"))

    def test_as_large_as_there_is_room(self):
        x, y, r = self.clip(self.draw("title: B", ""))
        self.assertGreater(r, 25)  # of a panel 67.5 mm wide
        self.assertLess(r, 33.75)
        self.assert_near(x, 140 - 33.75, 0.5)
        self.assert_near(self.clip(self.draw("scale: 4", ""))[2], 8, 1e-3)

    def test_every_format_is_cut(self):
        scene = self.scene()
        self.run_program("draw", scene, "-o", "s.pdf", "-o", "s.tikz", "--quiet")
        self.assertRegex((self.folder / "s.tikz").read_text(), r"\\clip \([\d.]+,[\d.]+\) circle\[radius=10(\.0*)?\];")
        self.assertTrue(self.bytes_of("s.pdf").startswith(b"%PDF-"))

    def test_one_panel_alone(self):
        self.write("p.yaml", (self.folder / self.scene()).read_text() + "outputs: { file: s.svg, panel: b }\n")
        self.run_program("draw", "p.yaml")
        self.assert_near(self.clip((self.folder / "s.svg").read_text())[2], 10, 1e-3)

    def test_what_is_said_of_other_places_is_left_out(self):
        shown = "{ type: label, at: [20, 0, 8], text: corner }"
        outside = "{ type: label, at: [0, 0, 0], text: outside, side: below }"
        scene = (self.folder / self.scene()).read_text()
        drawn = []
        for annotations in (shown, f"{shown}, {outside}"):
            self.write("l.yaml", scene.replace("title: B } }", "title: B }, drawing: { annotations: [%s] } }" % annotations))
            errors = self.run_program("draw", "l.yaml", "-o", "l.svg")[1]
            drawn.append((self.folder / "l.svg").read_text())
        self.assertIn(">corner</tspan>", drawn[0])
        self.assertIn("not in the drawing: label 'outside' outside of the detail (l.yaml:", errors)
        self.assertEqual(*drawn)
        through = "{ type: arrow, from: [0, 0, 8], to: [40, 0, 8], label: through }"
        self.write("l.yaml", scene.replace("title: B } }", "title: B }, drawing: { annotations: [%s] } }" % through))
        self.assertNotIn("not in the drawing", self.run_program("draw", "l.yaml", "-o", "l.svg")[1])

    def test_errors(self):
        for detail, scale, message in (("title: B", ", scale: 1", "has no scale, but the page has one"),
                                       ("scale: 50", "", "has no room in its panel"),
                                       ("scale: 0", "", "scale"),
                                       ("scale: -2", "", "scale")):
            self.assertIn(message, self.run_program("draw", self.scene(detail, scale), "-o", "s.svg", code=SCENE_ERROR)[1])
        good = (self.folder / self.scene()).read_text()
        for old, new, message in (("radius: 2", "radius: 0", "radius"),
                                  ("of: b", "of: front", "there is no panel 'front' with a detail"),
                                  ("b: { camera: { view: front }", "b: { camera: { type: perspective, from: [9, -50, 9], at: [9, 0, 4] }",
                                   "a detail is a view by a parallel camera")):
            self.write("e.yaml", good.replace(old, new))
            self.assertIn(message, self.run_program("check", "e.yaml", code=SCENE_ERROR)[1], new)

    def test_a_slip_in_a_detail_is_all_that_is_said(self):
        good = (self.folder / self.scene()).read_text()
        for old, new in (("radius: 2", "radius: 0"), ("detail: {", "detial: {"),
                         ("b: { camera: { view: front }", "b: { camera: { type: perspective, from: [9, -50, 9], at: [9, 0, 4] }")):
            self.write("e.yaml", good.replace(old, new))
            said = self.run_program("check", "e.yaml", code=SCENE_ERROR)[1]
            self.assertTrue(said.startswith("e.yaml:6:"), said)
            self.assertNotIn("there is no panel", said)

    def test_marks_of_what_looks_another_way_are_left_out_by_name(self):
        self.write("o.yaml", (self.folder / self.scene()).read_text().replace("front: { camera: { view: front }",
                                                                              "front: { camera: { view: top }"))
        self.assertIn("of a panel that looks another way", self.run_program("draw", "o.yaml", "-o", "o.svg")[1])

    def test_balloons(self):
        self.write("n.yaml", """lekalo: 1
geometry: { block: { type: box, size: [20, 10, 8] } }
camera: { view: front }
drawing: { annotations: [{ type: balloon, at: [10, 0, 4], to: [30, 0, 4], text: '7' }] }
image: { size: [80 mm, auto] }
""")
        self.run_program("draw", "n.yaml", "-o", "n.svg")
        svg = (self.folder / "n.svg").read_text()
        self.assertIn(">7</tspan>", svg)
        circle, line, *rest = re.findall(r'<path[^>]* d="([^"]*)"', "".join(re.findall(r'class="balloon".*?</g>', svg, re.S)))
        self.assertIn("A3 3 ", circle)
        # The line begins on the circle, 3 mm left of its middle, and ends at the part.
        numbers = list(map(float, re.findall(r"[-\d.]+", line)))
        rim = list(map(float, re.findall(r"[-\d.]+", circle)))[:2]
        self.assert_near(numbers[:2], [rim[0] - 6, rim[1]], 2e-3)


if __name__ == "__main__":
    unittest.main()
