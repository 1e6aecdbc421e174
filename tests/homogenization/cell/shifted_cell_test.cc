// SPDX-License-Identifier: MIT
// Cells whose outline cuts holes, cut from the cloth anew: it stays the same cloth.
#include "homogenization/bracket/loewner.h"
#include "homogenization/cell/shifted_cell.h"
#include "homogenization/lint/cell_frame.h"
#include "meshes/plain/drawn_lattice.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"
#include "tests/homogenization/bracket/bracket_cells.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
constexpr int n = 16; // squares along either side

/// A cloth of squares; one cell of it, cut out from square (first1, first2) on.
struct Cloth
{
  meshes::Lattice lattice = tests::skewed_lattice();
  /// By the numbers of a square, 0 to n - 1.
  std::function<bool(int i, int j)> is_void    = [](int, int) { return false; };
  std::function<int(int i, int j)> material_at = [](int, int) { return 0; };
  double wobble = 0.; ///< of the vertices, in squares; none on the lines that pass through (0, 0)

  meshes::TriangleMesh cell(const int first1, const int first2) const
  {
    meshes::TriangleMesh mesh;
    std::map<std::array<int, 2>, int> vertex_at;
    std::vector<Eigen::RowVector2d> points;
    std::vector<Eigen::RowVector3i> triangles;
    std::vector<int> materials;
    const auto vertex = [&](const int i, const int j)
    {
      const auto [place, is_new] =
        vertex_at.emplace(std::array<int, 2>{i, j}, static_cast<int>(points.size()));
      if (is_new)
      {
        // Random, but the same in all periods, and none on two lines.
        const int i0 = (i + n) % n, j0 = (j + n) % n;
        std::minstd_rand generator(static_cast<unsigned>(1 + i0 + n * j0));
        generator.discard(10);
        std::uniform_real_distribution<double> random(-wobble, wobble);
        const double less = i0 == 0 || j0 == 0 ? 0. : 1.;
        const Eigen::RowVector2d f(i + less * random(generator), j + less * random(generator));
        points.push_back(f / n * lattice.vectors);
      }
      return place->second;
    };
    for (int j = first2; j < first2 + n; ++j)
      for (int i = first1; i < first1 + n; ++i)
      {
        const int i0 = (i + n) % n, j0 = (j + n) % n;
        if (is_void(i0, j0))
          continue;
        const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                  d = vertex(i, j + 1);
        triangles.emplace_back(a, b, c);
        triangles.emplace_back(a, c, d);
        materials.insert(materials.end(), 2, material_at(i0, j0));
      }
    mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
    for (std::size_t p = 0; p < points.size(); ++p)
      mesh.vertices.row(static_cast<Eigen::Index>(p)) = points[p];
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    mesh.material.resize(static_cast<Eigen::Index>(triangles.size()));
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      mesh.triangles.row(static_cast<Eigen::Index>(t)) = triangles[t];
      mesh.material(static_cast<Eigen::Index>(t))      = materials[t];
    }
    return mesh;
  }
};

/// Squares between these numbers, around the end of the period where the first is larger.
std::function<bool(int, int)> hole(const int i0, const int i1, const int j0, const int j1)
{
  const auto within = [](const int k, const int first, const int last)
  { return first <= last ? k >= first && k <= last : k >= first || k <= last; };
  return [=](const int i, const int j) { return within(i, i0, i1) && within(j, j0, j1); };
}

/// A hole across the corner of the cell, and a stiff stripe that the new sides cross.
Cloth perforated(const double wobble)
{
  Cloth cloth;
  cloth.is_void     = hole(13, 2, 14, 1);
  cloth.material_at = [](const int i, const int j) { return i + j >= 9 && i + j < 14 ? 1 : 0; };
  cloth.wobble      = wobble;
  return cloth;
}

/// Nothing where no holes are cut, or where that is not all.
std::optional<CellCutAnew> anew(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                                const std::vector<CurvedSide> &curved_sides = {})
{
  const MatchedCell matched = match_sides(mesh, curved_sides, lattice, {}, "mesh");
  if (!matched.faults.empty() || !matched.cuts_holes)
    return std::nullopt;
  EXPECT_EQ(matched.largest_move, 0.);
  return cut_anew(matched.mesh, mesh.material, curved_sides, matched.lattice);
}

Eigen::VectorXd areas_of_materials(const meshes::TriangleMesh &mesh)
{
  Eigen::VectorXd areas     = Eigen::VectorXd::Zero(mesh.material.maxCoeff() + 1);
  const Eigen::VectorXd its = meshes::signed_areas(mesh);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    areas(mesh.material(t)) += its(t);
  return areas;
}

