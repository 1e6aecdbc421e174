# SPDX-License-Identifier: MIT
"""Manual page and completion of the shell: they know all that --help knows, and nothing else."""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from cli import PROGRAM, run

SCRIPT = pathlib.Path(__file__).resolve().parents[3] / "verification" / "manual" / "manual.py"
VERSION = "1.2.3"


def command_helps(words=()):
    """The help of the program and of every command, read apart from the code under test."""
    text = run(*words, "--help").stdout
    helps = {words: text}
    below = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.MULTILINE)
    for name in re.findall(r"^  (\S+)", below.group(1), re.MULTILINE) if below else ():
        helps.update(command_helps((*words, name)))
    return helps


def options_of(text):
    """The long options that a help lists."""
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][a-z-]*)", text, re.MULTILINE))


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="homespun-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        subprocess.run([sys.executable, "-B", SCRIPT, PROGRAM, VERSION, cls.folder], check=True)
        cls.roff = cls.folder / "homespun.1.gz"
        cls.bash = cls.folder / "homespun.bash"
        cls.helps = command_helps()

    def sections(self):
        """The page's text by command, as words: ("check",)."""
        page = gzip.decompress(self.roff.read_bytes()).decode().replace(r"\-", "-")
        sections = {(): page[page.index(".SH OPTIONS"):page.index(".SH COMMANDS")]}
        for part in page[page.index(".SH COMMANDS"):].split(".SS ")[1:]:
            words = re.match(r'"homespun((?: [a-z]\S*)+)', part).group(1).split()
            sections[tuple(words)] = part
        return sections

    def complete(self, *words):
        """What bash offers for the last word."""
        script = (f'source "{self.bash}"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _homespun; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        result = subprocess.run(["bash", "-u", "-c", script, "bash", "homespun", *words],
                                capture_output=True, text=True, check=True)
        self.assertEqual(result.stderr, "")
        return set(result.stdout.split())

    def test_the_help_itself_lists_commands_and_options(self):
        self.assertIn(("check",), self.helps)
        self.assertLess({"--help", "--tolerance", "--max-dofs"},
                        options_of(self.helps["homogenize",]))

    def test_the_page_has_the_commands_and_options_of_the_help(self):
        sections = self.sections()
        self.assertEqual(set(sections), set(self.helps))
        for words, text in self.helps.items():
            listed = set(re.findall(r"^\.TP\n\\fB(?:-\w,)?(--[a-z-]+)", sections[words],
                                    re.MULTILINE))
            self.assertEqual(listed | {"--help"}, options_of(text), words)

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_the_page_has_every_word_of_the_help(self):
        """Nothing is lost on the way: footers, examples, keys and their values."""
        page = subprocess.run(["man", "-l", self.roff], capture_output=True, text=True, check=True,
                              env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8",
                                   "MANWIDTH": "400"}).stdout
        known = set(page.replace("\N{HYPHEN}", "-").split())
        for words, text in self.helps.items():
            text = re.sub(r"\{false\}|:[A-Z]+(?= in )|Usage:|^(Positionals|Options|Subcommands):$",
                          "", text, flags=re.MULTILINE)
            lost = {word for word in text.split() if not {word, word + "."} & known}
            # The first line of the help becomes `NAME`, without its full stop.
            self.assertEqual(lost - {"from."}, set(), words)

    @unittest.skipUnless(shutil.which("man"), "man is not installed")
    def test_groff_has_nothing_to_say_about_the_page(self):
        for width in ("60", "80", "200"):
            result = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z",
                                     self.roff],
                                    capture_output=True, text=True, check=True,
                                    env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8",
                                         "MANWIDTH": width})
            self.assertEqual(result.stderr, "")
            self.assertIn(VERSION, result.stdout)

    def test_equal_programs_have_equal_pages(self):
        again = self.folder / "again"
        again.mkdir()
        subprocess.run([sys.executable, "-B", SCRIPT, PROGRAM, VERSION, again], check=True)
        self.assertEqual((again / "homespun.1.gz").read_bytes(), self.roff.read_bytes())

    def test_bash_accepts_the_completion(self):
        result = subprocess.run(["bash", "-n", self.bash], capture_output=True, text=True,
                                check=True)
        self.assertEqual(result.stderr, "")

    def test_commands_and_options_are_completed(self):
        for words, text in self.helps.items():
            self.assertLessEqual(options_of(text), self.complete(*words, "-"))
            self.assertEqual(options_of(text), self.complete(*words, "--"))
            below = {other[-1] for other in self.helps if other[:-1] == words and other}
            self.assertEqual(below, self.complete(*words, ""))
        self.assertEqual(self.complete("hom"), {"homogenize"})
        self.assertEqual(self.complete("homogenize", "cell.prm", "--tol"), {"--tolerance"})

    def test_files_are_left_to_bash(self):
        self.assertEqual(self.complete("check", ""), set())
        result = subprocess.run(["bash", "-c", f'source "{self.bash}"; complete -p homespun'],
                                capture_output=True, text=True, check=True)
        self.assertIn("-o default", result.stdout)


if __name__ == "__main__":
    unittest.main()
