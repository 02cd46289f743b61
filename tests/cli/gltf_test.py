"""lekalo export to glTF: read back by this test alone: positions within the sag, exact normals, names, materials, lines;
and the web page, opened in headless Chromium where it is installed."""

import base64
import json
import math
import re
import shutil
import struct
import subprocess
import unittest

from program import FILE_ERROR, ProgramTest, USAGE

SCENE = """lekalo: 1
info: { title: Three things }
geometry:
  ball: { type: sphere_surface, center: [5, 0, 100], radius: 2 }
  block: { type: box, size: [1, 2, 3] }
  rim: { type: circle, radius: 1 }
materials:
  gold: { type: conductor, metal: Au, roughness: 0.3 }
  ink: { type: plastic, color: [0.2, 0.4, 0.6], roughness: 0.5 }
  pane: { type: dielectric, index: 1.6 }
  flint: { type: dielectric, glass: N-SF6 }
objects:
  - { shape: ball, name: globe, material: gold }
  - { shape: block, material: ink, lines: { sharp: { width: 2 px, color: red } } }
  - { shape: block, name: glass, material: pane, transform: { translate: [0, 0, 9] } }
  - { shape: rim }
"""
FLINT = "  - { shape: block, name: prism, material: flint, transform: { translate: [0, 9, 0] } }\n"
SIZES = {"SCALAR": 1, "VEC3": 3}
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")


