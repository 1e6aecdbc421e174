// SPDX-License-Identifier: MIT
#include "verification/cell/cell_summary.h"

#include "homogenization/cell/quadratic_strain.h"
#include "verification/cell/cell_bars.h"
#include "verification/cell/energy_order.h"
#include "verification/cell/study_inputs.h"
#include "verification/record/number_text.h"

#include <Eigen/LU>

#include <cmath>
#include <cstdio>
#include <sstream>

namespace homespun::verification
{
using homogenization::Homogenization;
using homogenization::UnitCell;

namespace
{
/// What solvers leave, relative.
constexpr double digits_of_solvers = 1e-9;

/// Rows of a matrix with its bars.
std::string table(const Eigen::Matrix3d &matrix, const Eigen::Matrix3d &bars)
{
  // No more digits than round-off leaves.
  const double least = digits_of_solvers * matrix.cwiseAbs().maxCoeff();
  std::string text;
  char line[80];
  for (int i = 0; i < 3; ++i)
  {
    for (int j = 0; j < 3; ++j)
    {
      std::snprintf(line, sizeof(line), "  %26s",
                    with_bar(matrix(i, j), larger(least, bars(i, j))).c_str());
      text += line;
    }
    text += "\n";
  }
  return text;
}

/// D^H in millionths of N m: those of cloth are some ten.
std::string bending_text(const CellBending &bending)
{
  if (!bending.bracket)
    return "D^H: " + bending.remark + "\n";
  constexpr double per_unit                   = 1e6;
  const homogenization::BendingBracket &found = *bending.bracket;
  const auto moduli = bending_moduli(found), bars = bars_of_bending_moduli(found);
  const auto rigidity = [&](const double value, const double bar) {
    return with_bar(per_unit * value, per_unit * larger(digits_of_solvers * std::abs(value), bar));
  };
  std::ostringstream text;
  text << "D^H" << (found.is_of_drawing ? " of the drawing" : "")
       << " [1e-6 N m], moments 11, 22, 12 of kappa11, kappa22, 2 kappa12, +- guaranteed:\n"
       << table(per_unit * found.stiffness, per_unit * bars_of(found)) << "Narrow strips 1 "
       << rigidity(moduli.E1, bars.E1) << ", 2 " << rigidity(moduli.E2, bars.E2) << ", twist "
       << rigidity(moduli.G12, bars.G12) << " 1e-6 N m, nu12 "
       << with_bar(moduli.nu12, larger(digits_of_solvers, bars.nu12)) << ", nu21 "
       << with_bar(moduli.nu21, larger(digits_of_solvers, bars.nu21)) << "\n";
  char line[160];
  std::snprintf(line, sizeof(line),
                "Bracket of bending, D_lower <= D^H <= D_upper of relative width %.2g, %s\n",
                found.width, bending.remark.c_str());
  text << line << range_text(found.stiffness);
  if (bending.roll)
    text << roll_text(*bending.roll) << "\n";
  return text.str();
}

/// How far the entries move while the inputs stay in their ranges.
std::string inputs_text(const UnitCell &cell, const AssessedCell &assessed,
                        const std::vector<UncertainInput> &uncertain)
{
  const std::vector<Sensitivity> all = sensitivities(cell, assessed);
  if (uncertain.empty() || all.empty())
    return uncertain.empty() ? "" : "Inputs: no bars, because there is no bracket\n";
  const InputBars bars = input_bars(all, uncertain);
  std::ostringstream text;
  text << "Inputs";
  for (const UncertainInput &input : uncertain)
    text << (&input == &uncertain.front() ? " " : ", ") << input.group << "."
         << homogenization::name_of(input.constant) << " +- " << short_text(input.range) << " "
         << homogenization::unit_of(input.constant);
  text << " move, to first order,\n";
  const auto rows = [&](const char *what, const Eigen::Matrix3d &of)
  {
    text << "  " << what << " by";
    const char *names[]   = {"11", "22", "12", "66", "16", "26"};
    const double values[] = {of(0, 0), of(1, 1), of(0, 1), of(2, 2), of(0, 2), of(1, 2)};
    char line[40];
    for (int k = 0; k < 6; ++k)
    {
      std::snprintf(line, sizeof(line), " %s %.2g%s", names[k], values[k], k < 5 ? "," : "");
      text << line;
    }
    text << "\n";
  };
  rows("C [N/m]", bars.of_C);
  if (assessed.bending && assessed.bending->bracket)
    rows("D [N m]", bars.of_D);
  return text.str();
}

/// Moduli, with bars or without.
std::string moduli_text(const Eigen::Matrix3d &stiffness,
                        const std::optional<homogenization::EngineeringConstants> &bars)
{
  std::ostringstream text;
  const auto moduli = homogenization::engineering_constants(stiffness);
  if (bars)
  {
    const auto modulus = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers * std::abs(value), bar)); };
    const auto ratio = [&](const double value, const double bar)
    { return with_bar(value, larger(digits_of_solvers, bar)); };
    text << "E1 " << modulus(moduli.E1, bars->E1) << ", E2 " << modulus(moduli.E2, bars->E2)
         << ", G12 " << modulus(moduli.G12, bars->G12) << " N/m, nu12 "
         << ratio(moduli.nu12, bars->nu12) << ", nu21 " << ratio(moduli.nu21, bars->nu21);
  }
  else
  {
    char line[240];
    std::snprintf(
      line, sizeof(line),
      "E1 %.3g, E2 %.3g, G12 %.3g N/m, nu12 %.3g, nu21 %.3g (three digits: no error bar)",
      moduli.E1, moduli.E2, moduli.G12, moduli.nu12, moduli.nu21);
    text << line;
  }
  return text.str();
}

