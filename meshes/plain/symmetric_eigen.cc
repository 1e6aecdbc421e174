// SPDX-License-Identifier: MIT
#include "meshes/plain/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace homespun::meshes
{
template <int n>
SymmetricEigen<n> symmetric_eigen(const Eigen::Matrix<double, n, n> &A)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> solver(A);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

template SymmetricEigen<2> symmetric_eigen<2>(const Eigen::Matrix2d &);
template SymmetricEigen<3> symmetric_eigen<3>(const Eigen::Matrix3d &);
template SymmetricEigen<4> symmetric_eigen<4>(const Eigen::Matrix4d &);
template SymmetricEigen<Eigen::Dynamic> symmetric_eigen<Eigen::Dynamic>(const Eigen::MatrixXd &);
} // namespace homespun::meshes
