"""Subdivision surfaces by what is known of them: limits of a cube by Catmull's and Clark's rules by hand, cubic splines
along creases, meshes that stay what they are."""

import unittest

from program import ProgramTest, SCENE_ERROR

CUBE = ("type: subdivision_surface, points: [[-1, -1, -1], [1, -1, -1], [-1, 1, -1], [1, 1, -1], [-1, -1, 1], [1, -1, 1], "
        "[-1, 1, 1], [1, 1, 1]], faces: [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]")
RINGS = "[0, 1, 3, 2, 0], [4, 5, 7, 6, 4]"
SCENE = f"""lekalo: 1
geometry:
  cube: {{ {CUBE} }}
  sharp: {{ {CUBE}, creases: [{RINGS}, [0, 4], [1, 5], [2, 6], [3, 7]] }}
  drum: {{ {CUBE}, creases: [{RINGS}] }}
  coarse: {{ {CUBE}, levels: 3 }}
  roof: {{ type: subdivision_surface, points: [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 2]], faces: [[3, 2, 1, 0],
    [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]] }}
  sheet: {{ type: subdivision_surface, points: [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0], [2, 1, 0]], faces:
    [[0, 1, 4, 3], [1, 2, 5, 4]] }}
"""


class Subdivision(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.yaml", SCENE)

    def point(self, name, face, u, v):
        return self.json_of("evaluate", "scene.yaml", name, "--face", face, "--at", f"{u},{v}")["point"]

    def test_limits_of_a_cube(self):
        # The face's middle, its edge points and corners after one step are 1, 3/4 and 5/9: (16 + 4 * 4 * 3/4 + 4 * 5/9) / 36.
        self.assert_near(self.point("cube", 1, 0.5, 0.5), [0, 0, (16 + 12 + 20 / 9) / 36], 1e-14)
        self.assert_near(self.point("cube", 1, 0, 0), [-0.5, -0.5, 0.5], 1e-14)
        self.assert_near(self.point("coarse", 1, 0.5, 0.5), self.point("cube", 1, 0.5, 0.5), 1e-14)
        edge = self.point("cube", 1, 0.5, 0)
        self.assert_near([edge[0], edge[1] + edge[2]], [0, 0], 1e-14)

    def test_silhouettes(self):
        """The faces at -z and z are each other's images in the cube's middle; a line of patches on one is no crease."""
        found = [self.json_of("measure", "scene.yaml", f"cube.face.{face}", "--silhouette", "0.4532,-0.7849,0.4226") for face in (0, 1)]
        for one in found:
            self.assertEqual((len(one["branches"]), one["points"], one["complete"]), (1, [], True))
        self.assert_near(found[0]["branches"][0]["length"], found[1]["branches"][0]["length"], 1e-13)

    def test_creases(self):
        self.assert_near(self.point("drum", 1, 0, 0), [-2 / 3, -2 / 3, 1], 1e-14)
        self.assert_near(self.point("drum", 1, 0.3, 0.6)[2], 1, 1e-14)
        self.assert_near(self.json_of("measure", "scene.yaml", "sharp")["volume"], 8, 1e-9)

    def test_whole(self):
        for name, faces, edges in ("cube", 6, 12), ("sharp", 6, 12), ("roof", 16, 32):
            found = self.json_of("measure", "scene.yaml", name, "--topology")
            self.assertEqual((len(found["faces"]), len(found["edges"]), found["valid"]), (faces, edges, True))
        self.assert_near(self.json_of("measure", "scene.yaml", "sheet")["area"], 2, 1e-12)

    def test_loop_closes(self):
        tetrahedron = "scheme: loop, points: [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2]], faces: [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]"
        for levels, code in (12, 0), (20, SCENE_ERROR):
            self.write("loop.yaml", f"lekalo: 1\ngeometry: {{ s: {{ type: subdivision_surface, {tetrahedron}, levels: {levels} }} }}\n")
            output, errors = self.run_program("measure", "loop.yaml", "s", code=code)
            self.assertIn("too small to sew" if code else "volume", errors or output)

    def test_errors(self):
        for fields, message in [
            ("points: [[0, 0], [1, 0], [1, 1], [0, 1]], faces: [[0, 1, 2, 4]]", "face 0 names point 4; there are points 0 to 3"),
            ("points: [[0, 0], [1, 0], [1, 1], [0, 1]], faces: [[0, 1, 2], [0, 1, 3]]", "faces 0 and 1 both run from point 0 to 1"),
            ("points: [[0, 0], [1, 0], [1, 1], [0, 1]], faces: [[0, 1, 2, 3]], creases: [[0, 2]]", "no edge from point 0 to 2"),
        ]:
            self.write("bad.yaml", f"lekalo: 1\ngeometry: {{ s: {{ type: subdivision_surface, {fields} }} }}\n")
            _, errors = self.run_program("measure", "bad.yaml", "s", code=SCENE_ERROR)
            self.assertIn(message, errors)


if __name__ == "__main__":
    unittest.main()
