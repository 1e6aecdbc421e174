// SPDX-License-Identifier: MIT
// A sheet that bends by large turns: a small load bends it as linear theory says, with what differs
// falling as the square of the curvature at one mesh and of the mesh width at a small one; of one
// material it is the elastica; a clamp turned the wrong way and stiffnesses of the wrong phase are
// noticed.
#include "meshes/plain/index.h"
#include "tests/shell/shell_cases.h"
#include "tests/verification/bend/bent_cases.h"
#include "verification/bend/bent_cloth.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <utility>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
const BendingLoad across = load_of("cantilever-2");

/// Without what large turns do not know.
void forget_free_edges(BendingCell &cell)
{
  for (homogenization::PlateEdge &edge : cell.known.edges->sides)
    edge.moment.setZero();
  for (Eigen::Matrix3d &of_axis : cell.known.edges->bulk)
    of_axis.setZero();
}

/// What a small load leaves of a sheet of 3 x 3 cells, less linear theory: of the deflection in
/// parts of it, of the fields of errors in k eps² and k eps.
struct Distance
{
  double deflection = 0.;
  std::array<BendingError, 4> of_method;
};

template <typename Plant>
Distance from_linear(const homogenization::UnitCell &unit, const Plant &plant)
{
  BendingCell cell(unit);
  forget_free_edges(cell);
  const BentSheet linear(cell, across, 3, 20);
  plant(cell);
  const double curvature = 1e-4 / side;
  const BentByTurns bent = BentCloth(cell, across, 3).at(curvature * linear.unit_load);
  Distance distance      = {bent.deflection / (curvature * linear.deflection) - 1., {}};
  for (const Method method : {affine, localized, with_edges, full})
  {
    const BendingError difference =
      mean_of(bent.error_of_method[method] / curvature - linear.error_of_method[method]);
    distance.of_method[method] = {difference.position / (side * side), difference.normal / side};
  }
  return distance;
}

Distance from_linear(const homogenization::UnitCell &unit)
{
  return from_linear(unit, [](BendingCell &) {});
}
} // namespace

TEST(order_bent_cloth, of_a_small_load_is_that_of_linear_theory_but_for_its_mesh_with_order_two)
{
  const Distance wide = from_linear(three_stripes(6, 10)),
                 fine = from_linear(three_stripes(12, 20));
  std::cout << "deflection " << wide.deflection << ", " << fine.deflection << '\n';
  EXPECT_NEAR(wide.deflection / fine.deflection, 4., 0.7);
  EXPECT_LT(std::abs(fine.deflection), 0.005);
  for (const Method method : {affine, localized, with_edges, full})
  {
    const BendingError &before = wide.of_method[method], &now = fine.of_method[method];
    std::cout << bending_methods[method] << ": " << before.position << ", " << now.position
              << "; normals " << before.normal << ", " << now.normal << '\n';
    // The moments at the corners of a clamp, which it is turned by, are singular.
    EXPECT_NEAR(before.position / now.position, method < with_edges ? 4. : 3., 0.7);
    EXPECT_LT(now.position, 0.005);
    EXPECT_LT(now.normal, 0.005);
  }
}

TEST(order_bent_cloth, leaves_linear_theory_as_the_square_of_its_curvature)
{
  const homogenization::UnitCell unit = three_stripes(6, 10);
  const BendingCell cell(unit);
  const double unit_load = BentSheet(cell, across, 3, 6).unit_load;
  BentCloth cloth(cell, across, 3);
  // Over curvature: the deflection, the curvature, and of two methods the errors of deflection and
  // slopes at each vertex; along the sheet positions, and normals, change by the first power.
  const auto scaled = [&](const double bending)
  {
    const double curvature = bending / side;
    const BentByTurns bent = cloth.at(curvature * unit_load);
    const auto column      = [](const double value) { return Eigen::VectorXd::Constant(1, value); };
    std::vector<Eigen::VectorXd> values = {column(bent.deflection), column(bent.curvature)};
    for (const Method method : {affine, full})
    {
      const BentState &error = bent.error_of_method[method];
      values.emplace_back(error.col(2));
      values.emplace_back(error.middleCols<2>(3).reshaped());
    }
    for (Eigen::VectorXd &value : values)
      value /= curvature;
    return values;
  };
  const std::vector<Eigen::VectorXd> least = scaled(1e-4);
  std::vector<double> levels;
  std::vector<std::vector<double>> distances(least.size());
  for (const double bending : {0.01, 0.02, 0.04})
  {
    levels.push_back(bending);
    const std::vector<Eigen::VectorXd> now = scaled(bending);
    for (std::size_t k = 0; k < now.size(); ++k)
      distances[k].push_back((now[k] - least[k]).cwiseAbs().mean());
  }
  for (std::size_t k = 0; k < distances.size(); ++k)
    EXPECT_NEAR(tests::slope(levels, distances[k]), 2., 0.1) << k;
}

