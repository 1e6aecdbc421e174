// SPDX-License-Identifier: MIT
#include "verification/strain/claims/coarse_checks.h"

#include "localization/coarse_frames.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "shell/membrane/six_node_membrane.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/method/coarse_model.h"
#include "verification/record/claim.h"
#include "verification/strain/claims/layer_checks.h"
#include "verification/strain/claims/second_order_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// How far the coarse cloth of a law is from that of linear theory, over the strain and the side of
/// a cell: the farthest node.
double from_linear_theory(const CellModel &model, const meshes::Sheet &sheet, const Load &load,
                          const double strain)
{
  const Method method("localized+edges+p2");
  shell::EquilibriumOptions exact;
  exact.relative_tolerance = 1e-12;
  const CoarseModel linear(model, sheet, load, method, Law::linear),
    biot(model, sheet, load, method, Law::biot);
  return (linear.solve(strain, nullptr, exact).positions -
          biot.solve(strain, nullptr, exact).positions)
           .cwiseAbs()
           .maxCoeff() /
         (strain * std::sqrt(sheet.lattice.area()));
}

Verdict verdict_of_linear_limit(const homogenization::UnitCell &cell, const CellModel &model)
{
  constexpr int n_cells = 4;
  // Tension stiffens shear: strains are small beside the softest direction over the stiffest.
  const double anisotropy = contrast_of({model.cell.stiffness});
  const double large = 1e-3 * std::min(1., 1e3 / anisotropy), small = 0.01 * large;
  constexpr double least  = 1e-5; // differences over strain and cell side that count as none
  const meshes::Sheet its = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  double worst            = 0.;
  bool is_found           = anisotropy >= 1. && anisotropy <= 1e4; // beyond, rounding is as large
  try
  {
    for (const char *name : {"strip-1", "strip-2"})
      if (is_found)
      {
        const Load load(name);
        worst = larger(worst, from_linear_theory(model, its, load, small) /
                                (from_linear_theory(model, its, load, large) + least));
      }
  }
  catch (const meshes::NotConverged &) // at so little strain that decides nothing
  {
    is_found = false;
  }
  if (!is_found)
    worst = std::numeric_limits<double>::quiet_NaN();
  return open_without(is_found, at_most("linear-limit", {{"cell", cell.name}}, worst, 0.1));
}

/// Over a parallelogram the strains of a quadratic displacement are linear: the integral of their
/// energy is that at the centre and a twelfth of that of their change along either side.
Verdict verdict_of_six_nodes(const homogenization::UnitCell &cell, const Eigen::Matrix3d &C)
{
  const Eigen::Matrix2d &sides = cell.lattice.vectors; // rows
  const meshes::TriangleMesh coarse =
    meshes::coarse_sheet(Eigen::RowVector2d::Zero(), 0.5 * sides, 2, 2);
  const shell::SixNodeMembrane membrane =
    shell::six_node_membrane(shell::six_node_mesh(coarse, 2, 2), C);
  // u_i = x.Q_i.x / (2 side), any Q.
  const std::array<Eigen::Matrix2d, 2> Q = {Eigen::Matrix2d{{0.7, -0.4}, {-0.4, 0.3}},
                                            Eigen::Matrix2d{{-0.2, 0.9}, {0.9, 0.6}}};
  const double side                      = std::sqrt(cell.lattice.area());
  shell::Positions<2> u(coarse.n_vertices(), 2);
  for (int v = 0; v < coarse.n_vertices(); ++v)
    for (int i = 0; i < 2; ++i)
    {
      const Eigen::RowVector2d x = coarse.vertices.row(v);
      u(v, i)                    = 0.5 / side * x.dot(x * Q[static_cast<std::size_t>(i)]);
    }
  const auto strain = [&](const Eigen::RowVector2d &x) // linear in x
  {
    const Eigen::RowVector2d u1 = x * Q[0] / side, u2 = x * Q[1] / side;
    return Eigen::Vector3d(u1(0), u2(1), u1(1) + u2(0));
  };
  const auto energy = [&](const Eigen::Vector3d &e) { return 0.5 * e.dot(C * e); };
  const double expected =
    cell.lattice.area() * (energy(strain(0.5 * (sides.row(0) + sides.row(1)))) +
                           (energy(strain(sides.row(0))) + energy(strain(sides.row(1)))) / 12.);
  const double found = 0.5 * u.cwiseProduct(shell::linear_membrane_gradient(membrane, u)).sum();
  return at_most("six-node-energy", {{"cell", cell.name}}, std::abs(found / expected - 1.), 1e-10);
}
/// Vertex by vertex, each with a third of the triangles around it.
Verdict verdict_of_mean(const homogenization::UnitCell &cell,
                        const meshes::HomogenizedCell &homogenized)
{
  const meshes::TriangleMesh &mesh = homogenized.mesh;
  const meshes::Chi chi       = localization::anchored(homogenized, localization::Anchor::mean);
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  Eigen::VectorXd around      = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      around(mesh.triangles(t, k)) += areas(t) / 3.;
  const double size = chi.cwiseAbs().maxCoeff(),
               mean = (around.transpose() * chi).cwiseAbs().maxCoeff() / areas.sum();
  return at_most("chi-of-mean-zero", {{"cell", cell.name}}, size > 0. ? mean / size : 0., 1e-10);
}
} // namespace

std::vector<Verdict> coarse_checks(const homogenization::UnitCell &cell, const CellModel &model)
{
  std::vector<Verdict> checks = {verdict_of_linear_limit(cell, model),
                                 verdict_of_six_nodes(cell, model.cell.stiffness),
                                 verdict_of_mean(cell, model.cell)};
  for (const Verdict &check : second_order_checks(cell, model.cell))
    checks.push_back(check);
  constexpr int most_triangles = 8000; // whose sheet of 16 x 16 cells fits into any memory
  if (model.edges == nullptr || cell.mesh.n_triangles() > most_triangles)
    return checks;
  try
  {
    for (const Verdict &check : layer_checks(cell, model))
      checks.push_back(check);
  }
  catch (const meshes::NotConverged &)
  {
    for (const char *id : {"layers.clamped", "layers.free"})
      checks.push_back(judged(id, {{"cell", cell.name}, {"cells", 8}}, Outcome::inconclusive,
                              std::numeric_limits<double>::quiet_NaN()));
  }
  return checks;
}
} // namespace homespun::verification
