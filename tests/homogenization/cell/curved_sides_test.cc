// SPDX-License-Identifier: MIT
// Six-node triangles: what is read of them, what is refused, what the shipped cells draw with them;
// and polygons that stand for arcs where there are none.
#include "homogenization/bracket/bracket.h"
#include "homogenization/cell/cell_mesh_file.h"
#include "homogenization/lint/cell_lint.h"
#include "homogenization/lint/cell_reading.h"
#include "homogenization/lint/facets.h"
#include "tests/homogenization/bracket/bracket_cells.h"
#include "tests/homogenization/cell/shipped.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace homespun;
using namespace homespun::homogenization;
using tests::shipped;

namespace
{
/// The unit square in two triangles of different groups, their common side curved by `bulge` across
/// the diagonal.
struct Square
{
  Eigen::Vector2d diagonal = {0.5, 0.5}; ///< middle node
  Eigen::Vector2d other    = diagonal;   ///< the same, as the second triangle has it
  Eigen::Vector2d bottom = {0.5, 0.}, top = {0.5, 1.};
  bool is_turned = false; ///< the first triangle clockwise

  std::vector<Eigen::Vector2d> points() const
  {
    return {{0., 0.},  {1., 0.}, {1., 1.}, {0., 1.}, bottom,
            {1., 0.5}, diagonal, other,    top,      {0., 0.5}};
  }
  std::string triangles(const char *const before[2]) const
  {
    return before[0] + std::string(is_turned ? "1 3 2 7 6 5\n" : "1 2 3 5 6 7\n") + before[1] +
           "1 3 4 " + (other == diagonal ? "7" : "8") + " 9 10\n";
  }

  std::string msh2() const
  {
    std::ostringstream text;
    text.precision(17);
    text << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n";
    for (std::size_t k = 0; k < points().size(); ++k)
      text << k + 1 << " " << points()[k].transpose() << " 0\n";
    const char *const before[2] = {"1 9 2 1 1 ", "2 9 2 2 2 "};
    text << "$EndNodes\n$Elements\n2\n" << triangles(before) << "$EndElements\n";
    return text.str();
  }
  std::string msh41() const
  {
    std::ostringstream text;
    text.precision(17);
    text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 2 0\n1 0 0 0 1 1 0 1 1 0\n2 0 0 "
            "0 1 1 0 1 2 0\n"
            "$EndEntities\n$Nodes\n1 10 1 10\n2 1 0 10\n";
    for (int k = 1; k <= 10; ++k)
      text << k << "\n";
    for (const Eigen::Vector2d &x : points())
      text << x.transpose() << " 0\n";
    const char *const before[2] = {"2 1 9 1\n1 ", "2 2 9 1\n2 "};
    text << "$EndNodes\n$Elements\n2 2 1 2\n" << triangles(before) << "$EndElements\n";
    return text.str();
  }
};

CellMeshFile read(const std::string &content)
{
  const std::filesystem::path path =
    std::filesystem::temp_directory_path() /
    (std::string("homespun-") + testing::UnitTest::GetInstance()->current_test_info()->name() +
     ".msh");
  std::ofstream(path) << content;
  struct Remove
  {
    const std::filesystem::path &path;
    ~Remove()
    {
      std::filesystem::remove(path);
    }
  } remove{path};
  return read_cell_mesh(path.string());
}

void says(const Square &square, const std::vector<std::string> &parts)
{
  const std::string message = tests::refusal([&]() { read(square.msh2()); });
  for (const std::string &part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
}

/// A regular polygon of n sides about the middle of a square cell, in a fan, within rings out to
/// the outline; n a multiple of 8.
UnitCell polygon(const int n, const double radius, const double contrast)
{
  constexpr int n_rings = 5;
  UnitCell cell;
  cell.name    = "polygon";
  cell.lattice = tests::square_lattice(1.);
  cell.mesh.vertices.resize((n_rings + 1) * n + 1, 2);
  cell.mesh.triangles.resize((2 * n_rings + 1) * n, 3);
  cell.mesh.material.setZero(cell.mesh.triangles.rows());
  const int middle = (n_rings + 1) * n, quarter        = n / 4;
  const Eigen::RowVector2d centre(0.5, 0.5), corners[] = {{1., 0.}, {1., 1.}, {0., 1.}, {0., 0.}};
  cell.mesh.vertices.row(middle) = centre;
  for (int k = 0; k < n; ++k)
  {
    const double angle = 2. * M_PI * (k + 0.5) / n;
    const int side = (k + quarter / 2) / quarter, along = (k + quarter / 2) % quarter;
    const double part              = static_cast<double>(along) / quarter;
    const Eigen::RowVector2d inner = centre +
                                     radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle)),
                             outer =
                               (1. - part) * corners[side % 4] + part * corners[(side + 1) % 4];
    for (int ring = 0; ring <= n_rings; ++ring)
      cell.mesh.vertices.row(ring * n + k) = inner + ring * (outer - inner) / n_rings;
    const int next = (k + 1) % n;
    cell.mesh.triangles.row(k) << middle, k, next;
    cell.mesh.material(k) = 1;
    for (int ring = 0; ring < n_rings; ++ring)
    {
      const int first = n + 2 * (ring * n + k), low = ring * n, high = low + n;
      cell.mesh.triangles.row(first) << low + k, high + k, high + next;
      cell.mesh.triangles.row(first + 1) << low + k, high + next, low + next;
    }
  }
  cell.phases = {isotropic("ground", 1., 0.3, 1., 1.), isotropic("dot", contrast, 0.3, 1., 1.)};
  return cell;
}

} // namespace

