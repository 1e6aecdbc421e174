// SPDX-License-Identifier: MIT
#include "meshes/cloth/cloth_faults.h"
#include "meshes/cloth/seams.h"
#include "meshes/files/obj_file.h"
#include "meshes/plain/sheet.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

namespace
{
/// A square with a wedge cut out from its middle to its right side, closed in space; the upper side
/// of the wedge may have a vertex more than the lower one.
/// @param further where, as a part of that side; 0: nowhere
ClothMesh square_with_a_dart(const double further)
{
  ClothMesh cloth;
  const int m = further > 0. ? 8 : 7; // triangles, and vertices in space
  // The middle, the lower side of the wedge, the corners, the upper side, the vertex more.
  cloth.rest.vertices.resize(m + 2, 2);
  cloth.rest.vertices.topRows(9) << 0., 0., 0.5, -0.1, 1., -0.2, 1., -1., -1., -1., -1., 1., 1., 1.,
    0.5, 0.1, 1., 0.2;
  const std::vector<int> space = {0, 1, 2, 3, 4, 5, 6, 1, 2, 7};
  cloth.rest.triangles.resize(m, 3);
  cloth.rest.triangles.topRows(7) << 0, 3, 1, 1, 3, 2, 0, 4, 3, 0, 5, 4, 0, 6, 5, 0, 7, 6, 7, 8, 6;
  if (further > 0.)
  {
    cloth.rest.vertices.row(9) << further, 0.2 * further;
    const int split = further < 0.5 ? 5 : 6; // the triangle of that edge
    cloth.rest.triangles.row(7) << 9, cloth.rest.triangles(split, 1), 6;
    cloth.rest.triangles(split, 1) = 9;
  }
  cloth.rest.material.setZero(m);
  cloth.positions.setZero(m, 3);
  cloth.triangles =
    cloth.rest.triangles.unaryExpr([&](const int v) { return space[static_cast<std::size_t>(v)]; });
  for (int v = 0; v < cloth.rest.n_vertices(); ++v)
    cloth.positions.row(space[static_cast<std::size_t>(v)]).head<2>() << cloth.rest.vertices(v, 0),
      std::abs(cloth.rest.vertices(v, 1)) < 0.5 ? 0. : cloth.rest.vertices(v, 1);
  return cloth;
}
} // namespace

TEST(tripwire_cloth_faults, a_t_junction_in_the_seam_of_a_dart_is_named)
{
  EXPECT_EQ(cloth_faults(square_with_a_dart(0.), "dart"), std::vector<std::string>());
  for (const double further : {0.25, 0.75}) // next to the tip, next to the hem
  {
    const auto faults = cloth_faults(square_with_a_dart(further), "dart");
    ASSERT_EQ(faults.size(), 1u) << further;
    EXPECT_NE(faults[0].find("vertex 7 at ("), std::string::npos) << faults[0];
    EXPECT_NE(faults[0].find("a T-junction in a seam"), std::string::npos) << faults[0];
  }
}

TEST(invariant_cloth_faults, a_tube_of_one_panel_may_lie_flat)
{
  // Folded along its seam; the hems of both halves are not meshed alike.
  ClothMesh cloth;
  cloth.rest = coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), 4, 1);
  cloth.positions.setZero(8, 3);
  cloth.triangles =
    cloth.rest.triangles.unaryExpr([](const int v) { return v / 5 * 4 + v % 5 % 4; });
  const std::vector<double> columns = {0., 0.3, 1., 1.6, 2.};
  for (int v = 0; v < 10; ++v)
  {
    const double x = columns[static_cast<std::size_t>(v % 5)];
    cloth.rest.vertices.row(v) << x, v / 5;
    cloth.positions.row(v / 5 * 4 + v % 5 % 4) << std::min(x, 2. - x), v / 5, 0.;
  }
  EXPECT_EQ(cloth_faults(cloth, "tube"), std::vector<std::string>());
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
