"""Pictures of `path` against those of Blender Cycles (references/cycles, made by tools/cycles): means of 16 x 16 pixels."""

import json
import pathlib
import unittest

from exr import read_exr
from program import ProgramTest

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "references" / "cycles"
SAMPLES = 64
SHARE = 0.01  # of the light by which blocks may differ beside the noise of both
FAR = 3  # standard errors
FEW = 0.02  # of the blocks, beyond FAR by chance


class Cycles(ProgramTest):
    def block_means(self, scene, size, block):
        """Of each block, row by row: its colour and the variance of that."""
        self.run_program("render", str(scene), "--samples", SAMPLES, "--layers", "color,variance", "-o", "picture.exr",
                         "--quiet")
        planes = read_exr((self.folder / "picture.exr").read_bytes())[1]
        result = []
        for top in range(0, size[1], block):
            for left in range(0, size[0], block):
                pixels = [y * size[0] + x for y in range(top, top + block) for x in range(left, left + block)]
                result.append([(sum(planes[lane][i] for i in pixels) / block**2,
                                sum(planes[f"variance.{lane}"][i] for i in pixels) / block**4) for lane in "RGB"])
        return result

    def test_scenes(self):
        names = sorted(path.stem for path in FOLDER.glob("*.json"))
        self.assertGreaterEqual(len(names), 3)
        for name in names:
            with self.subTest(name):
                reference = json.loads((FOLDER / f"{name}.json").read_text())
                seeds = reference["seeds"]
                own = self.block_means(FOLDER / f"{name}.yaml", reference["size"], reference["block"])
                # Two pictures tell little of the noise of one block, and all blocks together much of its size.
                pairs = [(a[c], b[c]) for a, b in zip(*seeds) for c in range(3) if a[c] + b[c] > 0]
                noise = sum((a - b)**2 / (a + b)**2 for a, b in pairs) / len(pairs)
                beyond, sums = 0, [0, 0]
                for mine, one, other in zip(own, *seeds):
                    for c, (value, variance) in enumerate(mine):
                        truth = 0.5 * (one[c] + other[c])
                        error = (variance + noise * truth**2)**0.5
                        beyond += abs(value - truth) > SHARE * truth + FAR * error + 1e-6
                        sums[0] += value
                        sums[1] += truth
                self.assertLessEqual(beyond, FEW * 3 * len(own))
                self.assert_near(sums[0] / sums[1], 1, SHARE)


if __name__ == "__main__":
    unittest.main()
