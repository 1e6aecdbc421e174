// SPDX-License-Identifier: MIT
// Brackets of drawings: phases whose sides are parabolas. The drawing is held against what it is
// the limit of, uniformly refined meshes on the parabolas, whose own brackets hold their own
// polygons.
#include "homogenization/bracket/drawn_mesh.h"
#include "homogenization/bracket/loewner.h"
#include "tests/homogenization/bracket/bracket_cells.h"
#include "tests/homogenization/cell/unfolded.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
/// A cell whose phases are bounded by curves, with the middle nodes of their sides.
struct DrawnCell
{
  tests::BracketCell cell;
  std::vector<CurvedSide> sides;

  TorusMesh mesh() const
  {
    return glued(cell.mesh, cell.lattice, sides);
  }
};

/// n x n squares, cut so that the sides of an octagon of half the cell's width fit, moved onto a
/// disc: the sides of the octagon have their middle nodes on the circle.
DrawnCell disc(const int n, const double radius, const std::vector<Eigen::Matrix3d> &stiffness)
{
  DrawnCell drawing{tests::bracket_cell(tests::square_lattice(1.), n, n, stiffness,
                                        [](double, double) { return 0; }),
                    {}};
  meshes::TriangleMesh &mesh = drawing.cell.mesh;
  const auto is_on           = [](const Eigen::RowVector2d &x)
  { return std::abs((x.array() - 0.5).abs().maxCoeff() - 0.25) < 1e-9; };
  std::vector<char> on_circle;
  for (int v = 0; v < mesh.n_vertices(); ++v)
    on_circle.push_back(is_on(mesh.vertices.row(v)));
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Eigen::RowVector2d centre = Eigen::RowVector2d::Zero();
    for (int k = 0; k < 3; ++k)
      centre += mesh.vertices.row(mesh.triangles(t, k)) / 3.;
    mesh.material(t) = (centre.array() - 0.5).abs().maxCoeff() < 0.25;
  }
  const Eigen::RowVector2d middle(0.5, 0.5);
  const auto onto_circle = [&](const Eigen::RowVector2d &x) -> Eigen::RowVector2d
  { return middle + radius * (x - middle).normalized(); };
  // Squares about the middle become circles, that of the interface one of the radius, and the
  // outline stays.
  for (int v = 0; v < mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d x = mesh.vertices.row(v) - middle;
    const double size          = x.cwiseAbs().maxCoeff();
    if (size == 0.)
      continue;
    const Eigen::RowVector2d round = x.normalized() * radius * size / 0.25, straight = x;
    const double part    = size <= 0.25 ? 0. : (size - 0.25) / 0.25;
    mesh.vertices.row(v) = middle + (1. - part) * round + part * straight;
    if (on_circle[static_cast<std::size_t>(v)])
      mesh.vertices.row(v) = onto_circle(mesh.vertices.row(v));
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, k), b = mesh.triangles(t, (k + 1) % 3);
      if (mesh.material(t) == 1 && on_circle[static_cast<std::size_t>(a)] &&
          on_circle[static_cast<std::size_t>(b)])
      {
        const Eigen::RowVector2d chord = 0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b));
        drawing.sides.push_back({a, b, (onto_circle(chord) - chord).transpose()});
      }
    }
  return drawing;
}

/// The area of a material of a mesh.
double area_of(const TorusMesh &mesh, const int material)
{
  double area = 0.;
  for (const TorusTriangle &triangle : mesh.triangles)
  {
    const auto shape = triangle.shape(mesh.edges);
    if (triangle.material == material)
      area += 0.5 * (shape[1](0) * shape[2](1) - shape[1](1) * shape[2](0));
  }
  return area;
}

