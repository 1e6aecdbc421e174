// SPDX-License-Identifier: MIT
// A sheet that bends: with w3 of the cell and all terms of edges the error of the deflection stays
// in k eps², with D^H alone it grows as the number of cells; any term of the wrong sign, side or
// size brings that back.
#include "tests/verification/bend/bent_cases.h"
#include "verification/bend/cell_twice.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// Of all methods, in k eps² and k eps.
std::array<BendingError, bending_methods.size()>
errors_of(const BendingCell &cell, const std::string &load, const int n, const int quads_per_cell)
{
  const BentSheet sheet(cell, load_of(load), n, quads_per_cell);
  std::array<BendingError, bending_methods.size()> errors;
  for (std::size_t m = 0; m < errors.size(); ++m)
  {
    const BendingError mean = mean_of(sheet.error_of_method[m]);
    errors[m]               = {mean.position / (side * side), mean.normal / side};
  }
  return errors;
}

/// How the errors in k eps² of all methods grow from 4 to 8 cells: 1 of second order, 2 of first.
std::array<double, bending_methods.size()> growth(const BendingCell &cell, const std::string &load)
{
  const auto few = errors_of(cell, load, 4, 10), many = errors_of(cell, load, 8, 40 / 8);
  std::array<double, bending_methods.size()> ratios;
  for (std::size_t m = 0; m < ratios.size(); ++m)
    ratios[m] = many[m].position / few[m].position;
  return ratios;
}
} // namespace

TEST(order_bent_sheet, is_first_with_the_homogenized_plate_alone_and_second_with_all_terms)
{
  const homogenization::UnitCell unit = three_stripes();
  const BendingCell cell(unit);
  // Corners between clamped and free edges with exponents near 1 leave k eps² (A + B ln N).
  const double of_corners = std::log(8.) / std::log(4.);
  for (const char *load : {"roll", "cantilever-1", "cantilever-2", "twist"})
  {
    const auto of_method = growth(cell, load);
    EXPECT_NEAR(of_method[affine], 2., 0.4) << load;
    EXPECT_GT(of_method[full], 0.75) << load;
    EXPECT_LT(of_method[full], of_corners) << load;
  }
  // All around clamped, what is left at the edge is a larger part of 4 cells.
  const auto of_method = growth(cell, "pressure");
  EXPECT_GT(of_method[affine], 2.);
  EXPECT_NEAR(of_method[full], 1., 0.25);
}

// Where no edge stands on another one and nothing is symmetric: in k eps all terms leave normals
// that fall with the number of cells, and positions in k eps² that do not grow with it.
TEST(order_bent_sheet, is_the_same_on_an_oblique_lattice)
{
  const homogenization::UnitCell unit = tests::cell_of(
    tests::skewed_lattice(), 8, 10,
    {homogenization::isotropic("soft", 1e6, 0.1, 5e-4, 400.),
     homogenization::isotropic("hard", 2e7, 0.4, 5e-4, 400.)},
    [](const double f1, const double f2)
    { return f1 > 0.25 && f1 < 0.75 && f2 > 0.1 && f2 < (f1 < 0.5 ? 0.5 : 0.7) ? 1 : 0; });
  const BendingCell cell(unit);
  const double of_corners = std::log(6.) / std::log(3.);
  for (const char *load : {"roll", "cantilever-1", "cantilever-2", "twist", "pressure"})
  {
    const auto few = errors_of(cell, load, 3, 12), many = errors_of(cell, load, 6, 6);
    EXPECT_LT(many[full].position, of_corners * few[full].position) << load;
    EXPECT_LT(many[full].normal, 0.75 * few[full].normal) << load; // half of second order
    EXPECT_GT(many[with_edges].normal, 0.75 * few[with_edges].normal) << load;
  }
}

// The homogenized sheet has a solution: what halved quads change falls, with the lift at clamps
// too.
TEST(order_bent_sheet, macro_problem_with_all_terms_converges)
{
  const homogenization::UnitCell unit = three_stripes(6, 10);
  const BendingCell cell(unit);
  const auto change = [&](const int quads_per_cell)
  {
    return BentSheet(cell, load_of("cantilever-2"), 3, quads_per_cell).of_macro_mesh[full].position;
  };
  EXPECT_LT(change(24), 0.75 * change(12));
}

TEST(order_bent_sheet, normals_need_both_the_deflection_of_the_cell_and_the_edges)
{
  const homogenization::UnitCell unit = three_stripes();
  const BendingCell cell(unit);
  const auto errors = errors_of(cell, "cantilever-2", 6, 6);
  EXPECT_GT(errors[affine].normal, 20. * errors[full].normal);
  EXPECT_GT(errors[localized].normal, 20. * errors[full].normal);
  EXPECT_GT(errors[with_edges].normal, 5. * errors[full].normal);
}

