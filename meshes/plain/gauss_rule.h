// SPDX-License-Identifier: MIT
// Gauss-Legendre quadrature with any number of points.
#pragma once

#include <Eigen/Core>

namespace homespun::meshes
{
struct GaussRule
{
  Eigen::VectorXd points;  ///< (n) ascending in (−1, 1)
  Eigen::VectorXd weights; ///< (n), their sum is 2
};

/// The rule of n points on (−1, 1), exact for polynomials of degree 2 n − 1: the zeros x of
/// Legendre's P_n by Newton's method, weights 2 / ((1 − x²) P_n'(x)²).
GaussRule gauss_rule(int n);
} // namespace homespun::meshes