/// That of a material of the drawing: between chord and parabola lie 2/3 of length times bulge.
double drawn_area(const TorusMesh &mesh, const int material)
{
  double area = area_of(mesh, material);
  for (const TorusTriangle &triangle : mesh.triangles)
    for (std::size_t k = 0; triangle.material == material && k < 3; ++k)
    {
      const TorusEdge &edge = mesh.edges[static_cast<std::size_t>(triangle.edges[k])];
      area -= 2. / 3. * triangle.signs[k] *
              (edge.vector(0) * edge.bulge(1) - edge.vector(1) * edge.bulge(0));
    }
  return area;
}

TorusMesh halved(TorusMesh mesh, const int times)
{
  for (int k = 0; k < times; ++k)
    mesh = bisected(mesh, std::vector<char>(mesh.triangles.size(), 1));
  return mesh;
}

/// By how much lower <= upper fails for the worst strain, relative to upper; negative where there
/// is room.
double excess(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper)
{
  using Exact = Eigen::Matrix<long double, 3, 3>;
  const Eigen::LLT<Exact> factors(upper.cast<long double>());
  const Exact half =
    factors.matrixL().solve(Exact(lower.cast<long double>() - upper.cast<long double>()));
  const Exact both = factors.matrixL().solve(Exact(half.transpose()));
  return static_cast<double>(Eigen::SelfAdjointEigenSolver<Exact>(both).eigenvalues()(2));
}

Eigen::Matrix3d random_stiffness(std::mt19937 &generator)
{
  std::normal_distribution<double> normal;
  Eigen::Matrix3d root;
  for (int k = 0; k < 9; ++k)
    root(k) = normal(generator);
  const Eigen::Matrix3d C = std::exp(3. * normal(generator)) * root * root.transpose();
  return 0.5 * (C + C.transpose());
}

TorusMesh as_mesh(TorusMesh mesh)
{
  for (TorusEdge &edge : mesh.edges)
    edge.bulge.setZero();
  return mesh;
}
} // namespace

TEST(bound_drawn_mesh, stiffnesses_above_and_below_both_need_no_order_of_the_phases)
{
  std::mt19937 generator(4);
  for (int k = 0; k < 200; ++k)
  {
    const Eigen::Matrix3d A = random_stiffness(generator), B = random_stiffness(generator);
    const Eigen::Matrix3d above = above_both(A, B), below = below_both(A, B);
    EXPECT_LE(excess(A, above), 0.);
    EXPECT_LE(excess(B, above), 0.);
    EXPECT_LE(excess(below, A), 0.);
    EXPECT_LE(excess(below, B), 0.);
  }
  // Tight: where the phases are ordered they are the bounds themselves.
  const auto ordered = tests::contrasting(1e4);
  EXPECT_LT(excess(above_both(ordered[0], ordered[1]), ordered[1]), 1e-12);
  EXPECT_LT(excess(above_both(ordered[1], ordered[0]), ordered[1]), 1e-12);
  EXPECT_LT(excess(ordered[0], below_both(ordered[0], ordered[1])), 1e-12);
  EXPECT_LT(excess(ordered[0], below_both(ordered[1], ordered[0])), 1e-12);
}

