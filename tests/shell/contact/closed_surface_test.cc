// SPDX-License-Identifier: MIT
#include "shell/contact/closed_surface.h"

#include "meshes/plain/errors.h"
#include "tests/shell/contact/solids.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace homespun;
using namespace homespun::shell;

namespace
{
/// How often the surface winds around a point: sum of solid angles (Van Oosterom and Strackee
/// 1983).
double winding_number(const tests::Solid &solid, const Eigen::Vector3d &p)
{
  double sum = 0.;
  for (Eigen::Index f = 0; f < solid.triangles.rows(); ++f)
  {
    Eigen::Vector3d c[3];
    for (int k = 0; k < 3; ++k)
      c[k] = solid.vertices.row(solid.triangles(f, k)).transpose() - p;
    const double l0 = c[0].norm(), l1 = c[1].norm(), l2 = c[2].norm();
    sum += 2. * std::atan2(c[0].dot(c[1].cross(c[2])), l0 * l1 * l2 + c[0].dot(c[1]) * l2 +
                                                         c[1].dot(c[2]) * l0 + c[2].dot(c[0]) * l1);
  }
  return sum / (4. * M_PI);
}

double box_distance(const Eigen::Vector3d &p, const Eigen::Vector3d &half)
{
  const Eigen::Vector3d q = p.cwiseAbs() - half;
  return q.cwiseMax(0.).norm() + std::min(q.maxCoeff(), 0.);
}

std::string fault_of(const tests::Solid &solid)
{
  try
  {
    ClosedSurface(solid.vertices, solid.triangles, "solid");
    return "";
  }
  catch (const meshes::BadInput &fault)
  {
    return fault.what();
  }
}
} // namespace

TEST(exact_closed_surface, distance_to_a_box_is_the_known_one)
{
  const Eigen::Vector3d half(0.3, 0.2, 0.1);
  const tests::Solid solid = tests::box(half);
  const ClosedSurface surface(solid.vertices, solid.triangles, "box");
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> random(-0.5, 0.5);
  for (int trial = 0; trial < 2000; ++trial)
  {
    const Eigen::Vector3d p(random(generator), random(generator), random(generator));
    const auto near = surface.nearest(p);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->distance, box_distance(p, half), 1e-15);
    EXPECT_NEAR(box_distance(p - near->distance * near->normal, half), 0., 1e-15);
  }
}

TEST(exact_closed_surface, the_sign_agrees_with_the_winding_number_on_a_torus)
{
  const tests::Solid solid = tests::torus(0.3, 0.1, 17, 9);
  const ClosedSurface surface(solid.vertices, solid.triangles, "torus");
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> random(-0.45, 0.45);
  int inside = 0;
  for (int trial = 0; trial < 4000; ++trial)
  {
    const Eigen::Vector3d p(random(generator), random(generator), 0.4 * random(generator));
    const double winding = winding_number(solid, p);
    inside += winding > 0.5;
    EXPECT_EQ(surface.nearest(p)->distance<0., winding> 0.5) << p.transpose();
  }
  EXPECT_GT(inside, 400);
}

TEST(derivative_closed_surface, the_normal_is_the_gradient_of_the_distance)
{
  const tests::Solid solid = tests::torus(0.3, 0.1, 17, 9);
  const ClosedSurface surface(solid.vertices, solid.triangles, "torus");
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> random(-0.5, 0.5);
  int smooth = 0;
  for (int trial = 0; trial < 300; ++trial)
  {
    const Eigen::Vector3d p(random(generator), random(generator), 0.5 * random(generator));
    const auto near = surface.nearest(p);
    EXPECT_NEAR(near->normal.norm(), 1., 1e-14);
    Eigen::Vector3d slope;
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d d = 1e-6 * Eigen::Vector3d::Unit(i);
      slope(i) = (surface.nearest(p + d)->distance - surface.nearest(p - d)->distance) / 2e-6;
    }
    smooth += (slope - near->normal).norm() < 1e-6; // not where two points are nearest
  }
  EXPECT_GE(smooth, 297);
}

