"""Drawings: which lines an SVG holds, how hidden ones look, the same bytes again, what is not made yet."""

import unittest
import xml.etree.ElementTree as tree

from program import FILE_ERROR, ProgramTest, USAGE

BLOCK = """lekalo: 1
geometry: { block: { type: box, size: [1, 2, 3] } }
objects: [{ shape: block, lines: { sharp: thick, hidden: dashed } }]
camera: { view: isometric }
image: { size: [60 mm, 80 mm] }
outputs: block.svg
"""
PATH = "{http://www.w3.org/2000/svg}path"
GROUP = "{http://www.w3.org/2000/svg}g"


class Draw(ProgramTest):
    def paths(self, name):
        """Of every class of groups its paths."""
        found = {}
        for group in tree.fromstring(self.bytes_of(name)).iter(GROUP):
            if group.get("class"):
                found.setdefault(group.get("class"), []).extend(group.findall(PATH))
        return found

    def test_a_block(self):
        """Nine edges seen, three behind, as straight lines on a sheet in millimetres."""
        self.write("block.yaml", BLOCK)
        out, errors = self.run_program("draw", "block.yaml", "--stats")
        self.assertIn("block.svg", errors)
        self.assertIn("12 lines in 12 pieces", errors)
        root = tree.fromstring(self.bytes_of("block.svg"))
        self.assertEqual((root.get("width"), root.get("height"), root.get("viewBox")), ("60mm", "80mm", "0 0 60 80"))
        paths = self.paths("block.svg")
        self.assertEqual({name: len(of) for name, of in paths.items()}, {"sharp": 9, "sharp hidden": 3})
        for path in paths["sharp"] + paths["sharp hidden"]:
            self.assertRegex(path.get("d"), r"^M[-\d. ]+ L[-\d. ]+$")
        self.assertTrue(all(path.get("stroke-dasharray") for path in paths["sharp hidden"]))
        self.assertFalse(any(path.get("stroke-dasharray") for path in paths["sharp"]))

    def test_same_bytes(self):
        self.write("block.yaml", BLOCK)
        self.run_program("draw", "block.yaml", "-o", "one.svg", "-o", "two.svg", "--quiet")
        self.run_program("draw", "block.yaml", "--quiet")
        self.assertEqual(self.bytes_of("one.svg"), self.bytes_of("two.svg"))
        self.assertEqual(self.bytes_of("one.svg"), self.bytes_of("block.svg"))

    def test_a_ring(self):
        """Two closed outlines seen from above, curved."""
        self.write("ring.yaml", """lekalo: 1
geometry: { ring: { type: torus_surface, major_radius: 3, minor_radius: 1 } }
objects: [{ shape: ring, lines: { silhouette: thick } }]
camera: { view: top }
""")
        self.run_program("draw", "ring.yaml", "--quiet")
        outlines = self.paths("ring.svg")["silhouette"]
        self.assertEqual(len(outlines), 2)
        for path in outlines:
            self.assertTrue(path.get("d").endswith(" Z"))
            self.assertIn(" C", path.get("d"))

    def test_what_is_not_made(self):
        self.write("block.yaml", BLOCK.replace("block.svg", "[block.svg, block.pdf]"))
        errors = self.run_program("draw", "block.yaml", code=FILE_ERROR)[1]
        self.assertIn("block.pdf: not made", errors)
        self.assertTrue(self.paths("block.svg"))
        self.assertIn("'x.pdf': draw writes svg", self.run_program("draw", "block.yaml", "-o", "x.pdf", code=USAGE)[1])
        self.write("labelled.yaml", BLOCK + "drawing: { annotations: [{ type: label, at: [0, 0, 0], text: 'A' }] }\n")
        self.assertIn("not in the drawing yet: annotations", self.run_program("draw", "labelled.yaml")[1])


if __name__ == "__main__":
    unittest.main()
