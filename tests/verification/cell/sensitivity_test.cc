// SPDX-License-Identifier: MIT
// Derivatives of C^H and D^H by what the phases are made of, against differences of whole
// homogenizations, and the bars that inputs leave, against samples.
#include "meshes/plain/errors.h"
#include "tests/homogenization/cell/cells.h"
#include "verification/cell/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace homespun;
using namespace homespun::verification;
using homogenization::MaterialConstant;
using homogenization::Phase;
using homogenization::UnitCell;

namespace
{
/// A yarn at an angle in a film, on a skewed lattice.
UnitCell yarn_in_film()
{
  UnitCell cell = tests::cell_of(tests::skewed_lattice(), 8, 8,
                                 {homogenization::isotropic("film", 1e6, 0.35, 5e-4, 400.),
                                  {"yarn", 2e7, 2e6, 0.3, 7e5, 25., 8e-4, 700.}},
                                 [](const double f1, const double f2)
                                 {
                                   const int i = static_cast<int>(8. * f1),
                                             j = static_cast<int>(8. * f2);
                                   return (i > 1 && i < 5 && j > 2 && j < 5) || (i == 4 && j > 4);
                                 });
  cell.file     = "yarn.prm";
  return cell;
}

AssessedCell assessed(const UnitCell &cell)
{
  AssessedCell its;
  const auto silent = [](const std::string &) {};
  its.bracket       = bracket_of(cell, {}, silent);
  its.bending       = bending_of(cell, {}, silent);
  return its;
}

/// C and D as they would be written.
std::array<Eigen::Matrix3d, 2> both_of(const UnitCell &cell)
{
  const AssessedCell its = assessed(cell);
  return {its.bracket->bracket->stiffness, its.bending->bracket->stiffness};
}

UnitCell with(UnitCell cell, const std::string &group, const MaterialConstant constant,
              const double change)
{
  for (Phase &phase : cell.phases)
    if (phase.name == group)
      phase = homogenization::changed(phase, constant,
                                      homogenization::value_of(phase, constant) + change);
  return cell;
}

/// How far derivatives are from central differences, relative to the largest entry, at a step that
/// leaves them 1e-4^2 of truncation and 1e-12/1e-4 of round-off.
void expect_differences(const UnitCell &cell)
{
  const std::vector<Sensitivity> all = sensitivities(cell, assessed(cell));
  ASSERT_FALSE(all.empty());
  for (const Sensitivity &its : all)
  {
    const double step =
      1e-4 * (its.constant == MaterialConstant::angle ? 57. : std::abs(its.value));
    const auto more = both_of(with(cell, its.group, its.constant, step)),
               less = both_of(with(cell, its.group, its.constant, -step));
    for (std::size_t k = 0; k < 2; ++k)
    {
      const Eigen::Matrix3d difference = (more[k] - less[k]) / (2. * step);
      EXPECT_LT(tests::relative_difference(k == 0 ? its.of_C : its.of_D, difference), 1e-6)
        << (k == 0 ? "C by " : "D by ") << its.group << "." << name_of(its.constant);
    }
  }
}

std::string refusal(const std::string &text)
{
  try
  {
    uncertain_inputs(yarn_in_film(), text);
  }
  catch (const meshes::BadInput &fault)
  {
    return fault.what();
  }
  return "";
}
} // namespace

TEST(derivative_sensitivity, entries_change_as_differences_of_whole_homogenizations_say)
{
  const UnitCell cell = yarn_in_film();
  EXPECT_EQ(sensitivities(cell, assessed(cell)).size(), 3u + 6u);
  expect_differences(cell);
}

TEST(derivative_sensitivity, phases_that_differ_by_the_angles_of_the_mesh_change_together)
{
  UnitCell cell = yarn_in_film();
  cell.phases.push_back(cell.phases[1]);
  cell.phases[2].angle += 40.;
  for (int t = 0; t < cell.mesh.n_triangles(); t += 3)
    if (cell.mesh.material(t) == 1)
      cell.mesh.material(t) = 2;
  EXPECT_EQ(sensitivities(cell, assessed(cell)).size(), 3u + 6u);
  expect_differences(cell);
}

TEST(derivative_sensitivity, holes_bend_freely_and_so_do_their_derivatives)
{
  UnitCell cell = yarn_in_film();
  int n_kept    = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (t / 2 != 8 * 6 + 1 && t / 2 != 8 * 4 + 6)
    {
      cell.mesh.material(n_kept)        = cell.mesh.material(t);
      cell.mesh.triangles.row(n_kept++) = cell.mesh.triangles.row(t).eval();
    }
  cell.mesh.triangles.conservativeResize(n_kept, 3);
  cell.mesh.material.conservativeResize(n_kept);
  expect_differences(cell);
}

