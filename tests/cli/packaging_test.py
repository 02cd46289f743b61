"""The manual page and the shell completions name every command and option that the program's own --help names, and,
as soon as the program has all commands of the manual page, no other option."""

import os
import pathlib
import re
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEKALO = os.environ["LEKALO"]
PAGES = ["docs/man/lekalo.1", "tools/completions/lekalo.bash", "tools/completions/lekalo.zsh", "tools/completions/lekalo.fish"]


def text_of(page):
    """The page with the spellings of options in troff (\\-\\-size) and fish (complete ... -l size) undone."""
    text = (ROOT / page).read_text().replace("\\-", "-")
    return re.sub(r"^(complete .*) -l ([a-z][a-z-]*)", r"\1 --\2", text, flags=re.MULTILINE)


def options_in(text):
    return set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", text))


def help_of(*command):
    return subprocess.run([LEKALO, *command, "--help"], check=True, capture_output=True, text=True).stdout


def program_commands():
    return re.findall(r"^  ([a-z]+)\b", help_of().split("Subcommands:")[1], flags=re.MULTILINE)


def manual_commands():
    return re.findall(r"^\.B ([a-z]+)$", text_of(PAGES[0]).split(".SH COMMANDS")[1].split(".SH OPTIONS")[0], flags=re.MULTILINE)


class Packaging(unittest.TestCase):
    def test_every_command_is_named(self):
        self.assertNotEqual(program_commands(), [])
        for command in program_commands():
            for page in PAGES:
                self.assertRegex(text_of(page), rf"\b{command}\b", page)

    def test_every_option_is_named(self):
        commands = program_commands()
        known = options_in(help_of()).union(*(options_in(help_of(command)) for command in commands)) | {"--version"}
        for page in PAGES:
            named = options_in(text_of(page))
            self.assertEqual(sorted(known - named), [], f"options that {page} lacks")
            if set(commands) == set(manual_commands()):
                self.assertEqual(sorted(named - known), [], f"options of {page} that the program does not know")

    def test_bash_completes_commands_options_and_files(self):
        def completions(*words):
            script = ('compopt() { :; }; source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lekalo; '
                      'printf "%s\\n" "${COMPREPLY[@]}"')
            return subprocess.run(["bash", "-c", script, "bash", str(ROOT / PAGES[1]), "lekalo", *words], cwd=ROOT,
                                  check=True, capture_output=True, text=True).stdout.split()

        self.assertEqual(completions("ev"), ["evaluate"])
        self.assertIn("--samples", completions("render", "--s"))
        self.assertEqual(completions("compare", "--metric", "p"), ["psnr"])
        self.assertIn("scenes/primer", completions("render", "scenes/p"))
        self.assertNotIn("scenes/README.md", completions("render", "scenes/"))


if __name__ == "__main__":
    unittest.main()
