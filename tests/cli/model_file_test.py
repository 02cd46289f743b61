"""Models from glTF and OBJ files: places, materials and pictures; broken files are named."""

import base64
import json
import struct
import unittest

from exr import read_exr
from optics_input_test import chunk, png
from program import ProgramTest

SCENE = """lekalo: 1
geometry:
  thing: {{ type: model, file: {file}{more} }}
materials: {{ paper: {{ type: diffuse }} }}
objects: [{{ shape: thing }}]
lights: {{ room: {{ type: ambient_light }} }}
integrator: {{ type: path }}
camera: {{ type: parallel, view: {view}, frame: all, margin: 0 }}
image: {{ size: [32, 32], samples: 16, background: black }}
"""

# A square of side 2 in the plane z = 0 of the file, uv from its lower left corner (glTF counts v downwards).
CORNERS = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
UV = [(0, 1), (1, 1), (1, 0), (0, 0)]
INDICES = [0, 1, 2, 0, 2, 3]


def gltf(nodes, material, pictures=()):
    data = b"".join(struct.pack("<3f", *p) for p in CORNERS)
    data += b"".join(struct.pack("<2f", *p) for p in UV)
    data += b"".join(struct.pack("<H", i) for i in INDICES)
    views = [(0, 48), (48, 32), (80, 12)]
    for picture in pictures:
        views.append((len(data), len(picture)))
        data += picture
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "indices": 2, "material": 0}]}],
        "materials": [material],
        "textures": [{"source": k} for k in range(len(pictures))],
        "images": [{"bufferView": 3 + k, "mimeType": "image/png"} for k in range(len(pictures))],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": at, "byteLength": size} for at, size in views],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
            {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"},
            {"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}]})


def matt(**more):
    return {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1, **more}}


class Models(ProgramTest):
    def render(self, file, view="front", more="", code=0):
        self.write("scene.yaml", SCENE.format(file=file, view=view, more=more))
        return self.run_program("render", "scene.yaml", "-o", "picture.exr", "--quiet", code=code)[1]

    def same(self, expected):
        """The picture is that of a scene file that says the same."""
        self.write("expected.yaml", f"""lekalo: 1
{expected}
lights: {{ room: {{ type: ambient_light }} }}
integrator: {{ type: path }}
camera: {{ type: parallel, view: front, frame: all, margin: 0 }}
image: {{ size: [32, 32], samples: 16, background: black }}
""")
        self.run_program("render", "expected.yaml", "-o", "expected.exr", "--quiet")
        self.run_program("compare", "picture.exr", "expected.exr", "--metric", "max", "--threshold", "1e-4")

    def test_gltf_stands_where_it_says(self):
        """Two copies of the square, y of the file is z here."""
        self.write("two.gltf", gltf([{"mesh": 0, "translation": [-2, 1, 0]}, {"mesh": 0, "translation": [2, 0, 0], "scale": [1, 2, 1]}],
                                    matt(baseColorFactor=[0.6, 0.3, 0.1, 1])))
        self.render("two.gltf")
        matter = "{ type: principled, base_color: [0.6, 0.3, 0.1], specular_roughness: 1 }"
        self.same(f"""geometry:
  a: {{ type: plane, size: [2, 2], frame: {{ origin: [-2, 0, 1], x: x, z: -y }} }}
  b: {{ type: plane, size: [2, 4], frame: {{ origin: [2, 0, 0], x: x, z: -y }} }}
objects: [{{ shape: a, material: {matter} }}, {{ shape: b, material: {matter} }}]""")

    def test_pictures_within(self):
        """Four squares of colour."""
        colors = [[255, 0, 0, 0, 255, 0], [0, 0, 255, 255, 255, 255]]
        self.write("square.gltf", gltf([{"mesh": 0}], matt(baseColorTexture={"index": 0}), [png(2, 2, 8, colors)]))
        (self.folder / "colors.png").write_bytes(png(2, 2, 8, colors))
        self.render("square.gltf")
        self.same("""geometry: { a: { type: plane, size: [2, 2], frame: { x: x, z: -y } } }
materials: { it: { type: principled, specular_roughness: 1, base_color: { type: image, file: colors.png, spacing: 2, offset: -1, interpolation: filtered } } }
objects: [{ shape: a, material: it }]""")

    def test_pictures_of_other_spelling(self):
        """Spaces as %20, folders after \\."""
        (self.folder / "sub").mkdir()
        (self.folder / "sub" / "my red.png").write_bytes(png(1, 1, 8, [[255, 0, 0]]))
        spelled = json.loads(gltf([{"mesh": 0}], matt(baseColorTexture={"index": 0}), [b"none"]))
        spelled["images"] = [{"uri": "sub/my%20red.png"}]
        self.write("spelled.gltf", json.dumps(spelled))
        self.write("sub/part.mtl", "newmtl red\nmap_Kd sub\\my red.png\n")
        self.write("part.obj", "mtllib sub\\part.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n")
        for file in "spelled.gltf", "part.obj":
            with self.subTest(file):
                self.render(file, more=", up: z" if file == "part.obj" else "")
                planes = read_exr(self.bytes_of("picture.exr"))[1]
                self.assertGreater(max(planes["R"]), 3 * max(planes["G"]))

    def test_pictures_that_begin_alike(self):
        """Two of them, of the same first 5000 bytes."""
        red, green = png(1, 1, 8, [[255, 0, 0]]), png(1, 1, 8, [[0, 255, 0]])
        red, green = (p[:33] + chunk(b"tEXt", b"c\0" + 5000 * b" ") + p[33:] for p in (red, green))
        two = json.loads(gltf([{"mesh": 0, "translation": [-1, 0, 0]}, {"mesh": 1, "translation": [1, 0, 0]}],
                              matt(baseColorTexture={"index": 0}), [red, green]))
        two["materials"].append(matt(baseColorTexture={"index": 1}))
        two["meshes"].append(json.loads(json.dumps(two["meshes"][0])))
        two["meshes"][1]["primitives"][0]["material"] = 1
        self.write("two.gltf", json.dumps(two))
        self.render("two.gltf")
        planes = read_exr(self.bytes_of("picture.exr"))[1]
        for lane, other in ("R", "G"), ("G", "R"):
            self.assertGreater(sum(a > 0.3 > b for a, b in zip(planes[lane], planes[other])), 100)

    def test_pictures_are_moved_as_told(self):
        """KHR_texture_transform: only the green quarter is seen, by a turn too."""
        colors = 4 * [4 * [255, 0, 0] + 4 * [0, 255, 0]] + 4 * [4 * [0, 0, 255] + 4 * [255, 255, 255]]
        for told in ({"offset": [0.6, 0.1], "scale": [0.3, 0.25]},
                     {"offset": [0.6, 0.4], "scale": [0.3, 0.2], "rotation": 1.5707963}):
            texture = {"index": 0, "extensions": {"KHR_texture_transform": told}}
            moved = json.loads(gltf([{"mesh": 0}], matt(baseColorTexture=texture), [png(8, 8, 8, colors)]))
            self.write("moved.gltf", json.dumps({**moved, "extensionsUsed": ["KHR_texture_transform"]}))
            self.render("moved.gltf")
            planes = read_exr(self.bytes_of("picture.exr"))[1]
            self.assertGreater(min(planes["G"]), 0.9)
            self.assertLess(max(planes["R"] + planes["B"]), 0.3)

    def test_masks_are_all_or_nothing(self):
        """Opacity 0.3 of the whole and 0.6 of a picture, cut at 0.5: none, all."""
        mask = lambda **more: {**matt(**more), "alphaMode": "MASK"}
        picture = png(1, 1, 8, [[255, 255, 255, 153]], 6)
        for opacity, material in (0, mask(baseColorFactor=[1, 1, 1, 0.3])), (1, mask(baseColorTexture={"index": 0})):
            self.write("mask.gltf", gltf([{"mesh": 0}], material, [picture]))
            self.render("mask.gltf")
            self.assert_near(read_exr(self.bytes_of("picture.exr"))[1]["G"][16 * 32 + 16], opacity, 0.2)

    def test_strength_of_emission(self):
        """As text and as the binary form."""
        text = gltf([{"mesh": 0}], {**matt(baseColorFactor=[0, 0, 0, 1]), "emissiveFactor": [0.5, 1, 0],
                                    "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}}})
        self.write("lit.gltf", text)
        binary = json.loads(text)
        data = base64.b64decode(binary["buffers"][0].pop("uri").split(",")[1])
        text = json.dumps(binary).encode()
        text += b" " * (-len(text) % 4)
        (self.folder / "lit.glb").write_bytes(
            struct.pack("<4sIIII", b"glTF", 2, 28 + len(text) + len(data), len(text), 0x4E4F534A) + text +
            struct.pack("<II", len(data), 0x004E4942) + data)
        for file in "lit.gltf", "lit.glb":
            self.render(file)
            planes = read_exr(self.bytes_of("picture.exr"))[1]
            self.assert_near(max(planes["G"]) - max(planes["B"]), 3, 1e-4)
            self.assert_near(max(planes["R"]) - max(planes["B"]), 1.5, 1e-4)

    def test_obj_with_its_library(self):
        self.write("part.mtl", "newmtl red\nKd 0.7 0.1 0.05\nNs 0\nillum 2\n")
        self.write("part.obj", "mtllib part.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nusemtl red\nf 1 2 3 4\n")
        self.render("part.obj", more=", up: z")
        self.same("""geometry: { a: { type: plane, size: [2, 2], frame: { x: x, z: -y } } }
objects: [{ shape: a, material: { type: principled, base_color: [0.7, 0.1, 0.05], specular_roughness: 1, specular_weight: 0 } }]""")

    def test_unlit_shows_its_colour(self):
        self.write("thing.gltf", gltf([{"mesh": 0}], {
            **matt(baseColorFactor=[0.8, 0.1, 0.2, 1]), "extensions": {"KHR_materials_unlit": {}}}))
        self.write("dark.yaml", SCENE.format(file="thing.gltf", view="front", more="").replace("ambient_light", "ambient_light, intensity: 0"))
        self.run_program("render", "dark.yaml", "-o", "dark.exr", "--quiet")
        planes = read_exr(self.bytes_of("dark.exr"))[1]
        for layer, expected in zip("RGB", (0.8, 0.1, 0.2)):
            self.assertAlmostEqual(planes[layer][16 * 32 + 16], expected, 4)

    def test_what_an_obj_file_lacks_is_named(self):
        square = "v 0 0 {}\nv 1 0 0\nv 1 1 0\n"
        self.write("bare.obj", "mtllib missing.mtl\n" + square.format(0) + "usemtl red\nf 1 2 3\n")
        self.assertIn("missing.mtl", self.render("bare.obj", code=3))
        self.write("nan.obj", square.format("nan") + "f 1 2 3\n")
        self.assertIn("nan.obj", self.render("nan.obj", code=3))

    def test_what_is_wrong_is_named(self):
        self.write("broken.gltf", "{ \"asset\": ")
        self.write("empty.gltf", json.dumps({"asset": {"version": "2.0"}}))
        self.write("words.glb", "not a model")
        (self.folder / "cut.gltf").write_text(gltf([{"mesh": 0}], matt())[:900])
        lost = json.loads(gltf([{"mesh": 0}], matt(baseColorTexture={"index": 0}), [b"none"]))
        lost["images"] = [{"uri": "nowhere.png"}]
        self.write("lost.gltf", json.dumps(lost))
        for file in "broken.gltf", "empty.gltf", "words.glb", "cut.gltf", "lost.gltf", "nowhere.gltf":
            with self.subTest(file):
                said = self.render(file, code=3)
                self.assertRegex(said, r"scene.yaml:3:\d+: ")
                self.assertIn("nowhere.png" if file == "lost.gltf" else file, said)


if __name__ == "__main__":
    unittest.main()
