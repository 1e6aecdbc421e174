// SPDX-License-Identifier: MIT
#include "meshes/cloth/irregular_sheet.h"
#include "shell/membrane/triangle_packs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// Two phases, one of them coupled, on a number of triangles that fills no whole packs.
Membrane two_phases(meshes::TriangleMesh mesh)
{
  for (int t = 0; t < mesh.n_triangles(); ++t)
    mesh.material(t) = t % 3 == 0 ? 1 : 0;
  Eigen::Matrix3d soft, coupled;
  soft << 100., 20., 0., 20., 80., 0., 0., 0., 15.;
  coupled << 300., 40., 25., 40., 90., -10., 25., -10., 60.;
  return membrane(mesh, {soft, coupled});
}

/// Flat, bent and torn apart, with triangles that are crushed to a line and to a point.
std::vector<Positions<3>> motions(const Membrane &membrane)
{
  Positions<3> flat  = Positions<3>::Zero(membrane.vertices.rows(), 3);
  flat.leftCols<2>() = membrane.vertices;
  Positions<3> line = flat + 0.03 * meshes::random_vectors(flat.rows(), 3), point = line;
  line.row(membrane.triangles(4, 0)) =
    0.5 * (line.row(membrane.triangles(4, 1)) + line.row(membrane.triangles(4, 2)));
  for (int k = 0; k < 3; ++k)
    point.row(membrane.triangles(7, k)) << 0.1, 0.2, 0.3;
  return {flat,
          1.3 * flat,
          flat + 0.01 * meshes::random_vectors(flat.rows(), 1),
          0.2 * meshes::random_vectors(flat.rows(), 2),
          line,
          point};
}
} // namespace

TEST(exact_triangle_packs, energy_and_derivatives_are_those_of_each_triangle)
{
  const Membrane sheet = two_phases(meshes::irregular_sheet(3, 0.2));
  ASSERT_NE(sheet.triangles.rows() % TrianglePacks::size, 0);
  TrianglePacks packs(sheet);
  std::vector<Eigen::Vector3d> stress;
  // Of strains of zero under stresses of at most 5 sqrt(3) N/m on 0.04 m^2.
  const double round_off = 10. * std::numeric_limits<double>::epsilon() * 9. * 0.04;
  for (const bool is_stressed : {false, true})
  {
    if (is_stressed)
    {
      for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t)
        stress.push_back(5. * meshes::random_vectors(1, static_cast<unsigned int>(t)).row(0));
      packs.set_initial_stress(stress);
    }
    for (const Positions<3> &x : motions(sheet))
      for (const Hessian kind : {Hessian::exact, Hessian::projected})
      {
        double energy = 0.;
        int n         = 0;
        packs.derivatives(
          x, kind,
          [&](const int t, const TriangleDerivatives<3> &found)
          {
            ASSERT_EQ(t, n++);
            const auto at = static_cast<std::size_t>(t);
            Eigen::Matrix3d corners;
            for (int k = 0; k < 3; ++k)
              corners.row(k) = x.row(sheet.triangles(t, k));
            const auto &D            = sheet.stiffness[static_cast<std::size_t>(sheet.phase[at])];
            const Eigen::Vector3d T0 = is_stressed ? stress[at] : Eigen::Vector3d::Zero().eval();
            const auto expected = triangle_derivatives<3>(sheet.rest[at], corners, D, kind, T0);
            // Sums of a few dozen products, of which none is larger than this.
            double largest = expected.gradient.norm();
            for (const auto &block : expected.blocks)
              largest = std::max(largest, block.norm());
            EXPECT_LT((found.gradient - expected.gradient).norm(), 1e-13 * largest);
            for (std::size_t b = 0; b < 6; ++b)
              EXPECT_LT((found.blocks[b] - expected.blocks[b]).norm(), 1e-12 * largest)
                << t << " " << b;
            energy += triangle_energy<3>(sheet.rest[at], corners, D.D);
            if (is_stressed)
              energy += sheet.rest[at].area *
                        T0.dot(biot_strain<3>(deformation_gradient<3>(sheet.rest[at], corners)));
          });
        EXPECT_EQ(n, sheet.triangles.rows());
        EXPECT_NEAR(packs.energy(x), energy, 1e-13 * std::abs(energy) + round_off);
      }
  }
}

TEST(exact_triangle_packs, what_is_not_a_number_or_beyond_all_measure_comes_out_as_of_one_triangle)
{
  const Membrane sheet = two_phases(meshes::irregular_sheet(2, 0.2));
  const TrianglePacks packs(sheet);
  Positions<3> x  = Positions<3>::Zero(sheet.vertices.rows(), 3);
  x.leftCols<2>() = sheet.vertices;
  for (const double scale : {1e-30, 1e30})
  {
    const double found = packs.energy(scale * x), expected = membrane_energy<3>(sheet, scale * x);
    EXPECT_NEAR(found, expected, 1e-12 * expected) << scale;
  }
  x(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(packs.energy(x)));
  packs.derivatives(x, Hessian::projected,
                    [&](const int t, const TriangleDerivatives<3> &found)
                    {
                      const bool has_it = (sheet.triangles.row(t).array() == 1).any();
                      EXPECT_EQ(found.gradient.allFinite(), !has_it) << t;
                    });
}
