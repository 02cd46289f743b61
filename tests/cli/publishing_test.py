"""Figures in documents: lekalo make --list; lekalo.sty with pdflatex and lualatex, the filter of pandoc and the extension
of Sphinx, each where it is installed."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from program import FILE_ERROR, LEKALO, ProgramTest, ROOT, USAGE

RING = "lekalo: 1\nparameters: { r: 1 }\ngeometry: { c: { type: circle, radius: r } }\nimage: { size: [40 mm, 30 mm] }\n"


def has_package(name):
    return shutil.which("kpsewhich") is not None and subprocess.run(["kpsewhich", name], capture_output=True).returncode == 0


class Publishing(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("ring.yaml", RING)
        (self.folder / "bin").mkdir()
        (self.folder / "bin/lekalo").symlink_to(LEKALO)
        self.settings = {**os.environ, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "TEXINPUTS": f"{ROOT}/tools/publishing:"}

    def run_in_folder(self, *command, **options):
        done = subprocess.run(command, cwd=self.folder, env=self.settings, capture_output=True, timeout=300, **options)
        self.assertEqual(done.returncode, 0, (done.stdout + done.stderr)[-3000:].decode(errors="replace"))
        return done.stdout.decode(errors="replace")


class JobList(Publishing):
    def test_makes_what_is_missing(self):
        self.write("jobs", "draw 'ring.yaml' --quiet -o 'out/a b.pdf' --width 50\n\ndraw ring.yaml -o out/c.svg --quiet --set 'r=2'\n")
        _, said = self.run_program("make", "--list", "jobs")
        self.assertEqual(sorted(said.split("\n")), ["", "out/a b.pdf", "out/c.svg"])
        self.assertEqual(self.run_program("make", "--list", "jobs"), ("", ""))
        if shutil.which("pdfinfo"):
            size = re.search(r"Page size: *([\d.]+) x", self.run_in_folder("pdfinfo", "out/a b.pdf"))[1]
            self.assert_near(float(size), 50 / 25.4 * 72, 0.01)

    def test_errors(self):
        self.write("jobs", "draw none.yaml -o a.svg\ndraw ring.yaml -o b.svg --quiet\n")
        _, said = self.run_program("make", "--list", "jobs", code=FILE_ERROR)
        self.assertIn("lekalo draw none.yaml -o a.svg", said)
        self.assertTrue((self.folder / "b.svg").exists())
        for line, expected in ("rm -rf -o x", "jobs:1: expected draw"), ("draw ring.yaml", "has no -o"), ("draw 'ring", "not closed"):
            self.write("jobs", line + "\n")
            self.assertIn(expected, self.run_program("make", "--list", "jobs", code=USAGE)[1])
        self.assertIn("nothing", self.run_program("make", "--list", "nothing", code=FILE_ERROR)[1])
        self.write("jobs", "make --list jobs -o x.png\n")
        self.assertIn("jobs:1: a list", self.run_program("make", "--list", "jobs", code=USAGE)[1])
        self.run_program("make", code=USAGE)
        self.run_program("make", "ring.yaml", "--list", "jobs", code=USAGE)


DOCUMENT = r"""\documentclass{article}
\usepackage{lekalo}
\begin{document}
\includelekalo[set={r=0.5, r=2}, width=0.5\textwidth]{ring.yaml}
\includelekalo{none.yaml}