// What slip, lift, fluctuation and layers add to a clamped edge cancels there but for the next
// order.
TEST(exact_bent_sheet, lies_at_its_clamp_with_its_slope)
{
  const homogenization::UnitCell unit = three_stripes();
  const BendingCell cell(unit);
  const BentSheet bent(cell, load_of("cantilever-2"), 6, 12);
  const auto at_clamp = [&](const Method method)
  {
    BentState rows(0, 6);
    for (int v = 0; v < bent.sheet.mesh.n_vertices(); ++v)
      if (bent.sheet.fraction(bent.sheet.mesh.vertices.row(v))(1) < 1e-9)
      {
        rows.conservativeResize(rows.rows() + 1, 6);
        rows.row(rows.rows() - 1) = bent.error_of_method[method].row(v);
      }
    return mean_of(rows);
  };
  EXPECT_LT(at_clamp(full).position, 0.1 * at_clamp(localized).position);
  EXPECT_LT(at_clamp(full).normal, 0.1 * at_clamp(localized).normal);
  EXPECT_LT(at_clamp(full).normal, 0.1 * at_clamp(with_edges).normal);
}

// Of the images of a vertex any may be drawn first: the near one or the far one.
TEST(invariant_bent_sheet, errors_do_not_depend_on_the_numbering_of_the_cell)
{
  const homogenization::UnitCell unit = three_stripes(4, 10);
  homogenization::UnitCell backwards  = unit;
  const int n                         = unit.mesh.n_vertices();
  for (int v = 0; v < n; ++v)
    backwards.mesh.vertices.row(v) = unit.mesh.vertices.row(n - 1 - v);
  backwards.mesh.triangles = n - 1 - unit.mesh.triangles.array();
  const BendingCell cell(unit), other(backwards);
  for (const char *load : {"cantilever-1", "cantilever-2", "twist", "pressure"})
  {
    const auto errors = errors_of(cell, load, 4, 6), same = errors_of(other, load, 4, 6);
    for (std::size_t m = 0; m < errors.size(); ++m)
    {
      EXPECT_NEAR(same[m].position, errors[m].position, 1e-8) << load << ' ' << bending_methods[m];
      EXPECT_NEAR(same[m].normal, errors[m].normal, 1e-8) << load << ' ' << bending_methods[m];
    }
  }
}

TEST(exact_bent_sheet, of_one_material_is_the_homogenized_plate)
{
  const homogenization::UnitCell unit = tests::cell_of(
    tests::square_lattice(side), 6, 6, {homogenization::isotropic("one", 1e6, 0.3, 5e-4, 400.)},
    tests::everywhere_the_same);
  const BendingCell cell(unit);
  for (const BendingLoad &load : bending_loads)
  {
    // On the mesh of the reference itself.
    const auto errors = errors_of(cell, load.name, 4, 6);
    for (const Method method : {affine, localized, with_edges, full})
      EXPECT_LT(errors[method].position, 1e-9) << load.name;
  }
}

// What carries an error bar from a small sheet to a large one: meshes move slips and beams of
// edges, and with them the normal by a part of k eps, the position by that times the sheet's side;
// but terms of edges move with the reference.
TEST(bound_bent_sheet, what_meshes_move_is_covered_by_what_they_move_on_a_small_sheet)
{
  const homogenization::UnitCell unit =
    tests::cell_of(tests::square_lattice(side), 4, 10,
                   {homogenization::isotropic("soft", 1e6, 0.1, 5e-4, 400.),
                    homogenization::isotropic("hard", 1e7, 0.4, 5e-4, 400.)},
                   [](const double, const double f2) { return f2 < 0.3 ? 0 : 1; });
  const CellTwice cell(unit);
  for (const char *load : {"roll", "pressure"})
  {
    const auto small   = distance_of_meshes(cell, load_of(load), 3),
               carried = carried_bars(small, growth_in_linear_theory(2.), cell.factor),
               large   = distance_of_meshes(cell, load_of(load), 6);
    for (std::size_t m = 0; m < large.size(); ++m)
    {
      // Of an error of order one the limit is twice as far as the finer mesh.
      EXPECT_LT(2. * large[m]->position, carried[m]->position) << load << ' ' << bending_methods[m];
      EXPECT_LT(2. * large[m]->normal, carried[m]->normal) << load << ' ' << bending_methods[m];
      if (has_edges(bending_methods[m]))
        continue;
      EXPECT_GT(large[m]->position, 1.5 * small[m]->position) << "a sheet of twice the side";
      EXPECT_NEAR(large[m]->normal / small[m]->normal, 1., 0.5) << load;
    }
  }
}

