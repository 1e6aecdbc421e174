// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "tests/localization/localization_cases.h"
#include "tests/verification/stress/checks.h"
#include "verification/record/table.h"
#include "verification/stress/stress_localization.h"
#include "verification/stress/stress_sheet_axes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

using namespace homespun;
using namespace homespun::verification;
using tests::expect_all_pass;

namespace
{
const Limit one_at_most = {1., "[-]", "a limit of this test"};

/// A case that ends as told, in memory.
StressCase planted(const StressCase::Run &run, const Repeats repeats = Repeats::same_bits)
{
  return {"planted", "a case", "finite", one_at_most, repeats, run};
}

StressCase planted(const double figure, const double number)
{
  return planted(
    [=](unsigned int) -> StressAnswer {
      return {figure, Eigen::MatrixXd::Constant(1, 1, number)};
    });
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
} // namespace

TEST(tripwire_stress, a_case_beyond_its_limit_fails)
{
  EXPECT_EQ(run_case(planted(0.9, 0.), 3).verdict, Outcome::pass);
  EXPECT_EQ(run_case(planted(1.1, 0.), 3).verdict, Outcome::fail);
}

TEST(tripwire_stress, a_number_that_is_not_finite_fails_and_reaches_no_file)
{
  for (const StressCase &one :
       {planted(0., not_a_number), planted(not_a_number, 0.), planted(0., HUGE_VAL)})
  {
    const StressRow row = run_case(one, 2);
    EXPECT_EQ(row.verdict, Outcome::fail);
    EXPECT_EQ(row.outcome, "not finite");
    for (const std::string &field : fields_of_row(row))
      EXPECT_EQ(field.find("nan"), std::string::npos) << field;
  }
}

TEST(tripwire_stress, a_refusal_and_an_error_are_failures_that_are_told)
{
  const StressRow refused = run_case(
    planted([](unsigned int) -> StressAnswer { throw meshes::BadInput("triangle 3"); }), 2);
  EXPECT_EQ(refused.outcome, "refused: triangle 3");
  EXPECT_EQ(refused.verdict, Outcome::fail);
  const StressRow error = run_case(
    planted([](unsigned int) -> StressAnswer { throw std::logic_error("triangle 3"); }), 2);
  EXPECT_EQ(error.outcome, "error: triangle 3");
  EXPECT_EQ(error.verdict, Outcome::fail);
}

TEST(tripwire_stress, repetitions_without_random_numbers_must_agree_to_the_last_bit)
{
  const auto run = [](const unsigned int seed) -> StressAnswer {
    return {0., Eigen::MatrixXd::Constant(1, 1, 1. + (seed == 2 ? 1e-16 * 4. : 0.))};
  };
  EXPECT_EQ(run_case(planted(run), 2).verdict, Outcome::pass);
  EXPECT_EQ(run_case(planted(run), 3).verdict, Outcome::fail);
  EXPECT_EQ(run_case(planted(run, Repeats::twice), 3).repeats, 2);
  EXPECT_EQ(run_case(planted(run, Repeats::once), 3).repeats, 1);
  EXPECT_EQ(run_case(planted(run, Repeats::with_seeds), 3).verdict, Outcome::pass);
}

TEST(tripwire_stress, the_largest_figure_of_all_repetitions_counts)
{
  const StressRow row = run_case(planted(
                                   [](const unsigned int seed) -> StressAnswer {
                                     return {seed == 1 ? 7. : 0.5, Eigen::MatrixXd::Zero(1, 1)};
                                   },
                                   Repeats::with_seeds),
                                 3);
  EXPECT_EQ(row.figure, 7.);
  EXPECT_EQ(row.verdict, Outcome::fail);
}

TEST(tripwire_stress, one_failing_case_fails_its_group_and_no_other)
{
  StressCase good                     = planted(0., 0.);
  good.row.group                      = "sound, with a comma";
  const StressRow bad                 = run_case(planted(2., 0.), 1);
  const std::vector<Verdict> verdicts = stress_verdicts({run_case(good, 1), bad, bad});
  ASSERT_EQ(verdicts.size(), 2u);
  EXPECT_EQ(verdicts[0].outcome, Outcome::pass);
  EXPECT_EQ(verdicts[1].outcome, Outcome::fail);
  EXPECT_EQ(verdicts[1].value, 2.);
  for (const Verdict &verdict : verdicts)
  {
    EXPECT_EQ(verdict.kind, Kind::program);
    EXPECT_FALSE(verdict.derivation.empty());
  }
}

TEST(tripwire_stress, a_limit_without_a_derivation_is_no_limit)
{
  EXPECT_THROW(StressCase("planted", "a case", "finite", {1., "[-]", ""}, Repeats::once, {}),
               std::logic_error);
}

TEST(tripwire_stress, energy_that_a_handle_brings_in_is_seen)
{
  const meshes::ClothMesh mesh = hanging_mesh(4);
  shell::Cloth cloth           = sheet_cloth(mesh, built_in_stiffnesses()[0], {20});
  cloth.prescribe(20, mesh.positions.row(20) + Eigen::RowVector3d(0., 0., 0.1));
  EXPECT_GT(largest_energy_growth(cloth, 0.01, 1), 1e-2);
}

namespace
{
/// The forces of a membrane of half the stiffness whose energy it states: stretching gains energy
/// from nowhere.
class ForcesOfAnother : public shell::Term
{
public:
  ForcesOfAnother(const meshes::ClothMesh &mesh, const Eigen::Matrix3d &D)
      : stated(shell::membrane_term(mesh, {D}))
      , acting(shell::membrane_term(mesh, {0.5 * D}))
  {
  }

