// SPDX-License-Identifier: MIT
// A sheet without corners: with all terms of edges the error per cell falls with the cell, and with
// any of them of the wrong sign, or on the wrong side, it does not.
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/cell/cell_edges.h"
#include "verification/converge/closed_strip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

using namespace homespun;
using namespace homespun::verification;

namespace
{
struct Strip
{
  explicit Strip(const std::string &name)
      : cell(homogenization::read_unit_cell(CELLS + name + ".prm"))
      , homogenized(homogenization::homogenized_cell(cell, tests::solved(cell), "test"))
      , edges(known_edges(cell, 1).edges.value())
  {
  }

  double error(const int n) const
  {
    return closed_strip_errors(cell, {homogenized, &edges}, n).full;
  }

  /// Between 4 and 12 cells.
  double order() const
  {
    return std::log(error(4) / error(12)) / std::log(3.);
  }

  const homogenization::UnitCell cell;
  meshes::HomogenizedCell homogenized;
  meshes::CellEdges edges;
};
} // namespace

TEST(order_closed_strip, with_all_terms_of_edges_the_error_per_cell_falls_with_order_1)
{
  for (const char *name : {"layered", "three-stiffness"})
  {
    const Strip strip(name);
    EXPECT_NEAR(strip.order(), 1., 0.15) << name; // 4 cells are few
    const auto localized = [&](const int n) {
      return closed_strip_errors(strip.cell, {strip.homogenized, &strip.edges}, n).localized;
    };
    EXPECT_LT(std::log(localized(4) / localized(12)) / std::log(3.), 0.3) << name;
  }
}

TEST(tripwire_closed_strip, a_term_of_the_wrong_sign_or_side_is_noticed)
{
  const Strip as_is("three-stiffness");
  const auto order_with = [&](const auto &fault)
  {
    Strip strip = as_is;
    fault(strip.edges);
    return strip.order();
  };
  EXPECT_LT(order_with([](meshes::CellEdges &edges) { edges.sides[3].tension *= -1.; }), 0.6);
  EXPECT_LT(order_with([](meshes::CellEdges &edges) { edges.sides[2].slip *= -1.; }), 0.6);
  // Weaker ones, of a cell whose four edges are much alike: the error at 12 cells grows.
  const auto error_with = [&](const auto &fault)
  {
    Strip strip = as_is;
    fault(strip.edges);
    return strip.error(12) / as_is.error(12);
  };
  EXPECT_GT(error_with([](meshes::CellEdges &edges)
                       { std::swap(edges.sides[2].slip, edges.sides[3].slip); }),
            1.05);
  EXPECT_GT(error_with(
              [](meshes::CellEdges &edges)
              {
                for (Eigen::Matrix3d &of_axis : edges.bulk)
                  of_axis *= -1.;
              }),
            1.05);
}

TEST(invariant_closed_strip, the_constant_of_chi_changes_nothing)
{
  Strip strip("three-stiffness");
  const double before = strip.error(4);
  strip.homogenized.chi.rowwise() += 1e-3 * Eigen::Matrix<double, 1, 6>(1., -2., 0.5, 3., -1., 0.7);
  EXPECT_NEAR(strip.error(4), before, 1e-10 * 0.01);
}
