"""Exit codes, messages, help and the time that --version takes."""

import os
import re
import resource
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

from program import DIFFERS, FILE_ERROR, LEKALO, ProgramTest, ROOT, SCENE_ERROR, USAGE

BALL = "lekalo: 1\ngeometry: { ball: { type: ball, radius: 1 } }\n"


class Usage(ProgramTest):
    def test_version_is_quick(self):
        """The best of several runs: other work on the machine says nothing about the program."""
        times = []
        for _ in range(10):
            begin = time.perf_counter()
            out, _ = self.run_program("--version")
            times.append(time.perf_counter() - begin)
        self.assertRegex(out, r"^lekalo \d+\.\d+")
        self.assertLess(min(times), 0.1)

    def test_help_begins_with_examples(self):
        commands = re.findall(r"^  ([a-z]+)\b", self.run_program("--help")[0].split("Subcommands:")[1], flags=re.MULTILINE)
        self.assertGreaterEqual(set(commands), {"render", "check", "evaluate", "compare", "measure", "trace", "export"})
        for command in commands:
            text, _ = self.run_program(command, "--help")
            self.assertIn(f"  lekalo {command} ", text)
            self.assertLess(text.index(f"  lekalo {command} "), text.index("Usage:"), command)

    def test_wrong_usage(self):
        for arguments in [], ["paint"], ["render"], ["check", "a.yaml", "--nonsense"], ["measure", "a.yaml"]:
            self.assertIn("--help", self.run_program(*arguments, code=USAGE)[1])
        self.write("ball.yaml", BALL)
        for arguments in ["--size", "12"], ["--set", "novalue"], ["-o", "ball.tiff"], ["--crop", "0,0,1"]:
            self.assertIn(arguments[0].replace("-o", "ball.tiff"),
                          self.run_program("render", "ball.yaml", *arguments, code=USAGE)[1])

    def test_options_that_do_not_go_together(self):
        self.write("things.yaml", "lekalo: 1\ngeometry:\n  c: { type: circle, radius: 1 }\n"
                   "  t: { type: bezier_triangle, points: [[0, 1], [0, 0], [1, 0]] }\n")
        self.run_program("evaluate", "things.yaml", "t", "--uv", "0.2,0.3")
        for options in (["t", "--uv", "0.2,0.3", "--turn", "5"], ["c", "--divided-difference", "0,1", "--turn", "5"],
                        ["c", "--divided-difference", "0,1", "--placement"]):
            errors = self.run_program("evaluate", "things.yaml", *options, code=USAGE)[1]
            self.assertIn(options[1], errors)
            self.assertIn(options[3], errors)

    def test_slips_on_the_command_line(self):
        """The option or command that was meant, and the help of the right command."""
        self.write("ball.yaml", BALL + "materials: { red: { type: diffuse } }\n")
        for arguments, said in [(["render", "ball.yaml", "--sizes", "3x4"], "there is no option '--sizes' (did you mean '--size'?)"),
                                (["render", "ball.yaml", "--watsch"], "'lekalo render --help'"),
                                (["check", "ball.yaml", "other.yaml"], "there is no place for 'other.yaml'"),
                                (["evaluate", "ball.yaml", "ball"], "'lekalo evaluate --help'"),
                                (["measure", "ball.yaml", "red"], "this is a material"),
                                (["types", "nurbs"], "did you mean 'nurbs_curve', 'nurbs_of', 'nurbs_surface'?"),
                                (["render", "ball.yaml", "--size", "15360x10240"], "a picture 100 million"),
                                (["render", "ball.yaml", "--crop", "9,9,5,50"], "X0 < X1")]:
            self.assertIn(said, self.run_program(*arguments, code=USAGE)[1])
        self.assertIn("annotations", self.run_program("types", "drawing")[0])
        formulas = self.run_program("types", "formulas")[0]
        for words in ("sin(x): sine", "sum(i, a, b, formula)", "integral(x, a, b, formula)", "fresnel_s(x)", "deg, rad, turn"):
            self.assertIn(words, formulas)
        image = self.run_program("types", "image")[0]
        self.assertIn("image (texture)", image)
        self.assertIn("image (section)", image)

    def test_outputs_are_tried_before_the_work(self):
        """A picture that takes hours fails in the first second if its folder is not there."""
        self.write("ball.yaml", BALL)
        begin = time.perf_counter()
        _, errors = self.run_program("render", "ball.yaml", "--size", "8000x8000", "--samples", "4096", "-o", "a.png",
                                     "-o", "no/such/folder/b.png", code=FILE_ERROR)
        self.assertIn("no/such/folder/b.png", errors)
        self.assertLess(time.perf_counter() - begin, 5)
        self.assertEqual([path.name for path in self.folder.iterdir()], ["ball.yaml"])

    def test_what_only_drawings_show_is_said(self):
        self.write("figure.yaml", """lekalo: 1
geometry:
  c: { type: circle, radius: 1 }
  s: { type: bezier_surface, points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]] }
objects:
  - { shape: { type: group, of: { shape: c } } }
  - { shape: s, lines: { boundary: thin, silhouette: thin }, show: { control_net: {}, de_casteljau: { u: 0.5, v: 0.5 } } }
drawing: { annotations: [{ type: label, at: [0, 0, 0], text: a }] }
""")
        _, notes = self.run_program("render", "figure.yaml", "--size", "20x10")
        self.assertIn("note: not in the picture, but in drawings: lines (silhouette), helpers (de_casteljau), annotations\n", notes)
        self.write("ball.yaml", BALL)
        self.assertNotIn("note:", self.run_program("render", "ball.yaml", "--size", "20x10")[1])
        # No lines at all before a panorama, of objects in groups neither.
        around = BALL + "camera: { type: panorama, from: [0, -5, 0], at: [0, 0, 0] }\nobjects: "
        self.write("around.yaml", around + "{ shape: { type: group, of: { shape: ball, lines: { boundary: thin } } } }\n")
        _, notes = self.run_program("render", "around.yaml", "--size", "20x10")
        self.assertIn("note: not in the picture, but in drawings: lines, points and helpers", notes)
        self.write("around.yaml", around + "{ shape: ball }\n")
        self.assertNotIn("not in the picture", self.run_program("render", "around.yaml", "--size", "20x10")[1])

    def test_notes_of_what_applies(self):
        """Of panels with cameras and objects of their own no default shows, and where no picture is made none lacks."""
        scene = ("lekalo: 1\ngeometry: { b: { type: box, size: [3, 2, 1] } }\npanels: { p: { camera: { type: parallel, "
                 "view: front }, objects: { shape: b } } }\n")
        self.write("panels.yaml", scene + "outputs: panels.svg\n")
        self.assertEqual(self.run_program("make", "panels.yaml")[1], "panels.svg\n")
        self.assertEqual(self.run_program("draw", "panels.yaml")[1], "panels.svg\n")
        self.write("both.yaml", scene.replace(", objects: { shape: b }", "") + "outputs: both.svg\n")
        self.assertEqual(self.run_program("make", "both.yaml")[1],
                         "default: every entity is shown in a neutral material\nboth.svg\n")
        self.write("picture.yaml", scene + "image: { size: [20, 10] }\noutputs: [picture.svg, picture.png]\n")
        notes = self.run_program("make", "picture.yaml")[1]
        for note in ("every entity", "studio light", "three-quarter view", "not in the picture, but in drawings: panels"):
            self.assertIn(note, notes)

    def test_clear_bodies_without_shadow(self):
        scene = ("lekalo: 1\ngeometry: { b: { type: ball, center: [0, 0, 1.5], radius: 1 }, f: { type: plane, size: [9, 9] } }\n"
                 "objects: [{ shape: b, name: drop, material: { type: dielectric } }, { shape: f }]\n"
                 "lights: { sun: { type: distant_light, direction: [0.5, 0, -1] } }\n")
        said = "note: light goes straight through clear bodies, which throw no shadow ('drop')"
        for change, expected in ((("", ""), True), (("dielectric }", "dielectric, absorption: 0.5 }"), False),
                                 (("lights:", "integrator: { shadows: opaque }\nlights:"), False),
                                 ((", { shape: f }", ""), False),
                                 (("distant_light, direction: [0.5, 0, -1]", "ambient_light"), False)):
            self.write("scene.yaml", scene.replace(*change) if change[0] else scene)
            notes = self.run_program("render", "scene.yaml", "--size", "20x10", "--samples", "1")[1]
            self.assertEqual(said in notes, expected, change)

    def test_evaluation_outside_the_domain_is_said(self):
        self.write("curves.yaml", "lekalo: 1\ngeometry:\n  a: { type: bezier_curve, points: [[0, 0], [1, 1], [2, 0]] }\n"
                   "  c: { type: circle, radius: 1 }\n  s: { type: cylinder_surface, radius: 1, height: 2 }\n")
        self.assertIn("t = 3 lies outside the domain 0 to 1", self.run_program("evaluate", "curves.yaml", "a", "--at", "3")[1])
        self.assertIn("v = -1 lies", self.run_program("evaluate", "curves.yaml", "s", "--at", "9,-1")[1])
        self.assertEqual(self.run_program("evaluate", "curves.yaml", "c", "--at", "30")[1], "")

    def test_errors_of_a_scene(self):
        """All in one run, each with file, line and column, the line itself and a suggestion."""
        self.write("wrong.yaml", "lekalo: 1\ngeometry:\n  ball: { type: ball, radius: -1 }\n"
                   "  ring: { type: torus_body, major_radius: 2, minor_radius: 1, minor_radios: 3 }\n"
                   "objects:\n  - { shape: bal }\n")
        for command in ["check", "wrong.yaml"], ["measure", "wrong.yaml", "ball"], ["render", "wrong.yaml"]:
            _, errors = self.run_program(*command, code=SCENE_ERROR)
            for place in "wrong.yaml:3:31: ", "wrong.yaml:4:63: ", "wrong.yaml:6:14: ":
                self.assertIn(place, errors)
            self.assertIn("did you mean 'ball'?", errors)
            self.assertIn("  - { shape: bal }", errors)
        self.assertFalse((self.folder / "wrong.png").exists())

    def test_caps_of_meshes(self):
        """A mesh from a file knows no inside: nothing could close its cut."""
        self.write("ball.yaml", BALL)
        self.run_program("export", "ball.yaml", "ball", "--sag", "0.1", "-o", "ball.stl")
        self.write("cut.yaml", "lekalo: 1\ngeometry: { m: { type: mesh, file: ball.stl } }\n"
                   "objects: [{ shape: m, clip: [{ normal: x }, { normal: y, cap: true }] }]\n")
        errors = self.run_program("check", "cut.yaml", code=SCENE_ERROR)[1]
        self.assertIn("cut.yaml:3:63: a cap closes the cut of a body; a mesh from a file knows no inside", errors)
        self.assertIn("hint: leave out 'cap'", errors)

    def test_unreadable_files(self):
        self.assertIn("none.yaml", self.run_program("check", "none.yaml", code=FILE_ERROR)[1])
        self.write("ball.yaml", BALL)
        self.assertIn("none.csv", self.run_program("trace", "ball.yaml", "--rays", "none.csv", code=FILE_ERROR)[1])
        self.write("bad.csv", "0,0,1,0,0,x1\n")
        self.assertIn("bad.csv:1:11", self.run_program("trace", "ball.yaml", "--rays", "bad.csv", code=SCENE_ERROR)[1])
        self.assertIn("none.png", self.run_program("compare", "none.png", "none.png", code=FILE_ERROR)[1])

    def test_unknown_parameter(self):
        self.write("ball.yaml", "lekalo: 1\nparameters: { width: 1 }\ngeometry: { ball: { type: ball, radius: width } }\n")
        self.run_program("check", "ball.yaml", "--set", "width=2")
        self.assertIn("did you mean 'width'?",
                      self.run_program("check", "ball.yaml", "--set", "widht=2", code=SCENE_ERROR)[1])

    def test_errors_name_the_option(self):
        """What is wrong in a value given on the command line has no file: the option says where."""
        self.write("ball.yaml", "lekalo: 1\nparameters: { width: 1 }\ngeometry: { ball: { type: ball, radius: width } }\n")
        for option, value, said in [("--set", "widht=2", "--set widht=2: the scene has no parameter 'widht' (did you mean 'width'?)\n    widht=2\n    ^~~~~\n"),
                                    ("--set", "width=foo(1)", "--set width=foo(1): unknown function 'foo'\n    width=foo(1)\n          ^~~\n"),
                                    ("--set", "width=", "--set width=: 'width' is set to nothing"),
                                    ("--frames", "widht=1..2:3", "--frames widht=1..2:3: the scene has no parameter 'widht'"),
                                    ("--frames", "width=x..2:3", "--frames width=x..2:3: unknown name 'x'\n    width=x\n          ^\n")]:
            errors = self.run_program("render", "ball.yaml", option, value, code=SCENE_ERROR)[1]
            self.assertIn(said, errors)
            self.assertNotIn(":1:", errors)

    def test_missing_studio(self):
        """A picture without the light that the scene counts on would be black: the command says what is missing."""
        (self.folder / "bin").mkdir()
        shutil.copy(LEKALO, self.folder / "bin/lekalo")
        self.write("ball.yaml", BALL)
        command = [self.folder / "bin/lekalo", "render", "ball.yaml", "--quiet", "--size", "8x8"]
        settings = {**os.environ, "XDG_DATA_DIRS": str(self.folder)}
        done = subprocess.run(command, cwd=self.folder, env=settings, capture_output=True, text=True)
        self.assertEqual(done.returncode, FILE_ERROR)
        self.assertIn("ball.yaml: the shipped studio", done.stderr)
        self.assertIn("studio/softbox.yaml", done.stderr)
        self.assertFalse((self.folder / "ball.png").exists())
        self.write("ball.yaml", BALL + "lights: {}\n")
        self.assertEqual(subprocess.run(command, cwd=self.folder, env=settings).returncode, 0)

    def test_compare(self):
        pair = [ROOT / "tests/data/flip/ldr1_reference.png", ROOT / "tests/data/flip/ldr1_test.png"]
        same = self.json_of("compare", pair[0], pair[0], "--metric", "max")
        self.assertEqual((same["value"], same["passed"]), (0, True))
        self.assertFalse(self.json_of("compare", *pair, "--metric", "rmse", code=DIFFERS)["passed"])
        self.assertTrue(self.json_of("compare", *pair, "--metric", "rmse", "--threshold", "2")["passed"])
        self.run_program("compare", *pair, "--metric", "rmse", "--report", "report", code=DIFFERS)
        self.assertIn("<html", (self.folder / "report/index.html").read_text())

    def test_output_to_a_closed_pipe_does_not_hang(self):
        self.write("ball.yaml", BALL)
        done = subprocess.run(f"'{LEKALO}' measure ball.yaml ball --json | head -c 1", shell=True, cwd=self.folder,
                              capture_output=True, timeout=20)
        self.assertEqual(done.stdout, b"{")

    def test_lost_output_is_an_error(self):
        """/dev/full takes nothing: neither a line that waits in the buffer nor a long table passes for written."""
        self.write("ball.yaml", BALL + "lights: {}\n")
        self.write("rays.csv", "0,0,5,0,0,-1\n" * 200)
        for arguments in (["--version"], ["--help"], ["render", "--help"], ["check", "ball.yaml"], ["types"], ["schema"],
                          ["measure", "ball.yaml", "ball"], ["measure", "ball.yaml", "ball", "--json"],
                          ["trace", "ball.yaml", "--rays", "rays.csv"], ["test", "suite.yaml"]):
            if arguments[0] == "test":
                self.write("suite.yaml", "lekalo_suite: 1\ntests: [{ name: a, scene: ball.yaml, size: [8, 8], samples: 1 }]\n")
            with open("/dev/full", "w") as full:
                done = subprocess.run([LEKALO, *arguments], cwd=self.folder, stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual(done.returncode, FILE_ERROR, arguments)
            self.assertIn("lekalo: standard output: cannot write", done.stderr)

    def test_lost_messages_end_no_work(self):
        """Neither a full nor a closed standard error; what is written never lands in a picture."""
        self.write("ball.yaml", BALL)
        self.run_program("render", "ball.yaml", "--size", "8x8", "-o", "good.png")
        for closed in "2>/dev/full", "2>&-", "2>&- <&-":
            command = f"'{LEKALO}' render ball.yaml --size 8x8 -o ball.png {closed}"
            self.assertEqual(subprocess.run(command, shell=True, cwd=self.folder).returncode, 0, closed)
            self.assertEqual(self.bytes_of("ball.png"), self.bytes_of("good.png"))
            (self.folder / "ball.png").unlink()
            command = f"'{LEKALO}' check none.yaml {closed}"
            self.assertEqual(subprocess.run(command, shell=True, cwd=self.folder).returncode, FILE_ERROR, closed)
        done = subprocess.run(f"'{LEKALO}' check ball.yaml >&-", shell=True, cwd=self.folder, capture_output=True)
        self.assertEqual(done.returncode, FILE_ERROR)

    def test_a_closed_pipe_ends_quietly(self):
        """By the signal where that is not ignored, else by the error."""
        self.write("ball.yaml", BALL)
        self.write("rays.csv", "0,0,5,0,0,-1\n" * 2000)
        for arguments in "trace ball.yaml --rays rays.csv", "--version":
            for trap in "", "trap '' PIPE; ":
                done = subprocess.run(["bash", "-c", f"{trap}(sleep 0.3; exec '{LEKALO}' {arguments}) | true; "
                                       "exit ${PIPESTATUS[0]}"], cwd=self.folder, capture_output=True, text=True, timeout=20)
                self.assertEqual((done.returncode, done.stderr), (FILE_ERROR if trap else 128 + signal.SIGPIPE, ""))

    def test_bad_pictures_are_errors_of_the_scene(self):
        """Each at its place, among the others; a pipe does not hang."""
        self.write("text.png", "no picture")
        self.write("cut.png", "")
        (self.folder / "cut.png").write_bytes((ROOT / "tests/data/flip/ldr1_test.png").read_bytes()[:1000])
        os.mkfifo(self.folder / "pipe.png")
        self.write("ball.yaml", BALL + "materials:\n" + "".join(
            f"  m{k}: {{ type: diffuse, color: {{ type: image, file: {name} }} }}\n"
            for k, name in enumerate(["text.png", "cut.png", "pipe.png", "."])) + "objects: [{ shape: bal }]\n")
        begin = time.perf_counter()
        errors = self.run_program("check", "ball.yaml", code=SCENE_ERROR)[1]
        for line, said in (4, "text.png: "), (5, "cut.png: "), (6, "'pipe.png' is no regular file"), (7, "'.' is no regular file"):
            self.assertRegex(errors, f"ball.yaml:{line}:52: .*{said}")
        self.assertIn("did you mean 'ball'?", errors)
        for pair in ("pipe.png", "text.png"), ("cut.png", "pipe.png"):
            self.assertIn("cannot read: ", self.run_program("compare", *pair, code=FILE_ERROR)[1])
        self.assertLess(time.perf_counter() - begin, 10)

    def test_pictures_of_very_many_pixels_are_refused(self):
        """16384 x 16384 pixels in 33 kilobytes: found out before the memory for them is taken."""
        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
        side = 16384
        (self.folder / "large.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", side, side, 1, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(bytes(side * (side // 8 + 1)), 9)) + chunk(b"IEND", b""))
        text = chunk(b"zTXt", b"a\0\0" + zlib.compress(bytes(7 << 20), 9))
        (self.folder / "texts.png").write_bytes(
            b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 8, 8, 1, 0, 0, 0, 0)) + 300 * text +
            chunk(b"IDAT", zlib.compress(bytes(16), 9)) + chunk(b"IEND", b""))
        limit = 600 << 20

        def compared(name):
            return subprocess.run([LEKALO, "compare", name, name], cwd=self.folder, capture_output=True, text=True,
                                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        self.assertEqual(compared("texts.png").returncode, 0)
        done = compared("large.png")
        self.assertEqual(done.returncode, FILE_ERROR)
        self.assertIn("large.png: has 16384 x 16384 pixels (the file is damaged, or too large: at most 100 million", done.stderr)

    def test_numbers_of_options_are_finite(self):
        self.write("ball.yaml", BALL)
        self.write("rays.csv", "0,0,nan,0,0,-1\n")
        for arguments in (["compare", "a.png", "b.png", "--threshold", "X"], ["export", "ball.yaml", "-o", "b.stl", "--sag", "X"],
                          ["export", "ball.yaml", "-o", "b.pov", "--flatness", "X"],
                          ["measure", "ball.yaml", "ball", "--against", "ball", "--tolerance", "X"]):
            for word in "nan", "-nan", "inf", "NAN", "1e999":
                errors = self.run_program(*(word if one == "X" else one for one in arguments), code=USAGE)[1]
                self.assertIn(arguments[-2], errors)
        for arguments in (["trace", "ball.yaml", "--ray", "0,0,1/0,0,0,1"], ["evaluate", "ball.yaml", "ball", "--at", "0/0,1"],
                          ["render", "ball.yaml", "--crop", "0,0,1/0,5"]):
            errors = self.run_program(*arguments, code=USAGE)[1]
            self.assertRegex(errors, "'./0' is no finite number|is a body")
        self.assertIn("rays.csv:1:5", self.run_program("trace", "ball.yaml", "--rays", "rays.csv", code=SCENE_ERROR)[1])

    def test_large_weights_are_no_curve(self):
        """Weights of 1e14 and more draw all but a rim of a bilinear surface to its diagonal: its corners still span it."""
        points = "[[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 1]]]"
        for weight in "1e9", "1e12", "1e14", "1e20", "1e100":
            for weights in f"[[1, {weight}], [{weight}, 1]]", f"[[1, {weight}], [1, 1]]", f"[[{weight}, {weight}], [{weight}, {weight}]]":
                self.write("s.yaml", f"lekalo: 1\ngeometry: {{ s: {{ type: bezier_surface, points: {points}, weights: {weights} }} }}\n")
                self.run_program("check", "s.yaml")
        self.write("s.yaml", "lekalo: 1\ngeometry: { s: { type: bezier_surface, points: [[[0, 0, 0], [0, 1, 0]], [[0, 2, 0], [0, 3, 0]]] } }\n")
        self.assertIn("has no area", self.run_program("check", "s.yaml", code=SCENE_ERROR)[1])


if __name__ == "__main__":
    unittest.main()
