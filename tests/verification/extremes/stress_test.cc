// SPDX-License-Identifier: MIT
#include "meshes/plain/errors.h"
#include "shell/terms/membrane_term.h"
#include "tests/verification/extremes/program_cases.h"
#include "verification/extremes/stress_cases.h"
#include "verification/record/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A case that ends as told, in memory.
StressCase planted(const double figure, const double number,
                   const ExpectedEnd ending = ExpectedEnd::finite)
{
  StressCase one;
  one.group      = "planted";
  one.name       = "a case";
  one.ending     = ending;
  one.limit      = 1.;
  one.names      = "triangle 3";
  one.derivation = "a limit of this test";
  one.run        = [=](unsigned int) -> StressAnswer {
    return {figure, Eigen::MatrixXd::Constant(1, 1, number)};
  };
  return one;
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect_all_pass(const std::vector<StressCase> &cases, const std::string &part_of_name)
{
  int n = 0;
  for (const StressCase &one : cases)
    if (one.name.find(part_of_name) != std::string::npos)
    {
      ++n;
      const StressResult result = run_case(one, 2);
      EXPECT_EQ(result.verdict, Outcome::pass)
        << one.name << ": " << result.outcome << ", " << result.figure;
    }
  EXPECT_GT(n, 0) << part_of_name;
}
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
    const StressResult result = run_case(one, 2);
    EXPECT_EQ(result.verdict, Outcome::fail);
    EXPECT_EQ(result.outcome, "not finite");
    for (const std::string &field : fields_of_row(stress_row(one, result)))
      EXPECT_EQ(field.find("nan"), std::string::npos) << field;
  }
}

TEST(tripwire_stress, a_refusal_must_name_the_fault)
{
  StressCase one = planted(0., 0., ExpectedEnd::refused);
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::fail); // it did not refuse
  one.run = [](unsigned int) -> StressAnswer { throw meshes::BadInput("triangle 3: has no area"); };
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::pass);
  one.ending = ExpectedEnd::finite;
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::fail);
  one     = planted(0., 0., ExpectedEnd::refused);
  one.run = [](unsigned int) -> StressAnswer { throw meshes::BadInput("something is wrong"); };
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::fail);
  one.run = [](unsigned int) -> StressAnswer { throw std::logic_error("triangle 3"); };
  EXPECT_EQ(run_case(one, 2).outcome, "error: triangle 3");
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::fail);
}

TEST(tripwire_stress, repetitions_without_random_numbers_must_agree_to_the_last_bit)
{
  StressCase one = planted(0., 0.);
  one.run        = [](const unsigned int seed) -> StressAnswer {
    return {0., Eigen::MatrixXd::Constant(1, 1, 1. + (seed == 2 ? 1e-16 * 4. : 0.))};
  };
  EXPECT_EQ(run_case(one, 2).verdict, Outcome::pass);
  EXPECT_EQ(run_case(one, 3).verdict, Outcome::fail);
  one.is_random = true;
  EXPECT_EQ(run_case(one, 3).verdict, Outcome::pass);
}

TEST(tripwire_stress, the_largest_figure_of_all_repetitions_counts)
{
  StressCase one = planted(0., 0.);
  one.is_random  = true;
  one.run        = [](const unsigned int seed) -> StressAnswer {
    return {seed == 1 ? 7. : 0.5, Eigen::MatrixXd::Zero(1, 1)};
  };
  const StressResult result = run_case(one, 3);
  EXPECT_EQ(result.figure, 7.);
  EXPECT_EQ(result.verdict, Outcome::fail);
}

TEST(tripwire_stress, one_failing_case_fails_its_group_and_no_other)
{
  StressCase bad = planted(2., 0.), good = planted(0., 0.);
  good.group = "sound, with a comma";
  const std::vector<Verdict> verdicts =
    stress_verdicts({stress_row(good, run_case(good, 1)), stress_row(bad, run_case(bad, 1)),
                     stress_row(bad, run_case(bad, 1))});
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
  StressCase one = planted(0., 0.);
  one.derivation.clear();
  EXPECT_THROW(stress_row(one, run_case(one, 1)), std::logic_error);
}

TEST(invariant_stress, every_limit_of_every_case_says_where_it_comes_from)
{
  const std::vector<SheetStiffness> sheets          = built_in_stiffnesses();
  const std::vector<homogenization::UnitCell> moved = built_in_cells();
  int n                                             = 0;
  for (const std::vector<StressCase> &some :
       {cell_cases(moved, {2, Eigen::Matrix3d::Identity()}, 2, 1000000), time_step_cases(sheets),
        stiffness_cases(), start_cases(sheets), mesh_cases(sheets[0]), rotation_cases(sheets),
        motion_cases(sheets), scene_cases(sheets[0]),
        localization_cases({smooth_cell()}, {"smooth"})})
    for (const StressCase &one : some)
    {
      ++n;
      EXPECT_FALSE(stress_row(one, {"finite", 0., Outcome::pass, 1, 0.}).derivation.empty());
    }
  EXPECT_GT(n, 500);
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

TEST(bound_stress, sheets_that_spin_keep_what_their_integrator_keeps_and_turn)
{
  expect_all_pass(spin_cases({built_in_stiffnesses()[1]}), "thrown; 5 ms");
}

TEST(bound_stress, time_steps_of_ten_microseconds_to_a_second_do_not_raise_the_energy)
{
  expect_all_pass(time_step_cases({built_in_stiffnesses()[1]}), "random velocities");
}

TEST(bound_stress, unsound_meshes_are_refused_and_sound_ones_hang)
{
  expect_all_pass(mesh_cases(built_in_stiffnesses()[0]), "");
}

TEST(bound_stress, violent_coarse_motions_are_up_sampled_within_the_bound)
{
  expect_all_pass(localization_cases({smooth_cell()}, {"smooth modes"}), "");
}

TEST(bound_stress, turned_and_crushed_triangles_end_as_theory_says)
{
  expect_all_pass(rotation_cases(with_twins_of_yarn(built_in_stiffnesses())), "");
}

TEST(tripwire_stress, a_cloth_that_falls_through_the_sphere_is_seen_at_every_time_step)
{
  int n = 0;
  for (const StressCase &one : scene_cases(built_in_stiffnesses()[0], Sphere::missing))
    if (one.name.find("falls on a sphere") != std::string::npos)
    {
      const StressResult result = run_case(one, 1);
      EXPECT_EQ(result.verdict, Outcome::fail) << one.name << ": " << result.figure;
      ++n;
    }
  EXPECT_EQ(n, 12);
}