TEST(exact_curved_sides, six_node_triangles_are_three_node_ones_and_the_curves_beside_them)
{
  Square square;
  square.diagonal = square.other = {0.6, 0.45};
  for (const bool is_turned : {false, true})
    for (const bool is_new : {false, true})
    {
      square.is_turned        = is_turned;
      const CellMeshFile file = read(is_new ? square.msh41() : square.msh2());
      ASSERT_EQ(file.mesh.n_vertices(), 4);
      ASSERT_EQ(file.mesh.n_triangles(), 2);
      EXPECT_TRUE(file.mesh.triangles.row(0) == Eigen::RowVector3i(0, 1, 2)) << file.mesh.triangles;
      EXPECT_TRUE(file.mesh.triangles.row(1) == Eigen::RowVector3i(0, 2, 3)) << file.mesh.triangles;
      ASSERT_EQ(file.curved_sides.size(), 1u);                       // straight ones are none
      EXPECT_EQ(file.curved_sides[0].a + file.curved_sides[0].b, 2); // between 0 and 2
      EXPECT_NE(file.curved_sides[0].a, 1);
      EXPECT_LT((file.curved_sides[0].sagitta - Eigen::Vector2d(0.1, -0.05)).norm(), 1e-15);
      // The segment of a parabola: two thirds of chord times height, here sqrt(2) and 0.15/sqrt(2).
      const Eigen::Vector2d areas = drawn_areas(file.mesh, file.curved_sides);
      EXPECT_LT((areas - Eigen::Vector2d(0.4, 0.6)).norm(), 1e-15) << areas.transpose();
    }
}

TEST(exact_curved_sides, middle_nodes_on_the_chord_make_straight_sides)
{
  Square square; // of a coordinate with nine digits, and one that is not in the middle
  square.diagonal = square.other = {0.5 + 3e-10, 0.5 - 3e-10};
  square.bottom                  = {0.4, 0.};
  EXPECT_TRUE(read(square.msh2()).curved_sides.empty());
  square.diagonal = square.other = {0.5 + 1e-8, 0.5 - 1e-8};
  EXPECT_EQ(read(square.msh2()).curved_sides.size(), 1u);
}

