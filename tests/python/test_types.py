# SPDX-License-Identifier: MIT
"""The stubs of the compiled modules are those of the modules, and what readers copy type-checks."""
import ast
import importlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest

from with_cell import BUILD, SOURCE, shown_in

PACKAGE = BUILD / "python/homespun"
MODULES = ["_light", "_fem"] if list(PACKAGE.glob("_fem*.so")) else ["_light"]
PAGES = ["README.md", "guides/simulation.md", "python/README.md"]


def arguments_of(node):
    """(name, how it is passed, whether it may be left out) of each argument but self."""
    found = []
    takes = node.args
    plain = [*takes.posonlyargs, *takes.args]
    optional = len(plain) - len(takes.defaults)
    found += [(one.arg, "plain", k >= optional) for k, one in enumerate(plain)]
    found += [(one.arg, "keyword", default is not None)
              for one, default in zip(takes.kwonlyargs, takes.kw_defaults)]
    return [one for one in found if one[0] != "self"]


def in_stub(path):
    """{name: arguments, "property" or None} of a stub, members as Class.member."""
    found = {}

    def gather(body, prefix):
        for node in body:
            if isinstance(node, ast.ClassDef):
                found[prefix + node.name] = "class"
                gather(node.body, prefix + node.name + ".")
            elif isinstance(node, ast.FunctionDef):
                decorators = [one.id for one in node.decorator_list if isinstance(one, ast.Name)]
                found.setdefault(prefix + node.name, [])
                if "property" in decorators:
                    found[prefix + node.name] = "property"
                else:
                    found[prefix + node.name].append(arguments_of(node))
            elif isinstance(node, ast.AnnAssign):
                found[prefix + node.target.id] = "value"

    gather(ast.parse(path.read_text(encoding="utf-8")).body, "")
    return found


def signatures(function):
    """The arguments of each overload, as pybind11 writes them in the first lines of a docstring."""
    lines = [line for line in function.__doc__.splitlines()
             if re.match(rf"(\d+\. )?{function.__name__}\(", line)]
    if len(lines) > 1:
        lines = lines[1:]  # the first one says `Overloaded function.`
    texts = (re.sub(r"^\d+\. ", "", line) for line in lines)
    found = [arguments_of(ast.parse(f"def {text}: ...").body[0]) for text in texts]
    return [one for k, one in enumerate(found) if one not in found[:k]]


def in_module(module):
    """The same of a compiled module."""
    found = {}

    def gather(thing, prefix):
        for name, value in vars(thing).items():
            if name.startswith("_") and name not in ("__init__", "__version__"):
                continue
            if isinstance(value, type):
                found[prefix + name] = "class"
                gather(value, prefix + name + ".")
            elif isinstance(value, property):
                found[prefix + name] = "property"
            elif isinstance(value, str):
                found[prefix + name] = "value"
            elif not isinstance(value, types.ModuleType):
                found[prefix + name] = signatures(getattr(value, "__func__", value))

    gather(module, "")
    # What Python does not make has a constructor without a signature.
    return {name: value for name, value in found.items() if value != []}


class Stubs(unittest.TestCase):
    maxDiff = None

    def test_stubs_have_the_names_and_arguments_of_the_modules(self):
        for name in MODULES:
            module = in_module(importlib.import_module(f"homespun.{name}"))
            self.assertEqual(in_stub(PACKAGE / f"{name}.pyi"), module)
            self.assertGreater(len(module), 3)
        light = in_module(importlib.import_module("homespun._light"))
        self.assertEqual(light["Cloth.prescribe"],
                         [[("vertex", "plain", False), ("position", "plain", False)]])
        self.assertIn(("held", "keyword", True), light["Cloth.__init__"][0])

    def test_a_default_stands_in_the_module_and_not_once_more_in_its_stub(self):
        for name in MODULES:
            tree = ast.parse((PACKAGE / f"{name}.pyi").read_text(encoding="utf-8"))
            defaults = [ast.unparse(one) for node in ast.walk(tree)
                        if isinstance(node, ast.FunctionDef)
                        for one in (*node.args.defaults, *node.args.kw_defaults) if one]
            self.assertEqual(set(defaults), {"..."} & set(defaults))
            self.assertEqual(bool(defaults), name == "_light")


@unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
class Checked(unittest.TestCase):
    def mypy(self, *paths):
        return subprocess.run(
            ["mypy", "--config-file", SOURCE / "tests/python/mypy.ini", "--python-executable",
             sys.executable, "--cache-dir", PACKAGE.parent / "mypy_cache", *paths], check=False,
            text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)}, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT)

    def test_the_package_the_example_and_what_pages_show_are_strictly_typed(self):
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            shown = []
            for page in PAGES:
                text = "".join(shown_in(SOURCE / page))
                self.assertIn("import homespun", text, page)
                shown.append(pathlib.Path(folder, re.sub(r"\W", "_", page) + ".py"))
                shown[-1].write_text(text, encoding="utf-8")
            notebook = json.loads((SOURCE / "python/tour.ipynb").read_text(encoding="utf-8"))
            shown.append(pathlib.Path(folder, "tour.py"))
            shown[-1].write_text("\n".join("".join(cell["source"]) for cell in notebook["cells"]
                                           if cell["cell_type"] == "code"), encoding="utf-8")
            result = self.mypy(PACKAGE, SOURCE / "python/example.py", *shown)
            self.assertEqual(result.returncode, 0, result.stdout)

    def test_what_the_stubs_do_not_allow_is_found(self):
        lines = ["cell.stifness", "homespun.Sheet(cell, '3', 3)", "homespun.homogenise('x.prm')",
                 "cell.bending_bracket.width", "homespun.Cell.read(3)", "sheet.vertices.shpe",
                 "homespun.homogenize('x.prm', orders=2)"]
        with tempfile.TemporaryDirectory(prefix="homespun-python-") as folder:
            wrong = pathlib.Path(folder, "wrong.py")
            wrong.write_text("import homespun\ncell = homespun.homogenize('x.prm')\n"
                             "sheet = homespun.Sheet(cell, 3, 3)\n" + "\n".join(lines) + "\n",
                             encoding="utf-8")
            result = self.mypy(wrong)
        found = {int(line) for line in re.findall(r"wrong\.py:(\d+): error", result.stdout)}
        self.assertEqual(found, set(range(4, 4 + len(lines))), result.stdout)


if __name__ == "__main__":
    unittest.main()
