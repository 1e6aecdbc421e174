// SPDX-License-Identifier: MIT
// The sections of other programs, entry by entry, on a stiffness whose entries are all different.
#include "verification/cell/shell_sections.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <vector>

using namespace homespun::verification;

namespace
{
ShellSection some_section()
{
  ShellSection section{"stripes", {}, {}, 0.2, 5e-4};
  section.membrane << 11., 12., 13., 12., 22., 23., 13., 23., 33.;
  section.bending << 44., 45., 46., 45., 55., 56., 46., 56., 66.;
  section.bending *= 1e-7 / 3.; // no round numbers
  return section;
}
} // namespace

TEST(exact_shell_sections, abaqus_has_the_symmetric_half_column_by_column)
{
  const ShellSection section = some_section();
  std::istringstream lines(abaqus_section(section));
  std::string line, keyword;
  std::vector<std::vector<double>> rows;
  while (std::getline(lines, line))
  {
    EXPECT_LE(line.size(), 256u); // of a data line
    if (line.rfind("**", 0) == 0)
      continue;
    if (line[0] == '*')
    {
      keyword = line;
      continue;
    }
    rows.emplace_back();
    std::istringstream numbers(line);
    std::string number;
    while (std::getline(numbers, number, ','))
      rows.back().push_back(std::stod(number));
  }
  EXPECT_EQ(keyword.substr(0, 48), "*SHELL GENERAL SECTION, ELSET=CLOTH, DENSITY=0.2");
  const double s = 1e-7 / 3.;
  // D11 D12 D22 D13 D23 D33 D14 D24, D34 D44 D15 D25 D35 D45 D55 D16, D26 D36 D46 D56 D66.
  const std::vector<std::vector<double>> expected = {
    {11., 12., 22., 13., 23., 33., 0., 0.},
    {0., 44. * s, 0., 0., 0., 45. * s, 55. * s, 0.},
    {0., 0., 46. * s, 56. * s, 66. * s}};
  EXPECT_EQ(rows, expected);
}

TEST(exact_shell_sections, code_aster_has_all_thirty_three_entries_and_the_mass)
{
  const ShellSection section = some_section();
  const std::string text     = aster_section(section);
  const std::regex entry("([A-Z]+_?[A-Z]*)=([-+.e0-9]+),");
  std::map<std::string, double> found;
  for (std::sregex_iterator k(text.begin(), text.end(), entry), end; k != end; ++k)
    EXPECT_TRUE(found.emplace((*k)[1], std::stod((*k)[2])).second) << (*k)[1];
  EXPECT_EQ(found.size(), 34u);
  EXPECT_EQ(found["M_LLLT"], 13.);
  EXPECT_EQ(found["M_TTLT"], 23.);
  EXPECT_EQ(found["M_LTLT"], 33.);
  EXPECT_EQ(found["F_LLTT"], section.bending(0, 1));
  EXPECT_EQ(found["F_TTTT"], section.bending(1, 1));
  EXPECT_EQ(found["F_TTLT"], section.bending(1, 2));
  EXPECT_EQ(found["MF_LLLL"], 0.);
  EXPECT_EQ(found["FC_LTTZ"], 0.);
  EXPECT_GT(found["C_LZLZ"] * found["C_TZTZ"], 1e-15); // what Code_Aster asks of it
  EXPECT_DOUBLE_EQ(found["RHO"], 400.);
}
