#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Any mesh but .msh as text .msh, which homespun reads: convert_mesh.py MESH RESULT.msh

meshio reads the mesh, Gmsh a .unv; of Abaqus' decks meshio knows too little. Kept are points,
triangles and quadrilaterals in their order, the group of each with its name, cell data `angle`.
What cannot be a cell is refused with status 2 and one line: found, expected, what to do.
homespun carries this text in itself, behind that of abaqus_deck.py, and hands it to Python, which
hence needs no file of it.
"""
import base64
import contextlib
import io
import os
import sys
import warnings

# Cell data of these names, in lower case, tell the groups.
GROUP_ARRAYS = {
    "material", "materialid", "material_id", "material_ids", "group", "groups", "phase",
    "cellentityids", "gmsh:physical", "avsucd:material", "cell_tags", "medit:ref", "nastran:ref",
    "netgen:index", "su2:tag", "ugrid:ref",
}
CORNERS = {"triangle": 3, "quad": 4}
NEEDLESS = {"vertex", "line", "line3"}
STRAIGHT_AND_FLAT = (
    "expected triangles with 3 and quadrilaterals with 4 corners: mesh the surface alone, with "
    "elements of first order (Gmsh: -2 -order 1); triangles with 6 nodes, whose sides are curved, "
    "are read from .msh alone")
WHOLE = "expected a whole mesh: write it again, or save it as .msh with Gmsh"


def up_to_the_padding(text, decode=base64.b64decode):
    """What stands in base64 before the first padding. Of a .vtu meshio hands on all that follows an
    array too, and Python decodes no more than this up to 3.12, but refuses it since.
    """
    text = "".join((text.decode("ascii") if isinstance(text, bytes) else text).split())
    end = text.find("=")
    return decode(text if end < 0 else text[:end // 4 * 4 + 4])


class Refusal(Exception):
    pass


class Mesh:
    """Points (n,3); of each element its corners, its group, its angle or None."""

    def __init__(self, points):
        self.points = points
        self.other_data = []  # names of cell data that tell neither groups nor angles
        self.corners, self.groups, self.angles = [], [], []
        self.number_of_name = {}

    def add(self, corners, groups, angles=None):
        self.corners += corners
        self.groups += groups
        self.angles += [None] * len(corners) if angles is None else angles


def library(name, package):
    try:
        return __import__(name)
    except ImportError as error:
        raise Refusal(f"Python has no {name} ({error}), which reads this format; expected the "
                      f"package {package}: apt-get install {package}, or save the mesh as .msh "
                      "with Gmsh") from error


# meshio -------------------------------------------------------------------------------------------


def by_meshio(path, kind, ending):
    """What meshio makes of a file; what it refuses, in its own words.

    @param kind of meshio; None: by the ending of the file
    """
    meshio, said = library("meshio", "python3-meshio"), io.StringIO()
    base64.b64decode = up_to_the_padding
    try:
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            read = meshio.read(path, file_format=kind)
    except ModuleNotFoundError as missing:
        package = f"python3-{missing.name.lower()}"
        raise Refusal(f"meshio reads this format by {missing.name}, which Python has not; expected "
                      f"the package {package}: apt-get install {package}") from missing
    except (Exception, SystemExit) as error:  # meshio ends the program where it refuses a file
        why = said.getvalue().strip().split("\n")[0] or f"{type(error).__name__}: {error}"
        todo = STRAIGHT_AND_FLAT if "cannot handle" in why else WHOLE
        raise Refusal(f"found what meshio cannot read as {ending} ({why}); {todo}") from error
    if "cannot handle" in said.getvalue():  # and leaves out
        raise Refusal(f"holds elements that meshio does not know; {STRAIGHT_AND_FLAT}")
    return read


def of_one_component(mesh, name):
    """Values of cell data, a flat array per block of cells, or None for vectors."""
    blocks = mesh.cell_data[name]
    if any(its.ndim > 2 or (its.ndim == 2 and its.shape[1] != 1) for its in blocks):
        return None
    return [its.reshape(-1) for its in blocks]


def data_called(mesh, names):
    """{name: values} of the cell data whose name in lower case is one of `names`."""
    found = {name: of_one_component(mesh, name) for name in mesh.cell_data
             if name.lower() in names}
    return {name: values for name, values in found.items() if values is not None}


def groups_by_array(mesh):
    """The number of each cell, by block, and {name: number}; None where no array tells it."""
    found = data_called(mesh, GROUP_ARRAYS)
    if not found:
        return None, {}
    first, *others = found
    for other in others:
        if any((one != two).any() for one, two in zip(found[first], found[other])):
            raise Refusal(f"found the cell data `{first}` and `{other}`, which differ; expected "
                          "one that tells the group of every element: leave the other one out")
    groups, names = found[first], {}
    for name, its in mesh.field_data.items():  # (number, dimension), of Gmsh's
        if getattr(its, "shape", None) == (2,) and its[1] == 2:
            names[name] = int(its[0])
    families = getattr(mesh, "cell_tags", {})  # of MED, where groups have negative numbers
    for number, its in families.items():
        if len(its) > 1 and any((block == number).any() for block in groups):
            refuse_two_sets("an element", its[0], its[1])
        names.update({name: abs(int(number)) for name in its})
    return [abs(block) for block in groups] if families else groups, names


def groups_by_sets(mesh):
    """As groups_by_array(), from sets of cells; 0 where a cell is in none."""
    first_of_block, names = [0], []
    for block in mesh.cells:
        first_of_block.append(first_of_block[-1] + len(block.data))
    set_of_cell = {}
    for name, members in mesh.cell_sets.items():
        if name == "gmsh:bounding_entities":
            continue
        for first, its in zip(first_of_block, members):
            for cell in () if its is None else its:
                put(set_of_cell, first + int(cell), name, f"element {first + int(cell) + 1}")
    numbers, names = numbered([set_of_cell.get(cell) for cell in range(first_of_block[-1])])
    return [numbers[a:b] for a, b in zip(first_of_block, first_of_block[1:])], names


def angles_of(mesh):
    """Cell data `angle` of each cell, by block; None where there are none."""
    there = [name for name in mesh.cell_data if name.lower() == "angle"]
    if not there and any(name.lower() == "angle" for name in mesh.point_data):
        raise Refusal("found `angle` at the points; expected cell data, degrees for each element: "
                      "in ParaView, Point Data to Cell Data")
    found = data_called(mesh, {"angle"})
    if there and not found:
        raise Refusal(f"found cell data `{there[0]}` with several components; expected one number "
                      "for each element, degrees from the x axis")
    return next(iter(found.values()), None)


def of_meshio(read):
    """A Mesh of meshio's."""
    groups, names = groups_by_array(read)
    if groups is None:
        groups, names = groups_by_sets(read)
    angles = angles_of(read)
    mesh = Mesh([[*map(float, x), 0., 0.][:3] for x in read.points])
    for b, block in enumerate(read.cells):
        if block.type in NEEDLESS:
            continue
        if block.type not in CORNERS or block.data.shape[1:] != (CORNERS[block.type],):
            raise Refusal(f"holds elements of meshio's type `{block.type}`; {STRAIGHT_AND_FLAT}")
        mesh.add(block.data.tolist(), [whole(group) for group in groups[b]],
                 None if angles is None else [float(angle) for angle in angles[b]])
    mesh.number_of_name = {name: n for name, n in names.items() if n in set(mesh.groups) and n > 0}
    mesh.other_data = sorted(set(read.cell_data) - set(data_called(read, GROUP_ARRAYS | {"angle"})))
    return mesh


