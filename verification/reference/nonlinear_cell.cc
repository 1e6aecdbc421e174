// SPDX-License-Identifier: MIT
#include "verification/reference/nonlinear_cell.h"

#include "meshes/plain/errors.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
NonlinearCell::NonlinearCell(const meshes::HomogenizedCell &cell,
                             std::vector<Eigen::Matrix3d> stiffness_of_phase, const Law law)
    : cell(cell)
    , stiffness_of_phase(std::move(stiffness_of_phase))
    , law(law)
    , unknown(static_cast<std::size_t>(cell.mesh.n_vertices()), -1)
    , areas(meshes::signed_areas(cell.mesh))
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  const auto of                      = [&](const int v) { return static_cast<std::size_t>(v); };
  const int anchor                   = classes.representative[of(cell.anchor)];
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (const int master = classes.representative[of(v)]; master != anchor)
    {
      if (master == v)
      {
        unknown[of(v)] = n_unknowns;
        n_unknowns += 2;
      }
      else
        unknown[of(v)] = unknown[of(master)]; // the lowest index comes first
    }
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    Eigen::Matrix2d edges;
    for (int k = 0; k < 2; ++k)
      edges.row(k) = cell.mesh.vertices.row(cell.mesh.triangles(t, k + 1)) -
                     cell.mesh.vertices.row(cell.mesh.triangles(t, 0));
    Eigen::Matrix<double, 3, 2> gradients;
    gradients.bottomRows<2>() = edges.inverse().transpose();
    gradients.row(0)          = -gradients.bottomRows<2>().colwise().sum();
    hats.push_back(gradients);
  }
}

meshes::Points NonlinearCell::spread(const Eigen::VectorXd &unknowns) const
{
  meshes::Points w = meshes::Points::Zero(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    if (const int first = unknown[static_cast<std::size_t>(v)]; first >= 0)
      w.row(v) = unknowns.segment<2>(first).transpose();
  return w;
}

NonlinearCell::Assembled NonlinearCell::assemble(const Eigen::Matrix2d &U, const meshes::Points &w,
                                                 const bool with_matrix, const bool projected) const
{
  Assembled sum;
  sum.residual.setZero(n_unknowns);
  std::vector<Eigen::Triplet<double>> entries;
  double squared_size = 0., squared_round_off = 0.;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const auto &g = hats[static_cast<std::size_t>(t)];
    // B maps the fluctuations of the corners to the entries F11, F12, F21, F22.
    Eigen::Matrix<double, 4, 6> B = Eigen::Matrix<double, 4, 6>::Zero();
    Eigen::Matrix2d F             = U;
    double size_of_terms          = U.norm(); // of the sum that F is
    for (int k = 0; k < 3; ++k)
    {
      F += w.row(cell.mesh.triangles(t, k)).transpose() * g.row(k);
      size_of_terms += w.row(cell.mesh.triangles(t, k)).norm() * g.row(k).norm();
      B.block<2, 1>(0, 2 * k)     = g.row(k).transpose();
      B.block<2, 1>(2, 2 * k + 1) = g.row(k).transpose();
    }
    const Eigen::Matrix3d &c = stiffness_of_phase[static_cast<std::size_t>(cell.mesh.material(t))];
    const Response local     = response(law, c, F);
    const double part        = areas(t) / cell.lattice.area();
    squared_round_off += std::pow(part * std::numeric_limits<double>::epsilon() *
                                    c.cwiseAbs().maxCoeff() * size_of_terms,
                                  2) *
                         g.squaredNorm();
    sum.energy += part * local.energy;
    sum.energy_round_off +=
      part * local.stress.norm() * std::numeric_limits<double>::epsilon() * size_of_terms;
    sum.stress += part * Eigen::Vector3d(local.stress(0), local.stress(3),
                                         0.5 * (local.stress(1) + local.stress(2)));
    const Eigen::Matrix<double, 6, 1> force = part * B.transpose() * local.stress;
    squared_size += force.squaredNorm();
    Eigen::Matrix<double, 6, 6> stiffness;
    if (with_matrix)
      stiffness =
        part * B.transpose() * (projected ? positive_part(local.tangent) : local.tangent) * B;
    for (int k = 0; k < 3; ++k)
    {
      const int row = unknown[static_cast<std::size_t>(cell.mesh.triangles(t, k))];
      if (row < 0)
        continue;
      sum.residual.segment<2>(row) += force.segment<2>(2 * k);
      for (int l = 0; with_matrix && l < 3; ++l)
        if (const int column = unknown[static_cast<std::size_t>(cell.mesh.triangles(t, l))];
            column >= 0)
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
              entries.emplace_back(row + i, column + j, stiffness(2 * k + i, 2 * l + j));
    }
  }
  sum.force_size = std::sqrt(squared_size);
  sum.round_off  = std::sqrt(squared_round_off);
  if (with_matrix)
  {
    sum.matrix.resize(n_unknowns, n_unknowns);
    sum.matrix.setFromTriplets(entries.begin(), entries.end());
  }
  return sum;
}