TEST(exact_drawn_mesh, refined_vertices_lie_on_the_parabolas_of_the_drawing)
{
  const DrawnCell drawing = disc(8, 0.3, tests::contrasting(10.));
  const TorusMesh coarse = drawing.mesh(), fine = halved(coarse, 3);
  ASSERT_EQ(coarse.n_arcs(), 16);
  EXPECT_EQ(fine.n_arcs(), 16 * 8);
  EXPECT_EQ(fine.n_vertices - fine.n_edges() + fine.n_triangles(),
            0); // Euler's formula for the torus
  // The parabolas stay where they are: the same area beneath them, which chords only come near to.
  EXPECT_NEAR(drawn_area(fine, 1), drawn_area(coarse, 1), 1e-13);
  EXPECT_NEAR(drawn_area(coarse, 1) - area_of(coarse, 1),
              64. * (drawn_area(fine, 1) - area_of(fine, 1)), 1e-12);
  EXPECT_NEAR(area_of(fine, 0) + area_of(fine, 1), 1., 1e-14);
  // Every vertex of the interface on one of them, at a whole eighth of its parameter.
  const meshes::TriangleMesh plane = tests::unfolded(fine), given = drawing.cell.mesh;
  int n_on = 0;
  for (int v = 0; v < plane.n_vertices(); ++v)
  {
    bool is_on = false;
    for (const CurvedSide &side : drawing.sides)
      for (int eighth = 0; eighth < 8; ++eighth)
      {
        const double t             = eighth / 8.;
        const Eigen::RowVector2d x = (1. - t) * given.vertices.row(side.a) +
                                     t * given.vertices.row(side.b) +
                                     4. * t * (1. - t) * side.sagitta.transpose();
        is_on = is_on || (plane.vertices.row(v) - x).norm() < 1e-15;
      }
    n_on += is_on;
  }
  EXPECT_EQ(n_on, 16 * 8);
}

TEST(exact_drawn_mesh, what_is_uncertain_holds_the_slivers_and_nothing_is_lost)
{
  for (const int times : {0, 1, 3})
  {
    const DrawnCell drawing = disc(8, 0.3, tests::contrasting(10.));
    const TorusMesh mesh    = halved(drawing.mesh(), times);
    const DrawnMesh both    = drawn(mesh, drawing.cell.stiffness);
    ASSERT_EQ(both.lower.size(), 3u);
    EXPECT_FALSE(both.mesh.is_drawn());
    EXPECT_EQ(both.mesh.n_vertices - both.mesh.n_edges() + both.mesh.n_triangles(), 0);
    EXPECT_NEAR(area_of(both.mesh, 0) + area_of(both.mesh, 1) + area_of(both.mesh, 2), 1., 1e-14);
    // Inscribed below the drawing, circumscribed above it; the sliver takes 2/3 of what is
    // uncertain.
    const double sure = area_of(both.mesh, 1), unsure = area_of(both.mesh, 2);
    EXPECT_LT(sure, drawn_area(mesh, 1));
    EXPECT_NEAR(sure + 2. / 3. * unsure, drawn_area(mesh, 1), 1e-13);
    for (const TorusTriangle &triangle : both.mesh.triangles)
    {
      const auto shape = triangle.shape(both.mesh.edges);
      EXPECT_GT(shape[1](0) * shape[2](1) - shape[1](1) * shape[2](0), 0.);
    }
  }
}

TEST(bound_drawn_mesh, brackets_of_a_drawing_nest_and_hold_those_of_finer_polygons_on_its_curves)
{
  // Stiff in soft, soft in stiff, and phases of which neither is the stiffer one.
  const std::vector<std::vector<Eigen::Matrix3d>> pairs = {
    tests::contrasting(50.),
    {tests::isotropic_stiffness(50., 0.3), tests::isotropic_stiffness(1., 0.3)},
    {plane_stress_stiffness({"a", 10., 1., 0.3, 0.4, 20., 1., 1.}),
     plane_stress_stiffness({"b", 2., 7., 0.1, 2., 0., 1., 1.})}};
  for (const auto &stiffness : pairs)
  {
    const DrawnCell drawing = disc(8, 0.3, stiffness);
    const TorusMesh finest  = as_mesh(halved(drawing.mesh(), 3));
    const Bracket polygon   = bracket(finest, stiffness, 2);
    EXPECT_FALSE(polygon.is_of_drawing);
    double before = 1.;
    for (const int times : {0, 1, 2})
      for (const unsigned order : {1u, 2u})
      {
        const TorusMesh mesh = halved(drawing.mesh(), times);
        const Bracket b      = bracket(mesh, stiffness, order);
        EXPECT_TRUE(b.is_of_drawing);
        // Each other's C^H lies between the sides of both.
        EXPECT_LE(excess(b.lower, polygon.upper), 0.) << times;
        EXPECT_LE(excess(polygon.lower, b.upper), 0.) << times;
        EXPECT_GE(b.gaps.minCoeff(), 0.);
        const double gap = (b.stiffness.inverse() * (b.stiffness - b.compliance.inverse())).trace();
        EXPECT_NEAR(b.gaps.sum(), gap, 1e-10 * gap);
        if (order == 2)
        {
          EXPECT_LT(b.width, 0.6 * before) << times;
          before = b.width;
        }
      }
  }
}

