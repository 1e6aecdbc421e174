// SPDX-License-Identifier: MIT
#include "verification/method/mode_fit.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/singular_values.h"
#include "meshes/plain/symmetric_eigen.h"
#include "meshes/plain/triangle_kinematics.h"
#include "shell/membrane/corotational_energy.h"
#include "verification/periodic_cell/halton.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace homespun::verification
{
namespace
{
using meshes::FittedModes;

/// Strains of a box and of boxes in it that shrink towards rest along each axis apart, for a cloth
/// that is sheared far is hardly stretched. Places and sizes are those of a Halton sequence.
Eigen::Vector3d sampled(const StrainBox &box, const int index)
{
  constexpr std::array<double, 5> sizes = {1., 0.5, 0.25, 0.12, 0.06};
  constexpr std::array<int, 3> of_place = {2, 3, 5}, of_size = {7, 11, 13};
  Eigen::Vector3d strain;
  for (int a = 0; a < 3; ++a)
  {
    const auto k = static_cast<std::size_t>(a);
    const double size =
      sizes[static_cast<std::size_t>(sizes.size() * halton(index + 1, of_size[k]))];
    strain(a) = size * (box.low(a) + halton(index + 1, of_place[k]) * (box.high(a) - box.low(a)));
  }
  return strain;
}

/// Fluctuations of the cell at strains where it has an equilibrium, a row each.
struct Snapshots
{
  Eigen::MatrixXd strains; ///< (m,3)
  Eigen::MatrixXd w;       ///< (m,2n), zero at the anchor [m]
};

Snapshots snapshots(const NonlinearCell &nonlinear, const StrainBox &box, const int first,
                    const int number)
{
  std::vector<Eigen::Vector3d> strains;
  std::vector<meshes::Points> found;
  for (int k = first; k < first + number; ++k)
    try
    {
      const Eigen::Vector3d strain = sampled(box, k);
      found.push_back(nonlinear.solve(strain).fluctuation);
      strains.push_back(strain);
    }
    catch (const meshes::NotConverged &)
    {
      // A strain at which the law keeps no equilibrium is no part of the fit; their number is told.
    }
  Snapshots result;
  const auto m = static_cast<Eigen::Index>(found.size());
  if (m == 0)
    return result;
  result.strains.resize(m, 3);
  result.w.resize(m, found.front().size());
  for (Eigen::Index k = 0; k < m; ++k)
  {
    const meshes::Points &w = found[static_cast<std::size_t>(k)];
    result.strains.row(k)   = strains[static_cast<std::size_t>(k)].transpose();
    for (Eigen::Index v = 0; v < w.rows(); ++v)
      result.w.row(k).segment<2>(2 * v) = w.row(v);
  }
  return result;
}

/// Mean length of the vectors of each row, vertices by their share of the area.
Eigen::VectorXd mean_lengths(const Eigen::MatrixXd &rows, const Eigen::VectorXd &shares)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(rows.rows());
  for (Eigen::Index v = 0; v < shares.size(); ++v)
    result += shares(v) * rows.middleCols<2>(2 * v).rowwise().norm();
  return result;
}

Eigen::VectorXd shares_of_area(const meshes::TriangleMesh &mesh)
{
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  Eigen::VectorXd shares      = Eigen::VectorXd::Zero(mesh.n_vertices());
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      shares(mesh.triangles(t, k)) += areas(t) / (3. * areas.sum());
  return shares;
}

/// The characteristic displacements, a row each, zero at the anchor (3,2n) [m].
Eigen::MatrixXd chi_rows(const meshes::HomogenizedCell &cell)
{
  const auto n = static_cast<Eigen::Index>(cell.mesh.n_vertices());
  Eigen::MatrixXd rows(3, 2 * n);
  for (Eigen::Index v = 0; v < n; ++v)
    for (int a = 0; a < 3; ++a)
      rows.row(a).segment<2>(2 * v) =
        (cell.chi.row(v) - cell.chi.row(cell.anchor)).segment<2>(2 * a);
  return rows;
}

/// Rows without their mean over the area.
Eigen::MatrixXd without_mean(Eigen::MatrixXd rows, const Eigen::VectorXd &shares)
{
  Eigen::MatrixX2d mean = Eigen::MatrixX2d::Zero(rows.rows(), 2);
  for (Eigen::Index v = 0; v < shares.size(); ++v)
    mean += shares(v) * rows.middleCols<2>(2 * v);
  for (Eigen::Index v = 0; v < shares.size(); ++v)
    rows.middleCols<2>(2 * v) -= mean;
  return rows;
}

Eigen::MatrixXd functions_at(const Eigen::MatrixXd &strains, const Eigen::Vector3d &knees)
{
  Eigen::MatrixXd values(strains.rows(), FittedModes::n_functions);
  for (Eigen::Index k = 0; k < strains.rows(); ++k)
    values.row(k) = meshes::fitted_functions(strains.row(k).transpose(), knees);
  return values;
}

/// The directions in which weighted rows lie most, a row each.
Eigen::MatrixXd largest_directions(const Eigen::MatrixXd &rows, const int number)
{
  const auto gram        = meshes::symmetric_eigen<Eigen::Dynamic>(rows * rows.transpose());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(number, rows.cols());
  for (int k = 0; k < number && k < rows.rows(); ++k)
  {
    const Eigen::Index at = rows.rows() - 1 - k;
    const double squared  = gram.values(at);
    // Below it is round-off: a laminate has fewer directions than modes.
    if (squared > 1e-20 * gram.values(rows.rows() - 1))
      result.row(k) = gram.vectors.col(at).transpose() * rows / std::sqrt(squared);
  }
  return result;
}
} // namespace