\begin{lekalo}[width=30mm]
# 100 % of a "scene" with \backslashes, ~ and é
lekalo: 1
geometry: { c: { type: circle, radius: 1 } }	# behind a tab
\end{lekalo}
\begin{lekalo}
lekalo: 1
info: { title: 'two' }
geometry: { c: { type: circle, radius: 2 } }
\end{lekalo}
\end{document}
"""


class Latex(Publishing):
    def compile(self, engine, *options):
        self.run_in_folder(engine, "-interaction=nonstopmode", "-halt-on-error", *options, "paper.tex")
        return (self.folder / "paper.log").read_text(errors="replace")

    def engine_test(self, engine):
        self.write("paper.tex", DOCUMENT)
        log = self.compile(engine)
        self.assertIn("3 figures are missing", log)
        inline = DOCUMENT.split("\\begin{lekalo}[width=30mm]\n")[1].split("\\end{lekalo}")[0]
        self.assertEqual(self.bytes_of("paper-lekalo-1.yaml").decode(), inline)
        jobs = (self.folder / "paper.lekalo").read_text().split("\n")[:-1]
        self.assertEqual(len(jobs), 3)
        self.assertRegex(jobs[0], r"^draw 'ring\.yaml' --quiet -o 'lekalo/[0-9A-F]{32}\.pdf' --width 60\.\d+ --set 'r=0\.5' --set 'r=2'$")
        self.run_program("make", "--list", "paper.lekalo")
        log = self.compile(engine)
        self.assertNotIn("are missing", log)
        self.assertEqual((self.folder / "paper.lekalo").read_text(), "")
        # Only what has changed is made again.
        self.write("ring.yaml", RING + "# changed\n")
        self.compile(engine)
        self.assertEqual(len((self.folder / "paper.lekalo").read_text().split("\n")), 2)

    @unittest.skipUnless(shutil.which("pdflatex") and has_package("pdftexcmds.sty"), "pdflatex is not installed")
    def test_pdflatex(self):
        self.engine_test("pdflatex")

    @unittest.skipUnless(shutil.which("lualatex") and has_package("luaotfload.sty"), "lualatex is not installed (texlive-luatex)")
    def test_lualatex(self):
        self.engine_test("lualatex")

    @unittest.skipUnless(shutil.which("pdflatex") and has_package("pdftexcmds.sty"), "pdflatex is not installed")
    def test_shell_escape(self):
        self.write("paper.tex", DOCUMENT)
        self.assertNotIn("are missing", self.compile("pdflatex", "-shell-escape"))

    @unittest.skipUnless(shutil.which("latexmk") and has_package("pdftexcmds.sty"), "latexmk is not installed")
    def test_latexmk(self):
        text = (ROOT / "docs/documents.md").read_text()
        self.write(".latexmkrc", re.search(r"```perl\n(.*?)```", text, re.DOTALL)[1])
        self.write("paper.tex", DOCUMENT)
        self.run_in_folder("latexmk", "-pdf", "-interaction=nonstopmode", "paper.tex")
        self.assertNotIn("are missing", (self.folder / "paper.log").read_text(errors="replace"))


class Others(Publishing):
    @unittest.skipUnless(shutil.which("pandoc"), "pandoc is not installed")
    def test_pandoc(self):
        self.write("paper.md", '![A ring](ring.yaml){set="r=0.5 r=2" width=84 .wide}\n\n``` {.lekalo width=60 caption="A circle"}\n'
                   + RING + "```\n")
        html = self.run_in_folder("pandoc", "--lua-filter", str(ROOT / "tools/publishing/lekalo.lua"), "paper.md", "-t", "html")
        names = re.findall(r'src="(lekalo/[0-9a-f]{40}\.svg)"', html)
        self.assertEqual(len(names), 2, html)
        self.assertIn('width="84mm"', (self.folder / names[0]).read_text())
        self.assertIn("A circle", html)
        self.assertNotIn("r=0.5", html)

    def test_sphinx(self):
        try:
            import sphinx  # noqa: F401
        except ImportError:
            self.skipTest("Sphinx (python3-sphinx) is not installed")
        self.write("conf.py", f"import sys\nsys.path.append({str(ROOT / 'tools/publishing')!r})\nextensions = ['lekalo_sphinx']\n"
                   f"exclude_patterns = ['bin']\n")
        (self.folder / "part").mkdir()
        self.write("index.rst", "Paper\n=====\n\n.. toctree::\n\n   part/one\n\n.. lekalo:: ring.yaml\n   :width: 84\n   :alt: a ring\n")
        self.write("part/one.rst", "One\n===\n\n.. lekalo::\n\n" + "".join("   " + line + "\n" for line in RING.split("\n")))
        self.run_in_folder(sys.executable, "-m", "sphinx", "-q", "-W", "-b", "html", ".", "built")
        for page in "index", "part/one":
            html = (self.folder / f"built/{page}.html").read_text()
            source = re.search(r'src="([^"]*_images/[0-9a-f]{40}\.svg)"', html)[1]
            self.assertTrue((self.folder / "built" / pathlib.Path(page).parent / source).resolve().exists())


if __name__ == "__main__":
    unittest.main()
