"""The figures of scenes/figures and the features of scenes/drawing: each is listed, draws without a word of warning, and independent readers take it."""

import pathlib
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree as tree

import yaml

from program import ProgramTest

SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes"
FIGURES = SCENES / "figures"
FEATURES = SCENES / "drawing"
# How many figures the sources have.
NUMBERS = {"golovanov": 312, "zavyalov_splines": 64, "zavyalov_visualisation": 21, "korotkij": 8, "coursework": 22}


class Figures(ProgramTest):
    def test_index(self):
        for folder in (FIGURES, FEATURES):
            listed = [figure["file"] for figure in yaml.safe_load((folder / "index.yaml").read_text())["figures"]]
            self.assertEqual(sorted(listed), sorted(path.name for path in folder.glob("*.yaml") if path.name != "index.yaml"))

    def test_all(self):
        for path in sorted([*FIGURES.glob("*.yaml"), *FEATURES.glob("*.yaml")]):
            if path.name == "index.yaml":
                continue
            with self.subTest(path.name):
                name = path.stem
                _, errors = self.run_program("draw", str(path), "-o", f"{name}.svg", "-o", f"{name}.pdf")
                self.assertNotIn("warning", errors)
                self.assertNotIn("note", errors)
                root = tree.fromstring(self.bytes_of(f"{name}.svg"))
                paths = [one for one in root.iter("{http://www.w3.org/2000/svg}path")]
                self.assertGreater(len(paths), 3 if path.parent == FIGURES else 0)
                for command in (["rsvg-convert", f"{name}.svg", "-o", f"{name}.png"],
                                ["pdftoppm", "-r", "50", "-png", f"{name}.pdf", name]):
                    done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True)
                    self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_of_sources(self):
        """scenes/figures/<source>/: a figure says in `info` which of the source it is, and the ids of what it shows."""
        ids = {name: {row["id"] for row in source["capabilities"]}
               for name, source in yaml.safe_load((SCENES.parent / "docs/capabilities.yaml").read_text()).items()}
        for path in sorted(FIGURES.glob("*/*.yaml")):
            with self.subTest(f"{path.parent.name}/{path.name}"):
                info = yaml.safe_load(path.read_text())["info"]
                self.assertTrue(info["title"] and info["figure"] and info["shows"])
                self.assertEqual(set(info["shows"]) - ids[path.parent.name], set())
                _, errors = self.run_program("draw", str(path), "-o", "figure.svg")
                self.assertNotIn("warning", errors)
                self.assertNotIn("note", errors)
                paths = tree.fromstring(self.bytes_of("figure.svg")).iter("{http://www.w3.org/2000/svg}path")
                self.assertGreater(len(list(paths)), 2)

    def test_numbers(self):
        """docs/figures.yaml: every number of the sources, and the scene that draws it; a scene that names a number is listed."""
        listed = yaml.safe_load((SCENES.parent / "docs/figures.yaml").read_text())
        self.assertEqual({name: len({row["figure"] for row in rows}) for name, rows in listed.items()}, NUMBERS)
        for name, rows in listed.items():
            for row in rows:
                with self.subTest(f"{name} {row['figure']}"):
                    self.assertTrue(row["title"])
                    self.assertFalse("scene" in row and "not_ours" in row)
                    if "scene" in row:
                        self.assertTrue((FIGURES / row["scene"]).is_file())
            scenes = {row["figure"]: row.get("scene", "") for row in rows}
            for path in sorted((FIGURES / name).glob("*.yaml")):
                for number in str(yaml.safe_load(path.read_text())["info"]["figure"]).split(", "):
                    with self.subTest(f"{name}/{path.name}", number=number):
                        self.assertTrue(scenes.get(number, "composed"), f"docs/figures.yaml has no scene for {number}")

    def test_pictures_of_reference(self):
        """Each picture that the reference shows is there, and shows something; none is left over."""
        reference = SCENES.parent / "docs/reference"
        shown = {name for page in reference.glob("*.md") for name in re.findall(r"\(images/([\w.]+)\)", page.read_text())}
        self.assertEqual(shown, {path.name for path in (reference / "images").iterdir()}, "run tools/figures reference")
        for name in shown:
            with self.subTest(name):
                if name.endswith(".png"):
                    self.assertGreater((reference / "images" / name).stat().st_size, 2000, "all of one colour")
                    continue
                paths = tree.parse(reference / "images" / name).iter("{http://www.w3.org/2000/svg}path")
                self.assertGreater(len(list(paths)), 0)

    def test_pages_of_the_gallery(self):
        """Each page shows the pictures and scenes of its chapter, and no picture is left over."""
        gallery, pictures = SCENES.parent / "docs/gallery", set()
        for name, chapter in yaml.safe_load((gallery / "index.yaml").read_text()).items():
            page = (gallery / f"{name}.md").read_text()
            self.assertEqual(re.findall(r"!\[\]\((\S+)\.svg\)", page), [figure.split("/")[1] for figure in chapter["figures"]])
            for link in re.findall(r"\]\(([^)]+)\)", page):
                self.assertTrue((gallery / link).exists(), link)
            pictures |= {pathlib.Path(figure).name + ".svg" for figure in chapter["figures"]}
        self.assertEqual(pictures, {path.name for path in gallery.glob("*.svg")}, "run tools/figures gallery")

    def test_slips_on_the_command_line_of_the_script(self):
        """An option that there is not makes no folder of its name."""
        done = subprocess.run([SCENES.parent / "tools/figures", "--atlas"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2)
        self.assertIn("--atlas", done.stderr)
        self.assertFalse((self.folder / "--atlas").exists())

    def test_bezier_construction(self):
        """The words of the figure can be found in its PDF."""
        self.run_program("draw", str(FIGURES / "bezier_construction.yaml"), "-o", "b.pdf", "--quiet")
        words = subprocess.run(["pdftotext", "b.pdf", "-"], cwd=self.folder, capture_output=True, text=True).stdout
        self.assertIn("r(0.4)", words)
        fonts = subprocess.run(["pdffonts", "b.pdf"], cwd=self.folder, capture_output=True, text=True).stdout
        self.assertIn("CMUSerif-Bold", fonts)

    def test_chromium(self):
        """A browser opens the drawings without complaint, where it is installed, and shows something of each."""
        if not shutil.which("chromium"):
            self.skipTest("chromium is not installed")
        blank = None
        self.write("blank.svg", '<svg xmlns="http://www.w3.org/2000/svg" width="10mm" height="10mm"/>')
        for path in [self.folder / "blank.svg", *sorted(set(FIGURES.glob("*.yaml")) - {FIGURES / "index.yaml"})[:40:8]]:
            with self.subTest(path.name):
                if path.suffix == ".yaml":
                    self.run_program("draw", str(path), "-o", f"{path.stem}.svg", "--quiet")
                done = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                                       "--window-size=900,900", "--enable-logging=stderr",
                                       f"--screenshot={self.folder}/browser.png", f"file://{self.folder}/{path.stem}.svg"],
                                      cwd=self.folder, capture_output=True, text=True, timeout=60)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("CONSOLE", done.stderr)
                picture = self.bytes_of("browser.png")
                blank = blank or picture
                self.assertTrue(path.suffix == ".svg" or len(picture) > 2 * len(blank))

    def test_latex(self):
        """pdflatex takes the texts of a drawing, where it is installed."""
        try:
            subprocess.run(["pdflatex", "--version"], capture_output=True, check=True)
        except FileNotFoundError:
            self.skipTest("pdflatex is not installed")
        self.run_program("draw", str(FIGURES / "basis_functions.yaml"), "-o", "basis.pdf", "--latex", "--quiet")
        labels = ("a_b^c ^^5cinput{x} <x> | # & 50\\,\\%% \\textbf{d_e $f_g$} 90° ≤ α × ⌀ ℝ ∞",
                  "$x''^2_{\\text{a_b}} \\degree 90° ≤ αx ∈ ℝ² \\bm{r} \\div v \\tfrac12 − \\left\\langle x\\right\\rangle$")
        self.write("labels.yaml", "lekalo: 1\ngeometry: { c: { type: circle, radius: 1 } }\ndrawing:\n  annotations:\n" + "".join(
            f"    - {{ type: label, at: [0, {i}/2], text: '{text}' }}\n" for i, text in enumerate(labels)))
        self.run_program("draw", "labels.yaml", "-o", "a_b c~^^5c&.pdf", "--latex", "--quiet")
        (self.folder / "a_b c~^^5c&.tex").rename(self.folder / "labels.tex")
        self.write("document.tex", "\\documentclass{article}\\usepackage{graphicx,color,amsmath,amssymb}\\begin{document}"
                   "\\input{basis.tex}\\input{labels.tex}\\end{document}\n")
        done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "document.tex"],
                              cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout[-2000:])


if __name__ == "__main__":
    unittest.main()