StrainBox box_up_to(const double strain, const Law law)
{
  const double least = is_of_yarns(law) ? 0. : -strain / 3.;
  return {Eigen::Vector3d(least, least, -strain), Eigen::Vector3d::Constant(strain)};
}

ModeFit fit_modes(const NonlinearCell &nonlinear, const meshes::HomogenizedCell &cell,
                  const StrainBox &box)
{
  const Snapshots seen   = snapshots(nonlinear, box, 0, box.n_fitted),
                  unseen = snapshots(nonlinear, box, box.n_fitted, box.n_held_out);
  if (2 * seen.w.rows() < box.n_fitted || 2 * unseen.w.rows() < box.n_held_out)
    throw meshes::NotConverged("fitted modes: the cell has an equilibrium at " +
                                 std::to_string(seen.w.rows() + unseen.w.rows()) + " of " +
                                 std::to_string(box.n_fitted + box.n_held_out) +
                                 " strains of the box; expected most of them: a smaller box",
                               {});
  ModeFit fit;
  fit.n_fitted       = static_cast<int>(seen.w.rows());
  fit.n_held_out     = static_cast<int>(unseen.w.rows());
  FittedModes &modes = fit.modes;
  modes.low          = box.low;
  modes.high         = box.high;
  const double shear = 2. * cell.stiffness(2, 2);
  modes.knees        = {shear / cell.stiffness(0, 0), shear / cell.stiffness(1, 1),
                        std::max(box.high(2), -box.low(2))};
  const auto n       = static_cast<Eigen::Index>(cell.mesh.n_vertices());
  const auto shares  = shares_of_area(cell.mesh);
  Eigen::RowVectorXd by_area(2 * n);
  for (Eigen::Index v = 0; v < n; ++v)
    by_area.segment<2>(2 * v).setConstant(std::sqrt(shares(v)));
  // A cell of one phase has no fluctuations, and nothing to weigh.
  const Eigen::VectorXd sizes   = mean_lengths(seen.w, shares);
  const Eigen::VectorXd weights = (sizes.array() > 0.).select(sizes.cwiseInverse(), 0.);

  // What chi at rest leaves, then what more or less of chi leaves of that; the constant of a
  // fluctuation is no matter of either.
  const Eigen::MatrixXd chi = chi_rows(cell), left = seen.w + seen.strains * chi,
                        flat      = without_mean(chi, shares) * by_area.asDiagonal(),
                        rest      = without_mean(left, shares) * by_area.asDiagonal();
  const Eigen::MatrixXd functions = weights.asDiagonal() * functions_at(seen.strains, modes.knees);
  // Shares of a chi that is zero are none.
  const Eigen::MatrixXd more =
    meshes::least_squares(flat.transpose(), rest.transpose(), 1e-8).transpose(); // (m,3)
  const Eigen::MatrixXd weighted = weights.asDiagonal() * (rest - more * flat),
                        basis    = largest_directions(weighted, FittedModes::n_modes);
  // The functions are nearly dependent where a cell does not saturate; the least coefficients do.
  modes.of_strain    = meshes::least_squares(functions, -(weights.asDiagonal() * more), 1e-8);
  modes.coefficients = meshes::least_squares(functions, weighted * basis.transpose(), 1e-8);
  modes.modes.resize(n, 2 * FittedModes::n_modes);
  for (Eigen::Index v = 0; v < n; ++v)
    for (int k = 0; k < FittedModes::n_modes; ++k)
      modes.modes.row(v).segment<2>(2 * k) = -basis.row(k).segment<2>(2 * v) / std::sqrt(shares(v));
  const Eigen::RowVectorXd at_anchor = modes.modes.row(cell.anchor);
  modes.modes.rowwise() -= at_anchor;

  Eigen::MatrixXd of_modes(FittedModes::n_modes, 2 * n);
  for (Eigen::Index v = 0; v < n; ++v)
    for (int k = 0; k < FittedModes::n_modes; ++k)
      of_modes.row(k).segment<2>(2 * v) = modes.modes.row(v).segment<2>(2 * k);
  const Eigen::MatrixXd f      = functions_at(unseen.strains, modes.knees),
                        by_chi = unseen.w + unseen.strains * chi,
                        by_both =
                          by_chi + f * modes.of_strain * chi + f * modes.coefficients * of_modes;
  const double size = mean_lengths(unseen.w, shares).sum();
  if (size > 0.)
  {
    fit.left        = mean_lengths(by_both, shares).sum() / size;
    fit.left_by_chi = mean_lengths(by_chi, shares).sum() / size;
  }
  return fit;
}

int n_outside(const meshes::FittedModes &modes, const meshes::TriangleMesh &rest,
              const meshes::Points &positions)
{
  int n = 0;
  for (int t = 0; t < rest.n_triangles(); ++t)
    n += !modes.holds(shell::biot_strain<2>(meshes::deformation_gradient<2>(rest, t, positions)));
  return n;
}
} // namespace homespun::verification