/// Whether opposite sides match vertex by vertex to round-off, and nothing else is wrong.
void expect_sound(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice)
{
  EXPECT_TRUE(meshes::faults_of(mesh, "mesh").empty()) << meshes::faults_of(mesh, "mesh")[0];
  for (const std::string &fault : meshes::periodicity_faults(mesh, lattice, "mesh", 1e-13))
    ADD_FAILURE() << fault;
  const meshes::Lattice outline =
    meshes::frames_of(mesh, 1e-9 * std::sqrt(lattice.area())).at(0).lattice;
  for (int k = 0; k < 2; ++k) // in any order, in either direction
  {
    const Eigen::RowVector2d f = lattice.fractional(outline.vectors.row(k)).cwiseAbs();
    EXPECT_NEAR(f.minCoeff(), 0., 1e-12);
    EXPECT_NEAR(f.maxCoeff(), 1., 1e-12);
  }
}

/// The material to the left of each edge.
std::map<std::array<int, 2>, int> materials_along(const meshes::TriangleMesh &mesh)
{
  std::map<std::array<int, 2>, int> material_at;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      material_at[{mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)}] = mesh.material(t);
  return material_at;
}

/// Arcs between soft and stiff, as six-node triangles have them: out of the stiff phase, away from
/// the outlines of cell(0, 0) and cell(6, 6), so that both have the same.
std::vector<CurvedSide> arcs_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice)
{
  const auto material_at = materials_along(mesh);
  std::vector<CurvedSide> arcs;
  for (const auto &[edge, material] : material_at)
  {
    const auto other = material_at.find({edge[1], edge[0]});
    if (edge[0] > edge[1] || other == material_at.end() || other->second == material)
      continue;
    const Eigen::RowVector2d a = mesh.vertices.row(edge[0]), b = mesh.vertices.row(edge[1]);
    Eigen::RowVector2d squares = n * lattice.fractional(0.5 * (a + b));
    for (const double line : {0., 6.})
    {
      const Eigen::RowVector2d off     = squares.array() - line;
      const Eigen::RowVector2d periods = (off / n).array().round();
      if ((off - n * periods).cwiseAbs().minCoeff() < 0.8)
        squares(0) = std::nan("");
    }
    if (!squares.allFinite())
      continue;
    const double out = material == 1 ? -0.05 : 0.05;
    arcs.push_back({edge[0], edge[1], out * Eigen::Vector2d(a(1) - b(1), b(0) - a(0))});
  }
  return arcs;
}

Bracket bracket_of(const meshes::TriangleMesh &mesh, const meshes::Lattice &lattice,
                   const std::vector<CurvedSide> &curved_sides = {})
{
  return bracket(glued(mesh, lattice, curved_sides), tests::contrasting(20.), 2);
}

/// Both brackets are of one stiffness: neither lower side lies above the other's upper one.
void expect_one_stiffness(const Bracket &one, const Bracket &other)
{
  const double round_off = std::max(one.round_off, other.round_off);
  EXPECT_NO_THROW(relative_width(one.lower, other.upper, round_off));
  EXPECT_NO_THROW(relative_width(other.lower, one.upper, round_off));
}
} // namespace

TEST(exact_shifted_cell, along_lines_of_its_mesh_it_is_the_cell_drawn_there)
{
  const Cloth cloth = perforated(0.);
  const auto cut    = anew(cloth.cell(0, 0), cloth.lattice);
  ASSERT_TRUE(cut && cut->shift);
  const meshes::TriangleMesh inside = cloth.cell(6, 6);
  expect_sound(cut->mesh, cloth.lattice);
  EXPECT_EQ(cut->mesh.n_triangles(), inside.n_triangles()) << "a line of the mesh splits nothing";
  EXPECT_EQ(cut->mesh.n_vertices(), inside.n_vertices());
  EXPECT_EQ(meshes::boundary_loops(cut->mesh).size(), 2u) << "the outline and one hole";
  EXPECT_TRUE(areas_of_materials(cut->mesh).isApprox(areas_of_materials(inside), 1e-13));
  const Bracket mine = bracket_of(cut->mesh, cloth.lattice),
                its  = bracket_of(inside, cloth.lattice);
  EXPECT_LT((mine.stiffness - its.stiffness).norm(), 1e-9 * its.stiffness.norm());
  EXPECT_LT((mine.compliance - its.compliance).norm(), 1e-9 * its.compliance.norm());
  // Where it says that it is.
  const Eigen::RowVector2d sixteenths = n * cut->shift->parts;
  EXPECT_LT((sixteenths - sixteenths.array().round().matrix()).norm(), 1e-9);
  EXPECT_LT((cut->shift->metres - cut->shift->parts * cloth.lattice.vectors).norm(), 1e-15);
  Eigen::RowVector2d low = cloth.lattice.fractional(cut->mesh.vertices.row(0));
  for (int v = 0; v < cut->mesh.n_vertices(); ++v)
    low = low.cwiseMin(cloth.lattice.fractional(cut->mesh.vertices.row(v)));
  Eigen::RowVector2d off = low - cut->shift->parts;
  off -= off.array().round().matrix();
  EXPECT_LT(off.norm(), 1e-12);
}

