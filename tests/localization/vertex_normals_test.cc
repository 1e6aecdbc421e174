// SPDX-License-Identifier: MIT
#include "localization/options.h"
#include "localization/vertex_normals.h"
#include "meshes/files/obj_file.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::localization;
using Space = Positions<3>;

TEST(exact_vertex_normals, triangles_count_by_their_area_and_symmetry_makes_normals_radial)
{
  // In the planes z = 0 and y = 0, with the areas 1/2 and 1.
  const Space corners = (Space(4, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2).finished();
  const Space two     = vertex_normals<double>(corners, meshes::Triangles{{0, 1, 2}, {0, 3, 1}});
  EXPECT_LT((two.row(0) - Eigen::RowVector3d(0., 2., 1.) / std::sqrt(5.)).norm(), 1e-15);
  EXPECT_EQ(two.row(2), Eigen::RowVector3d(0., 0., 1.));
  EXPECT_EQ(two.row(3), Eigen::RowVector3d(0., 1., 0.));
  const Space flat = vertex_normals<double>(Space::Zero(3, 3), meshes::Triangles{{0, 1, 2}});
  EXPECT_EQ(flat.norm(), 0.);

  const meshes::Surface ball = meshes::read_surface(HOMESPUN_SOURCE_DIR "/meshes/scenes/ball.obj");
  const Space normals        = vertex_normals<double>(ball.positions, ball.triangles);
  for (int v = 0; v < 12; ++v) // corners of the icosahedron, with five triangles alike
    EXPECT_LT((normals.row(v) - ball.positions.row(v).normalized()).norm(), 1e-9);
  // In float the squares of small areas underflow; the direction must not.
  const auto tiny =
    vertex_normals<float>((1e-15 * ball.positions).cast<float>().eval(), ball.triangles);
  EXPECT_LT((tiny.cast<double>() - normals).cwiseAbs().maxCoeff(), 1e-5);
}
