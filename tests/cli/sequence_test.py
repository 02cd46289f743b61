"""Pictures over and over: --frames, --watch, make; and what goes into them: --stamp, --isa."""

import os
import re
import signal
import subprocess
import time
import unittest

from exr import read_exr
from program import DONE, FILE_ERROR, INTERRUPTED, LEKALO, ProgramTest, SCENE_ERROR, USAGE

SCENE = """lekalo: 1
parameters: { tube: 0.4, lean: 0 }
geometry: { ring: { type: torus_body, major_radius: 2, minor_radius: tube, transform: { rotate: lean, axis: x } } }
image: { size: [32, 24], samples: 1 }
outputs: [ring.png, { file: out.exr }]
"""


class Sequences(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ring.yaml", SCENE)

    def render(self, *arguments, code=DONE):
        return self.run_program("render", "ring.yaml", "--quiet", *arguments, code=code)

    def names(self):
        return sorted(set(os.listdir(self.folder)) - {"ring.yaml"})

    def test_frames(self):
        """Each frame is the picture of its own value, the first and the last of the ends; angles keep their unit."""
        self.render("--frames", "tube=0.1..0.5:3")
        self.assertEqual(self.names(), [f"{name}_000{k}.{kind}" for name, kind in (("out", "exr"), ("ring", "png")) for k in (1, 2, 3)])
        for k, value in enumerate(("0.1", "0.3", "0.5"), 1):
            self.render("--set", f"tube={value}", "-o", "one.png")
            self.assertEqual(self.bytes_of("one.png"), self.bytes_of(f"ring_000{k}.png"))
        self.render("--frames", "lean=0 deg..90 deg:3", "-o", "turned.png")
        self.render("--set", "lean=90", "-o", "one.png")
        self.assertEqual(self.bytes_of("one.png"), self.bytes_of("turned_0003.png"))

    def test_shutter(self):
        """Light that grows from 0 to 1 while the shutter is open is half of it; what moves is another picture."""
        self.write("disc.yaml", """lekalo: 1
parameters: { way: 0, bright: 1 }
geometry: { disc: { type: plane, size: [2, 2], origin: [way, 0, 0] } }
objects: [{ shape: disc, material: { type: emission, strength: bright } }]
camera: { type: parallel, from: [0, 0, 5], at: [0, 0, 0], height: 4 }
image: { size: [20, 20], samples: 16, background: black }
""")
        self.run_program("render", "disc.yaml", "--shutter", "bright=0..1:3", "-o", "mean.exr", "--quiet")
        self.run_program("render", "disc.yaml", "--set", "bright=0.5", "-o", "half.exr", "--quiet")
        self.run_program("compare", "mean.exr", "half.exr", "--metric", "max", "--threshold", "1e-6")
        self.run_program("render", "disc.yaml", "--shutter", "way=-0.5..0.5:16", "-o", "moved.exr", "--quiet")
        self.run_program("compare", "moved.exr", "half.exr", "--metric", "max", "--threshold", "1e-6", code=1)
        said = self.run_program("render", "disc.yaml", "--shutter", "way=1", "-o", "no.exr", "--quiet", code=USAGE)[1]
        self.assertIn("--shutter takes NAME=A..B:N", said)
        said = self.run_program("render", "disc.yaml", "--shutter", "weg=0..1:2", "-o", "no.exr", "--quiet", code=SCENE_ERROR)[1]
        self.assertIn("--shutter weg=0..1:2: the scene has no parameter 'weg'", said)

    def test_shutter_blurs_all_layers_of_light(self):
        """Parts add up to the colour; the mean is as sure as all samples make it; mattes are refused."""
        self.write("lit.yaml", """lekalo: 1
parameters: { way: 0, bright: 1 }
geometry: { floor: { type: plane, size: [4, 4] }, ball: { type: ball, radius: 0.5, center: [way, 0, 1] } }
objects: [{ shape: floor, material: { type: diffuse, color: 0.5 } }, { shape: ball, material: { type: plastic } }]
lights: { lamp: { type: sphere_light, center: [0, -1, 4], radius: 0.5, intensity: bright, group: key } }
camera: { type: perspective, from: [0, -4, 5], at: [0, 0, 0.5] }
integrator: { type: path, photons: 1000 }
image: { size: [24, 16], samples: 64, background: black, layers: [color, direct, indirect, diffuse, specular, light_groups,
  samples, variance, normal, depth, albedo, denoised] }
""")
        self.run_program("render", "lit.yaml", "--shutter", "way=-0.7..0.7:8", "-o", "blur.exr", "--quiet")
        _, planes = read_exr(self.bytes_of("blur.exr"))
        for parts in ("direct", "indirect"), ("diffuse", "specular"), ("group.key", "group.rest"):
            for i, color in enumerate(planes["G"]):
                self.assert_near(sum(planes[f"{part}.G"][i] for part in parts), color, 1e-5)
        self.assertEqual(set(planes["samples"]), {8, 64})  # empty background takes one of each instant
        mean = lambda name, plane: sum(read_exr(self.bytes_of(name))[1][plane]) / (24 * 16)
        self.assert_near(mean("blur.exr", "denoised.G"), mean("blur.exr", "G"), 0.03 * mean("blur.exr", "G"))
        # Of a scene that does not move it is the variance of one picture of as many samples.
        self.run_program("render", "lit.yaml", "--shutter", "bright=1..1:8", "-o", "still.exr", "--quiet")
        self.run_program("render", "lit.yaml", "-o", "one.exr", "--quiet")
        one = mean("one.exr", "variance.G")
        self.assert_near(mean("still.exr", "variance.G"), one, 0.5 * one)
        said = self.run_program("render", "lit.yaml", "--shutter", "way=0..1:2", "--layers", "color,cryptomatte_object", "-o",
                                "no.exr", "--quiet", code=USAGE)[1]
        self.assertIn("'cryptomatte_object'", said)

    def test_interrupted_frames_go_on_as_told(self):
        """The change of the command that the message tells, typed in a shell: the frame ends in the same bits."""
        self.write("ring.yaml", SCENE.replace("size: [32, 24], samples: 1", "size: [32, 24], samples: 300"))
        names = ["-o", "it's one.exr", "-o", "two.png"]
        self.render("--frames", "tube=0.1..0.5:3", *names)
        whole = self.bytes_of("it's one_0002.exr"), self.bytes_of("two_0002.png")
        for name in self.names():
            (self.folder / name).unlink()
        process = subprocess.Popen([LEKALO, "render", "ring.yaml", "--frames", "tube=0.1..0.5:3", *names],
                                   cwd=self.folder, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.kill)
        while "two_0001.png" not in self.names():
            time.sleep(0.001)
        time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        notes = process.communicate()[1]
        self.assertEqual(process.returncode, INTERRUPTED)
        change, resume = re.search("the same command, (.*) in place of --frames and -o, and (.*)", notes).groups()
        subprocess.run(f"'{LEKALO}' render ring.yaml --quiet {change} {resume}", shell=True, check=True, cwd=self.folder)
        self.assertEqual((self.bytes_of("it's one_0002.exr"), self.bytes_of("two_0002.png")), whole)

    def test_wrong_frames(self):
        for frames in "tube", "tube=1:3", "tube=0.1..0.5", "tube=0.1..0.5:0", "tube=0.1..0.5:x", "=0.1..0.5:3", "tube=..1:3", "tube=(..1:3":
            self.assertIn("--frames", self.render("--frames", frames, code=USAGE)[1])
        self.assertIn("the number of frames, '2.5', is no whole number between 1 and 1000000",
                      self.render("--frames", "tube=1..2:2.5", code=USAGE)[1])
        self.assertIn("found '2.5'", self.render("--frames", "2.5", code=USAGE)[1])
        self.assertIn("did you mean 'tube'?", self.render("--frames", "tub=0.1..0.5:3", code=SCENE_ERROR)[1])
        self.assertIn("--resume", self.render("--frames", "tube=0.1..0.5:3", "--resume", "x", code=USAGE)[1])
        self.assertEqual(self.names(), [])

    def test_make_writes_all_outputs(self):
        self.run_program("make", "ring.yaml", "--quiet")
        self.assertEqual(self.names(), ["out.exr", "ring.png"])
        self.write("ring.yaml", SCENE.replace("ring.png,", "ring.png, ring.svg, { file: draft.png, kind: drawing },"))
        self.run_program("make", "ring.yaml", "--quiet")
        self.assertEqual(self.names(), ["draft.png", "out.exr", "ring.png", "ring.svg"])
        self.render()  # pictures only: nothing to complain about

    def test_stamp(self):
        """Without it no clock, host or path; SOURCE_DATE_EPOCH gives the date and leaves host and path out."""
        self.render("-o", "plain.exr")
        self.render("--stamp", "-o", "stamped.exr")
        self.assertNotIn(b"lekalo.date", self.bytes_of("plain.exr"))
        for what in b"lekalo.date", b"lekalo.host", str(self.folder).encode():
            self.assertIn(what, self.bytes_of("stamped.exr"))
        os.environ["SOURCE_DATE_EPOCH"] = "0"
        self.addCleanup(lambda: os.environ.pop("SOURCE_DATE_EPOCH"))
        for name in "a.exr", "b.exr":
            self.render("--stamp", "-o", name)
        self.assertIn(b"1970-01-01T00:00:00Z", self.bytes_of("a.exr"))
        self.assertNotIn(b"lekalo.host", self.bytes_of("a.exr"))
        self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("b.exr"))

    def test_instruction_sets(self):
        """The same bits again; and between two sets nearly the same picture."""
        for name in "a.exr", "b.exr":
            self.render("--isa", "sse2", "--threads", 2, "-o", name)
        self.assertEqual(self.bytes_of("a.exr"), self.bytes_of("b.exr"))
        self.render("--isa", "native", "-o", "native.exr")
        self.run_program("compare", "a.exr", "native.exr", "--metric", "max", "--threshold", "1e-5")
        self.assertIn("sse3", self.render("--isa", "sse3", code=USAGE)[1])

    def test_watch(self):
        """The picture is made again when the scene, an included file or a table changes, and errors do not end it."""
        self.write("points.csv", "0,0,0\n1,1,0\n2,0,1\n")
        self.write("part.yaml", "lekalo: 1\ngeometry: { line: { type: polyline, points: { file: points.csv } } }\n")
        self.write("ring.yaml", SCENE.replace("parameters", "include: part.yaml\nparameters"))
        with open(self.folder / "notes", "w") as notes:
            process = subprocess.Popen([LEKALO, "render", "ring.yaml", "--watch", "-o", "watched.exr"], cwd=self.folder, stderr=notes)
        self.addCleanup(process.kill)

        def rounds(count):
            end = time.monotonic() + 20
            while (self.folder / "notes").read_text().count("Ctrl-C ends") < count and time.monotonic() < end:
                self.assertIsNone(process.poll())
                time.sleep(0.05)
            self.assertEqual((self.folder / "notes").read_text().count("Ctrl-C ends"), count)

        rounds(1)
        self.assertIn("watching 3 files", (self.folder / "notes").read_text())
        first = self.bytes_of("watched.exr")
        self.write("ring.yaml", SCENE.replace("tube: 0.4", "tube: 0.8").replace("parameters", "include: part.yaml\nparameters"))
        rounds(2)
        self.assertNotEqual(self.bytes_of("watched.exr"), first)
        self.write("points.csv", "0,0,0\n1,1,0\n2,x,1\n")
        rounds(3)
        self.assertIn("points.csv:3:", (self.folder / "notes").read_text())
        self.write("points.csv", "0,0,0\n1,1,0\n")
        rounds(4)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(20), DONE)

    def test_watch_begins_anew_when_the_scene_changes_meanwhile(self):
        self.write("ring.yaml", SCENE.replace("size: [32, 24], samples: 1", "size: [960, 720], samples: 1000"))
        process = subprocess.Popen([LEKALO, "render", "ring.yaml", "--watch", "--quiet"], cwd=self.folder)
        self.addCleanup(process.kill)
        time.sleep(1)
        self.write("ring.yaml", SCENE)
        end = time.monotonic() + 20
        while "out.exr" not in self.names() and time.monotonic() < end:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(20), DONE)
        self.assertEqual(self.names(), ["out.exr", "ring.png"])  # nothing of the one that was given up

    def test_changes_and_interrupts_do_not_wait_for_a_tile(self):
        """A picture of one tile that takes minutes."""
        slow = SCENE.replace("size: [32, 24], samples: 1", "size: [32, 32], samples: 1048576")
        self.write("ring.yaml", slow)
        process = subprocess.Popen([LEKALO, "render", "ring.yaml", "--watch", "--quiet"], cwd=self.folder)
        self.addCleanup(process.kill)
        time.sleep(1)
        self.write("ring.yaml", SCENE)
        end = time.monotonic() + 20
        while "out.exr" not in self.names() and time.monotonic() < end:
            time.sleep(0.05)
        self.assertEqual(self.names(), ["out.exr", "ring.png"])
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(20), DONE)
        self.write("ring.yaml", slow)
        process = subprocess.Popen([LEKALO, "render", "ring.yaml", "--quiet"], cwd=self.folder, stderr=subprocess.DEVNULL)
        self.addCleanup(process.kill)
        time.sleep(1)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(20), INTERRUPTED)


if __name__ == "__main__":
    unittest.main()
