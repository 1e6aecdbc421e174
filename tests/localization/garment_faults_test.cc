// SPDX-License-Identifier: MIT
#include "tests/localization/garment_cases.h"
#include "tests/refusal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace homespun;
using namespace homespun::localization;
using tests::Garment;
using tests::Space;

TEST(tripwire_garment, faults_are_named)
{
  const Garment good = tests::two_panels();
  const auto refusal = [](const Garment &garment, const UpsamplerOptions &options = {})
  {
    return tests::refusal(
      [&] { Upsampler<3>(placed_garment(garment.cell, garment.coarse, garment.fine, options)); });
  };
  const auto expect = [](const std::string &text, const std::string &part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  EXPECT_EQ(refusal(good), "");
  Garment bad = good;
  bad.coarse.rest.vertices.row(3) += Eigen::RowVector2d(1e-4, 0.);
  expect(refusal(bad), "at rest; expected none: it was made from another coarse cloth");
  bad                         = good;
  bad.fine.coarse_triangle(7) = 100;
  expect(refusal(bad), "vertex 7 lies in triangle 100 of panel 0; expected one of 100 triangles");
  bad                     = good;
  bad.fine.cell_vertex(7) = 56;
  expect(refusal(bad), "vertex 7 names vertex 56");
  bad = good;
  bad.fine.seam_distance.conservativeResize(3);
  expect(refusal(bad), "do not all have one entry");
  bad = good;
  bad.cell.lattice.vectors *= 1.01;
  expect(refusal(bad), "lattice vectors differ");
  bad                        = good;
  bad.coarse.triangles(0, 0) = 5;
  expect(refusal(bad), "coarse cloth: rest vertex");
  UpsamplerOptions options;
  options.seam_fade = 5.;
  expect(refusal(good, options), "fades over 5 cell sides at seams; expected 0 to 4");
  options.seam_fade = std::nan("");
  expect(refusal(good, options), "expected 0 to 4");
  options                       = {};
  options.lift                  = Lift::identity;
  bad                           = good;
  bad.fine.grains.front().angle = 0.3;
  expect(refusal(bad, options), "of a cloth whose cells are turned");

  const Upsampler<3> upsampler(placed_garment(good.cell, good.coarse, good.fine));
  Upsampler<3>::Fine fine;
  Space current      = good.coarse.positions;
  current(7, 1)      = std::numeric_limits<double>::infinity();
  const auto refused = [&](const Space &positions)
  { return tests::refusal([&] { upsampler.upsample(positions, fine); }); };
  expect(refused(current), "coarse vertex 7: its position is not finite");
  expect(refused(Space::Zero(72, 3)), "have 72 rows; expected 66"); // 72 rest vertices, 66 in space
}

TEST(bound_garment, collapsed_coarse_triangles_give_finite_positions)
{
  const Garment garment = tests::skirt();
  Space current         = garment.coarse.positions;
  current.row(41)       = current.row(40); // an edge without length
  current.row(85)       = 0.5 * (current.row(84) + current.row(86));
  current.row(200).setConstant(1e6);
  EXPECT_TRUE(garment.upsampled(current).allFinite());
  EXPECT_TRUE(garment.upsampled(Space::Zero(440, 3)).allFinite());
  current = garment.coarse.positions;
  current.col(2).setZero();
  current.col(1).setZero(); // a line
  EXPECT_TRUE(garment.upsampled(current).allFinite());
}
