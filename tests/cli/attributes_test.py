"""Attributes of elements: what may be said of which, who inherits what, and that pictures show materials of faces as they
show them of whole bodies, while shapes stay as they are (Golovanov 2016, 8.1)."""

import json
import re
import unittest

from exr import read_exr
from program import ProgramTest, SCENE_ERROR, USAGE

PART = """lekalo: 1
geometry:
  part: { type: box, size: [2, 2, 1] }
  spot: [0, 0, 0]
"""
MATERIALS = """materials:
  wood: { type: classic, color: [0.5, 0.3, 0.2] }
  paint: { type: classic, color: [0.1, 0.2, 0.7] }
"""


class Attributes(ProgramTest):
    def pixels(self, text):
        self.write("scene.yaml", text)
        self.run_program("render", "scene.yaml", "-o", "x.exr", "--quiet")
        _, planes = read_exr(self.bytes_of("x.exr"))
        return [planes[channel] for channel in "RGB"]

    def error_of(self, attribute, more=""):
        self.write("scene.yaml", f"{PART}attributes:\n  - {attribute}\n{more}")
        return self.run_program("check", "scene.yaml", code=SCENE_ERROR)[1]

    def test_slips(self):
        for attribute, part in [
            ("{ of: part, densty: 1 }", "unknown attribute 'densty' (did you mean 'density'?)"),
            ("{ of: prat, density: 1 }", "there is no geometry called 'prat' (did you mean 'part'?)"),
            ("{ of: part.z_mx, density: 1 }", "'part' has no face or edge 'z_mx' (did you mean 'z_max'?)"),
            ("{ of: spot, density: 1 }", "'spot' is a point: it carries no attributes"),
            ("{ of: part, density: -1 }", "scene.yaml:6:26"),
            ("{ of: part, transparency: 1.5 }", "transparency"),
            ("{ of: part, wear: sqrt(-1) }", "scene.yaml:6:23"),
            ("{ of: part }", "this says nothing of its elements"),
            ("{ density: 1 }", "each with 'of'"),
            ("part", "each with 'of'"),
            ("{ of: { type: ball, radius: 1 }, density: 1 }", "attributes are those of named things"),
            ("{ of: { of: part, vertex: 0 }, density: 1 }", "vertices carry no attributes"),
            ("{ of: { of: part, face: z_top }, density: 1 }", "z_top"),
            ("{ of: part, material: gold }", "gold"),
        ]:
            with self.subTest(attribute):
                said = self.error_of(attribute)
                self.assertIn(part, said)
                self.assertIn("scene.yaml:6:", said)

    def test_what_is_asked_for_must_be_there(self):
        said = self.error_of("{ of: part, density: 1 }",
                             "parameters: { a: { type: attribute, of: part, name: temperatur } }\n")
        self.assertIn("'part' has no attribute 'temperatur'", said)
        said = self.error_of("{ of: part.z_max, temperature: 1 }", "parameters: { m: { type: mass, of: part } }\n")
        self.assertIn("'part' has no attribute 'density'", said)
        said = self.error_of("{ of: part, density: 1 }", "integrator: { type: analysis, attribute: temperature }\n")
        self.assertIn("nothing in the scene has the attribute 'temperature'", said)

    def test_an_attribute_is_of_one_element(self):
        """Where two faces are equally far the scene is not built without what is made of the number."""
        self.write("scene.yaml", """lekalo: 1
geometry:
  part: { type: box, size: [1, 1, 1], transform: [{ rotate: 45, axis: x }] }
  k: { type: segment, from: [0, 0, 0], to: [heat, 0, 0] }
attributes: [{ of: { of: part, extreme: z }, temperature: 5 }]
parameters: { heat: { type: attribute, of: { of: part, extreme: z }, name: temperature } }
objects: [{ shape: part }, { shape: k, lines: { curve: thick } }]
""")
        said = self.run_program("check", "scene.yaml", code=SCENE_ERROR)[1]
        self.assertRegex(said, r"scene.yaml:6:.*: 2 things are meant by this; one is wanted here")

    def test_conditions_mean_the_same_in_a_quantity(self):
        """A face, unless they speak of an edge."""
        for of, value in (("{ of: part, extreme: z }", 20), ("{ of: part, edge: 0 }", 30)):
            self.write("scene.yaml", f"{PART}attributes: [{{ of: {of}, temperature: {value} }}]\n"
                                     f"parameters: {{ heat: {{ type: attribute, of: {of}, name: temperature }} }}\n")
            self.assertEqual(self.json_of("measure", "scene.yaml", "heat")["value"], value)

    def test_what_a_quantity_asks_of_is_shown(self):
        """Also where it is asked for by geometry, in which operands have names of their own."""
        for of in ("part", "part.z_max", "{ of: part, extreme: z }"):
            self.write("scene.yaml", f"{PART}  ring: {{ type: circle, radius: heat }}\n"
                                     f"attributes: [{{ of: {of}, temperature: 2 }}]\nparameters:\n"
                                     "  around: { type: arc_length, of: ring }\n"
                                     f"  heat: {{ type: attribute, of: {of}, name: temperature }}\n")
            self.assertIn("3 entities, 3 objects", self.run_program("check", "scene.yaml")[0])

    def test_a_thing_built_with_an_attribute_has_its_own(self):
        """What is said of it is not asked for by the number with which it is built; a true circle is told."""
        for attributes in ("[{ of: [part, ring], temperature: 5 }, { of: ring, wear: 2 }]",
                           "[{ of: ring, temperature: 7 }, { of: { of: part, face: z_min }, wear: heat }, "
                           "{ of: part.z_max, temperature: 5 }, { of: part, temperature: 3 }]"):
            self.write("scene.yaml", f"{PART}  ring: {{ type: circle, radius: heat }}\nattributes: {attributes}\n"
                                     "parameters: { heat: { type: attribute, of: part.z_max, name: temperature } }\n")
            self.assertEqual(self.json_of("measure", "scene.yaml", "heat")["value"], 5)
            self.assertIn("temperature", self.json_of("measure", "scene.yaml", "ring")["attributes"])
        said = self.error_of("{ of: part, temperature: heat }",
                             "parameters: { heat: { type: attribute, of: part, name: temperature } }\n")
        self.assertIn("scene.yaml:6:30: the parameter 'heat' is defined by itself", said)
        said = self.error_of("{ of: part, density: -1 }", "parameters: { m: { type: mass, of: part } }\n")
        self.assertNotIn("has no attribute", said)

    def test_inheritance_of_edges(self):
        """Where both faces say the same an edge has it, else it has what its body has."""
        self.write("scene.yaml", PART + "attributes:\n  - { of: part, temperature: 1 }\n"
                                        "  - { of: [part.z_max, part.x_max], temperature: 5 }\n")
        of_edges = {}
        for edge in self.json_of("measure", "scene.yaml", "part", "--topology")["edges"]:
            name = f"part.edge.{edge['index'] if 'index' in edge else len(of_edges)}"
            of_edges[name] = self.json_of("measure", "scene.yaml", name)["attributes"]["temperature"]
        self.assertEqual(sorted(row["value"] for row in of_edges.values()), [1] * 11 + [5])

    def test_shape_stays(self):
        """Without constraints, tree and attributes what depends on the shape is the same."""
        said = (MATERIALS + "attributes:\n  - { of: part, density: 7850, temperature: 20, material: wood }\n"
                            "  - { of: part.z_max, material: paint, temperature: 90 }\n")
        self.write("with.yaml", PART + said)
        self.write("without.yaml", PART)
        told = self.json_of("measure", "with.yaml", "part")
        for key in ("attributes", "mass", "mass_error", "mass_inertia", "mass_inertia_error", "mass_principal_moments"):
            told.pop(key)
        self.assertEqual(told, self.json_of("measure", "without.yaml", "part"))
        for options in (["--topology"], ["--silhouette", "1,2,-3"], ["--section", "0,0,0.5,0,0,1"]):
            self.assertEqual(self.json_of("measure", "with.yaml", "part", *options),
                             self.json_of("measure", "without.yaml", "part", *options))
        for name in ("with", "without"):
            self.run_program("draw", f"{name}.yaml", "-o", f"{name}.svg", "--quiet")
        self.assertEqual(self.bytes_of("with.svg"), self.bytes_of("without.svg"))

    def test_material_of_a_face_is_that_of_a_body_seen_there(self):
        view = "camera: { view: top }\nimage: { size: [60, 60], samples: 1 }\n"
        for representation in ("direct", "mesh"):
            shown = f"{{ shape: part, representation: {representation}"
            face = self.pixels(PART + MATERIALS + view + "attributes: { of: part.z_max, material: paint }\n"
                               f"objects: [{shown}, material: wood }}]\n")
            body = self.pixels(PART + MATERIALS + view + f"objects: [{shown}, material: paint }}]\n")
            other = self.pixels(PART + MATERIALS + view + f"objects: [{shown}, material: wood }}]\n")
            self.assertEqual(face, body)
            self.assertNotEqual(face, other)

    def test_material_of_a_body_is_its_objects(self):
        """What its object says stands above."""
        size = "image: { size: [60, 60], samples: 1 }\n"
        said = self.pixels(PART + MATERIALS + size + "attributes: { of: part, material: paint }\nobjects: [{ shape: part }]\n")
        shown = self.pixels(PART + MATERIALS + size + "objects: [{ shape: part, material: paint }]\n")
        self.assertEqual(said, shown)
        both = self.pixels(PART + MATERIALS + size + "attributes: { of: part, material: wood }\n"
                           "objects: [{ shape: part, material: paint }]\n")
        self.assertEqual(both, shown)

    def test_transparency(self):
        """Through a plate of transparency 1 the ground is seen as if there were none."""
        scene = ("lekalo: 1\ngeometry:\n  plate: { type: box, size: [2, 2, 0.1], center: [0, 0, 1] }\n"
                 "  ground: { type: box, size: [2, 2, 0.5] , center: [0, 0, 0] }\n"
                 "materials: { red: { type: emission, color: [1, 0, 0] }, blue: { type: emission, color: [0, 0, 1] } }\n"
                 "lights: {}\ncamera: { view: top }\nimage: { size: [30, 30], samples: 1 }\n"
                 "objects: [{ shape: plate, material: blue }, { shape: ground, material: red }]\n")
        middle = 15 * 30 + 15
        for transparency, color in (0, [0, 0, 1]), (1, [1, 0, 0]):
            found = self.pixels(scene + f"attributes: {{ of: plate, transparency: {transparency} }}\n")
            self.assert_near([plane[middle] for plane in found], color, 1e-6)

    def test_transparency_of_a_back(self):
        """A surface lets through what is behind it whichever of its sides is seen, also where these differ."""
        for turned in ("false", "true"):
            found = self.pixels("lekalo: 1\ngeometry:\n"
                                f"  sheet: {{ type: plane, center: [0, 0, 1], size: [2, 2], reversed: {turned} }}\n"
                                "  ground: { type: box, size: [2, 2, 0.5] }\n"
                                "materials: { red: { type: emission, color: [1, 0, 0] }, blue: { type: emission, color: [0, 0, 1] },\n"
                                "  green: { type: emission, color: [0, 1, 0] } }\nlights: {}\ncamera: { view: top }\nimage: { size: [30, 30], samples: 1 }\n"
                                "objects: [{ shape: sheet, material: blue, back_material: green }, { shape: ground, material: red }]\n"
                                "attributes: { of: sheet, transparency: 1 }\n")
            self.assert_near([plane[15 * 30 + 15] for plane in found], [1, 0, 0], 1e-6)

    def test_a_section_keeps_the_materials_of_faces(self):
        """Seen from above a cut at half depth leaves the top as it is."""
        view = ("camera: { view: top }\nimage: { size: [60, 60], samples: 1 }\n"
                "panels: { cut: { section: { planes: { through: [0, 1, 0], normal: -y }, hatch: none } } }\n"
                "drawing: { ground: fill }\nlayout: { rows: [[cut]] }\n")
        fills = {}
        for name, more in [("face", "attributes: { of: part.z_max, material: paint }\nobjects: [{ shape: part, material: wood }]\n"),
                           ("body", "objects: [{ shape: part, material: paint }]\n")]:
            self.write(f"{name}.yaml", PART + MATERIALS + view + more)
            self.run_program("draw", f"{name}.yaml", "-o", f"{name}.svg", "--quiet")
            fills[name] = [line for line in self.bytes_of(f"{name}.svg").decode().splitlines() if "fill=" in line]
        self.assertEqual(fills["face"], fills["body"])

    def test_an_object_with_a_section_of_its_own(self):
        """Its faces have their materials; in colours of an attribute the cut has what the body has."""
        cut = "section: { planes: { through: [0, 1, 0], normal: -y }, hatch: none }"
        self.write("scene.yaml", PART + MATERIALS + "attributes: [{ of: part.z_max, material: paint }, { of: part, material: wood }]\n"
                   f"objects: [{{ shape: part, {cut} }}]\ncamera: {{ view: isometric }}\ndrawing: {{ ground: fill }}\n")
        self.run_program("draw", "scene.yaml", "-o", "x.svg", "--quiet")
        fills = set(re.findall('fill="(#[0-9a-f]+)"', self.bytes_of("x.svg").decode()))
        self.assertEqual(fills, {"#ffffff", "#aa866f", "#506fc5"})
        for view, value in ("top", 8), ("front", 3):
            self.write("scene.yaml", PART + "attributes: [{ of: part, temperature: 3 }, { of: part.z_max, temperature: 8 }]\n"
                       f"objects: [{{ shape: part, {cut} }}]\ncamera: {{ view: {view} }}\n"
                       "integrator: { type: analysis, attribute: temperature }\nimage: { size: [8, 8], samples: 1 }\n")
            self.run_program("render", "scene.yaml", "-o", "x.exr", "--quiet")
            self.assertEqual(read_exr(self.bytes_of("x.exr"))[1]["temperature"][4 * 8 + 4], value)

    def test_fills_of_faces(self):
        """Each face of a drawing is filled in the colour of its own material, with exact borders."""
        self.write("scene.yaml", PART + MATERIALS + "attributes: { of: part.z_max, material: paint }\n"
                   "objects: [{ shape: part, material: wood }]\ndrawing: { ground: fill }\ncamera: { view: isometric }\n")
        self.run_program("draw", "scene.yaml", "-o", "x.svg", "--quiet")
        text = self.bytes_of("x.svg").decode()
        for color in ("#aa866f", "#506fc5"):  # sRGB of 0.8 times the colours, the share of light that is thrown back
            self.assertIn(color, text.lower())

    def test_gltf(self):
        self.write("scene.yaml", PART + MATERIALS + "attributes: { of: part.z_max, material: paint }\n"
                   "objects: [{ shape: part, material: wood }]\n")
        self.run_program("export", "scene.yaml", "-o", "x.gltf")
        model = json.loads(self.bytes_of("x.gltf"))
        of_material = {model["materials"][primitive["material"]]["name"]: model["accessors"][primitive["indices"]]["count"]
                       for mesh in model["meshes"] for primitive in mesh["primitives"] if primitive.get("mode", 4) == 4}
        self.assertEqual(of_material, {"wood": 30, "paint": 6})  # three corners of two triangles of each face

    def test_step(self):
        """The face's colour overrides that of the solid (ISO 10303-46)."""
        self.write("scene.yaml", PART + MATERIALS + "attributes: { of: part.z_max, material: paint }\n"
                   "objects: [{ shape: part, material: wood }]\n")
        self.run_program("export", "scene.yaml", "-o", "x.step", "--quiet")
        entities = dict(re.findall(r"^(#\d+)=(.*);$", self.bytes_of("x.step").decode(), re.MULTILINE))
        styled = [text for text in entities.values() if text.startswith("OVER_RIDING_STYLED_ITEM")]
        self.assertEqual(len(styled), 1)
        face, whole = re.findall(r"#\d+", styled[0])[1:]
        self.assertTrue(entities[face].startswith("ADVANCED_FACE('z_max'"))
        self.assertTrue(entities[whole].startswith("STYLED_ITEM"))

    def test_json(self):
        self.write("scene.yaml", PART + MATERIALS + "attributes: [{ of: part.z_max, material: paint }, { of: part, density: 2 }]\n")
        self.run_program("export", "scene.yaml", "-o", "x.json", "--quiet")
        self.assertEqual(json.loads(self.bytes_of("x.json"))["attributes"],
                         [{"of": "part", "kind": "thing",
                           "attributes": {"density": {"value": 2.0, "unit": "kg/m^3", "of": "part"}}},
                          {"of": "part.z_max", "kind": "face", "attributes": {"material": {"value": "paint"}}}])

    def test_included_attributes(self):
        """Those of the including file come later."""
        self.write("base.yaml", PART + "attributes: { of: part, density: 2, temperature: 1 }\n")
        self.write("scene.yaml", "lekalo: 1\ninclude: base.yaml\nattributes: { of: part, temperature: 7 }\n")
        found = self.json_of("measure", "scene.yaml", "part")["attributes"]
        self.assertEqual((found["density"]["value"], found["temperature"]["value"]), (2, 7))
        self.write("scene.yaml", "lekalo: 1\ninclude: { file: base.yaml, as: a }\n")
        self.assertEqual(self.json_of("measure", "scene.yaml", "a.part")["attributes"]["density"]["value"], 2)

    def test_text(self):
        self.write("scene.yaml", PART + "attributes: { of: part, density: 2 }\n")
        said = self.run_program("measure", "scene.yaml", "part.z_max")[0]
        self.assertIn("attributes\n  density          2 kg/m^3   of part\n", said)
        mass = re.search(r"^mass +(\S+)   error", self.run_program("measure", "scene.yaml", "part")[0], re.MULTILINE)
        self.assert_near(float(mass[1]), 8, 1e-13)
        self.run_program("measure", "scene.yaml", "part.z_mx", code=USAGE)

    def test_colours_of_an_attribute(self):
        """The layer of an analysis holds the number of each face."""
        self.write("scene.yaml", PART + "attributes: [{ of: part, temperature: 3 }, { of: part.z_max, temperature: 8 }]\n"
                   "integrator: { type: analysis, attribute: temperature }\ncamera: { view: top }\nimage: { size: [8, 8], samples: 1 }\n")
        self.run_program("render", "scene.yaml", "-o", "x.exr", "--quiet")
        _, planes = read_exr(self.bytes_of("x.exr"))
        self.assertEqual(planes["temperature"][4 * 8 + 4], 8)


if __name__ == "__main__":
    unittest.main()
