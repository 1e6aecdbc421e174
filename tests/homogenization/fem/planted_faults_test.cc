// SPDX-License-Identifier: MIT
// Faults of the constitutive law, planted into the cell that is solved: the closed form of the
// laminate, to which the suite holds C^H (exact_homogenize), must notice each. All of them pass
// symmetry, Hill-Mandel and the Voigt and Reuss bounds of the cell that was solved.
#include "tests/homogenization/cell/cells.h"

#include <gtest/gtest.h>

#include <functional>

using namespace homespun;
using namespace homespun::homogenization;

namespace
{
const std::vector<Phase> off_axis = {{"a", 10., 1., 0.3, 0.4, 30., 1., 1.},
                                     {"b", 6., 2., 0.2, 0.7, -55., 0.8, 1.}};

UnitCell laminated(const std::vector<Phase> &phases)
{
  return tests::cell_of(tests::square_lattice(0.01), 4, 4, phases, tests::halves);
}

/// Distance of C^H from the closed form where a fault was planted into every phase that is solved.
double distance_with(const std::vector<Phase> &phases, const std::function<void(Phase &)> &fault)
{
  std::vector<Phase> wrong = phases;
  for (Phase &phase : wrong)
    fault(phase);
  return tests::relative_difference(
    tests::solved(laminated(wrong), 1).stiffness,
    laminate_stiffness(laminated(phases).stiffness_of_phase(), {0.5, 0.5}));
}

/// The suite's tolerance is 1e-10; a fault must stand out far above that.
constexpr double noticed = 1e-2;
} // namespace

TEST(tripwire_homogenize, nothing_planted_is_no_difference)
{
  EXPECT_LT(distance_with(tests::soft_and_hard(), [](Phase &) {}), 1e-10);
  EXPECT_LT(distance_with(off_axis, [](Phase &) {}), 1e-10);
}

TEST(tripwire_homogenize, swapped_lame_constants_are_noticed)
{
  EXPECT_GT(distance_with(tests::soft_and_hard(),
                          [](Phase &phase)
                          {
                            const double lambda =
                                           phase.E1 * phase.nu12 / (1. - phase.nu12 * phase.nu12),
                                         mu  = phase.G12;
                            const double c11 = mu + 2. * lambda, c12 = mu;
                            phase.nu12 = c12 / c11;
                            phase.E1 = phase.E2 = c11 * (1. - phase.nu12 * phase.nu12);
                            phase.G12           = lambda;
                          }),
            noticed);
}

TEST(tripwire_homogenize, plane_strain_in_place_of_plane_stress_is_noticed)
{
  EXPECT_GT(distance_with(tests::soft_and_hard(),
                          [](Phase &phase)
                          {
                            phase.E1 = phase.E2 = phase.E1 / (1. - phase.nu12 * phase.nu12);
                            phase.nu12          = phase.nu12 / (1. - phase.nu12);
                          }),
            noticed);
}

TEST(tripwire_homogenize, a_lost_factor_of_two_in_shear_is_noticed)
{
  EXPECT_GT(distance_with(tests::soft_and_hard(), [](Phase &phase) { phase.G12 *= 0.5; }), noticed);
}

TEST(tripwire_homogenize, a_yarn_turned_the_wrong_way_is_noticed)
{
  EXPECT_GT(distance_with(off_axis, [](Phase &phase) { phase.angle = -phase.angle; }), noticed);
}

TEST(tripwire_homogenize, exchanged_axes_of_a_yarn_are_noticed)
{
  EXPECT_GT(distance_with(off_axis,
                          [](Phase &phase)
                          {
                            phase.nu12 *= phase.E2 / phase.E1;
                            std::swap(phase.E1, phase.E2);
                          }),
            noticed);
}

TEST(tripwire_homogenize, a_forgotten_thickness_is_noticed)
{
  EXPECT_GT(distance_with(off_axis, [](Phase &phase) { phase.thickness = 1.; }), noticed);
}
