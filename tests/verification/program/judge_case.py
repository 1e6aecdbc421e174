# SPDX-License-Identifier: MIT
"""What tests of `homespun judge` share: studies that kept positions, and judging them."""
import json
import pathlib
import tempfile

import h5py
import numpy

from broken_cells_test import Cell
from cli import CELLS, LAYERED, InFolder, rows_of, run


class Judging(InFolder):
    """A study that kept positions, made once: `study`, `kept`, its table `rows`."""

    table = "strain.csv"

    @classmethod
    def make(cls, *arguments):
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cls.study = pathlib.Path(folder.name) / "study"
        result = run(*arguments, "--keep", "--no-report", "--output", cls.study)
        assert result.returncode in (0, 1, 4), result.stderr
        cls.said = result.stderr
        cls.kept = cls.study / "layered" / "positions"
        cls.rows = rows_of(cls.study / cls.table)

    def kept_positions(self, name, what="reference"):
        with h5py.File(self.kept / f"{name}.h5") as file:
            return file[what][...]

    def write(self, name, positions):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        numpy.save(path, positions)
        return path

    @staticmethod
    def forget(study, name):
        """What the run knows of a file, as if it had written it so."""
        description = json.loads((study / "run.json").read_text())
        for key in [key for key in description["files"] if key.endswith(name)]:
            del description["files"][key]
        (study / "run.json").write_text(json.dumps(description))

    def judge(self, *files, name="mine", study=None):
        return run("judge", study or self.study, *files, "--name", name, "--output",
                   self.folder / f"judged-{name}", "--overwrite", "--no-report")

    def judged(self, *files, name="mine"):
        """The rows of a method, by level, and what was said."""
        result = self.judge(*files, name=name)
        self.assertIn(result.returncode, (0, 1, 4), result.stderr)
        rows = [row for row in rows_of(self.folder / f"judged-{name}" / self.table)
                if row["method"] == name]
        return {self.level(row): row for row in rows}, result

    def refused(self, words, *arguments, study=None):
        """Judging is refused with these words, and nothing is written."""
        output = self.folder / "refused"
        result = run("judge", study or self.study, *arguments, "--output", output)
        self.assertEqual(result.returncode, 2, result.stdout)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, result.stderr)
        self.assertFalse(output.exists())
        return result.stderr


class JudgingLevels(Judging):
    """Positions of sheets and infinite cloth, as `strain --keep` leaves them."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="homespun-")
        cls.addClassCleanup(folder.cleanup)
        cell = Cell().write(pathlib.Path(folder.name), "layered")
        cls.make("strain", cell, "--cells", "4", "--loads", "strip-1,periodic-11", "--references",
                 "linear,biot", "--strains", "0.01,0.1", "--no-budget", "--no-runtime")
        with h5py.File(cls.kept / "sheet.h5") as file:
            cls.triangles, cls.rest = file["triangles"][...], file["rest"][...]

    @staticmethod
    def level(row):
        return f"{row['load']}-{row['reference']}-{float(row['strain']):g}"

    def affine(self):
        """The rest sheet, pulled evenly."""
        return self.rest * [1.1, 0.97]


class JudgingFrames(Judging):
    """Positions of moving cloth, as `drape --keep` leaves them."""

    table = "drape.csv"

    @classmethod
    def setUpClass(cls):
        cls.make("drape", CELLS.parent / "scenes" / "pull.prm", "--unit-cells",
                 LAYERED, "--duration", "0.1", "--quick", "--references", "biot",
                 "--no-frames")

    @staticmethod
    def level(row):
        return f"{row['reference']}-{int(row['frame']):04d}"
