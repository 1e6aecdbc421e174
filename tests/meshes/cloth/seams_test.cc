// SPDX-License-Identifier: MIT
#include "meshes/cloth/seams.h"
#include "meshes/files/obj_file.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::meshes;

TEST(exact_seams, a_dart_is_sewn_up_to_its_tip)
{
  // A panel with a wedge cut out at the origin; in space both sides of the wedge are one edge, of
  // which the end at the tip is one vertex at rest, too.
  ClothMesh cloth;
  cloth.rest.vertices.resize(5, 2);
  cloth.rest.vertices << 0., 0., 1., 0., 0., 1., -1., 0., 0.6, -0.8;
  cloth.rest.triangles.resize(3, 3);
  cloth.rest.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4;
  cloth.rest.material.setZero(3);
  cloth.positions.resize(4, 3);
  cloth.positions << 0., 0., 0.3, 0.9, 0., 0., 0., 0.9, 0., -0.9, 0., 0.;
  cloth.triangles.resize(3, 3);
  cloth.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 1;
  const auto seams = seam_edges(cloth);
  ASSERT_EQ(seams.size(), 1u);
  EXPECT_EQ(space_ends(cloth, seams[0].sides[0]), (std::array<int, 2>{0, 1}));
  EXPECT_EQ(rest_ends(cloth, seams[0].sides[1]), (std::array<int, 2>{4, 0}));
}

TEST(exact_scenes, the_skirt_begins_without_strain_and_the_ball_is_closed)
{
  const std::string folder = HOMESPUN_SOURCE_DIR "/meshes/scenes/";
  const ClothMesh skirt    = read_cloth(folder + "skirt.obj");
  EXPECT_EQ(skirt.n_triangles(), 800);
  EXPECT_EQ(panels_of(skirt).count, 4);
  EXPECT_EQ(seam_edges(skirt).size(), 40u); // four seams of ten edges, the closing one included
  for (int t = 0; t < skirt.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const auto rest = rest_ends(skirt, {t, k}), space = space_ends(skirt, {t, k});
      const double at_rest =
        (skirt.rest.vertices.row(rest[0]) - skirt.rest.vertices.row(rest[1])).norm();
      EXPECT_NEAR((skirt.positions.row(space[0]) - skirt.positions.row(space[1])).norm(), at_rest,
                  1e-9 * at_rest);
    }
  // A frustum's mantle, pi (r1 + r2) length, to the coarseness of its polyhedron.
  const double mantle = 3.14159265358979 * (0.06 + 0.12) * 0.14;
  EXPECT_NEAR(signed_areas(skirt.rest).sum(), mantle, 1e-3 * mantle);

  const Surface ball = read_surface(folder + "ball.obj");
  EXPECT_EQ(ball.triangles.rows(), 1280);
  EXPECT_EQ(ball.positions.rows(), 642); // Euler: V = 2 + F / 2
  EXPECT_NEAR(ball.positions.rowwise().norm().maxCoeff(), 0.05, 1e-12);
  EXPECT_NEAR(ball.positions.rowwise().norm().minCoeff(), 0.05, 1e-12);
}
