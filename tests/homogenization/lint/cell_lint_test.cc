// SPDX-License-Identifier: MIT
// What the linter finds in cells made in code: parts that move, hinges, slivers, units, contrast.
#include "homogenization/lint/cell_lint.h"
#include "homogenization/lint/conformity.h"
#include "homogenization/lint/mechanisms.h"
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
/// The cell without the squares, of n x n, that the predicate names.
meshes::TriangleMesh without(const meshes::Lattice &lattice, const int n,
                             const std::function<bool(int i, int j)> &is_void)
{
  const meshes::TriangleMesh whole = tests::parallelogram(lattice, n, n);
  meshes::TriangleMesh mesh        = whole;
  int kept                         = 0;
  for (int t = 0; t < whole.n_triangles(); ++t)
    if (!is_void(t / 2 % n, t / 2 / n))
      mesh.triangles.row(kept++) = whole.triangles.row(t);
  mesh.triangles.conservativeResize(kept, 3);
  mesh.material.setZero(kept);
  return mesh;
}

/// A frame along the outline; what stands inside it is told by the predicate.
meshes::TriangleMesh frame_with(const std::function<bool(int i, int j)> &stands)
{
  return without(tests::skewed_lattice(), 8,
                 [&](const int i, const int j)
                 { return i > 0 && i < 7 && j > 0 && j < 7 && !stands(i, j); });
}

int n_free(const Mechanisms &found)
{
  int n = 0;
  for (const MeshPart &part : found.parts)
    n += part.is_free ? 1 : 0;
  return n;
}

bool finds(const std::vector<Finding> &findings, const std::string &kind, const Severity severity)
{
  for (const Finding &finding : findings)
    if (finding.kind == kind && finding.severity == severity)
      return true;
  return false;
}
} // namespace

TEST(exact_mechanisms, a_cell_with_a_hole_holds)
{
  const Mechanisms found =
    find_mechanisms(frame_with([](int, int) { return false; }), tests::skewed_lattice());
  EXPECT_EQ(found.parts.size(), 1u);
  EXPECT_EQ(found.parts[0].n_periods, 2);
  EXPECT_TRUE(found.hinges.empty());
  EXPECT_EQ(found.free_strains.cols(), 0);
}

TEST(exact_mechanisms, an_island_floats_and_one_on_a_vertex_turns_and_one_on_two_holds)
{
  const auto lattice        = tests::skewed_lattice();
  const Mechanisms floating = find_mechanisms(
    frame_with([](int i, int j) { return i >= 3 && i < 5 && j >= 3 && j < 5; }), lattice);
  ASSERT_EQ(floating.parts.size(), 2u);
  EXPECT_TRUE(floating.parts[1].is_free);
  EXPECT_EQ(floating.parts[1].n_joints, 0);
  EXPECT_EQ(floating.free_strains.cols(), 0) << "the frame carries any strain";

  const Mechanisms turning =
    find_mechanisms(frame_with([](int i, int j) { return i == 1 && j == 1; }), lattice);
  EXPECT_EQ(turning.parts.size(), 1u) << "a square in the corner of the frame shares edges with it";

  // A chain of two squares from the frame, joined corner to corner: the first one shares edges with
  // the frame.
  const Mechanisms chain = find_mechanisms(
    frame_with([](int i, int j) { return (i == 1 && j == 1) || (i == 2 && j == 2); }), lattice);
  ASSERT_EQ(chain.parts.size(), 2u);
  EXPECT_EQ(chain.parts[1].n_joints, 1);
  EXPECT_TRUE(chain.parts[1].is_free);
  EXPECT_EQ(chain.hinges.size(), 1u);

  const Mechanisms diagonal =
    find_mechanisms(frame_with([](int i, int j) { return i == j; }), lattice);
  // Squares 2..5 hang in a row between two that share edges with the frame: five hinges for four
  // squares, 12 motions against 10 equations; on one line the middle ones may still leave it.
  EXPECT_EQ(diagonal.parts.size(), 5u);
  EXPECT_EQ(n_free(diagonal), 4);
}

