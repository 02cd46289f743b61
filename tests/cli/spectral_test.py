"""Spectral mode: grey scenes as in RGB, the same bits for any number of threads, lamps by spectrum, messages."""

import unittest

from exr import read_exr
from program import SCENE_ERROR, ProgramTest

SCENE = """lekalo: 1
geometry: {{ floor: {{ type: plane, size: [20, 20] }}, it: {{ type: ball, center: [0, 0, 1], radius: 1 }} }}
materials:
  grey: {{ type: diffuse, color: 0.6 }}
  it: {material}
lights:
  lamp: {{ type: {light}, {lamp} }}
  room: {{ type: ambient_light, intensity: 0.2 }}
camera: {{ type: perspective, from: [0, -6, 2.5], at: [0, 0, 0.8], field_of_view: 40 }}
image: {{ size: [40, 30], samples: 64 }}
integrator: {{ type: {integrator}, spectral: {spectral}{more} }}
objects: [{{ shape: floor, material: grey }}, {{ shape: it, material: it }}]
"""
BALL = "center: [2, -3, 4], radius: 0.5"


class Spectral(ProgramTest):
    def picture(self, name="picture.exr", options=(), code=0, **parts):
        given = {"material": "{ type: plastic, color: 0.3, roughness: 0.2 }", "light": "sphere_light", "lamp": BALL,
                 "integrator": "path", "spectral": "true", "more": ""} | parts
        self.write("scene.yaml", SCENE.format(**given))
        said = self.run_program("render", "scene.yaml", "-o", name, "--quiet", *options, code=code)[1]
        return said if code else (self.folder / name).read_bytes()

    def means(self, **parts):
        planes = read_exr(self.picture(**parts))[1]
        return [sum(planes[c]) / len(planes[c]) for c in "RGB"]

    def test_grey_scenes_are_those_of_rgb(self):
        for integrator in ("path", "direct_lighting"):
            for material in ("{ type: plastic, color: 0.3 }", "{ type: dielectric, index: 1.5 }", "{ type: cloth, color: 0.4 }",
                             "{ type: translucent_sheet, color: 0.4 }", "{ type: mix, first: grey, second: { type: plastic } }",
                             "{ type: diffuse, color: 0.5, opacity: 0.4 }", "{ type: classic, specular: 0.4, mirror: 0.2 }",
                             "{ type: principled, base_color: 0.5, coat_weight: 0.5 }", "{ type: shadow_catcher }"):
                with self.subTest(integrator=integrator, material=material):
                    spectral = self.means(integrator=integrator, material=material)
                    plain = self.means(integrator=integrator, material=material, spectral="false")
                    for a, b in zip(spectral, plain):
                        self.assertAlmostEqual(a, b, delta=0.015 * b)

    def test_the_same_bits_for_any_number_of_threads(self):
        parts = {"material": "{ type: dielectric, glass: N-SF11 }", "more": ", photons: 5000"}
        self.assertEqual(self.picture(options=("--threads", "1"), **parts), self.picture(options=("--threads", "3"), **parts))

    def test_lamps_of_a_spectrum_have_its_colour(self):
        for lamp, colors in (("spectrum: D65", (1, 1, 1)), ("spectrum: A", (1.845, 0.826, 0.233)),
                             ("temperature: 5000", (1.213, 0.961, 0.762))):
            with self.subTest(lamp=lamp):
                white = self.means(spectral="false", lamp=BALL + ", intensity: 1000")
                for spectral in ("false", "true"):
                    found = self.means(spectral=spectral, lamp=f"{BALL}, intensity: 1000, {lamp}")
                    for a, b, c in zip(found, white, colors):
                        self.assertAlmostEqual(a / b, c, delta=0.03)

    def test_spectra_inside_of_rec709_are_their_colours(self):
        """A glowing ball, the sun, and glass that parts colours: under grey surroundings as by the colour alone."""
        for parts in ({"material": "{ type: emission, temperature: 3200, strength: 2 }"},
                      {"material": "{ type: emission, spectrum: F7, strength: 2 }"},
                      {"light": "sun_light", "lamp": "sun: [1, -1, 1]"},
                      {"material": "{ type: dielectric, glass: N-SF11 }"}):
            with self.subTest(**parts):
                for a, b in zip(self.means(**parts), self.means(spectral="false", **parts)):
                    self.assertAlmostEqual(a, b, delta=0.02 * b)

    def test_what_is_wrong_is_said(self):
        for lamp, words in ((f"{BALL}, spectrum: D75", "D65"), (f"{BALL}, spectrum: A, temperature: 3000", "leave one out"),
                            (f"{BALL}, spectrum: A, color: [1, 0.5, 0.5]", "says of what colour"),
                            (f"{BALL}, temperature: 20", "temperature")):
            with self.subTest(lamp=lamp):
                said = self.picture(lamp=lamp, code=SCENE_ERROR)
                self.assertRegex(said, r"scene.yaml:\d+:\d+: ")
                self.assertIn(words, said)


if __name__ == "__main__":
    unittest.main()
