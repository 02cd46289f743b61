"""Views of OpenColorIO configurations: the numbers of a PNG, a configuration's own names, messages."""

import pathlib
import struct
import unittest
import zlib

from program import SCENE_ERROR, ProgramTest

CONFIG = """ocio_profile_version: 2
roles: { scene_linear: Linear, default: Linear }
displays:
  screen:
    - !<View> { name: Gamma, colorspace: Gamma }
    - !<View> { name: Turned, colorspace: Turned }
    - !<View> { name: Lost, colorspace: Lost }
  paper:
    - !<View> { name: Flat, colorspace: Linear }
colorspaces:
  - !<ColorSpace> { name: Linear, isdata: false }
  - !<ColorSpace>
    name: Gamma
    from_scene_reference: !<ExponentTransform> { value: [2, 2, 2, 1], direction: inverse }
  - !<ColorSpace>
    name: Turned
    from_scene_reference: !<MatrixTransform> { matrix: [0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1] }
  - !<ColorSpace>
    name: Lost
    from_scene_reference: !<FileTransform> { src: nowhere.cube }
"""
SCENE = """lekalo: 1
geometry: {{ it: {{ type: plane, size: [2, 2] }} }}
materials: {{ it: {{ type: emission, color: [0.5, 0.25, 0.04] }} }}
camera: {{ type: parallel, from: [0, 0, 5], at: [0, 0, 0], up: [0, 1, 0], height: 1 }}
image: {{ size: [8, 8], samples: 1 }}
integrator: {{ type: path }}
objects: [{{ shape: it, material: it }}]
outputs:
  - picture.exr
  - {{ file: picture.png, exposure: {exposure}, ocio: {{ config: config.ocio{more} }}{beside} }}
"""
OF_BLENDER = pathlib.Path("/usr/share/blender/datafiles/colormanagement/config.ocio")


class ColorView(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("config.ocio", CONFIG)

    def shown(self, more="", exposure=0, beside="", code=0):
        """The first pixel's three levels, or the message."""
        self.write("scene.yaml", SCENE.format(more=more, exposure=exposure, beside=beside))
        said = self.run_program("render", "scene.yaml", "--quiet", code=code)[1]
        return said if code else self.first_pixel("picture.png")

    def first_pixel(self, name):
        data = (self.folder / name).read_bytes()
        packed, at = b"", 8
        while at < len(data):
            length, kind = struct.unpack(">I4s", data[at:at + 8])
            self.assertNotEqual(kind, b"sRGB")
            packed += data[at + 8:at + 8 + length] if kind == b"IDAT" else b""
            at += 12 + length
        return list(zlib.decompress(packed)[1:4])  # whatever the filter of the row, the first pixel has nothing beside it

    def test_numbers(self):
        self.assertEqual(self.shown(), [round(255 * light**0.5) for light in (0.5, 0.25, 0.04)])
        self.assertEqual(self.shown(exposure=1), [255, round(255 * 0.5**0.5), round(255 * 0.08**0.5)])
        self.assertEqual(self.shown(", view: Turned"), [10, 128, 64])
        self.assertEqual(self.shown(", display: paper"), [128, 64, 10])
        self.assertEqual(self.shown(", display: screen, view: Gamma, space: Gamma"), [128, 64, 10])

    def test_messages(self):
        for more, beside, said, place in (
                (", view: Gama", "", "the display 'screen' has no view 'Gama'", "it has 'Gamma', 'Turned', 'Lost'"),
                (", display: wall", "", "the configuration has no display 'wall'", "it has 'screen', 'paper'"),
                (", space: XYZ", "", "the configuration has no space 'XYZ'", "'Linear', 'Gamma', 'Turned', 'Lost'"),
                (", view: Lost", "", "OpenColorIO cannot show it", "nowhere.cube"),
                ("", ", tone: agx", "'tone' and 'ocio' are two ways to a display", "keep one"),
        ):
            text = self.shown(more, beside=beside, code=SCENE_ERROR)
            self.assertIn(said, text)
            self.assertIn(place, text)
            self.assertRegex(text, r"scene.yaml:\d+:\d+")
        self.write("config.ocio", "nothing of this: kind")
        self.assertIn("cannot be read", self.shown(code=SCENE_ERROR))
        self.write("config.ocio", CONFIG.replace("Linear", "Plain"))
        self.assertIn("no space of the configuration is the usual one", self.shown(code=SCENE_ERROR))

    @unittest.skipUnless(OF_BLENDER.exists(), "Blender's configuration is not installed")
    def test_of_blender(self):
        """Its view Standard is sRGB."""
        self.write("config.ocio", "")
        scene = SCENE.format(more=", display: sRGB, view: Standard", exposure=0, beside="").replace("config.ocio", str(OF_BLENDER))
        self.write("scene.yaml", scene)
        self.run_program("render", "scene.yaml", "--quiet")
        for level, light in zip(self.first_pixel("picture.png"), (0.5, 0.25, 0.04)):
            self.assertAlmostEqual(level, 255 * (1.055 * light**(1 / 2.4) - 0.055), delta=1)


if __name__ == "__main__":
    unittest.main()
