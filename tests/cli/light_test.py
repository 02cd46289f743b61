"""Light by paths: the same picture for any number of threads, and what is wrong with lights and materials is said."""

import unittest

from exr import read_exr
from program import ProgramTest

SCENE = """lekalo: 1
geometry: {{ ball: {{ type: ball, center: [0, 0, 1], radius: 1 }}, floor: {{ type: plane, size: [6, 6] }} }}
materials:
  red: {{ type: plastic, color: [0.7, 0.1, 0.1] }}
  glass: {{ type: dielectric, glass: N-BK7 }}
  other: {other}
lights: {{ lamp: {light} }}
integrator: {{ type: {integrator} }}
objects: [{{ shape: ball, material: glass }}, {{ shape: floor, material: red }}]
camera: {{ type: perspective, from: [0, -6, 3], at: [0, 0, 0.9], field_of_view: 30 }}
image: {{ size: [48, 32], samples: 4 }}
outputs: picture.exr
"""
BALL = "{ type: sphere_light, center: [2, -2, 4], radius: 0.5 }"
MATT = "{ type: diffuse }"


class Light(ProgramTest):
    def scene(self, light=BALL, integrator="path", other=MATT):
        return self.write("scene.yaml", SCENE.format(light=light, integrator=integrator, other=other))

    def complaint(self, **parts):
        self.scene(**parts)
        return self.run_program("check", "scene.yaml", code=3)[1]

    def test_same_bits_for_any_number_of_threads(self):
        for integrator in ("path", "direct_lighting", "ambient_occlusion"):
            with self.subTest(integrator):
                self.scene(integrator=integrator)
                for threads in (1, 3):
                    self.run_program("render", "scene.yaml", "--threads", str(threads), "-o", f"{threads}.exr", "--quiet")
                self.assertEqual(self.bytes_of("1.exr"), self.bytes_of("3.exr"))

    def test_light_that_is_left_out_is_named(self):
        point = "{ type: point_light, position: [0, 0, 5] }"
        self.scene(light=point, integrator="path, photons: 0")
        self.assertIn("is left out", self.run_program("render", "scene.yaml")[1])
        self.scene(light=point)
        self.assertNotIn("is left out", self.run_program("render", "scene.yaml")[1])
        for light in BALL, "{ type: sphere_light, center: [0, 0, 0], radius: 9 }":  # this one all about the scene
            self.scene(light=light)
            self.assertNotIn("is left out", self.run_program("render", "scene.yaml")[1])

    def test_open_surroundings_of_a_coarse_ball_are_white(self):
        """As the same facets are that glow."""
        scene = """lekalo: 1
geometry: {{ ball: {{ type: ball, radius: 1 }} }}
materials: {{ it: {{ type: {1} }} }}
integrator: {{ type: {0} }}
objects: [{{ shape: ball, material: it, representation: mesh, mesh: {{ sag: 0.1 }} }}]
camera: {{ type: perspective, from: [0, -6, 3], at: [0, 0, 0], field_of_view: 25 }}
image: {{ size: [96, 96], samples: 4, background: white }}
"""
        for integrator, material in ("ambient_occlusion", "diffuse"), ("classic", "emission, color: white"):
            self.write("scene.yaml", scene.format(integrator, material))
            self.run_program("render", "scene.yaml", "-o", f"{integrator}.exr", "--quiet")
        worst = self.json_of("compare", "ambient_occlusion.exr", "classic.exr", "--metric", "max", "--threshold", "9")
        self.assertEqual(worst["value"], 0)

    def test_panoramas(self):
        self.scene(light="{ type: environment_light, file: studio/environments/studio.exr }")
        self.run_program("render", "scene.yaml", "--quiet")
        self.assertIn("nowhere.exr", self.complaint(light="{ type: environment_light, file: nowhere.exr }"))
        self.write("words.exr", "not a picture")
        self.assertIn("words.exr", self.complaint(light="{ type: environment_light, file: words.exr }"))

    def test_ies_files(self):
        lamp = "{ type: profile_light, frame: { origin: [0, 0, 4], z: -z }, file: lamp.ies }"
        self.write("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100 0\n")
        self.scene(light=lamp)
        self.run_program("render", "scene.yaml", "--quiet")
        self.write("lamp.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 50\n0 90\n0\n100\n")
        self.assertIn("the file ends after", self.complaint(light=lamp))

    def test_studios(self):
        """Each set-up of the studio lights a scene in both integrators: neither black nor burnt out."""
        for studio in "softbox", "technical", "outdoor":
            for integrator in "classic", "path":
                with self.subTest(studio, integrator=integrator):
                    self.write("scene.yaml", f"""lekalo: 1
include: studio/{studio}.yaml
geometry: {{ block: {{ type: box, size: [1, 1, 1], center: [0, 0, 0.5] }} }}
objects: [{{ shape: block, material: {{ type: diffuse, color: 0.5 }} }}]
integrator: {{ type: {integrator} }}
camera: {{ type: perspective, from: [2, -5, 4], at: [0, 0, 0.5], field_of_view: 5 }}
image: {{ size: [8, 8], samples: 16, background: black }}
""")
                    self.write("grey.yaml", (self.folder / "scene.yaml").read_text().replace("diffuse, color: 0.5", "emission, color: 0.4"))
                    for name in "scene", "grey":
                        self.run_program("render", f"{name}.yaml", "-o", f"{name}.exr", "--quiet")
                    self.run_program("compare", "scene.exr", "grey.exr", "--metric", "max", "--threshold", "0.37")
        for integrator in "classic", "path":  # paper: nothing where no shadow lies
            with self.subTest("paper", integrator=integrator):
                self.write("scene.yaml", f"""lekalo: 1
include: [studio/softbox.yaml, studio/paper.yaml]
integrator: {{ type: {integrator} }}
camera: {{ type: perspective, from: [2, -5, 4], at: [0, 0, 0], field_of_view: 25 }}
image: {{ size: [8, 8], samples: 4, background: [0.3, 0.5, 0.7] }}
""")
                self.write("bare.yaml", (self.folder / "scene.yaml").read_text().replace(", studio/paper.yaml", ""))
                for name in "scene", "bare":
                    self.run_program("render", f"{name}.yaml", "-o", f"{name}.exr", "--layers", "color", "--quiet")
                self.run_program("compare", "scene.exr", "bare.exr", "--metric", "max", "--threshold", "1e-5")

    def test_materials(self):
        self.assertIn("one of 'metal' and 'color'", self.complaint(other="{ type: conductor }"))
        self.assertIn("one of 'metal' and 'color'", self.complaint(other="{ type: conductor, metal: Cu, color: 0.5 }"))
        self.assertIn("more light than falls", self.complaint(other="{ type: translucent_sheet, color: 0.8, transmission: 0.5 }"))
        self.assertIn("a substance behind them", self.complaint(other="{ type: mix, first: glass, second: { type: dielectric } }"))
        self.assertIn("roughness", self.complaint(other="{ type: plastic, roughness: 2 }"))
        self.assertIn("anisotropy", self.complaint(other="{ type: conductor, metal: Cu, anisotropy: 1 }"))

    def test_shares_of_a_mix_that_are_none(self):
        """A texture of 3 is all of the second, and takes no light from the first."""
        for share in 1, 3:
            self.scene(other=MATT)
            red = "{ type: mix, first: { type: diffuse, color: 0.9 }, second: { type: diffuse, color: [0.2, 0.2, 0.8] }, " \
                  f"share: {{ type: checker, color: {share}, background: {share} }} }}"
            scene = (self.folder / "scene.yaml").read_text()
            self.write("scene.yaml", scene.replace("{ type: plastic, color: [0.7, 0.1, 0.1] }", red))
            self.run_program("render", "scene.yaml", "-o", f"{share}.exr", "--quiet")
        self.run_program("compare", "1.exr", "3.exr", "--metric", "max", "--threshold", "1e-6")

    def mean(self, name, layer="G"):
        plane = read_exr(self.bytes_of(name))[1][layer]
        return sum(plane) / len(plane)

    def test_milk_is_the_same_with_photons(self):
        """They do not scatter, and bring nothing of the light that milk lets through."""
        for photons in 0, 20000:
            self.write("scene.yaml", f"""lekalo: 1
geometry: {{ floor: {{ type: plane, size: [6, 6] }}, b: {{ type: ball, radius: 1, center: [0, 0, 1.2] }} }}
objects:
  - {{ shape: floor, material: {{ type: diffuse, color: 0.5 }} }}
  - {{ shape: b, material: {{ type: dielectric, index: 1.5, scattering: 8 }} }}
lights: {{ l: {{ type: sphere_light, radius: 1.5, center: [0, -3, 6], intensity: 40, decay: inverse_square }} }}
camera: {{ type: perspective, from: [0, -8, 5], at: [0, 0, 0.7], field_of_view: 40 }}
integrator: {{ type: path, photons: {photons} }}
image: {{ size: [24, 16], samples: 256, background: black, layers: [color, transmission] }}
""")
            self.run_program("render", "scene.yaml", "-o", f"{photons}.exr", "--quiet")
        for layer in "transmission.G", "G":
            found, expected = self.mean("20000.exr", layer), self.mean("0.exr", layer)
            self.assert_near(found, expected, 0.1 * expected)

    def test_light_that_does_not_fall_off_passes_panes(self):
        """The same behind panes of all sizes, but for what their faces throw back."""
        for side in 0, 2, 8, 60:
            pane = f"[{{ shape: {{ type: box, size: [{side}, {side}, 0.01], center: [0, 0, 4] }}, material: {{ type: dielectric }} }}]"
            self.write("scene.yaml", f"""lekalo: 1
geometry: {{ floor: {{ type: plane, size: [1, 1] }} }}
objects:
  - {{ shape: floor, material: {{ type: diffuse, color: 0.5 }} }}
{"  - " + pane[1:-1] if side else ""}
lights: {{ l: {{ type: point_light, position: [0, 0, 5] }} }}
camera: {{ type: parallel, from: [0, 0, 2], at: [0, 0, 0], up: y, height: 0.8 }}
integrator: {{ type: path, photons: 100000 }}
image: {{ size: [8, 8], samples: 4, background: black, layers: [color] }}
""")
            self.run_program("render", "scene.yaml", "-o", f"{side}.exr", "--quiet")
        expected = self.mean("0.exr") * (1 - 0.04) / (1 + 0.04)
        for side in 2, 8, 60:
            self.assert_near(self.mean(f"{side}.exr"), expected, 0.1 * expected)

    def test_balls_that_do_not_fall_off_pass_panes(self):
        """Of each face's reflectance R a share of (1 - R) / (1 + R) passes, whatever the ball's size; 1.5 % come back."""
        for radius in 0.5, 3, 5, 8:  # from 5 on the ball reaches into that around the pane
            self.write("scene.yaml", f"""lekalo: 1
geometry:
  floor: {{ type: plane, size: [80, 80] }}
  pane: {{ type: box, size: [20, 20, 0.1], center: [0, 0, 0.5] }}
objects:
  - {{ shape: floor, material: {{ type: diffuse, color: 0.1 }} }}
  - {{ shape: pane, material: {{ type: dielectric }}, visible_to: [shadow, reflection] }}
lights: {{ l: {{ type: sphere_light, center: [0, 0, 20], radius: {radius} }} }}
camera: {{ type: parallel, from: [0, 0, 2], at: [0, 0, 0], up: y, height: 4 }}
integrator: {{ type: path, photons: 1000000 }}
image: {{ size: [4, 4], samples: 16, background: black, layers: [color] }}
""")
            self.run_program("render", "scene.yaml", "-o", "ball.exr", "--quiet")
            self.assert_near(self.mean("ball.exr"), 1.015 * 0.1 * (1 - 0.04) / (1 + 0.04), 0.004)

    def floor_below(self, thing, light, integrator):
        """Radiance at the middle of a floor of albedo 0.8."""
        self.write("scene.yaml", f"""lekalo: 1
geometry: {{ floor: {{ type: plane, size: [4, 4] }}, sheet: {{ type: plane, size: [20, 20], origin: [0, 0, 0.3] }},
             ball: {{ type: ball, radius: 1, center: [0, 0, 1.2] }} }}
objects: [{{ shape: floor, material: {{ type: diffuse, color: 0.8 }} }}, {thing}]
lights: {{ l: {{ {light} }} }}
camera: {{ type: parallel, from: [0, 0, 0.1], at: [0, 0, 0], up: y, height: 0.2 }}
integrator: {{ {integrator} }}
image: {{ size: [4, 4], samples: 256, background: black, layers: [color] }}
""")
        self.run_program("render", "scene.yaml", "-o", "floor.exr", "--quiet")
        return self.mean("floor.exr")

    def test_light_comes_straight_through_whoever_counts_bounces(self):
        lights = "type: ambient_light", "type: rectangle_light, frame: { origin: [0, 0, 2], z: -z }, size: [4, 4]"
        for light in lights:
            open_sky = self.floor_below("{ shape: ball, visible_to: [camera] }", light, "type: direct_lighting")
            for integrator in "type: direct_lighting", "type: path, bounces: 0":
                for more in "opacity: 0.5", "opacity: 0":
                    thing = f"{{ shape: sheet, material: {{ type: diffuse, color: 0, {more} }} }}"
                    share = 0.5 if more == "opacity: 0.5" else 1
                    self.assert_near(self.floor_below(thing, light, integrator), share * open_sky, 0.01 * open_sky)

    def test_shadows_are_of_what_shadow_rays_see(self):
        """Of lamps that are found by directions too: as dark as with all rays, and no darker than with none."""
        for light in "type: sky_light, sun: [1, -1, 2], intensity: 0.3", "type: sphere_light, center: [0, 0, 6], radius: 3":
            for integrator in "type: path", "type: direct_lighting":
                found = {seen: self.floor_below(
                    f"{{ shape: ball, material: {{ type: diffuse, color: 0 }}, visible_to: [{seen}] }}", light, integrator)
                    for seen in ("shadow", "reflection", "shadow, reflection", "camera")}
                free = found["camera"]
                self.assert_near(found["shadow"], found["shadow, reflection"], 0.01 * free)
                self.assert_near(found["reflection"], free, 0.01 * free)
                self.assertLess(found["shadow"], 0.6 * free)

    def white_seen_on(self, material, integrator, camera="from: [0, 0, 2], at: [0, 0, 0], up: y"):
        """A sheet in a white world."""
        self.write("scene.yaml", f"""lekalo: 1
geometry: {{ a: {{ type: plane, size: [4, 4] }}, dark: {{ type: plane, size: [90, 90], origin: [0, 0, -2] }} }}
objects:
  - {{ shape: a, material: {{ {material} }} }}
  - {{ shape: dark, material: {{ type: diffuse, color: 0 }} }}
lights: {{}}
camera: {{ type: parallel, {camera}, height: 1 }}
integrator: {{ {integrator} }}
image: {{ size: [4, 4], samples: 1024, contrast: 0, background: white, layers: [color] }}
""")
        self.run_program("render", "scene.yaml", "-o", "white.exr", "--quiet")
        return [self.mean("white.exr", layer) for layer in "RGB"]

    def test_metals_look_as_their_spectra_do(self):
        for metal in "Au", "Cu", "CuZn", "Ag", "Fe":
            sheet = f"type: conductor, metal: {metal}, roughness: 0"
            spectral = self.white_seen_on(sheet, "type: path, background_light: true, spectral: true")
            seen = self.white_seen_on(sheet, "type: path, background_light: true")
            for one, other in zip(seen, spectral):
                self.assert_near(one, min(1, other), 0.01)

    def test_classic_panes_mirror_by_both_faces(self):
        """At 60 degrees 2 F / (1 + F) of white, F = 0.0892."""
        slanted = "from: [0, -3.4641016, 2], at: [0, 0, 0]"
        for integrator in "type: classic", "type: path, background_light: true":
            found = self.white_seen_on("type: dielectric, thin: true", integrator, slanted)
            self.assert_near(found[0], 2 * 0.0892 / 1.0892, 0.01)

    def test_many_clear_balls_over_an_endless_floor(self):
        """More than have photons of their own."""
        balls = "".join(f"  - {{ shape: b, material: g, transform: [{{ translate: [{i % 9 - 4}, {i // 9 - 4}, 0] }}] }}\n"
                        for i in range(81))
        for photons in 0, 50000:
            self.write("scene.yaml", f"""lekalo: 1
geometry: {{ floor: {{ type: plane }}, b: {{ type: ball, radius: 0.3, center: [0, 0, 0.5] }} }}
materials: {{ g: {{ type: dielectric, index: 1.5 }} }}
lights: {{ l: {{ type: distant_light, direction: [0.3, 0, -1] }} }}
camera: {{ type: perspective, from: [0, -8, 5], at: [0, 0, 0], field_of_view: 40 }}
integrator: {{ type: path, photons: {photons} }}
image: {{ size: [24, 16], samples: 16, background: black, layers: [color] }}
objects:
  - {{ shape: floor, material: {{ type: diffuse, color: 0.5 }} }}
{balls}""")
            self.run_program("render", "scene.yaml", "-o", f"{photons}.exr", "--quiet")
        self.assertGreater(self.mean("50000.exr"), 1.1 * self.mean("0.exr"))

    def test_mirrors_found_in_a_texture(self):
        """The caustic of a wall that is a mirror but in its middle."""
        for photons in 0, 20000:
            self.write("scene.yaml", f"""lekalo: 1
geometry: {{ floor: {{ type: plane, size: [6, 6] }}, wall: {{ type: plane, size: [6, 6], frame: {{ origin: [3, 0, 3], z: -x }} }} }}
materials:
  dark: {{ type: diffuse, color: 0 }}
  silver: {{ type: conductor, metal: Ag, roughness: 0 }}
  wall: {{ type: mix, first: dark, second: silver, share: {{ type: checker, spacing: 2.5, offset: -1.25, color: 0, background: 1 }} }}
lights: {{ l: {{ type: distant_light, direction: [1, 0, -1] }} }}
camera: {{ type: parallel, from: [0, 0, 2], at: [0, 0, 0], up: y, height: 4 }}
integrator: {{ type: path, photons: {photons} }}
image: {{ size: [8, 8], samples: 16, background: black, layers: [color] }}
objects: [{{ shape: floor, material: {{ type: diffuse, color: 0.5 }} }}, {{ shape: wall, material: wall }}]
""")
            self.run_program("render", "scene.yaml", "-o", f"{photons}.exr", "--quiet")
        self.assertGreater(self.mean("20000.exr"), 1.2 * self.mean("0.exr"))

    def test_endless_mirrors_send_no_photons(self):
        """It is said, and not where the mirror has a size."""
        for plane, told in (("origin: [0, 0, 0]", True), ("origin: [0, 0, 0], size: [9, 9]", False)):
            self.write("scene.yaml", f"lekalo: 1\ngeometry: {{ f: {{ type: plane, {plane} }}, b: {{ type: ball, radius: 1, center: [0, 0, 1] }} }}\n"
                       "objects: [{ shape: f, name: sea, material: { type: conductor, metal: Ag, roughness: 0 } }, { shape: b }]\n"
                       "camera: { type: perspective, from: [4, -7, 4], at: [0, 0, 0] }\nintegrator: { type: path, photons: 1000 }\n"
                       "image: { size: [16, 12], samples: 1 }\n")
            _, errors = self.run_program("render", "scene.yaml", "-o", "x.png")
            self.assertEqual("no photons are sent, as 'sea'" in errors, told, errors)


if __name__ == "__main__":
    unittest.main()
