// SPDX-License-Identifier: MIT
#include "verification/stress/stress_localization.h"

#include "localization/upsampler.h"
#include "meshes/cloth/irregular_sheet.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/symmetric_eigen.h"
#include "meshes/plain/triangle_kinematics.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using localization::Positions;
using localization::Upsampler;
using localization::UpsamplerOptions;

namespace
{
constexpr int n_cells = 4;

/// Coarse positions of a sheet.
struct Violence
{
  const char *name, *value_is;
  double last; ///< of the ladder, by factors of 1000
  Positions<3> (*of)(const Positions<3> &rest, double value);
};

const std::vector<Violence> violent_motions = {
  {"up-sampling, compressed", "factor, both axes [-]", 1e30,
   [](const Positions<3> &rest, const double value) -> Positions<3> { return rest / value; }},
  {"up-sampling, stretched", "factor, both axes [-]", 1e30,
   [](const Positions<3> &rest, const double value) -> Positions<3> { return value * rest; }},
  {"up-sampling, flattened", "length over width of what it is pressed to [-]", 1e30,
   [](const Positions<3> &rest, const double value) -> Positions<3>
   {
     Positions<3> x = rest.rowwise().sum() * Eigen::RowVector3d(1., 2., 3.);
     x.col(0) += rest.col(0) / value;
     return x;
   }},
  {"up-sampling, thrown about", "random way of each coarse vertex [sides]", 1e15,
   [](const Positions<3> &rest, const double value) -> Positions<3>
   { return rest + value * rest.cwiseAbs().maxCoeff() * meshes::random_vectors(rest.rows(), 0); }},
  {"up-sampling, one vertex far", "way of one coarse vertex [m]", 1e15,
   [](const Positions<3> &rest, const double value) -> Positions<3>
   {
     Positions<3> x = rest;
     x.row(3) += value * Eigen::RowVector3d(1., -0.2, 0.3);
     return x;
   }}};

/// Sum of the sizes of Biot's strain U - I, 11, 22 and twice 12; U of F = R U by the eigenvectors
/// of F'F, apart from the code under test.
double size_of_strain(const Eigen::Matrix<double, 3, 2> &F)
{
  const auto squared      = meshes::symmetric_eigen<2>(F.transpose() * F);
  const Eigen::Matrix2d U = squared.vectors * squared.values.cwiseMax(0.).cwiseSqrt().asDiagonal() *
                            squared.vectors.transpose();
  return std::abs(U(0, 0) - 1.) + std::abs(U(1, 1) - 1.) + 2. * std::abs(U(0, 1));
}

/// Largest microscopic displacement over its bound.
StressAnswer upsampled(const meshes::HomogenizedCell &cell, const Violence &motion,
                       const double value)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  const meshes::TriangleMesh mesh =
    meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, n_cells, n_cells);
  Positions<3> rest         = Positions<3>::Zero(mesh.n_vertices(), 3);
  rest.leftCols<2>()        = mesh.vertices;
  const Positions<3> coarse = motion.of(rest, value);

  UpsamplerOptions without;
  without.microscopic = false;
  Upsampler<3, double>::Fine fine, alone;
  Upsampler<3, float>::Fine in_floats;
  Upsampler<3, double>(cell, mesh, sheet).upsample(coarse, fine);
  Upsampler<3, double>(cell, mesh, sheet, without).upsample(coarse, alone);
  Upsampler<3, float>(cell, mesh, sheet).upsample(coarse, in_floats);

  double strain = 0., mode = 0.;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    strain = std::max(strain, size_of_strain(meshes::deformation_gradient<3>(mesh, t, coarse)));
  const meshes::Chi chi = localization::anchored(cell, localization::Anchor::lattice);
  for (int k = 0; k < 3; ++k)
    mode = std::max(mode, chi.middleCols<2>(2 * k).rowwise().norm().maxCoeff());
  constexpr double lift = 1.; // of a rotation
  const double bound    = strain * lift * mode + 1e-14 * coarse.cwiseAbs().maxCoeff();
  Eigen::MatrixXd values(fine.rows(), 6);
  values << fine, in_floats.cast<double>();
  return {(fine - alone).rowwise().norm().maxCoeff() / bound, values};
}
} // namespace

std::vector<StressAxis> localization_axes(const meshes::HomogenizedCell &cell,
                                          const std::string &name)
{
  std::vector<StressAxis> axes;
  for (const Violence &motion : violent_motions)
  {
    StressAxis axis;
    axis.axis       = motion.name;
    axis.of         = name;
    axis.value_is   = motion.value_is;
    axis.criterion  = "finite in float and double; largest microscopic displacement over its bound";
    axis.limit      = 1. + 1e-12; // round-off of the bound itself
    axis.theory     = TheoryOfEnd::promises;
    axis.theory_end = motion.last;
    axis.theory_is =
      "lift x sum of |strains| x largest mode bounds it, whatever the motion: no end "
      "within the numbers of a computer";
    for (int power = 0; std::pow(10., power) <= motion.last; power += 3)
      axis.ladder.push_back(power == 0 ? 5. : std::pow(10., power));
    axis.at = [=](const double value) { return upsampled(cell, motion, value); };
    axes.push_back(axis);
  }
  return axes;
}
} // namespace homespun::verification
