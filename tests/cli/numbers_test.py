"""evaluate, measure and trace against closed forms: circle, torus, ball, box, and a table of points of a circle."""

import json
import math
import re
import unittest

from program import DIFFERS, ProgramTest, SCENE_ERROR, USAGE

SCENE = """
lekalo: 1
parameters: { tube: 0.5 }
geometry:
  rim:   { type: circle, radius: 2 }
  apex:  [3, 0, 4]
  chord: { type: segment, from: [-4, 1, 0], to: [4, 1, 0] }
  tangent: { type: segment, from: [-4, 2, 0], to: [4, 2, 0] }
  pole:  { type: segment, from: [0, 0.6, 0], to: [0, 0.6, 2] }
  ring:  { type: torus_body, major_radius: 2, minor_radius: tube }
  tire:  { type: torus_surface, major_radius: 2, minor_radius: tube }
  ball:  { type: ball, center: [0, 0, 3], radius: 1.5 }
  block: { type: box, size: [1, 2, 3] }
  floor: { type: plane }
  shell: { type: sphere_surface, radius: 1, domain: { u: [0, 360 deg], v: [0, 90 deg] } }
  south: { type: sphere_surface, radius: 1, domain: { u: [0, 360 deg], v: [-90 deg, 0] } }
  bend:  { type: circle, center: [4, 3, 0], radius: 2, arc: [-90 deg, 0] }
  inside: { type: half_space, through: [0, 0, 1], normal: z }
  disc:  { type: trimmed_surface, of: { type: plane }, loops: [{ type: circle, radius: 2 }] }
  patch: { type: bezier_surface, points: [[[20, 0, 0], [20, 1, 1], [20, 2, 0]], [[21, 0, 1], [21, 1, 3], [21, 2, 1]],
           [[22, 0, 0], [22, 1, 1], [22, 2, 0]]] }
  tile:  { type: mesh, file: tile.obj }
objects:
  - { shape: ball }
  - { shape: block, name: brick, transform: { translate: [10, 0, 0] } }
  - { shape: ring, transform: { translate: [0, 0, -10] } }
  - { shape: patch }
"""

TILE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"


