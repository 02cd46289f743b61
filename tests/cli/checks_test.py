"""The numbers that the sources give: tests/data/checks/<source>/<section>.yaml, each by a command on a scene.

A file holds a scene, inline or by its path, and its checks:

  section: '2.2'                    of the source, the file's folder
  scene: |                          or scene: scenes/figures/...yaml
    lekalo: 1
    geometry: ...
  checks:
    - { says: radius of curvature of the helix, run: evaluate helix --at 1, value: radius_of_curvature, is: 2.5, within: 1e-14 }

`value` is the path in the JSON output, with numbers for members of lists: derivatives.0.1; `is` a number, a list, a word or true or false.
`within` is the largest difference, relative to the number where that is above 1 (left out: exact but for 4 last places). `set`
gives parameters, `exit` another exit code than 0, whose message then holds `message`.
"""

import unittest

import yaml

from program import ProgramTest, ROOT

CHECKS = ROOT / "tests/data/checks"


def member(value, path):
    for key in path.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def numbers(value):
    if isinstance(value, list):
        return [x for one in value for x in numbers(one)]
    return [float(value)]


class Checks(ProgramTest):
    def output(self, scene, check, known):
        """What the command prints: once for all checks of a scene that ask for it."""
        command, *rest = check["run"].split()
        arguments = (command, scene, *rest, *(f"--set={name}={value}" for name, value in check.get("set", {}).items()))
        if arguments not in known:
            known[arguments] = (self.run_program(*arguments, code=check["exit"])[1] if "message" in check
                                else self.json_of(*arguments))
        return known[arguments]

    def check(self, scene, check, known):
        output = self.output(scene, check, known)
        if "message" in check:
            self.assertIn(check["message"], output)
            return
        found = member(output, check["value"])
        expected = check["is"]
        if isinstance(expected, (str, bool)):
            self.assertEqual(found, expected)
            return
        found, expected = numbers(found), numbers(expected)
        self.assertEqual(len(found), len(expected))
        for a, b in zip(found, expected):
            self.assertLessEqual(abs(a - b), float(check.get("within", 1e-15)) * max(1, abs(b)), f"{a!r} is not {b!r}")

    def test_all(self):
        files = sorted(CHECKS.glob("*/*.yaml"))
        for path in files:
            data = yaml.safe_load(path.read_text())
            scene = data["scene"]
            if "\n" in scene:
                scene = f"{path.parent.name}_{path.stem}.yaml"
                self.write(scene, data["scene"])
            else:
                scene = ROOT / scene
            known = {}
            for check in data["checks"]:
                with self.subTest(f"{path.parent.name} {data['section']}: {check['says']}"):
                    self.check(scene, check, known)


if __name__ == "__main__":
    unittest.main()
