"""The example of each curve, surface and body of the reference goes through every command: checked, drawn, rendered (curves
as lines and as tubes), measured, evaluated and exported, without an error and without a number that is none.

The small tier takes every seventh type, LEKALO_TIER=full all."""

import json
import math
import os
import pathlib
import re
import unittest

from program import ROOT, ProgramTest

# What examples refer to by name.
NAMED = {"my_curve": "{ type: bezier_curve, points: [[1, 0, 0], [2.5, 0, 1], [0, 0, 2], [1.5, 0, 3]] }",
         "round": "{ type: circle, radius: 1 }", "my_body": "{ type: ball, radius: 1 }",
         "pipe": "{ type: cylinder_surface, radius: 1, height: 2 }"}
# Code and files from outside; shown by their own tests.
OUTSIDE = {"external_surface", "mesh"}
# What the example of external_curve calls file.so: examples/external, as ctest has built it.
LIBRARY = os.environ.get("LEKALO_EXTERNAL_EXAMPLE")
# Creases that the default tolerance of fits in STEP files is too small for.
CREASED = {"deformed_surface", "thread_surface", "weld_groove", "subdivision_surface"}
STEP = 1 if os.environ.get("LEKALO_TIER") == "full" else 7


def examples(page):
    text = (ROOT / f"docs/reference/{page}.md").read_text()
    found = re.findall(r"^## (\w+)\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    for name, body in found[::STEP]:
        example = re.search(r"^    (\{ type: .*)$", body, re.MULTILINE)
        if example and name not in OUTSIDE and (LIBRARY or "file.so" not in example[1]):
            yield name, example[1].replace("file.so", str(LIBRARY))


def numbers(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for one in value:
            yield from numbers(one)
    elif isinstance(value, float):
        yield value


class EveryType(ProgramTest):
    def scene(self, example, tube=False):
        named = "".join(f"  {one}: {NAMED[one]}\n" for one in NAMED if re.search(rf"\b{one}\b", example))
        shown = "thick" if tube else "it"
        more = "  thick: { type: tube, of: it, radius: 0.05 }\n" if tube else ""
        self.write("scene.yaml", f"lekalo: 1\ngeometry:\n{named}  it: {example}\n{more}"
                   f"objects: [{{ shape: {shown} }}]\nimage: {{ size: [80, 60] }}\n")

    def run_program(self, command, *arguments):
        return super().run_program(command, *arguments, "--allow-external")

    def pictures(self):
        self.run_program("draw", "scene.yaml", "-o", "x.svg")
        self.assertNotRegex((self.folder / "x.svg").read_text(), r"\b(nan|inf)\b")
        self.run_program("render", "scene.yaml", "-o", "x.exr", "--samples", "1", "--quiet")

    def told(self, *words):
        found = json.loads(self.run_program(*words, "--json")[0])
        self.assertTrue(all(math.isfinite(x) for x in numbers(found)), words)
        return found

    def exported(self, *formats):
        for format in formats:
            names = [] if format == "pov" else ["it"]  # the whole scene
            self.run_program("export", "scene.yaml", *names, "-o", f"x.{format}", "--quiet")
            if format != "gltf":  # whose numbers are bytes
                self.assertNotRegex((self.folder / f"x.{format}").read_text(), r"\b(nan|inf)\b", format)

    def test_curves(self):
        for name, example in examples("curves"):
            with self.subTest(name):
                self.scene(example)
                self.run_program("check", "scene.yaml")
                self.pictures()
                # A line that is seen: paths of it, not the empty page.
                self.assertRegex((self.folder / "x.svg").read_text(), r"<(path|circle|ellipse|polyline|line)\b")
                self.assertGreater(self.told("measure", "scene.yaml", "it")["length"], 0)
                self.told("measure", "scene.yaml", "it", "--nurbs")
                self.told("evaluate", "scene.yaml", "it", "--at", "0.3")
                self.exported("obj", "json", "step", "gltf", "pov")
                self.scene(example, tube=True)
                self.run_program("check", "scene.yaml")
                self.pictures()
                self.told("measure", "scene.yaml", "thick")

    def test_surfaces(self):
        for name, example in examples("surfaces"):
            with self.subTest(name):
                self.scene(example)
                self.run_program("check", "scene.yaml")
                self.pictures()
                self.told("measure", "scene.yaml", "it")
                self.exported("obj", "json", *(["step"] if name not in CREASED else []))

    def test_bodies(self):
        for name, example in examples("bodies"):
            with self.subTest(name):
                self.scene(example)
                self.run_program("check", "scene.yaml")
                self.pictures()
                self.told("measure", "scene.yaml", "it")
                self.told("measure", "scene.yaml", "it", "--topology")
                self.exported("obj", *(["step"] if name not in CREASED else []))


if __name__ == "__main__":
    unittest.main()
