#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The walls of the house: which room may include which, and what may stand where.

A wing is the folder of a source, such as shell/solver or localization; a room is a header
with its source. walls.py [ROOT] prints each violation with its place and ends with 1, or with 0;
walls.py --dot [ROOT] prints the wings and their arrows for graphviz: walls.py --dot | dot -Tsvg
"""
import collections
import pathlib
import re
import sys

from functions import functions

MESHES = {"meshes/plain", "meshes/files", "meshes/cloth", "meshes/garment"}
CELLS = {"homogenization/cell", "homogenization/lint", "homogenization/fem"}
SHELL = {"shell/algebra", "shell/membrane", "shell/terms", "shell/solver"}

# What the headers and sources of a wing may include beside their own.
MAY_INCLUDE = {
    "meshes/plain": set(),
    "meshes/cloth": {"meshes/plain"},
    "meshes/files": {"meshes/plain", "meshes/cloth"},
    "meshes/garment": {"meshes/plain", "meshes/cloth"},
    "homogenization/mesh_files": {"meshes/plain", "meshes/files"},
    "homogenization/cell": {"meshes/plain", "meshes/files", "homogenization/mesh_files"},
    "homogenization/lint": {"meshes/plain", "homogenization/cell"},
    "homogenization/algebra": {"meshes/plain"},
    "homogenization/edges": {"meshes/plain", "homogenization/algebra", "homogenization/bracket",
                             "homogenization/cell"},
    "homogenization/fem": {"meshes/plain", "meshes/files", "homogenization/algebra",
                           "homogenization/cell"},
    "homogenization/bracket": {"meshes/plain", "homogenization/algebra", "homogenization/cell"},
    "shell/algebra": {"meshes/plain"},
    "shell/membrane": {"meshes/plain", "meshes/cloth", "shell/algebra"},
    "shell/terms": {"meshes/plain", "meshes/cloth", "shell/algebra", "shell/membrane"},
    "shell/solver": {"meshes/plain", "shell/algebra", "shell/membrane", "shell/terms"},
    "shell/contact": {"meshes/plain", "meshes/cloth", "shell/algebra", "shell/terms"},
    "localization": {"meshes/plain"},
    "localization/garment": {"meshes/plain", "meshes/cloth", "meshes/garment", "localization"},
    "python": {"shell/solver", "shell/terms", "localization", "localization/garment",
               "homogenization/lint", "verification/cell"} | MESHES,
    "verification/record": {"meshes/plain", "meshes/files"},
    "verification/law": {"meshes/plain", "verification/newton"},
    "verification/newton": {"meshes/plain"},
    "verification/reference": {"meshes/plain", "meshes/cloth", "homogenization/algebra",
                               "homogenization/fem", "homogenization/bracket",
                               "verification/record", "verification/newton", "verification/law"},
    "verification/ellipticity": {"meshes/plain", "homogenization/cell", "verification/record",
                                 "verification/newton", "verification/law",
                                 "verification/reference"},
    "verification/periodic_cell": {"meshes/plain", "verification/newton", "verification/law"},
    "verification/cell": {"meshes/plain", "meshes/files", "homogenization/bracket",
                          "homogenization/edges", "verification/record"} | CELLS,
    "verification/command": {"meshes/plain", "meshes/files", "homogenization/cell",
                             "verification/record", "verification/cell", "verification/method"},
    "verification/method": {"meshes/plain", "meshes/cloth", "localization", "shell/algebra",
                            "shell/membrane", "shell/solver", "shell/terms", "verification/law",
                            "verification/reference", "verification/periodic_cell"},
    # Studies, which have folders of their own inside.
    "verification/homogenize": {"verification/cell"} | CELLS,
    "verification/strain": {"verification/law", "verification/reference",
                            "verification/ellipticity", "verification/cell",
                            "verification/method", "verification/periodic_cell",
                            "homogenization/bracket", "localization"}
    | MESHES | CELLS | SHELL,
    "verification/bend": {"verification/cell", "homogenization/bracket", "homogenization/cell",
                          "homogenization/edges", "meshes/cloth"} | SHELL,
    "verification/converge": {"verification/reference", "verification/ellipticity",
                              "verification/bend", "verification/cell", "verification/method",
                              "homogenization/bracket", "homogenization/algebra", "localization"}
    | MESHES | CELLS | SHELL,
    "verification/drape": {"verification/law", "verification/reference",
                           "verification/ellipticity", "verification/cell",
                           "verification/method", "localization", "localization/garment",
                           "shell/contact"} | MESHES | CELLS | SHELL,
    "verification/stress": {"verification/ellipticity", "verification/cell", "verification/drape",
                            "localization", "homogenization/bracket"} | MESHES | CELLS | SHELL,
    "verification/periodic": {"verification/newton", "verification/reference",
                              "verification/periodic_cell", "verification/cell",
                              "verification/ellipticity", "homogenization/cell"},
    "verification/upsample": {"meshes/files", "meshes/cloth", "meshes/garment", "localization",
                              "localization/garment"},
    "verification/judge": {"meshes/plain", "meshes/files", "homogenization/mesh_files",
                           "verification/record", "verification/command", "verification/law",
                           "verification/method", "verification/cell", "verification/strain",
                           "verification/drape"},
    "verification/verify": {"meshes/plain", "verification/record", "verification/command",
                            "verification/cell", "verification/homogenize", "verification/strain",
                            "verification/bend", "verification/converge", "verification/drape",
                            "verification/periodic", "verification/stress"} | CELLS,
    "verification/program": {"meshes/plain", "meshes/files", "verification/record",
                             "verification/command", "verification/ellipticity",
                             "verification/method", "verification/cell",
                             "verification/reference", "verification/judge",
                             "verification/verify"} | CELLS,
}
STUDIES = {"verification/homogenize", "verification/strain", "verification/bend",
           "verification/converge", "verification/drape", "verification/stress",
           "verification/periodic", "verification/upsample"}
for study in STUDIES:
    MAY_INCLUDE[study] |= {"meshes/plain", "verification/record", "verification/command"}
MAY_INCLUDE["verification/program"] |= STUDIES  # its one list of commands
FOLDERS = sorted({wing.split("/")[0] for wing in MAY_INCLUDE})

# What may be included where: a pattern of the include, the places (wings, and ends of paths), why.
PLACES = [
    (r"<deal\.II/(?!base/)", {"homogenization/fem", "verification/reference"},
     "finite elements of deal.II are used where finite elements are"),
    (r"<deal\.II/", {"homogenization/fem", "verification/reference",
                     "verification/program/mpi_start.h"},
     "the rest of the house compiles without deal.II, in seconds"),
    (r"<(Epetra|ml_|Amesos)", set(), "Trilinos is reached through deal.II's wrappers"),
    (r"<CLI/", {"verification/program", "verification/command", "_command.h", "_command.cc"},
     "the command line is read by commands"),
    (r"<nlohmann/", {"verification/record"}, "JSON is written and read in record/"),
]
# What finite elements stand on: names of deal.II that a wing uses in its code, not in includes.
GROUND = {
    "homogenization/fem": ("parallel::shared::Triangulation<2>", "DoFHandler<2>", "FESystem<2>",
                           "FE_SimplexP<2>", "MappingFE<2>", "FEValues<2>",
                           "AffineConstraints<double>", "TrilinosWrappers::SparseMatrix",
                           "SolverCG<", "TrilinosWrappers::PreconditionAMG",
                           "TrilinosWrappers::SolverDirect", "DataOut<2>"),
    "verification/reference": ("homogenization::Discretization", "FEValues<2>",
                               "AffineConstraints<double>"),
}
MOST_FILES = 40
SOURCES = (".cc", ".h", ".py", ".js")
AT_THE_TOP = {"CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE", "CHANGELOG.md",
              "CITATION.cff", "bootstrap"}  # beside folders and dot files
MOST_LINES = 400
MOST_COLUMNS = 100
MOST_LINES_OF_FUNCTION = 80
MOST_PARAMETERS = 6
INSTALLED = ("meshes/", "homogenization/", "shell/", "localization/")  # whose headers are public
# Other files that are held to MOST_COLUMNS, with the sources: of the build, and in Python.
OTHER_TEXTS = (r"(.*/)?CMakeLists\.txt|.*\.cmake(\.in)?|bootstrap|"
               r"tests/(mutants|walls|verification/program|verification/published)/\w+\.py")
# A limit says where it comes from, not how somebody came to it.
DIARY = (r'"[^"]*\b(beforehand|before any|set before|what was asked for|until now|formerly|'
         r'previously)\b')
OTHER_NOTES = r"METHOD [0-9]|FRONTIER|DESIGN"  # documents that are not part of the repository


def wing_of(path):
    """The wing of a file, or None where it stands in none."""
    wing, _, inside = path.rpartition("/")[0].rpartition("/")
    if f"{wing}/{inside}".strip("/") in MAY_INCLUDE:
        return f"{wing}/{inside}".strip("/")
    return wing if wing in STUDIES else None  # a study has folders of its own


def room_of(path):
    return path.rsplit(".", 1)[0]


class House:
    """The sources below a folder: {path: text}."""

    def __init__(self, root):
        self.root = pathlib.Path(root)
        self.tests = self._sources("tests")
        self.product = {path: text for folder in FOLDERS
                        for path, text in self._sources(folder).items()}
        if not self.product:
            raise SystemExit(f"{root}: no sources in {', '.join(FOLDERS)}; nothing to check")
        self.others = self._others()

    def _sources(self, folder):
        found = sorted(p for p in (self.root / folder).rglob("*") if p.suffix in (".h", ".cc"))
        return {p.relative_to(self.root).as_posix(): p.read_text(encoding="utf-8") for p in found}

    def _others(self):
        """{path: text} of OTHER_TEXTS, at the top and in the folders of sources and tests."""
        found = [*self.root.iterdir()]
        for folder in [*FOLDERS, "tests"]:
            found += (self.root / folder).rglob("*")
        names = sorted(p.relative_to(self.root).as_posix() for p in found if p.is_file())
        return {name: (self.root / name).read_text(encoding="utf-8") for name in names
                if re.fullmatch(OTHER_TEXTS, name)}

    def includes(self):
        """(file, what stands between the quotes or brackets, brackets included)."""
        for path, text in self.product.items():
            for name in re.findall(r'^\s*#\s*include\s*("[^"]+"|<[^>]+>)', text, re.M):
                yield path, name

    def own_includes(self):
        for path, name in self.includes():
            target = name.strip('"')
            is_made = re.search("/(build_info|claims_text).h", target)  # by the build
            if name[0] == '"' and target.split("/")[0] in FOLDERS and not is_made:
                yield path, target


def arrows(house):
    """Files in no wing, and includes that the table does not allow."""
    for path in house.product:
        if wing_of(path) is None:
            yield f"{path}: stands in no wing; expected one of those in walls.py"
    for path, target in house.own_includes():
        here, there = wing_of(path), wing_of(target)
        if here and here != there and there not in MAY_INCLUDE[here]:
            yield f"{path}: includes {target}, which {here} may not"


def unused_arrows(house):
    """Arrows between wings of one folder that the table allows and nobody uses."""
    used = {(wing_of(path), wing_of(target)) for path, target in house.own_includes()}
    for here, allowed in MAY_INCLUDE.items():
        for there in sorted(allowed):
            if here.split("/")[0] == there.split("/")[0] and (here, there) not in used:
                yield f"walls.py: {here} may include {there} and does not; close that door"


def circles(house):
    """Rooms that reach themselves."""
    graph = {}
    for path, target in house.own_includes():
        if room_of(path) != room_of(target):
            graph.setdefault(room_of(path), set()).add(room_of(target))
    state = {}

    def visit(room, way):
        state[room] = "open"
        for other in sorted(graph.get(room, ())):
            if state.get(other) == "open":
                yield "circle: " + " -> ".join(way[way.index(other):] + [other])
            elif other not in state:
                yield from visit(other, way + [other])
        state[room] = "done"

    for room in sorted(graph):
        if room not in state:
            yield from visit(room, [room])


def places(house):
    """Libraries outside of their rooms."""
    for path, name in house.includes():
        for pattern, where, why in PLACES:
            if (re.match(pattern, name) and wing_of(path) not in where
                    and not path.endswith(tuple(where or "-"))):
                yield f"{path}: includes {name}; {why}"


def ground(house):
    """Finite elements that no longer stand on deal.II."""
    for wing, names in GROUND.items():
        code = "\n".join(re.sub(r"//.*|^\s*#\s*include.*", "", text, flags=re.M)
                         for path, text in house.product.items() if wing_of(path) == wing)
        for name in names:
            if name not in code:
                yield f"{wing}: uses no {name}; finite elements stand on deal.II's"


def rows(house):
    """Columns of tables by their number."""
    for path, text in house.product.items():
        if not path.startswith("verification/record/"):
            for found in re.finditer(r"\brow\[\d+\]", text):
                line = text.count("\n", 0, found.start()) + 1
                yield f"{path}:{line}: {found[0]}; columns have names"


def test_headers(house):
    """Headers that only tests include, unless a README lists them as public."""
    used = {target for path, target in house.own_includes() if room_of(path) != room_of(target)}
    for path in house.product:
        if not path.endswith(".h") or path in used:
            continue
        readme = house.root / path.split("/")[0] / "README.md"
        text = readme.read_text(encoding="utf-8") if readme.exists() else ""
        listed = " ".join(re.findall(r"^Public: (.*)$", text, re.M))
        if f"`{pathlib.Path(path).name}`" not in listed:
            yield (f"{path}: no product file includes it, and no line 'Public: ...' of the "
                   "folder's README.md lists it")


def unlisted_tests(house):
    """Tests in Python that no CMakeLists.txt names or finds by a pattern."""
    lists = {path[:-len("CMakeLists.txt")]: re.sub(r"\S+\.cc|#.*|COMMENT.*", "", text)
             for path, text in house.others.items() if path.endswith("CMakeLists.txt")}
    for path in house.others:
        stem = pathlib.Path(path).stem
        names = {"test_": rf"test_\*\.py|\b{stem[5:]}\b", "_test": rf"\b{stem[:-5]}(_test)?\b"}
        for mark in (stem[:5], stem[-5:]):
            if path.endswith(".py") and mark in names and not any(
                    path.startswith(folder) and re.search(names[mark], text)
                    for folder, text in lists.items()):
                yield f"{path}: no CMakeLists.txt above it names it, so that nothing runs it"


def top_level(house):
    """Files at the top that belong into a folder."""
    for path in sorted(house.root.iterdir()):
        if path.is_file() and path.name[0] != "." and path.name not in AT_THE_TOP:
            yield f"{path.name}: stands at the top; expected it in a folder"


def sizes(house):
    """Folders and files that hold too much."""
    n_files = collections.Counter(
        path.parent.relative_to(house.root).as_posix() for folder in [*FOLDERS, "tests"]
        for path in (house.root / folder).rglob("*") if path.suffix in SOURCES)
    for folder, n in n_files.items():
        if n > MOST_FILES:
            yield f"{folder}: {n} source files; at most {MOST_FILES}: give it rooms"
    for path, text in {**house.product, **house.tests, **house.others}.items():
        n = text.count("\n")
        if n > MOST_LINES:
            yield f"{path}: {n} lines; at most {MOST_LINES}: give its second idea a file"


def signatures(house):
    """Functions that are too long, or that a caller cannot read."""
    for path, text in house.product.items():
        for name, line, n_lines, parameters in functions(text):
            here = f"{path}:{line}: {name}"
            if n_lines > MOST_LINES_OF_FUNCTION:
                yield f"{here}: {n_lines} lines; at most {MOST_LINES_OF_FUNCTION}"
            if len(parameters) > MOST_PARAMETERS:
                yield (f"{here}: {len(parameters)} parameters; at most {MOST_PARAMETERS}: what "
                       "belongs together is a struct")
            if path.startswith(INSTALLED) and path.endswith(".h") and any(
                    re.match(r"(const )?bool\b(?!.*&)", parameter) for parameter in parameters):
                yield f"{here}: a boolean parameter; expected an enum, which says what it chooses"


def texts(house):
    """Lines that are too long, mentions of documents that a reader does not have, and texts of the
    program that tell its own story.
    """
    for path, text in {**house.product, **house.tests, **house.others}.items():
        for number, line in enumerate(text.split("\n"), 1):
            if len(line) > MOST_COLUMNS:
                yield f"{path}:{number}: {len(line)} columns; at most {MOST_COLUMNS}"
            if path not in house.others and re.search(OTHER_NOTES, line):
                yield f"{path}:{number}: names a document that is not part of the repository"
            if path in house.product and re.search(DIARY, line):
                yield f"{path}:{number}: tells how a limit came about, not what it follows from"


RULES = [arrows, unused_arrows, circles, places, ground, rows, test_headers, unlisted_tests,
         top_level, sizes, signatures, texts]


def violations(root, rules=None):
    house = House(root)
    return [text for rule in rules or RULES for text in rule(house)]


def picture(house):
    """The wings for graphviz, an arrow from who includes to what, with the number of includes."""
    counts = {}
    for path, target in house.own_includes():
        arrow = wing_of(path), wing_of(target)
        if arrow[0] != arrow[1]:
            counts[arrow] = counts.get(arrow, 0) + 1
    lines = ["digraph house {", "rankdir=BT; node [shape=box];"]
    for folder in FOLDERS:
        wings = " ".join(f'"{wing}";' for wing in MAY_INCLUDE if wing.split("/")[0] == folder)
        lines.append(f'subgraph "cluster_{folder}" {{ label="{folder}"; {wings} }}')
    lines += [f'"{here}" -> "{there}" [label={n}];' for (here, there), n in sorted(counts.items())]
    return "\n".join([*lines, "}"])


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--dot"]
    root = arguments[0] if arguments else pathlib.Path(__file__).resolve().parents[2]
    if "--dot" in sys.argv:
        print(picture(House(root)))
        return 0
    found = violations(root)
    for text in found:
        print(text)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
