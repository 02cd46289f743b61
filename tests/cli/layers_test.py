"""Layers of OpenEXR files for compositing, read back by a decoder of our own: parts of light, groups, Cryptomatte."""

import json
import struct
import unittest

from exr import read_exr
from program import ProgramTest

SCENE = """lekalo: 1
geometry: {{ ball: {{ type: ball, center: [0, 0, 1], radius: 1 }}, floor: {{ type: plane, size: [6, 6] }} }}
materials:
  red: {{ type: plastic, color: [0.7, 0.1, 0.1], roughness: 0.2 }}
  glass: {{ type: dielectric, glass: N-BK7 }}
lights:
  lamp: {{ type: sphere_light, center: [2, -2, 4], radius: 0.5, group: {group} }}
  sky: {{ type: ambient_light, intensity: 0.2 }}
integrator: {{ type: {integrator} }}
objects: [{{ shape: ball, name: pearl, material: glass }}, {{ shape: floor, name: ground, material: red }}]
camera: {{ type: perspective, from: [0, -6, 3], at: [0, 0, 0.9], field_of_view: 30 }}
image: {{ size: [48, 32], samples: 16, {image} }}
outputs: picture.exr
"""


class Layers(ProgramTest):
    def scene(self, image, group="key", integrator="path"):
        self.write("scene.yaml", SCENE.format(image=image, group=group, integrator=integrator))

    def render(self, image, **parts):
        self.scene(image, **parts)
        self.run_program("render", "scene.yaml", "--quiet")
        return read_exr(self.bytes_of("picture.exr"))

    def test_parts_add_up(self):
        _, planes = self.render("layers: [color, direct, indirect, emission, diffuse, specular, transmission, "
                                "light_groups, variance]")
        for lane in "RGB":
            for parts in (["emission", "direct", "indirect"], ["emission", "diffuse", "specular", "transmission"],
                          ["group.rest", "group.key"]):
                for i, color in enumerate(planes[lane]):
                    self.assert_near(sum(planes[f"{part}.{lane}"][i] for part in parts), color, 1e-5 * (1 + color))
        self.assertGreater(max(planes["transmission.R"]), 0.01)
        self.assertGreater(max(planes["variance.R"]), 0)

    def test_highlights_of_coats_are_specular(self):
        """Of a black body under a rough coat all that comes back is."""
        self.scene("layers: [color, diffuse, specular]")
        scene = (self.folder / "scene.yaml").read_text()
        self.write("scene.yaml", scene.replace("[0.7, 0.1, 0.1]", "0").replace("material: glass", "material: red"))
        self.run_program("render", "scene.yaml", "--quiet")
        _, planes = read_exr(self.bytes_of("picture.exr"))
        self.assertEqual(max(planes["diffuse.G"]), 0)
        self.assertGreater(max(planes["specular.G"]), 0.01)

    def test_cryptomatte_is_read_back(self):
        """The matte of each name in the manifest, as the specification decodes it, against the layer of numbers."""
        image = "layers: [id, samples, cryptomatte_object, cryptomatte_material], filter: box"
        attributes, planes = self.render(image)
        for layer, names in ("CryptoObject", {"pearl", "ground"}), ("CryptoMaterial", {"glass", "red"}):
            key = next(n[:-4] for n, (_, v) in attributes.items() if n.startswith("cryptomatte/") and
                       n.endswith("/name") and v.decode() == layer)
            self.assertEqual(attributes[key + "hash"][1], b"MurmurHash3_32")
            self.assertEqual(attributes[key + "conversion"][1], b"uint32_to_float32")
            manifest = json.loads(attributes[key + "manifest"][1])
            self.assertEqual(set(manifest), names)
            mattes = {}
            for name, number in manifest.items():
                bits = struct.unpack("<f", struct.pack("<I", int(number, 16)))[0]
                mattes[name] = [sum(planes[f"{layer}{rank // 2:02}.{'GA'[rank % 2]}"][i]
                                    for rank in range(6)
                                    if planes[f"{layer}{rank // 2:02}.{'RB'[rank % 2]}"][i] == bits)
                                for i in range(48 * 32)]
            for i in range(48 * 32):
                self.assertLessEqual(sum(matte[i] for matte in mattes.values()), 1 + 1e-6)
            if layer == "CryptoObject":  # the pixel's middle lies in what covers most of it, nearly always
                agree = sum((mattes["pearl"][i] > 0.5) == (planes["id.object"][i] == 1) for i in range(48 * 32))
                self.assertGreater(agree, 48 * 32 - 20)
                self.assert_near(sum(mattes["pearl"]), planes["id.object"].count(1), 15)

    def test_cryptomatte_of_names_in_another_encoding(self):
        (self.folder / "old.obj").write_bytes(b"o W\xfcrfel\nv -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.write("scene.yaml", "lekalo: 1\nobjects: [{ shape: { type: model, file: old.obj } }]\nintegrator: { type: path }\n"
                   "image: { size: [8, 8], samples: 1, layers: [color, cryptomatte_object] }\n")
        self.run_program("render", "scene.yaml", "-o", "old.exr", "--quiet")
        attributes, _ = read_exr(self.bytes_of("old.exr"))
        manifest = next(v for n, (_, v) in attributes.items() if n.endswith("/manifest"))
        self.assertIn("W\ufffdrfel", json.loads(manifest))

    def test_noise_target(self):
        _, planes = self.render("noise: 0.02, layers: [color, samples]")
        self.assertEqual(set(planes["samples"]), {16})
        self.write("scene.yaml", SCENE.format(image="noise: 0.02", group="key", integrator="path"))
        for threads in 1, 3:
            self.run_program("render", "scene.yaml", "--samples", "300", "--threads", threads, "-o", f"{threads}.exr",
                             "--quiet")
        self.assertEqual(self.bytes_of("1.exr"), self.bytes_of("3.exr"))
        counts = set(read_exr(self.bytes_of("1.exr"))[1]["samples"])
        self.assertLessEqual(counts, {16, 32, 64, 128, 256, 300})
        self.assertGreater(len(counts), 1)

    def test_what_cannot_be_is_said(self):
        self.scene("layers: [color, diffuse]", integrator="classic")
        self.assertIn("'diffuse' is that of an integrator that follows paths",
                      self.run_program("render", "scene.yaml", code=3)[1])
        self.assertIn("'diffuse' is that of an integrator that follows paths",
                      self.run_program("check", "scene.yaml", code=3)[1])
        self.scene("layers: [color, denoised]")
        self.assertRegex(self.run_program("check", "scene.yaml", code=3)[1], r"scene.yaml:\d+:\d+: .*'denoised' is made of")
        self.scene("noise: 0.02", group="'a b'")
        self.assertIn("group", self.run_program("check", "scene.yaml", code=3)[1])


if __name__ == "__main__":
    unittest.main()
