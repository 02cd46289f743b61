"""Curves and surfaces of shared libraries and programs: examples/external, and evaluators with every fault."""

import math
import os
import pathlib
import shutil
import signal
import sys
import unittest

from program import DIFFERS, FILE_ERROR, ProgramTest, ROOT, SCENE_ERROR, USAGE

EXAMPLE = pathlib.Path(os.environ["LEKALO_EXTERNAL_EXAMPLE"])
FAULTY = pathlib.Path(os.environ["LEKALO_EXTERNAL_FAULTY"])
FOLDER = ROOT / "examples/external"
TAU = "2*pi"
ALLOW = "--allow-external"


class External(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copy(FAULTY, self.folder / "faulty.so")
        shutil.copy(EXAMPLE, self.folder / "libhelicoid.so")
        shutil.copy(FOLDER / "kernel.yaml", self.folder)

    def faulty(self, function, more="", kind="external_surface", domain="{ u: [0, 1], v: [0, 1] }"):
        return self.write("scene.yaml", "lekalo: 1\ngeometry:\n  ours: { type: formula_surface, point: "
                          "[u, v, 'u*v + 0.2*sin(3*u)'], domain: { u: [0, 1], v: [0, 1] } }\n"
                          f"  theirs: {{ type: {kind}, library: faulty.so, function: {function}, domain: {domain}{more} }}\n")

    def script(self, text, arguments="", more=""):
        self.write("evaluator.py", text)
        return self.write("scene.yaml", "lekalo: 1\ngeometry:\n  theirs:\n    type: external_surface\n"
                          f"    command: ['{sys.executable}', evaluator.py{arguments}]\n"
                          f"    domain: {{ u: [0, {TAU}], v: [0, {TAU}] }}\n{more}")

    def refused(self, scene, *words, code=SCENE_ERROR):
        error = self.run_program("check", scene, ALLOW, code=code)[1]
        for word in words:
            self.assertIn(word, error)
        return error


class Allowed(External):
    def test_only_if_the_user_says_so(self):
        for command in (["check"], ["render"], ["make"], ["evaluate", "theirs", "--at", "0,0"], ["measure", "theirs"],
                        ["trace", "--ray", "0,0,5,0,0,-1"], ["export", "-o", "x.pov"]):
            error = self.run_program(command[0], "kernel.yaml", *command[1:], code=SCENE_ERROR)[1]
            self.assertIn("kernel.yaml:12:5: 'external_surface' runs code from outside the program", error)
            self.assertIn("kernel.yaml:20:5: 'external_curve' runs code from outside the program", error)
            self.assertIn("hint: if you trust this scene and what it names, add --allow-external", error)

    def test_suite(self):
        area = 2 * math.pi * (math.hypot(1, 0.25) + 0.25**2 * math.asinh(4))
        self.write("suite.yaml", "lekalo_suite: 1\ntests:\n  - { name: a, scene: kernel.yaml, size: [24, 18], samples: 1, "
                                 f"expect: {{ measure: theirs, area: {area!r}, tolerance: 1e-9 }} }}\n")
        self.run_program("test", "suite.yaml", code=SCENE_ERROR)
        self.run_program("test", "suite.yaml", ALLOW, code=DIFFERS)  # no golden picture yet
        self.run_program("test", "suite.yaml", "--accept", "a", "--reason", "new")
        self.run_program("test", "suite.yaml", ALLOW)


class Library(External):
    def test_evaluate_answers_with_the_function(self):
        theirs = self.json_of("evaluate", "kernel.yaml", "theirs", "--at", "0.7,2.1", ALLOW)
        ours = self.json_of("evaluate", "kernel.yaml", "ours", "--at", "0.7,2.1", ALLOW)
        self.assertEqual(theirs.pop("parameters"), ours.pop("parameters"))
        self.assertEqual(theirs.pop("point_type"), ours.pop("point_type"))
        for key, value in ours.items():
            self.assert_near(theirs[key], value, 1e-15)
        border = self.json_of("evaluate", "kernel.yaml", "border", "--at", "2", "--order", 2, ALLOW)
        self.assert_near(border["curvature"], 1 / 1.0625, 1e-14)

    def test_rays(self):
        ours = self.write("ours.yaml", "lekalo: 1\ngeometry: { s: { type: formula_surface, point: [u*cos(v), u*sin(v), "
                          "0.25*v], domain: { u: [-1, 1], v: [0, 2*pi] } } }\n")
        for fit, tolerance in ((1e-9, 2e-8), (1e-12, 2e-11)):
            theirs = self.write("theirs.yaml", "lekalo: 1\ngeometry: { s: { type: external_surface, library: libhelicoid.so, "
                                "function: helicoid, parameters: [0.25], domain: { u: [-1, 1], v: [0, 2*pi] }, "
                                f"tolerance: {fit} }} }}\n")
            for ray in ("0.3,0.2,5,0.1,0.05,-1", "-3,0.1,0.6,1,0.02,0.1", "0.5,-4,1,0,1,0"):
                a = self.json_of("trace", ours, "--ray", ray)["hits"]
                b = self.json_of("trace", theirs, "--ray", ray, ALLOW)["hits"]
                self.assertGreater(len(a), 0)
                self.assertEqual(len(a), len(b))
                for x, y in zip(a, b):
                    for key in ("t", "u", "v", "point", "normal"):
                        self.assert_near(x[key], y[key], tolerance)

    def test_picture(self):
        self.run_program("render", "kernel.yaml", ALLOW, "--size", "60x45", "--samples", 1, "--representation", "mesh")
        error = self.run_program("render", "kernel.yaml", ALLOW, "--size", "60x45", "--samples", 1, "--stats")[1]
        self.assertIn("note: kernel.yaml:12: rays meet a spline of degree 7 with", error)
        self.assertIn("sampled, not proven", error)

    def test_higher_derivatives_are_the_splines(self):
        scene = self.faulty("points_only", ", order: 0")
        found = self.json_of("measure", scene, "theirs", "--against", "ours", ALLOW, "--tolerance", 1e-4)
        self.assertEqual(found["deviations"][0]["maximum"], 0)
        for row in found["deviations"][1:]:
            self.assertGreater(row["maximum"], 0)

    def test_no_such_library_or_function(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n  a:\n    type: external_surface\n    library: none.so\n"
                                 "    function: f\n    domain: { u: [0, 1], v: [0, 1] }\n")
        self.refused("scene.yaml", "scene.yaml:5:14: there is no file 'none.so'")
        self.write("none.so", "not a library")
        self.refused("scene.yaml", "scene.yaml:5:14: cannot be loaded: ", "none.so", "hint: a shared library")
        shutil.copy(FAULTY, self.folder / "none.so")
        self.refused("scene.yaml", "scene.yaml:6:15: there is no function 'f' in none.so", "hint: 'nm -D")

    def test_faults(self):
        for function, *words in (
                ("returns_7_at_some", "'returns_7_at_some' returned 7 at u = 0.71875, v = 0.625, order 0"),
                ("not_a_number", "nan) at u = 0, v = 1"),
                ("forgets_duv", "the derivative duv is (nan, nan, nan) at u = 0, v = 0"),
                ("takes_a_second_parameter", "the point is (0, 0, nan) at u = 0, v = 0"),
                ("has_an_edge", "no spline comes nearer to the function than", "u = 0.3", "hint: the function is not smooth"),
                ("points_only", "'points_only' returned 1 at u = 0, v = 0, order 2"),
                ("constant", "the same point everywhere")):
            with self.subTest(function=function):
                self.refused(self.faulty(function, ", parameters: [1]"), "scene.yaml:4:", *words)
        self.refused(self.faulty("good", ", closed: true"), "the surface is not closed along u")
        self.refused(self.faulty("good", ", command: [python3]"), "'library' and 'command' exclude each other")
        self.run_program("check", self.faulty("good", ", timeout: 3"), ALLOW)

    def test_calls_are_serialized(self):
        # Meshes are shaded by the surface itself: many threads ask it.
        render = ["render", ALLOW, "--threads", 4, "--size", "80x60", "--samples", 4, "--representation", "mesh"]
        self.run_program(*render, self.faulty("one_call_at_a_time"))

    def test_fault_found_later(self):
        error = self.run_program("evaluate", self.faulty("returns_7_at_one"), "theirs", "--at", "0.123,0.5", ALLOW,
                                 code=FILE_ERROR)[1]
        self.assertEqual(error, "lekalo: 'returns_7_at_one' returned 7 at u = 0.123, v = 0.5, order 2\n")

    def test_library_that_ends_the_program(self):
        for words in (["render", "--size", "24x18", "-o", "x.png"], ["measure", "--json"]):
            scene = self.faulty("exits_at_some")
            out, error = self.run_program(words[0], scene, *(["theirs"] if words[0] == "measure" else []), *words[1:],
                                          ALLOW, code=FILE_ERROR)
            self.assertRegex(error, r"^lekalo: 'exits_at_some' ended the program at u = 0\.\d+, v = \S+\n$")
            self.assertEqual(out, "")
        self.assertEqual([path.name for path in self.folder.glob("x.png*")], [])
        for function, code, what in (("exits_at_one", FILE_ERROR, "ended the program"),
                                     ("crashes_at_one", -signal.SIGSEGV, "was ended by a signal (Segmentation fault)")):
            out, error = self.run_program("evaluate", self.faulty(function), "theirs", "--at", "0.123,0.5", ALLOW, code=code)
            self.assertEqual((out, error), ("", f"lekalo: '{function}' {what} at u = 0.123, v = 0.5\n"))
        error = self.run_program("check", self.faulty("aborts", "", "external_curve", "[0, 3]"), ALLOW,
                                 code=-signal.SIGABRT)[1]
        self.assertEqual(error, "lekalo: 'aborts' was ended by a signal (Aborted) at t = 0\n")

    def test_stuck_library_ends_the_program(self):
        """While the scene is read, later, and where the library is loaded."""
        stuck = r"^lekalo: '{}' has not returned for 0.3 s, its timeout at u = {}, v = \S+\n$"
        for words in ["check"], ["render", "-o", "x.png"]:
            error = self.run_program(words[0], self.faulty("stuck_at_some", ", timeout: 0.3"), *words[1:], ALLOW, code=FILE_ERROR)[1]
            self.assertRegex(error, stuck.format("stuck_at_some", r"0\.\d+"))
        self.assertFalse((self.folder / "x.png").exists())
        out, error = self.run_program("evaluate", self.faulty("stuck_at_one", ", timeout: 0.3"), "theirs", "--at", "0.123,0.5",
                                      ALLOW, code=FILE_ERROR)
        self.assertRegex(error, stuck.format("stuck_at_one", "0.123"))
        self.assertEqual(out, "")
        os.mkfifo(self.folder / "pipe.so")
        self.write("scene.yaml", "lekalo: 1\ngeometry: { a: { type: external_curve, library: pipe.so, function: f, domain: [0, 1] } }\n")
        self.refused("scene.yaml", "scene.yaml:2:49: 'pipe.so' is no regular file")

    def test_wrong_derivatives_are_doubted(self):
        error = self.run_program("check", self.faulty("wrong_dv"), ALLOW)[1]
        self.assertIn("warning: scene.yaml:4: dv is not the derivative of the points: (0, 1, 1.001) at u = 1", error)
        self.assertNotIn("warning: scene.yaml:4: du", error)
        scene = self.faulty("wrong_second_derivative", "", "external_curve", "[0, 3]")
        error = self.run_program("check", scene, ALLOW)[1]
        self.assertIn("d2 is not the derivative of the points", error)
        self.assertNotIn("d1 is not", error)
        self.assertNotIn("warning", self.run_program("check", self.faulty("good"), ALLOW)[1])


class Program(External):
    TORUS = (FOLDER / "torus.py").read_text()

    def test_torus(self):
        scene = self.script(self.TORUS, ", 2, 0.75", f"    closed: true\n  ours: {{ type: torus_surface, "
                            "major_radius: 2, minor_radius: 0.75, domain: { u: [0, 2*pi], v: [0, 2*pi] } }\n")
        found = self.json_of("measure", scene, "theirs", "--against", "ours", ALLOW, "--tolerance", 1e-14)
        self.assertEqual([row["quantity"] for row in found["deviations"]],
                         ["point", "du", "dv", "duu", "duv", "dvv", "normal"])
        hits = self.json_of("trace", scene, "--ray", "-5,0.1,0.2,1,0,0", ALLOW)["hits"]
        self.assertEqual(len(hits), 8)  # four of each
        for one, other in zip(hits[::2], hits[1::2]):
            self.assert_near(one["t"], other["t"], 1e-8)

    def test_faults(self):
        begin = "import sys\nfor line in sys.stdin:\n  u, v, order = line.split()\n"
        for text, *words in (
                ("import sys\nsys.exit('no licence')", "ended with exit code 1; asked for u = 0, v = 0", "it said: no licence"),
                ("import os\nos.kill(os.getpid(), 9)", "was ended by a signal: Killed"),
                (begin + "  print('1 2', flush=True)", "answered with 2 numbers in place of 3: '1 2'"),
                (begin + "  print('1 two 3', flush=True)", "answered '1 two 3', where 3 numbers are wanted"),
                (begin + "  print('error outside', flush=True)", "answered 'error outside'; asked for u = 0, v = 0"),
                (begin + "  print(u, v, 'nan', flush=True)", "the point is (0, 0, nan) at u = 0, v = 0"),
                ("print('Kernel 7.1')\n" + begin + "  print(u, v, u, flush=True)", "answered 'Kernel 7.1'"),
                (begin + "  print(u, v, u)\n  if float(u) > 3: raise ValueError(u)", "exit code 1", "it said: Traceback",
                 "ValueError: 3")):
            with self.subTest(text=text):
                self.refused(self.script(text), "scene.yaml:5:14: ", *words)

    def test_timeout(self):
        scene = self.script("import sys\nfor line in sys.stdin:\n  pass\nimport time\ntime.sleep(100)", "",
                            "    timeout: 0.3\n")
        self.refused(scene, "gave no answer for 0.3 s (it must flush each line, or the system keeps it back); asked for u = 0, v = 0")

    def test_no_such_program(self):
        scene = "lekalo: 1\ngeometry: {{ a: {{ type: external_curve, command: [{}], domain: [0, 1] }} }}\n"
        self.write("scene.yaml", scene.format("no_such_program"))
        self.refused("scene.yaml", "'no_such_program' cannot be started: No such file or directory")
        self.write("scene.yaml", scene.format("'python3 wave.py'"))
        self.refused("scene.yaml", "'python3 wave.py' cannot be started", "hint: write its words apart")
        self.write("scene.yaml", scene.format("./no_such_program"))
        self.refused("scene.yaml", "there is no program './no_such_program'")
        self.write("scene.yaml", scene.format("python3") .replace("domain", "function: f, domain"))
        self.refused("scene.yaml", "'function' belongs to a library")
        self.write("scene.yaml", "lekalo: 1\ngeometry: { a: { type: external_curve, domain: [0, 1] } }\n")
        self.refused("scene.yaml", "where the points come from is missing", "hint: write library: FILE.so")


class Against(External):
    def test_ninth_digit(self):
        scene = self.faulty("wrong_in_the_ninth_digit")
        found = self.json_of("measure", scene, "theirs", "--against", "ours", ALLOW, "--tolerance", 1e-9, code=DIFFERS)
        self.assertFalse(found["passed"])
        point = found["deviations"][0]
        self.assert_near(point["maximum"], 3e-9, 1e-15)
        self.assertEqual(point["u"], 1)
        self.assertIn("sampled, not proven", found["external"][0]["fit"])
        out = self.run_program("measure", scene, "theirs", "--against", "ours", ALLOW, "--tolerance", 1e-9, code=DIFFERS)[0]
        self.assertIn("surface 'theirs' against 'ours': 4225 places", out)
        self.assertIn("more than 1e-09", out)
        self.assertRegex(out, r"point +3e-09 +\S+ +u 1  v")
        self.run_program("measure", scene, "theirs", "--against", "ours", ALLOW, "--tolerance", 1e-8)

    def test_linear_map(self):
        self.write("scene.yaml", "lekalo: 1\ngeometry:\n"
                   "  a: { type: formula_surface, point: [u, v, u*v*v], domain: { u: [0, 1], v: [0, 1] } }\n"
                   "  b: { type: formula_surface, point: [u/3 - 1, v/2, (u/3 - 1)*(v/2)^2], "
                   "domain: { u: [3, 6], v: [0, 2] } }\n"
                   "  c: { type: formula_curve, point: [cos(t), sin(t)], domain: [0, 2*pi] }\n"
                   "  d: { type: circle, radius: 1 }\n  e: { type: circle, radius: 1.5 }\n"
                   "  p: { type: plane }\n")
        self.run_program("measure", "scene.yaml", "a", "--against", "b", "--tolerance", 1e-14)
        self.run_program("measure", "scene.yaml", "c", "--against", "d", "--tolerance", 1e-14, "--samples", 1000)
        found = self.json_of("measure", "scene.yaml", "d", "--against", "e", "--order", 1, "--tolerance", 0.6)
        self.assertEqual([row["quantity"] for row in found["deviations"]], ["point", "d1", "tangent"])
        self.assert_near([row["maximum"] for row in found["deviations"]], [0.5, 0.5, 0], 1e-15)
        for words, message in ((["a", "--against", "d"], "two curves can, or two surfaces"),
                               (["a", "--against", "p"], "its domain is not finite"),
                               (["a", "--against", "bb"], "no geometry called 'bb' (did you mean 'b'?)"),
                               (["a", "--samples", "9"], "--samples belongs to --against NAME"),
                               (["a", "--tolerance", "9"], "--tolerance belongs to --against")):
            self.assertIn(message, self.run_program("measure", "scene.yaml", *words, code=USAGE)[1])
        self.run_program("measure", "scene.yaml", "a", "--against", "none.csv", code=FILE_ERROR)


if __name__ == "__main__":
    unittest.main()
