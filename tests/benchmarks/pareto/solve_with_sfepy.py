# SPDX-License-Identifier: MIT
"""The three cell problems by SfePy's homogenization engine: a cell as .npz in, a line of JSON out.

The mesh comes as arrays, so that no time goes into reading text. Factored once for the three loads
(`is_linear`); MUMPS where SfePy finds it, else SuperLU.
"""
import argparse
import json
import sys
import tempfile
import time

start = time.perf_counter()

import numpy
import sfepy.discrete.fem.periodic as periodic
import sfepy.homogenization.coefs_base as coefs_base
from sfepy.base.base import Struct, output
from sfepy.base.conf import ProblemConf, get_standard_keywords
from sfepy.discrete.fem import Mesh
from sfepy.discrete.fem.meshio import UserMeshIO
from sfepy.homogenization.homogen_app import HomogenizationApp
from sfepy.homogenization.utils import define_box_regions

ITERATIVE = {"method": "cg", "eps_r": 1e-10, "eps_a": 1e-30, "i_max": 2000}


def factored(package):
    """A Cholesky factorization by PETSc, kept over the three loads."""
    return {
        "method": "cg",
        "precond": "cholesky",
        "pc_factor_mat_solver_type": package,
        "eps_r": 1e-10,
        "eps_a": 1e-30,
        "force_reuse": True,
    }


SOLVERS = {
    "superlu": ("ls.scipy_superlu", {"use_presolve": True}),
    "mumps": ("ls.petsc", factored("mumps")),
    "cholmod": ("ls.petsc", factored("cholmod")),
    "gamg": ("ls.petsc", {"precond": "gamg", "force_reuse": True, **ITERATIVE}),
    "hypre": ("ls.petsc", {"precond": "hypre", "force_reuse": True, **ITERATIVE}),
}


def problem(arrays, order, solver, folder):
    vertices, length = arrays["vertices"], float(arrays["vertices"].max())
    periodic.set_accuracy(1e-9 * length)

    def mesh_hook(mesh, mode):
        if mode == "read":
            return Mesh.from_data(
                "cell", vertices, None, [arrays["triangles"]], [arrays["material"]], ["2_3"]
            )
        return None

    regions = {"Y": "all", "Ysoft": "cells of group 0", "Yhard": "cells of group 1"}
    regions.update(define_box_regions(2, (0, 0), (length, length), eps=1e-6 * length))
    return {
        "filename_mesh": UserMeshIO(mesh_hook),
        "regions": regions,
        "materials": {"mat": ({"D": dict(zip(("Ysoft", "Yhard"), arrays["stiffness"]))},)},
        "fields": {"corrector": ("real", 2, "Y", order)},
        "variables": {
            "u": ("unknown field", "corrector", 0),
            "v": ("test field", "corrector", "u"),
            "Pi": ("parameter field", "corrector", "u"),
            "Pi1": ("parameter field", "corrector", "(set-to-None)"),
            "Pi2": ("parameter field", "corrector", "(set-to-None)"),
        },
        "functions": {
            "match_x": (periodic.match_y_line,),
            "match_y": (periodic.match_x_line,),
        },
        "ebcs": {"fixed_u": ("Corners", {"u.all": 0.0})},
        "epbcs": {
            "periodic_x": (["Left", "Right"], {"u.all": "u.all"}, "match_x"),
            "periodic_y": (["Bottom", "Top"], {"u.all": "u.all"}, "match_y"),
        },
        "integrals": {"i": 1 if order == 1 else 2},
        "options": {
            "coefs": "coefs",
            "requirements": "requirements",
            "ls": "ls",
            "volume": {"value": length**2},
            "output_dir": folder,
            "coefs_filename": "coefs",
            "multiprocessing": False,
            "save_formats": [],
            "save_times": [],
        },
        "coefs": {
            "D": {
                "requires": ["pis", "corrs_rs"],
                "expression": "dw_lin_elastic.i.Y(mat.D, Pi1, Pi2)",
                "set_variables": [
                    ("Pi1", ("pis", "corrs_rs"), "u"),
                    ("Pi2", ("pis", "corrs_rs"), "u"),
                ],
                "class": coefs_base.CoefSymSym,
            },
            "filenames": {},
        },
        "requirements": {
            "pis": {"variables": ["u"], "class": coefs_base.ShapeDimDim},
            "corrs_rs": {
                "requires": ["pis"],
                "ebcs": ["fixed_u"],
                "epbcs": ["periodic_x", "periodic_y"],
                "equations": {
                    "balance": "dw_lin_elastic.i.Y(mat.D, v, u)"
                    " = - dw_lin_elastic.i.Y(mat.D, v, Pi)"
                },
                "set_variables": [("Pi", "pis", "u")],
                "class": coefs_base.CorrDimDim,
                "is_linear": True,
            },
        },
        "solvers": {
            "ls": SOLVERS[solver],
            "newton": ("nls.newton", {"i_max": 1, "eps_a": 1e-30, "is_linear": True}),
        },
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cell")
    parser.add_argument("--order", type=int, default=1)
    parser.add_argument("--solver", choices=SOLVERS, default="mumps")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    if not options.verbose:
        output.set_output(quiet=True)
    arrays = numpy.load(options.cell)
    imported = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        required, other = get_standard_keywords()
        required.remove("equations")
        conf = ProblemConf.from_dict(
            problem(arrays, options.order, options.solver, folder),
            sys.modules[__name__],
            required,
            other,
        )
        coefficients = HomogenizationApp(conf, Struct(output_filename_trunk=None), "homogen:")()
    end = time.perf_counter()
    print(
        json.dumps(
            {
                "C": numpy.asarray(coefficients.D).tolist(),
                "seconds_solver": end - imported,
                "seconds_start": imported - start,
            }
        )
    )


if __name__ == "__main__":
    main()
