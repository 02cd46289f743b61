"""Pictures, maps, indices, substances and luminaires that are wrong: named, located, survived."""

import math
import shutil
import struct
import unittest
import zlib

from program import ROOT, SCENE_ERROR, ProgramTest

SCENE = """lekalo: 1
geometry: {{ floor: {{ type: plane, size: [4, 4] }}, ball: {{ type: ball, center: [0, 0, 1], radius: 1 }} }}
objects: [{{ shape: floor, material: matt }}, {{ shape: ball, material: it }}]
camera: {{ type: perspective, from: [1, -5, 2], at: [0, 0, 0.5] }}
image: {{ size: [24, 16], samples: 4 }}
integrator: {{ type: path }}
lights: {{ lamp: {light} }}
materials:
  matt: {{ type: diffuse }}
  it: {material}
"""
SUN = "{ type: distant_light, direction: [1, 1, -1] }"
MATT = "{ type: diffuse }"


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(width, height, bits, rows, colors=2):
    """A picture of rows of numbers: RGB, with `colors` 6 RGBA."""
    kind = ">%dH" if bits == 16 else ">%dB"
    raw = b"".join(b"\0" + struct.pack(kind % len(row), *row) for row in rows)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, bits, colors, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


class OpticsInput(ProgramTest):
    def render(self, light=SUN, material=MATT, code=0):
        self.write("scene.yaml", SCENE.format(light=light, material=material))
        return self.run_program("render", "scene.yaml", "-o", "picture.exr", "--quiet", code=code)[1]

    def complaint(self, **parts):
        """What is said, with the place in the file; nothing is written."""
        (self.folder / "picture.exr").unlink(missing_ok=True)
        said = self.render(code=SCENE_ERROR, **parts)
        self.assertRegex(said, r"scene.yaml:\d+:\d+: ")
        self.assertFalse((self.folder / "picture.exr").exists())
        return said

    def assert_finite(self):
        values = self.json_of("compare", "picture.exr", "picture.exr")
        self.assertEqual(values["non_finite"]["a"], 0)

    def test_pictures_that_are_none(self):
        picture = (ROOT / "scenes/data/letters.png").read_bytes()
        (self.folder / "cut.png").write_bytes(picture[:200])
        self.write("words.png", "not a picture")
        (self.folder / "empty.png").write_bytes(b"")
        for name, words in (("cut.png", "incomplete"), ("words.png", "check that it is a picture"), ("empty.png", "empty.png: cannot read"),
                            ("nowhere.png", "there is no file 'nowhere.png'")):
            with self.subTest(name):
                picture = f"{{ type: image, file: {name} }}"
                said = self.complaint(material=f"{{ type: diffuse, color: {picture}, roughness_texture: {picture}, opacity: "
                                      f"{picture}, bump: {{ texture: {picture} }}, normal_map: {{ texture: {picture} }} }}")
                self.assertEqual(said.count(words), 5, said)

    def test_texture_that_is_no_texture(self):
        said = self.complaint(material="{ type: diffuse, bump: { texture: matt } }")
        self.assertIn("matt", said)
        self.assertIn("missing field 'texture'", self.complaint(material="{ type: diffuse, bump: { height: 1 } }"))
        self.assertIn("one of 'range' and 'stops'", self.complaint(material="{ type: diffuse, color: { type: ramp } }"))
        self.assertIn("rising order", self.complaint(
            material="{ type: diffuse, color: { type: ramp, stops: [{ at: 1, color: red }, { at: 0, color: blue }] } }"))

    def test_deep_pictures(self):
        """16 bits a number: the same light as of 8 bits."""
        colors = [[255, 0, 0, 0, 255, 0], [0, 0, 255, 128, 128, 128]]
        for bits, factor in (8, 1), (16, 257):
            (self.folder / f"{bits}.png").write_bytes(png(2, 2, bits, [[factor * x for x in row] for row in colors]))
            self.render(material=f"{{ type: diffuse, color: {{ type: image, file: {bits}.png, interpolation: nearest }} }}")
            shutil.move(self.folder / "picture.exr", self.folder / f"{bits}.exr")
        self.run_program("compare", "8.exr", "16.exr", "--metric", "max", "--threshold", "1e-5")

    def test_impossible_indices(self):
        for index in "0", "-1.5", ".nan", "1e400", "glass":
            with self.subTest(index):
                self.complaint(material=f"{{ type: dielectric, index: {index} }}")
        for index in "1", "1e-6", "1e6":  # possible, if odd
            with self.subTest(index):
                self.render(material=f"{{ type: dielectric, index: {index} }}")
                self.assert_finite()

    def test_substances_that_are_never_left(self):
        """A sheet is no body; and a lamp within glass, and milk all round the viewer."""
        for material in ("{ type: dielectric, absorption: 0.3 }", "{ type: dielectric, scattering: 2 }",
                         "{ type: dielectric, index: 1, scattering: 50, absorption: 0.01 }"):
            for light in SUN, "{ type: point_light, position: [0, 0, 1] }":
                with self.subTest(material, light=light):
                    self.render(light=light, material=material)
                    self.assert_finite()
        text = (self.folder / "scene.yaml").read_text()
        self.write("scene.yaml", text.replace("material: matt }", "material: it }").replace("radius: 1", "radius: 40"))
        self.run_program("render", "scene.yaml", "-o", "picture.exr", "--quiet")
        self.assert_finite()
        self.assertIn("no substance that could scatter",
                      self.complaint(material="{ type: dielectric, thin: true, scattering: 1 }"))

    def test_numbers_that_are_none(self):
        """A pixel of a texture or panorama that is not a number is named before anything is rendered."""
        self.render()
        for value, word in (math.nan, "nan"), (math.inf, "inf"):
            (self.folder / "bad.pfm").write_bytes(b"PF\n2 2\n-1\n" + struct.pack("<12f", *[0.5] * 7, value, *[0.5] * 4))
            with self.subTest(word):
                said = self.complaint(material="{ type: diffuse, color: { type: image, file: bad.pfm } }")
                self.assertIn("no finite number", said)

    def test_luminaires(self):
        whole = (ROOT / "scenes/data/downlight.ies").read_text()
        for length in 40, 120, 200, 225:
            with self.subTest(length):
                self.write("cut.ies", whole[:length])
                said = self.complaint(light="{ type: profile_light, file: cut.ies, frame: { origin: [0, 0, 4], z: -z } }")
                self.assertIn("cut.ies", said)
        self.complaint(light="{ type: profile_light, file: nowhere.ies }")
        self.complaint(light="{ type: environment_light, file: nowhere.exr }")

    def test_daylight(self):
        self.assertIn("below the horizon", self.complaint(light="{ type: sky_light, sun: [1, 0, -0.2] }"))
        self.complaint(light="{ type: sun_light, sun: [1, 0, 1], turbidity: 20 }")

    def test_films(self):
        for film, words in (("{ thickness: 0 }", "greater than 0"), ("{ thickness: 300, to: 600 }", "'to' and 'texture'"),
                            ("{ thickness: 600, to: 300, texture: { type: noise } }", "smaller one first")):
            with self.subTest(film):
                self.assertIn(words, self.complaint(material=f"{{ type: conductor, metal: Fe, film: {film} }}"))
        self.assertIn("metal below it", self.complaint(material="{ type: conductor, color: 0.8, film: { thickness: 300 } }"))

    def test_dispersion_and_depth(self):
        self.assertIn("its own dispersion", self.complaint(material="{ type: dielectric, glass: N-BK7, abbe: 30 }"))
        self.complaint(material="{ type: dielectric, abbe: 0 }")
        self.assertIn("without a depth", self.complaint(material="{ type: principled, transmission_weight: 1, transmission_scatter: 1 }"))

    def test_holes_in_clear_bodies(self):
        said = self.complaint(material="{ type: dielectric, opacity: 0.5 }")
        self.assertIn("clear body has no opacity", said)
        self.assertIn("thin: true", said)
        self.render(material="{ type: dielectric, opacity: 0.5, thin: true }")


if __name__ == "__main__":
    unittest.main()
