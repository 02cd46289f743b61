"""The manual page and the shell completions are what `lekalo completions` writes from the declarations of commands and
options, and name each of them."""

import os
import pathlib
import re
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
LEKALO = os.environ["LEKALO"]
PAGES = {"man": "docs/man/lekalo.1", "bash": "tools/completions/lekalo.bash", "zsh": "tools/completions/lekalo.zsh",
         "fish": "tools/completions/lekalo.fish"}


def help_of(*command):
    return subprocess.run([LEKALO, *command, "--help"], check=True, capture_output=True, text=True).stdout


def program_commands():
    return re.findall(r"^  ([a-z]+)\b", help_of().split("Subcommands:")[1], flags=re.MULTILINE)


class Packaging(unittest.TestCase):
    def test_pages_are_what_the_program_writes(self):
        for kind, page in PAGES.items():
            written = subprocess.run([LEKALO, "completions", kind], check=True, capture_output=True, text=True).stdout
            self.assertEqual((ROOT / page).read_text(), written, f"write it again: lekalo completions {kind} > {page}")

    def test_every_command_and_option_is_named(self):
        pages = {kind: (ROOT / page).read_text() for kind, page in PAGES.items()}
        commands = program_commands()
        self.assertGreater(len(commands), 10)
        for command in commands:
            for option in re.findall(r"^ +(?:-[a-z],)?--([a-z][a-z-]+)", help_of(command).split("Usage:")[1], re.MULTILINE):
                self.assertRegex(pages["bash"], rf"\b{command}\) words='[^']*--{option}\b")
                self.assertRegex(pages["fish"], rf"_from {command}'.* -l {option} ")
                self.assertIn(f"--{option}[", pages["zsh"].split(f"\n  {command})\n")[1].split(" ;;\n")[0])
                spelt = option.replace("-", r"\-")
                if option != "help":
                    self.assertIn(rf"\-\-{spelt}", pages["man"].split(f".SS {command}\n")[1].split(".SS ")[0])

    def test_shells_take_them(self):
        for shell, options in ("bash", ["-n"]), ("zsh", ["-n"]), ("fish", ["--no-execute"]):
            if shutil.which(shell):
                subprocess.run([shell, *options, ROOT / PAGES[shell]], check=True)
        if shutil.which("man"):
            done = subprocess.run(["man", "--warnings", "-l", ROOT / PAGES["man"]], capture_output=True, text=True,
                                  env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "120"})
            self.assertEqual(done.stderr, "")

    def test_bash_completes_commands_options_and_files(self):
        def completions(*words):
            script = ('compopt() { :; }; source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _lekalo; '
                      'printf "%s\\n" "${COMPREPLY[@]}"')
            return subprocess.run(["bash", "-c", script, "bash", str(ROOT / PAGES["bash"]), "lekalo", *words], cwd=ROOT,
                                  check=True, capture_output=True, text=True).stdout.split()

        self.assertEqual(completions("ev"), ["evaluate"])
        self.assertIn("--samples", completions("render", "--s"))
        self.assertEqual(completions("compare", "--metric", "p"), ["psnr"])
        self.assertEqual(completions("farm", "s"), ["slurm"])
        self.assertIn("scenes/primer", completions("render", "scenes/p"))
        self.assertNotIn("scenes/README.md", completions("render", "scenes/"))


if __name__ == "__main__":
    unittest.main()
