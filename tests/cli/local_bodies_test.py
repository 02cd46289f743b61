"""Bodies changed in places: faces that would run into each other are refused, names mean what is outside, moved bodies are recognised."""

import math
import unittest

from program import ProgramTest

SQUARE = ("{ type: extrusion_body, along: z, of: [{ type: rectangle, size: [4, 4] }, { type: polyline, closed: true, points: "
          "[[1, -1], [1, 1], [-1, 1], [-1, -1]] }] }")
PLATE = ("{ type: extrusion_body, along: z, of: [{ type: rectangle, size: [6, 4] }, { type: circle, radius: 0.4, center: [-1, 0] }, "
         "{ type: circle, radius: 0.8, center: [1, 0] }] }")
MERIDIAN = "{ type: polyline, points: [[0, 0, 0], [4, 0, 0], [4, 0, 4], [1, 0, 4], [1, 0, 1], [0, 0, 1]] }"
TRAY = "{ type: shell_body, of: block, thickness: 0.5, open: z_max }"
BLOCK = "  block: { type: box, size: [4, 4, 2] }\n"


class LocalBodies(ProgramTest):
    def scene(self, body, more=BLOCK):
        self.write("local.yaml", f"lekalo: 1\ngeometry:\n{more}  b: {{ {body} }}\n")

    def volume(self, body, more=BLOCK):
        self.scene(body, more)
        return self.json_of("measure", "local.yaml", "b")["volume"]

    def refused(self, body, *texts, more=BLOCK, code=3):
        self.scene(body, more)
        errors = self.run_program("measure", "local.yaml", "b", code=code)[1]
        for text in texts:
            self.assertIn(text, errors)

    def test_walls_through_holes(self):
        self.refused(f"type: moved_faces, of: {SQUARE}, faces: side.3, distance: -1.2", "the loops of a face do not cross", "move them by less")
        for by, condition in (0.9, "the faces side.4 and side.5 run into each other"), (2.1, "no inner loop lies within another"):
            self.refused(f"type: moved_faces, of: {PLATE}, faces: side.4, by: {{ translate: [{by}, 0, 0] }}", condition)

    def test_counters_in_names_of_faces(self):
        """%i stands for the counter of a family, or of the map in a list, wherever faces and edges are named."""
        holes = ("  block: { type: box, size: [6, 4, 1] }\n"
                 "  h: { repeat: { k: 1..2 }, type: cylinder_body, center: [3*k - 1.5, 2, -1], radius: 0.5, height: 3 }\n"
                 "  d: { type: difference, of: block, minus: h }\n")
        filleted = "type: fillet_body, of: d, fillets: "
        both = "{ repeat: { i: 0..1 }, edges: { between: [block.z_max, 'h.%i.side'] }, radius: 0.1*(i+1) }"
        each = ", ".join(f"{{ edges: {{ between: [block.z_max, h.{i}.side] }}, radius: {0.1*(i+1)} }}" for i in (0, 1))
        self.assert_near(self.volume(filleted + both, holes), self.volume(f"{filleted}[{each}]", holes), 1e-9)
        self.volume("type: union, of: m", holes + "  m: { repeat: { i: 0..1 }, type: deleted_faces, of: d, faces: ['h.%i.side'] }\n")
        self.refused("type: deleted_faces, of: d, faces: ['h.%q.side']", "'q'", more=holes)

    def test_faces_that_are_no_neighbours(self):
        turned = f"{{ type: revolution_body, of: {MERIDIAN}, axis: z }}"
        self.refused(f"type: offset_body, of: {turned}, distance: -0.6", "run into each other", "up to 0.499 works")
        self.refused("type: moved_faces, of: { type: shell_body, of: block, thickness: 0.5 }, faces: inner.block.x_max, distance: -2", "run into each other")
        self.refused(f"type: moved_faces, of: {TRAY}, faces: block.z_min, distance: -0.8", "block.z_min and inner.block.x_min run into each other")
        self.refused(f"type: chamfer_body, of: {TRAY}, chamfers: {{ edges: {{ between: [block.z_min, block.x_min] }}, lengths: 1.5 }}",
                     "chamfers.0 run into each other", "the largest length that fits is 0.99999")

    def test_dents_through_the_body(self):
        dent = "type: deformed_face, of: { type: box, size: [3, 3, 2] }, face: z_max, count: 5, moves: { at: [2, 2], height: %s }"
        self.assertGreater(self.volume(dent % -4), 0)
        self.refused(dent % -12, "the faces z_min and z_max run into each other", "moves by less")

    def test_walls_that_fall_apart(self):
        self.scene("type: shell_body, of: { type: extrusion_body, along: z, of: [{ type: rectangle, size: [4, 4] }, { type: circle, radius: 0.5 }] }, "
                   "thickness: 0.2, open: [start, end]")
        found = self.json_of("measure", "local.yaml", "b", "--topology")
        self.assertEqual((found["violations"], found["shells"]), ([], 2))
        self.assert_near(self.json_of("measure", "local.yaml", "b")["volume"], 16 - 3.6**2 + math.pi * (0.7**2 - 0.5**2), 1e-9)
        self.refused("type: shell_body, of: { type: shell_body, of: block, thickness: 0.5, open: [x_min, x_max, y_min, y_max] }, thickness: 0.1",
                     "hollow already")

    def test_short_names_mean_what_is_outside(self):
        hollow = "{ type: shell_body, of: block, thickness: 0.5 }"
        self.assert_near(self.volume(f"type: moved_faces, of: {hollow}, faces: x_min, distance: 0.5"), 4.5 * 8 - 3 * 3 * 1, 1e-9)
        self.assert_near(self.volume(f"type: moved_faces, of: {hollow}, faces: inner.block.x_min, distance: 0.2"), 32 - 2.8 * 3 * 1, 1e-9)

    def test_chamfers_that_say_too_much(self):
        one = "type: chamfer_body, of: block, chamfers: { edges: { between: [z_max, x_max] }, lengths: [0.3, 0.2], %s }"
        self.refused(one % "angle: 30", "lengths leave no choice of the angle")
        self.refused(one % "face: x_min", "the face 'x_min' lies beside none of the edges")
        self.assert_near(self.volume(one % "face: x_max"), 32 - 0.5 * 0.3 * 0.2 * 4, 1e-9)

    def test_fillets_at_their_limits(self):
        """Closed forms of what is built; what is refused names the edge and the largest radius."""
        spandrel = 1 - math.pi / 4
        block = "  block: { type: box, size: [4, 4, 3] }\n"
        one = "type: fillet_body, of: block, fillets: { edges: { between: [z_max, y_min] }, radius: %s }"
        two = "type: fillet_body, of: block, fillets: { edges: { of_face: z_max, parallel: x }, radius: %s }"
        # What is left of a face is 0.01 wide; a radius that takes all of it.
        self.assert_near(self.volume(two % 1.995, block), 48 - 2 * spandrel * 1.995**2 * 4, 1e-9)
        self.refused(two % 2, "between block.y_max and block.z_max: nothing is left of", "the largest radius that fits is 1.9999", more=block)
        # A fillet beside a fillet, up to where they touch.
        first = block + f"  first: {{ {one % 2} }}\n"
        beside = "type: fillet_body, of: first, fillets: { edges: { between: [block.z_max, block.y_max] }, radius: %s }"
        self.assert_near(self.volume(beside % 1.99, first), 48 - spandrel * (4 + 1.99**2) * 4, 1e-9)
        self.refused(beside % 2, "nothing is left of edge", "the largest radius that fits is 1.9999", more=first)
        # Its border runs along an edge: the foot of a step as wide as the radius.
        step = ("  block: { type: extrusion_body, along: [0, 0, 2], of: { type: polyline, closed: true, "
                "points: [[0, 0], [3, 0], [3, 1], [1, 1], [1, 2], [0, 2]] } }\n")
        foot = "type: fillet_body, of: block, fillets: { edges: { between: [side.2, side.3] }, radius: %s }"
        self.assert_near(self.volume(foot % 0.99, step), 8 + spandrel * 0.99**2 * 2, 1e-9)
        self.refused(foot % 1, "between block.side.2 and block.side.3: nothing is left of edge", "the largest radius that fits is 0.99999", more=step)
        # Its border touches the rim of a hole, crosses it, and has the hole beyond it.
        plate = "  block: { type: difference, of: { type: box, size: [4, 4, 1] }, minus: { type: cylinder_body, radius: 0.5, height: 3, center: [3.2, 2, -1] } }\n"
        side = "type: fillet_body, of: block, fillets: { edges: { between: [z_max, x_max] }, radius: %s }"
        self.assert_near(self.volume(side % 0.299, plate), 16 - math.pi / 4 - spandrel * 0.299**2 * 4, 1e-9)
        for radius in 0.3, 0.5, 0.95:
            self.refused(side % radius, "x_max and", "z_max", "the largest radius that fits is 0.29999", more=plate)

    def test_fillets_between_nearly_tangent_faces(self):
        """Between faces that turn by 2 a the spandrel is r^2 (tan a - a)."""
        for rise in 0.1, 0.01, 1e-3, 1e-5:
            roof = ("  block: { type: extrusion_body, along: z, of: { type: polyline, closed: true, "
                    f"points: [[0, 0], [2, 0], [2, 1], [1, {1 + rise!r}], [0, 1]] }} }}\n")
            ridge = "{ edges: { between: [side.2, side.3] }, %s: 0.5 }"
            self.assert_near(self.volume(f"type: fillet_body, of: block, fillets: {ridge % 'radius'}", roof), 2 + rise - 0.25 * (rise - math.atan(rise)), 1e-12)
            angle = 2 * math.atan(rise)
            self.assert_near(self.volume(f"type: chamfer_body, of: block, chamfers: {ridge % 'lengths'}", roof), 2 + rise - 0.125 * math.sin(angle), 1e-12)
        self.refused(f"type: fillet_body, of: block, fillets: {ridge % 'radius'}", "no sharp edge is between 'side.2' and 'side.3'", more=roof.replace("1.00001", "1.0000001"))

    def test_rims_of_lofts(self):
        """Of circles: as of a cone. Of squares: the corners of the rim are mitred, and all edges have balls in the corners."""
        both = ("  loft: { type: loft_body, of: [{ type: circle, radius: 1 }, { type: circle, radius: 0.6, center: [0, 0, 1] }] }\n"
                "  cone: { type: cone_body, radius: 1, top_radius: 0.6, height: 1 }\n")
        for end in "start", "end":
            loft, cone = (self.volume(f"type: fillet_body, of: {of}, fillets: {{ edges: {{ of_face: {end} }}, radius: 0.2 }}", both) for of in ("loft", "cone"))
            self.assert_near(loft, cone, 1e-12)
        square = ("  loft: { type: loft_body, of: [{ type: rectangle, size: [2, 2] }, { type: rectangle, size: [2, 2], center: [0, 0, 1] }] }\n")
        spandrel, third = (1 - math.pi / 4) * 0.04, (5 / 3 - math.pi / 2) * 0.008
        self.assert_near(self.volume("type: fillet_body, of: loft, fillets: { edges: { of_face: end }, radius: 0.2 }", square), 4 - 8 * spandrel + 4 * third, 1e-12)
        # Twisted sides, which have no law.
        bent = ("  loft: { type: loft_body, of: [{ type: polyline, closed: true, points: [[0, 0, 0], [3, 0, 0], [0, 2, 0]] }, { type: polyline, closed: true, "
                "points: [[0.2, 0.1, 1], [2.5, 0.4, 1], [0.3, 1.5, 1]] }, { type: polyline, closed: true, points: [[0, 0, 2], [3, 0, 2], [0, 2, 2]] }] }\n")
        sharp = self.volume("like: loft", bent)
        for edges in "{ of_face: end }", "{ between: [side, side] }", "{}":
            self.assertLess(self.volume(f"type: fillet_body, of: loft, fillets: {{ edges: {edges}, radius: 0.05 }}", bent), sharp)

    def test_balls_near_to_edges_of_boxes(self):
        """A contour begins anywhere; where that is near to an edge that moves past it the vertex makes way. Inward by 1 is a box and a ball of other sizes."""
        for center in ([10, 8, 0], [9, 8, 0], [6, 8, 2], [5.32, 8.79, 0.55]):
            def cut(size, radius, name):
                return (f"  {name}: {{ type: difference, of: {{ type: box, size: [{size}, {size}, {size}], center: [0, 0, 0] }}, "
                        f"minus: {{ type: ball, center: {center}, radius: {radius} }} }}\n")
            both = cut(20, 5, "outer") + cut(18, 6, "inner")
            outer, inner = self.volume("like: outer", both), self.volume("like: inner", both)
            self.assert_near(self.volume("type: offset_body, of: outer, distance: -1", both), inner, 1e-11)
            self.assert_near(self.volume("type: shell_body, of: outer, thickness: 1", both), outer - inner, 1e-10)

    def test_fillet_beside_a_hole(self):
        plate = ("{ type: extrusion_body, along: [0, 0, 2], of: [{ type: rectangle, size: [6, 4] }, { type: circle, radius: 0.2, center: [0, 1.5] }] }")
        self.refused(f"type: fillet_body, of: {plate}, fillets: {{ edges: {{ between: [side.2, end] }}, radius: 0.5 }}", "edge",
                     "there is no room", "the largest radius that fits is")

    def test_moved_bodies_are_recognised(self):
        rounded = ("  plain: { type: extrusion_body, along: z, of: { type: rectangle, size: [3, 2], corner_radius: 0.5 } }\n"
                   "  holed: { type: extrusion_body, along: z, of: [{ type: rectangle, size: [4, 4] }, { type: circle, radius: 1 }] }\n")
        for step in "{ mirror: x }", "{ scale: 2 }", "[{ rotate: 30, axis: y }, { mirror: [1, 2, 3] }, { scale: 0.5 }]":
            k = 2 if step == "{ scale: 2 }" else 0.5 if "0.5" in step else 1
            moved = f"{{ like: plain, transform: {step} }}"
            self.assert_near(self.volume(f"type: refilleted_body, of: {moved}, radius: {0.25 * k}", rounded), (6 - (4 - math.pi) * 0.0625) * k**3, 1e-9)
            self.assert_near(self.volume(f"type: moved_faces, of: {moved}, faces: side.0, distance: {0.5 * k}", rounded),
                             self.volume("type: moved_faces, of: plain, faces: side.0, distance: 0.5", rounded) * k**3, 1e-9)
        leant = "type: drafted_faces, of: %s, faces: side.4, angle: 5"
        for step, k in ("{ mirror: z }", 1), ("{ scale: 2 }", 2):
            there = self.volume(leant % f"{{ like: holed, transform: {step} }}", rounded)
            self.assertGreater(abs(there - (16 - math.pi) * k**3), 0.1)
            if k == 2:
                self.assert_near(there, self.volume(leant % "holed", rounded) * k**3, 1e-9)

    def test_no_faces(self):
        self.refused("type: deleted_faces, of: block, faces: []", "expected at least 1 value, found 0")


    def test_refilleted_bodies_are_as_filleted_ones(self):
        leant = ("  leant: { type: union, of: [block, { type: cylinder_body, radius: 0.6, height: 3, frame: { origin: [2, 2, 1.4], z: [0.3, 0, 1] } }] }\n")
        foot = "{ edges: { between: [side, z_max] }, radius: %s }"
        for of, fillets in (("block", "{ edges: { of_face: z_max }, radius: %s }"), ("block", "{ radius: %s }"), ("leant", foot)):
            made = "{ type: fillet_body, of: " + of + ", fillets: " + fillets + " }"
            more = BLOCK + leant + f"  rounded: {made % 0.3}\n"
            self.assert_near(self.volume("type: refilleted_body, of: rounded, radius: 0.2", more),
                             self.volume((made % 0.2)[2:-2], BLOCK + leant), 1e-10)
            self.assert_near(self.volume("type: deleted_faces, of: rounded, faces: fillets, chain: true", more),
                             self.volume(f"like: {of}", BLOCK + leant), 1e-10)

    def test_grooves_along_walls(self):
        groove = (BLOCK + "  h: { type: difference, of: block, minus: [{ type: cylinder_body, radius: 0.2, height: 3, "
                  "frame: { origin: [2, 0, -0.5] } }] }\n")
        def segment(r, d):  # of a circle, beyond a line at the distance d
            return r * r * math.acos(d / r) - d * math.sqrt(r * r - d * d)
        for body, radius, whole, height in (("type: offset_body, of: h, distance: 0.05", 0.15, 4.1 * 4.1 * 2.1, 2.1),
                                            ("type: moved_faces, of: h, faces: y_min, distance: 0.05", 0.2, 4 * 4.05 * 2, 2)):
            expected = whole - height * segment(radius, -0.05)
            self.assert_near(self.volume(body, groove), expected, 1e-9)
        self.refused("type: offset_body, of: h, distance: 0.15", "do not come together in a corner any more", more=groove)

    def test_balls_in_any_place(self):
        """Where the poles of a ball stand makes no difference to what becomes of its domes and dents."""
        dome_of, dent_of = "of: { type: union, of: [plate, ball] }", "of: { type: difference, of: plate, minus: ball }"
        cap = lambda r, h: math.pi * h * h * (r - h / 3)
        # Between the dome, 64 - z^2, and the rolled ball, (sqrt(96) - sqrt(4 - w^2))^2 with w = z - 2, up to z = 1.6.
        root = lambda w: 0.5 * w * math.sqrt(4 - w * w) + 2 * math.asin(w / 2)
        foot = math.pi * (1.6 * 36 - (2**3 - 0.4**3) / 3 - 2 * math.sqrt(96) * (root(-0.4) - root(-2)) + 1.6**3 / 3)
        for axis, size, center in ("x", "[10, 40, 40]", "[10, 20, 20]"), ("y", "[40, 10, 40]", "[20, 10, 20]"), ("z", "[40, 40, 10]", "[20, 20, 10]"):
            more = f"  plate: {{ type: box, size: {size} }}\n  ball: {{ type: ball, center: {center}, radius: 8 }}\n"
            for body, volume in ((f"shell_body, {dome_of}, thickness: 2, open: plate.{axis}_min", 16000 + cap(8, 8) - 36 * 36 * 8 - cap(6, 8)),
                                 (f"offset_body, {dent_of}, distance: 1", 12 * 42 * 42 - cap(7, 8)),
                                 (f"fillet_body, {dome_of}, fillets: {{ edges: {{ between: [plate.{axis}_max, ball.side] }}, radius: 2 }}",
                                  16000 + cap(8, 8) + foot)):
                self.assert_near(self.volume(f"type: {body}", more), volume, 1e-7)
            pipe = f"  ball: {{ type: ball, radius: 10 }}\n  pipe: {{ type: cylinder_body, axis: {axis}, radius: 4, height: 25 }}\n"
            self.assert_near(self.volume("type: shell_body, of: { type: union, of: [ball, pipe] }, thickness: 1, open: pipe.end", pipe), 1450.22714836991, 1e-7)

    def test_walls_of_mitred_fillets(self):
        """Fillets of one radius that meet in a mitre cross where their cylinders touch."""
        def rounded(a, b, height, r):  # about its top; at s below the fillets' axes the sides stand r - sqrt(r^2 - s^2) further in
            return a * b * height - 2 * (a + b) * r * r * (1 - math.pi / 4) + 4 * r**3 * (5 / 3 - math.pi / 2)
        more = ("  block: { type: box, size: [4, 3, 2] }\n"
                "  round: { type: fillet_body, of: block, corners: mitred, fillets: { radius: 0.5, edges: { of_face: z_max } } }\n")
        for wall in (0.05, 0.1):
            inner = rounded(4 - 2 * wall, 3 - 2 * wall, 2 - wall, 0.5 - wall)
            self.assert_near(self.volume(f"type: shell_body, of: round, thickness: {wall}, open: z_min", more), rounded(4, 3, 2, 0.5) - inner, 1e-10)

    def test_balls_on_edges(self):
        def corner(radius, d):  # of a ball: beyond d from its center along both of two axes, by heights
            total = 0
            for k in range(400):
                angle = math.pi * ((k + 0.5) / 400 - 0.5)
                r = radius * math.cos(angle)
                if r * r <= 2 * d * d:
                    continue
                under = lambda x: 0.5 * (x * math.sqrt(r * r - x * x) + r * r * math.asin(x / r))
                side = math.sqrt(r * r - d * d)
                total += (under(side) - under(d) - d * (side - d)) * r * math.pi / 400
            return total

        ball = lambda radius: 4 / 3 * math.pi * radius**3
        for center in ("[40, 40, 20]", "[20, 40, 40]", "[40, 20, 40]"):
            more = f"  block: {{ type: box, size: [40, 40, 40] }}\n  ball: {{ type: ball, center: {center}, radius: 8 }}\n"
            of = "of: { type: union, of: [block, ball] }"
            self.assert_near(self.volume(f"type: shell_body, {of}, thickness: 1", more), 40**3 + ball(8) * 3 / 4 - 38**3 - ball(7) + corner(7, 1), 1e-4)
        # The poles would stand on the seam of the cylinder.
        more = "  pipe: { type: cylinder_body, radius: 10, height: 40 }\n  ball: { type: ball, center: [10, 0, 20], radius: 5 }\n"
        one, two = (self.volume(f"type: {kind}, of: {of}", more) for kind, of in (("union", "[pipe, ball]"), ("intersection", "[pipe, ball]")))
        self.assert_near(one + two, math.pi * 4000 + ball(5), 1e-7)

    def test_walls_of_cylinders_that_meet(self):
        def tee(run, branch, height, reach):  # the strips of the branch beyond the run
            angles = [math.pi * (k + 0.5) / 400 for k in range(400)]
            beyond = sum((branch * math.sin(a)) ** 2 * (reach - math.sqrt(run**2 - (branch * math.cos(a)) ** 2)) for a in angles) * math.pi / 200
            return math.pi * run**2 * height + beyond

        for run, middle, along in ("z", "[0, 0, 20]", "x"), ("z", "[0, 0, 20]", "[0.8, 0.6, 0]"), ("x", "[20, 0, 0]", "z"):
            pair = (f"  run: {{ type: cylinder_body, axis: {{ through: [0, 0, 0], along: {run} }}, radius: 10, height: 40 }}\n"
                    f"  branch: {{ type: cylinder_body, axis: {{ through: {middle}, along: {along} }}, radius: 5, height: 25 }}\n")
            of = "of: { type: union, of: [run, branch] }"
            self.assert_near(self.volume(f"type: shell_body, {of}, thickness: 1, open: branch.end", pair), tee(10, 5, 40, 25) - tee(9, 4, 38, 25), 1e-8)
            self.assert_near(self.volume(f"type: offset_body, {of}, distance: 1", pair), tee(11, 6, 42, 26), 1e-8)

    def test_fillets_of_cylinders_that_meet(self):
        """The integral over the sections across the way of the ball's center, of radius 12 about one axis, 7 about the other."""
        for run, middle, along in ("z", "[0, 0, 20]", "x"), ("z", "[0, 0, 20]", "[0.8, 0.6, 0]"), ("x", "[20, 0, 0]", "z"):
            pair = (f"  run: {{ type: cylinder_body, axis: {{ through: [0, 0, 0], along: {run} }}, radius: 10, height: 40 }}\n"
                    f"  branch: {{ type: cylinder_body, axis: {{ through: {middle}, along: {along} }}, radius: 5, height: 25 }}\n")
            tee = "of: { type: union, of: [run, branch] }"
            sharp = self.volume("type: union, of: [run, branch]", pair)
            rounded = self.volume(f"type: fillet_body, {tee}, fillets: {{ edges: {{ between: [run.side, branch.side] }}, radius: 2 }}", pair)
            self.assert_near(rounded - sharp, 15.709225915274, 1e-8)

    def test_fillets_along_fillets(self):
        rounded = ("  base: { type: fillet_body, of: { type: extrusion_body, along: [0, 0, 2], of: { type: rectangle, size: [4, 4], "
                   "corner_radius: 0.8 } }, fillets: { edges: { of_face: end }, radius: 0.3 } }\n")
        whole = "type: deleted_faces, of: base, chain: true, faces: [fillets, side.1, side.3, side.5, side.7]"
        self.assert_near(self.volume(whole, rounded), 32, 1e-9)
        # What a round edge of the length 1 leaves off, and a ball in a corner.
        edge, ball = 0.04 * (1 - math.pi / 4), 0.008 * (1 - math.pi / 6)
        self.assert_near(self.volume("type: refilleted_body, of: base, radius: 0.2", rounded), 32 - 4 * (3.6 + 1.8) * edge - 4 * ball, 1e-8)
        self.assert_near(self.volume("type: offset_body, of: base, distance: -0.9", rounded), 2.2 * 2.2 * 0.2, 1e-9)

    def test_blends_without_room_are_named(self):
        wide = "{ edges: { between: [block.z_min, block.x_max] }, radius: 1.5 }"
        self.refused(f"type: fillet_body, of: {TRAY.replace('0.5', '0.3')}, fillets: [{{ edges: {{ between: [block.z_min, block.x_min] }}, "
                     f"radius: 0.05 }}, {wide}]", "between block.x_max and block.z_min: the faces inner.block.x_max and fillets.1 run into")

    def test_what_does_not_follow(self):
        more = BLOCK + "  rounded: { type: fillet_body, of: block, fillets: { edges: { of_face: z_max }, radius: 0.3 } }\n"
        self.refused("type: moved_faces, of: rounded, faces: block.x_max, distance: 0.1", "meets others in a corner, which does not follow", more=more)
        self.refused("type: drafted_faces, of: { type: cone_body, radius: 2, height: 3 }, faces: side, angle: 5", "runs to a point")


if __name__ == "__main__":
    unittest.main()
