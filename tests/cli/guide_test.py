"""The guides do what they say. A block of yaml, csv, json or python whose first line is `# NAME` is saved as NAME (without that
line in JSON and CSV); each line of a block of sh is run in the same folder, in order, and must end with the exit code of
its remark `# exit N`, else 0; lines of a block of text must stand in the output of the command before it."""

import json
import pathlib
import re
import subprocess
import unittest

from program import LEKALO, ProgramTest, ROOT

BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


class Guides(ProgramTest):
    def follow(self, guide):
        output = ""
        commands = set()
        for language, text in BLOCK.findall((ROOT / guide).read_text()):
            name = re.match(r"# (\S+\.(?:yaml|json|csv|py))$", text.splitlines()[0])
            if language in ("yaml", "csv", "json", "python") and name:
                path = self.folder / name[1]
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text if name[1].endswith(("yaml", "py")) else text.split("\n", 1)[1])
                if name[1].endswith("json"):
                    json.loads(path.read_text())
            elif language == "sh":
                for line in text.splitlines():
                    with self.subTest(guide=guide, line=line):
                        command, _, code = line.partition("# exit ")
                        self.assertTrue(command.startswith("lekalo "), line)
                        done = subprocess.run(f"'{LEKALO}'{command.removeprefix('lekalo')}", shell=True, cwd=self.folder,
                                              capture_output=True, text=True, timeout=100)
                        output = done.stdout + done.stderr
                        self.assertEqual(done.returncode, int(code or 0), output)
                        commands.add(command.split()[1])
            elif language == "text":
                for line in text.splitlines():
                    with self.subTest(guide=guide, line=line):
                        self.assertIn(line.strip(), output)
        return commands

    def test_regression(self):
        self.assertEqual(self.follow("docs/regression.md"), {"test"})

    def test_guide_shows_every_command(self):
        helped = self.run_program("--help")[0].split("Subcommands:")[1]
        self.assertEqual(self.follow("docs/guide.md"), set(re.findall(r"^  ([a-z]+)\b", helped, flags=re.MULTILINE)))

    def test_readme(self):
        """Its scene is what tools/run renders; the message about a slip is the program's."""
        text = (ROOT / "README.md").read_text()
        scene = BLOCK.search(text)[2]
        self.write("ring.yaml", scene)
        self.run_program("check", "ring.yaml")
        self.write("ring.yaml", scene.replace("axis: z", "axes: z"))
        message = re.search(r"^    (ring\.yaml:\d.*)$", text, flags=re.MULTILINE)[1]
        self.assertIn(message, self.run_program("check", "ring.yaml", code=3)[1])


if __name__ == "__main__":
    unittest.main()
