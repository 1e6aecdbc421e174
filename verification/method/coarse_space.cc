// SPDX-License-Identifier: MIT
#include "verification/method/coarse_space.h"

#include "meshes/plain/yarn_axes.h"

#include <algorithm>
#include <utility>

namespace homespun::verification
{
namespace
{
CoarseGrid grid_of(const meshes::Sheet &sheet, const Quads quads)
{
  const Eigen::Vector2d widths(static_cast<double>(sheet.n1) / quads.n1,
                               static_cast<double>(sheet.n2) / quads.n2);
  return {meshes::coarse_sheet(sheet.origin, widths.asDiagonal() * sheet.lattice.vectors, quads.n1,
                               quads.n2),
          quads};
}

template <typename Sheet>
class SolverOf : public CoarseSolver
{
public:
  /// @param own_law of the sheet, which has it
  SolverOf(Sheet of_sheet, const Law own_law, const std::vector<int> &held)
      : law(own_law)
      , sheet(std::move(of_sheet))
  {
    if (!held.empty())
      solver = std::make_unique<shell::MembraneSolver<Sheet>>(sheet, held);
  }

  shell::Equilibrium solve(const Positions &start, const Positions &loads,
                           const shell::EquilibriumOptions &options) const override
  {
    if (law != Law::linear)
      return solver->solve_equilibrium(start, options, loads);
    shell::Equilibrium result;
    result.positions  = solver->solve_linear(start, loads);
    result.iterations = 1;
    return result;
  }

  Positions gradient(const Positions &positions) const override
  {
    return law == Law::linear ? shell::linear_membrane_gradient(sheet, positions - sheet.vertices)
                              : shell::membrane_gradient<2>(sheet, positions).gradient;
  }

private:
  const Law law;
  const Sheet sheet;
  std::unique_ptr<shell::MembraneSolver<Sheet>> solver; ///< none where nothing is held
};

void give_law(shell::Membrane &membrane, const Law law)
{
  if (properties_of(law).has_yarns)
    shell::take_yarn_law(membrane);
}

/// The quadratic functions at the vertices of a grid half as wide as the nodes.
Eigen::SparseMatrix<double, Eigen::RowMajor>
values_on(const CoarseGrid &grid, const CoarseGrid &nodes, const shell::SixNodeMesh &mesh)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j <= grid.quads.n2; ++j)
    for (int i = 0; i <= grid.quads.n1; ++i)
    {
      // In which pair of triangles, and where in it; on a side either neighbour says the same.
      const int pair1 = std::min(i / 4, nodes.quads.n1 / 2 - 1),
                pair2 = std::min(j / 4, nodes.quads.n2 / 2 - 1);
      const double x = 0.25 * (i - 4 * pair1), y = 0.25 * (j - 4 * pair2);
      const int triangle = 2 * (pair2 * (nodes.quads.n1 / 2) + pair1) + (y > x);
      const Eigen::RowVector3d at =
        y > x ? Eigen::RowVector3d(1. - y, x, y - x) : Eigen::RowVector3d(1. - x, x - y, y);
      const Eigen::Matrix<double, 1, 6> values = shell::six_node_values(at);
      for (int k = 0; k < 6; ++k)
        if (values(k) != 0.)
          entries.emplace_back(j * (grid.quads.n1 + 1) + i, mesh.triangles(triangle, k), values(k));
    }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(grid.mesh.n_vertices(),
                                                      nodes.mesh.n_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}
} // namespace

Law homogenized_law(const Law of_reference, const Eigen::Matrix3d &stiffness)
{
  const meshes::LawProperties &its = properties_of(of_reference);
  const bool is_its_own =
    of_reference == Law::linear ||
    (its.is_of_coarse_cloth && (!its.has_yarns || meshes::yarn_axes(stiffness).are_there));
  return is_its_own ? of_reference : Law::biot;
}

shell::Membrane homogenized_membrane(const meshes::TriangleMesh &rest,
                                     const Eigen::Matrix3d &stiffness, const Law of_reference)
{
  shell::Membrane membrane = shell::membrane(rest, {stiffness});
  give_law(membrane, homogenized_law(of_reference, stiffness));
  return membrane;
}

bool CoarseSpace::fits(const meshes::Sheet &sheet, const CoarseElement element,
                       const std::optional<Quads> &quads)
{
  const Quads in = quads.value_or(quads_per_cell(sheet, 1));
  return element == CoarseElement::three_nodes || (in.n1 % 2 == 0 && in.n2 % 2 == 0);
}

CoarseSpace::CoarseSpace(const meshes::Sheet &sheet, const CoarseElement element,
                         const std::optional<Quads> &quads)
    : element(element)
    , nodes(grid_of(sheet, quads.value_or(quads_per_cell(sheet, 1))))
    , six_nodes(element == CoarseElement::six_nodes
                  ? std::optional(shell::six_node_mesh(nodes.mesh, nodes.quads.n1, nodes.quads.n2))
                  : std::nullopt)
    , grid(grid_of(sheet, six_nodes ? Quads{2 * nodes.quads.n1, 2 * nodes.quads.n2} : nodes.quads))
{
  if (six_nodes)
    from_nodes = values_on(grid, nodes, *six_nodes);
}

template <int dim>
shell::Positions<dim> CoarseSpace::on_grid(const shell::Positions<dim> &of_nodes) const
{
  return element == CoarseElement::three_nodes ? of_nodes
                                               : shell::Positions<dim>(from_nodes * of_nodes);
}

int CoarseSpace::grid_vertex(const int node) const
{
  const int r = grid.quads.n1 / nodes.quads.n1, i = node % (nodes.quads.n1 + 1),
            j = node / (nodes.quads.n1 + 1);
  return r * j * (grid.quads.n1 + 1) + r * i;
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

std::unique_ptr<CoarseSolver> CoarseSpace::solver(const Eigen::Matrix3d &stiffness, const Law law,
                                                  const std::vector<int> &held,
                                                  const std::vector<meshes::CubicForm> &cubic) const
{
  const Law own_law = homogenized_law(law, stiffness);
  if (!six_nodes)
  {
    shell::Membrane membrane = homogenized_membrane(nodes.mesh, stiffness, law);
    shell::add_cubic_energy(membrane, cubic);
    return std::make_unique<SolverOf<shell::Membrane>>(std::move(membrane), own_law, held);
  }
  shell::SixNodeMembrane membrane = shell::six_node_membrane(*six_nodes, stiffness);
  give_law(membrane.points, own_law);
  shell::add_cubic_energy(membrane.points, cubic);
  return std::make_unique<SolverOf<shell::SixNodeMembrane>>(std::move(membrane), own_law, held);
}
} // namespace homespun::verification
