// SPDX-License-Identifier: MIT
#include "verification/cell/sensitivity.h"

#include "homogenization/cell/parameter_text.h"
#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
#include "verification/record/claim.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using homogenization::MaterialConstant;
using homogenization::Phase;
using homogenization::UnitCell;

namespace
{
/// The phase and its constant that `group.constant` names.
std::optional<MaterialConstant> constant_of(const Phase &phase, const std::string &name)
{
  for (const MaterialConstant constant : homogenization::constants_of(phase))
    if (homogenization::name_of(constant) == name)
      return constant;
  return std::nullopt;
}

std::string names_of_constants(const Phase &phase)
{
  std::string names;
  for (const MaterialConstant constant : homogenization::constants_of(phase))
    names += (names.empty() ? "" : ", ") + homogenization::name_of(constant);
  return names;
}

class InputReader
{
public:
  explicit InputReader(const UnitCell &cell)
      : cell(cell)
  {
    for (const int p : cell.phase_of_group())
      groups.push_back(&cell.phases[static_cast<std::size_t>(p)]);
  }

  void read(const std::string &entry)
  {
    const std::size_t equal = entry.find('=');
    const std::string name  = homogenization::trimmed(entry.substr(0, equal));
    const std::size_t point = name.rfind('.');
    if (equal == std::string::npos || point == std::string::npos)
    {
      faults.push_back("--uncertain: found `" + entry +
                       "`; expected `group.constant=range` such as `" + groups[0]->name +
                       ".thickness=10%`");
      return;
    }
    const std::string group = name.substr(0, point), constant = name.substr(point + 1);
    const auto phase = std::find_if(groups.begin(), groups.end(),
                                    [&](const Phase *its) { return its->name == group; });
    if (phase == groups.end())
    {
      std::string names;
      for (const Phase *its : groups)
        names += (names.empty() ? "`" : ", `") + its->name + "`";
      faults.push_back("--uncertain: names the phase `" + group + "`, which " + cell.file +
                       " does not have; expected one of " + names);
      return;
    }
    const auto its_constant = constant_of(**phase, constant);
    if (!its_constant)
    {
      faults.push_back("--uncertain: phase `" + group + "` of " + cell.file + " has no constant `" +
                       constant + "`; expected one of " + names_of_constants(**phase));
      return;
    }
    const bool is_known =
      std::any_of(inputs.begin(), inputs.end(),
                  [&](const UncertainInput &other)
                  { return other.group == group && other.constant == *its_constant; });
    // An angle has no size: its zero is where the axes were drawn.
    const double value = *its_constant == MaterialConstant::angle
                           ? 0.
                           : std::abs(homogenization::value_of(**phase, *its_constant));
    const double range = range_of(homogenization::trimmed(entry.substr(equal + 1)), value);
    if (is_known)
      faults.push_back("--uncertain: `" + name + "` is given twice; expected once");
    else if (!(range > 0.) || !std::isfinite(range))
      faults.push_back("--uncertain: found `" + entry +
                       "`; expected a positive range: a percentage of a value that is neither zero "
                       "nor an angle, or a number in " +
                       homogenization::unit_of(*its_constant));
    else
      inputs.push_back({group, *its_constant, range});
  }

  std::vector<UncertainInput> inputs;
  std::vector<std::string> faults;

private:
  /// Not positive where the text is no range.
  static double range_of(std::string text, const double value)
  {
    const bool is_part = !text.empty() && text.back() == '%';
    if (is_part)
      text.pop_back();
    const auto numbers = homogenization::numbers(text);
    if (!numbers || numbers->size() != 1)
      return 0.;
    return is_part ? 0.01 * (*numbers)[0] * value : (*numbers)[0];
  }

  const UnitCell &cell;
  std::vector<const Phase *> groups;
};
} // namespace

