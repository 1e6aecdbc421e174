// SPDX-License-Identifier: MIT
#include "meshes/plain/singular_values.h"

#include <Eigen/SVD>

namespace homespun::meshes
{
using Decomposition = Eigen::BDCSVD<Eigen::MatrixXd>;

SingularValues singular_values(const Eigen::MatrixXd &A, const unsigned int options)
{
  const Decomposition svd(A, options);
  SingularValues result{svd.singularValues(), {}, {}};
  if (svd.computeU())
    result.U = svd.matrixU();
  if (svd.computeV())
    result.V = svd.matrixV();
  return result;
}

Eigen::MatrixXd least_squares(const Eigen::MatrixXd &A, const Eigen::MatrixXd &b,
                              const double threshold)
{
  Decomposition svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(threshold);
  return svd.solve(b);
}
} // namespace homespun::meshes
