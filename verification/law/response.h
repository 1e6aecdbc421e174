// SPDX-License-Identifier: MIT
// What a law answers: in the plane at a deformation gradient F; where it is a function of the
// metric alone by E = ½ (F^T F − I), and from there by F in the plane (dim = 2) or in space (dim =
// 3),
//   P = F S    and    dF : dP = dE · H · dE + tr(dF S dF^T),    dE = sym(F^T dF).
#pragma once

#include <Eigen/Core>

namespace homespun::verification
{
/// Energy per area and its derivatives by the entries of F in the order F11, F12, F21, F22.
struct Response
{
  double energy;           ///< W [N/m]
  Eigen::Vector4d stress;  ///< P = dW/dF, the first Piola-Kirchhoff membrane force [N/m]
  Eigen::Matrix4d tangent; ///< dP/dF [N/m]
};

/// Derivative of the position in space by the rest position, columns f1, f2.
using SpaceGradient = Eigen::Matrix<double, 3, 2>;

/// W, its gradient and its second derivative by E in Voigt order, 11, 22 and twice 12.
struct MetricResponse
{
  double energy;             ///< [N/m]
  Eigen::Vector3d force;     ///< S = dW/dE, the second Piola-Kirchhoff stress [N/m]
  Eigen::Matrix3d stiffness; ///< H = d²W/dE² [N/m]
};

/// A symmetric matrix from its entries 11, 22, 12.
inline Eigen::Matrix2d symmetric(const Eigen::Vector3d &entries)
{
  Eigen::Matrix2d matrix;
  matrix << entries(0), entries(2), entries(2), entries(1);
  return matrix;
}

/// B dF = dE with the entries of F row by row.
template <int dim>
Eigen::Matrix<double, 3, 2 * dim> strain_derivative(const Eigen::Matrix<double, dim, 2> &F)
{
  Eigen::Matrix<double, 3, 2 * dim> B;
  for (int a = 0; a < dim; ++a)
  {
    B.col(2 * a) << F(a, 0), 0., F(a, 1);
    B.col(2 * a + 1) << 0., F(a, 1), F(a, 0);
  }
  return B;
}

/// dP/dF, row by row.
template <int dim>
Eigen::Matrix<double, 2 * dim, 2 * dim> tangent_of(const Eigen::Matrix<double, dim, 2> &F,
                                                   const Eigen::Matrix3d &H,
                                                   const Eigen::Matrix2d &S)
{
  const Eigen::Matrix<double, 3, 2 *dim> B       = strain_derivative<dim>(F);
  Eigen::Matrix<double, 2 * dim, 2 *dim> tangent = B.transpose() * (H * B);
  for (int a = 0; a < dim; ++a)
    tangent.template block<2, 2>(2 * a, 2 * a) += S;
  return tangent;
}
} // namespace homespun::verification
