# SPDX-License-Identifier: MIT
"""What the pages show runs: README.md of the package, its notebook, and what pip says."""
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

from with_cell import SOURCE, shown_in


class Shown(unittest.TestCase):
    def run_python(self, code, folder):
        done = subprocess.run([sys.executable, "-B", "-W", "error", "-c", code], cwd=folder,
                              check=False, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, env={**os.environ, "MPLBACKEND": "Agg"})
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_the_page_up_samples_a_skirt_and_moves_a_cloth(self):
        text = (SOURCE / "python/README.md").read_text(encoding="utf-8")
        page, _ = text.split("## How good is my own method?")
        garment, cloth = shown_in(page)
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            # The page begins in the checkout; pictures go elsewhere.
            os.symlink(SOURCE / "meshes", pathlib.Path(folder, "meshes"))
            code = garment + "size = len(fine)\n" + cloth
            said = self.run_python(code + "print(size, numpy.ptp(out[:, 0]))\n", folder).split()
            self.assertGreater(int(said[0]), 100_000)
            self.assertAlmostEqual(float(said[1]), 0.2, 2)
            self.assertGreater(pathlib.Path(folder, "skirt.png").stat().st_size, 100_000)

    def test_the_page_judges_a_method(self):
        text = (SOURCE / "python/README.md").read_text(encoding="utf-8")
        (code,) = shown_in(text.split("## How good is my own method?")[1])
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            os.symlink(SOURCE / "meshes", pathlib.Path(folder, "meshes"))
            said = self.run_python("import homespun\nimport numpy\n" + code, folder)
            self.assertRegex(said, r"(?m)^mean errors in 1/1000 of strain x cell side")
            self.assertRegex(said, r"(?m)^strip-1 +biot +10 % .* ± .* rank 9 of 9$")
            page = pathlib.Path(folder, said.splitlines()[-1])
            self.assertEqual(page.name, "report.html")
            self.assertIn("mine", page.read_text(encoding="utf-8"))

    def test_the_notebook_runs_from_cell_to_cell(self):
        notebook = json.loads((SOURCE / "python/tour.ipynb").read_text(encoding="utf-8"))
        self.assertEqual((notebook["nbformat"], notebook["nbformat_minor"]), (4, 5))
        identities = [cell["id"] for cell in notebook["cells"]]
        self.assertEqual(len(set(identities)), len(identities))
        code = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
        for cell in notebook["cells"]:
            self.assertEqual(cell.get("outputs", []), [])
        self.assertGreater(len(code), 4)
        says = "\nfrom matplotlib import pyplot\nprint(len(pyplot.get_fignums()), fine.shape[1])\n"
        said = self.run_python("\n".join(code) + says, SOURCE / "python").splitlines()
        self.assertEqual(said[-1], "3 3")
        self.assertIn("+-", said)


class Pip(unittest.TestCase):
    def test_pip_says_which_package_is_missing(self):
        if importlib.util.find_spec("scikit_build_core"):
            self.skipTest("scikit-build-core is installed")
        done = subprocess.run([sys.executable, "-B", "-c", "import build_backend"], check=False,
                              cwd=SOURCE / "python", text=True, stderr=subprocess.PIPE)
        self.assertEqual(done.returncode, 1)
        self.assertIn("needs the Python package scikit_build_core", done.stderr)
        self.assertIn("python3-scikit-build-core (Debian 13)", done.stderr)


if __name__ == "__main__":
    unittest.main()
