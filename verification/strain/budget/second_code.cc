// SPDX-License-Identifier: MIT
#include "verification/strain/budget/second_code.h"

#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/cell/torus_mesh.h"
#include "meshes/plain/triangle_kinematics.h"
#include "verification/periodic_cell/nonlinear_cell.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace homespun::verification
{
namespace
{
Eigen::RowVector2d centroid(const meshes::TriangleMesh &mesh, const int t)
{
  Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
  for (int k = 0; k < 3; ++k)
    sum += mesh.vertices.row(mesh.triangles(t, k));
  return sum / 3.;
}

/// A sheet of its own: the phases that the second code reads, and the same vertices.
meshes::TriangleMesh second_mesh(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet)
{
  meshes::TriangleMesh mesh = sheet.mesh;
  mesh.material             = phases_of_sheet(cell, sheet);
  return mesh;
}

/// An infinite cloth: the affine motion, and a fluctuation of each vertex of the cell.
/// @param lift from the cell's frame into the current cloth
meshes::Points infinite_cloth(const meshes::Sheet &sheet, const Eigen::Matrix2d &gradient,
                              const Eigen::Matrix2d &lift, const meshes::Points &fluctuation,
                              const int anchor)
{
  meshes::Points positions(sheet.mesh.n_vertices(), 2);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    positions.row(v) =
      sheet.origin + (sheet.mesh.vertices.row(v) - sheet.origin) * gradient.transpose() +
      (fluctuation.row(sheet.cell_vertex(v)) - fluctuation.row(anchor)) * lift.transpose();
  return positions;
}
} // namespace

Eigen::VectorXi phases_of_sheet(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet)
{
  // Centroids in lattice vectors, from a vertex of the cell, modulo one. Those next to 0 may come
  // out next to 1 on the other side, hence the comparison on the circle.
  const auto fractions_of = [&](const meshes::TriangleMesh &mesh)
  {
    std::vector<Eigen::RowVector2d> fractions;
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      Eigen::RowVector2d f = cell.lattice.fractional(centroid(mesh, t) - cell.mesh.vertices.row(0));
      f(0) -= std::floor(f(0));
      f(1) -= std::floor(f(1));
      fractions.push_back(f);
    }
    return fractions;
  };
  const std::vector<Eigen::RowVector2d> of_cell  = fractions_of(cell.mesh),
                                        of_sheet = fractions_of(sheet.mesh);
  std::vector<int> order(of_cell.size());
  std::iota(order.begin(), order.end(), 0);
  const auto first = [&](const int t) { return of_cell[static_cast<std::size_t>(t)](0); };
  std::sort(order.begin(), order.end(),
            [&](const int s, const int t) { return first(s) < first(t); });

  const double reach       = 10. * meshes::image_tolerance;
  const auto on_the_circle = [](const double difference)
  { return std::abs(difference - std::round(difference)); };
  Eigen::VectorXi phases(sheet.mesh.n_triangles());
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector2d &f = of_sheet[static_cast<std::size_t>(t)];
    int found                   = -1;
    for (const double turn : {0., -1., 1.})
    {
      auto at = std::lower_bound(order.begin(), order.end(), f(0) + turn - reach,
                                 [&](const int s, const double x) { return first(s) < x; });
      for (; at != order.end() && first(*at) <= f(0) + turn + reach; ++at)
        if (on_the_circle(of_cell[static_cast<std::size_t>(*at)](1) - f(1)) <= reach)
          found = *at;
    }
    if (found < 0)
      throw std::logic_error("triangle " + std::to_string(t) +
                             " of the sheet is the image of no triangle of the cell");
    phases(t) = cell.mesh.material(found);
  }
  return phases;
}

SecondSheet::SecondSheet(const meshes::HomogenizedCell &cell,
                         std::vector<Eigen::Matrix3d> stiffness_of_phase,
                         const meshes::Sheet &sheet, const Load &load)
    : cell(cell)
    , stiffness_of_phase(std::move(stiffness_of_phase))
    , sheet(sheet)
    , load(load)
{
}

const shell::MembraneSolver<> &SecondSheet::solver_under(const Law law) const
{
  std::unique_ptr<shell::MembraneSolver<>> &solver = solvers[is_of_yarns(law) ? 1 : 0];
  if (!solver)
  {
    shell::Membrane membrane = shell::membrane(second_mesh(cell, sheet), stiffness_of_phase);
    if (is_of_yarns(law))
      shell::take_yarn_law(membrane);
    solver = std::make_unique<shell::MembraneSolver<>>(
      std::move(membrane), held_vertices(load, sheet, sheet.mesh.vertices));
  }
  return *solver;
}

meshes::Points SecondSheet::linear(const double strain) const
{
  if (!load.is_periodic())
    return solver_under(Law::linear)
      .solve_linear(moved_affinely(load, sheet, sheet.mesh.vertices, strain));
  const homogenization::TorusMesh torus = homogenization::glued(cell.mesh, cell.lattice);
  const meshes::Chi chi =
    homogenization::CompatibleStrain(torus, stiffness_of_phase, 1).chi_at_given_vertices();
  const Eigen::Matrix2d gradient = load.gradient(strain);
  const Eigen::Vector3d e(gradient(0, 0) - 1., gradient(1, 1) - 1.,
                          gradient(0, 1) + gradient(1, 0));
  meshes::Points fluctuation = meshes::Points::Zero(chi.rows(), 2);
  for (int a = 0; a < 3; ++a)
    fluctuation -= e(a) * chi.middleCols<2>(2 * a);
  return infinite_cloth(sheet, gradient, Eigen::Matrix2d::Identity(), fluctuation, cell.anchor);
}

bool second_code_has(const Law law)
{
  return law == Law::linear || law == Law::biot || is_of_yarns(law);
}

meshes::Points SecondSheet::nonlinear(const Law law, const double strain) const
{
  if (load.is_periodic())
  {
    const Eigen::Matrix2d F = load.gradient(strain);
    const Eigen::Matrix2d R = meshes::nearest_rotation(F), U = R.transpose() * F;
    const CellState state = NonlinearCell(cell, stiffness_of_phase, law)
                              .solve({U(0, 0) - 1., U(1, 1) - 1., U(0, 1) + U(1, 0)});
    return infinite_cloth(sheet, F, R, state.fluctuation, cell.anchor);
  }
  const shell::MembraneSolver<> &solver = solver_under(law);
  shell::EquilibriumOptions tight;
  tight.relative_tolerance   = 1e-13; // round-off counts as zero before
  const meshes::Points moved = moved_affinely(load, sheet, sheet.mesh.vertices, strain);
  return solver.solve_equilibrium(solver.solve_linear(moved), tight).positions;
}

Eigen::Matrix3d second_p2_stiffness(const meshes::HomogenizedCell &cell,
                                    const std::vector<Eigen::Matrix3d> &stiffness_of_phase)
{
  const homogenization::TorusMesh torus = homogenization::glued(cell.mesh, cell.lattice);
  return homogenization::CompatibleStrain(torus, stiffness_of_phase, 2).stiffness;
}
} // namespace homespun::verification