// As far as an isotropic and a very anisotropic phase may go, whichever axis is the stiff one.
TEST(exact_sensitivity, derivatives_by_constants_are_those_of_differences)
{
  for (const Phase &phase : {homogenization::isotropic("film", 1e6, 0.49, 1e-4, 1.),
                             homogenization::isotropic("foam", 1e6, -0.9, 1e-4, 1.),
                             Phase{"across", 1e5, 1e9, 3e-5, 5e4, 20., 5e-4, 400.},
                             Phase{"along", 1e9, 1e5, 0.3, 5e4, 110., 5e-4, 400.},
                             Phase{"near the end of nu", 1e5, 1e8, 0.0284, 5e4, 0., 5e-4, 400.}})
  {
    const UnitCell cell =
      tests::cell_of(tests::square_lattice(1.), 2, 2, {phase}, [](double, double) { return 0; });
    const Verdict check = constants_check(cell);
    EXPECT_EQ(check.outcome, Outcome::pass) << phase.name << ": " << check.value;
    EXPECT_LT(check.value, 1e-9) << phase.name;
  }
}

TEST(exact_sensitivity, moduli_and_thicknesses_scale_stiffness)
{
  const UnitCell cell               = yarn_in_film();
  AssessedCell its                  = assessed(cell);
  const std::vector<Verdict> checks = scaling_checks(cell, its);
  ASSERT_EQ(checks.size(), 2u);
  for (const Verdict &check : checks)
  {
    EXPECT_EQ(check.outcome, Outcome::pass) << check.claim;
    EXPECT_LT(check.value, 1e-11) << check.claim;
  }
  // A plate about its face, t^3/3.
  its.bending->bracket->stiffness *= 4.;
  EXPECT_EQ(scaling_checks(cell, its)[0].outcome, Outcome::pass);
  EXPECT_EQ(scaling_checks(cell, its)[1].outcome, Outcome::fail);
}

namespace
{
/// By how much the largest change among samples misses the bar of an entry, relative, the worst
/// entry. Among the first samples are the corners of the box, where first order has its maximum.
double missed_by(const std::string &text, const int n_samples)
{
  const UnitCell cell                      = yarn_in_film();
  const std::vector<UncertainInput> inputs = uncertain_inputs(cell, text);
  const int n_corners                      = 1 << inputs.size();
  const InputBars bars       = input_bars(sensitivities(cell, assessed(cell)), inputs);
  const auto exact           = both_of(cell);
  Eigen::Matrix3d largest[2] = {Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> inside(-1., 1.);
  for (int sample = 0; sample < n_samples; ++sample)
  {
    UnitCell other = cell;
    for (std::size_t k = 0; k < inputs.size(); ++k)
    {
      const double part = sample < n_corners ? (sample >> k & 1 ? 1. : -1.) : inside(generator);
      other             = with(other, inputs[k].group, inputs[k].constant, part * inputs[k].range);
    }
    const auto its = both_of(other);
    for (std::size_t k = 0; k < 2; ++k)
      largest[k] = largest[k].cwiseMax((its[k] - exact[k]).cwiseAbs());
  }
  return std::max((largest[0].cwiseQuotient(bars.of_C).array() - 1.).abs().maxCoeff(),
                  (largest[1].cwiseQuotient(bars.of_D).array() - 1.).abs().maxCoeff());
}
} // namespace

TEST(bound_input_bars, two_hundred_samples_stay_within_the_bar_and_reach_it_to_first_order)
{
  const auto inputs =
    uncertain_inputs(yarn_in_film(), "film.E=1%, yarn.E1=1%,film.thickness=1%,yarn.angle=0.5");
  ASSERT_EQ(inputs.size(), 4u);
  EXPECT_NEAR(inputs[0].range, 1e4, 1e-9);
  EXPECT_NEAR(inputs[3].range, 0.5, 1e-15);
  // What first order leaves out is of second order: of the bar, a tenth in a tenth of the ranges.
  const double wide = missed_by("film.E=1%,yarn.E1=1%,film.thickness=1%,yarn.angle=0.5", 200);
  const double narrow =
    missed_by("film.E=0.1%,yarn.E1=0.1%,film.thickness=0.1%,yarn.angle=0.05", 200);
  EXPECT_LT(wide, 0.2);
  EXPECT_NEAR(narrow / wide, 0.1, 0.02);
}

TEST(tripwire_input_bars, unknown_phases_and_constants_are_named)
{
  EXPECT_EQ(refusal("film.E=20%"), "");
  EXPECT_EQ(refusal("flim.E=20%"), "--uncertain: names the phase `flim`, which yarn.prm does not "
                                   "have; expected one of `film`, `yarn`");
  EXPECT_NE(refusal("yarn.E=20%")
              .find("has no constant `E`; expected one of E1, E2, nu12, G12, "
                    "thickness, angle"),
            std::string::npos);
  for (const char *text :
       {"film.E=", "film.E=-3%", "film.E=nan", "film.E=2 3", "film.E=inf", "yarn.angle=10%"})
    EXPECT_NE(refusal(text).find("expected a positive range"), std::string::npos) << text;
  EXPECT_NE(refusal("film").find("expected `group.constant=range`"), std::string::npos);
  EXPECT_NE(refusal("film.E=1%,film.E=2%").find("given twice"), std::string::npos);
  EXPECT_NE(refusal("a.E=1%,b.E=2%").find("`b`"), std::string::npos); // all faults at once
}
