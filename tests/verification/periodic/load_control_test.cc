// SPDX-License-Identifier: MIT
// What is prescribed of a cloth, as words of the command line and as files of measured curves.
#include "meshes/files/temporary_folder.h"
#include "tests/refusal.h"
#include "verification/periodic/load_control.h"
#include "verification/periodic/measured_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

using namespace homespun;
using namespace homespun::verification;

TEST(exact_load_control, components_are_read_and_the_others_are_free)
{
  const LoadControl control = load_control({"11=50", "12=0"}, {"22=-2%"}, 1);
  EXPECT_EQ(control.is_stress, (std::array<bool, 3>{true, false, true}));
  EXPECT_EQ(control.value, Eigen::Vector3d(50., -0.02, 0.));
  EXPECT_EQ(control.text(), "stress 11 = 50 N/m, strain 22 = -0.02, 12 free of stress");
  EXPECT_EQ(load_control({}, {"11=0.1"}, 1).text(),
            "strain 11 = 0.1, 22 free of stress, 12 free of stress");
  Eigen::Matrix2d axis_1, axis_2;
  axis_1 << 1.1, 0.3, 0., 1.2;
  axis_2 << 1.1, 0., 0.3, 1.2;
  LoadControl turned = control;
  turned.axis        = 2;
  EXPECT_EQ(control.gradient({0.1, 0.2, 0.3}).isApprox(axis_1), true);
  EXPECT_EQ(turned.gradient({0.1, 0.2, 0.3}).isApprox(axis_2), true);
  EXPECT_TRUE(turned.strain(axis_2).isApprox(Eigen::Vector3d(0.1, 0.2, 0.3)));
  EXPECT_EQ(turned.stress({1., 2., 3., 4.}), Eigen::Vector3d(1., 4., 3.));
}

TEST(exact_load_control, the_axis_of_a_pull_keeps_its_direction_unless_another_is_asked_for)
{
  const auto axis_of = [](const std::vector<std::string> &stresses,
                          const std::vector<std::string> &strains, const int axis)
  { return load_control(stresses, strains, axis).axis; };
  EXPECT_EQ(axis_of({}, {"22=2%"}, 0), 2);
  EXPECT_EQ(axis_of({"22=50", "11=0"}, {}, 0), 2);
  EXPECT_EQ(axis_of({}, {"11=2%"}, 0), 1);
  EXPECT_EQ(axis_of({"11=50"}, {"22=2%"}, 0), 1);
  EXPECT_EQ(axis_of({}, {"12=2%"}, 0), 1);
  EXPECT_EQ(axis_of({}, {"22=2%"}, 1), 1);
  EXPECT_EQ(axis_of({}, {"11=2%"}, 2), 2);
}

TEST(tripwire_load_control, what_cannot_be_prescribed_is_named)
{
  const auto refused = [](const std::vector<std::string> &stresses,
                          const std::vector<std::string> &strains, const std::string &expected)
  {
    EXPECT_NE(tests::refusal([&]() { load_control(stresses, strains, 1); }).find(expected),
              std::string::npos)
      << expected;
  };
  refused({"11=50", "11=60"}, {}, "component 11 a second time");
  refused({"11=50"}, {"11=0.1"}, "--strain: found component 11 a second time");
  refused({"13=50"}, {}, "found `13=50`; expected COMPONENT=VALUE");
  refused({"50"}, {}, "found `50`; expected COMPONENT=VALUE");
  refused({"11=5%"}, {}, "found `5%`; expected a number");
  refused({"11=nan"}, {}, "found `nan`");
  refused({}, {"22=x"}, "component 22: found `x`");
  refused({}, {"22=-1"}, "expected more than -1");
  refused({}, {"22=2"}, "if percent was meant, write 22=2%");
  refused({}, {}, "found nothing but zeros");
  refused({"11=0"}, {"22=0"}, "found nothing but zeros");
}

TEST(tripwire_measured_curve, damaged_files_are_refused_by_line_and_column)
{
  const meshes::TemporaryFolder folder(testing::TempDir());
  const std::string file = folder.path + "/lab.csv";
  const auto write       = [&](const std::string &text) { std::ofstream(file) << text; };
  write("\xef\xbb\xbfstrain_11, stress_11_N_per_m,who\r\n0.01,2.5,me\r\n\r\n0.02,,me\r\n");
  const std::vector<LoadRow> rows = read_measured_curve(file);
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].cell, "lab");
  EXPECT_EQ(rows[1].step, 2);
  EXPECT_EQ(rows[0].strain_11, 0.01);
  EXPECT_EQ(rows[0].stress_11, 2.5);
  EXPECT_TRUE(std::isnan(rows[1].stress_11));
  EXPECT_TRUE(std::isnan(rows[0].strain_22));
  const auto refused = [&](const std::string &text, const std::string &expected)
  {
    write(text);
    EXPECT_NE(tests::refusal([&]() { read_measured_curve(file); }).find(expected),
              std::string::npos)
      << expected;
  };
  refused("", "is empty");
  refused("a,b\n1,2\n", "expected strain and stress of one component");
  refused("strain_11,stress_22_N_per_m\n1,2\n", "expected strain and stress of one component");
  refused("strain_11,stress_11_N_per_m\n", "a row at least");
  refused("strain_11,stress_11_N_per_m\n0.1\n", "line 2: found 1 fields; expected 2");
  refused("strain_11,stress_11_N_per_m\n0.1,x\n", "line 2, column stress_11_N_per_m: found `x`");
  refused("strain_11,stress_11_N_per_m\n0.1,inf\n", "found `inf`");
  EXPECT_NE(tests::refusal([&]() { read_measured_curve(folder.path + "/absent.csv"); })
              .find("absent.csv: cannot be read"),
            std::string::npos);
}
