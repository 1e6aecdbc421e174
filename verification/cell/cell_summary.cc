// SPDX-License-Identifier: MIT
#include "verification/cell/cell_summary.h"

#include "verification/cell/cell_bars.h"
#include "verification/cell/energy_order.h"
#include "verification/record/number_text.h"

#include <Eigen/LU>

#include <cstdio>
#include <sstream>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;

std::string summary(const UnitCell &cell, const AssessedCell &assessed)
{
  const Homogenization &result = assessed.result;
  const bool is_bracketed      = assessed.bracket && assessed.bracket->bracket;
  std::ostringstream text;
  char line[240];
  text << cell.name << ": "
       << (is_bracketed && !is_of_drawing(assessed)
             ? static_cast<int>(assessed.bracket->bracket->n_triangles)
             : cell.mesh.n_triangles())
       << " triangles, " << cell.phases.size() << " phases, P" << assessed.options.order << ", "
       << result.n_dofs << " DoFs, " << result.iterations[0] << "/" << result.iterations[1] << "/"
       << result.iterations[2] << " iterations\n";
  text << "C^H" << (is_of_drawing(assessed) ? " of the drawing" : "")
       << " [N/m], Voigt 11, 22, 12 with engineering shear";
  text << (is_of_drawing(assessed) ? ", middle of its bracket, +- guaranteed:\n"
           : is_bracketed          ? ", +- guaranteed by the bracket of the mesh:\n"
           : assessed.uncertainty  ? ", +- distance to P2 on the refined mesh:\n"
                                   : " (no error bar: left out, or its mesh too large):\n");
  const auto &[stiffness, bars, moduli_bars] = shown(assessed);
  // No more digits than round-off leaves.
  constexpr double digits_of_solvers = 1e-9;
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      const double scale = stiffness.cwiseAbs().maxCoeff();
      if (bars)
        std::snprintf(
          line, sizeof(line), "  %26s",
          with_bar(stiffness(i, j), larger(digits_of_solvers * scale, (*bars)(i, j))).c_str());
      else
        std::snprintf(line, sizeof(line), "  %16.6g", stiffness(i, j));
      text << line;
    }
    text << "\n";
  }
  const auto moduli = homogenization::engineering_constants(stiffness);
  if (moduli_bars)
  {
    const auto modulus = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers * std::abs(value), bar)); };
    const auto ratio = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers, bar)); };
    text << "E1 " << modulus(moduli.E1, moduli_bars->E1) << ", E2 "
         << modulus(moduli.E2, moduli_bars->E2) << ", G12 " << modulus(moduli.G12, moduli_bars->G12)
         << " N/m, nu12 " << ratio(moduli.nu12, moduli_bars->nu12) << ", nu21 "
         << ratio(moduli.nu21, moduli_bars->nu21);
  }
  else
  {
    std::snprintf(
      line, sizeof(line),
      "E1 %.3g, E2 %.3g, G12 %.3g N/m, nu12 %.3g, nu21 %.3g (three digits: no error bar)",
      moduli.E1, moduli.E2, moduli.G12, moduli.nu12, moduli.nu21);
    text << line;
  }
  std::snprintf(line, sizeof(line), "; %.4g kg/m^2\n", cell.areal_density());
  text << line;
  if (assessed.bracket)
  {
    if (is_bracketed)
    {
      std::snprintf(line, sizeof(line),
                    "Bracket of the %s, C_lower <= C^H <= C_upper of relative width %.2g, ",
                    name_of_subject(*assessed.bracket->bracket), assessed.bracket->bracket->width);
      text << line;
    }
    else
      text << "Bracket: ";
    text << assessed.bracket->remark << "\n";
  }
  if (is_of_drawing(assessed))
  {
    std::snprintf(line, sizeof(line),
                  "C of the straight triangles, which the files and all other studies hold, "
                  "differs from it by %.2g of an energy\n",
                  energy_difference(result.stiffness, stiffness));
    text << line;
  }
  text << geometry_text(cell, result);
  for (const Verdict &check : assessed.checks)
  {
    std::snprintf(line, sizeof(line), "%-4s %s: %.2g (%s)\n", name_of(check.outcome).c_str(),
                  check.claim.c_str(), check.value, check.limit.c_str());
    text << line;
  }
  return text.str();
}
} // namespace homespun::verification
