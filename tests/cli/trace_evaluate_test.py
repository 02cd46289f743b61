"""What trace finds, evaluate gives back: every type of surface, faces of bodies and patches, unmoved and moved."""

import random
import re
import unittest

from program import ProgramTest, ROOT

NET = "[[0, 0, 0], [0, 1, 1], [0, 2, 0], [0, 3, 1]], [[1, 0, 1], [1, 1, 3], [1, 2, 1], [1, 3, 0]], " \
      "[[2, 0, 0], [2, 1, 1], [2, 2, 2], [2, 3, 0]]"
SURFACES = {
    "plane": "size: [4, 4]",
    "sphere_surface": "radius: 1.5",
    "cylinder_surface": "radius: 1, height: 2",
    "cone_surface": "radius: 1.5, height: 2",
    "torus_surface": "major_radius: 1.5, minor_radius: 0.5",
    "ellipsoid": "semi_axes: [1, 1.5, 0.7]",
    "hyperboloid_one_sheet": "semi_axes: [1, 0.8, 1], heights: [-1, 1.5]",
    "hyperboloid_two_sheets": "semi_axes: [1, 0.8, 0.5], heights: [0.5, 2]",
    "elliptic_paraboloid": "semi_axes: [1, 0.8], heights: [0, 2]",
    "hyperbolic_paraboloid": "semi_axes: [1, 0.8], domain: { u: [-2, 2], v: [-2, 2] }",
    "extrusion_surface": "of: { type: circle, radius: 1 }, along: [0.3, 0.2, 2]",
    "revolution_surface": "of: { type: bezier_curve, points: [[1, 0, 0], [2, 0, 1], [0.5, 0, 2]] }, axis: z",
    "bezier_surface": f"points: [{NET}], weights: [[1, 2, 1, 1], [1, 0.5, 3, 1], [1, 1, 1, 1]]",
    "nurbs_surface": f"points: [{NET}], degree: 2",
    "formula_surface": "point: ['(2 + cos(v))*cos(u)', '(2 + cos(v))*sin(u)', sin(v) + 0.3*sin(3*u)], "
                       "domain: { u: [0, 2*pi], v: [0, 2*pi] }, closed: true",
    "ribbon": "of: { type: bezier_curve, points: [[-1, -1, -1], [1, -1, 0], [1, 1, 0.5], [-1, 1, 1]] }, width: 1.5",
}


class TraceThenEvaluate(ProgramTest):
    def check(self, names, shift, rays_each, scene, middle):
        """Rays through the neighbourhood of every shape; shape k stands `shift` * k along x."""
        random.seed(5)
        self.write("scene.yaml", scene)
        rays = []
        for k in range(len(names)):
            for _ in range(rays_each):
                through = [x + random.uniform(-0.7, 0.7) for x in middle]
                direction = [random.uniform(-1, 1) for _ in range(3)]
                origin = [x - 3 * d for x, d in zip(through, direction)]
                rays.append([origin[0] + shift * k, *origin[1:], *direction])
        self.write("rays.csv", "".join(",".join(map(repr, ray)) + "\n" for ray in rays))
        met = set()
        for ray in self.json_of("trace", "scene.yaml", "--rays", "rays.csv")["rays"]:
            for hit in ray["hits"][:2]:
                name = hit["object"]
                on_line = [o + hit["t"] * d for o, d in zip(ray["origin"], ray["direction"])]
                self.assert_near(hit["point"], on_line, 1e-12)
                there = self.json_of("evaluate", "scene.yaml", name, "--face", hit["face"], "--at",
                                     f"{hit['u']!r},{hit['v']!r}")["point"]
                self.assert_near([there[0] + shift * names.index(name), *there[1:]], hit["point"], 1e-12)
                met.add(name)
        self.assertEqual(met, set(names))

    def test_every_type_is_here(self):
        listed = (ROOT / "geometry/surfaces/all.cpp").read_text().split("namespace")[0]
        self.assertEqual(sorted(SURFACES), sorted(re.findall(r"X\((\w+)_type\)", listed)))

    def test_surfaces(self):
        names = ["of_" + name for name in SURFACES]
        geometry = "".join(f"  of_{name}: {{ type: {name}, {fields} }}\n" for name, fields in SURFACES.items())
        objects = "".join(f"  - {{ shape: {name}, transform: {{ translate: [{12 * k}, 0, 0] }} }}\n"
                          for k, name in enumerate(names))
        self.check(names, 12, 4, f"lekalo: 1\ngeometry:\n{geometry}objects:\n{objects}", [0.5, 0.5, 0.5])

    def test_faces_and_patches(self):
        teapot = ROOT / "scenes/data/newell_teapot.txt"
        self.check(["teapot"], 0, 6, f"lekalo: 1\ngeometry: {{ teapot: {{ type: patches, file: '{teapot}' }} }}\n",
                   [0, 0, 1.2])
        self.check(["sheet"], 0, 20, "lekalo: 1\ngeometry: { sheet: { type: trimmed_surface, of: { type: torus_surface, "
                   "major_radius: 1, minor_radius: 0.5 }, keep: outside, loops: [{ type: circle, radius: 0.7 }] } }\n",
                   [0, 0, 0])
        self.check(["wedge"], 0, 6, "lekalo: 1\ngeometry: { wedge: { type: wedge, size: [2, 3, 1], top: 1 } }\n",
                   [0.5, 1, 0.5])

    def test_curvatures_at_a_pole(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  dish: { type: formula_surface, coordinates: cylindrical, "
                   "point: [u, v, u^2], domain: { u: [0, 1], v: [0, 2*pi] } }\n"
                   "  cone: { type: formula_surface, coordinates: cylindrical, point: [u, v, u], "
                   "domain: { u: [0, 1], v: [0, 2*pi] } }\n")
        dish = self.json_of("evaluate", "scene.yaml", "dish", "--at", "0,0.4")
        self.assert_near(dish["gaussian_curvature"], 4, 1e-7)
        self.assert_near(dish["principal_curvatures"], [2, 2], 1e-7)
        self.assertRegex(self.run_program("evaluate", "scene.yaml", "cone", "--at", "0,0.4")[0],
                         r"gaussian_curvature +-\nmean_curvature +-\nprincipal_curvatures +-\n")


if __name__ == "__main__":
    unittest.main()
