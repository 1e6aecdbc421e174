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
  const char *name;
  Repeats repeats;
  Positions<3> (*of)(const Positions<3> &rest, unsigned int seed);
};

const std::vector<Violence> violent_motions = {
  {"both axes to 0.2", Repeats::same_bits,
   [](const Positions<3> &rest, unsigned int) -> Positions<3> { return 0.2 * rest; }},
  {"the whole sheet in a line", Repeats::same_bits,
   [](const Positions<3> &rest, unsigned int) -> Positions<3>
   { return rest.rowwise().sum() * Eigen::RowVector3d(1., 2., 3.); }},
  {"the whole sheet in a point", Repeats::same_bits,
   [](const Positions<3> &rest, unsigned int) -> Positions<3>
   { return Positions<3>::Constant(rest.rows(), 3, 0.3); }},
  {"random coarse vertices", Repeats::with_seeds,
   [](const Positions<3> &rest, const unsigned int seed) -> Positions<3>
   { return rest.cwiseAbs().maxCoeff() * meshes::random_vectors(rest.rows(), seed); }},
  {"one coarse vertex at 1e6 m", Repeats::with_seeds,
   [](const Positions<3> &rest, const unsigned int seed) -> Positions<3>
   {
     Positions<3> x = rest;
     x.row(static_cast<int>(7 * seed + 3) % static_cast<int>(x.rows())) << 1e6, -2e5, 3e5;
     return x;
   }},
  {"scaled by 1e-30", Repeats::same_bits,
   [](const Positions<3> &rest, unsigned int) -> Positions<3> { return 1e-30 * rest; }},
  {"scaled by 1e+30", Repeats::same_bits,
   [](const Positions<3> &rest, unsigned int) -> Positions<3> { return 1e30 * rest; }}};

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
                       const unsigned int seed)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n_cells, n_cells);
  const meshes::TriangleMesh mesh =
    meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, n_cells, n_cells);
  Positions<3> rest         = Positions<3>::Zero(mesh.n_vertices(), 3);
  rest.leftCols<2>()        = mesh.vertices;
  const Positions<3> coarse = motion.of(rest, seed);

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

std::vector<StressCase> localization_cases(const meshes::HomogenizedCell &cell,
                                           const std::string &name)
{
  const Limit bound = {1. + 1e-12, "largest microscopic displacement over its bound [-]",
                       "theory: lift x sum of |strains| x largest mode, and 1e-14 of the largest "
                       "coordinate, whose digits the difference of two positions loses; round-off "
                       "of the bound itself: 1e-12 of it"};
  std::vector<StressCase> cases;
  for (const Violence &motion : violent_motions)
    cases.emplace_back("localization", std::string(motion.name) + "; " + name,
                       "finite in float and double; within the bound of the method", bound,
                       motion.repeats,
                       [=](const unsigned int seed) { return upsampled(cell, motion, seed); });
  return cases;
}
} // namespace homespun::verification
