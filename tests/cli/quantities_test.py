"""Parameters that are measured of the geometry, and models that are kept in archives."""

import os
import subprocess
import unittest

from program import LEKALO, ProgramTest, SCENE_ERROR


class Quantities(ProgramTest):
    def errors_of(self, text):
        self.write("scene.yaml", "lekalo: 1\n" + text)
        return self.run_program("check", "scene.yaml", code=SCENE_ERROR)[1]

    def test_a_circle_of_definitions(self):
        said = self.errors_of("parameters:\n  r: { type: arc_length, of: c }\ngeometry:\n  c: { type: circle, radius: r }\n")
        self.assertIn("scene.yaml:5:30", said)
        self.assertIn("the parameter 'r' is defined by itself", said)
        self.assertNotIn("built from itself", said)

    def test_what_cannot_be_measured(self):
        for text, part in [
            ("{ type: distance, from: c }", "missing field 'to'"),
            ("{ type: distance, from: c, to: d }", "there is no geometry called 'd'"),
            ("{ type: volume, of: c }", "'c' is a curve, but a body is wanted here"),
            ("{ type: angle_between, from: [0, 0, 0], to: x }", "scene.yaml:3:35"),
            ("{ type: lenght, of: c }", "unknown type 'lenght'"),
            ("{ of: c }", "missing 'type' of a quantity"),
            ("{ type: circle, radius: 1 }", "'circle' makes a curve, but a quantity is wanted here"),
            ("{ type: arc_length, of: { type: formula_curve, point: [t, sqrt(t), 0], domain: [-1, 1] } }", "the formulas have no value at t = -1"),
        ]:
            said = self.errors_of(f"parameters:\n  r: {text}\ngeometry:\n  c: {{ type: circle, radius: 1 }}\n")
            self.assertIn(part, said)

    def test_the_length_of_a_part_has_no_direction(self):
        for ends in ("from: 1, to: 3", "from: 3, to: 1"):
            self.write("scene.yaml", f"lekalo: 1\nparameters: {{ l: {{ type: arc_length, of: c, {ends} }} }}\n"
                                     "geometry: { c: { type: circle, radius: 2 } }\n")
            self.assert_near(self.json_of("measure", "scene.yaml", "l")["value"], 4, 1e-12)

    def test_what_is_measured_is_shown(self):
        """To measure is no use: the circle is drawn though a parameter names it."""
        self.write("scene.yaml", "lekalo: 1\nparameters: { l: { type: arc_length, of: c } }\n"
                                 "geometry:\n  c: { type: circle, radius: 1 }\n  d: { type: circle, radius: 2 }\n")
        self.run_program("draw", "scene.yaml", "-o", "both.svg")
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  c: { type: circle, radius: 1 }\n  d: { type: circle, radius: 2 }\n")
        self.run_program("draw", "scene.yaml", "-o", "plain.svg")
        self.assertEqual(self.bytes_of("both.svg"), self.bytes_of("plain.svg"))

    def test_archives(self):
        """A model of a user's own archive is found from any folder, a shared one after it."""
        for archive, radius in ("own", 1), ("shared", 2):
            folder = self.folder / archive / "lekalo/scenes/parts"
            folder.mkdir(parents=True)
            (folder / "ring.yaml").write_text(
                f"lekalo: 1\nparameters: {{ r: {radius} }}\ngeometry: {{ ring: {{ type: circle, radius: r }} }}\n")
            (folder / f"{archive}.yaml").write_text(f"lekalo: 1\nparameters: {{ {archive}: {radius} }}\n")
        self.write("scene.yaml", "lekalo: 1\ninclude: [{ file: parts/ring.yaml, as: a }, parts/own.yaml, parts/shared.yaml]\n")
        settings = {**os.environ, "XDG_DATA_HOME": str(self.folder / "own"), "XDG_DATA_DIRS": str(self.folder / "shared")}
        for name, value in ("a.r", 1), ("own", 1), ("shared", 2):
            done = subprocess.run([LEKALO, "measure", "scene.yaml", name], cwd=self.folder, env=settings,
                                  capture_output=True, text=True)
            self.assertEqual(done.stdout, f"parameter '{name}'\nvalue              {value}\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
