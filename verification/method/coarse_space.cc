// SPDX-License-Identifier: MIT
#include "verification/method/coarse_space.h"

#include "shell/membrane/six_node_membrane.h"

#include <utility>

namespace homespun::verification
{
namespace
{
CoarseGrid grid_of(const meshes::Sheet &sheet, const int quads_per_cell)
{
  const int n1 = quads_per_cell * sheet.n1, n2 = quads_per_cell * sheet.n2;
  return {meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / quads_per_cell, n1, n2), n1,
          n2};
}

template <typename Sheet>
class SolverOf : public CoarseSolver
{
public:
  SolverOf(Sheet sheet, const std::vector<int> &held)
      : solvers(std::move(sheet), held)
  {
  }

  Positions solve_linear(const Positions &prescribed, const Positions &loads) const override
  {
    return solvers.solver(Law::linear).solve_linear(prescribed, loads);
  }

  shell::Equilibrium<2> solve_equilibrium(const Law law, const Positions &start,
                                          const Positions &loads) const override
  {
    return solvers.solver(law).solve_equilibrium(start, {}, loads);
  }

  Positions gradient(const Law law, const Positions &positions) const override
  {
    const Sheet &sheet = solvers.membrane(law);
    return law == Law::linear ? shell::linear_membrane_gradient(sheet, positions - sheet.vertices)
                              : shell::membrane_gradient<2>(sheet, positions).gradient;
  }

private:
  const SheetSolvers<Sheet> solvers;
};

/// The quadratic functions at the vertices of a grid half as wide as the nodes.
Eigen::SparseMatrix<double, Eigen::RowMajor>
values_on(const CoarseGrid &grid, const CoarseGrid &nodes, const shell::SixNodeMesh &mesh)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j <= grid.n2; ++j)
    for (int i = 0; i <= grid.n1; ++i)
    {
      // In which pair of triangles, and where in it; on a side either neighbour says the same.
      const int pair1 = std::min(i / 4, nodes.n1 / 2 - 1),
                pair2 = std::min(j / 4, nodes.n2 / 2 - 1);
      const double x = 0.25 * (i - 4 * pair1), y = 0.25 * (j - 4 * pair2);
      const int triangle = 2 * (pair2 * (nodes.n1 / 2) + pair1) + (y > x);
      const Eigen::RowVector3d at =
        y > x ? Eigen::RowVector3d(1. - y, x, y - x) : Eigen::RowVector3d(1. - x, x - y, y);
      const Eigen::Matrix<double, 1, 6> values = shell::six_node_values(at);
      for (int k = 0; k < 6; ++k)
        if (values(k) != 0.)
          entries.emplace_back(j * (grid.n1 + 1) + i, mesh.triangles(triangle, k), values(k));
    }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(grid.mesh.n_vertices(),
                                                      nodes.mesh.n_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
} // namespace

bool CoarseSpace::fits(const meshes::Sheet &sheet, const CoarseElement element,
                       const int quads_per_cell)
{
  return element == CoarseElement::three_nodes ||
         (quads_per_cell * sheet.n1 % 2 == 0 && quads_per_cell * sheet.n2 % 2 == 0);
}

CoarseSpace::CoarseSpace(const meshes::Sheet &sheet, const CoarseElement element,
                         const int quads_per_cell)
    : element(element)
    , nodes(grid_of(sheet, quads_per_cell))
    , grid(
        grid_of(sheet, element == CoarseElement::six_nodes ? 2 * quads_per_cell : quads_per_cell))
{
  if (element == CoarseElement::six_nodes)
    from_nodes = values_on(grid, nodes, shell::six_node_mesh(nodes.mesh, nodes.n1, nodes.n2));
}

template <int dim>
shell::Positions<dim> CoarseSpace::on_grid(const shell::Positions<dim> &of_nodes) const
{
  return element == CoarseElement::three_nodes ? of_nodes
                                               : shell::Positions<dim>(from_nodes * of_nodes);
}

int CoarseSpace::grid_vertex(const int node) const
{
  const int r = grid.n1 / nodes.n1, i = node % (nodes.n1 + 1), j = node / (nodes.n1 + 1);
  return r * j * (grid.n1 + 1) + r * i;
}

CoarseSpace::Positions CoarseSpace::at_nodes(const Positions &of_grid) const
{
  Positions of_nodes(nodes.mesh.n_vertices(), 2);
  for (int node = 0; node < nodes.mesh.n_vertices(); ++node)
    of_nodes.row(node) = of_grid.row(grid_vertex(node));
  return of_nodes;
}

template <int dim>
shell::Positions<dim> CoarseSpace::loads_of_nodes(const shell::Positions<dim> &of_grid) const
{
  return element == CoarseElement::three_nodes
           ? of_grid
           : shell::Positions<dim>(from_nodes.transpose() * of_grid);
}

template shell::Positions<2> CoarseSpace::on_grid<2>(const shell::Positions<2> &) const;
template shell::Positions<3> CoarseSpace::on_grid<3>(const shell::Positions<3> &) const;
template shell::Positions<2> CoarseSpace::loads_of_nodes<2>(const shell::Positions<2> &) const;
template shell::Positions<3> CoarseSpace::loads_of_nodes<3>(const shell::Positions<3> &) const;

std::unique_ptr<CoarseSolver> CoarseSpace::solver(const Eigen::Matrix3d &stiffness,
                                                  const std::vector<int> &held,
                                                  const std::vector<meshes::CubicForm> &cubic) const
{
  if (element == CoarseElement::three_nodes)
  {
    shell::Membrane membrane = shell::membrane(nodes.mesh, {stiffness});
    shell::add_cubic_energy(membrane, cubic);
    return std::make_unique<SolverOf<shell::Membrane>>(std::move(membrane), held);
  }
  shell::SixNodeMembrane membrane =
    shell::six_node_membrane(shell::six_node_mesh(nodes.mesh, nodes.n1, nodes.n2), stiffness);
  shell::add_cubic_energy(membrane.points, cubic);
  return std::make_unique<SolverOf<shell::SixNodeMembrane>>(std::move(membrane), held);
}
} // namespace homespun::verification
