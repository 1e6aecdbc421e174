// SPDX-License-Identifier: MIT
#include "homogenization/bracket/loewner.h"

#include "meshes/plain/errors.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <limits>
#include <sstream>
#include <stdexcept>

namespace homespun::homogenization
{
namespace
{
/// A scaled to a unit diagonal.
Eigen::Matrix3d scaled(const Eigen::Matrix3d &A, const Eigen::Vector3d &scale)
{
  return scale.asDiagonal() * A * scale.asDiagonal();
}

Eigen::Vector3d scale_of(const Eigen::Matrix3d &A)
{
  return A.diagonal().cwiseSqrt().cwiseInverse();
}
} // namespace

double weakness(const Eigen::Matrix3d &A)
{
  const double smallest =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scaled(A, scale_of(A)), Eigen::EigenvaluesOnly)
      .eigenvalues()(0);
  return smallest > 0. ? 1. / smallest : std::numeric_limits<double>::infinity();
}

double relative_error(const Eigen::Matrix3d &error, const Eigen::Matrix3d &A)
{
  return scaled(error, scale_of(A)).cwiseAbs().maxCoeff();
}

Eigen::Matrix3d raised(const Eigen::Matrix3d &A, const double part)
{
  const Eigen::Matrix3d diagonal = A.diagonal().asDiagonal();
  return A + 3. * part * diagonal;
}

RoundedInverse inverse_of(const Eigen::Matrix3d &A)
{
  // Of forms of three strains, in units of the rounding x weakness: 12 from the factors, 54 from
  // their inverse, 27 from its square, 27 from the scaling and the last rounding; a rounding is
  // half of epsilon.
  constexpr double roundings  = 64. * std::numeric_limits<double>::epsilon();
  const Eigen::Vector3d scale = scale_of(A);
  const Eigen::LLT<Eigen::Matrix3d> factors(scaled(A, scale));
  const double round_off = roundings * weakness(A);
  if (!A.allFinite() || factors.info() != Eigen::Success || !(round_off < 0.1))
    throw meshes::NotConverged(
      "a side of the bracket is not positive beyond round-off: the contrast of the phases leaves "
      "it no digit; expected a lower contrast",
      {});
  const Eigen::Matrix3d root = factors.matrixL().solve(Eigen::Matrix3d(scale.asDiagonal()));
  return {root.transpose() * root, round_off};
}

double relative_width(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper,
                      const double round_off)
{
  Eigen::Vector3d gaps = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (lower.allFinite() && upper.allFinite())
    gaps =
      Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d>(upper - lower, upper).eigenvalues();
  if (!(gaps(0) >= -round_off))
  {
    std::ostringstream text;
    text << "the lower side of a bracket exceeds the upper one by " << -gaps(0)
         << " of an energy, more than the round-off of " << round_off
         << ": one of them is wrong; please report the cell";
    throw std::logic_error(text.str());
  }
  return gaps(2);
}
} // namespace homespun::homogenization