TEST(tripwire_curved_sides, middle_nodes_off_their_place_and_inverted_triangles_are_refused_by_name)
{
  Square square;
  square.bottom = {0.8, 0.};
  says(square,
       {"triangle 0", "from vertex 0 to vertex 1", "at 0.8 of the side", "between 0.25 and 0.75"});
  square     = {};
  square.top = {0.75, 1.}; // the limit itself: the map has no inverse at the corner
  says(square, {"triangle 1", "from vertex 2 to vertex 3"});
  square          = {};
  square.diagonal = square.other = {0.78, 0.22}; // beyond the middle of the way to the corner
  says(square, {"triangle 0 is inverted by its curved sides", "mesh finer there"});
  square       = {};
  square.other = {0.55, 0.45};
  says(square, {"triangles 0 and 1 curve their common side from vertex 0 to vertex 2 differently"});
  square.other = {std::nan(""), 0.45};
  says(square, {"triangle 1"});
}

TEST(exact_curved_sides, the_curves_of_an_outline_must_be_periodic)
{
  // The common side of two phases that lies on the outline of the cell.
  const tests::BracketCell cell =
    tests::bracket_cell(tests::square_lattice(1.), 2, 2, tests::contrasting(5.),
                        [](double f1, double) { return f1 < 0.5; });
  const auto vertex = [&](const double x, const double y)
  {
    for (int v = 0; v < cell.mesh.n_vertices(); ++v)
      if ((cell.mesh.vertices.row(v) - Eigen::RowVector2d(x, y)).norm() < 1e-12)
        return v;
    return -1;
  };
  const CurvedSide left{vertex(0., 0.), vertex(0., 0.5), {0.05, 0.}},
    right{vertex(1., 0.5), vertex(1., 0.), {0.05, 0.}};
  EXPECT_EQ(glued(cell.mesh, cell.lattice, {left, right}).n_arcs(), 1);
  CurvedSide off   = right;
  off.sagitta(0)   = 0.051;
  const char *said = "curved otherwise than its periodic image";
  for (const std::vector<CurvedSide> &sides :
       {std::vector<CurvedSide>{left, off}, std::vector<CurvedSide>{left},
        std::vector<CurvedSide>{right}})
    EXPECT_NE(tests::refusal([&]() { glued(cell.mesh, cell.lattice, sides); }).find(said),
              std::string::npos);
  // Inside of a phase a curve is no side of it.
  const CurvedSide inside{vertex(0., 0.), vertex(0.5, 0.5), {0.02, -0.02}};
  EXPECT_EQ(glued(cell.mesh, cell.lattice, {inside}).n_arcs(), 0);
}

TEST(exact_curved_sides, shipped_cells_draw_their_arcs)
{
  const Eigen::Vector2d middle(0.0015, 0.0005 * std::sqrt(3.)); // of a rhombus with sides of 2 mm
  const double radius   = 0.28 * 0.002;
  const UnitCell dots   = shipped("hexagonal-dots");
  const TorusMesh torus = glued(dots.mesh, dots.lattice, dots.curved_sides);
  EXPECT_GT(torus.n_arcs(), 30);
  for (const CurvedSide &side : dots.curved_sides)
  {
    const Eigen::Vector2d a = dots.mesh.vertices.row(side.a), b = dots.mesh.vertices.row(side.b);
    EXPECT_NEAR((a - middle).norm(), radius, 1e-15);
    EXPECT_NEAR((0.5 * (a + b) + side.sagitta - middle).norm(), radius, 1e-15);
  }
  // Of a circle; the polygon has more than a thousandth less.
  const double mass = 0.12 + (0.36 - 0.12) * M_PI * radius * radius / dots.lattice.area();
  EXPECT_NEAR(dots.areal_density(drawn_areas(dots.mesh, dots.curved_sides)), mass, 1e-5 * mass);
  EXPECT_LT(dots.areal_density(), (1. - 1e-3) * mass);
  for (const char *name : {"three-stiffness", "hexagonal-dots", "random-dots", "printed-patch"})
  {
    UnitCell cell = shipped(name);
    EXPECT_FALSE(cell.curved_sides.empty()) << name;
    EXPECT_TRUE(facets_of(cell).empty()) << name;
    const auto n_arcs = glued(cell.mesh, cell.lattice, cell.curved_sides).n_arcs();
    cell.curved_sides.clear();
    // Where arcs end, one of their sides has but one neighbour on the same circle.
    EXPECT_NEAR(static_cast<double>(facets_of(cell).size()), n_arcs, 0.2 * n_arcs) << name;
  }
  for (const char *name : {"layered", "plain-weave", "twill", "satin", "honeycomb", "auxetic",
                           "chevron", "checkerboard"})
  {
    EXPECT_TRUE(shipped(name).curved_sides.empty()) << name;
    EXPECT_TRUE(facets_of(shipped(name)).empty()) << name;
  }
}

