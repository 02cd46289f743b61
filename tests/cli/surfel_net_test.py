"""Nets of oriented points: each point of the surface has one near it whose normal is near its own."""

import math
import random
import unittest

from program import ProgramTest

SCENE = """lekalo: 1
geometry:
  ball: {{ type: sphere_surface, radius: 2 }}
  ring: {{ type: torus_surface, major_radius: 2, minor_radius: 0.5 }}
  net: {{ type: surfel_net, of: {of}, epsilon: {epsilon}, gamma: {gamma}, size: 0.4 }}
objects: [{{ shape: net }}]
"""


def ball(a, b):
    n = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b))
    return [2 * x for x in n], n


def ring(a, b):
    n = (math.cos(a) * math.cos(b), math.sin(a) * math.cos(b), math.sin(b))
    return [2 * math.cos(a) + 0.5 * n[0], 2 * math.sin(a) + 0.5 * n[1], 0.5 * n[2]], n


class SurfelNets(ProgramTest):
    def surfels(self):
        """Middles of the hexagons and their normals, from the file that the net is exported to."""
        self.run_program("export", "scene.yaml", "net", "-o", "net.obj", "--quiet")
        points, normals = [], []
        for line in (self.folder / "net.obj").read_text().splitlines():
            words = line.split()
            if words[:1] == ["v"]:
                points.append([float(x) for x in words[1:]])
            elif words[:1] == ["vn"]:
                normals.append([float(x) for x in words[1:]])
        return points[::7], normals

    def test_nets(self):
        random.seed(5)
        for of, place, epsilon, gamma in (("ball", ball, 0.5, 60), ("ball", ball, 5, 12), ("ring", ring, 0.3, 20)):
            with self.subTest(of, epsilon=epsilon):
                self.write("scene.yaml", SCENE.format(of=of, epsilon=epsilon, gamma=gamma))
                points, normals = self.surfels()
                self.assertEqual(len(points), len(normals))
                for _ in range(300):
                    p, n = place(random.uniform(0, 2 * math.pi), random.uniform(-math.pi / 2, math.pi / 2))
                    self.assertTrue(any(math.dist(p, q) <= epsilon and sum(x * y for x, y in zip(n, m)) >= math.cos(math.radians(gamma))
                                        for q, m in zip(points, normals)), p)

    def test_what_is_refused(self):
        self.write("scene.yaml", SCENE.format(of="ball", epsilon=1e-4, gamma=60))
        self.assertIn("more than 1000000 points", self.run_program("check", "scene.yaml", code=3)[1])
        self.write("scene.yaml", SCENE.format(of="{ type: plane }", epsilon=1, gamma=60))
        self.assertIn("unbounded", self.run_program("check", "scene.yaml", code=3)[1])


if __name__ == "__main__":
    unittest.main()
