"""lekalo draw -o figure.dxf: entities, layers and looks in the file; and its lines beside those of the SVG file."""

import math
import re
import unittest
import xml.etree.ElementTree as tree

from program import ProgramTest, ROOT

NEAR = 1e-3  # millimetres
STEPS = 256
BLOCK = """lekalo: 1
geometry:
  block: { type: box, size: [2, 1, 1] }
  rim: { type: circle, radius: 0.4, center: [1, 0.5, 1] }
  way: { type: bezier_curve, points: [[-1, -1, 0.5], [0, -2, 1], [0, 0, 1], [1, -1, 0.5]] }
objects:
  - { shape: block, name: stone, lines: { sharp: thick, hidden: dashed } }
  - { shape: [rim, way], lines: { curve: { color: red, width: 0.5 mm } } }
drawing: { annotations: [{ type: point, at: [0, 0, 0], label: 'aǎ' }] }
camera: { view: VIEW }
image: { size: [60 mm, 40 mm] }
"""


def groups_of(text):
    lines = text.split("\n")
    return [(int(code), value) for code, value in zip(lines[::2], lines[1::2])]


class Dxf:
    """Sections of a file; each a list of entities (kind, groups)."""

    def __init__(self, text):
        self.sections, entities, name = {}, None, None
        groups = groups_of(text)
        for (code, value), (_, after) in zip(groups, groups[1:] + [(0, "")]):
            if (code, value) == (0, "SECTION"):
                entities = self.sections.setdefault(after, [])
            elif code == 0:
                entities.append((value, []))
            elif entities:
                entities[-1][1].append((code, value))
        self.entities = [one for one in self.sections["ENTITIES"] if one[0] != "ENDSEC"]

    def kinds(self):
        result = {}
        for kind, _ in self.entities:
            result[kind] = result.get(kind, 0) + 1
        return result


def values(groups, code):
    return [float(value) for number, value in groups if number == code]


def bezier(p, s):
    w = ((1 - s)**3, 3 * s * (1 - s)**2, 3 * s * s * (1 - s), s**3)
    return tuple(sum(w[k] * p[k][c] for k in range(4)) for c in range(2))