  std::string name() const override
  {
    return "forces of another membrane";
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    acting->couple(pairs);
  }

  void attach(const shell::BlockMatrix &matrix) override
  {
    acting->attach(matrix);
  }

  void begin_step(const shell::StepStart &start) override
  {
    stated->begin_step(start);
    acting->begin_step(start);
  }

  double energy(const shell::Vectors &positions) const override
  {
    return stated->energy(positions);
  }

  void add_gradient(const shell::Vectors &positions, shell::Vectors &gradient) const override
  {
    acting->add_gradient(positions, gradient);
  }

  void add_derivatives(const shell::Vectors &positions, const shell::Hessian kind,
                       shell::Vectors &gradient, shell::BlockMatrix &matrix) const override
  {
    acting->add_derivatives(positions, kind, gradient, matrix);
  }

  bool has_discrete_gradient() const override
  {
    return true;
  }

  void add_discrete_gradient(const shell::Vectors &old, const shell::Vectors &positions,
                             shell::Vectors &gradient, shell::VertexMatrix &jacobian) const override
  {
    acting->add_discrete_gradient(old, positions, gradient, jacobian);
  }

  std::size_t bytes() const override
  {
    return acting->bytes();
  }

private:
  const std::unique_ptr<shell::Term> stated, acting;
};
} // namespace

TEST(tripwire_stress, energy_that_forces_bring_in_which_are_not_its_gradient_is_seen)
{
  const meshes::ClothMesh mesh = hanging_mesh(4);
  const SheetStiffness sheet   = built_in_stiffnesses()[0];
  for (const bool is_wrong : {false, true})
  {
    // This one solves for the forces as they are: the others would look for a lower energy, find
    // none and refuse.
    shell::ClothOptions options;
    options.integrator = shell::Integrator::conserving;
    shell::Cloth cloth(mesh.positions, shell::lumped_masses(mesh, {sheet.areal_density}), {},
                       options);
    if (is_wrong)
      cloth.add(std::make_unique<ForcesOfAnother>(mesh, sheet.D));
    else
      cloth.add(shell::membrane_term(mesh, {sheet.D}));
    cloth.set_state(mesh.positions, 5. * mesh.positions, 0.); // it flies apart
    const double growth = largest_energy_growth(cloth, 1e-4, 10);
    if (is_wrong)
      EXPECT_GT(growth, 1e-3);
    else
      EXPECT_LE(growth, energy_round_off);
  }
}

TEST(bound_stress, the_turn_per_step_ends_no_earlier_than_theory_says)
{
  expect_all_pass(spin_cases({built_in_stiffnesses()[1]}));
}

TEST(bound_stress, time_steps_of_ten_microseconds_to_a_second_do_not_raise_the_energy)
{
  expect_all_pass(time_step_cases({built_in_stiffnesses()[1]}));
}

TEST(bound_stress, violent_coarse_motions_are_up_sampled_within_the_bound)
{
  expect_all_pass(
    localization_cases(tests::smooth_cell(tests::square_lattice(0.01), 8, 8), "smooth modes"));
}
