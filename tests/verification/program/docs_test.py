# SPDX-License-Identifier: MIT
"""README, docs and guides: links lead somewhere, commands are those of the program, generated pages
are those of this program, and the cell and the Python of the front page do what it says.
"""
import functools
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest

from cli import PATIENCE, PROGRAM, InFolder, run

ROOT = pathlib.Path(__file__).resolve().parents[3]
MANUAL = ROOT / "verification" / "manual"
sys.path.insert(0, str(MANUAL))

# pylint: disable=wrong-import-position
from help_text import entries_of, read  # noqa: E402
from reference import tables_page  # noqa: E402
from table_words import words_of  # noqa: E402

FRONT = ROOT / "README.md"
WRITTEN = [FRONT, *sorted((ROOT / "guides").glob("*.md")), ROOT / "python" / "README.md"]
PAGES = [*WRITTEN, *sorted((ROOT / "docs").rglob("*.md"))]
AGAIN = "`cmake --build --preset release --target docs` writes the page again"
FENCE = re.compile(r"^```(\w*)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(path, language):
    """The code blocks of a page in one language; "" for those that name none."""
    return [code for name, code in FENCE.findall(path.read_text(encoding="utf-8"))
            if name == language]


def anchors(path):
    """The anchors of a page's headings, as GitHub makes them."""
    text = FENCE.sub("", path.read_text(encoding="utf-8"))
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in titles}


def commands(path):
    """Every command of homespun in code blocks and in code within sentences, as words."""
    text = path.read_text(encoding="utf-8")
    spans = re.findall(r"`((?:mpirun -n \w+ )?homespun [^`]*)`", FENCE.sub("", text))
    lines = [line for language, code in FENCE.findall(text) if language == "sh"
             for line in code.split("\n")]
    for part in [*spans, *(part for line in lines for part in line.split("&&"))]:
        words = shlex.split(part.replace("'", '"'), comments=True)
        if words[:2] == ["mpirun", "-n"]:
            words = words[3:]
        if words[:1] == ["homespun"]:
            yield words


@functools.lru_cache
def helps():
    """{words of a command: Command}"""
    return {command.words: command for command in read(PROGRAM).walk()}


