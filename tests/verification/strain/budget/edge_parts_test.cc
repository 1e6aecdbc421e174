// SPDX-License-Identifier: MIT
// What edges make of the error, piece by piece: nothing where theory has nothing, all of it with
// what the term `edges` leaves, and whatever the constant of chi.
#include "homogenization/lint/cell_reading.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/cell/cell_edges.h"
#include "verification/method/coarse_model.h"
#include "verification/method/sheet_reading.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A sheet of 4 x 4 cells, resolved, with what its parts come from.
struct Resolved
{
  static constexpr int refinement = 8;

  Resolved(const std::string &name, const std::string &load_name, const Law law,
           const double strain = 0.01)
      : cell(homogenization::read_unit_cell(CELLS + name + ".prm"))
      , homogenized(homogenization::homogenized_cell(cell, tests::solved(cell), "test"))
      , edges(known_edges(cell, 1).edges.value())
      , sheet(meshes::tile(cell.mesh, cell.lattice, 4, 4))
      , load(load_name)
      , law(law)
      , macro({homogenized}, sheet, load, Method("localized"), law,
              quads_per_cell(sheet, refinement))
      , u(macro.solve(strain))
  {
  }

  meshes::Points localized_sheet() const
  {
    const SheetReading reading(sheet, quads_per_cell(sheet, refinement));
    return localized(reading.at_fine_vertices(law, u.positions), homogenized, sheet);
  }

  EdgeParts parts() const
  {
    return edge_parts(macro, load, edges_piece_by_piece(edges), u, localized_sheet());
  }

  const homogenization::UnitCell cell;
  meshes::HomogenizedCell homogenized;
  meshes::CellEdges edges;
  const meshes::Sheet sheet;
  const Load load;
  const Law law;
  const CoarseModel macro;
  const CoarseState u;
};

double mean_length(const meshes::Points &field)
{
  return field.rowwise().norm().mean();
}

double distance(const EdgeParts &a, const EdgeParts &b)
{
  return mean_length(a.slip - b.slip) + mean_length(a.selvedge - b.selvedge) +
         mean_length(a.bulk - b.bulk) + mean_length(a.layer - b.layer);
}
} // namespace

TEST(exact_edge_parts, together_they_lead_from_localized_to_the_method_edges)
{
  for (const Law law : {Law::linear, Law::biot})
    for (const char *load : {"strip-1", "shear-frame"})
    {
      const Resolved of("three-stiffness", load, law);
      const EdgeParts parts = of.parts();
      const CoarseModel edged({of.homogenized, &of.edges}, of.sheet, of.load,
                              Method("localized+edges"), law,
                              quads_per_cell(of.sheet, Resolved::refinement));
      const meshes::Points with = edged.upsample(edged.solve(0.01));
      EXPECT_LT(mean_length(of.localized_sheet() - parts.slip - parts.selvedge - parts.bulk -
                            parts.layer - with),
                1e-12)
        << load;
    }
}

// Two stripes have a centre of symmetry, three have none.
TEST(exact_edge_parts, a_cell_with_a_centre_of_symmetry_has_no_part_of_strain_gradients)
{
  const EdgeParts two   = Resolved("layered", "shear-frame", Law::linear).parts(),
                  three = Resolved("three-stiffness", "shear-frame", Law::linear).parts();
  const double unit     = 0.01 * 0.01; // strain x cell side
  EXPECT_LT(mean_length(two.bulk), 1e-9 * unit);
  EXPECT_GT(mean_length(three.bulk), 1e5 * 1e-9 * unit);
  EXPECT_GT(mean_length(two.slip), 1e-3 * unit);
  EXPECT_GT(mean_length(two.selvedge), 1e-3 * unit);
  EXPECT_GT(mean_length(two.layer), 1e-4 * unit);
}

TEST(invariant_edge_parts, the_constant_of_chi_in_the_file_changes_none)
{
  Resolved of("three-stiffness", "strip-1", Law::biot);
  const EdgeParts before = of.parts();
  of.homogenized.chi.rowwise() += 1e-3 * Eigen::Matrix<double, 1, 6>(1., -2., 0.5, 3., -1., 0.7);
  EXPECT_LT(distance(of.parts(), before), 1e-10 * 0.01);
}

TEST(order_edge_parts, under_biot_they_are_those_of_linear_theory_at_small_strain)
{
  const auto off = [](const double strain)
  {
    return distance(Resolved("layered", "shear-frame", Law::biot, strain).parts(),
                    Resolved("layered", "shear-frame", Law::linear, strain).parts());
  };
  EXPECT_NEAR(std::log2(off(2e-3) / off(1e-3)), 2., 0.1);
}