TEST(bound_drawn_mesh,
     empty_holes_are_circumscribed_below_and_inscribed_above_rigid_ones_vice_versa)
{
  // A round hole, whose sides bulge into the phase, and one whose sides bulge into the hole.
  for (const double bulge : {1., -1.})
  {
    DrawnCell drawing = disc(8, 0.3, tests::contrasting(10.));
    for (CurvedSide &side : drawing.sides)
      side.sagitta *= bulge;
    meshes::TriangleMesh &mesh = drawing.cell.mesh;
    int n_kept                 = 0;
    for (int t = 0; t < mesh.n_triangles(); ++t)
      if (mesh.material(t) == 0)
        mesh.triangles.row(n_kept++) = mesh.triangles.row(t);
    mesh.triangles.conservativeResize(n_kept, 3);
    mesh.material.setZero(n_kept);
    // Vertices in the hole go, and sides inside of it.
    std::vector<int> number(static_cast<std::size_t>(mesh.n_vertices()), -1);
    for (int k = 0; k < 3 * n_kept; ++k)
      number[static_cast<std::size_t>(mesh.triangles(k / 3, k % 3))] = 0;
    int n = 0;
    for (int v = 0; v < mesh.n_vertices(); ++v)
      if (number[static_cast<std::size_t>(v)] == 0)
      {
        mesh.vertices.row(n)                = mesh.vertices.row(v).eval();
        number[static_cast<std::size_t>(v)] = n++;
      }
    mesh.vertices.conservativeResize(n, 2);
    for (int k = 0; k < 3 * n_kept; ++k)
    {
      int &v = mesh.triangles(k / 3, k % 3);
      v      = number[static_cast<std::size_t>(v)];
    }
    std::set<std::array<int, 2>> rim;
    for (const auto &edge : meshes::boundary_edges(mesh))
      rim.insert({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    std::vector<CurvedSide> sides;
    for (const CurvedSide &side : drawing.sides)
    {
      const int a = number[static_cast<std::size_t>(side.a)],
                b = number[static_cast<std::size_t>(side.b)];
      if (rim.count({std::min(a, b), std::max(a, b)}) > 0)
        sides.push_back({a, b, side.sagitta});
    }
    drawing.sides = sides;
    ASSERT_EQ(drawing.mesh().n_arcs(), 16);
    for (const Holes holes : {Holes::empty, Holes::rigid})
    {
      const Bracket polygon =
        bracket(as_mesh(halved(drawing.mesh(), 3)), drawing.cell.stiffness, 2, holes);
      double before = 1.;
      for (const int times : {0, 1, 2})
      {
        const Bracket b = bracket(halved(drawing.mesh(), times), drawing.cell.stiffness, 2, holes);
        EXPECT_TRUE(b.is_of_drawing);
        EXPECT_LE(excess(b.lower, polygon.upper), 0.) << times;
        EXPECT_LE(excess(polygon.lower, b.upper), 0.) << times;
        EXPECT_GE(b.gaps.minCoeff(), 0.);
        const double gap = (b.stiffness.inverse() * (b.stiffness - b.compliance.inverse())).trace();
        EXPECT_NEAR(b.gaps.sum(), gap, 1e-10 * gap);
        EXPECT_LT(b.width, 0.6 * before) << times;
        before = b.width;
      }
    }
  }
}