class Gltf(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("things.yaml", SCENE)

    def numbers(self, model, index):
        accessor = model["accessors"][index]
        view = model["bufferViews"][accessor["bufferView"]]
        size = SIZES[accessor["type"]]
        count = accessor["count"] * size
        code = {5126: "f", 5125: "I"}[accessor["componentType"]]
        values = struct.unpack_from(f"<{count}{code}", self.buffer, view["byteOffset"])
        self.assertEqual(view["byteLength"], 4 * count)
        return [values[i:i + size] for i in range(0, count, size)]

    def export(self, *options):
        self.run_program("export", "things.yaml", "-o", "things.gltf", *options)
        model = json.loads((self.folder / "things.gltf").read_text())
        self.buffer = base64.b64decode(model["buffers"][0]["uri"].split(",")[1], validate=True)
        self.assertEqual(len(self.buffer), model["buffers"][0]["byteLength"])
        return model

    def nodes(self, model):
        return {node["name"]: node for node in model["nodes"] if "mesh" in node}

    def test_model(self):
        model = self.export("--sag", "0.001")
        self.assertEqual(model["asset"]["version"], "2.0")
        self.assertEqual(model["scenes"][0]["name"], "Three things")
        nodes = self.nodes(model)
        self.assertEqual(sorted(nodes), ["block", "block lines", "glass", "globe", "rim lines"])
        globe = model["meshes"][nodes["globe"]["mesh"]]["primitives"][0]
        middle = nodes["globe"]["translation"]
        self.assert_near(middle, [5, 0, 100], 0.01)
        points = self.numbers(model, globe["attributes"]["POSITION"])
        normals = self.numbers(model, globe["attributes"]["NORMAL"])
        places = [[p[k] + middle[k] - (5, 0, 100)[k] for k in range(3)] for p in points]
        for p, n in zip(places, normals):
            self.assert_near(math.dist(p, (0, 0, 0)), 2, 1e-6)
            self.assert_near(n, [x / 2 for x in p], 1e-6)
        indices = [i for i, in self.numbers(model, globe["indices"])]
        self.assertEqual(max(indices), len(points) - 1)
        for a, b, c in zip(indices[::3], indices[1::3], indices[2::3]):
            inside = [sum(places[i][k] for i in (a, b, c)) / 3 for k in range(3)]
            self.assertLess(2 - math.dist(inside, (0, 0, 0)), 0.001)
        accessor = model["accessors"][globe["attributes"]["POSITION"]]
        for k in range(3):
            self.assertEqual(accessor["min"][k], min(p[k] for p in points))
            self.assertEqual(accessor["max"][k], max(p[k] for p in points))

    def test_materials(self):
        model = self.export()
        materials = {one["name"]: one for one in model["materials"]}
        gold = materials["gold"]["pbrMetallicRoughness"]
        self.assertEqual((gold["metallicFactor"], gold["roughnessFactor"]), (1, 0.3))
        self.assertGreater(gold["baseColorFactor"][0], gold["baseColorFactor"][2] + 0.2)
        ink = materials["ink"]["pbrMetallicRoughness"]
        self.assertEqual((ink["metallicFactor"], ink["roughnessFactor"]), (0, 0.5))
        self.assert_near(ink["baseColorFactor"], [0.2, 0.4, 0.6, 1], 1e-6)
        self.assertEqual(materials["pane"]["extensions"]["KHR_materials_ior"]["ior"], 1.6)
        self.write("things.yaml", SCENE + FLINT)
        flint = {one["name"]: one for one in self.export()["materials"]}["flint"]
        self.assert_near(flint["extensions"]["KHR_materials_ior"]["ior"], 1.80518, 1e-4)
        self.assertEqual(model["extensionsUsed"], ["KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_unlit"])
        nodes = self.nodes(model)
        edges = model["meshes"][nodes["block lines"]["mesh"]]["primitives"]
        self.assertEqual([one["mode"] for one in edges], 12 * [3])
        red = model["materials"][edges[0]["material"]]
        self.assertEqual(red["pbrMetallicRoughness"]["baseColorFactor"], [1, 0, 0, 1])
        self.assertIn("KHR_materials_unlit", red["extensions"])

    def test_line_keeps_the_sag(self):
        model = self.export("--sag", "0.001")
        node = self.nodes(model)["rim lines"]
        points = self.numbers(model, model["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"])
        places = [[p[k] + node["translation"][k] for k in range(3)] for p in points]
        for p, q in zip(places, places[1:]):
            self.assert_near(math.dist(p, (0, 0, 0)), 1, 1e-6)
            self.assertLess(1 - math.dist([(x + y) / 2 for x, y in zip(p, q)], (0, 0, 0)), 0.001)

    def test_binary_file(self):
        model = self.export()
        self.run_program("export", "things.yaml", "-o", "things.glb")
        data = self.bytes_of("things.glb")
        magic, version, length, json_length, kind = struct.unpack_from("<4sIII4s", data)
        self.assertEqual((magic, version, length, kind), (b"glTF", 2, len(data), b"JSON"))
        binary = json.loads(data[20:20 + json_length])
        count, kind = struct.unpack_from("<I4s", data, 20 + json_length)
        self.assertEqual(kind, b"BIN\0")
        self.assertEqual(data[28 + json_length:][:len(self.buffer)], self.buffer)
        self.assertEqual(len(data), 28 + json_length + count)
        del model["buffers"][0]["uri"]
        self.assertEqual(binary, model)

    def test_named_geometry(self):
        model = self.export("block", "rim")
        nodes = self.nodes(model)
        self.assertEqual(set(nodes), {"block", "rim"})
        self.assertEqual(model["meshes"][nodes["rim"]["mesh"]]["primitives"][0]["mode"], 3)
        self.assertNotIn("material", model["meshes"][nodes["block"]["mesh"]]["primitives"][0])

    def test_usage(self):
        self.assertIn("nothing", self.run_program("export", "things.yaml", "nothing", "-o", "a.gltf", code=USAGE)[1])
        self.run_program("export", "things.yaml", "-o", "none/a.gltf", code=FILE_ERROR)
        self.assertIn("5 nodes", self.run_program("export", "things.yaml", "--format", "gltf")[1])

    def test_page(self):
        self.run_program("export", "things.yaml", "-o", "things.html", "--sag", "0.01")
        page = (self.folder / "things.html").read_text()
        self.assertEqual(re.findall(r'(?:src|href)="', page.split("<script>")[0]), [])
        self.assertIn("<title>Three things</title>", page)
        self.assertIn("Three.js Authors", page)
        if CHROMIUM is None:
            self.skipTest("Chromium is not installed: the page is not opened")
        done = subprocess.run([CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                               f"--user-data-dir={self.folder}/profile", "--virtual-time-budget=20000", "--dump-dom",
                               (self.folder / "things.html").as_uri()], capture_output=True, text=True, timeout=240)
        found = re.search(r'data-lekalo="(\d+) triangles, (\d+) lines"', done.stdout)
        self.assertIsNotNone(found, done.stdout[:300] + done.stdout[-500:] + done.stderr[-1500:])
        self.assertEqual(int(found[2]), 13)
        self.assertGreater(int(found[1]), 100)


if __name__ == "__main__":
    unittest.main()
