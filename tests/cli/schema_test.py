"""The JSON Schema against an independent validator (python3-jsonschema): it is a valid schema, every scene of the
repository validates, typical slips do not. The pages of docs/reference are what the program writes."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import jsonschema
import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEKALO = os.environ["LEKALO"]


def run(*arguments):
    return subprocess.run([LEKALO, *arguments], check=True, capture_output=True, text=True).stdout


class Loader(yaml.SafeLoader):
    """YAML 1.2, as scenes are: on, off, yes and no are words."""


Loader.yaml_implicit_resolvers = {
    first: [(tag, pattern) for tag, pattern in resolvers if tag != "tag:yaml.org,2002:bool" or first in "tTfF"]
    for first, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}


def load_yaml(text):
    return yaml.load(text, Loader)


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.schema = json.loads(run("schema"))
        cls.validator = jsonschema.Draft202012Validator(cls.schema)
        cls.suite_schema = json.loads(run("schema", "--suite"))
        cls.suites = jsonschema.Draft202012Validator(cls.suite_schema)

    def valid(self, text):
        return not list(self.validator.iter_errors({"lekalo": 1, **load_yaml(text)}))

    def test_is_a_schema(self):
        jsonschema.Draft202012Validator.check_schema(self.schema)
        jsonschema.Draft202012Validator.check_schema(self.suite_schema)

    def test_defaults_and_descriptions(self):
        """For editors: every field says what it is and its default, every type where more stands."""
        circle = self.schema["$defs"]["curve.circle"]
        self.assertIn("(docs/reference/curves.md#circle)", circle["markdownDescription"])
        self.assertTrue((ROOT / "docs/reference/curves.md").exists())
        fields = [(name, field) for definition in self.schema["$defs"].values() if "markdownDescription" in definition
                  for name, field in definition["properties"].items() if "description" in field and name not in ("type", "let")]
        self.assertGreater(len(fields), 500)
        defaults = [(name, field) for name, field in fields if "default" in field]
        self.assertGreater(len(defaults), 200)
        for name, field in defaults:
            self.assertIn("; default ", field["description"], name)
            self.assertRegex(field["markdownDescription"], "default `.+`$", name)
        samples = self.schema["properties"]["image"]["properties"]["samples"]
        self.assertEqual(samples["default"], 16)
        self.assertIn("default `16`", samples["markdownDescription"])

    def test_every_scene_validates(self):
        scenes = [path for folder in ("scenes", "references", "examples", "tests/images", "tests/render/scene/examples") for path in sorted((ROOT / folder).rglob("*.yaml"))
                  if path.parent.name not in ("figures", "drawing") or path.name != "index.yaml"]
        self.assertNotEqual(scenes, [])
        for path in scenes:
            scene = load_yaml(path.read_text())
            validator = self.suites if "lekalo_suite" in scene else self.validator
            with self.subTest(scene=path.name):
                self.assertEqual([f"{list(e.absolute_path)}: {e.message}" for e in validator.iter_errors(scene)], [])

    def test_every_example_of_a_type_validates(self):
        sections = {"curves": "geometry", "surfaces": "geometry", "bodies": "geometry", "meshes": "geometry",
                    "shapes": "geometry", "materials": "materials", "lights": "lights", "groups": "geometry"}
        for page, section in sections.items():
            text = (ROOT / "docs/reference" / f"{page}.md").read_text()
            examples = re.findall(r"^    (\{ type: (\w+).*)$", text, re.MULTILINE)
            self.assertEqual([name for _, name in examples], re.findall(r"^## (\w+)$", text, re.MULTILINE))
            for example, _ in examples:
                self.assertTrue(self.valid(f"{section}: {{ a: {example} }}"), example)

    def test_slips_do_not(self):
        self.assertTrue(self.valid("geometry: { a: { type: circle, radius: 2*r, center: [1, 0, 0], normal: -y } }"))
        self.assertTrue(self.valid("materials: { a: { type: diffuse }, b: { like: a, color: red } }"))
        for text in ["geometry: { a: { type: circle, raduis: 1 } }", "geometry: { a: { type: circle } }",
                     "geometry: { a: { type: circl, radius: 1 } }", "geometry: { a: { type: ball, radius: -1 } }",
                     "geometry: { a: { radius: 1 } }", "geometry: { a: { type: diffuse } }", "geometri: {}",
                     "image: { filter: boxx }", "objects: [{ material: steel }]", "camera: { type: fisheye }",
                     "styles: { a: { widht: 1 mm } }", "styles: { a: { marker: bal } }", "drawing: { grund: fill }",
                     "drawing: { annotations: [{ type: labl, at: [0, 0] }] }",
                     "drawing: { annotations: [{ type: label, at: [0, 0] }] }",
                     "objects: [{ shape: a, lines: { curv: thick } }]", "objects: [{ shape: a, show: { cmob: {} } }]",
                     "objects: [{ shape: a, show: { comb: { cuont: 3 } } }]", "panels: { a: { camra: {} } }",
                     "layout: { rows: [a, b] }", "layout: { gap: 3 mm }", "camera: { type: graph, x: 3 }",
                     "geometry: { g: { type: group, of: [{ material: red }] } }"]:
            self.assertFalse(self.valid(text), text)


    def test_suites(self):
        def valid(test):
            return not list(self.suites.iter_errors({"lekalo_suite": 1, "tests": [load_yaml(test)]}))

        good = "name: a_%02k, scene: a.yaml, repeat: { k: 1..3 }, set: { r: k/2 }"
        for more in "", ", compare: { metric: ssim, minimum: 0.99 }", ", expect: { measure: a, area: 1, tolerance: 1e-9 }":
            self.assertTrue(valid(f"{{ {good}{more} }}"), more)
        for bad in "{ name: a }", f"{{ {good}, colour: red }}", f"{{ {good}, compare: {{ metric: taste }} }}", f"{{ {good}, samples: 0 }}":
            self.assertFalse(valid(bad), bad)


class Reference(unittest.TestCase):
    def test_pages_are_what_the_program_writes(self):
        committed = {path.name: path.read_text() for path in (ROOT / "docs/reference").glob("*.md")}
        with tempfile.TemporaryDirectory() as folder:
            run("types", "--markdown", folder)
            written = {path.name: path.read_text() for path in pathlib.Path(folder).glob("*.md")}
        self.assertEqual(sorted(committed), sorted(written))
        for name, text in written.items():
            self.assertEqual(committed[name], text, f"{name}: run lekalo types --markdown docs/reference")


if __name__ == "__main__":
    unittest.main()
