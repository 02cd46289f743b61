"""lekalo check --json: always a valid document with stable keys, and the same findings as the text output, on the
broken files of the fuzzer's corpus and on scenes of the repository with one slip each."""

import json
import random
import re
import subprocess
import unittest

from program import DONE, FILE_ERROR, LEKALO, ProgramTest, ROOT, SCENE_ERROR

KEYS = ["severity", "file", "line", "column", "length", "message", "hint", "replacement", "notes", "included_from"]
SHOWN = 100  # findings that the text shows


def position(place):
    if place["file"] is None:
        return ""
    if place["line"] is None or place["file"].startswith("--"):
        return f"{place['file']}: "
    return f"{place['file']}:{place['line']}:{place['column']}: "


def text_of(found):
    """As the text output says it, without the lines of the scene."""
    kind = "" if found["severity"] == "error" else found["severity"] + ": "
    lines = [position(found) + kind + found["message"]]
    if found["hint"] is not None:
        lines.append("hint: " + found["hint"])
    for note in found["notes"]:
        lines += text_of(note)
    for place in found["included_from"] if found["severity"] == "error" else []:
        lines.append(position(place) + "note: included from here")
    return lines


def slips(text, random_numbers):
    """The text with a letter of a word gone, two exchanged, or a line cut."""
    code = re.sub(r"#.*", lambda comment: " " * len(comment[0]), text)
    words = list(re.finditer(r"[a-z_]{4,}", code))
    word = random_numbers.choice(words)
    i = random_numbers.randrange(word.start(), word.end() - 1)
    yield text[:i] + text[i + 1:]
    yield text[:i] + text[i + 1] + text[i] + text[i + 2:]
    yield text[:i]


class CheckJson(ProgramTest):
    def both(self, path):
        command = [LEKALO, "check", path]
        plain = subprocess.run(command, cwd=self.folder, capture_output=True, timeout=60)
        done = subprocess.run(command + ["--json"], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, plain.returncode, path)
        self.assertEqual(done.stderr, b"", path)
        report = json.loads(done.stdout.decode("utf-8"))
        self.assertEqual(list(report)[:4], ["file", "good", "diagnostics", "more"])
        self.assertEqual(report["good"], done.returncode == DONE)
        for found in report["diagnostics"]:
            self.assertEqual(list(found), KEYS)
        expected = [line for found in report["diagnostics"][:SHOWN] for line in text_of(found)]
        more = report["more"] + max(0, len(report["diagnostics"]) - SHOWN)
        expected += [f"and {more} more"] if more else []
        text = plain.stderr.decode("utf-8", "replace")
        shown = [line for line in text.split("\n")[:-1] if not line.startswith("    ")]
        if not any("\n" in line for line in expected):
            self.assertEqual(shown, expected, path)
        return report

    def test_corpus_of_broken_files(self):
        broken = 0
        for path in sorted((ROOT / "tests/fuzz/corpus/reader").iterdir()):
            broken += not self.both(path)["good"]
        self.assertGreater(broken, 60)

    def test_scenes_with_slips(self):
        random_numbers = random.Random(39)
        broken = 0
        for path in sorted((ROOT / "scenes/figures/golovanov").glob("*.yaml")) * 3:
            for text in slips(path.read_text(), random_numbers):
                broken += not self.both(self.write(path.name, text))["good"]
                if broken >= 140:
                    return
        self.fail(f"only {broken} scenes are broken")

    def test_place_and_replacement(self):
        """What is proposed stands where the place says: with it put there the error is gone."""
        text = ("lekalo: 1\ninfo: { title: 'Élan é', shosw: ['2.3a'] }\nparameters: { width: 1 }\ngeometry:\n  ball: { type: bal, radius: widht }\n"
                "  ring: { type: torus_body, major_radius: 2, minor_radios: 1 }\n  dot: { type: ball, radius: 1 + sni(2) }\n"
                "objects:\n  - { shape: rign, material: 'coper' }\nmaterials: { copper: { type: diffuse, color: gren } }\n")
        before = None
        while True:
            report = self.both(self.write("slips.yaml", text))
            if before is not None:
                self.assertNotIn(before, [found["message"] for found in report["diagnostics"]])
            if report["good"]:
                break
            found = report["diagnostics"][0]
            before = found["message"]
            self.assertIsNotNone(found["replacement"], before)
            lines = text.split("\n")
            line, column = lines[found["line"] - 1], found["column"] - 1
            lines[found["line"] - 1] = line[:column] + found["replacement"] + line[column + found["length"]:]
            text = "\n".join(lines)

    def test_good_scene(self):
        self.write("ball.yaml", "lekalo: 1\ngeometry: { ball: { type: ball, radius: 1 } }\n")
        report = self.json_of("check", "ball.yaml")
        self.assertEqual(report, {"file": "ball.yaml", "good": True, "diagnostics": [], "more": 0, "entities": 1,
                                  "objects": report["objects"], "lights": report["lights"]})

    def test_errors_without_a_line(self):
        report = self.json_of("check", "none.yaml", code=FILE_ERROR)
        self.assertEqual((report["diagnostics"][0]["file"], report["diagnostics"][0]["line"]), ("none.yaml", None))
        (self.folder / "bytes.yaml").write_bytes(b"lekalo: 1\ngeometry: { a: { type: \xff\xfe } }\n")
        self.assertFalse(self.json_of("check", "bytes.yaml", code=SCENE_ERROR)["good"])
        self.write("ball.yaml", "lekalo: 1\nparameters: { r: 1 }\ngeometry: { ball: { type: ball, radius: r } }\n")
        report = self.json_of("check", "ball.yaml", "--set", "s=2", code=SCENE_ERROR)
        self.assertEqual(report["diagnostics"][0]["file"], "--set s=2")

    def test_notes_and_inclusions(self):
        self.write("part.yaml", "lekalo: 1\ngeometry: { a: { type: ball, radius: 1 }, a: { type: ball, radius: 1 } }\n")
        self.write("all.yaml", "lekalo: 1\ninclude: part.yaml\n")
        found = self.both("all.yaml")["diagnostics"]
        self.assertTrue(any(one["notes"] for one in found), found)
        self.assertTrue(all(one["included_from"][0]["line"] == 2 for one in found if one["file"] == "part.yaml"), found)


if __name__ == "__main__":
    unittest.main()
