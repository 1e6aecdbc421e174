// SPDX-License-Identifier: MIT
#include "verification/periodic/margin_search.h"

#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
constexpr int most_fields = 6; ///< that are computed between two eliminations

/// A wave that may be below the upper side.
struct Undecided
{
  Wave wave;
  BlochPencil::Ties ties;
};

/// The numbers 0 to n − 1 in an order in which the first few are spread over all.
std::vector<std::size_t> spread(const std::size_t n)
{
  std::vector<std::size_t> order;
  for (std::size_t stride = 8, begin = 0; begin < stride; ++begin)
    for (std::size_t k = begin; k < n; k += stride)
      order.push_back(k);
  return order;
}

bool is_positive(const Eigen::MatrixXcd &matrix)
{
  return Eigen::LLT<Eigen::MatrixXcd>(matrix).info() == Eigen::Success;
}
} // namespace

MarginSearch::MarginSearch(const BlochPencil &pencil, const CellAssembly::Sparse &stiffness)
    : pencil(pencil)
    , stiffness(stiffness)
    , parts(pencil.split(stiffness))
{
}

const BlochPencil::Shifted *MarginSearch::shifted(const double beta)
{
  if (last_beta != beta)
  {
    last      = pencil.shifted(parts, beta);
    last_beta = beta;
  }
  return last ? &*last : nullptr;
}

Eigen::MatrixXcd MarginSearch::of_wave(const Eigen::MatrixXd &schur,
                                       const BlochPencil::Ties &ties) const
{
  const Eigen::MatrixXcd right = schur * ties;
  return ties.adjoint() * right;
}

bool MarginSearch::is_above(const Wave &wave, const double beta)
{
  const BlochPencil::Shifted *at = shifted(beta);
  return at && is_positive(of_wave(at->schur, pencil.ties(wave)));
}

Mode MarginSearch::lowest(const BlochPencil::Shifted &at, const BlochPencil::Ties &ties) const
{
  constexpr long most_steps = 60;
  const Eigen::LLT<Eigen::MatrixXcd> rest(of_wave(pencil.eliminated_at_rest().schur, ties));
  const Eigen::MatrixXcd matrix = of_wave(at.schur, ties);
  const long n = matrix.rows(), n_steps = std::min(n, most_steps);
  Eigen::MatrixXcd basis(n, n_steps);
  Eigen::VectorXd diagonal(n_steps), beside = Eigen::VectorXd::Zero(n_steps);
  Eigen::VectorXcd next(n);
  for (long k = 0; k < n; ++k) // whatever has no symmetry of a cell
    next(k) =
      std::polar(1. + 0.5 * std::sin(1.7 * static_cast<double>(k)), 2.4 * static_cast<double>(k));
  long m = 0;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  for (double size = next.norm(); m < n_steps && size > 0.; ++m)
  {
    basis.col(m)           = next / size;
    Eigen::VectorXcd image = rest.matrixU().solve(basis.col(m));
    image                  = matrix * image;
    next                   = rest.matrixL().solve(image);
    diagonal(m)            = basis.col(m).dot(next).real();
    for (int twice = 0; twice < 2; ++twice)
      next -= basis.leftCols(m + 1) * (basis.leftCols(m + 1).adjoint() * next);
    size      = next.norm();
    beside(m) = size;
    if ((m + 1) % 10 == 0 || m + 1 == n_steps || size <= 1e-14 * diagonal.head(m + 1).norm())
    {
      ritz.computeFromTridiagonal(diagonal.head(m + 1), beside.head(m));
      // The error of a quotient is the square of that of its field.
      const double error = size * std::abs(ritz.eigenvectors()(m, 0));
      if (error <= 1e-4 * std::abs(ritz.eigenvalues()(0)) ||
          size <= 1e-14 * diagonal.head(m + 1).norm())
      {
        ++m;
        break;
      }
    }
  }
  const Eigen::VectorXcd lowest = basis.leftCols(m) * ritz.eigenvectors().col(0).head(m);
  return pencil.extended(at, ties * Eigen::VectorXcd(rest.matrixU().solve(lowest)));
}

Margin MarginSearch::start(const std::vector<Wave> &waves) const
{
  Margin best;
  best.beta  = std::numeric_limits<double>::infinity();
  best.lower = -best.beta;
  for (const Wave &wave : waves)
  {
    const BlochPencil::Ties ties = pencil.ties(wave);
    for (int c = 1; c <= 2; ++c) // of long waves a (n.y), of others a master that moves
    {
      const Eigen::VectorXcd plain = Eigen::VectorXcd::Unit(ties.cols(), ties.cols() - c);
      const Mode mode              = pencil.extended(pencil.eliminated_at_rest(), ties * plain);
      if (const double beta = pencil.quotient(stiffness, mode); beta < best.beta)
        best = {beta, best.lower, wave, mode};
    }
  }
  return best;
}

Margin MarginSearch::lowered(Margin from, const std::vector<Wave> &waves)
{
  std::vector<Undecided> undecided;
  for (const std::size_t k : spread(waves.size()))
    undecided.push_back({waves[k], pencil.ties(waves[k])});
  double lower = -std::numeric_limits<double>::infinity(), step = 0.;
  std::vector<double> history;
  for (int pass = 0; pass < 200; ++pass)
  {
    history.push_back(from.beta);
    const double least_step = closeness * (1. + std::abs(from.beta));
    if (from.beta - lower <= 1.5 * least_step)
    {
      from.lower = lower;
      return from;
    }
    double trial = from.beta - std::max(step, least_step);
    if (trial <= lower)
      trial = 0.5 * (lower + from.beta);
    const BlochPencil::Shifted *at = shifted(trial);
    if (!at)
    {
      // Fields inside the cell, which belong to every wave, are below: an upper side by inertia.
      from.beta = trial;
      from.wave = undecided.front().wave;
      from.mode.resize(0);
      step = 100. * std::max(step, least_step);
      continue;
    }
    // Few fields at a time: each brings the upper side down, and a wave above trial is above
    // whatever comes below it.
    Margin best  = from;
    int n_fields = 0;
    std::vector<Undecided> below, not_asked;
    for (const Undecided &one : undecided)
    {
      if (n_fields == most_fields)
        not_asked.push_back(one);
      else if (!is_positive(of_wave(at->schur, one.ties)))
      {
        below.push_back(one);
        ++n_fields;
        const Mode mode = lowest(*at, one.ties);
        if (const double beta = pencil.quotient(stiffness, mode); beta < best.beta)
          best = {beta, lower, one.wave, mode};
      }
    }
    if (below.empty())
    {
      lower = trial;
      continue;
    }
    undecided = std::move(not_asked);
    undecided.insert(undecided.end(), below.begin(), below.end());
    from = best;
    // Inertia says that an eigenvalue is below, whatever the fields can show.
    from.beta = std::min(from.beta, trial);
    step      = 0.;
  }
  throw meshes::NotConverged("Bloch waves: the two sides of the least eigenvalue do not meet",
                             history);
}
} // namespace homespun::verification
