"""lekalo draw -o figure.tikz: names, styles and anchors in the text; and where pdflatex is installed (texlive-latex-base,
texlive-pictures, texlive-latex-extra) figures compiled by it, compared path by path and pixel by pixel with the PDF that
the program writes itself."""

import json
import os
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as tree

from program import FILE_ERROR, LEKALO, ProgramTest, ROOT, SCENE_ERROR, USAGE

NEAR = 0.02 / 25.4 * 72  # points
FIGURES = """plate_fills machined_part plate_weights plate_csg plate_bodies plate_conics plate_knots plate_sections
    plate_surface_lines plate_quadrics viviani vase curvature_comb two_eyes torus_outline de_boor_triangle delaunay
    solids_with_dimensions lame_curves plane_cubics""".split()
NODE = re.compile(r"^\\node\[(lekalo/look-.*?),anchor=(base(?: west| east)?)(?:,rotate=([-\d.]+))?\] at \(([-\d.]+),([-\d.]+)\) ")


def has_tex():
    if shutil.which("pdflatex") is None or shutil.which("kpsewhich") is None:
        return False
    return all(subprocess.run(["kpsewhich", name], capture_output=True).returncode == 0 for name in ("tikz.sty", "standalone.cls"))


def needs_tex(test):
    return unittest.skipUnless(has_tex(), "pdflatex, tikz or standalone is not installed (texlive-latex-base, "
                               "texlive-pictures, texlive-latex-extra)")(test)


def matrix_of(text):
    if not text:
        return (1, 0, 0, 1, 0, 0)
    return tuple(float(x) for x in re.fullmatch(r"matrix\((.*)\)", text)[1].split(","))


def product(m, n):
    a, b, c, d, e, f = m
    g, h, i, j, k, l = n
    return (a * g + c * h, b * g + d * h, a * i + c * j, b * i + d * j, a * k + c * l + e, b * k + d * l + f)


def paths_of(svg):
    """Of an SVG file by pdftocairo: for each path its subpaths, as lists of points: a corner for each line, four points
    for each curve."""
    found = []
    root = tree.parse(svg).getroot()
    by_id = {element.get("id"): element for element in root.iter() if element.get("id")}

    def visit(element, matrix):
        name = element.tag.split("}")[1]
        if name == "defs":
            return
        matrix = product(matrix, matrix_of(element.get("transform")))
        if name == "use":
            # What is not opaque stands among the definitions.
            visit(by_id[element.get("{http://www.w3.org/1999/xlink}href")[1:]],
                  product(matrix, (1, 0, 0, 1, float(element.get("x", 0)), float(element.get("y", 0)))))
        # Of fills by gradients the PDF paints a box about the clip, TikZ a larger one.
        if name == "path" and "fill:url(" not in element.get("style", ""):
            found.append(subpaths(element.get("d"), matrix))
        for child in element:
            visit(child, matrix)

    visit(root, matrix_of(None))
    return [path for path in found if path]


def clips_of(svg):
    return [subpaths(clip[0].get("d"), (1, 0, 0, 1, 0, 0)) for clip in tree.parse(svg).getroot().iter()
            if clip.tag.endswith("clipPath") and len(clip)]


def subpaths(data, m):
    result, words = [], data.split()
    i = 0
    while i < len(words):
        count = {"M": 2, "L": 2, "C": 6, "Z": 0}[words[i]]
        numbers = [float(x) for x in words[i + 1:i + 1 + count]]
        points = [(m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]) for x, y in zip(numbers[::2], numbers[1::2])]
        if words[i] == "Z" and result[-1][0] != result[-1][-1]:
            result[-1].append(result[-1][0])
        elif words[i] == "M":
            result.append([points[0]])
        elif words[i] == "C":
            p = [result[-1][-1]] + points
            for s in 0.25, 0.5, 0.75, 1:
                w = ((1 - s)**3, 3 * s * (1 - s)**2, 3 * s * s * (1 - s), s**3)
                result[-1].append(tuple(sum(w[k] * p[k][c] for k in range(4)) for c in range(2)))
        else:
            result[-1] += points
        i += 1 + count
    # pdftocairo says M once more behind Z.
    return [part for part in result if len(part) > 1]


