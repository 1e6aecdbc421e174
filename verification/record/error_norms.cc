// SPDX-License-Identifier: MIT
#include "verification/record/error_norms.h"

#include <cmath>

namespace homespun::verification
{
ErrorNorms error_norms(const Eigen::VectorXd &distances)
{
  return {distances.mean(),
          std::sqrt(distances.squaredNorm() / static_cast<double>(distances.size())),
          distances.maxCoeff()};
}
} // namespace homespun::verification
