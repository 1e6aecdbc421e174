# SPDX-License-Identifier: MIT
"""Error of C^H against seconds: homespun beside what Debian has for the same problem.

    /usr/bin/python3 tests/benchmarks/pareto/pareto.py --homespun build/release/homespun \\
        --output out/pareto

Solves cells whose C^H is known (answered_cells.py) on finer and finer meshes with each program that
is installed, one thread, and writes pareto.csv, pareto.json, pareto.svg and pareto.html: a quarter
of an hour on a quiet machine. A round runs every point once, so that what else the machine does
falls on all of them; times are medians over the rounds. python3-sfepy and python3-dolfinx-mpc are
optional: the page says what was missing.
"""
import argparse
import csv
import json
import os
import pathlib
import platform
import statistics
import subprocess
import sys
import tempfile
import time

import numpy

import answered_cells
import pareto_page

HERE = pathlib.Path(__file__).resolve().parent
PYTHON = sys.executable
# Packages of Debian, the module that must load, and the solver that was the fastest of those that
# the script offers, on 131,072 triangles.
PEERS = {
    "SfePy": (
        "solve_with_sfepy.py",
        "python3-sfepy, python3-petsc4py",
        "sfepy, petsc4py",
        "cholmod",
    ),
    "FEniCSx": (
        "solve_with_dolfinx.py",
        "python3-dolfinx, python3-dolfinx-mpc",
        "dolfinx, dolfinx_mpc",
        "mumps",
    ),
}
# Squares along a side, of P1 and P2; of the laminate, where every mesh leaves round-off alone, the
# first two.
SIZES = {1: (32, 64, 128, 256), 2: (16, 32, 64, 128)}
WIDTHS = ("1e-1", "1e-2", "1e-3", "1e-4", "1e-5")
COARSEST = 8  # squares along a side of the mesh that brackets begin with
COLUMNS = (
    "cell",
    "program",
    "method",
    "squares",
    "width_asked_for",
    "dofs",
    "seconds_median",
    "seconds_least",
    "seconds_most",
    "seconds_solver_median",
    "rounds",
    "memory_megabytes",
    "error",
    "error_guaranteed",
    "error_of_answer",
)