def distance_to(p, polyline):
    best = float("inf")
    for (ax, ay), (bx, by) in zip(polyline, polyline[1:]):
        dx, dy = bx - ax, by - ay
        square = dx * dx + dy * dy
        s = 0 if square == 0 else min(1, max(0, ((p[0] - ax) * dx + (p[1] - ay) * dy) / square))
        best = min(best, (p[0] - ax - s * dx)**2 + (p[1] - ay - s * dy)**2)
    return best**0.5


def difference(a, b):
    """The largest distance of two paths, subpath by subpath; they may begin elsewhere and run the other way."""
    if len(a) != len(b):
        return float("inf")
    worst = 0
    for part, other in zip(a, b):
        if len(part) != len(other) or max(abs(p[k] - q[k]) for p, q in zip(part, other) for k in range(2)) > NEAR:
            worst = max([worst] + [distance_to(p, other) for p in part] + [distance_to(p, part) for p in other])
    return worst


def ink_and_near(pgm, dots_per_millimetre):
    """How many pixels are not white, and how many lie within a millimetre of them (in both directions)."""
    magic, size, _, pixels = pgm.split(b"\n", 3)
    assert magic == b"P5"
    width, height = (int(x) for x in size.split())
    reach = round(dots_per_millimetre)
    rows = []
    for y in range(height):
        row = pixels[y * width:(y + 1) * width]
        bits = int("".join("0" if v > 250 else "1" for v in row), 2)
        for _ in range(reach):
            bits |= bits << 1 | bits >> 1
        rows.append(bits & ((1 << width) - 1))
    near = 0
    for y in range(height):
        bits = 0
        for k in range(max(0, y - reach), min(height, y + reach + 1)):
            bits |= rows[k]
        near += bin(bits).count("1")
    return near, width * height