# Sets of elements ---------------------------------------------------------------------------------


def refuse_two_sets(element, one, two):
    raise Refusal(f"{element} is in the sets `{one}` and `{two}`; expected one set per element, "
                  "that of its material: remove the other one")


def put(set_of, element, name, text):
    if set_of.setdefault(element, name) != name:
        refuse_two_sets(text, set_of[element], name)


def numbered(names):
    """Names as numbers from 1 on in the order of their appearance, None as 0; {name: number}."""
    number_of = {}
    numbers = [0 if name is None else number_of.setdefault(name, len(number_of) + 1)
               for name in names]
    return numbers, number_of


def whole(value):
    """A number of a group."""
    if not (0 <= value <= 1e9 and int(value) == value):
        raise Refusal(f"found the group {value}; expected a whole number from 0 to 1e9")
    return int(value)


# I-DEAS universal files ---------------------------------------------------------------------------


def in_order(text):
    """A .unv with points in front of elements and these in front of groups: Gmsh 4.8 dies of
    another order."""
    datasets, lines = [], None
    for line in text.splitlines():
        if line.strip() == "-1":
            if lines:
                datasets.append(lines)
            lines = [] if lines is None else None
        elif lines is not None:
            lines.append(line)
    if lines is not None:
        raise Refusal("found the end of the file inside a dataset; expected -1: it is cut off, "
                      "write it again")
    rank = {"2411": 0, "2412": 1}
    datasets.sort(key=lambda its: rank.get(its[0].strip(), 2))
    return "".join("\n".join(["    -1", *its, "    -1", ""]) for its in datasets)