TEST(exact_bent_sheet, bars_of_two_meshes_know_how_slowly_strong_corners_converge)
{
  const auto factor_of = [](const double contrast)
  {
    const homogenization::UnitCell unit =
      tests::cell_of(tests::square_lattice(side), 4, 4,
                     {homogenization::isotropic("soft", 1e6, 0.3, 5e-4, 400.),
                      homogenization::isotropic("hard", contrast * 1e6, 0.3, 5e-4, 400.)},
                     [](const double f1, const double f2) { return (f1 < 0.5) == (f2 < 0.5); });
    return CellTwice(unit).factor;
  };
  EXPECT_EQ(factor_of(2.), 3.);
  EXPECT_GT(factor_of(1000.), 6.);
}

TEST(tripwire_bent_sheet, a_term_of_the_wrong_sign_side_or_size_is_noticed)
{
  const homogenization::UnitCell unit = three_stripes();
  const auto planted                  = [&](const char *load, const auto &plant)
  {
    BendingCell cell(unit);
    plant(*cell.known.edges, cell.solved);
    return growth(cell, load)[full];
  };
  using Edges = homogenization::PlateEdges;
  using Cell  = homogenization::PlateCell;
  EXPECT_GT(planted("cantilever-2",
                    [](Edges &edges, Cell &) { edges.sides[2].slip = edges.sides[3].slip; }),
            1.5)
    << "slip of the opposite edge";
  EXPECT_GT(planted("cantilever-1", [](Edges &its, Cell &) { its.sides[3].moment *= -1.; }), 1.5)
    << "sign of one beam";
  EXPECT_GT(planted("cantilever-2", [](Edges &edges, Cell &) { edges.sides[2].slip.slope *= 0.5; }),
            1.5)
    << "half of the slip";
  EXPECT_GT(planted("cantilever-1",
                    [](Edges &edges, Cell &)
                    {
                      for (Eigen::Matrix3d &of_axis : edges.bulk)
                        of_axis *= -1.;
                    }),
            1.5)
    << "sign of the gradient's term";
  // w3 alone does not grow with the sheet: its faults are seen in the normals.
  const auto normal = [&](const double factor)
  {
    BendingCell cell(unit);
    cell.solved.deflection *= factor;
    return errors_of(cell, "cantilever-2", 6, 6)[full].normal;
  };
  EXPECT_GT(normal(-1.), 5. * normal(1.)) << "sign of w3";
  EXPECT_GT(normal(0.5), 2. * normal(1.)) << "half of w3";
}

TEST(invariant_bent_sheet, errors_do_not_know_how_vertices_are_numbered)
{
  const homogenization::UnitCell unit = three_stripes();
  homogenization::UnitCell turned     = unit;
  turned.mesh.vertices                = unit.mesh.vertices.colwise().reverse().eval();
  turned.mesh.triangles = (unit.mesh.n_vertices() - 1 - unit.mesh.triangles.array()).matrix();
  const auto here       = errors_of(BendingCell(unit), "cantilever-1", 3, 4),
             there      = errors_of(BendingCell(turned), "cantilever-1", 3, 4);
  for (std::size_t m = 0; m < here.size(); ++m)
  {
    EXPECT_NEAR(there[m].position / here[m].position, 1., 1e-6) << bending_methods[m];
    EXPECT_NEAR(there[m].normal / here[m].normal, 1., 1e-6) << bending_methods[m];
  }
}

// Vertices of the cell lie on lines of the macro mesh, across which curvatures jump.
TEST(invariant_bent_sheet, errors_do_not_know_where_the_cell_lies_nor_how_it_is_turned)
{
  const homogenization::UnitCell unit = three_stripes(4, 10);
  homogenization::UnitCell shifted = unit, turned = unit;
  shifted.mesh.vertices.rowwise() += side * Eigen::RowVector2d(0.37, -1.21);
  const Eigen::Matrix2d turn = tests::rotation<2>(0.5);
  turned.mesh.vertices       = (unit.mesh.vertices * turn.transpose()).eval();
  turned.lattice.vectors     = (unit.lattice.vectors * turn.transpose()).eval();
  const auto here            = errors_of(BendingCell(unit), "cantilever-1", 3, 4);
  for (const homogenization::UnitCell &same : {shifted, turned})
  {
    const auto there = errors_of(BendingCell(same), "cantilever-1", 3, 4);
    for (std::size_t m = 0; m < here.size(); ++m)
    {
      EXPECT_NEAR(there[m].position / here[m].position, 1., 1e-6) << bending_methods[m];
      EXPECT_NEAR(there[m].normal / here[m].normal, 1., 1e-6) << bending_methods[m];
    }
  }
}
