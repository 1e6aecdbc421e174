// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"
#include "homogenization/lint/cell_reading.h"
#include "verification/drape/drape_error_bar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A sheet of one cell, pulled during four hundredths of a second.
DrapeErrorBar bar_of(const double time_step, const TimeIntegration integration)
{
  Scene scene          = read_scene(std::string(CELLS) + "../scenes/pull.prm");
  scene.time_step      = time_step;
  scene.frame_interval = 0.02;
  scene.duration       = 0.04;
  scene.integration    = integration;
  const homogenization::UnitCell cell =
    homogenization::read_unit_cell(std::string(CELLS) + "layered.prm");
  const homogenization::Homogenization result =
    homogenization::homogenize(cell, {}, MPI_COMM_WORLD);
  const DrapedCell draped(scene, cell, homogenization::homogenized_cell(cell, result, ""),
                          Law::biot);
  return drape_error_bar(draped, Law::biot, 1, DrapeSchedule(scene), MPI_COMM_WORLD,
                         [](const int) {});
}
} // namespace

TEST(order_drape_error_bar, the_part_of_the_time_step_is_of_first_order)
{
  const DrapeErrorBar coarse = bar_of(0.01, TimeIntegration::implicit),
                      middle = bar_of(0.005, TimeIntegration::implicit),
                      fine   = bar_of(0.0025, TimeIntegration::implicit);
  ASSERT_EQ(coarse.halved_step.size(), 3u);
  ASSERT_EQ(fine.halved_step.size(), 3u);
  const double order = std::log(coarse.halved_step[2] / fine.halved_step[2]) / std::log(4.);
  EXPECT_NEAR(order, 1., 0.2);
  // The bar holds what three halvings change together.
  EXPECT_GT(coarse.of_time_step_at(2, coarse.fluctuation[2]),
            coarse.halved_step[2] + middle.halved_step[2] + fine.halved_step[2]);
  EXPECT_GT(fine.of_mesh[2], 0.);
  EXPECT_LT(fine.of_mesh[2], fine.fluctuation[2]);
  // What it is carried over with.
  EXPECT_DOUBLE_EQ(fine.of_mesh_at(2, 3. * fine.fluctuation[2]), 3. * fine.of_mesh[2]);
  EXPECT_TRUE(std::isnan(fine.of_mesh_at(3, 1.)));
}

TEST(exact_drape_error_bar, equilibria_have_no_time_step)
{
  const DrapeErrorBar bar = bar_of(0.01, TimeIntegration::equilibria);
  ASSERT_EQ(bar.halved_step.size(), 3u);
  EXPECT_EQ(bar.of_time_step_at(2, bar.fluctuation[2]), 0.);
  EXPECT_GT(bar.of_mesh[2], 0.);
}
