"""Pictures and meshes as files: the same bits for any number of threads and after an interruption, no half files."""

import math
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time
import unittest

from program import DONE, FILE_ERROR, INTERRUPTED, LEKALO, ProgramTest, USAGE

SCENE = """
lekalo: 1
geometry:
  ring:  { type: torus_body, major_radius: 2, minor_radius: 0.6 }
  ball:  { type: ball, radius: 1 }
  block: { type: box, size: [1, 2, 3], center: [4, 0, 0] }
materials:
  shiny: { type: plastic, color: '#b5482a', roughness: 0.2 }
objects:
  - { shape: ring, material: shiny }
  - { shape: ball }
  - { shape: block }
image: { size: [64, 48], samples: 4 }
"""


FORMULAS = """
lekalo: 1
geometry:
  shell: { type: formula_surface, point: [u*cos(v), u*sin(v), sin(3*u) + 0.2*v], domain: { u: [0, 2], v: [0, 2*pi] } }
  waves: { type: implicit, formula: sin(3*x)*cos(y) - z, box: { min: [2, -1, -2], max: [4, 1, 2] } }
  cubic: { type: implicit, formula: x^3 + y^3 + z^3 - 1, ball: { radius: 2 } }
  globe: { type: sphere_surface, center: [5, 0, 0], radius: 1 }
objects: [{ shape: shell }, { shape: waves }, { shape: cubic, transform: { translate: [0, 4, 0] } }, { shape: globe }]
image: { size: [64, 48], samples: 1 }
"""


