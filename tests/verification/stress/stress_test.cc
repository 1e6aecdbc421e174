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
using tests::expect_no_promise_broken;

namespace
{
/// An axis whose error is its value.
StressAxis planted()
{
  StressAxis axis;
  axis.axis      = "planted";
  axis.of        = "a cell";
  axis.criterion = "the value itself";
  axis.limit     = 100.;
  axis.ladder    = {1., 10., 100., 1000., 10000.};
  axis.at        = [](const double value) -> StressAnswer {
    return {value, Eigen::MatrixXd::Constant(1, 1, value)};
  };
  return axis;
}

LimitRow climbed(const StressAxis &axis, const double longest = 10., const double owed = 0.)
{
  return climb(axis, owed, longest, [](const StressRow &) {});
}

std::optional<Verdict> verdict(const StressAxis &axis, const LimitRow &found,
                               const PublishedLimitRow *limit)
{
  return verdict_of(axis, found, owed_value(axis, limit));
}

/// The same but at one value.
StressAxis planted_at(const double where, const std::function<StressAnswer()> &what)
{
  StressAxis axis = planted();
  axis.at         = [=, before = axis.at](const double value)
  { return value == where ? what() : before(value); };
  return axis;
}

PublishedLimitRow published(const double reached)
{
  PublishedLimitRow row;
  row.reached  = reached;
  row.revision = "a1b2c3d";
  return row;
}
} // namespace

TEST(exact_stress, an_axis_ends_at_the_first_value_that_is_wrong)
{
  std::vector<StressRow> rungs;
  const LimitRow row =
    climb(planted(), 0., 10., [&](const StressRow &rung) { rungs.push_back(rung); });
  EXPECT_EQ(row.reached, 100.);
  EXPECT_EQ(row.end, 1000.);
  EXPECT_EQ(row.ended_by, "error");
  EXPECT_EQ(row.why, "error 1000 above 100");
  EXPECT_EQ(row.error, 1000.);
  ASSERT_EQ(rungs.size(), 4u);
  EXPECT_EQ(rungs[2].outcome, "right");
  EXPECT_EQ(rungs[3].outcome, row.why);
}

TEST(exact_stress, a_repetition_that_has_no_answer_ends_the_axis)
{
  StressAxis axis = planted();
  int n_asked     = 0;
  axis.at         = [&n_asked](const double value) -> StressAnswer
  {
    if (++n_asked > 4)
      throw std::runtime_error("not again");
    return {value, Eigen::MatrixXd::Constant(1, 1, value)};
  };
  const LimitRow row = climbed(axis);
  EXPECT_EQ(row.end, 100.);
  EXPECT_EQ(row.ended_by, "repetition");
}

TEST(exact_stress, an_axis_that_does_not_end_says_whether_more_was_tried)
{
  StressAxis axis = planted();
  axis.limit      = 1e6;
  EXPECT_EQ(climbed(axis).ended_by, "ladder");
  EXPECT_EQ(climbed(axis).reached, 10000.);
  axis.most     = 50.;
  axis.why_most = "not more than 50";
  EXPECT_EQ(climbed(axis).reached, 10.);
  EXPECT_EQ(climbed(axis).why, "not more than 50");
  EXPECT_FALSE(climbed(axis).end);
  EXPECT_EQ(climbed(planted(), -1.).ended_by, "cap");
}

TEST(tripwire_stress, refusals_numbers_that_are_not_finite_and_other_bits_end_an_axis)
{
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  const auto number         = [](const double error, const double value)
  {
    return planted_at(10.,
                      [=]() -> StressAnswer {
                        return {error, Eigen::MatrixXd::Constant(1, 1, value)};
                      });
  };
  for (const StressAxis &axis :
       {number(not_a_number, 0.), number(0., not_a_number), number(0., HUGE_VAL)})
  {
    const LimitRow row = climbed(axis);
    EXPECT_EQ(row.end, 10.);
    EXPECT_EQ(row.reached, 1.);
    EXPECT_EQ(row.why, "the answer is not finite");
    for (const std::string &field : fields_of_row(row))
      EXPECT_EQ(field.find("nan"), std::string::npos) << field;
  }
  const LimitRow refused =
    climbed(planted_at(10., []() -> StressAnswer { throw meshes::BadInput("triangle 3"); }));
  EXPECT_EQ(refused.ended_by, "solver");
  EXPECT_EQ(refused.why, "triangle 3");
  EXPECT_EQ(climbed(planted_at(10., []() -> StressAnswer { throw std::logic_error("oh"); })).why,
            "oh");
  const auto n = std::make_shared<int>(0);
  const LimitRow other_bits =
    climbed(planted_at(100.,
                       [=]() -> StressAnswer {
                         return {0., Eigen::MatrixXd::Constant(1, 1, ++*n)};
                       }));
  EXPECT_EQ(other_bits.ended_by, "repetition");
  EXPECT_FALSE(other_bits.reached);
}

