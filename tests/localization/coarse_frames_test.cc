// SPDX-License-Identifier: MIT
#include "localization/coarse_frames.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/point_location.h"
#include "tests/localization/fine_position.h"
#include "tests/localization/localization_cases.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;

namespace
{
template <int dim>
void frames_match_the_singular_values()
{
  const tests::Cloth cloth = tests::skewed_cloth();
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> random(-1., 1.);
  for (int k = 0; k < 50; ++k)
  {
    Eigen::Matrix<double, dim, 2> F = tests::some_stretch<dim>();
    for (Eigen::Index i = 0; i < F.size(); ++i)
      F.data()[i] += 0.3 * random(generator);
    const Frame<dim> expected    = tests::frame_by_svd<dim>(F);
    const Positions<dim> current = tests::affine_motion<dim>(cloth.coarse.vertices, F);
    const CoarseFrames<dim> frames(cloth.coarse, {});
    const Frame<dim> single = frames.of_triangle(5, current);
    EXPECT_LT((single.strain - expected.strain).norm(), 1e-12);
    EXPECT_LT((single.lift - expected.lift).norm(), 1e-12);
    const Frame<dim> blended = tests::frame_at<dim>(frames, 5, {0.2, 0.5, 0.3}, current);
    EXPECT_LT((blended.strain - expected.strain).norm(), 1e-12);
    EXPECT_LT((blended.lift - expected.lift).norm(), 1e-12);
    UpsamplerOptions affine;
    affine.lift = Lift::affine;
    EXPECT_LT((CoarseFrames<dim>(cloth.coarse, affine).of_triangle(5, current).lift - F).norm(),
              1e-12);
  }
}

/// Fine positions on shared coarse edges, from the triangle on either side.
template <int dim>
double largest_jump(const Blend blend, const Lift lift)
{
  const tests::Cloth cloth = tests::skewed_cloth();
  UpsamplerOptions options;
  options.blend = blend;
  options.lift  = lift;
  const CoarseFrames<dim> frames(cloth.coarse, options);
  const Positions<dim> current          = tests::wavy_motion<dim>(cloth.coarse.vertices);
  const Eigen::Matrix<double, 1, 6> chi = cloth.cell.chi.row(17);
  const auto &triangles                 = cloth.coarse.triangles;
  double jump                           = 0.;
  int n_shared                          = 0;
  for (int s = 0; s < triangles.rows(); ++s)
    for (int t = s + 1; t < triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          if (triangles(s, k) == triangles(t, (l + 1) % 3) &&
              triangles(s, (k + 1) % 3) == triangles(t, l))
          {
            ++n_shared;
            for (const double part : {0., 0.3, 0.8})
            {
              Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = from;
              from(k) = to((l + 1) % 3) = 1. - part;
              from((k + 1) % 3) = to(l) = part;
              jump = std::max(jump, (tests::fine_position<dim>(frames, s, from, chi, current) -
                                     tests::fine_position<dim>(frames, t, to, chi, current))
                                      .norm());
            }
          }
  EXPECT_GT(n_shared, 20);
  return jump;
}
} // namespace

TEST(exact_coarse_frames, strain_and_rotation_are_those_of_the_singular_values)
{
  frames_match_the_singular_values<2>();
  frames_match_the_singular_values<3>();
}

TEST(invariant_coarse_frames, the_blended_field_has_no_jump_across_coarse_edges)
{
  for (const Lift lift : {Lift::rotation, Lift::affine, Lift::identity})
  {
    EXPECT_LT(largest_jump<2>(Blend::continuous, lift), 1e-16);
    EXPECT_LT(largest_jump<3>(Blend::continuous, lift), 1e-16);
  }
}

TEST(tripwire_coarse_frames, without_blending_the_jump_is_noticed)
{
  EXPECT_GT(largest_jump<2>(Blend::piecewise, Lift::rotation), 1e-6);
  EXPECT_GT(largest_jump<3>(Blend::piecewise, Lift::rotation), 1e-6);
}

TEST(exact_coarse_frames, the_strain_at_a_vertex_weighs_triangles_by_their_areas)
{
  // Around the origin a triangle of area 1/2 and one of area 2, each strained evenly.
  meshes::TriangleMesh mesh;
  mesh.vertices.resize(5, 2);
  mesh.vertices << 0., 0., 1., 0., 0., 1., -2., 0., 0., -2.;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 3, 4;
  mesh.material.setZero(2);
  UpsamplerOptions options;
  options.strain = Strain::linear;
  options.lift   = Lift::identity;
  const CoarseFrames<2> frames(mesh, options);
  Positions<2> current = mesh.vertices;
  current(1, 0) += 0.1; // 11 of the first
  current(3, 0) -= 0.6; // 11 of the second is 0.3
  const Eigen::Matrix<double, 1, 7> at_origin = frames.values(current).row(0);
  EXPECT_NEAR(at_origin(0), (0.5 * 0.1 + 2. * 0.3) / 2.5, 1e-15);
  EXPECT_NEAR(frames.values(current)(1, 0), 0.1, 1e-15);
  EXPECT_NEAR(frames.values(current)(3, 0), 0.3, 1e-15);
}

TEST(exact_coarse_frames, the_mean_anchor_has_mean_zero_and_the_lattice_anchor_is_zero_there)
{
  const meshes::HomogenizedCell cell = tests::skewed_cloth().cell;
  const auto mean                    = anchored(cell, Anchor::mean);
  const Eigen::VectorXd areas        = meshes::signed_areas(cell.mesh);
  Eigen::Matrix<double, 1, 6> sum    = Eigen::Matrix<double, 1, 6>::Zero();
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      sum += areas(t) / 3. * mean.row(cell.mesh.triangles(t, k));
  EXPECT_LT(sum.norm() / areas.sum(), 1e-15 * cell.chi.norm());
  EXPECT_GT(mean.row(0).norm(), 1e-5);
  EXPECT_EQ(anchored(cell, Anchor::lattice).row(cell.anchor).norm(), 0.);
}

TEST(exact_point_location, every_point_of_a_shaken_mesh_is_found_with_its_coordinates)
{
  const meshes::Lattice lattice = tests::skewed_lattice();
  meshes::TriangleMesh mesh     = tests::parallelogram(lattice, 9, 7);
  tests::shake(mesh, lattice, 2e-4);
  const meshes::PointLocation location(mesh);
  std::mt19937 generator(32);
  std::uniform_real_distribution<double> random(0.01, 0.49);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Eigen::Vector3d weights(random(generator), random(generator), 0.);
    const Eigen::Vector3d b(weights(0), weights(1), 1. - weights(0) - weights(1));
    Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      point += b(k) * mesh.vertices.row(mesh.triangles(t, k));
    const meshes::Location found = location.locate(point, Eigen::RowVector2d::Zero());
    EXPECT_EQ(found.triangle, t);
    EXPECT_LT((found.weights - b).norm(), 1e-12);
  }
  EXPECT_EQ(location.locate({1., 1.}, {0., 0.}).triangle, -1);
  EXPECT_EQ(location.locate({-1e-6, 5e-3}, {0., 0.}).triangle, -1);
  EXPECT_EQ(location.locate({std::nan(""), 0.}, {0., 0.}).triangle, -1);
}
