"""lekalo test: what passes and what fails, exit codes, accepting, reports, time limits."""

import os
import pathlib
import re
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree

from program import DIFFERS, FILE_ERROR, INTERRUPTED, LEKALO, ProgramTest, SCENE_ERROR, USAGE

# Golovanov 2016, 2.5: area 4 pi^2 R r, volume 2 pi^2 R r^2 of a torus with R = 3, r = 1.
SCENE = """lekalo: 1
parameters: { R: 3, r: 1 }
geometry:
  ring: { type: torus_body, major_radius: R, minor_radius: r }
  circle: { type: circle, radius: 2 }
objects: { shape: ring }
"""
SUITE = """lekalo_suite: 1
results: out
defaults: { size: [32, 24], samples: 1, compare: { metric: max, maximum: 1e-5 } }
tests:
"""


class Suites(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ring.yaml", SCENE)

    def suite(self, *tests):
        self.write("suite.yaml", SUITE + "".join(f"  - {{ {test} }}\n" for test in tests))

    def run_suite(self, *arguments, code=0):
        return self.run_program("test", "suite.yaml", *arguments, code=code)[0]

    def accept(self, *names, reason="looked right"):
        self.run_suite(*(word for name in names for word in ("--accept", name)), "--reason", reason)

    def test_a_missing_golden_fails_and_accepting_mends_it(self):
        self.suite("name: ring, scene: ring.yaml")
        out = self.run_suite(code=DIFFERS)
        self.assertIn("golden/ring.exr is missing", out)
        self.assertIn("--accept ring --reason", out)
        self.assertFalse((self.folder / "golden").exists())
        os.environ["GIT_AUTHOR_NAME"], os.environ["SOURCE_DATE_EPOCH"] = "Ada", "86400"
        self.addCleanup(lambda: [os.environ.pop(name) for name in ("GIT_AUTHOR_NAME", "SOURCE_DATE_EPOCH")])
        self.accept("ring", reason="the first one")
        self.assertEqual((self.folder / "golden/ring.txt").read_text(), "1970-01-02 Ada: the first one\n")
        self.assertIn("passed  ring", self.run_suite())
        before = self.bytes_of("golden/ring.exr")
        self.write("ring.yaml", SCENE.replace("r: 1", "r: 0.8"))
        self.assertIn("differs from golden/ring.exr", self.run_suite(code=DIFFERS))
        self.assertEqual(self.bytes_of("golden/ring.exr"), before)
        self.accept("ring", reason="thinner")
        self.run_suite()
        self.assertNotEqual(self.bytes_of("golden/ring.exr"), before)
        self.assertEqual((self.folder / "golden/ring.txt").read_text(),
                         "1970-01-02 Ada: the first one\n1970-01-02 Ada: thinner\n")
        # The golden picture holds the compared layer and nothing else.
        self.assertLess(len(self.bytes_of("golden/ring.exr")), len(self.bytes_of("out/ring.exr")) / 2)

    def test_results_never_lie_among_the_golden_pictures(self):
        """One folder under two names: the run would compare each picture with itself, and the golden one be gone."""
        self.suite("name: ring, scene: ring.yaml")
        self.run_suite(code=DIFFERS)
        self.accept("ring")
        before = self.bytes_of("golden/ring.exr")
        (self.folder / "link").symlink_to("golden")
        for golden, results in [("golden", "golden"), ("golden", "./golden/"), ("golden", "link"),
                                ("golden", self.folder / "golden"), ("none/.", "link/../none"), ("results", None)]:
            line = f"results: '{results}'" if results else "defaults: {}"
            self.write("suite.yaml", f"lekalo_suite: 1\ngolden: {golden}\n{line}\n"
                       "tests: [{ name: ring, scene: ring.yaml, size: [32, 24] }]\n")
            errors = self.run_program("test", "suite.yaml", code=SCENE_ERROR)[1]
            self.assertIn("suite.yaml:3:10: 'golden' and 'results' are one folder" if results else "suite.yaml:2:9: ", errors)
            self.assertEqual(self.bytes_of("golden/ring.exr"), before)

    def test_accepting_needs_a_test_a_picture_and_a_reason(self):
        self.suite("name: ring, scene: ring.yaml", "name: mesh, scene: ring.yaml, representation: mesh, against: ring")
        self.assertIn("run the suite first", self.run_program("test", "suite.yaml", "--accept", "ring", "--reason", "x",
                                                              code=USAGE)[1])
        self.run_suite(code=DIFFERS)
        for arguments, said in [(["--accept", "ring"], "--reason"), (["--accept", "ring", "--reason", " "], "--reason"),
                                (["--accept", "rign", "--reason", "x"], "did you mean 'ring'?"),
                                (["--accept", "mesh", "--reason", "x"], "no golden picture"),
                                (["--reason", "x"], "--accept"), (["--filter", "rong"], "did you mean 'ring'?")]:
            self.assertIn(said, self.run_program("test", "suite.yaml", *arguments, code=USAGE)[1])
        self.assertFalse((self.folder / "golden").exists())

    def test_against_another_test(self):
        self.suite("name: mesh, scene: ring.yaml, representation: mesh, against: ring, layer: depth, "
                   "compare: { metric: ssim, minimum: 0.9 }",
                   "name: same, scene: ring.yaml, against: ring", "name: other, scene: ring.yaml, set: { r: 0.5 }, against: ring",
                   "name: ring, scene: ring.yaml")
        out = self.run_suite("--filter", "[mso]*", "--jobs", 2, code=DIFFERS)
        self.assertEqual(sorted(re.findall(r"^(passed|FAILED)  (\w+)", out, re.M)),
                         [("FAILED", "other"), ("passed", "mesh"), ("passed", "same")])
        self.assertNotIn("golden", out)  # `ring` itself was not judged

    def test_expected_numbers(self):
        """Areas and volumes hold relatively, tables by distance."""
        self.write("good.csv", "t,x,y,z\n0,2,0,0\n3.141592653589793,-2,0,0\n")
        self.write("bad.csv", "t,x,y,z\n0,2,0,0\n1,2,0,0\n")
        self.suite("name: ring, scene: ring.yaml, expect: [{ measure: ring, area: 118.4352528, volume: 59.21762641, tolerance: 1e-9 }, "
                   "{ evaluate: circle, samples: good.csv, tolerance: 1e-12 }]",
                   "name: wrong, scene: ring.yaml, against: ring, expect: [{ measure: ring, area: 118.5, tolerance: 1e-9 }, "
                   "{ measure: circle, length: 12.566370614359172, tolerance: 1e-12 }, { measure: circle, area: 1, tolerance: 1 }, "
                   "{ evaluate: circle, samples: bad.csv, tolerance: 1e-12 }, { measure: rign, area: 1, tolerance: 1 }]")
        self.run_suite(code=DIFFERS)
        self.accept("ring")
        out = self.run_suite(code=DIFFERS)
        self.assertIn("passed  ring", out)
        for said in ["area of 'ring' is 118.435252813", "'circle' has no area", "bad.csv:3", "did you mean 'ring'?"]:
            self.assertIn(said, out)
        self.assertNotIn("length of", out)

    def test_exit_codes(self):
        self.suite("name: ring, scene: ring.yaml", "name: bad, scene: bad.yaml, include: late.yaml", "name: none, scene: ring.yaml, include: none.json")
        self.write("bad.yaml", SCENE.replace("{ shape: ring }", "{ shape: rong }"))
        self.write("late.yaml", "lekalo: 1\n")
        out = self.run_suite(code=SCENE_ERROR)
        self.assertIn("bad.yaml:6:19: there is no geometry called 'rong'", out)
        self.assertIn("none.json", out)
        self.suite("name: ring, scene: ring.yaml, expect: { evaluate: circle, samples: none.csv, tolerance: 1 }")
        self.assertIn("none.csv", self.run_suite(code=FILE_ERROR))
        self.suite("name: ring, scene: none.yaml")
        self.run_suite(code=SCENE_ERROR)
        self.run_program("test", "nosuite.yaml", code=FILE_ERROR)
        self.run_program("test", "ring.yaml", code=SCENE_ERROR)

    def test_a_hanging_test_ends_at_its_time_limit(self):
        self.suite("name: slow, scene: ring.yaml, samples: 1000000, time_limit: 0.3", "name: after, scene: ring.yaml, against: slow",
                   "name: quick, scene: ring.yaml")
        out = self.run_suite(code=DIFFERS)
        self.assertIn("not done after 0.3 s, its time_limit", out)
        self.assertIn("'slow', which it is compared with, made no picture", out)
        self.assertEqual(sorted(os.listdir(self.folder / "out")), ["quick.exr"])

    def start_slow(self, *more):
        """A suite under way whose first test takes for ever: the program and the process of that test."""
        self.suite("name: slow, scene: ring.yaml, samples: 1000000", *more)
        process = subprocess.Popen([LEKALO, "test", "suite.yaml"], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        end = time.monotonic() + 20
        while not children.read_text() and time.monotonic() < end:
            time.sleep(0.02)
        return process, int(children.read_text())

    def test_a_crash_fails_one_test_only(self):
        process, child = self.start_slow("name: quick, scene: ring.yaml")
        os.kill(child, signal.SIGSEGV)
        out, _ = process.communicate(timeout=60)
        self.assertEqual(process.returncode, DIFFERS)
        self.assertIn("crashed: Segmentation fault", out)
        self.assertTrue((self.folder / "out/quick.exr").exists())

    def test_interrupted(self):
        process, child = self.start_slow()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=60)
        self.assertEqual((process.returncode, errors), (INTERRUPTED, "interrupted\n"))
        self.assertFalse(pathlib.Path(f"/proc/{child}").exists())

    def test_outputs_for_people_and_programs(self):
        self.suite("name: ring, scene: ring.yaml", "name: mesh, scene: ring.yaml, set: { r: 0.5 }, against: ring")
        self.run_suite(code=DIFFERS)
        self.accept("ring", reason="first & <only>")
        self.run_suite("--report", "report", "--junit", "junit.xml", code=DIFFERS)
        page = (self.folder / "report/index.html").read_text()
        self.assertIn("first &amp; &lt;only&gt;", page)
        self.assertIn("differs from out/ring.exr", page)
        for picture in re.findall(r'src="([^"]+)"', page):
            self.assertTrue((self.folder / "report" / picture).exists(), picture)
        self.assertEqual(len(re.findall(r'src="', page)), 6)
        suite = xml.etree.ElementTree.parse(self.folder / "junit.xml").getroot()[0]
        self.assertEqual((suite.get("name"), suite.get("tests"), suite.get("failures"), suite.get("errors")), ("suite", "2", "1", "0"))
        self.assertEqual([case.get("name") for case in suite], ["ring", "mesh"])
        self.assertIn("differs", suite[1][0].get("message"))
        results = self.json_of("test", "suite.yaml", code=DIFFERS)
        self.assertEqual([(r["name"], r["passed"]) for r in results], [("ring", True), ("mesh", False)])
        self.assertNotIn("passed  ring", self.run_suite("--quiet", code=DIFFERS))

    def test_outputs_are_tried_before_the_work(self):
        self.suite("name: slow, scene: ring.yaml, samples: 1000000", "name: same, scene: ring.yaml, against: slow")
        begin = time.monotonic()
        for file, code, said in [("no/such/junit.xml", FILE_ERROR, "no/such/junit.xml"), (".", FILE_ERROR, "Is a directory"),
                                 ("suite.yaml", USAGE, "is a file of the suite"), ("./ring.yaml", USAGE, "is a file of the suite"),
                                 ("golden/slow.exr", USAGE, "is a file of the suite")]:
            self.assertIn(said, self.run_program("test", "suite.yaml", "--junit", file, code=code)[1])
        self.assertIn("ring.yaml/index.html", self.run_program("test", "suite.yaml", "--report", "ring.yaml", code=FILE_ERROR)[1])
        self.assertLess(time.monotonic() - begin, 5)
        self.assertEqual((self.folder / "ring.yaml").read_text(), SCENE)

    def test_junit_is_xml_whatever_a_name_holds(self):
        self.suite("name: ring, scene: ring.yaml")
        name = os.fsdecode("su<\xef\xbf\xbe\xff\x01>.yaml".encode("latin-1"))
        (self.folder / "suite.yaml").rename(self.folder / name)
        self.run_program("test", name, "--junit", "junit.xml", code=DIFFERS)
        self.assertEqual(xml.etree.ElementTree.parse(self.folder / "junit.xml").getroot()[0].get("name"), "su<\ufffd\ufffd\ufffd>")

    def test_same_pictures_for_any_jobs_and_threads(self):
        self.suite("repeat: { k: 1..3 }, name: ring_%k, scene: ring.yaml, set: { r: k/2 - 0.2 }")
        self.run_suite(code=DIFFERS)
        before = [self.bytes_of(f"out/ring_{k}.exr") for k in (1, 2, 3)]
        self.run_suite("--jobs", 3, "--threads", 2, code=DIFFERS)
        self.assertEqual(before, [self.bytes_of(f"out/ring_{k}.exr") for k in (1, 2, 3)])


if __name__ == "__main__":
    unittest.main()
