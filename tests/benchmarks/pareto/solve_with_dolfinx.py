# SPDX-License-Identifier: MIT
"""The three cell problems by FEniCSx and dolfinx_mpc: a cell as .npz in, a line of JSON out.

The mesh comes as arrays, so that no time goes into reading text. Factored once for the three loads,
by MUMPS or CHOLMOD, or solved by conjugate gradients with hypre's or PETSc's multigrid. What
FEniCSx compiles for a form is kept on disk by FEniCSx, so that a second run has it.
"""
import argparse
import json
import time

start = time.perf_counter()

import dolfinx
import dolfinx_mpc
import numpy
import ufl
from dolfinx import fem
from mpi4py import MPI
from petsc4py import PETSc

DIRECT = ("mumps", "cholmod")


def periodic_space(arrays, order):
    """The space of displacements and its periodic constraints; a corner is held."""
    vertices, triangles = arrays["vertices"], arrays["triangles"]
    length = float(vertices.max())
    element = ufl.Mesh(ufl.VectorElement("Lagrange", ufl.triangle, 1))
    mesh = dolfinx.mesh.create_mesh(MPI.COMM_SELF, triangles, vertices, element)
    space = fem.VectorFunctionSpace(mesh, ("Lagrange", order))
    near = 1e-9 * length

    def corners(x):
        at = [(abs(x[k]) < near) | (abs(x[k] - length) < near) for k in (0, 1)]
        return at[0] & at[1]

    held = fem.dirichletbc(
        numpy.zeros(2), fem.locate_dofs_geometrical(space, corners), space
    )
    constraint = dolfinx_mpc.MultiPointConstraint(space)
    for axis in (0, 1):

        def far_side(x, axis=axis):
            return (abs(x[axis] - length) < near) & ~corners(x)

        def near_side(x, axis=axis):
            moved = x.copy()
            moved[axis] -= length
            return moved

        constraint.create_periodic_constraint_geometrical(space, far_side, near_side, [held])
    constraint.finalize()
    return mesh, space, held, constraint


def stiffness_field(mesh, arrays):
    """C of each triangle, Voigt order."""
    constants = fem.FunctionSpace(mesh, ufl.TensorElement("DG", mesh.ufl_cell(), 0, (3, 3)))
    stiffness = fem.Function(constants)
    material = arrays["material"][mesh.topology.original_cell_index]
    stiffness.x.array[:] = arrays["stiffness"][material].ravel()
    return stiffness


def strain(u):
    return ufl.as_vector([u[0].dx(0), u[1].dx(1), u[0].dx(1) + u[1].dx(0)])


def solver_of(matrix, name, space):
    solver = PETSc.KSP().create(MPI.COMM_SELF)
    solver.setOperators(matrix)
    preconditioner = solver.getPC()
    if name in DIRECT:
        solver.setType("preonly")
        preconditioner.setType("cholesky")
        preconditioner.setFactorSolverType(name)
    else:
        solver.setType("cg")
        solver.setTolerances(rtol=1e-10, max_it=2000)
        preconditioner.setType(name)
        if name == "gamg":
            modes = rigid_modes(space)
            matrix.setNearNullSpace(PETSc.NullSpace().create(vectors=modes))
    return solver


def rigid_modes(space):
    points = space.tabulate_dof_coordinates()
    modes = []
    for direction in range(3):
        values = numpy.zeros((len(points), 2))
        if direction < 2:
            values[:, direction] = 1
        else:
            values[:, 0], values[:, 1] = -points[:, 1], points[:, 0]
        modes.append(PETSc.Vec().createWithArray(values.ravel().copy()))
    basis = []
    for mode in modes:
        for other in basis:
            mode.axpy(-mode.dot(other), other)
        mode.normalize()
        basis.append(mode)
    return basis


def effective_stiffness(arrays, order, solver_name):
    mesh, space, held, constraint = periodic_space(arrays, order)
    c = stiffness_field(mesh, arrays)
    u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
    matrix = dolfinx_mpc.assemble_matrix(
        fem.form(ufl.inner(c * strain(u), strain(v)) * ufl.dx), constraint, bcs=[held]
    )
    matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    matrix.setBlockSize(2)
    solver = solver_of(matrix, solver_name, space)
    unit = fem.Constant(mesh, numpy.zeros(3))
    load = fem.form(ufl.inner(c * unit, strain(v)) * ufl.dx)
    fields = []
    for direction in range(3):
        unit.value[:] = 0
        unit.value[direction] = 1
        right = dolfinx_mpc.assemble_vector(load, constraint)
        fem.petsc.set_bc(right, [held])
        chi = fem.Function(constraint.function_space)
        solver.solve(right, chi.vector)
        if solver.getConvergedReason() < 0:
            raise RuntimeError(f"the solver ended with {solver.getConvergedReason()}")
        constraint.backsubstitution(chi.vector)
        fields.append(chi)
    return energies(mesh, c, fields, float(arrays["vertices"].max()) ** 2)


def energies(mesh, c, fields, area):
    """C_ab = 1/area integral (e_a - eps(chi_a)) : c : (e_b - eps(chi_b)), by one form for all."""
    units = [fem.Constant(mesh, numpy.zeros(3)) for _ in range(2)]
    chis = [fem.Function(fields[0].function_space) for _ in range(2)]
    first, second = (unit - strain(chi) for unit, chi in zip(units, chis))
    energy = fem.form(ufl.inner(c * first, second) * ufl.dx)
    stiffness = numpy.zeros((3, 3))
    for row in range(3):
        for column in range(row + 1):
            for side, direction in enumerate((row, column)):
                units[side].value[:] = numpy.eye(3)[direction]
                chis[side].x.array[:] = fields[direction].x.array
            value = fem.assemble_scalar(energy) / area
            stiffness[row, column] = stiffness[column, row] = value
    return stiffness


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cell")
    parser.add_argument("--order", type=int, default=1)
    parser.add_argument("--solver", choices=(*DIRECT, "hypre", "gamg"), default="mumps")
    options = parser.parse_args()
    arrays = dict(numpy.load(options.cell))
    imported = time.perf_counter()
    stiffness = effective_stiffness(arrays, options.order, options.solver)
    end = time.perf_counter()
    print(
        json.dumps(
            {
                "C": stiffness.tolist(),
                "seconds_solver": end - imported,
                "seconds_start": imported - start,
            }
        )
    )


if __name__ == "__main__":
    main()