/// Why there is no second order in strain; empty where there is one, or nobody asked.
std::string second_order_text(const UnitCell &cell, const AssessedCell &assessed)
{
  if (!assessed.result.second_order.empty())
    return "";
  if (assessed.options.second_order.empty())
  {
    const std::string why_not = too_dear_second_order(cell, assessed.options);
    return why_not.empty() ? "" : "No quadratic modes and no cubic energy: " + why_not + "\n";
  }
  return "No quadratic modes and no cubic energy: C^H and chi are those of an adapted mesh. "
         "Without --tolerance there are some\n";
}
} // namespace

std::string summary(const UnitCell &cell, const AssessedCell &assessed,
                    const std::vector<UncertainInput> &uncertain)
{
  const Homogenization &result = assessed.result;
  const bool is_bracketed      = assessed.bracket && assessed.bracket->bracket;
  std::ostringstream text;
  char line[240];
  text << cell.name << ": "
       << (is_bracketed && !is_of_drawing(assessed)
             ? static_cast<int>(assessed.bracket->bracket->n_triangles)
             : cell.mesh.n_triangles())
       << " triangles, " << cell.phases.size()
       << (cell.phases.size() == 1 ? " phase, P" : " phases, P") << assessed.options.order << ", "
       << result.n_dofs << " DoFs, " << result.iterations[0] << "/" << result.iterations[1] << "/"
       << result.iterations[2] << " iterations\n";
  if (!result.abandoned.empty())
    text << "Conjugate gradients with multigrid were given up after " << result.abandoned.size() - 1
         << " iterations; a direct solver took over\n";
  for (const std::string &note : notes_on_cells({cell}))
    text << note << "\n";
  text << "C^H" << (is_of_drawing(assessed) ? " of the drawing" : "")
       << " [N/m], Voigt 11, 22, 12 with engineering shear";
  text << (is_of_drawing(assessed) ? ", middle of its bracket, +- guaranteed:\n"
           : is_bracketed          ? ", +- guaranteed by the bracket of the mesh:\n"
           : assessed.uncertainty  ? ", +- distance to P2 on the refined mesh:\n"
                                   : " (no error bar: left out, or its mesh too large):\n");
  const auto &[stiffness, bars, moduli_bars] = shown(assessed);
  if (bars)
    text << table(stiffness, *bars);
  for (int i = 0; !bars && i < 3; ++i)
  {
    std::snprintf(line, sizeof(line), "  %16.6g  %16.6g  %16.6g\n", stiffness(i, 0),
                  stiffness(i, 1), stiffness(i, 2));
    text << line;
  }
  text << moduli_text(stiffness, moduli_bars);
  std::snprintf(line, sizeof(line), "; %.4g kg/m^2\n", areal_density(cell, assessed));
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
  if (assessed.bending)
    text << bending_text(*assessed.bending);
  text << second_order_text(cell, assessed) << inputs_text(cell, assessed, uncertain)
       << geometry_text(cell, result);
  for (const Verdict &check : assessed.checks)
  {
    std::snprintf(line, sizeof(line), ": %.2g (", check.value);
    text << name_of(check.outcome) << " " << check.claim << line << check.limit << ")\n";
  }
  return text.str();
}

std::string too_dear_second_order(const homogenization::UnitCell &cell,
                                  const homogenization::HomogenizationOptions &options)
{
  // Six more right-hand sides for each law. Measured on one core, of two laws with P1: 1.2 s for
  // 132,098 unknowns by the direct solver, 2.1 s by multigrid, 26 s for 994,050.
  constexpr double most_seconds = 10., seconds_per_dof = 1.3e-5;
  const double n_dofs =
    2. * cell.mesh.n_vertices() * std::pow(4., options.refine) * (options.order == 2 ? 4. : 1.);
  const double estimate =
    seconds_per_dof * n_dofs *
    static_cast<double>(meshes::laws_with(&meshes::LawProperties::has_second_order).size());
  if (estimate <= most_seconds)
    return "";
  char text[160];
  std::snprintf(text, sizeof(text),
                "they would take about %.2g s on this mesh, more than %g: studies make them where "
                "they need them",
                estimate, most_seconds);
  return text;
}
} // namespace homespun::verification