class Links(unittest.TestCase):
    def test_every_relative_link_leads_to_a_file_and_a_heading(self):
        for page in [*PAGES, *ROOT.glob("*/README.md")]:
            text = FENCE.sub("", page.read_text(encoding="utf-8"))
            for link in re.findall(r"\]\(([^)\s]+)\)", text):
                if re.match(r"[a-z]+:", link):
                    continue
                name, _, heading = link.partition("#")
                target = (page.parent / name).resolve() if name else page
                with self.subTest(page=page.relative_to(ROOT), link=link):
                    self.assertTrue(target.exists())
                    if heading:
                        self.assertIn(heading, anchors(target))

    def test_every_guide_and_picture_is_linked(self):
        text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
        for path in [*(ROOT / "guides").iterdir(), *(ROOT / "docs" / "pictures").iterdir()]:
            self.assertTrue(path.name in text, path)

    def test_the_front_page_is_short(self):
        text = FRONT.read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), 120)
        self.assertLessEqual(len(re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL).split()), 1200)

    def test_pictures_are_small(self):
        for path in (ROOT / "docs" / "pictures").iterdir():
            self.assertLess(path.stat().st_size, 400_000, path.name)

    def test_the_version_to_cite_is_that_of_the_project(self):
        project = re.search(r"project\(\s*homespun\s+VERSION ([\d.]+)",
                            (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
        cited = re.search(r"^version: ([\d.]+)$",
                          (ROOT / "CITATION.cff").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(project.group(1), cited.group(1))


class Commands(unittest.TestCase):
    def test_commands_and_their_options_exist(self):
        for page in WRITTEN:
            for words in commands(page):
                name = next(words[:n] for n in (3, 2, 1) if tuple(words[:n]) in helps())
                with self.subTest(page=page.relative_to(ROOT), words=" ".join(words)):
                    if len(name) == 1:  # homespun --version, homespun COMMAND --help
                        self.assertTrue(words[1].startswith("-") or words[1].isupper())
                    options = helps()[tuple(name)].options()
                    for word in words[len(name):]:
                        if word.startswith("--"):
                            self.assertIn(word.split("=")[0], options)
                        if word.startswith("meshes/"):
                            self.assertTrue((ROOT / word).is_file())

    def test_every_command_of_the_front_page_is_run_by_a_test(self):
        here = pathlib.Path(__file__).parent
        tests = "".join(path.read_text(encoding="utf-8") for path in here.glob("*.py")
                        if path != pathlib.Path(__file__))
        for words in commands(FRONT):
            if words[1] != "--version":
                self.assertTrue(f'"{words[1]}"' in tests, words)

    def test_the_reference_is_what_this_program_says(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([sys.executable, "-B", MANUAL / "reference.py", PROGRAM,
                            os.environ["HOMESPUN_SCHEMA"], folder], check=True)
            for path in sorted(pathlib.Path(folder).iterdir()):
                stored = ROOT / "docs" / "reference" / path.name
                self.assertTrue(stored.read_text(encoding="utf-8") ==
                                path.read_text(encoding="utf-8"),
                                f"{stored} is not what this program says; {AGAIN}")

    def test_a_column_has_the_unit_of_its_name_and_the_values_that_its_table_holds(self):
        units = {"curvature_per_m": "1/m", "stress_11_N_per_m": "N/m", "force_N": "N", "x_m": "m",
                 "foundation_N_per_m3": "N/m^3", "normal_error_mean_rad": "rad",
                 "angle_deg": "degrees", "mean_per_cell": "", "seconds": "s"}
        columns = [{"name": name, "domain": "real"} for name in units]
        columns.append({"name": "stable", "domain": "flag"})
        page = tables_page({"a.csv": {"keys": 0, "columns": columns}, "laws": [], "loads": []}, {})
        found = re.findall(r"(?m)^\| `(\w+)` \| (.*?) \| (.*?) \|", page)
        self.assertEqual(found, [(name, unit, "number") for name, unit in units.items()]
                         + [("stable", "", "true or false")])

    def test_python_takes_for_text_what_is_text(self):
        code = (ROOT / "python" / "package" / "results.py").read_text(encoding="utf-8")
        named = set(re.search(r'^_TEXT = set\("""(.*?)"""', code, re.S | re.M).group(1).split())
        schema = json.loads(pathlib.Path(os.environ["HOMESPUN_SCHEMA"]).read_text(encoding="utf-8"))
        kinds = {}  # {column: {whether it is text: tables}}
        for table, entry in schema.items():
            if table.endswith(".csv"):
                for column in entry["columns"]:
                    is_text = column["domain"] in ("name", "text", "outcome")
                    kinds.setdefault(column["name"], {}).setdefault(is_text, []).append(table[:-4])
        wanted = {text for column, of in kinds.items() if True in of
                  for text in ([f"{table}.{column}" for table in of[True]] if False in of
                               else [column])}
        self.assertEqual(named, wanted)

    def test_every_claim_of_the_program_is_in_claims_json_and_the_other_way_round(self):
        here = ROOT / "verification"
        claims = json.loads((here / "record" / "claims.json").read_text(encoding="utf-8"))
        known = {name for study, some in claims.items() if study != "shared" for name in some}
        code = "".join(path.read_text(encoding="utf-8") for ending in ("cc", "h")
                       for path in sorted(here.rglob(f"*.{ending}")))
        asked = re.findall(r"\b(?:judged?|at_most|none_of|open_by_loss|verdict_of_smallest)"
                           r'\(\s*"([\w.-]*\w)"', code)
        self.assertGreater(len(asked), 50)
        self.assertEqual(set(asked) - known, set())
        for name in known:
            self.assertTrue(f'"{name}"' in code or f'"{name.rpartition(".")[0]}."' in code, name)

    def test_a_long_option_with_its_text_beside_it_is_read(self):
        lines = ["  --variants TEXT ...         Models of the cloth: woven (law",
                 " " * 30 + "yarn), corotational",
                 "  --order UINT:INT in [1 - 2]=2", " " * 30 + "Order"]
        self.assertEqual(entries_of(lines),
                         [("--variants TEXT ...", "Models of the cloth: woven (law yarn),"
                           " corotational"),
                          ("--order UINT:INT in [1 - 2]=2", "Order")])

    def test_the_words_of_a_table_are_those_of_its_header(self):
        header = """
/// made-up.csv: one thing (record/thing.h). Of the ways
///   =   kept
///   >   not kept,
///   at all
struct Row
{
  static constexpr const char *file   = "made-up.csv";
  std::string cell;
  double mean = 0.,
         max = 0.; ///< over the vertices
                   ///< [m]
  int n = 1;

  template <typename Column>
  static void columns(Column &&column)
  {
    column("cell", &Row::cell, Domain::name);
    column("mean_m", &Row::mean, Domain::real);
    column("max_m", &Row::max, Domain::real);
  }
};
"""
        about, columns = words_of(header)["made-up.csv"]
        self.assertEqual(about, ["One thing. Of the ways", "- `=`: kept",
                                 "- `>`: not kept, at all"])
        self.assertEqual(columns, {"mean_m": "over the vertices [m]",
                                   "max_m": "over the vertices [m]"})


@unittest.skipUnless(shutil.which("gmsh"), "gmsh is not installed")
class FrontPage(InFolder):
    def mesh_and_check(self, page, *options):
        """Writes the cell of a page, meshes and checks it."""
        (drawing,) = blocks(page, "c")
        keys = next(code for code in blocks(page, "") if code.startswith("set Mesh"))
        (self.folder / "dots.geo").write_text(drawing, encoding="utf-8")
        (self.folder / "dots.prm").write_text(keys, encoding="utf-8")
        subprocess.run(["gmsh", "-2", *options, "dots.geo"], cwd=self.folder, check=True,
                       capture_output=True, timeout=60 * PATIENCE)
        result = run("check", "dots.prm", cwd=self.folder)
        self.assertEqual(result.returncode, 0)
        self.assertNotIn("warning", result.stdout)

    def test_ten_lines_are_a_cell_that_python_up_samples(self):
        line = next(line for line in "".join(blocks(FRONT, "sh")).split("\n")
                    if line.startswith("gmsh"))
        words = shlex.split(line.split("&&")[0])
        self.assertEqual([*words[:2], words[-1]], ["gmsh", "-2", "dots.geo"])
        self.mesh_and_check(FRONT, *words[2:-1])
        self.assertEqual(run("homogenize", "dots.prm", "--quiet", cwd=self.folder).returncode, 0)
        self.assertTrue((self.folder / "out" / "dots" / "homogenize" / "cell.h5").is_file())
        package = pathlib.Path(os.environ["HOMESPUN_BUILD"]) / "python"
        if not list(package.glob("homespun/_fem*.so")):
            self.skipTest("the Python package is not built")
        for page in (FRONT, ROOT / "guides" / "simulation.md"):
            (code,) = blocks(page, "python")
            code += "\nassert fine.shape[1] == 3 and len(fine) > len(cloth.positions)\n"
            subprocess.run(["/usr/bin/python3", "-B", "-c", code], cwd=self.folder, check=True,
                           env={**os.environ, "PYTHONPATH": str(package)},
                           timeout=120 * PATIENCE)

    def test_the_cell_of_the_guide_is_sound(self):
        self.mesh_and_check(ROOT / "guides" / "cell.md", "-format", "msh41")


if __name__ == "__main__":
    unittest.main()
