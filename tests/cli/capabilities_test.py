"""docs/capabilities.yaml: every capability of the sources has its row, and what a row names is there."""

import re
import unittest

import yaml

from program import ProgramTest, ROOT

# The rows of the sources' tables, counted there.
ROWS = {"golovanov": 379, "zavyalov_splines": 69, "zavyalov_visualisation": 35, "korotkij": 15, "grezdov": 28,
        "coursework": 20}


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
                    self.assertTrue((ROOT / path).is_file())

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

    def test_what_is_missing_is_not_tested(self):
        for name, row in self.rows():
            if not row["provided_by"]:
                self.assertEqual(set(row), {"id", "title", "provided_by"}, (name, row["id"]))


if __name__ == "__main__":
    unittest.main()