class TikzText(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("block.yaml", """lekalo: 1
geometry: { block: { type: box, size: [2, 1, 1] } }
objects: { shape: block, name: stone, lines: { sharp: thick, hidden: dashed } }
drawing: { annotations: [{ type: point, at: [0, 0, 0], label: '$a_1$ <b>' }, { type: linear_dimension, from: [1, -0.5, -0.5], to: [1, 0.5, -0.5], along: y, offset: 5 mm, text: slant }] }
camera: { view: isometric }
image: { size: [60 mm, 40 mm] }
""")

    def test_names_and_styles(self):
        self.run_program("draw", "block.yaml", "-o", "block.tikz", "-o", "block.svg")
        text = (self.folder / "block.tikz").read_text()
        self.assertTrue(text.startswith("% TikZ picture by Lekalo"))
        self.assertRegex(text, r"\\path\[lekalo/look-\d,lekalo/sharp,lekalo/hidden,.*lekalo/name=stone-sharp-hidden")
        self.assertIn("dash pattern=on ", text)
        self.assertIn("{$a_1$ \\textless{}b\\textgreater{}}", text)
        names = re.findall(r"lekalo/name=([^\],]+)", text)
        ids = re.findall(r'id="([^"]+)"', (self.folder / "block.svg").read_text())
        self.assertEqual(len(names), len(set(names)))
        self.assertEqual([name for name in names if name not in ids], [])

    def test_anchors_are_those_of_latex(self):
        self.run_program("draw", "block.yaml", "-o", "block.tikz")
        self.run_program("draw", "block.yaml", "--latex", "-o", "over.pdf")
        nodes = [NODE.match(line) for line in (self.folder / "block.tikz").read_text().split("\n") if line.startswith("\\node")]
        puts = re.findall(r"\\put\(([\d.]+),([\d.]+)\)\{\\color.*?(?:\\rotatebox\{([\d.-]+)\}\{)?\\makebox\(0,0\)\[(\w+)\]",
                          (self.folder / "over.tex").read_text())
        self.assertEqual(len(nodes), 2)
        self.assertEqual(len(puts), 2)
        for node, (x, y, angle, side) in zip(nodes, puts):
            self.assert_near([float(node[4]), float(node[5])], [60 * float(x), 60 * float(y)], 1e-4)
            self.assert_near(float(node[3] or 0), float(angle or 0), 1e-3)
            self.assertEqual({"lb": "base west", "b": "base", "rb": "base east"}[side], node[2])

    def test_outputs(self):
        self.write("made.yaml", (self.folder / "block.yaml").read_text() + "outputs: [made.tikz, { file: narrow.tikz, width: 30 mm }]\n")
        self.assertEqual(self.run_program("draw", "made.yaml")[1], "made.tikz\nnarrow.tikz\n")
        self.assertIn("(30,", (self.folder / "narrow.tikz").read_text())

    def test_usage(self):
        self.assertIn("--standalone", self.run_program("draw", "block.yaml", "-o", "a.tex", code=USAGE)[1])
        self.assertIn("--latex", self.run_program("draw", "block.yaml", "--latex", "-o", "a.tikz", code=USAGE)[1])
        # Beside a PDF file whose texts LaTeX sets too.
        self.assertEqual(self.run_program("draw", "block.yaml", "--latex", "-o", "a.tikz", "-o", "a.pdf")[1], "a.tikz\na.pdf\na.tex\n")
        self.assertIn("are written there", self.run_program("draw", "block.yaml", "--latex", "--standalone", "-o", "b.tex", "-o", "b.pdf",
                                                            code=USAGE)[1])
        self.assertIn("# %", self.run_program("draw", "block.yaml", "-o", "a#.tikz", code=USAGE)[1])
        self.write("mine.tex", "\\documentclass{article}")
        self.assertIn("is for tikz", self.run_program("draw", "block.yaml", "--standalone", "-o", "a.svg", code=USAGE)[1])
        self.assertIn("is no TikZ picture", self.run_program("draw", "block.yaml", "--standalone", "-o", "mine.tex", code=USAGE)[1])
        self.run_program("draw", "block.yaml", "-o", "no/a.tikz", code=FILE_ERROR)
        self.write("block.yaml", (self.folder / "block.yaml").read_text().replace("slant", "'aǎ'"))
        self.assertIn("U+01CE", self.run_program("draw", "block.yaml", "-o", "a.tikz", code=SCENE_ERROR)[1])


@needs_tex
class TikzCompiled(ProgramTest):
    def compile(self, name):
        done = subprocess.run(["pdflatex", "-interaction=nonstopmode", "-halt-on-error", name], cwd=self.folder,
                              capture_output=True, text=True, errors="replace", timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout[-3000:])
        return done.stdout

    def convert(self, *arguments):
        return subprocess.run(arguments, cwd=self.folder, check=True, capture_output=True).stdout

    def test_figures_agree_with_pdf(self):
        for figure in FIGURES:
            with self.subTest(figure):
                self.compare_figure(ROOT / f"scenes/figures/{figure}.yaml")

    def compare_figure(self, scene):
        self.run_program("draw", scene, "--quiet", "--standalone", "-o", "t.tex")
        self.run_program("draw", scene, "--quiet", "--latex", "-o", "p.pdf")
        # Of the drawing itself, labels off.
        lines = (self.folder / "t.tex").read_text().split("\n")
        self.write("t.tex", "\n".join(line for line in lines if not line.startswith("\\node[lekalo")))
        self.compile("t.tex")
        for name in "t", "p":
            self.convert("pdftocairo", "-svg", f"{name}.pdf", f"{name}.svg")
            self.convert("pdftocairo", "-png", "-singlefile", "-r", "100", f"{name}.pdf", name)
        self.compare_paths()
        self.compare_pixels()

    def compare_paths(self):
        ours, left = paths_of(self.folder / "p.svg"), paths_of(self.folder / "t.svg")
        self.assertGreater(len(left), 3)
        for path in ours:
            # Almost always the first: both are written in the same order.
            twin = next((k for k in range(len(left)) if difference(path, left[k]) < NEAR), None)
            if twin is None and path is ours[0]:
                continue  # the paper, where it is white
            if twin is None and any(difference(path, clip) < NEAR for clip in clips_of(self.folder / "t.svg")):
                continue  # filled by a gradient of one colour
            self.assertIsNotNone(twin, path)
            left.pop(twin)
        self.assertEqual(len(left), 0, left[:1])

    def compare_pixels(self):
        mean = json.loads(self.run_program("compare", "p.png", "t.png", "--json", "--threshold", "1")[0])["error"]["mean"]
        near, pixels = ink_and_near(self.convert("pdftoppm", "-gray", "-singlefile", "-r", "100", "p.pdf"), 100 / 25.4)
        self.assertLess(mean * pixels / near, 0.1)

    def test_styles_of_the_document(self):
        self.write("block.yaml", "lekalo: 1\ngeometry: { block: { type: box, size: [2, 1, 1] } }\nobjects: { shape: block, lines: "
                   "{ sharp: thick, hidden: dashed } }\nimage: { size: [60 mm, 40 mm] }\n")
        self.run_program("draw", "block.yaml", "-o", "block.tikz")
        names = re.findall(r"lekalo/name=([^\],]+)", (self.folder / "block.tikz").read_text())
        self.write("doc.tex", r"""\documentclass{article}
\usepackage{tikz,amsmath,amssymb}
\begin{document}
\pagestyle{empty}
\tikzset{lekalo/hidden/.style={draw=red}, lekalo/%s/.style={draw=blue}}
\input{block.tikz}

\def\lekalowidth{30mm}\input{block.tikz}
\end{document}
""" % names[-1])
        self.compile("doc.tex")
        self.convert("pdftocairo", "-svg", "doc.pdf", "doc.svg")
        svg = (self.folder / "doc.svg").read_text()
        self.assertIn("stroke:rgb(100%,0%,0%)", svg)
        self.assertEqual(svg.count("stroke:rgb(0%,0%,100%)"), 2)
        widths = [max(p[0] for part in path for p in part) - min(p[0] for part in path for p in part)
                  for path in paths_of(self.folder / "doc.svg")]
        half = len(widths) // 2
        self.assert_near([2 * width for width in widths[half:]], widths[:half], 0.03)

    def test_labels(self):
        """Set by TeX where the scene wants them; those that overlap by TeX's sizes are told."""
        self.run_program("draw", ROOT / "scenes/figures/machined_part.yaml", "--quiet", "--standalone", "-o", "t.tex")
        text = (self.folder / "t.tex").read_text()
        names = [re.search(r"lekalo/name=([^\],]+)", line)[1] for line in text.split("\n") if line.startswith("\\node[lekalo")]
        self.assertGreater(len(names), 3)
        tell = "".join(r"\pgfpointanchor{%s}{south west}\edef\lowx{\the\pgf@x}\edef\lowy{\the\pgf@y}"
                       r"\pgfpointanchor{%s}{north east}\typeout{BOX %s \lowx,\lowy,\the\pgf@x,\the\pgf@y}" % (n, n, n) + "\n"
                       for n in names)
        text = text.replace("\\begingroup%", "\\tikzset{lekalo/name/.style={name=#1}}%\n\\begingroup%", 1)
        self.write("t.tex", text.replace("\\end{tikzpicture}", "\\makeatletter\n" + tell + "\\end{tikzpicture}"))
        os.environ["max_print_line"] = "1000"
        log = self.compile("t.tex")
        boxes = {name: [float(x) for x in numbers.replace("pt", "").split(",")]
                 for name, numbers in re.findall(r"BOX (\S+) (\S+)", log)}
        self.assertEqual(sorted(boxes), sorted(names))
        overlaps = [(a, b) for a in names for b in names if a < b and
                    all(max(boxes[a][k], boxes[b][k]) < min(boxes[a][k + 2], boxes[b][k + 2]) for k in range(2))]
        if overlaps:
            print("labels that overlap by TeX's sizes:", overlaps, file=sys.stderr)
        self.assertEqual(overlaps, [])


if __name__ == "__main__":
    unittest.main()
