"""docs/capabilities.yaml: every capability of the sources has its row, and what a row names is there."""

import re
import unittest

import yaml

from program import ProgramTest, ROOT

# The rows of the sources' tables, counted there.
ROWS = {"golovanov": 379, "zavyalov_splines": 69, "zavyalov_visualisation": 35, "korotkij": 15, "grezdov": 28,
        "coursework": 20}


# What rows speak of, in words of their titles, and the kinds of types that can provide it.
SPOKEN = [(r"\bcurves?\b", {"curves", "helpers", "objects", "annotations"}),
          (r"\b(surfaces?|loft)\b", {"surfaces", "curves", "bodies", "shapes", "helpers", "objects", "materials", "textures"}),
          (r"\bbod(y|ies)\b", {"bodies", "shapes", "objects"}),
          (r"(?<!T-)\b(mesh|triangulation)", {"meshes", "objects"}),
          (r"\b(lights?|shadows?)\b", {"lights", "integrators", "materials"})]
# What the C++ of types is called where it is not called like them.
CALLED = {"object": ["representation", "tessellate"], "intersection_curve": ["intersect"], "union": ["unite"],
          "difference": ["subtract"]}


def file_of(test):
    """A row names a file of tests, or one case of it: FILE::Suite.Case."""
    return test.split("::")[0]


def has_case(path, case):
    """GoogleTest's TEST(Suite, Case), TEST_F, TEST_P; a method of a class of unittest."""
    suite, name = case.split(".")
    text = (ROOT / path).read_text()
    if path.endswith(".py"):
        body = re.search(rf"^class {suite}\b.*?(?=^\S|\Z)", text, re.MULTILINE | re.DOTALL)
        return bool(body and re.search(rf"^    def {name}\(", body[0], re.MULTILINE))
    return bool(re.search(rf"^TEST(_[FP])?\({suite}, {name}\)", text, re.MULTILINE))


class Capabilities(ProgramTest):
    def setUp(self):
        super().setUp()
        self.sources = yaml.safe_load((ROOT / "docs/capabilities.yaml").read_text())

    def rows(self):
        for name, source in self.sources.items():
            for row in source["capabilities"]:
                yield name, row

    def test_all_have_a_row(self):
        self.assertEqual({name: len(source["capabilities"]) for name, source in self.sources.items()}, ROWS)
        names = [(name, row["id"]) for name, row in self.rows()]
        self.assertEqual(len(names), len(set(names)))

    def test_files_exist(self):
        for name, row in self.rows():
            for path in row.get("figures", []) + row.get("tests", []):
                with self.subTest(source=name, id=row["id"], file=path):
                    self.assertTrue((ROOT / file_of(path)).is_file())
                    if "::" in path:
                        self.assertTrue(has_case(*path.split("::")))

    def test_providers_exist(self):
        types = set(re.findall(r"^  (\w+)  ", self.run_program("types")[0], re.MULTILINE))
        helps = {}
        for name, row in self.rows():
            for provider in row["provided_by"]:
                with self.subTest(source=name, id=row["id"], provider=provider):
                    if "/" in provider:
                        self.assertTrue((ROOT / provider).is_file())
                    elif provider.startswith("lekalo "):
                        command, *options = provider.split()[1:]
                        if command not in helps:
                            helps[command] = self.run_program(command, "--help")[0]
                        for option in options:
                            self.assertIn(option, helps[command])
                    else:
                        self.assertIn(provider, types)

    def kinds_of_types(self):
        """Of every type the sections of `lekalo types` that it stands in."""
        kinds, section = {}, None
        for line in self.run_program("types")[0].splitlines():
            name = re.match(r"  (\w+)  ", line)
            if name:
                kinds.setdefault(name[1], set()).add(section)
            elif line:
                section = line
        return kinds

    def test_providers_are_of_the_kind_spoken_of(self):
        """By the title up to a bracket: a row of curves is not provided by a reader of meshes."""
        kinds = self.kinds_of_types()
        for name, row in self.rows():
            types = [provider for provider in row["provided_by"] if provider in kinds]
            title = re.split(r"[(;]", row["title"])[0]
            fitting = [of for word, of in SPOKEN if re.search(word, title, re.IGNORECASE)]
            if types and fitting:
                with self.subTest(source=name, id=row["id"], types=types):
                    self.assertTrue(any(kinds[one] & set().union({"groups"}, *fitting) for one in types))

    def test_tests_mention_what_they_hold(self):
        """Each type stands in one of the row's tests, or in a figure that a test of the program reads: as scenes call it,
        or as C++ does. Tests of the program run the command; which C++ stands behind a command cannot be told."""
        types = self.kinds_of_types()
        for name, row in self.rows():
            tests = [file_of(test) for test in row.get("tests", [])]
            texts = [(ROOT / path).read_text() for path in tests]
            if any(path.endswith(".py") for path in tests):
                texts += [(ROOT / path).read_text() for path in row.get("figures", [])]
            for provider in row["provided_by"] if texts else []:
                if provider in types:
                    stem = re.sub(r"_(curve|surface|body|line|light)$", "", provider)
                    words = [stem, "".join(part.capitalize() for part in stem.split("_")),
                             *CALLED.get(provider, [])]
                elif all(path.endswith(".py") for path in tests):
                    words = [provider.split()[1]] if "/" not in provider else []
                else:
                    continue
                with self.subTest(source=name, id=row["id"], provider=provider, tests=row["tests"]):
                    self.assertTrue(not words or any(re.search(rf"\b{word}", text) for word in words for text in texts))

    def test_what_is_missing_is_not_tested(self):
        for name, row in self.rows():
            if not row["provided_by"]:
                self.assertEqual(set(row), {"id", "title", "provided_by"}, (name, row["id"]))


if __name__ == "__main__":
    unittest.main()
