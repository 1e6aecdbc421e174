// SPDX-License-Identifier: MIT
#include "verification/reference/cloth_reference_faults.h"

#include "meshes/plain/symmetric_eigen.h"


#include <cmath>

namespace homespun::verification
{
std::vector<std::string> faults_of_cloth(const meshes::TriangleMesh &rest,
                                         const std::vector<Eigen::Matrix3d> &stiffness,
                                         const std::vector<double> &density,
                                         const ClothReferenceOptions &options)
{
  std::vector<std::string> faults = meshes::faults_of(rest, "the rest mesh");
  if (options.law == Law::linear)
    faults.push_back("the law is linear, which no rotation leaves alone; expected biot or green");
  if (options.order != 1 && options.order != 2)
    faults.push_back("the order is " + std::to_string(options.order) + "; expected 1 or 2");
  if (!(options.tolerance > 0.))
    faults.push_back("the tolerance is " + std::to_string(options.tolerance) +
                     "; expected a positive number");
  if (stiffness.size() != density.size())
    faults.push_back("there are " + std::to_string(stiffness.size()) + " stiffnesses but " +
                     std::to_string(density.size()) + " densities; expected one of each per phase");
  for (std::size_t p = 0; p < stiffness.size(); ++p)
  {
    const Eigen::Matrix3d &C = stiffness[p];
    if (!C.allFinite() || (C - C.transpose()).norm() > 1e-12 * C.norm() ||
        !(meshes::symmetric_eigen<3>(C).values(0) > 0.))
      faults.push_back("the stiffness of phase " + std::to_string(p) +
                       " is not symmetric and positive definite");
  }
  for (std::size_t p = 0; p < density.size(); ++p)
    if (!(density[p] > 0.) || !std::isfinite(density[p]))
      faults.push_back("the density of phase " + std::to_string(p) + " is " +
                       std::to_string(density[p]) + "; expected a positive number [kg/m^2]");
  const int n_phases = static_cast<int>(stiffness.size());
  if (rest.material.size() != rest.n_triangles())
    faults.push_back("the rest mesh has " + std::to_string(rest.n_triangles()) +
                     " triangles but a phase for " + std::to_string(rest.material.size()));
  else
    for (int t = 0; t < rest.n_triangles(); ++t)
      if (rest.material(t) < 0 || rest.material(t) >= n_phases)
      {
        faults.push_back("triangle " + std::to_string(t) + " has phase " +
                         std::to_string(rest.material(t)) + "; expected 0 to " +
                         std::to_string(n_phases - 1));
        break;
      }
  return faults;
}
} // namespace homespun::verification
