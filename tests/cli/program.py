"""The program as tests run it: its path stands in LEKALO, every test case has a folder of its own."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEKALO = os.environ["LEKALO"]

DONE, DIFFERS, USAGE, SCENE_ERROR, FILE_ERROR, INTERRUPTED = range(6)


class ProgramTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def run_program(self, *arguments, code=DONE):
        """Runs it in the folder; the exit code must be `code`. Gives (stdout, stderr)."""
        done = subprocess.run([LEKALO, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}{done.stderr}")
        return done.stdout, done.stderr

    def json_of(self, *arguments, code=DONE):
        return json.loads(self.run_program(*arguments, "--json", code=code)[0])

    def bytes_of(self, name):
        return (self.folder / name).read_bytes()

    def assert_near(self, found, expected, tolerance):
        """Numbers or (nested) lists of them, every difference at most `tolerance`."""
        if isinstance(expected, (list, tuple)):
            self.assertEqual(len(found), len(expected))
            for a, b in zip(found, expected):
                self.assert_near(a, b, tolerance)
        else:
            self.assertLessEqual(abs(found - expected), tolerance, f"{found} is not {expected}")