TEST(exact_facets, slivers_of_a_regular_polygon_are_those_of_its_circle)
{
  for (const int n : {16, 32, 64})
  {
    const UnitCell cell = polygon(n, 0.3, 10.);
    ASSERT_TRUE(meshes::faults_of(cell.mesh, "polygon").empty());
    const std::vector<Facet> facets = facets_of(cell);
    ASSERT_EQ(static_cast<int>(facets.size()), n);
    double area = 0.;
    for (const Facet &facet : facets)
    {
      area += facet.area;
      EXPECT_NEAR(facet.turn, 2. * M_PI / n, 1e-12);
      EXPECT_EQ(cell.mesh.material(facet.inside), 1);
      EXPECT_EQ(cell.mesh.material(facet.outside), 0);
    }
    const double missing = 0.09 * M_PI - 0.5 * n * 0.09 * std::sin(2. * M_PI / n);
    EXPECT_NEAR(area / missing, 1., 3. / (n * n)); // curvature x length^3 / 12 is its first term
    const auto findings = lint_facets(cell, 0.01);
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].kind, "faceted");
    EXPECT_NE(findings[0].what.find("phase `dot` is faceted: " + std::to_string(n)),
              std::string::npos)
      << findings[0].what;
  }
  EXPECT_TRUE(facets_of(polygon(8, 0.3, 10.)).empty()); // an octagon is one
}

TEST(order_facets, the_estimate_of_the_geometry_is_the_change_to_the_arcs_to_first_order)
{
  // Against brackets of both drawings, the polygon's and that of the parabolas through the circle.
  for (const double contrast : {20., 0.05})
  {
    UnitCell cell = polygon(32, 0.3, contrast);
    AdaptiveOptions options;
    options.tolerance = 1e-3;
    const auto middle = [&]() -> Eigen::Matrix3d
    {
      const AdaptiveBracket reached =
        adaptive_bracket(glued(cell.mesh, cell.lattice, cell.curved_sides),
                         cell.stiffness_of_phase(), options, [](const Bracket &) {});
      EXPECT_EQ(reached.ending, AdaptiveEnd::tolerance);
      return 0.5 * (reached.bracket.lower + reached.bracket.upper);
    };
    const TorusMesh torus = glued(cell.mesh, cell.lattice);
    const auto estimate = geometry_estimate(cell, bracket(torus, cell.stiffness_of_phase(), 2).chi);
    ASSERT_TRUE(estimate.has_value());
    const Eigen::Matrix3d of_polygon = middle();
    for (const Facet &facet : facets_of(cell))
    {
      int ends[2], n = 0; // those of the dot's triangle that are not the middle of the fan
      for (int k = 0; k < 3; ++k)
        if (cell.mesh.triangles(facet.inside, k) < 32)
          ends[n++] = cell.mesh.triangles(facet.inside, k);
      const Eigen::Vector2d chord =
        0.5 * (cell.mesh.vertices.row(ends[0]) + cell.mesh.vertices.row(ends[1])).transpose() -
        Eigen::Vector2d(0.5, 0.5);
      cell.curved_sides.push_back({ends[0], ends[1], (0.3 / chord.norm() - 1.) * chord});
    }
    EXPECT_TRUE(facets_of(cell).empty());
    const Eigen::Matrix3d change = middle() - of_polygon;
    EXPECT_GT(change.norm(), 3e-3 * of_polygon.norm()) << contrast;
    EXPECT_LT((estimate->change - change).norm(), 0.35 * change.norm())
      << contrast << "\n"
      << estimate->change << "\n\n"
      << change;
  }
}