TEST(bound_shifted_cell, across_triangles_it_is_the_same_cloth)
{
  const Cloth cloth                = perforated(0.25);
  const meshes::TriangleMesh drawn = cloth.cell(0, 0);
  ASSERT_GT(tests::smallest_angle(drawn), 10.);
  const auto cut = anew(drawn, cloth.lattice);
  ASSERT_TRUE(cut && cut->shift);
  EXPECT_GT(cut->mesh.n_triangles(), drawn.n_triangles()) << "some were split";
  expect_sound(cut->mesh, cloth.lattice);
  EXPECT_GT(tests::smallest_angle(cut->mesh), 5.) << "what the linter calls a sliver";
  EXPECT_EQ(meshes::boundary_loops(cut->mesh).size(), 2u);
  EXPECT_TRUE(areas_of_materials(cut->mesh).isApprox(areas_of_materials(drawn), 1e-13));
  // The cloth's own mesh, cut out along its wavy lines.
  expect_one_stiffness(bracket_of(cut->mesh, cloth.lattice),
                       bracket_of(cloth.cell(6, 6), cloth.lattice));
}

TEST(exact_shifted_cell, a_side_that_cuts_nothing_stays)
{
  Cloth cloth   = perforated(0.25);
  cloth.is_void = hole(13, 2, 6, 9); // across the side along axis 2 alone
  // Its corners are there: the parallelogram around it is its lattice.
  const meshes::TriangleMesh drawn = cloth.cell(0, 0);
  const MatchedCell matched        = match_drawn_sides(drawn, {}, {}, "mesh");
  ASSERT_TRUE(matched.faults.empty()) << matched.faults[0].message;
  EXPECT_LT((matched.lattice.vectors - cloth.lattice.vectors).norm(), 1e-12);
  const auto cut = anew(drawn, matched.lattice);
  ASSERT_TRUE(cut && cut->shift);
  EXPECT_GT(cut->shift->parts(0), 3. / n);
  EXPECT_LT(cut->shift->parts(0), 13. / n);
  EXPECT_EQ(cut->shift->parts(1), 0.);
  expect_sound(cut->mesh, cloth.lattice);
  EXPECT_EQ(meshes::boundary_loops(cut->mesh).size(), 2u);
}

TEST(invariant_shifted_cell, of_a_mirrored_cell_is_the_mirrored_stiffness)
{
  const Cloth cloth             = perforated(0.25);
  meshes::TriangleMesh mirrored = cloth.cell(0, 0);
  mirrored.vertices.col(0) *= -1.;
  mirrored.triangles.col(1).swap(mirrored.triangles.col(2));
  meshes::Lattice mirror = cloth.lattice;
  mirror.vectors.col(0) *= -1.;
  mirror.vectors.row(0) *= -1.; // a1 x a2 > 0
  const auto cut = anew(cloth.cell(0, 0), cloth.lattice), its = anew(mirrored, mirror);
  ASSERT_TRUE(cut && cut->shift && its && its->shift);
  expect_sound(its->mesh, mirror);
  Bracket one = bracket_of(cut->mesh, cloth.lattice), other = bracket_of(its->mesh, mirror);
  const Eigen::Matrix3d turn = Eigen::Vector3d(1., 1., -1.).asDiagonal();
  other.lower                = turn * other.lower * turn;
  other.upper                = turn * other.upper * turn;
  expect_one_stiffness(one, other);
}

TEST(exact_shifted_cell, curved_sides_are_split_on_their_curve)
{
  // Arcs between soft and stiff, along the stripe, as six-node triangles have them.
  const Cloth cloth                  = perforated(0.25);
  const meshes::TriangleMesh drawn   = cloth.cell(0, 0);
  const std::vector<CurvedSide> arcs = arcs_of(drawn, cloth.lattice);
  ASSERT_GT(arcs.size(), 10u);
  const auto cut = anew(drawn, cloth.lattice, arcs);
  ASSERT_TRUE(cut && cut->shift);
  expect_sound(cut->mesh, cloth.lattice);
  EXPECT_GT(cut->curved_sides.size(), arcs.size()) << "some were split";
  // The area of the stiff phase, parabolas and all: a segment has two thirds of chord x sagitta.
  const auto stiff = [](const meshes::TriangleMesh &mesh, const std::vector<CurvedSide> &sides)
  {
    const auto materials = materials_along(mesh);
    double area          = areas_of_materials(mesh)(1);
    for (const CurvedSide &side : sides)
    {
      const Eigen::Vector2d chord =
        (mesh.vertices.row(side.b) - mesh.vertices.row(side.a)).transpose();
      const double segment = 2. / 3. * (chord(0) * side.sagitta(1) - chord(1) * side.sagitta(0));
      // Positive to the left of the chord.
      area += materials.at({side.a, side.b}) == 1 ? -segment : segment;
    }
    return area;
  };
  const double given = stiff(drawn, arcs);
  EXPECT_NEAR(stiff(cut->mesh, cut->curved_sides), given, 1e-13 * given);
  EXPECT_GT(std::abs(areas_of_materials(drawn)(1) - given), 1e-3 * given) << "arcs count";
  const meshes::TriangleMesh inside = cloth.cell(6, 6);
  const std::vector<CurvedSide> its = arcs_of(inside, cloth.lattice);
  EXPECT_EQ(its.size(), arcs.size());
  expect_one_stiffness(bracket_of(cut->mesh, cloth.lattice, cut->curved_sides),
                       bracket_of(inside, cloth.lattice, its));
}