class Pictures(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("scene.yaml", SCENE)

    def render(self, *arguments, code=DONE):
        return self.run_program("render", "scene.yaml", "--quiet", *arguments, code=code)

    def test_any_number_of_threads(self):
        for threads in 1, 2:
            self.render("--threads", threads, "-o", f"{threads}.exr", "-o", f"{threads}.png")
        self.assertEqual(self.bytes_of("1.exr"), self.bytes_of("2.exr"))
        self.assertEqual(self.bytes_of("1.png"), self.bytes_of("2.png"))
        self.assertTrue(self.bytes_of("1.exr").startswith(b"\x76\x2f\x31\x01"))
        self.assertTrue(self.bytes_of("1.png").startswith(b"\x89PNG"))

    def test_formulas(self):
        """The cells that lines are met through do not depend on the threads; --stats tells of them."""
        self.write("scene.yaml", FORMULAS)
        for threads in 1, 2:
            _, notes = self.render("--threads", threads, "-o", f"{threads}.exr", "--stats")
            for method in "enclosed pieces", "implicit cells", "polynomial on the line", "closed form":
                self.assertRegex(notes, f"lines met by +{method}: 1 surface or shape, [1-9][0-9]* pieces, [0-9.]+ MiB")
        self.assertEqual(self.bytes_of("1.exr"), self.bytes_of("2.exr"))

    def test_direct_and_mesh_agree(self):
        """At a sag of 0.05 pixels; of the mean FLIP error over the picture."""
        self.render("-o", "direct.exr")
        self.write("scene.yaml", SCENE.replace(" }\n  - {", ", mesh: { sag_pixels: 0.05 } }\n  - {"))
        self.render("--representation", "mesh", "-o", "mesh.exr")
        self.assertLess(self.json_of("compare", "direct.exr", "mesh.exr", "--threshold", "1")["value"], 0.01)

    def test_default_output(self):
        _, notes = self.run_program("render", "scene.yaml")
        self.assertIn("default: ", notes)
        self.assertEqual(sorted(os.listdir(self.folder)), ["scene.png", "scene.yaml"])

    def test_outputs_are_atomic(self):
        """What cannot be written leaves nothing behind; an older file stays as it was."""
        self.assertIn("nowhere", self.render("-o", "nowhere/a.exr", code=FILE_ERROR)[1])
        self.write("old.png", "precious")
        self.write("bad.yaml", SCENE.replace("roughness: 0.2", "roughness: 'x'"))
        subprocess.run([LEKALO, "render", "bad.yaml", "-o", "old.png"], cwd=self.folder, capture_output=True)
        self.assertEqual(self.bytes_of("old.png"), b"precious")
        self.assertEqual(sorted(os.listdir(self.folder)), ["bad.yaml", "old.png", "scene.yaml"])
        self.render("-o", "old.png")
        self.assertTrue(self.bytes_of("old.png").startswith(b"\x89PNG"))
        self.assertEqual(sorted(os.listdir(self.folder)), ["bad.yaml", "old.png", "scene.yaml"])

    def test_interrupted_and_resumed(self):
        """SIGINT in the middle of a rendering; when is found from the time that all of it takes."""
        samples = ["--samples", "100", "--threads", "2"]
        begin = time.perf_counter()
        self.render(*samples, "-o", "whole.exr")
        wait = 0.6 * (time.perf_counter() - begin)
        for _ in range(6):
            (self.folder / "part.exr").unlink(missing_ok=True)  # a whole one would stay
            process = subprocess.Popen([LEKALO, "render", "scene.yaml", *samples, "-o", "part.exr"], cwd=self.folder,
                                       stderr=subprocess.PIPE, text=True)
            time.sleep(wait)
            process.send_signal(signal.SIGINT)
            _, notes = process.communicate()
            if process.returncode == INTERRUPTED:
                break
            wait *= 0.8 if process.returncode == DONE else 1.4
        self.assertEqual(process.returncode, INTERRUPTED)
        self.assertIn("--resume part.exr.partial", notes)
        self.assertNotEqual(self.bytes_of("part.exr"), self.bytes_of("whole.exr"))
        self.assertTrue((self.folder / "part.exr.partial").exists())
        shutil.copy(self.folder / "part.exr.partial", self.folder / "kept.partial")
        for resume in (["--resume"], ["--resume", "kept.partial"]):
            self.render(*samples, *resume, "-o", "part.exr")
            self.assertFalse((self.folder / "part.exr.partial").exists())
            self.assertEqual(self.bytes_of("part.exr"), self.bytes_of("whole.exr"))

    def test_resume_without_a_file_begins_where_nothing_was_kept(self):
        self.render("-o", "whole.exr")
        self.render("-o", "part.exr", "--resume")
        self.assertEqual(self.bytes_of("part.exr"), self.bytes_of("whole.exr"))

    def interrupted(self, *arguments):
        """A picture that would take for ever, stopped once its work is under way; what it said."""
        process = subprocess.Popen([LEKALO, "render", "scene.yaml", "--samples", "20000", *arguments], cwd=self.folder,
                                   stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        time.sleep(1.5)
        process.send_signal(signal.SIGINT)
        notes = process.communicate(timeout=60)[1]
        return process.returncode, notes

    def test_an_interruption_leaves_a_good_picture_alone(self):
        self.render("-o", "old.png")
        before = self.bytes_of("old.png")
        code, notes = self.interrupted("-o", "old.png", "-o", "new.exr", "--isa", "sse2")
        self.assertEqual(code, INTERRUPTED, notes)
        self.assertIn("old.png stays as it was", notes)
        self.assertEqual(self.bytes_of("old.png"), before)
        self.assertTrue((self.folder / "new.exr").exists())
        self.assertTrue(self.bytes_of("old.png.partial").startswith(b"lekalo partial 3\nsse2\0"))

    def test_resume_with_another_instruction_set_is_refused(self):
        code, notes = self.interrupted("-o", "a.exr", "--isa", "sse2")
        self.assertEqual(code, INTERRUPTED, notes)
        if "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
            self.skipTest("this processor has one instruction set")
        _, errors = self.render("--samples", "20000", "-o", "a.exr", "--resume", "a.exr.partial", "--isa", "avx2", code=FILE_ERROR)
        self.assertIn("made with the instruction set sse2, this run has avx2 (add --isa sse2", errors)

    def test_inputs_are_not_overwritten(self):
        """The scene, what it includes and reads, by whatever name; files whose names follow from an output's."""
        self.run_program("export", "scene.yaml", "ball", "-o", "ball.stl", "--quiet")
        self.render("-o", "wood.png")
        self.write("part.exr", "lekalo: 1\nmaterials: { w: { type: diffuse, color: { type: image, file: wood.png } } }\n")
        self.write("points.obj", "0, 0\n1, 1\n2, 0\n")
        self.write("all.yaml", "lekalo: 1\ninclude: part.exr\ngeometry:\n  m: { type: mesh, file: ball.stl }\n"
                   "  s: { type: polyline, points: { file: points.obj } }\n"
                   "objects: [{ shape: m, material: w }, { shape: s }]\noutputs: [wood.png]\n")
        os.link(self.folder / "all.yaml", self.folder / "all.pov")
        (self.folder / "link.png").symlink_to("wood.png")
        before = {path.name: path.read_bytes() for path in self.folder.iterdir()}
        for arguments, name in [(["render", "all.yaml"], "wood.png"), (["make", "all.yaml"], "wood.png"),
                                (["render", "all.yaml", "-o", "x.png", "-o", "./link.png"], "./link.png"),
                                (["render", "all.yaml", "-o", "part.exr"], "part.exr"),
                                (["draw", "all.yaml", "-o", self.folder / "wood.png"], "wood.png"),
                                (["export", "all.yaml", "-o", "ball.stl"], "ball.stl"),
                                (["export", "all.yaml", "-o", "points.obj"], "points.obj"),
                                (["export", "all.yaml", "--format", "stl", "-o", "all.yaml"], "all.yaml")]:
            errors = self.run_program(*arguments, code=USAGE)[1]
            self.assertIn(f"{name}' is read by the scene and would be overwritten", errors)
        self.write("f.tex", "my thesis")
        self.write("f.png.partial", "half of a song")
        self.assertIn("'f.tex' is no LaTeX file of lekalo", self.run_program("draw", "scene.yaml", "--latex", "-o", "f.pdf", code=USAGE)[1])
        self.assertIn("'f.png.partial' is no partial picture of lekalo", self.run_program("render", "scene.yaml", "-o", "f.png", code=USAGE)[1])
        self.assertEqual((self.bytes_of("f.tex"), self.bytes_of("f.png.partial")), (b"my thesis", b"half of a song"))
        (self.folder / "f.tex").unlink(), (self.folder / "f.png.partial").unlink()
        self.assertEqual({path.name: path.read_bytes() for path in self.folder.iterdir()}, before)
        for _ in range(2):  # our own are made anew
            self.run_program("draw", "scene.yaml", "--latex", "-o", "f.pdf")

    def test_what_is_not_traced_yet_ends_at_once(self):
        """SIGTERM while a mesh of millions of triangles is made, with nothing to be saved."""
        self.write("slow.yaml", "lekalo: 1\ngeometry: { s: { type: torus_body, major_radius: 2, minor_radius: 1 } }\n"
                   "objects: [{ shape: s, representation: mesh, mesh: { sag: 2e-6 } }]\n")
        process = subprocess.Popen([LEKALO, "render", "slow.yaml", "--quiet", "-o", "slow.exr"], cwd=self.folder)
        self.addCleanup(process.kill)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(5), -signal.SIGTERM)
        self.assertEqual(sorted(os.listdir(self.folder)), ["scene.yaml", "slow.yaml"])

    def test_placed_lines_end_at_once(self):
        """SIGTERM while the lines of 10^9 curves in groups in groups are looked for; balls there take no time."""
        groups = "".join(f"  g{k}: {{ type: group, of: {{ repeat: {{ i: 0..9 }}, shape: g{k - 1}, transform: {{ translate: [10^{k}*i, 0, 0] }} }} }}\n"
                         for k in range(1, 10))
        self.write("deep.yaml", "lekalo: 1\ngeometry:\n  g0: { type: group, of: [{ shape: { type: ball, radius: 0.4 } }] }\n" + groups +
                   "objects: [{ shape: g9 }]\nimage: { size: [32, 24], samples: 1 }\n")
        self.run_program("render", "deep.yaml", "--quiet", "-o", "balls.exr")
        self.write("deep.yaml", (self.folder / "deep.yaml").read_text().replace("ball, radius: 0.4", "polyline, points: [[0, 0, 0], [1, 1, 1]]"))
        process = subprocess.Popen([LEKALO, "render", "deep.yaml", "--quiet", "-o", "deep.exr"], cwd=self.folder)
        self.addCleanup(process.kill)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        self.assertEqual(process.wait(5), INTERRUPTED)

    def test_statistics_tell_the_memory(self):
        """What many objects take: the resident set grows by what is told, to a quarter."""
        self.write("many.yaml", "lekalo: 1\nparameters: { n: 1 }\ngeometry: { b: { type: ball, radius: 0.4 } }\n"
                   "objects: [{ repeat: { i: 1..n, j: 1..200 }, shape: b, transform: { translate: [i, j, 0] } }]\n"
                   "image: { size: [32, 24], samples: 1 }\n")

        def memory(n):
            """Told and resident, MiB."""
            process = subprocess.Popen([LEKALO, "render", "many.yaml", "--set", f"n={n}", "--quiet", "--stats", "-o", "many.png"],
                                       cwd=self.folder, stderr=subprocess.PIPE, text=True)
            told = process.stderr.read()
            process.stderr.close()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            self.assertEqual(process.returncode, DONE)
            return sum(map(float, re.findall("([0-9.]+) MiB", told.splitlines()[0]))), usage.ru_maxrss / 1024

        (told_of_few, few), (told, many) = memory(1), memory(500)
        self.assertLess(abs((told - told_of_few) / (many - few) - 1), 0.25)

    def test_resume_of_another_scene_is_refused(self):
        self.write("nonsense.partial", "not a partial rendering")
        _, errors = self.render("-o", "a.exr", "--resume", "nonsense.partial", code=FILE_ERROR)
        self.assertIn("nonsense.partial", errors)
        self.assertFalse((self.folder / "a.exr").exists())

    def test_exported_meshes(self):
        """Closed bodies stay closed; the mesh's volume comes near that of the bodies; PLY and OBJ keep all digits."""
        for format in "obj", "ply", "stl":
            self.run_program("export", "scene.yaml", "ball", "--sag", "1e-3", "-o", f"ball.{format}")
            self.write("back.yaml", f"lekalo: 1\ngeometry: {{ ball: {{ type: mesh, file: ball.{format} }} }}\n")
            volume = self.json_of("measure", "back.yaml", "ball")
            self.assert_near(volume["area"], 12.566370614359172, 0.03)
            self.assertTrue(volume["closed"], format)
            self.assert_near(volume["volume"], 4.1887902047863905, 0.02)
        _, note = self.run_program("export", "scene.yaml", "--format", "stl", "--sag", "0.01")
        triangles = int.from_bytes(self.bytes_of("scene.stl")[80:84], "little")
        self.assertIn(f"{triangles} triangles", note)
        self.assertEqual(len(self.bytes_of("scene.stl")), 84 + 50 * triangles)

    def test_exported_curves(self):
        """Polylines of OBJ: their corners lie on the circle, their chords keep the sag, as few as there can be."""
        self.write("rim.yaml", "lekalo: 1\ngeometry:\n  rim: { type: circle, radius: 1 }\n"
                   "  ball: { type: ball, radius: 1 }\n"
                   "objects:\n  - { shape: rim, transform: [{ scale: 2 }, { translate: [5, 0, 0] }] }\n")
        for names, radius, middle in ([], 2, 5), (["rim"], 1, 0):
            self.run_program("export", "rim.yaml", *names, "--sag", "0.01", "-o", "rim.obj")
            lines = [line.split() for line in self.bytes_of("rim.obj").decode().splitlines()]
            points = [[float(x) for x in line[1:]] for line in lines if line[0] == "v"]
            self.assertEqual([[int(i) for i in line[1:]] for line in lines if line[0] == "l"],
                             [list(range(1, len(points) + 1))])
            self.assertEqual(len(points) - 1, math.ceil(math.pi / math.acos(1 - 0.01 / radius)))
            for (x, y, _), (a, b, _) in zip(points, points[1:]):
                self.assert_near(math.hypot(x - middle, y), radius, 1e-14)
                self.assertGreaterEqual(math.hypot((x + a) / 2 - middle, (y + b) / 2), radius - 0.01 - 1e-12)
        self.run_program("export", "rim.yaml", "ball", "rim", "--sag", "0.01", "-o", "both.obj")
        lines = [line.split() for line in self.bytes_of("both.obj").decode().splitlines()]
        points = [[float(x) for x in line[1:]] for line in lines if line[0] == "v"]
        for i in next(line[1:] for line in lines if line[0] == "l"):
            self.assert_near(points[int(i) - 1][2], 0, 0)
        self.assertIn("only OBJ", self.run_program("export", "rim.yaml", "ball", "rim", "-o", "both.stl")[1])
        self.assertIn("nothing to export", self.run_program("export", "rim.yaml", "-o", "rim.stl", code=USAGE)[1])

    def test_meshes_by_angle(self):
        """The angle of an object's mesh bounds the turn of the normal along parallels and meridians, and is made use of;
        the diagonals of their cells turn by up to the root of 2 times more."""
        for angle in 10, 30:
            self.write("ball.yaml", "lekalo: 1\ngeometry: { ball: { type: sphere_surface, radius: 3 } }\n"
                       f"objects: {{ shape: ball, representation: mesh, mesh: {{ angle: {angle} }} }}\n")
            self.run_program("export", "ball.yaml", "-o", "ball.obj", "--quiet")
            lines = [line.split() for line in self.bytes_of("ball.obj").decode().splitlines()]
            points = [[float(x) for x in line[1:]] for line in lines if line[0] == "v"]
            along, diagonal = [], []
            for line in lines:
                if line[0] == "f":
                    corners = [points[int(word.split("/")[0]) - 1] for word in line[1:]]
                    for p, q in zip(corners, corners[1:] + corners[:1]):
                        cosine = sum(a * b for a, b in zip(p, q)) / 9
                        across = abs(p[2] - q[2]) > 1e-9 and abs(p[0] * q[1] - p[1] * q[0]) > 1e-9
                        (diagonal if across else along).append(math.degrees(math.acos(min(1, cosine))))
            self.assertLessEqual(max(along), angle * 1.001)
            self.assertGreater(max(along), angle / 2)
            self.assertLessEqual(max(diagonal), angle * 1.001 * math.sqrt(2))

    def test_export_of_a_finer_mesh(self):
        """Half the size of triangles costs about four times as many and a quarter of the sag."""
        def triangles(sag):
            note = self.run_program("export", "scene.yaml", "ring", "--sag", sag, "-o", "ring.stl")[1]
            return int(note.split()[-2])
        self.assertGreater(triangles("1e-3"), 2.5 * triangles("4e-3"))


if __name__ == "__main__":
    unittest.main()
