// SPDX-License-Identifier: MIT
#include "localization/garment_chi.h"

#include <algorithm>

namespace homespun::localization
{
namespace
{
/// chi of a cell that is turned against the rest frame: w = Q w_cell(Q^T E Q).
Eigen::Matrix<double, 6, 6> turned_chi(const Eigen::Matrix2d &Q)
{
  Eigen::Matrix<double, 6, 6> map = Eigen::Matrix<double, 6, 6>::Zero(); // chi row times map
  for (int b = 0; b < 3; ++b)
  {
    Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
    if (b < 2)
      strain(b, b) = 1.;
    else
      strain(0, 1) = strain(1, 0) = 0.5;
    const Eigen::Matrix2d in_cell = Q.transpose() * strain * Q;
    const Eigen::Vector3d voigt(in_cell(0, 0), in_cell(1, 1), 2. * in_cell(0, 1));
    for (int a = 0; a < 3; ++a)
      map.block<2, 2>(2 * a, 2 * b) = voigt(a) * Q.transpose();
  }
  return map;
}

/// Grows from 0 at 0 to 1 at 1, with slope zero at both.
double smooth_step(const double s)
{
  const double t = std::clamp(s, 0., 1.);
  return t * t * (3. - 2. * t);
}
} // namespace

GarmentChi::GarmentChi(const meshes::HomogenizedCell &cell, const meshes::Chi &chi,
                       const meshes::FineCloth &fine, const double fade)
    : cell(cell)
    , chi(chi)
    , fine(fine)
    , fade(fade)
{
  for (const meshes::Grain &grain : fine.grains)
    turned.push_back(turned_chi(grain.rotation()));
}

Eigen::Matrix<double, 1, 6> GarmentChi::operator()(const int v) const
{
  Eigen::Matrix<double, 1, 6> here = Eigen::Matrix<double, 1, 6>::Zero();
  if (fine.cell_vertex(v) >= 0)
    here = chi.row(fine.cell_vertex(v));
  else
    for (int k = 0; k < 3; ++k)
      here += fine.cell_weights(v, k) * chi.row(cell.mesh.triangles(fine.cell_triangle(v), k));
  const auto panel = static_cast<std::size_t>(fine.panel(v));
  if (fine.grains[panel].angle != 0.)
    here = (here * turned[panel]).eval();
  const double distance = fine.seam_distance(v);
  if (distance < fade)
    here *= smooth_step(distance / fade);
  return here;
}
} // namespace homespun::localization
