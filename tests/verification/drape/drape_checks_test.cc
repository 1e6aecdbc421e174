// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/drape/drape_verdicts.h"
#include "verification/drape/draped_cell.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
std::vector<Verdict> checks_of(const std::string &scene_name, const double turns = 0.)
{
  Scene scene = read_scene(std::string(CELLS) + "../scenes/" + scene_name + ".prm");
  scene.n1 = scene.n2 = 2;
  if (turns > 0.)
    scene.held = {{"left", {}, {Motion::Kind::rotate, {1., 0., 0.}, 2. * M_PI * turns, 10.}}};
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "chevron.prm");
  const DrapedCell draped(scene, cell,
                          homogenization::homogenized_cell(
                            cell, homogenization::homogenize(cell, {}, MPI_COMM_WORLD), ""),
                          Law::biot);
  return checks_of_scene(draped);
}
} // namespace

TEST(invariant_drape_checks, handles_start_at_rest_and_a_turned_sheet_is_the_turned_sheet)
{
  for (const char *name : {"pull"})
  {
    const std::vector<Verdict> checks = checks_of(name);
    ASSERT_EQ(checks.size(), 3u) << name;
    for (const Verdict &check : checks)
      EXPECT_EQ(check.outcome, Outcome::pass) << check.claim << " " << check.value;
    // A part s of the time makes 3 s^2 - 2 s^3 of the way: in the first thousandth 2.998e-6.
    EXPECT_NEAR(checks[0].value, 2.998e-3, 1e-6) << name;
    EXPECT_LT(checks[1].value, 1e-13) << name;
    EXPECT_LT(checks[2].value, 1e-12) << name;
  }
  EXPECT_EQ(checks_of("hang").size(), 2u); // nothing moves
  for (const double turns : {0.25, 20., 200.})
    EXPECT_NEAR(checks_of("pull", turns)[0].value, 2.998e-3, 1e-6) << turns;
}
