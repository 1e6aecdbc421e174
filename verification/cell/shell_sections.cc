// SPDX-License-Identifier: MIT
#include "verification/cell/shell_sections.h"

#include <cstdio>
#include <vector>

namespace homespun::verification
{
namespace
{
/// All digits: it reads back as the same number.
std::string digits(const double value)
{
  char text[40];
  std::snprintf(text, sizeof(text), "%.17g", value);
  return text;
}
} // namespace

std::string abaqus_section(const ShellSection &section)
{
  Eigen::Matrix<double, 6, 6> both = Eigen::Matrix<double, 6, 6>::Zero();
  both.topLeftCorner<3, 3>()       = section.membrane;
  both.bottomRightCorner<3, 3>()   = section.bending;
  std::string text =
    "** " + section.name +
    ": effective stiffness of a periodic sheet, homespun. SI units: N/m, N m, kg/m^2.\n"
    "** Axis 1 of the section is axis 1 of the cell: give an *ORIENTATION. Transverse shear is "
    "that of\n** a thin sheet; Abaqus takes its own default.\n"
    "*SHELL GENERAL SECTION, ELSET=CLOTH, DENSITY=" +
    digits(section.areal_density) + "\n";
  int n = 0;
  for (int column = 0; column < 6; ++column)
    for (int row = 0; row <= column; ++row)
    {
      ++n;
      text += digits(both(row, column));
      text += n == 21 || n % 8 == 0 ? "\n" : ", ";
    }
  return text;
}

std::string aster_section(const ShellSection &section)
{
  std::string text =
    "# " + section.name +
    ": effective stiffness of a periodic sheet, homespun. SI units: N/m, N m, kg/m^3.\n"
    "# L is axis 1 of the cell: ANGL_REP or VECTEUR of AFFE_CARA_ELEM. RHO is for EPAIS = " +
    digits(section.thickness) +
    " m.\n# C_* are no results: thin elements (DKT, DKTG) do without, and the keyword asks for "
    "positive ones.\nCLOTH = DEFI_MATERIAU(ELAS_COQUE=_F(\n";
  const auto entry = [&](const std::string &name, const double value)
  { text += "    " + name + "=" + digits(value) + ",\n"; };
  const auto six = [&](const std::string &prefix, const Eigen::Matrix3d &matrix)
  {
    entry(prefix + "LLLL", matrix(0, 0));
    entry(prefix + "LLTT", matrix(0, 1));
    entry(prefix + "LLLT", matrix(0, 2));
    entry(prefix + "TTTT", matrix(1, 1));
    entry(prefix + "TTLT", matrix(1, 2));
    entry(prefix + "LTLT", matrix(2, 2));
  };
  six("M_", section.membrane);
  six("F_", section.bending);
  six("MF_", Eigen::Matrix3d::Zero());
  for (const char *prefix : {"MC_", "FC_"})
    for (const char *name : {"LLLZ", "LLTZ", "TTLZ", "TTTZ", "LTLZ", "LTTZ"})
      entry(std::string(prefix) + name, 0.);
  const double shear = 5. / 6. * section.membrane(2, 2);
  entry("C_LZLZ", shear);
  entry("C_LZTZ", 0.);
  entry("C_TZTZ", shear);
  entry("RHO", section.areal_density / section.thickness);
  return text + "))\n";
}
} // namespace homespun::verification
