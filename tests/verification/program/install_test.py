# SPDX-License-Identifier: MIT
"""The installed program, in a folder that it was not configured for: all files, its own data found.
"""
import json
import os
import re
import subprocess

from cli import PATIENCE, InFolder


class Install(InFolder):
    def setUp(self):
        super().setUp()
        self.prefix = self.folder / "moved here"
        subprocess.run(["cmake", "--install", os.environ["HOMESPUN_BUILD"], "--prefix",
                        self.prefix],
                       check=True, capture_output=True)

    def run_installed(self, *arguments):
        return subprocess.run([self.prefix / "bin" / "homespun", *map(str, arguments)],
                              cwd=self.folder, capture_output=True, text=True,
                              timeout=600 * PATIENCE, check=False)

    def test_everything_is_there(self):
        share = self.prefix / "share"
        self.assertTrue((self.prefix / "libexec" / "homespun-full").is_file())
        for name in ("doc/homespun/LICENSE", "doc/homespun/README.md", "man/man1/homespun.1.gz",
                     "bash-completion/completions/homespun", "homespun/cells/layered.geo",
                     "homespun/scenes/skirt.obj", "homespun/report/report.py",
                     "homespun/report/read/runs.py",
                     "homespun/report/figures/style.py",
                     "homespun/report/page/templates/report.html.j2"):
            self.assertTrue((share / name).is_file(), name)
        for folder in ("meshes", "shell", "localization", "homogenization"):
            self.assertTrue(list((self.prefix / "include" / "homespun" / folder).rglob("*.h")),
                            folder)
        self.assertEqual(list((share / "homespun").rglob("test_*")), [])

    def test_cells_and_scenes_and_the_report_are_those_of_the_prefix(self):
        cells = re.findall(r"^/.*\.prm$", self.run_installed("cells").stdout, re.MULTILINE)
        self.assertTrue(cells)
        for cell in cells:
            self.assertEqual(os.path.dirname(cell),
                             str(self.prefix / "share" / "homespun" / "cells"))
        scene = self.prefix / "share" / "homespun" / "scenes" / "hang.prm"
        result = self.run_installed("drape", scene, "--quick", "--duration", "0.1", "--unit-cells",
                                    cells[0], "--no-frames", "--output", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("<html", (self.folder / "out" / "report.html").read_text(encoding="utf-8"))
        verdicts = (self.folder / "out" / "verdicts.json").read_text(encoding="utf-8")
        self.assertTrue(json.loads(verdicts))
        self.assertEqual(list(self.prefix.rglob("__pycache__")), [])
