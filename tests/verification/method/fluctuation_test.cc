// SPDX-License-Identifier: MIT
// What a sheet fluctuates by, and what the place of the cut decides.
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/method/anchor_choice.h"
#include "verification/method/fluctuation.h"
#include "verification/method/sheet_reading.h"

#include <gtest/gtest.h>

#include <functional>

using namespace homespun;
using namespace homespun::verification;

namespace
{
struct Striped
{
  homogenization::UnitCell cell = homogenization::read_unit_cell(CELLS "layered.prm");
  meshes::HomogenizedCell homogenized;
  meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 4, 4);

  /// @param change of the phases
  explicit Striped(const std::function<void(homogenization::Phase &, std::size_t)> &change = {})
  {
    for (std::size_t p = 0; change && p < cell.phases.size(); ++p)
      change(cell.phases[p], p);
    homogenization::HomogenizationOptions p1;
    p1.order    = 1;
    homogenized = homogenization::homogenized_cell(
      cell, homogenization::homogenize(cell, p1, MPI_COMM_WORLD), "");
  }
};
} // namespace

TEST(exact_fluctuation, chi_says_under_which_strains_a_cell_fluctuates)
{
  const auto strains_of = [](const Striped &striped)
  {
    std::string all;
    for (int a = 0; a < 3; ++a)
      all += fluctuates(striped.homogenized, Eigen::Vector3d::Unit(a)) ? "y" : "n";
    return all;
  };
  EXPECT_EQ(strains_of(Striped()), "yyy");
  EXPECT_EQ(strains_of(Striped(
              [](homogenization::Phase &phase, const std::size_t p) { // unlike in shear alone
                phase.E1 = phase.E2 = 1e6;
                phase.G12           = 3e5 * (1. + static_cast<double>(p));
              })),
            "nny");
  EXPECT_EQ(strains_of(Striped([](homogenization::Phase &phase, std::size_t)
                               { phase.E1 = phase.E2 = 1e6, phase.G12 = 1e6 / 2.6; })),
            "nnn");
}

TEST(exact_fluctuation, in_an_infinite_cloth_it_is_the_distance_from_the_affine_motion)
{
  const Striped striped;
  const meshes::Sheet one = meshes::tile(striped.cell.mesh, striped.cell.lattice, 1, 1);
  const Load load("periodic-22");
  meshes::Points positions = one.mesh.vertices * load.gradient(0.01).transpose();
  positions.col(1).array() += 2e-6;
  FluctuationMeasure measure(striped.homogenized, one, load);
  const Fluctuation found = measure.at(Law::biot, 0.01, positions);
  EXPECT_NEAR(found.mean, 2e-6, 1e-15);
  EXPECT_NEAR(found.bar, 0., 1e-15);
}

// A sheet of one stiffness does not fluctuate; what is found is the discretization of the measure,
// which its bar covers.
TEST(bound_fluctuation, a_homogeneous_sheet_has_none_beyond_its_bar)
{
  const Striped striped;
  for (const char *name : {"strip-1", "strip-2", "shear-frame"})
  {
    const Load load(name);
    const Quads quads = quads_per_cell(striped.sheet, 8);
    const CoarseModel resolved({striped.homogenized}, striped.sheet, load, Method("affine"),
                               Law::biot, quads);
    const shell::Positions<2> solved = resolved.solve(0.05).positions;
    const SheetReading reading(striped.sheet, quads);
    FluctuationMeasure measure(striped.homogenized, striped.sheet, load);
    const Fluctuation found =
      measure.at(Law::biot, 0.05, reading.at_fine_vertices(Law::biot, solved).positions);
    EXPECT_GT(found.mean, 0.);
    EXPECT_LE(found.mean, found.bar) << name;
    EXPECT_LE(found.mean, 1e-2 * 0.05 * 0.01) << name; // a hundredth of strain x cell side
  }
}

// Stripes pulled across: with the mean of chi in place of the corner as its zero nothing is gained,
// so another anchor must do much worse than the corner.
TEST(tripwire_fluctuation, another_place_of_the_cut_changes_the_error_and_is_told)
{
  const Striped striped;
  const Load load("strip-2");
  const CoarseModel coarse({striped.homogenized}, striped.sheet, load, Method("localized"),
                           Law::biot);
  const shell::Positions<2> solved = coarse.solve(0.01).positions;
  const LocalState state           = SheetReading(striped.sheet, quads_per_cell(striped.sheet, 1))
                             .at_fine_vertices(Law::biot, solved);
  const meshes::Points reference       = localized(state, striped.homogenized, striped.sheet);
  const meshes::HomogenizedCell &whole = striped.homogenized;
  const AnchorChoice choice =
    errors_of_other_anchors(whole, coarse.mesh(), striped.sheet, Law::biot, solved, reference);
  EXPECT_LT(choice.smallest, 0.05 * choice.largest);
  EXPECT_GT(choice.largest, 0.1 * 0.01 * 0.01); // a tenth of strain x cell side
  EXPECT_NE(note_of_anchor(choice, 1e-6, 2e-5, 1e-7).find("where the cell is cut"),
            std::string::npos);
  EXPECT_EQ(note_of_anchor(choice, 1e-6, 2e-5, choice.largest), "");
}