class Numbers(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.yaml", SCENE)
        self.write("tile.obj", TILE)

    def measure(self, name, *more):
        return self.json_of("measure", "scene.yaml", name, *more)

    def test_length_of_a_circle(self):
        measured = self.measure("rim")
        self.assertEqual(measured["kind"], "curve")
        self.assert_near(measured["length"], 4 * math.pi, 1e-13)
        self.assertLess(measured["length_error"], 1e-11)
        self.assert_near(measured["centroid"], [0, 0, 0], 1e-14)
        self.assertTrue(0 < measured["centroid_error"] < 1e-11)

    def test_a_torus_cut_at_its_inner_equator(self):
        """The plane that touches the hole cuts a spiric section that crosses itself; both parts are the whole torus."""
        self.write("spiric.yaml", """lekalo: 1
geometry:
  ring: { type: torus_body, major_radius: 5, minor_radius: 2 }
  skin: { type: torus_surface, major_radius: 5, minor_radius: 2 }
  far: { type: half_space, through: [0, 3, 0], normal: -y }
  piece: { type: intersection, of: [ring, far] }
  rest: { type: difference, of: ring, minus: far }
""")
        # The area of a slice of the torus at the distance y from the axis, summed over y; the length of its border.
        for name, volume in (("piece", 114.886320193), ("rest", 279.897855851)):
            measured = self.json_of("measure", "spiric.yaml", name)
            self.assertEqual(measured["kind"], "body")
            self.assert_near(measured["volume"], volume, 1e-8)
            self.assertLess(measured["volume_error"], 1e-8)
        section = self.run_program("measure", "spiric.yaml", "skin", "--section", "0,3,0,0,1,0")[0]
        self.assertIn("1 branch, 1 singular point", section)
        self.assert_near(float(re.search(r"length ([\d.]+)", section).group(1)), 31.9196152828, 1e-10)

    def test_torus_area_volume_and_moments(self):
        """Area 4 pi^2 R r, volume 2 pi^2 R r^2 (Pappus); moments V (R^2 + 3/4 r^2), V (R^2/2 + 5/8 r^2)."""
        for tube in 0.5, 0.25:
            measured = self.measure("ring", "--set", f"tube={tube}")
            volume = 2 * math.pi**2 * 2 * tube**2
            across, about = volume * (2 + 0.625 * tube**2), volume * (4 + 0.75 * tube**2)
            self.assertTrue(measured["closed"])
            self.assert_near(measured["area"], 8 * math.pi**2 * tube, 1e-11)
            self.assert_near(measured["volume"], volume, 1e-11)
            self.assert_near(measured["centroid"], [0, 0, 0], 1e-12)
            self.assert_near(measured["principal_moments"], [across, across, about], 1e-10)
            self.assert_near(measured["inertia"], [[across, 0, 0], [0, across, 0], [0, 0, about]], 1e-10)
            for key in "area", "volume":
                self.assertLess(measured[key + "_error"], 1e-10)
        self.assert_near(self.measure("tire")["area"], 4 * math.pi**2, 1e-11)

    def test_open_surfaces_and_meshes(self):
        """A hemisphere's sheet balances at half its radius."""
        measured = self.measure("shell")
        self.assert_near(measured["area"], 2 * math.pi, 1e-12)
        self.assert_near(measured["centroid"], [0, 0, 0.5], 1e-12)
        tile = self.measure("tile")
        self.assert_near(tile["area"], 1, 1e-15)
        self.assertFalse(tile["closed"])
        self.assertNotIn("volume", tile)

    def test_box_axes(self):
        measured = self.measure("block")
        self.assert_near([measured["volume"], measured["area"]], [6, 22], 1e-12)
        self.assert_near(measured["centroid"], [0.5, 1, 1.5], 1e-13)
        self.assert_near(measured["principal_moments"], [0.5 * (1 + 4), 0.5 * (1 + 9), 0.5 * (4 + 9)], 1e-12)
        axes = [[abs(x) for x in axis] for axis in measured["principal_axes"]]
        self.assert_near(axes, [[0, 0, 1], [0, 1, 0], [1, 0, 0]], 1e-12)

    def test_smallest_blank_lies_along_a_side(self):
        corners = [[1.4, 2.53], [2.86, 2.41], [1.15, 0.21]]
        self.write("prism.yaml", f"lekalo: 1\ngeometry: {{ prism: {{ type: extrusion_body, along: z, of: {{ type: polyline, "
                   f"closed: true, points: {corners} }} }} }}\n")
        (ax, ay), (bx, by), (cx, cy) = corners
        twice = abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax))
        # Both other sides of this triangle are within the width of the longest: height times length.
        self.assert_near(self.json_of("measure", "prism.yaml", "prism", "--blank", "0,0,1")["volume"], twice, 1e-7)

    def test_text_has_all_digits(self):
        text, _ = self.run_program("measure", "scene.yaml", "rim")
        length = text.split("length", 1)[1].split()[0]
        self.assertEqual(float(length), self.measure("rim")["length"])

    def test_what_cannot_be_measured(self):
        for name, reason in ("floor", "unbounded"), ("bal", "did you mean 'ball'?"):
            self.assertIn(reason, self.run_program("measure", "scene.yaml", name, code=USAGE)[1])
        self.assertIn("no topology", self.run_program("measure", "scene.yaml", "rim", "--topology", code=USAGE)[1])

    def test_topology(self):
        block = self.measure("block", "--topology")
        self.assertEqual([len(block[key]) for key in ("faces", "edges", "vertices", "violations")], [6, 12, 8, 0])
        self.assertEqual((block["valid"], block["closed"], block["euler_characteristic"]), (True, True, 2))
        self.assertEqual(sorted(face["name"] for face in block["faces"]),
                         ["x_max", "x_min", "y_max", "y_min", "z_max", "z_min"])
        for edge in block["edges"]:
            self.assertEqual((len(edge["faces"]), edge["curve"]), (2, "line"))
        self.assertEqual({face["surface"] for face in block["faces"]}, {"plane"})
        # Every edge is used once along and once against its direction; four of each face's loop, end to end.
        uses = [use for face in block["faces"] for loop in face["coedges"] for use in loop]
        self.assertEqual(sorted((use["edge"], use["forward"]) for use in uses),
                         [(edge, forward) for edge in range(12) for forward in (False, True)])
        points = [vertex["point"] for vertex in block["vertices"]]
        for face in block["faces"]:
            self.assertEqual([len(loop) for loop in face["coedges"]], [4])
            walk = []
            for use in face["coedges"][0]:
                edge = block["edges"][use["edge"]]
                walk.append((edge["start"], edge["end"]) if use["forward"] else (edge["end"], edge["start"]))
            self.assertEqual([end for _, end in walk], [start for start, _ in walk[1:] + walk[:1]])
            # Counter-clockwise seen against the outward normal: the area vector looks where the name says.
            axis, side = "xyz".index(face["name"][0]), 1 if face["name"].endswith("max") else -1
            a, b = ((axis + 1) % 3, (axis + 2) % 3)
            corners = [points[start] for start, _ in walk]
            area = sum(p[a] * q[b] - p[b] * q[a] for p, q in zip(corners, corners[1:] + corners[:1]))
            self.assertGreater(side * area, 0, face["name"])
        text = self.run_program("measure", "scene.yaml", "block", "--topology")[0]
        self.assertRegex(text, r"z_max +plane +\+ loop( [+-]\d+){4}\n")
        ring = self.measure("ring", "--topology")
        # Golovanov 2016, 5.6e: the loop of a torus +e1 +e2 -e1 -e2.
        (loop,) = ring["faces"][0]["coedges"]
        first, second = loop[0]["edge"], loop[1]["edge"]
        self.assertEqual([(use["edge"], use["forward"]) for use in loop],
                         [(first, True), (second, True), (first, False), (second, False)])
        self.assertTrue(ring["faces"][0]["forward"])
        self.assertEqual(ring["euler_characteristic"], 0)
        self.assertEqual([edge["kind"] for edge in ring["edges"]], ["seam", "seam"])
        tile = self.measure("tile", "--topology")
        self.assertEqual([tile[key] for key in ("points", "sides", "triangles", "euler_characteristic", "closed")],
                         [4, 5, 2, 1, False])
        self.assertEqual([tile[key] for key in ("free_sides", "turned_sides", "crowded_sides")], [4, 0, 0])

    def test_what_keeps_meshes_from_being_closed(self):
        """A tetrahedron of volume 1/6; with one face turned, turned inside out, without a face, with a fin."""
        points = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
        faces = ["f 1 3 2\n", "f 1 2 4\n", "f 2 3 4\n", "f 1 4 3\n"]

        def of(faces):
            self.write("solid.obj", points + "".join(faces))
            self.write("solid.yaml", "lekalo: 1\ngeometry: { solid: { type: mesh, file: solid.obj } }\n")
            return (self.json_of("measure", "solid.yaml", "solid"),
                    self.run_program("measure", "solid.yaml", "solid")[0])

        self.assert_near(of(faces)[0]["volume"], 1 / 6, 1e-15)
        found, text = of(["f 1 2 3\n", "f 1 4 2\n", "f 2 4 3\n", "f 1 3 4\n"])
        self.assert_near(found["volume"], -1 / 6, 1e-15)
        self.assertIn("inside out", text)
        for changed, sides in ((["f 1 2 3\n"] + faces[1:], [0, 3, 0]), (faces[1:], [3, 0, 0]),
                               (faces + ["v 2 2 2\nf 1 2 5\n"], [2, 0, 1])):
            found, text = of(changed)
            self.assertEqual([found[key] for key in ("free_sides", "turned_sides", "crowded_sides")], sides)
            self.assertIn("not closed", text)

    def test_distance_from_a_point(self):
        """The torus' four feet (Golovanov 2016, 4.2) and a circle's two; a point by name."""
        found = self.measure("tire", "--to", "1,2,2")
        ring = math.hypot(math.sqrt(5) - 2, 2)
        self.assert_near(found["distance"], ring - 0.5, 1e-14)
        self.assertEqual([foot["kind"] for foot in found["feet"]], ["minimum", "saddle", "saddle", "maximum"])
        self.assert_near(found["feet"][0]["u"], math.atan2(2, 1), 1e-14)
        found = self.measure("rim", "--to", "apex")
        self.assert_near([foot["distance"] for foot in found["feet"]], [math.hypot(1, 4), math.hypot(5, 4)], 1e-14)
        found = self.measure("rim", "--to", "0,0,1")
        self.assert_near([found["distance"], *found["arcs"][0]], [math.sqrt(5), 0, 2 * math.pi], 1e-14)
        text = self.run_program("measure", "scene.yaml", "rim", "--to", "apex")[0]
        self.assertEqual(self.measure("rim", "--to", "1,1")["feet"], self.measure("rim", "--to", "1,1,0")["feet"])
        self.assertIn("minimum", text)

    def test_umbilics_of_an_ellipsoid(self):
        """Semi-axes a < b < c: x^2 = a^2 (b^2 - a^2)/(c^2 - a^2), both curvatures a c/b^3."""
        self.write("egg.yaml", "lekalo: 1\ngeometry: { egg: { type: ellipsoid, semi_axes: [1, 2, 3] } }\n")
        found = json.loads(self.run_program("measure", "egg.yaml", "egg", "--features", "--json")[0])["features"]
        self.assertEqual(len(found), 4)
        for one in found:
            self.assert_near([abs(one["point"][0]), abs(one["curvature"])], [math.sqrt(3 / 8), 3 / 8], 1e-14)

    def test_hausdorff_of_a_curve_and_its_offset(self):
        """As far apart everywhere: each part of either might hold the farthest point."""
        self.write("pair.yaml", "lekalo: 1\ngeometry:\n"
                   "  base: { type: nurbs_curve, degree: 4, points: [[0,0],[1,2],[3,2.5],[4,-1],[6,0.5],[7,2]], weights: [1,2,0.5,1,3,1] }\n"
                   "  side: { type: offset_curve, of: base, distance: 0.3 }\n")
        found = json.loads(self.run_program("measure", "pair.yaml", "base", "--hausdorff", "side", "--json")[0])
        low, high = found["lower"], found["upper"]
        self.assertTrue(0.3 * (1 - 1e-12) <= low <= high <= 0.3 * (1 + 1e-6), found)

    def test_distance_between_things(self):
        """A ball of radius 1.5 at height 3 above a box of height 3; a chord above a torus; a disc's rim inside a sphere."""
        found = self.measure("ball", "--to", "chord")
        self.assert_near(found["distance"], math.hypot(3, 1) - 1.5, 1e-14)
        self.assertTrue(0 <= found["distance"] - found["bound"] < 1e-13)
        self.assertEqual((found["kind"], found["meet"], len(found["minima"])), ("body", False, 1))
        self.assert_near(found["minima"][0]["at_other"]["t"], 0.5, 1e-12)
        found = self.measure("block", "--to", "10,1,1.5")
        self.assert_near([one["distance"] for one in found["minima"]], [9, 10], 1e-14)
        self.assertTrue(all("face" in one["at"] for one in found["minima"]))
        found = self.measure("block", "--to", "10,1,1.5", "--nearest")
        self.assertEqual(len(found["minima"]), 1)
        found = self.measure("tire", "--to", "rim")
        self.assert_near(found["distance"], 0.5, 1e-13)
        self.assertFalse(found["minima"][0]["isolated"])
        self.assertEqual(len(found["minima"][0]["at_other"]["t_range"]), 2)
        found = self.measure("shell", "--to", "block")
        self.assertEqual((found["meet"], found["distance"], found["bound"]), (True, 0, 0))
        self.assertEqual(set(found["minima"][0]), {"distance", "at", "at_other"})
        text = self.run_program("measure", "scene.yaml", "tire", "--to", "rim")[0]
        self.assertIn("places beside are as near", text)
        self.assertIn("they meet", self.run_program("measure", "scene.yaml", "shell", "--to", "block")[0])

    def test_intersections(self):
        found = self.measure("rim", "--intersect", "chord")
        self.assert_near([one["point"] for one in found["points"]], [[math.sqrt(3), 1, 0], [-math.sqrt(3), 1, 0]], 1e-14)
        self.assertFalse(any(one["contact"] for one in found["points"]))
        found = self.measure("rim", "--intersect", "tangent")
        self.assertEqual([one["contact"] for one in found["points"]], [True])
        for words in ("pole", "shell"), ("shell", "pole"):
            found = self.measure(words[0], "--intersect", words[1])
            self.assert_near([one["point"] for one in found["points"]], [[0, 0.6, 0.8]], 1e-14)
        found = self.measure("rim", "--intersect", "rim")
        self.assertEqual(found["points"], [])
        self.assert_near(found["common"][0]["t"], [0, 2 * math.pi], 1e-12)
        text = self.run_program("measure", "scene.yaml", "rim", "--intersect", "tangent")[0]
        self.assertIn("contact", text)

    def test_self_intersections(self):
        scene = """
lekalo: 1
geometry:
  eight: { type: formula_curve, point: [sin(t), sin(2*t), 0], domain: [0, 2*pi], closed: true }
  cubic: { type: formula_curve, point: [t^2, t^3, 0], domain: [-1, 2] }
  twice: { type: formula_curve, point: [cos(t), sin(t), 0], domain: [0, 4*pi] }
  umbrella: { type: formula_surface, point: [u*v, u, v^2], domain: { u: [-1.2, 1.2], v: [-1.2, 1.2] } }
  ball: { type: sphere_surface, radius: 2 }
  block: { type: box, size: [2, 2, 2] }
  double: { type: self_intersection_curve, of: umbrella }
  pipe: { type: cylinder_surface, frame: { origin: [1, 0, -2.6] }, radius: 1, height: 5.2 }
  viviani: { type: intersection_curve, of: [ball, pipe] }
"""
        self.write("self.yaml", scene)
        self.assert_near(self.json_of("measure", "self.yaml", "double")["length"], 1.44, 1e-12)
        self.write("none.yaml", scene + "  none: { type: self_intersection_curve, of: ball }\n")
        self.assertIn("the surface does not meet itself", self.run_program("measure", "none.yaml", "ball", code=SCENE_ERROR)[1])

        def found(name):
            return self.json_of("measure", "self.yaml", name, "--self-intersection")

        self.assertEqual([one["kind"] for one in found("eight")["points"]], ["crossing"])
        self.assert_near(found("eight")["points"][0]["t_other"], math.pi, 1e-14)
        self.assertEqual([one["kind"] for one in found("cubic")["points"]], ["cusp"])
        self.assert_near(found("twice")["common"][0]["t_other"], [2 * math.pi, 4 * math.pi], 1e-12)
        self.assertEqual([one["kind"] for one in found("viviani")["points"]], ["crossing"])
        self.assert_near(found("viviani")["points"][0]["point"], [2, 0, 0], 1e-12)
        umbrella = found("umbrella")
        self.assert_near(umbrella["branches"][0]["length"], 1.44, 1e-12)
        self.assertEqual([one["kind"] for one in umbrella["points"]], ["end"])
        self.assertEqual(found("ball")["branches"], [])
        self.assertIn("'umbrella' with itself: 1 branch", self.run_program("measure", "self.yaml", "umbrella", "--self-intersection")[0])
        self.assertIn("cusp", self.run_program("measure", "self.yaml", "cubic", "--self-intersection")[0])

    def test_common_points(self):
        self.write("three.yaml", """
lekalo: 1
geometry:
  a: { type: sphere_surface, center: [1, 0, 0], radius: 2 }
  b: { type: sphere_surface, center: [-1, 0, 0], radius: 2 }
  level: { type: plane, origin: [0, 0, 1] }
  slab: { type: box, corner: [-4, -4, 1], size: [8, 8, 4] }
  rim: { type: circle, radius: 2 }
""")
        for third in "level", "slab":
            found = self.json_of("measure", "three.yaml", "a", "--intersect", "b", "--intersect", third)
            self.assertTrue(found["complete"])
            self.assert_near(sorted([one["point"] for one in found["points"]], key=lambda p: p[1]),
                             [[0, -math.sqrt(2), 1], [0, math.sqrt(2), 1]], 1e-14)
        text = self.run_program("measure", "three.yaml", "level", "--intersect", "b", "--intersect", "a")[0]
        self.assertIn("'level', 'b' and 'a': 2 common points", text)
        for words, message in ((("rim", "--intersect", "a", "--intersect", "b"), "'rim' is neither a surface nor a body"),
                               (("a", "--intersect", "b", "--intersect", "level", "--intersect", "slab"), "--intersect stands once, or twice")):
            self.assertIn(message, self.run_program("measure", "three.yaml", *words, code=USAGE)[1])
        self.assertIn("'block' is a body", self.run_program("measure", "scene.yaml", "block", "--self-intersection", code=USAGE)[1])

    def test_surfaces_that_touch_and_coincide(self):
        self.write("touch.yaml", """lekalo: 1
geometry:
  near: { type: plane, domain: { u: [-1, 1], v: [-1, 1] } }
  far: { type: plane, domain: { u: [0.2, 3], v: [-0.5, 0.7] } }
  tube: { type: cylinder_surface, center: [0, 0, -2], radius: 1, height: 4 }
  ball: { type: sphere_surface, radius: 1 }
objects: [{ shape: ball }]
outputs: [touch.png]
""")
        common = self.json_of("measure", "touch.yaml", "near", "--intersect", "far")
        self.assertTrue(common["coincident"] and common["complete"])
        self.assertEqual([(b["kind"], b["closed"]) for b in common["branches"]], [("border", True)])
        self.assertAlmostEqual(common["branches"][0]["length"], 4, 12)
        self.assertEqual(common["method"], "search")
        contact = self.json_of("measure", "touch.yaml", "tube", "--intersect", "ball")
        self.assertFalse(contact["coincident"])
        self.assertEqual(contact["method"], "closed form")
        self.assertEqual([b["kind"] for b in contact["branches"]], ["touching"])
        self.assertAlmostEqual(contact["branches"][0]["length"], 2 * math.pi, 12)
        self.assertIn("closed touching", self.run_program("measure", "touch.yaml", "tube", "--intersect", "ball")[0])
        self.assertIn("they coincide in part", self.run_program("measure", "touch.yaml", "near", "--intersect", "far")[0])

    def test_position(self):
        for words, where, distance in ((("shell", "0,0,3"), "above", 2), (("shell", "0,0,0.5"), "below", 0.5),
                                       (("floor", "3,4,-2"), "below", 2), (("block", "0.5,1,0.25"), "inside", 0.25),
                                       (("block", "2,1,1"), "outside", 1), (("block", "1,1,1"), "on", 0),
                                       (("ring", "2,0,0.25"), "inside", 0.25), (("ring", "apex"), "outside", math.hypot(1, 4) - 0.5),
                                       (("disc", "1,0"), "inside", 1), (("disc", "3,0"), "outside", 1)):
            found = self.measure(words[0], "--position", words[1])
            self.assertEqual(found["position"], where, words)
            self.assert_near(found["distance"], distance, 1e-13)
        self.assertEqual(self.measure("inside", "--position", "5,6,0")["position"], "inside")
        self.assertEqual(self.measure("inside", "--position", "5,6,2")["position"], "outside")
        self.assertTrue(self.measure("block", "--position", "-1,-1,-1")["by_lines"])
        self.assert_near(self.measure("shell", "--position", "0,0,0.5")["height"], -0.5, 1e-14)
        text = self.run_program("measure", "scene.yaml", "block", "--position", "0.5,1,0.25")[0]
        self.assertIn("0.5,1,0.25 is inside body 'block'", text)

    def test_continuity(self):
        """A box has right angles, two half spheres are one, a line meets the arc of a circle with a jump 1/2."""
        joints = self.measure("block", "--continuity")["joints"]
        self.assertEqual(len(joints), 12)
        for joint in joints:
            self.assertEqual(joint["order"], 0)
            self.assert_near(joint["angle"]["largest"], math.pi / 2, 1e-14)
        joints = self.measure("shell", "--continuity", "south")["joints"]
        self.assertEqual([joint["order"] for joint in joints], [3])
        self.assertEqual((joints[0]["edge"]["v"], joints[0]["edge_other"]["v"]), (0, 0))
        found = self.measure("chord", "--continuity", "bend")
        self.assertEqual((found["joints"][0]["end"], found["joints"][0]["end_other"]), ("last", "first"))
        self.assertEqual(found["joints"][0]["order"], 1)
        self.assert_near(found["joints"][0]["curvature"]["largest"], 0.5, 1e-14)
        self.assertEqual(self.measure("chord", "--continuity", "bend", "--tolerance", 1)["joints"][0]["order"], 3)
        text = self.run_program("measure", "scene.yaml", "chord", "--continuity", "bend")[0]
        self.assertIn("G1: last end with first end", text)
        joints = self.measure("rim", "--continuity")["joints"]
        self.assertEqual([joint["order"] for joint in joints], [3] * 4)
        self.assertIn("G3: t 0", self.run_program("measure", "scene.yaml", "rim", "--continuity")[0])

    def test_questions_without_an_answer(self):
        for words, message in ((("tile", "--to", "0,0,0"), "'tile' is no curve"),
                               (("rim", "--to", "tile"), "'tile' is no point"),
                               (("rim", "--nearest"), "--nearest belongs to --to"),
                               (("chord", "--position", "0,0,0"), "the curve is not closed"),
                               (("disc", "--position", "0,0,1"), "the body is not closed"),
                               (("block", "--position", "0,1"), "'block' is no body of one face"),
                               (("tire", "--continuity"), "'tire' is neither a curve nor a body"),
                               (("rim", "--continuity", "chord"), "a closed curve has no ends"),
                               (("rim", "--continuity", "tire"), "do not join"),
                               (("rim", "--to", "apexx"), "apex"), (("tire", "--to", "1,2"), "--to"), (("pole", "--to", "1,2"), "--to"),
                               (("rim", "--section", "0,0,0,0,0,1"), "neither a surface nor a body"),
                               (("tire", "--section", "0,0,0"), "--section"),
                               (("tire", "--section", "0,0,0,0,0,0"), "normal of the plane"),
                               (("rim", "--tolerance", 1), "--tolerance belongs to")):
            self.assertIn(message, self.run_program("measure", "scene.yaml", *words, code=USAGE)[1])

    def test_curves_that_surfaces_make(self):
        """Parallels of a torus, its outline seen from above, and two of its circles in a body."""
        found = self.measure("tire", "--section", "0,0,0,0,0,1", "--samples", "5")
        self.assertTrue(found["complete"] and all(one["closed"] for one in found["branches"]))
        lengths = sorted(one["length"] for one in found["branches"])
        again = sorted(one["length"] for one in self.measure("tire", "--silhouette", "0,0,1")["branches"])
        self.assert_near(lengths, again, 1e-12)
        for one in found["branches"]:
            self.assertEqual(len(one["samples"]), 5)
            for row in one["samples"]:
                self.assert_near(row["point"][2], 0, 1e-14)
        found = self.measure("block", "--section", "0.1,0,0,1,0,0")
        self.assertEqual([len(one["parts"]) for one in found["branches"]], [4])
        self.assertIn("closed", self.run_program("measure", "scene.yaml", "tire", "--section", "0,0,0,0,0,1")[0])

    def test_against_a_table(self):
        angles = [0.1 * k for k in range(63)]
        rows = [[t, 2 * math.cos(t), 2 * math.sin(t), 0.0] for t in angles]
        table = lambda: "t,x,y,z\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows)
        self.write("rim.csv", table())
        compared = self.measure("rim", "--against", "rim.csv", "--tolerance", "1e-14")
        self.assertTrue(compared["passed"])
        self.assertEqual(compared["samples"], 63)
        self.assertLessEqual(compared["maximum_ulps"], 4)
        rows[40][2] += 1e-6
        self.write("rim.csv", table())
        compared = self.json_of("measure", "scene.yaml", "rim", "--against", "rim.csv", "--tolerance", "1e-9",
                                code=DIFFERS)
        self.assertEqual(compared["worst"][0]["line"], 42)
        self.assert_near(compared["maximum_distance"], 1e-6, 1e-12)
        self.assert_near(compared["maximum_ulps"], 1e-6 / math.ulp(2.0), 1e-3 / math.ulp(2.0) * 1e-6)
        self.run_program("measure", "scene.yaml", "rim", "--against", "rim.csv")
        self.assertIn("u, v, x, y, z",
                      self.run_program("measure", "scene.yaml", "tire", "--against", "rim.csv", code=USAGE)[1])

    def test_evaluate(self):
        point = self.json_of("evaluate", "scene.yaml", "rim", "--at", "90 deg", "--order", "2")
        self.assert_near(point["point"], [0, 2, 0], 1e-15)
        self.assert_near(point["derivatives"], [[-2, 0, 0], [0, -2, 0]], 1e-15)
        self.assert_near(point["curvature"], 0.5, 1e-15)
        torus = self.json_of("evaluate", "scene.yaml", "tire", "--at", "0,0")
        self.assert_near(torus["point"], [2.5, 0, 0], 1e-15)
        self.assert_near(torus["gaussian_curvature"], 1 / (0.5 * 2.5), 1e-14)
        self.assert_near(sorted(map(abs, torus["principal_curvatures"])), [0.4, 2], 1e-14)
        self.assertIn("z_max", str(self.json_of("measure", "scene.yaml", "block", "--topology")))
        face = self.json_of("evaluate", "scene.yaml", "block", "--face", "z_max", "--at", "0.25,0.5")
        self.assertEqual(face["point"], [0.25, 0.5, 3])
        self.assertIn("--face 0 to 5", self.run_program("evaluate", "scene.yaml", "block", "--at", "0,0", code=USAGE)[1])

    def test_trace_through_the_ball(self):
        traced = self.json_of("trace", "scene.yaml", "--ray", "0,0,10,0,0,-2")
        hits = traced["hits"]
        self.assertEqual([hit["object"] for hit in hits], ["ball", "ball"])
        self.assert_near([hit["t"] for hit in hits], [2.75, 4.25], 1e-14)
        self.assert_near([hit["normal"] for hit in hits], [[0, 0, 1], [0, 0, -1]], 1e-14)
        aside = 0.3
        hit = self.json_of("trace", "scene.yaml", "--ray", f"{aside},0,10,0,0,-1")["hits"][0]
        self.assert_near(hit["t"], 7 - math.sqrt(1.5**2 - aside**2), 1e-14)

    def test_trace_names_objects_and_faces(self):
        hits = self.json_of("trace", "scene.yaml", "--ray", "10.5,0.5,10,0,0,-1")["hits"]
        self.assertEqual([(hit["object"], hit["face_name"], hit["t"]) for hit in hits],
                         [("brick", "z_max", 7), ("brick", "z_min", 10)])

    def test_trace_in_order_from_the_origin_on(self):
        """A line in the torus' plane meets it at the distances 1.5 and 2.5 on both sides of the axis."""
        hits = self.json_of("trace", "scene.yaml", "--ray", "-5,0,-10,1,0,0")["hits"]
        self.assert_near([hit["t"] for hit in hits], [2.5, 3.5, 6.5, 7.5], 1e-12)
        hits = self.json_of("trace", "scene.yaml", "--ray", "0,0,-10,1,0,0")["hits"]
        self.assert_near([hit["t"] for hit in hits], [1.5, 2.5], 1e-12)

    def test_trace_of_a_table_then_evaluate(self):
        self.write("rays.csv", "# down on the patch\n" +
                   "".join(f"{20.1 + 0.2 * k} {0.3 + 0.15 * k} 5 0.01 -0.02 -1\n" for k in range(9)))
        rays = self.json_of("trace", "scene.yaml", "--rays", "rays.csv")["rays"]
        self.assertEqual([len(ray["hits"]) for ray in rays], [1] * 9)
        for ray in rays[::4]:
            hit = ray["hits"][0]
            on_line = [o + hit["t"] * d for o, d in zip(ray["origin"], ray["direction"])]
            self.assert_near(hit["point"], on_line, 1e-12)
            at = f"{hit['u']!r},{hit['v']!r}"
            self.assert_near(self.json_of("evaluate", "scene.yaml", "patch", "--at", at)["point"], hit["point"], 1e-12)

    def test_trace_without_rays(self):
        self.assertIn("--ray", self.run_program("trace", "scene.yaml", code=USAGE)[1])
        self.assertIn("zero", self.run_program("trace", "scene.yaml", "--ray", "0,0,0,0,0,0", code=USAGE)[1])
        self.write("rays.csv", "0,0,1\n")
        self.assertIn("six numbers", self.run_program("trace", "scene.yaml", "--rays", "rays.csv", code=USAGE)[1])


if __name__ == "__main__":
    unittest.main()
