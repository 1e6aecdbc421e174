// SPDX-License-Identifier: MIT
#include "verification/strain/claims/second_order_checks.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "shell/membrane/guarded_cubic.h"
#include "verification/cell/algebraic_limit.h"
#include "verification/cell/discretization_distance.h"
#include "verification/method/coarse_model.h"
#include "verification/periodic_cell/nonlinear_cell.h"
#include "verification/record/claim.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// Stress and displacement at second order in a strain e: means over s e and −s e, over s².
struct QuadraticResponse
{
  Eigen::Vector3d stress;      ///< [N/m]
  meshes::Points displacement; ///< of the vertices of a sheet of one cell [m]

  QuadraticResponse operator*(const double factor) const
  {
    return {factor * stress, factor * displacement};
  }

  QuadraticResponse operator-(const QuadraticResponse &other) const
  {
    return {stress - other.stress, displacement - other.displacement};
  }

  /// The stress over that of linear theory, the mean displacement over a side, the larger.
  double size(const double of_stress, const double side) const
  {
    return larger(stress.norm() / of_stress, displacement.rowwise().norm().mean() / side);
  }
};

QuadraticResponse of_solved_cells(const NonlinearCell &cell, const meshes::Sheet &sheet,
                                  const Eigen::Vector3d &e, const double s)
{
  const CellState ahead = cell.solve(s * e), behind = cell.solve(-s * e);
  QuadraticResponse sum = {ahead.stress + behind.stress,
                           meshes::Points(sheet.mesh.n_vertices(), 2)};
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    sum.displacement.row(v) =
      ahead.fluctuation.row(sheet.cell_vertex(v)) + behind.fluctuation.row(sheet.cell_vertex(v));
  return sum * (0.5 / (s * s));
}

/// Of the coarse cloth and up-sampling.
QuadraticResponse of_model(const CoarseModel &model, const Eigen::Vector3d &e, const double s)
{
  const Eigen::Matrix2d along{{e(0), 0.5 * e(2)}, {0.5 * e(2), e(1)}};
  const auto arms       = model.mesh().vertices.rowwise() - model.sheet.origin;
  QuadraticResponse sum = {Eigen::Vector3d::Zero(),
                           meshes::Points::Zero(model.sheet.mesh.n_vertices(), 2)};
  for (const double strain : {s, -s})
  {
    CoarseState state;
    state.strain    = strain;
    state.positions = state.without_edges = model.mesh().vertices + strain * (arms * along);
    sum.displacement += model.upsample(state) - model.sheet.mesh.vertices;
  }
  sum        = sum * (0.5 / (s * s));
  sum.stress = model.parts.cubic.front().gradient(e);
  return sum;
}

Verdict verdict_of_second_order(const homogenization::UnitCell &cell,
                                const meshes::HomogenizedCell &homogenized, const Law law)
{
  constexpr double smallness     = 0.1;   // of a limit that decides
  constexpr int most_triangles   = 20000; // ten seconds
  const Words words              = {{"cell", cell.name}, {"reference", name_of(law)}};
  double limit                   = std::numeric_limits<double>::infinity(),
         off                     = std::numeric_limits<double>::quiet_NaN();
  const meshes::SecondOrder &its = homogenized.second_order.at(name_of(law));
  if (!its.energy.derivatives.allFinite() || !its.chi.allFinite())
    return at_most("second-order", words, off, smallness);
  if (cell.mesh.n_triangles() > most_triangles)
    return open_without(0, at_most("second-order", words, off, smallness));
  const Eigen::Vector3d e(1., -0.6, 0.7);
  const auto stiffness   = cell.stiffness_of_phase();
  const double of_stress = (homogenized.stiffness * e).norm(),
               side      = std::sqrt(cell.lattice.area());

  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  const Load load("periodic-11");
  const CoarseModel model({homogenized}, sheet, load, Method("localized+cubic+modes"), law);
  const NonlinearCell nonlinear(homogenized, stiffness, law);
  // Smaller strains where the cell softens or stiffens sooner, until rounding is as large.
  for (int power = 3; limit > 0.1 * smallness && power <= 6; ++power)
    try
    {
      const double s               = std::pow(10., -power);
      const QuadraticResponse near = of_solved_cells(nonlinear, sheet, e, s),
                              far  = of_solved_cells(nonlinear, sheet, e, 2. * s),
                              step = (far - near) * (1. / 3.); // from the limit to the nearer one
      const double its_limit       = safety_unconfirmed * step.size(of_stress, side) +
                               meshes::epsilon * contrast_of(stiffness) / (s * s);
      if (!(its_limit < limit))
        break;
      limit = its_limit;
      off   = (of_model(model, e, s) - (near - step)).size(of_stress, side);
    }
    catch (const meshes::NotConverged &) // at so little strain that decides nothing
    {
    }
  return open_without(limit <= smallness, at_most("second-order", words, off, std::min(limit, 1.)));
}

/// Over the directions of a net, the least eigenvalue of C + d²G/de² in the metric of C.
/// @param sizes of the strains, in parts of what the cubic energy reaches undamped
double least_stiffness(const shell::GuardedCubic &cubic, const Eigen::Matrix3d &C,
                       const std::vector<double> &sizes)
{
  constexpr int n_parts = 24; // of a half circle
  const Eigen::LLT<Eigen::Matrix3d> cholesky(C);
  double lost = 0.;
  for (int i = 0; i <= n_parts; ++i)
    for (int j = 0; j < 2 * n_parts; ++j)
    {
      const double polar = i * M_PI / n_parts, azimuth = j * M_PI / n_parts;
      const Eigen::Vector3d unit = cholesky.matrixU().solve(Eigen::Vector3d(
        std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
      for (const double size : sizes)
      {
        const Eigen::Matrix3d hessian = cubic.hessian(size * cubic.reach() * unit);
        const Eigen::Matrix3d scaled =
          cholesky.matrixL().solve(cholesky.matrixL().solve(hessian).transpose());
        lost = larger(lost, -Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                               0.5 * (scaled + scaled.transpose()), Eigen::EigenvaluesOnly)
                               .eigenvalues()(0));
      }
    }
  return 1. - lost;
}

Verdict verdict_of_guard(const homogenization::UnitCell &cell,
                         const meshes::HomogenizedCell &homogenized, const std::string &law)
{
  const meshes::CubicForm &energy = homogenized.second_order.at(law).energy;
  const shell::GuardedCubic cubic(energy, homogenized.stiffness);
  const bool has_any = std::isfinite(cubic.reach());
  const auto least   = [&](const std::vector<double> &sizes)
  { return has_any ? least_stiffness(cubic, homogenized.stiffness, sizes) : 1.; };
  const double within = least({0.5, 1.}), beyond = least({1.2, 1.4, 1.5, 5. / 3., 2., 4.});
  const bool holds = energy.derivatives.allFinite() && within >= 2. / 3. && beyond >= 0.1;
  return judged("cubic-guard", {{"cell", cell.name}, {"reference", law}, {"beyond", beyond}},
                holds ? Outcome::pass : Outcome::fail, within);
}
} // namespace

std::vector<Verdict> second_order_checks(const homogenization::UnitCell &cell,
                                         const meshes::HomogenizedCell &homogenized)
{
  std::vector<Verdict> checks;
  for (const auto &[law, its] : homogenized.second_order)
  {
    checks.push_back(verdict_of_guard(cell, homogenized, law));
    checks.push_back(verdict_of_second_order(cell, homogenized, law_of(law)));
  }
  return checks;
}
} // namespace homespun::verification