TEST(exact_mechanisms, squares_of_a_checkerboard_turn_against_each_other)
{
  // Joined at their corners alone; to first order this keeps the size of the cell.
  const auto lattice = tests::square_lattice(0.01);
  const Mechanisms found =
    find_mechanisms(without(lattice, 2, [](int i, int j) { return (i + j) % 2 == 1; }), lattice);
  ASSERT_EQ(found.parts.size(), 2u);
  EXPECT_TRUE(found.parts[1].is_free);
  EXPECT_EQ(found.free_strains.cols(), 0);
}

TEST(exact_mechanisms, turned_squares_shrink_alike_in_both_directions)
{
  // Two squares of half diagonal r, turned by phi and -phi, on a lattice of 4 r cos 45 cos phi: the
  // known auxetic mechanism, whose strain is isotropic.
  const double r = 0.003, phi = 0.3, side = 4. * r * std::sqrt(0.5) * std::cos(phi);
  meshes::TriangleMesh mesh;
  mesh.vertices.resize(7, 2);
  for (int k = 0; k < 4; ++k)
  {
    const double angle0 = (0.25 + 0.5 * k) * M_PI + phi, angle1 = (0.25 + 0.5 * k) * M_PI - phi;
    mesh.vertices.row(k) << r * std::cos(angle0), r * std::sin(angle0);
    if (k != 2) // the corner towards the first square is that square's first
      mesh.vertices.row(k < 2 ? 4 + k : 6) << 0.5 * side + r * std::cos(angle1),
        0.5 * side + r * std::sin(angle1);
  }
  mesh.triangles.resize(4, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3, 4, 5, 0, 4, 0, 6;
  mesh.material.setZero(4);
  const Mechanisms found = find_mechanisms(mesh, tests::square_lattice(side));
  ASSERT_EQ(found.parts.size(), 2u);
  EXPECT_EQ(found.hinges.size(), 4u);
  ASSERT_EQ(found.free_strains.cols(), 1);
  const Eigen::Vector3d strain = found.free_strains.col(0);
  EXPECT_NEAR(std::abs(strain(0)), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(strain(0), strain(1), 1e-9);
  EXPECT_NEAR(strain(2), 0., 1e-9);
}

TEST(exact_mechanisms, a_strip_carries_only_the_strain_along_it)
{
  const auto lattice = tests::square_lattice(0.01);
  const Mechanisms strip =
    find_mechanisms(without(lattice, 8, [](int i, int) { return i >= 4; }), lattice);
  EXPECT_EQ(strip.parts.size(), 1u);
  EXPECT_EQ(strip.parts[0].n_periods, 1);
  ASSERT_EQ(strip.free_strains.cols(), 2);
  EXPECT_LT(strip.free_strains.row(1).norm(), 1e-9);
  const Mechanisms patch =
    find_mechanisms(without(lattice, 8, [](int i, int j) { return i >= 4 || j >= 4; }), lattice);
  EXPECT_EQ(patch.free_strains.cols(), 3);
}

TEST(exact_cell_lint, sound_cells_have_no_findings)
{
  for (const auto &phase_at : {tests::halves, tests::square_inclusion})
  {
    std::vector<Phase> phases = {isotropic("soft", 1e6, 0.3, 5e-4, 400.),
                                 isotropic("hard", 1e7, 0.3, 5e-4, 400.)};
    const UnitCell cell       = tests::cell_of(tests::skewed_lattice(), 16, 16, phases, phase_at);
    for (const auto &findings :
         {lint_slivers(cell.mesh, 1.), lint_missing_triangles(cell.mesh, 1.),
          lint_mechanisms(cell.mesh, cell.lattice, 1.), lint_size(0.01, 0.01),
          lint_phases(cell, 0.01), lint_contrast(cell), lint_thin_parts(cell, 1.)})
      for (const Finding &finding : findings)
        ADD_FAILURE() << text_of(finding);
  }
}

TEST(exact_cell_lint, a_stripe_of_one_row_is_thin_and_one_of_two_is_not)
{
  const std::vector<Phase> phases = {isotropic("soft", 1e6, 0.3, 5e-4, 400.),
                                     isotropic("hard", 1e7, 0.3, 5e-4, 400.)};
  for (const int rows : {1, 2})
  {
    const UnitCell cell =
      tests::cell_of(tests::square_lattice(0.01), 8, 8, phases,
                     [&](double, const double f2) { return f2 * 8. < rows ? 1 : 0; });
    const auto findings = lint_thin_parts(cell, 1.);
    ASSERT_EQ(findings.size(), rows == 1 ? 1u : 0u);
    for (const Finding &finding : findings)
      EXPECT_NE(finding.what.find("`hard`"), std::string::npos);
  }
}

TEST(tripwire_cell_lint, more_parts_than_motions_are_looked_for_are_no_sound_cell)
{
  // A chessboard: every square hangs on its corners.
  const auto lattice = tests::square_lattice(0.01);
  for (const int n : {4, 26})
  {
    const meshes::TriangleMesh mesh =
      without(lattice, n, [](int i, int j) { return (i + j) % 2 == 1; });
    const Mechanisms found = find_mechanisms(mesh, lattice);
    ASSERT_EQ(found.parts.size(), static_cast<std::size_t>(n * n / 2));
    EXPECT_EQ(found.is_determined, n * n / 2 <= most_parts);
    EXPECT_TRUE(finds(lint_mechanisms(mesh, lattice, 1.), "mechanism", Severity::error)) << n;
  }
}

TEST(tripwire_cell_lint, every_kind_is_found_with_its_severity)
{
  const auto lattice = tests::square_lattice(0.01);
  UnitCell cell      = tests::cell_of(
         lattice, 8, 8,
         {isotropic("soft", 1e6, 0.3, 5e-4, 400.), isotropic("hard", 1e7, 0.3, 5e-4, 400.)},
         tests::halves);

  meshes::TriangleMesh mesh = cell.mesh;
  mesh.vertices(10, 1) =
    mesh.vertices(1, 1) + 1e-3 * 0.01 / 8.; // an inner vertex down to the lower side
  EXPECT_TRUE(finds(lint_slivers(mesh, 1.), "sliver", Severity::warning));

  EXPECT_TRUE(finds(lint_size(10., 1.), "size", Severity::warning));
  EXPECT_NE(lint_size(10., 1.)[0].remedy.find("0.001 (millimetres)"), std::string::npos);
  EXPECT_TRUE(finds(lint_size(1e-6, 1e-6), "size", Severity::warning));

  cell.phases[0].thickness = 0.5; // half a millimetre in millimetres
  EXPECT_TRUE(finds(lint_phases(cell, 0.01), "thickness", Severity::warning));
  cell.phases[0] = isotropic("soft", 1., 0.3, 5e-4, 400.); // 1 MPa in MPa
  EXPECT_TRUE(finds(lint_phases(cell, 0.01), "stiffness", Severity::warning));
  cell.phases[0] = isotropic("soft", 1e6, 0.3, 5e-4, 0.4); // g/cm^3
  EXPECT_TRUE(finds(lint_phases(cell, 0.01), "mass", Severity::warning));
  // A film over a third of the thickness beside the bare fabric; the same on all of it is sound.
  const Phase film = layered("p", {{6e-4, 1e6, 0.3}, {3e-4, 1e6, 0.3}}, 400.);
  cell.phases      = {isotropic("q", 1e6, 0.3, 6e-4, 400.), film};
  EXPECT_TRUE(finds(lint_phases(cell, 0.01), "layers", Severity::warning));
  cell.phases = {film, film};
  EXPECT_FALSE(finds(lint_phases(cell, 0.01), "layers", Severity::warning));
  cell.phases[0] = isotropic("soft", 1e-3, 0.3, 5e-4, 400.);
  EXPECT_TRUE(finds(lint_contrast(cell), "contrast", Severity::warning));
  cell.phases[0] = isotropic("soft", 1e-10, 0.3, 5e-4, 400.);
  EXPECT_TRUE(finds(lint_contrast(cell), "contrast", Severity::error));
}