TEST(exact_bent_cloth, of_one_material_is_the_elastica_and_leaves_nothing_to_restore)
{
  constexpr int n                     = 4;
  const homogenization::UnitCell unit = tests::cell_of(
    tests::square_lattice(side), 8, 8, {homogenization::isotropic("one", 1e6, 0., 1e-4, 400.)},
    tests::everywhere_the_same);
  const BendingCell cell(unit);
  BentCloth cloth(cell, across, n);
  // rho g L³/D = 2 drops the tip by 0.246673 of its reach (tests/shell/solver/elastica_test.cc).
  const double length = n * side, D = 1e6 * 1e-12 / 12.;
  const BentByTurns bent       = cloth.at(2. * D / std::pow(length, 3));
  const Eigen::RowVector3d tip = cloth.resolved.mesh.positions.bottomRows<1>();
  EXPECT_NEAR(tip(2) / tip(1), 0.246673, 0.003 * 0.246673);
  for (const Method method : {affine, localized, with_edges, full})
  {
    const BendingError mean = mean_of(bent.error_of_method[method]);
    EXPECT_LT(mean.position, 1e-7 * bent.curvature * side * side);
    EXPECT_LT(mean.normal, 1e-7 * bent.curvature * side);
  }
}

TEST(bound_bent_cloth, a_turned_clamp_restores_what_a_large_droop_lacks)
{
  const homogenization::UnitCell unit = three_stripes(6, 10);
  const BendingCell cell(unit);
  BentCloth cloth(cell, across, 4);
  const BentByTurns bent = cloth.at(0.2 / side * BentSheet(cell, across, 4, 6).unit_load);
  EXPECT_GT(mean_of(bent.error_of_method[affine]).position,
            10. * mean_of(bent.error_of_method[full]).position);
  EXPECT_GT(mean_of(bent.error_of_method[affine]).normal,
            10. * mean_of(bent.error_of_method[full]).normal);
}

TEST(tripwire_bent_cloth, a_clamp_turned_the_wrong_way_and_a_stiffness_of_the_neighbour_are_noticed)
{
  const homogenization::UnitCell unit = three_stripes(6, 10);
  const auto planted                  = [&](const auto &plant) { return from_linear(unit, plant); };
  const Distance sound                = planted([](BendingCell &) {});
  const auto of_full = [](const Distance &one) { return one.of_method[full].position; };
  EXPECT_GT(
    of_full(planted([](BendingCell &cell) { cell.known.edges->sides[2].slip.slope *= -1.; })),
    10. * of_full(sound))
    << "the wrong way";
  EXPECT_GT(of_full(planted(
              [](BendingCell &cell)
              {
                Eigen::RowVector3d &slip = cell.known.edges->sides[2].slip.slope;
                std::swap(slip(0), slip(1));
              })),
            5. * of_full(sound))
    << "the slip of the other curvature";
  EXPECT_GT(std::abs(planted(
                       [](BendingCell &cell) {
                         std::swap(cell.bending_stiffness_of_phase[0],
                                   cell.bending_stiffness_of_phase[1]);
                       })
                       .deflection),
            10. * std::abs(sound.deflection))
    << "D of the neighbour";
}

TEST(invariant_bent_cloth, large_turns_are_known_where_one_edge_is_clamped_and_the_cell_has_no_hole)
{
  homogenization::UnitCell unit = three_stripes(6, 10);
  for (const char *load : {"cantilever-1", "cantilever-2"})
    EXPECT_EQ(why_no_large_turns(unit, load_of(load)), "");
  for (const char *load : {"twist", "pressure"})
    EXPECT_EQ(why_no_large_turns(unit, load_of(load)),
              "clamps that keep their distance stretch the sheet");
  EXPECT_EQ(why_no_large_turns(unit, load_of("roll")), "a moment on an edge is no dead load");
  unit.mesh.triangles.conservativeResize(unit.mesh.n_triangles() - 2, 3);
  unit.mesh.material.conservativeResize(unit.mesh.triangles.rows());
  EXPECT_EQ(why_no_large_turns(unit, across),
            "the cell has holes, which the triangles of the homogenized sheet do not fill");
}
