"""lekalo compare: exit codes, the published FLIP values (tests/data/flip/README.md), messages and the report."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

PAIRS = pathlib.Path(__file__).resolve().parents[1] / "data" / "flip"
LEKALO = os.environ["LEKALO"]


def compare(*arguments):
    return subprocess.run([LEKALO, "compare", *map(str, arguments)], capture_output=True, text=True)


class Compare(unittest.TestCase):
    def test_exit_code_says_whether_the_pictures_differ_too_much(self):
        pair = PAIRS / "ldr1_reference.png", PAIRS / "ldr1_test.png"
        self.assertEqual(compare(*pair, "--threshold", 0.113).returncode, 0)
        self.assertEqual(compare(*pair, "--threshold", 0.112).returncode, 1)
        self.assertEqual(compare(*pair).returncode, 1)
        self.assertEqual(compare(pair[0], pair[0]).returncode, 0)
        self.assertEqual(compare(*pair, "--metric", "ssim", "--threshold", 0.999).returncode, 1)

    def test_a_crop_is_compared_with_its_part_of_the_whole(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "s.yaml").write_text("lekalo: 1\ngeometry: { b: { type: ball, radius: 1 } }\nobjects: [{ shape: b }]\n"
                                           "image: { size: [40, 30], samples: 1 }\n")
            for name, crop in (("whole", []), ("part", ["--crop", "10,8,30,24"])):
                done = subprocess.run([LEKALO, "render", folder / "s.yaml", "-o", folder / f"{name}.exr", *crop], capture_output=True)
                self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(compare(folder / "whole.exr", folder / "part.exr").returncode, 0)
            found = json.loads(compare(folder / "part.exr", folder / "whole.exr", "--json").stdout)
            self.assertEqual((found["passed"], found["size"]), (True, [20, 16]))

    def test_json_has_the_published_figures(self):
        result = compare(PAIRS / "hdr1_reference.exr", PAIRS / "hdr1_test.exr", "--json")
        self.assertEqual(result.returncode, 1)
        figures = json.loads(result.stdout)
        self.assertAlmostEqual(figures["value"], 0.092986, delta=1e-4)
        self.assertAlmostEqual(figures["error"]["weighted_median"], 0.092825, delta=1e-4)
        self.assertAlmostEqual(figures["error"]["maximum"], 0.989454, delta=1e-4)
        self.assertEqual(figures["exposures"]["count"], 4)

    def test_report_is_written(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "report" / "index.html"
            compare(PAIRS / "ldr2_reference.png", PAIRS / "ldr2_test.png", "--report", page.parent)
            self.assertIn("0.12443", page.read_text())
            self.assertEqual(len(list(page.parent.iterdir())), 4)

    def test_what_is_wrong_is_said(self):
        exr = PAIRS / "hdr1_reference.exr"
        for arguments, code, message in [
            ((exr, "none.exr"), 4, "none.exr: cannot read: No such file or directory"),
            ((exr, exr, "--layer", "normal"), 4, "has no layer 'normal' (it has: color)"),
            ((exr, exr, "--metric", "mse"), 2, "mse"),
            ((exr,), 2, "b is required"),
        ]:
            result = compare(*arguments)
            self.assertEqual(result.returncode, code, result.stderr)
            self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
