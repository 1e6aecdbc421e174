// SPDX-License-Identifier: MIT
#include "verification/periodic_cell/nonlinear_cell.h"

#include "meshes/plain/errors.h"
#include "verification/periodic_cell/halton.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
NonlinearCell::NonlinearCell(const meshes::HomogenizedCell &cell,
                             std::vector<Eigen::Matrix3d> stiffness_of_phase, const Law law)
    : assembly(cell, std::move(stiffness_of_phase), law)
{
}

CellState NonlinearCell::solve(const Eigen::Vector3d &strain) const
{
  const meshes::HomogenizedCell &cell = assembly.cell;
  Eigen::Matrix2d U;
  U << 1. + strain(0), 0.5 * strain(2), 0.5 * strain(2), 1. + strain(1);
  CellEquilibrium state{U, meshes::Points::Zero(cell.mesh.n_vertices(), 2)};
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    for (int a = 0; a < 3; ++a)
      state.fluctuation.row(v) -=
        strain(a) * (cell.chi.row(v) - cell.chi.row(cell.anchor)).segment<2>(2 * a);
  find_equilibrium(assembly, {}, state);
  return {state.fluctuation,
          {state.stress(0), state.stress(3), 0.5 * (state.stress(1) + state.stress(2))}};
}

NonlinearLocalization::NonlinearLocalization(
  const NonlinearCell &nonlinear, const meshes::HomogenizedCell &cell,
  const Eigen::Matrix<double, Eigen::Dynamic, 3> &strains, const double outside)
{
  for (int a = 0; a < 3; ++a)
  {
    std::vector<double> sorted(strains.col(a).data(), strains.col(a).data() + strains.rows());
    std::sort(sorted.begin(), sorted.end());
    const auto last   = static_cast<double>(sorted.size() - 1);
    const double low  = sorted[static_cast<std::size_t>(std::floor(outside * last))];
    const double high = sorted[static_cast<std::size_t>(std::ceil((1. - outside) * last))];
    middle(a)         = 0.5 * (low + high);
    half(a)           = 0.5 * (high - low);
  }
  const bool is_point = half.maxCoeff() <= 1e-12 * middle.cwiseAbs().maxCoeff();
  // Strains that hardly vary in a component need some width to be fitted at all.
  half = half.cwiseMax(1e-3 * (middle.cwiseAbs() + half).maxCoeff());

  // An infinite cloth knows one strain, and its cell problem is all there is to know.
  const int n_fitted = is_point ? 1 : 2 * n_terms, n_checked = is_point ? 0 : 4;
  const int n = cell.mesh.n_vertices();
  Eigen::MatrixXd terms(n_fitted + n_checked, n_terms), values(n_fitted + n_checked, 3 + 2 * n);
  for (int k = 0; k < n_fitted + n_checked; ++k)
  {
    const Eigen::Vector3d place(halton(k + 1, 2), halton(k + 1, 3), halton(k + 1, 5));
    Eigen::Vector3d strain = middle;
    if (!is_point)
      strain += half.cwiseProduct(2. * place - Eigen::Vector3d::Ones());
    const CellState state   = nonlinear.solve(strain);
    terms.row(k)            = monomials(strain);
    values.row(k).head<3>() = (state.stress - cell.stiffness * strain).transpose();
    for (int v = 0; v < n; ++v)
    {
      Eigen::RowVector2d excess = state.fluctuation.row(v);
      for (int a = 0; a < 3; ++a)
        excess += strain(a) * (cell.chi.row(v) - cell.chi.row(cell.anchor)).segment<2>(2 * a);
      values.row(k).segment<2>(3 + 2 * v) = excess;
    }
  }
  if (is_point)
  {
    coefficients        = Eigen::MatrixXd::Zero(n_terms, values.cols());
    coefficients.row(0) = values.row(0); // of the monomial 1
    return;
  }
  coefficients = terms.topRows(n_fitted).householderQr().solve(values.topRows(n_fitted));
  const Eigen::MatrixXd miss =
    values.bottomRows(n_checked) - terms.bottomRows(n_checked) * coefficients;
  const auto relative = [](const auto &part, const auto &whole)
  { return whole.norm() > 0. ? part.norm() / whole.norm() : 0.; };
  largest_misfit =
    std::max(relative(miss.leftCols(3), values.bottomRows(n_checked).leftCols(3)),
             relative(miss.rightCols(2 * n), values.bottomRows(n_checked).rightCols(2 * n)));
}

Eigen::Matrix<double, 1, NonlinearLocalization::n_terms>
NonlinearLocalization::monomials(const Eigen::Vector3d &strain) const
{
  const Eigen::Vector3d x = (strain - middle).cwiseQuotient(half).cwiseMax(-1.).cwiseMin(1.);
  Eigen::Matrix<double, 3, 4> power;
  power.col(0).setOnes();
  for (int p = 1; p <= 3; ++p)
    power.col(p) = power.col(p - 1).cwiseProduct(x);
  Eigen::Matrix<double, 1, n_terms> result;
  int k = 0;
  for (int i = 0; i <= 3; ++i)
    for (int j = 0; i + j <= 3; ++j)
      for (int l = 0; i + j + l <= 3; ++l)
        result(k++) = power(0, i) * power(1, j) * power(2, l);
  return result;
}

Eigen::Vector3d NonlinearLocalization::excess_stress(const Eigen::Vector3d &strain) const
{
  return (monomials(strain) * coefficients.leftCols<3>()).transpose();
}

Eigen::RowVector2d NonlinearLocalization::excess_fluctuation(const int cell_vertex,
                                                             const Eigen::Vector3d &strain) const
{
  return monomials(strain) * coefficients.middleCols<2>(3 + 2 * cell_vertex);
}
} // namespace homespun::verification