CellState NonlinearCell::solve(const Eigen::Vector3d &strain) const
{
  Eigen::Matrix2d U;
  U << 1. + strain(0), 0.5 * strain(2), 0.5 * strain(2), 1. + strain(1);
  CellState state;
  state.fluctuation = meshes::Points::Zero(cell.mesh.n_vertices(), 2);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
    for (int a = 0; a < 3; ++a)
      state.fluctuation.row(v) -=
        strain(a) * (cell.chi.row(v) - cell.chi.row(cell.anchor)).segment<2>(2 * a);

  constexpr double rounding = 1e-14; // of an energy that is a sum over the triangles
  std::vector<double> history;
  Assembled now = assemble(U, state.fluctuation, false, false);
  for (int newton = 0;; ++newton)
  {
    const double size = now.residual.norm();
    history.push_back(now.force_size > 0. ? size / now.force_size : 0.);
    // Down to round-off: the excess over the linear theory is a small difference.
    const bool is_stuck = newton > 2 && size < std::max(1e-10 * now.force_size, now.round_off) &&
                          history.back() > 0.5 * history[history.size() - 2];
    if (history.back() <= 1e-14 || is_stuck || n_unknowns == 0)
      break;
    if (newton == 40 || !std::isfinite(now.energy))
      throw meshes::NotConverged("cell at finite strain: Newton's method stalls", history);
    // The exact Hessian where it is positive definite; else the projected one, which is only
    // semi-definite, with as little of its own diagonal as makes it definite.
    Eigen::SimplicialLDLT<Sparse> factor;
    double shift           = 0.;
    const auto is_definite = [&](const bool projected)
    {
      Sparse matrix = assemble(U, state.fluctuation, true, projected).matrix;
      matrix.diagonal() *= 1. + shift;
      factor.compute(matrix);
      return factor.info() == Eigen::Success && factor.vectorD().minCoeff() > 0.;
    };
    if (!is_definite(false))
      for (shift = 1e-10; !is_definite(true); shift *= 100.)
        if (shift > 1.)
          throw meshes::NotConverged("cell at finite strain: no definite matrix", history);
    const Eigen::VectorXd step = -factor.solve(now.residual);
    const double slope         = step.dot(now.residual);
    double length              = 1.;
    for (;; length *= 0.5)
    {
      const meshes::Points trial = state.fluctuation + length * spread(step);
      const Assembled next       = assemble(U, trial, false, false);
      // Close to the answer the energy changes by less than its rounding, and the step is Newton's
      // own.
      if (size < std::max(1e-7 * now.force_size, 10. * now.round_off) ||
          next.energy <= now.energy + 1e-4 * length * slope + rounding * std::abs(now.energy) +
                           now.energy_round_off)
      {
        state.fluctuation = trial;
        now               = next;
        break;
      }
      if (length < 1e-4)
        throw meshes::NotConverged("cell at finite strain: the line search found no lower energy",
                                   history);
    }
  }
  state.stress = now.stress;
  return state;
}

namespace
{
/// Radical inverse: the points of a Halton sequence fill a box evenly, the same every time.
double halton(int index, const int base)
{
  double value = 0., digit = 1.;
  for (; index > 0; index /= base)
  {
    digit /= base;
    value += digit * (index % base);
  }
  return value;
}
} // namespace

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
