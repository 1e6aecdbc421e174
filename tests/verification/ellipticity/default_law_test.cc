// SPDX-License-Identifier: MIT
// Which law a cell has where none is asked for, against the closed form of the loss.
#include "homogenization/lint/cell_reading.h"
#include "verification/ellipticity/default_law.h"
#include "verification/record/main_reference.h"

#include <gtest/gtest.h>

using namespace homespun;
using namespace homespun::verification;

namespace
{
/// A phase of nu = 0.1, E2 = 0.7 E1, with a ratio of E1 to G12, its axis 1 at an angle [deg].
homogenization::Phase phase_of(const double ratio, const double angle = 0.)
{
  homogenization::Phase phase;
  phase.name      = "yarn";
  phase.E1        = 1e8;
  phase.E2        = 0.7e8;
  phase.nu12      = 0.1;
  phase.G12       = phase.E1 / ratio;
  phase.thickness = 1e-3;
  phase.angle     = angle;
  return phase;
}

homogenization::UnitCell cell_of(const std::vector<homogenization::Phase> &phases)
{
  homogenization::UnitCell cell;
  cell.name   = "cell";
  cell.phases = phases;
  cell.mesh.material.resize(static_cast<int>(phases.size()));
  for (std::size_t p = 0; p < phases.size(); ++p)
  {
    cell.phases[p].name += std::to_string(p); // those of one name differ in their angle alone
    cell.mesh.material(static_cast<int>(p)) = static_cast<int>(p);
  }
  return cell;
}
} // namespace

TEST(exact_default_law, the_strain_of_loss_is_that_of_the_ratio_of_moduli_in_any_position)
{
  for (const double ratio : {8., 23.9, 24.1, 583.})
    for (const double angle : {0., 31., 90.})
    {
      const PhaseLoss loss = loss_of_biot(phase_of(ratio, angle));
      EXPECT_NEAR(loss.strain, 4. / (ratio - 4.), 1e-6 * loss.strain);
      EXPECT_NEAR(loss.ratio, ratio, 1e-9 * ratio);
      EXPECT_EQ(axis_text(loss), "its axis 1");
    }
  // The stiffer axis is the second one.
  homogenization::Phase other = phase_of(583.);
  std::swap(other.E1, other.E2);
  other.nu12 *= 0.7; // so that nu12 / E1 = nu21 / E2 stays
  EXPECT_EQ(axis_text(loss_of_biot(other)), "its axis 2");
  EXPECT_NEAR(loss_of_biot(other).strain, 4. / 579., 1e-8);
}

TEST(exact_default_law, yarn_takes_over_where_biot_is_lost_before_a_fifth)
{
  EXPECT_EQ(default_law(cell_of({phase_of(24.1)})), Law::yarn);
  EXPECT_EQ(default_law(cell_of({phase_of(23.9)})), Law::biot);
  // The worst phase decides; one that is alike in all directions never does.
  homogenization::Phase alike = phase_of(2. * 1.1);
  alike.E2                    = alike.E1;
  EXPECT_EQ(loss_of_biot(alike).strain, never);
  EXPECT_EQ(default_law(cell_of({alike})), Law::biot);
  EXPECT_EQ(default_law(cell_of({alike, phase_of(8.), phase_of(100.)})), Law::yarn);
  EXPECT_EQ(default_references(cell_of({phase_of(100.)})),
            (std::vector<std::string>{"linear", "yarn", "green"}));
}

TEST(exact_default_law, weaves_have_yarn_and_all_other_shipped_cells_biot)
{
  for (const auto &[name, law] : {std::pair{"plain-weave", Law::yarn},
                                  {"twill", Law::yarn},
                                  {"satin", Law::yarn},
                                  {"layered", Law::biot},
                                  {"three-stiffness", Law::biot},
                                  {"chevron", Law::biot},
                                  {"auxetic", Law::biot},
                                  {"honeycomb", Law::biot},
                                  {"printed-patch", Law::biot}})
  {
    const auto cell =
      homogenization::read_unit_cell(std::string(CELLS) + name + ".prm", MPI_COMM_SELF);
    EXPECT_EQ(default_law(cell), law) << name;
    EXPECT_NE(note_on_default_law(cell).find("the law is " + name_of(law)), std::string::npos);
    const std::string laws =
      law == Law::biot
        ? "linear, biot and green, as none was asked for; biot and not yarn: under biot"
        : "linear, yarn and green, as none was asked for; yarn and not biot: under biot";
    EXPECT_EQ(note_on_default_references(cell).find(name), 0);
    EXPECT_NE(note_on_default_references(cell).find(": the references are " + laws),
              std::string::npos);
  }
}

TEST(exact_default_law, a_coarse_cloth_that_is_lost_early_is_told)
{
  Eigen::Matrix3d C;
  const double E = 1000.;
  for (const double ratio : {25., 500.})
  {
    C << E, 0., 0., 0., E, 0., 0., 0., E / ratio;
    const std::string note = note_on_corotational_cloth(C);
    EXPECT_NE(note.find("pulled along its axis 1"), std::string::npos) << note;
    EXPECT_NE(note.find("(E/G " + std::to_string(static_cast<int>(ratio)) + ")"), std::string::npos)
      << note;
  }
  C(2, 2) = E / 23.; // 4 / (23 - 4) = 21 %
  EXPECT_EQ(note_on_corotational_cloth(C), "");
}

TEST(exact_default_law, claims_speak_of_biot_else_yarn_else_the_first)
{
  using Names = std::vector<std::string>;
  EXPECT_EQ(main_reference(Names{"linear", "yarn", "biot"}), "biot");
  EXPECT_EQ(main_reference(Names{"linear", "green", "yarn"}), "yarn");
  EXPECT_EQ(main_reference(Names{"linear", "green"}), "linear");
  EXPECT_EQ(main_reference(Names{}), "");
}
