// SPDX-License-Identifier: MIT
// The error bar of the reference against distances that are measured apart from it.
#include "homogenization/lint/cell_reading.h"
#include "verification/reference/fine_reference.h"
#include "verification/strain/reference_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace homespun;
using namespace homespun::verification;

namespace
{
constexpr double largest = 0.15;

struct Measured
{
  double mean, max;
  double force; ///< over that of the first [-]
};

/// Distances of two discretizations of a sheet of one cell along a ladder of strains [m].
std::vector<Measured> distances(const homogenization::UnitCell &cell, const Load &load,
                                const std::vector<double> &strains, const ReferenceOptions &a,
                                const ReferenceOptions &b)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, 1, 1);
  FineReference first(sheet, cell.stiffness_of_phase(), a, MPI_COMM_WORLD);
  FineReference second(sheet, cell.stiffness_of_phase(), b, MPI_COMM_WORLD);
  first.start(load, Law::biot);
  second.start(load, Law::biot);
  std::vector<Measured> result;
  for (const double strain : strains)
  {
    const ReferenceStep one = first.advance(strain), other = second.advance(strain);
    const Eigen::VectorXd distance = (one.positions - other.positions).rowwise().norm();
    const double force             = force_along(load, sheet.sides(), one.forces);
    result.push_back(
      {distance.mean(), distance.maxCoeff(),
       std::abs(force - force_along(load, sheet.sides(), other.forces)) / std::abs(force)});
  }
  return result;
}

const homogenization::UnitCell &layers()
{
  static const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm");
  return cell;
}

ReferenceUncertainty bars_of_layers(const Load &load, const Law law)
{
  return {layers(), load,           {{law}, 1, 1, largest},
          nullptr,  MPI_COMM_WORLD, [](const std::string &) {}};
}
} // namespace

// A shear frame's P1 leaves P2 faster than a line through small strain and 5 %.
TEST(bound_reference_uncertainty, covers_the_distance_of_p1_from_p2_at_every_strain)
{
  const Load load("shear-frame");
  const ReferenceUncertainty bars      = bars_of_layers(load, Law::biot);
  const std::vector<double> strains    = {0.01, 0.05, 0.10, largest};
  const std::vector<Measured> measured = distances(layers(), load, strains, {1, 0}, {2, 0});
  for (std::size_t k = 0; k < strains.size(); ++k)
  {
    const ReferenceBar bar = bars.at(Law::biot, strains[k]);
    EXPECT_GT(bar.mean, measured[k].mean) << "at strain " << strains[k];
    EXPECT_GT(bar.max, measured[k].max) << "at strain " << strains[k];
    EXPECT_LT(bar.mean, 3. * measured[k].mean) << "at strain " << strains[k];
    EXPECT_GT(bar.force, measured[k].force) << "at strain " << strains[k];
    EXPECT_LT(bar.force, 3. * measured[k].force) << "at strain " << strains[k];
  }
}

TEST(exact_reference_uncertainty, is_what_was_measured_where_it_was_measured)
{
  const Load load("shear-frame");
  const ReferenceUncertainty bars      = bars_of_layers(load, Law::biot);
  const std::vector<Measured> measured = distances(layers(), load, {0.05, largest}, {1, 0}, {2, 1});
  // Both stop at 1e-9 of the forces, times 1e3 for the condition of a cell.
  EXPECT_NEAR(bars.at(Law::biot, 0.05).to_refined / measured[0].mean, 1., 1e-6);
  EXPECT_NEAR(bars.at(Law::biot, largest).to_refined / measured[1].mean, 1., 1e-6);
  // In between on a line per strain.
  const auto per_strain = [&](const double strain)
  { return bars.at(Law::biot, strain).to_refined / strain; };
  EXPECT_NEAR(per_strain(0.10) / (0.5 * (per_strain(0.05) + per_strain(largest))), 1., 1e-12);
}

// What a law does beyond linear theory is not known from another one.
TEST(exact_reference_uncertainty, the_linear_law_keeps_its_bar_per_strain)
{
  const Load load("shear-frame");
  const ReferenceUncertainty bars = bars_of_layers(load, Law::linear);
  EXPECT_NEAR(bars.at(Law::linear, 0.10).mean / bars.at(Law::linear, 0.01).mean, 10., 1e-12);
}

// Beside measured distances: F (|P1 − refined P2| + |P2 − refined P2| / (2^q − 1)), q = 1 where
// clamped and free edges meet, relative to the force, which no change of unit touches.
TEST(exact_reference_uncertainty, the_bar_of_the_force_is_that_of_its_own_distances)
{
  const Load load("shear-frame");
  const ReferenceUncertainty bars        = bars_of_layers(load, Law::biot);
  const std::vector<Measured> to_p2      = distances(layers(), load, {0.05}, {1, 0}, {2, 0}),
                              to_refined = distances(layers(), load, {0.05}, {1, 0}, {2, 1});
  // Forces of P1, P2 and refined P2 fall one after the other.
  const double between = to_refined[0].force - to_p2[0].force;
  ASSERT_GT(between, 0.);
  ASSERT_LT(between, to_p2[0].force);
  EXPECT_NEAR(bars.at(Law::biot, 0.05).force / (1.25 * (to_refined[0].force + between)), 1., 1e-5);
  const ReferenceBar bar = bars.at(Law::biot, 0.05);
  EXPECT_EQ((bar * 3.).force, bar.force);
}