TEST(tripwire_shifted_cell, holes_that_leave_no_line_are_named)
{
  Cloth cloth;
  cloth.is_void = [](const int i, const int j) // a slanting slot, longer than the cell along axis 1
  { return j >= 5 && j <= 11 && (i - 2 * j + 64) % n < 6; };
  const auto one = anew(cloth.cell(0, 0), cloth.lattice);
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->shift);
  EXPECT_NE(one->obstacle.find("every straight line along a2 meets a hole: the one around"),
            std::string::npos)
    << one->obstacle;
  EXPECT_EQ(one->obstacle.find("along a1 meets"), std::string::npos) << "those pass it";

  cloth.is_void = [](const int i, const int j) // two that overlap as seen along axis 2
  { return (hole(12, 4, 2, 4)(i, j)) || (hole(3, 13, 9, 11)(i, j)); };
  const auto two = anew(cloth.cell(0, 0), cloth.lattice);
  ASSERT_TRUE(two);
  EXPECT_FALSE(two->shift);
  EXPECT_NE(two->obstacle.find(", that around"), std::string::npos) << two->obstacle;
}

TEST(invariant_shifted_cell, holes_that_leave_no_line_have_one_bracket_wherever_they_are_drawn)
{
  Cloth cloth;
  cloth.is_void = [](const int i, const int j)
  { return (hole(12, 4, 2, 4)(i, j)) || (hole(3, 13, 9, 11)(i, j)); };
  cloth.material_at        = [](const int i, const int j) { return (i + j) % 5 == 0 ? 1 : 0; };
  cloth.lattice.cuts_holes = true;
  const Bracket here       = bracket_of(cloth.cell(0, 0), cloth.lattice),
                there      = bracket_of(cloth.cell(6, 3), cloth.lattice);
  EXPECT_LT((here.stiffness - there.stiffness).norm(), 1e-9 * here.stiffness.norm());
  EXPECT_LT((here.compliance - there.compliance).norm(), 1e-9 * here.compliance.norm());
  expect_one_stiffness(here, there);
  EXPECT_THROW(meshes::tile(cloth.cell(0, 0), cloth.lattice, 2, 2), meshes::BadInput);
}

TEST(tripwire_shifted_cell, other_faults_of_an_outline_are_no_holes)
{
  Cloth cloth = perforated(0.);
  // Whole, with a lattice that is not its own; with sides that do not match; without its image.
  Cloth whole           = cloth;
  whole.is_void         = [](int, int) { return false; };
  meshes::Lattice wrong = cloth.lattice;
  wrong.vectors.row(0) *= 2.;
  EXPECT_FALSE(anew(whole.cell(0, 0), wrong));
  EXPECT_FALSE(anew(whole.cell(0, 0), cloth.lattice)) << "nothing is cut";
  Cloth strips   = cloth;
  strips.is_void = [](const int i, int) { return i == 3; };
  EXPECT_FALSE(anew(strips.cell(0, 0), cloth.lattice)) << "nothing joins the strips";
  for (const int side : {6, 7})
  {
    meshes::TriangleMesh shaken = cloth.cell(0, 0);
    for (int v = 0; v < shaken.n_vertices(); ++v)
      if ((cloth.lattice.fractional(shaken.vertices.row(v)) -
           Eigen::RowVector2d(0., static_cast<double>(side) / n))
            .norm() < 1e-6)
        shaken.vertices.row(v) += 0.3 / n * cloth.lattice.vectors.row(1);
    EXPECT_FALSE(anew(shaken, cloth.lattice)) << "a slit along the side is no hole";
  }
  // Half of the hole is missing: its sides face triangles of the image.
  Cloth half                = cloth;
  half.is_void              = hole(13, 15, 5, 9);
  meshes::TriangleMesh mesh = half.cell(0, 0);
  EXPECT_TRUE(anew(mesh, cloth.lattice)) << "a hole that ends at the side is one";
}