def run(command):
    """Seconds, peak memory [MB] and output of a program with one thread."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    start = time.perf_counter()
    with subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    ) as process:
        output, errors = process.stdout.read(), process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    seconds = time.perf_counter() - start
    if process.returncode not in (0, 1, 4):  # a width that was not reached is a claim that failed
        text = " ".join(map(str, command))
        raise RuntimeError(f"{text} ended with {process.returncode}: {errors}")
    return seconds, usage.ru_maxrss / 1024, output


class Homespun:
    """One way to ask homespun."""

    def __init__(self, program, folder, cell, squares, order=None, width=None):
        self.row = {
            "cell": cell,
            "program": "homespun",
            "method": f"P{order}" if order else "adaptive bracket",
            "squares": squares,
            "width_asked_for": width or "",
        }
        self.output = folder / "run"
        self.command = [program, "homogenize", folder / f"{cell}-{squares}.prm", "--quiet"]
        self.command += ["--overwrite", "--output", self.output]
        self.command += ["--order", str(order), "--no-bars"] if order else ["--tolerance", width]

    def measure(self):
        seconds, memory, _ = run(self.command)
        with open(self.output / "homogenize.json", encoding="utf-8") as file:
            found = json.load(file)
        return {
            "C": found["C"],
            "seconds": seconds,
            "seconds_solver": sum(found["seconds"].values()),
            "memory": memory,
            "dofs": found["dofs"],
            "lower": found.get("C_lower"),
            "upper": found.get("C_upper"),
        }


class Peer:
    """One way to ask another program."""

    def __init__(self, program, folder, cell, squares, order):
        script, _, _, solver = PEERS[program]
        self.row = {
            "cell": cell,
            "program": program,
            "method": f"P{order}",
            "squares": squares,
            "width_asked_for": "",
        }
        self.dofs = 2 * (squares * order) ** 2
        self.command = [PYTHON, HERE / script, folder / f"{cell}-{squares}.npz"]
        self.command += ["--order", str(order), "--solver", solver]

    def measure(self):
        seconds, memory, output = run(self.command)
        found = json.loads(output.splitlines()[-1])
        return {**found, "seconds": seconds, "memory": memory, "dofs": self.dofs}


def missing_peers():
    """{program: Debian's packages} of what does not load here."""
    missing = {}
    for program, (_, packages, modules, _) in PEERS.items():
        loads = subprocess.run(
            [PYTHON, "-c", f"import {modules}"], capture_output=True, check=False
        )
        if loads.returncode:
            missing[program] = packages
    return missing


def write_mesh(folder, name, squares):
    cell = answered_cells.make_cell(name, squares)
    answered_cells.write_cell_file(cell, folder / f"{name}-{squares}")
    numpy.savez(
        folder / f"{name}-{squares}.npz",
        vertices=cell.vertices,
        triangles=cell.triangles,
        material=cell.material,
        stiffness=cell.stiffness,
    )


def answer_of(program, folder, name, width):
    """C^H, half the width of what it is known to, and a sentence on where it comes from."""
    if name == "laminate":
        return answered_cells.laminate_stiffness(), 0.0, "closed form"
    found = Homespun(program, folder, name, COARSEST, width=width).measure()
    lower, upper = numpy.array(found["lower"]), numpy.array(found["upper"])
    answer = (lower + upper) / 2
    half_width = answered_cells.energy_error(upper, answer)
    text = f"middle of a bracket by homespun, known to {half_width:.1e}"
    if name == "checkerboard":
        bulk, product = answered_cells.duality_gap(answer)
        text += (
            f"; it misses the exact K by {bulk:.1e} and the exact product of both shear moduli by"
            f" {product:.1e}"
        )
    return answer, half_width, text


def extrapolated(points):
    """C of a peer's three finest P2 meshes, extrapolated by the order that they show, and what this
    moves it by, relative. Another code's word on an answer that homespun gave."""
    coarse, middle, fine = (numpy.array(values["C"]) for values in points)
    ratio = numpy.linalg.norm(coarse - middle) / numpy.linalg.norm(middle - fine)
    limit = fine - (middle - fine) / (ratio - 1)
    return limit, answered_cells.energy_error(limit, fine)


def points_of(program, folder, name, sizes, widths, peers):
    points = []
    for order, squares_of_order in sizes.items():
        for squares in squares_of_order:
            points.append(Homespun(program, folder, name, squares, order=order))
            points += [Peer(peer, folder, name, squares, order) for peer in peers]
    points += [Homespun(program, folder, name, COARSEST, width=width) for width in widths]
    return points


def row_of(point, measured, answer, half_width):
    seconds = [values["seconds"] for values in measured]
    last = measured[-1]
    guaranteed = ""
    if last.get("lower"):
        middle = (numpy.array(last["lower"]) + numpy.array(last["upper"])) / 2
        guaranteed = 2 * answered_cells.energy_error(numpy.array(last["upper"]), middle)
    return {
        **point.row,
        "dofs": last["dofs"],
        "seconds_median": statistics.median(seconds),
        "seconds_least": min(seconds),
        "seconds_most": max(seconds),
        "seconds_solver_median": statistics.median(v["seconds_solver"] for v in measured),
        "rounds": len(measured),
        "memory_megabytes": max(values["memory"] for values in measured),
        "error": answered_cells.energy_error(numpy.array(last["C"]), answer),
        "error_guaranteed": guaranteed,
        "error_of_answer": half_width,
    }


def study_of(name, options, folder, peers):
    """Rows of a cell and the sentences on its answer."""
    sizes = options.sizes
    if name == "laminate":
        sizes = {order: sizes[order][:2] for order in sizes}
    squares = {COARSEST, *(n for some in sizes.values() for n in some)}
    for n in squares:
        write_mesh(folder, name, n)
    answer, half_width, text = answer_of(options.homespun, folder, name, options.answer_width)
    print(f"{name}: {text}", flush=True)
    points = points_of(options.homespun, folder, name, sizes, options.widths, peers)
    measured = [[] for _ in points]
    for count in range(options.rounds):
        for point, its in zip(points, measured):
            its.append(point.measure())
        print(f"{name}: round {count + 1} of {options.rounds}", flush=True)
    if peers and name != "laminate":
        p2 = [
            its[-1]
            for point, its in zip(points, measured)
            if point.row["program"] == peers[0] and point.row["method"] == "P2"
        ]
        if len(p2) >= 3:
            limit, moved = extrapolated(p2[-3:])
            distance = answered_cells.energy_error(limit, answer)
            text += (
                f"; P2 of {peers[0]}, extrapolated by the order that its meshes show (which moves"
                f" it by {moved:.1e}), lies {distance:.1e} from it"
            )
    rows = [
        row_of(point, its, answer, half_width) for point, its in zip(points, measured)
    ]
    return rows, {"answer": text, "C": answer.tolist()}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--homespun", default="build/release/homespun", type=pathlib.Path)
    parser.add_argument("--output", default="out/pareto", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--quick", action="store_true", help="one round of small meshes")
    options = parser.parse_args()
    options.homespun = options.homespun.resolve()
    options.sizes, options.widths, options.answer_width = SIZES, WIDTHS, "1e-6"
    if options.quick:
        options.sizes = {1: (8, 16), 2: (8, 16)}
        options.widths, options.rounds, options.answer_width = WIDTHS[:2], 1, "1e-4"
    missing = missing_peers()
    peers = [peer for peer in PEERS if peer not in missing]
    rows, answers = [], {}
    with tempfile.TemporaryDirectory() as folder:
        for name in ("laminate", "inclusion", "checkerboard"):
            its_rows, answers[name] = study_of(name, options, pathlib.Path(folder), peers)
            rows += its_rows
    options.output.mkdir(parents=True, exist_ok=True)
    with open(options.output / "pareto.csv", "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    about = {
        "answers": answers,
        "missing": missing,
        "versions": versions(options.homespun, peers),
        "machine": f"{os.cpu_count()} cores, {platform.machine()}, one thread each",
        "load_average": os.getloadavg()[1],
    }
    with open(options.output / "pareto.json", "w", encoding="utf-8") as file:
        json.dump(about, file, indent=2)
    pareto_page.write(options.output)
    print(f"Written to {options.output}: pareto.csv, pareto.json, pareto.svg, pareto.html")


def versions(homespun, peers):
    its = {"homespun": run([homespun, "--version"])[2].splitlines()[0]}
    for peer in peers:
        module = PEERS[peer][2].split(",")[0]
        code = f"import {module}; print({module}.__version__)"
        its[peer] = f"{run([PYTHON, '-c', code])[2].strip()}, solver {PEERS[peer][3]}"
    return its


if __name__ == "__main__":
    main()
