"""lekalo new: every kind of starting file is good, makes what its comments say, and is never written over a file."""

import unittest

from program import DIFFERS, FILE_ERROR, ProgramTest, USAGE


class New(ProgramTest):
    def test_picture(self):
        self.assertEqual(self.run_program("new", "ring")[0], "ring.yaml\n")
        self.run_program("check", "ring.yaml")
        self.run_program("render", "ring.yaml", "--size", "24x16", "--samples", "1", "--set", "r=1")
        self.assertTrue((self.folder / "ring.png").exists())

    def test_drawings(self):
        for kind in "drawing", "graph", "plate":
            self.run_program("new", kind, "--kind", kind)
            _, messages = self.run_program("draw", f"{kind}.yaml")
            self.assertEqual(messages, f"{kind}.svg\n{kind}.pdf\n")

    def test_suite(self):
        self.assertEqual(self.run_program("new", "kernel.yaml", "--kind", "suite")[0], "kernel.yaml\nkernel_scene.yaml\n")
        # What is missing is a picture that somebody has looked at, and the message says so.
        self.assertIn("--accept torus", self.run_program("test", "kernel.yaml", code=DIFFERS)[0])
        self.run_program("test", "kernel.yaml", "--accept", "torus", "--reason", "looked at")
        self.run_program("test", "kernel.yaml")

    def test_names(self):
        (self.folder / "figures").mkdir()
        self.run_program("new", "figures/ring.lekalo.yaml")
        text = (self.folder / "figures/ring.lekalo.yaml").read_text()
        self.assertIn("lekalo render ring.lekalo.yaml ", text)
        self.assertIn("outputs: [ring.png]", text)
        self.assertNotIn("NAME", text)
        before = self.write("old.yaml", "mine")
        self.assertIn("'old.yaml' exists", self.run_program("new", "old", code=USAGE)[1])
        self.assertEqual((self.folder / before).read_text(), "mine")
        self.assertIn("letters", self.run_program("new", "a b", code=USAGE)[1])
        self.assertIn("--kind", self.run_program("new", "a", "--kind", "film", code=USAGE)[1])
        self.run_program("new", "none/a", code=FILE_ERROR)


if __name__ == "__main__":
    unittest.main()