TEST(tripwire_stress, a_limit_that_falls_fails_and_an_end_that_nothing_forbids_does_not)
{
  const LimitRow row = climbed(planted()); // right up to 100
  EXPECT_FALSE(verdict(planted(), row, nullptr));
  for (const auto &[reached, outcome] : {std::pair{10., Outcome::pass},
                                         {100., Outcome::pass},
                                         {1000., Outcome::fail},
                                         {10000., Outcome::fail}})
  {
    const PublishedLimitRow limit = published(reached);
    const auto said               = verdict(planted(), row, &limit);
    ASSERT_TRUE(said);
    EXPECT_EQ(said->outcome, outcome) << reached;
    EXPECT_EQ(said->kind, Kind::program);
    EXPECT_NE(said->derivation.find("a1b2c3d"), std::string::npos);
  }
  StressAxis promised = planted();
  promised.theory     = TheoryOfEnd::promises;
  promised.theory_end = 1000.;
  EXPECT_EQ(verdict(promised, row, nullptr)->outcome, Outcome::fail);
  promised.theory = TheoryOfEnd::estimates;
  EXPECT_FALSE(verdict(promised, row, nullptr));
  // Time stops no climb before what is owed; what a size leaves out is not asked.
  const PublishedLimitRow at_the_end = published(100.);
  EXPECT_EQ(climbed(planted(), -1., 100.).reached, 100.);
  EXPECT_EQ(verdict(planted(), climbed(planted(), -1., 100.), &at_the_end)->outcome, Outcome::pass);
  const PublishedLimitRow limit = published(1000.);
  EXPECT_EQ(verdict(planted(), climbed(planted(), -1.), &limit)->outcome, Outcome::inconclusive);
  StressAxis small = planted();
  small.most       = 10.;
  const auto asked = verdict(small, climbed(small), &limit);
  EXPECT_EQ(asked->outcome, Outcome::pass);
  EXPECT_NE(asked->claim.find("10"), std::string::npos) << asked->claim;
  EXPECT_EQ(asked->claim.find("1000"), std::string::npos) << asked->claim;
}

TEST(invariant_stress, ten_repetitions_agree_to_the_last_bit)
{
  for (const StressAxis &axis : sheet_axes(built_in_stiffnesses()[1]))
  {
    const Eigen::MatrixXd first = axis.at(axis.ladder[1]).values;
    for (int k = 0; k < 9; ++k)
      EXPECT_TRUE(axis.at(axis.ladder[1]).values == first) << axis.axis;
  }
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

TEST(bound_stress, no_axis_of_a_sheet_ends_earlier_than_theory_says)
{
  expect_no_promise_broken(sheet_axes(built_in_stiffnesses()[1]));
}

TEST(bound_stress, violent_coarse_motions_are_up_sampled_within_the_bound)
{
  for (const LimitRow &row : expect_no_promise_broken(
         localization_axes(tests::smooth_cell(tests::square_lattice(0.01), 8, 8), "smooth modes")))
    EXPECT_EQ(row.ended_by, "ladder") << row.axis;
}

TEST(order_stress, a_pulled_sheet_is_right_to_the_first_order_of_its_step)
{
  const StressAxis pull = scene_axes(built_in_stiffnesses()[1])[1];
  const double coarse = pull.at(pull.ladder[2]).error, fine = pull.at(pull.ladder[1]).error;
  EXPECT_NEAR(std::log2(coarse / fine), 1., 0.1);
}