def of_unv(text, passing):
    """A .unv by Gmsh.

    @param passing a file that may be written
    """
    with open(passing, "w", encoding="latin-1") as file:
        file.write(in_order(text))
    gmsh = library("gmsh", "python3-gmsh")
    gmsh.initialize(readConfigFiles=False)
    gmsh.option.setNumber("General.Terminal", 0)
    try:
        gmsh.open(passing)
    except Exception as error:
        raise Refusal(f"found what Gmsh cannot read as .unv ({error}); {WHOLE}") from error
    mesh_of = gmsh.model.mesh
    numbers, coordinates, _ = mesh_of.getNodes()
    points = dict(zip(numbers.tolist(), coordinates.reshape(-1, 3).tolist()))
    index = {number: k for k, number in enumerate(sorted(points))}
    has_groups = any(number > 0 for _, number in gmsh.model.getPhysicalGroups(2))
    elements = {}
    for dimension, entity in gmsh.model.getEntities():
        for kind, its, nodes in zip(*mesh_of.getElements(dimension, entity)):
            if dimension < 2:
                continue
            n = {2: 3, 3: 4}.get(kind)
            if n is None:
                raise Refusal(f"holds elements of Gmsh's type {kind}; {STRAIGHT_AND_FLAT}")
            group = group_of_entity(gmsh, entity) if has_groups else entity
            rows = nodes.reshape(-1, n).tolist()
            for number, corners in zip(its.tolist(), rows):
                elements[number] = ([index[node] for node in corners], group)
    mesh = Mesh([points[number] for number in sorted(points)])
    ordered = [elements[number] for number in sorted(elements)]
    mesh.add([corners for corners, _ in ordered], [group for _, group in ordered])
    for group in set(mesh.groups) if has_groups else ():
        name = gmsh.model.getPhysicalName(2, group)
        if name:
            mesh.number_of_name[name] = group
    return mesh


def group_of_entity(gmsh, entity):
    """Gmsh gathers in an entity what is in the same groups."""
    groups = [g for g in gmsh.model.getPhysicalGroupsForEntity(2, entity).tolist() if g > 0]
    if len(groups) > 1:
        one, two = (gmsh.model.getPhysicalName(2, group) or str(group) for group in groups[:2])
        refuse_two_sets("an element", one, two)
    return groups[0] if groups else 0


# Reading and writing ------------------------------------------------------------------------------


def text_of(path):
    with open(path, encoding="latin-1") as file:
        return file.read()


def read(path, result):
    ending = os.path.splitext(path)[1].lower()
    if ending == ".unv":
        return of_unv(text_of(path), result + ".unv")
    # Both AVS and Abaqus write .inp: Abaqus' keywords and comments begin with stars.
    if ending == ".inp" and text_of(path).lstrip().startswith("*"):
        return of_abaqus(text_of(path))
    if ending in (".inp", ".ucd"):
        return of_meshio(by_meshio(path, "avsucd", ending))
    known = library("meshio", "python3-meshio").extension_to_filetypes
    if ending not in known:
        raise Refusal(f"its ending is `{ending}`; expected .msh, .unv, .ucd or one that meshio "
                      f"reads, {', '.join(sorted(known))}: convert it, in ParaView by Save Data as "
                      ".vtu, with Gmsh by -save -o cell.msh")
    if ending in (".xdmf", ".xmf") and "HDF" in text_of(path):
        raise Refusal("found data in another file; expected one whole file: save it as .vtu")
    return of_meshio(by_meshio(path, None, ending))


def check(mesh):
    n = len(mesh.points)
    for corners in mesh.corners:
        for point in corners:
            if not 0 <= point < n:
                raise Refusal(f"an element names point {point}; expected 0 to {n - 1}: write the "
                              "file again")


def write(mesh, path):
    """Gmsh's format 2.2; `angle` as $ElementData, and the names of other data."""
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat",
             "$PhysicalNames", f"{len(mesh.number_of_name)}"]
    for name, number in mesh.number_of_name.items():
        lines.append(f'2 {number} "{" ".join(name.split())}"')
    lines += ["$EndPhysicalNames", "$Nodes", f"{len(mesh.points)}"]
    lines += [f"{k} {x!r} {y!r} {z!r}" for k, (x, y, z) in enumerate(mesh.points)]
    lines += ["$EndNodes", "$Elements", f"{len(mesh.corners)}"]
    for k, (corners, group) in enumerate(zip(mesh.corners, mesh.groups)):
        lines.append(f"{k} {len(corners) - 1} 2 {group} 0 {' '.join(map(str, corners))}")
    lines.append("$EndElements")
    if mesh.angles and mesh.angles[0] is not None:
        lines += ["$ElementData", "1", '"angle"', "1", "0.0", "3", "0", "1", f"{len(mesh.angles)}"]
        lines += [f"{k} {angle!r}" for k, angle in enumerate(mesh.angles)]
        lines.append("$EndElementData")
    for name in mesh.other_data:
        name = " ".join(name.replace('"', "'").split())
        lines += ["$ElementData", "1", f'"{name}"', "1", "0.0", "3", "0", "1", "0",
                  "$EndElementData"]
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


def main():
    warnings.simplefilter("ignore")
    path, result = sys.argv[1:]
    try:
        mesh = read(path, result)
        check(mesh)
        write(mesh, result)
    except Refusal as refusal:
        text = str(refusal)
    except OSError as error:
        text = f"found {error}; expected permission to read it and room to convert it"
    except Exception as error:
        text = f"found what cannot be a mesh ({type(error).__name__}: {error}); {WHOLE}"
    else:
        return 0
    print("".join(c if c.isprintable() else " " for c in text))
    return 2


if __name__ == "__main__":
    sys.exit(main())