std::vector<Sensitivity> sensitivities(const UnitCell &cell, const AssessedCell &assessed)
{
  if (!assessed.bracket || !assessed.bracket->bracket)
    return {};
  const bool bends = assessed.bending && assessed.bending->bracket;
  std::vector<Sensitivity> all;
  const std::vector<int> group = cell.group_of_phase();
  for (const int first : cell.phase_of_group())
  {
    const Phase &its = cell.phases[static_cast<std::size_t>(first)];
    for (const MaterialConstant constant : homogenization::constants_of(its))
    {
      Sensitivity found{its.name, constant, homogenization::value_of(its, constant),
                        Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
      for (std::size_t p = 0; p < cell.phases.size(); ++p)
        if (group[p] == group[static_cast<std::size_t>(first)])
        {
          found.of_C += homogenization::energies_of(
            homogenization::plane_stress_derivative(cell.phases[p], constant),
            assessed.bracket->products[p]);
          if (bends)
            found.of_D += homogenization::energies_of(
              homogenization::bending_derivative(cell.phases[p], constant),
              assessed.bending->bracket->curvature_products[p]);
        }
      found.of_C = (0.5 * (found.of_C + found.of_C.transpose())).eval();
      found.of_D = (0.5 * (found.of_D + found.of_D.transpose())).eval();
      all.push_back(found);
    }
  }
  return all;
}

bool has_scaling_checks(const UnitCell &cell)
{
  return std::none_of(cell.phases.begin(), cell.phases.end(),
                      [](const Phase &phase)
                      { return homogenization::constants_of(phase).empty(); });
}

namespace
{
/// What a stiffness divides by, 1 - nu12 nu21: small near the ends of nu.
double room_of(const Phase &phase)
{
  return 1. - phase.nu12 * phase.nu12 * phase.E2 / phase.E1;
}

/// How far derivatives of a phase's stiffness are from differences, over the stiffness and the size
/// of the constant.
/// @param part of what a constant may change by, the smaller step
double misfit_of_derivatives(const Phase &phase, const double part)
{
  const double room = room_of(phase);
  double worst      = 0.;
  for (const MaterialConstant constant : homogenization::constants_of(phase))
  {
    const double value = homogenization::value_of(phase, constant);
    const double unit  = homogenization::unit_of(constant) == "deg" ? 180. / M_PI
                         : homogenization::unit_of(constant) == "1" ? std::sqrt(phase.E1 / phase.E2)
                                                                    : value;
    const auto off     = [&](const auto &stiffness, const auto &derivative)
    {
      const auto slope = [&](const double step) -> Eigen::Matrix3d
      {
        return (stiffness(homogenization::changed(phase, constant, value + step)) -
                stiffness(homogenization::changed(phase, constant, value - step))) /
               (2. * step);
      };
      const double step             = part * room * unit;
      const Eigen::Matrix3d at_zero = (4. * slope(step) - slope(2. * step)) / 3.;
      return (derivative(phase, constant) - at_zero).norm() * room * unit / stiffness(phase).norm();
    };
    worst = larger(
      worst, off(homogenization::plane_stress_stiffness, homogenization::plane_stress_derivative));
    worst =
      larger(worst, off(homogenization::bending_stiffness, homogenization::bending_derivative));
  }
  return worst;
}
} // namespace

Verdict constants_check(const UnitCell &cell)
{
  constexpr double part = 1e-4;
  double worst = 0., room = 1.;
  for (const Phase &phase : cell.phases)
  {
    worst = larger(worst, misfit_of_derivatives(phase, part));
    room  = std::min(room, room_of(phase));
  }
  return at_most("constants", {}, worst, 10. * meshes::epsilon / (part * room));
}

std::vector<Verdict> scaling_checks(const UnitCell &cell, const AssessedCell &assessed)
{
  // Sums of both sides have the same products of fields: what is left is their rounding.
  constexpr double rounding          = 1e-9;
  const std::vector<Sensitivity> all = sensitivities(cell, assessed);
  if (all.empty() || !has_scaling_checks(cell))
    return {};
  const auto check = [&](const char *name, const auto of, const Eigen::Matrix3d &stiffness,
                         const double degree, const double limit)
  {
    Eigen::Matrix3d of_moduli = Eigen::Matrix3d::Zero(), of_thickness = of_moduli;
    for (const Sensitivity &its : all)
      if (its.constant == MaterialConstant::thickness)
        of_thickness += its.value / degree * its.*of;
      else if (homogenization::unit_of(its.constant) == "Pa")
        of_moduli += its.value * its.*of;
    const double off = larger((of_moduli - stiffness).cwiseAbs().maxCoeff(),
                              (of_thickness - stiffness).cwiseAbs().maxCoeff());
    return at_most("scaling", {{"stiffness", name}, {"degree", degree}},
                   off / stiffness.cwiseAbs().maxCoeff(), limit);
  };
  const CellBracket &bracket  = *assessed.bracket;
  const bool is_drawn         = bracket.bracket->is_of_drawing;
  std::vector<Verdict> checks = {
    check("C^H", &Sensitivity::of_C, is_drawn ? *bracket.on_given_mesh : bracket.bracket->stiffness,
          1., rounding)};
  // D of a drawing takes the stiffer phase wherever its curves leave open which one is there.
  if (assessed.bending && assessed.bending->bracket)
    checks.push_back(check("D^H", &Sensitivity::of_D, assessed.bending->bracket->stiffness, 3.,
                           rounding + (is_drawn ? assessed.bending->bracket->width : 0.)));
  return checks;
}

std::vector<UncertainInput> uncertain_inputs(const UnitCell &cell, const std::string &text)
{
  InputReader reader(cell);
  for (const std::string &entry : homogenization::split(text, ','))
    reader.read(entry);
  if (!reader.faults.empty())
    throw meshes::BadInput(reader.faults);
  return reader.inputs;
}

InputBars input_bars(const std::vector<Sensitivity> &all, const std::vector<UncertainInput> &inputs)
{
  InputBars bars{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  for (const UncertainInput &input : inputs)
    for (const Sensitivity &its : all)
      if (its.group == input.group && its.constant == input.constant)
      {
        bars.of_C += input.range * its.of_C.cwiseAbs();
        bars.of_D += input.range * its.of_D.cwiseAbs();
      }
  return bars;
}
} // namespace homespun::verification