def points_of(kind, groups):
    """Of an entity: points along it, the ends among them; None of what is no line."""
    one = lambda code: values(groups, code)[0]
    if kind == "LINE":
        return [(one(10), one(20)), (one(11), one(21))]
    if kind == "LWPOLYLINE":
        points = list(zip(values(groups, 10), values(groups, 20)))
        return points + (points[:1] if ("70", "1") in [(str(c), v.strip()) for c, v in groups] else [])
    if kind in ("ARC", "CIRCLE"):
        begin, end = (math.radians(one(50)), math.radians(one(51))) if kind == "ARC" else (0, 2 * math.pi)
        end += 2 * math.pi if end <= begin else 0
        angles = [begin + (end - begin) * k / STEPS for k in range(STEPS + 1)]
        return [(one(10) + one(40) * math.cos(a), one(20) + one(40) * math.sin(a)) for a in angles]
    if kind == "ELLIPSE":
        x, y, ratio = one(11), one(21), one(40)
        angles = [one(41) + (one(42) - one(41)) * k / STEPS for k in range(STEPS + 1)]
        return [(one(10) + math.cos(a) * x - ratio * math.sin(a) * y, one(20) + math.cos(a) * y + ratio * math.sin(a) * x)
                for a in angles]
    if kind == "SPLINE":
        points = list(zip(values(groups, 10), values(groups, 20)))
        knots = [float(i) for i in range((len(points) - 1) // 3 + 1) for _ in range(3)]
        assert values(groups, 40) == knots[:1] + knots + knots[-1:]
        return [bezier(points[i:i + 4], k / STEPS) for i in range(0, len(points) - 3, 3) for k in range(STEPS + 1)]
    return None


def arc_points(p, rx, ry, turn, sweep, q):
    """SVG 1.1, F.6.5, of arcs of half a turn at most."""
    c, s = math.cos(turn), math.sin(turn)
    dx, dy = (p[0] - q[0]) / 2, (p[1] - q[1]) / 2
    x, y = c * dx + s * dy, c * dy - s * dx
    share = max(0, rx * rx * ry * ry - rx * rx * y * y - ry * ry * x * x) / (rx * rx * y * y + ry * ry * x * x)
    f = math.sqrt(share) * (1 if sweep else -1)
    cx, cy = f * rx * y / ry, -f * ry * x / rx
    begin, end = math.atan2((y - cy) / ry, (x - cx) / rx), math.atan2((-y - cy) / ry, (-x - cx) / rx)
    end += 2 * math.pi * ((1 if end < begin else 0) if sweep else (-1 if end > begin else 0))
    mx, my = (p[0] + q[0]) / 2, (p[1] + q[1]) / 2
    for k in range(STEPS + 1):
        a = begin + (end - begin) * k / STEPS
        u, v = cx + rx * math.cos(a), cy + ry * math.sin(a)
        yield (mx + c * u - s * v, my + s * u + c * v)


def lines_of_svg(path):
    """Polylines along all that is stroked, and the height of the page."""
    root = tree.parse(path).getroot()
    height = float(root.get("height")[:-2])
    result = []
    for element in root.iter():
        if not element.tag.endswith("}path") or not element.get("stroke"):
            continue
        at = begin = None
        for command, text in re.findall(r"([MLCAZ])([^MLCAZ]*)", element.get("d")):
            n = [float(x) for x in text.split()]
            if command == "M":
                begin, line = (n[0], n[1]), []
                result.append(line)
            elif command == "L":
                line += [at, (n[0], n[1])]
            elif command == "C":
                line += [bezier([at, tuple(n[0:2]), tuple(n[2:4]), tuple(n[4:6])], k / STEPS) for k in range(STEPS + 1)]
            elif command == "A":
                line += arc_points(at, n[0], n[1], math.radians(n[2]), n[4] == 1, (n[5], n[6]))
            else:
                line += [at, begin]
            at = tuple(n[-2:]) if n else begin
    return [[(x, height - y) for x, y in line] for line in result if line], height


def distance(p, polylines):
    best = float("inf")
    for line in polylines:
        for (ax, ay), (bx, by) in zip(line, line[1:]):
            dx, dy = bx - ax, by - ay
            square = dx * dx + dy * dy
            s = 0 if square == 0 else min(1, max(0, ((p[0] - ax) * dx + (p[1] - ay) * dy) / square))
            best = min(best, math.hypot(p[0] - ax - s * dx, p[1] - ay - s * dy))
    return best


class DxfFiles(ProgramTest):
    def drawn(self, scene):
        _, errors = self.run_program("draw", scene, "-o", "a.dxf", "-o", "a.svg")
        return Dxf((self.folder / "a.dxf").read_text()), errors

    def check_beside_svg(self, dxf):
        theirs, _ = lines_of_svg(self.folder / "a.svg")
        ours = [points for points in (points_of(*one) for one in dxf.entities) if points]
        chords = 2 * NEAR  # the sag of both polylines is less than half of NEAR
        for lines, others in ((ours, theirs), (theirs, ours)):
            for line in lines:
                for p in line[::16] + line[-1:]:
                    self.assertLess(distance(p, others), chords, p)
        for kind, groups in dxf.entities:
            if kind in ("LINE", "LWPOLYLINE"):
                for p in points_of(kind, groups):
                    self.assertLess(min(math.dist(p, q) for line in theirs for q in line), NEAR)

    def test_entities_and_layers(self):
        self.write("block.yaml", BLOCK.replace("VIEW", "isometric"))
        dxf, errors = self.drawn("block.yaml")
        self.assertNotIn("note", errors)
        self.assertEqual(dxf.kinds(), {"LINE": 4, "LWPOLYLINE": 4, "ELLIPSE": 1, "SPLINE": 1, "HATCH": 1, "TEXT": 1})
        sides = sum(len(points_of(*one)) - 1 for one in dxf.entities if one[0] in ("LINE", "LWPOLYLINE"))
        self.assertEqual(sides, 12)
        layers = {value for _, groups in dxf.entities for code, value in groups if code == 8}
        self.assertEqual(layers, {"sharp", "sharp-hidden", "curve", "mark", "point"})
        declared = {dict(groups)[2]: dict(groups) for kind, groups in dxf.sections["TABLES"] if kind == "LAYER"}
        self.assertTrue(layers <= set(declared))
        self.assertEqual((int(declared["curve"][62]), int(declared["curve"][370])), (1, 50))
        self.assertEqual(declared["sharp"][6], "Continuous")
        self.assertEqual(declared["sharp-hidden"][6], "DASH-1")
        text = next(dict(groups) for kind, groups in dxf.entities if kind == "TEXT")
        self.assertEqual(text[1], "a\\U+01CE")
        self.check_beside_svg(dxf)

    def test_from_above_circles_are_circles(self):
        self.write("block.yaml", BLOCK.replace("VIEW", "top"))
        dxf, _ = self.drawn("block.yaml")
        self.assertEqual(dxf.kinds()["CIRCLE"], 1)
        self.check_beside_svg(dxf)

    def test_handles_are_unique_and_the_same_scene_makes_the_same_file(self):
        self.write("block.yaml", BLOCK.replace("VIEW", "isometric"))
        dxf, _ = self.drawn("block.yaml")
        first = self.bytes_of("a.dxf")
        handles = [value for entities in dxf.sections.values() for _, groups in entities for code, value in groups[:3] if code == 5]
        self.assertEqual(len(handles), len(set(handles)))
        self.run_program("draw", "block.yaml", "-o", "b.dxf")
        self.assertEqual(first, self.bytes_of("b.dxf"))

    def test_figures(self):
        for name in "graph", "section_stepped", "detail_view":
            found = sorted((ROOT / "scenes").rglob(f"{name}.yaml"))
            self.assertTrue(found, name)
            with self.subTest(name):
                dxf, _ = self.drawn(found[0])
                self.assertGreater(len(dxf.entities), 10)
                for _, groups in dxf.entities:
                    for code, value in groups:
                        if 10 <= code < 60:
                            self.assertTrue(math.isfinite(float(value)))

    def test_outputs(self):
        self.write("made.yaml", BLOCK.replace("VIEW", "front") + "outputs: [made.dxf]\n")
        self.assertEqual(self.run_program("draw", "made.yaml")[1], "made.dxf\n")


if __name__ == "__main__":
    unittest.main()