TEST(exact_closed_surface, a_point_on_a_face_an_edge_or_a_corner_has_a_normal)
{
  const tests::Solid solid = tests::box({0.3, 0.2, 0.1});
  const ClosedSurface surface(solid.vertices, solid.triangles, "box");
  for (Eigen::Index f = 0; f < solid.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      for (const Eigen::Vector3d &weights :
           {Eigen::Vector3d(1., 0., 0.), Eigen::Vector3d(0.5, 0.5, 0.),
            Eigen::Vector3d(0.25, 0.5, 0.25)})
      {
        Eigen::Vector3d p = Eigen::Vector3d::Zero();
        for (int i = 0; i < 3; ++i)
          p += weights(i) * solid.vertices.row(solid.triangles(f, (k + i) % 3)).transpose();
        const auto near = surface.nearest(p);
        EXPECT_NEAR(near->distance, 0., 1e-15);
        EXPECT_NEAR(near->normal.norm(), 1., 1e-14);
        EXPECT_GT(near->normal.dot(p), 0.);
        EXPECT_GT(surface.nearest(p + 1e-3 * near->normal)->distance, 5e-4);
        // On an edge the normal may be that of one face: then this point lies on the other one.
        EXPECT_LT(surface.nearest(p - 1e-3 * near->normal)->distance, 1e-15);
      }
}

TEST(invariant_closed_surface, nothing_is_found_beyond_the_distance_asked_for)
{
  const tests::Solid solid = tests::box({0.3, 0.2, 0.1});
  const ClosedSurface surface(solid.vertices, solid.triangles, "box");
  EXPECT_FALSE(surface.nearest({0., 0., 0.2}, 0.0999));
  EXPECT_TRUE(surface.nearest({0., 0., 0.2}, 0.1001));
}

TEST(exact_closed_surface, a_segment_enters_where_it_first_meets_a_face_from_outside)
{
  const tests::Solid solid = tests::box({0.3, 0.2, 0.001}); // a thin plate
  const ClosedSurface surface(solid.vertices, solid.triangles, "plate");
  // Through edges, corners of triangles and the diagonals of faces, as well as elsewhere.
  for (const double x1 : {-0.3, -0.15, 0., 0.1, 0.3})
    for (const double x2 : {-0.2, -0.1, 0., 0.07, 0.2})
    {
      const auto entry = surface.first_entry({x1, x2, 0.2}, {x1, x2, -0.2});
      ASSERT_TRUE(entry) << x1 << ' ' << x2;
      EXPECT_NEAR(entry->part, 0.199 / 0.4, 1e-14);
      EXPECT_NEAR(entry->normal(2), 1., 1e-15);
    }
  EXPECT_FALSE(surface.first_entry({0., 0., 0.2}, {0., 0., 0.1}));
  EXPECT_FALSE(surface.first_entry({0., 0., 0.}, {0., 0., 0.1})); // leaves
  EXPECT_FALSE(surface.first_entry({0.4, 0., 0.2}, {0.4, 0., -0.2}));
  EXPECT_FALSE(
    surface.first_entry({-1., 0., 0.001}, {1., 0., 0.001 + 1e-6})); // leaves the plane of the face
  EXPECT_FALSE(surface.first_entry({0., 0., 0.2}, {0., 0., 0.2}));
}

TEST(tripwire_closed_surface, faults_are_named)
{
  const tests::Solid good = tests::box({0.3, 0.2, 0.1});
  EXPECT_EQ(fault_of(good), "");
  tests::Solid solid = good;
  solid.triangles.conservativeResize(11, 3);
  EXPECT_NE(fault_of(solid).find("fill the hole"), std::string::npos);
  solid = good;
  for (Eigen::Index f = 0; f < 12; ++f)
    solid.triangles.row(f).reverseInPlace();
  EXPECT_NE(fault_of(solid).find("normals point inwards"), std::string::npos);
  solid = good;
  solid.triangles.row(3).reverseInPlace();
  EXPECT_NE(fault_of(solid).find("traversed the same way"), std::string::npos);
  solid                = good;
  solid.vertices(2, 1) = std::nan("");
  EXPECT_NE(fault_of(solid).find("vertex 2 has a coordinate"), std::string::npos);
  solid                 = good;
  solid.triangles(4, 0) = 8;
  EXPECT_NE(fault_of(solid).find("triangle 4 has a vertex out of range"), std::string::npos);
}
