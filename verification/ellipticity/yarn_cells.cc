// SPDX-License-Identifier: MIT
#include "verification/ellipticity/yarn_cells.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/yarn_axes.h"
#include "verification/ellipticity/default_law.h"
#include "verification/record/number_text.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
using homogenization::Phase;
using homogenization::UnitCell;

namespace
{
/// The first law of yarns among some names; empty where there is none.
std::string law_of_yarns(const std::vector<std::string> &names)
{
  const auto found = std::find_if(
    names.begin(), names.end(), [](const std::string &name) { return name == name_of(Law::yarn); });
  return found == names.end() ? std::string() : *found;
}

meshes::YarnAxes axes_of(const Phase &phase)
{
  return meshes::yarn_axes(homogenization::plane_stress_stiffness(phase));
}

/// How far the axes are from those of the phase, as the same cross of two lines [deg].
double degrees_off(const Phase &phase, const meshes::YarnAxes &yarns)
{
  const double angle = std::atan2(yarns.axes(1, 0), yarns.axes(0, 0)) * 180. / M_PI - phase.angle;
  return std::abs(std::remainder(angle, 90.));
}

std::string joined(const std::vector<std::string> &names)
{
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text;
}
} // namespace

void check_yarns(const std::vector<UnitCell> &cells, const std::string &option,
                 const std::vector<std::string> &names)
{
  const std::string law = law_of_yarns(names);
  if (law.empty())
    return;
  std::vector<std::string> faults;
  for (const UnitCell &cell : cells)
    if (std::none_of(cell.phases.begin(), cell.phases.end(),
                     [](const Phase &phase) { return axes_of(phase).are_there; }))
      faults.push_back(cell.file + ": " + option + " " + law +
                       ": every phase is alike in all directions; expected one with yarns, by the "
                       "key Orthotropic: ask for biot or green");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

std::vector<std::string> notes_on_yarns(const UnitCell &cell,
                                        const std::vector<std::string> &references)
{
  std::vector<std::string> notes, alike;
  const std::string law = law_of_yarns(references);
  if (law.empty())
    return notes;
  for (const int p : cell.phase_of_group())
  {
    const Phase &phase           = cell.phases[static_cast<std::size_t>(p)];
    const meshes::YarnAxes yarns = axes_of(phase);
    if (!yarns.are_there)
      alike.push_back(phase.name);
    else if (const double off = degrees_off(phase, yarns); off > 0.01)
      notes.push_back(cell.name + ": under the law " + law + " the axes of phase " + phase.name +
                      " are those of its largest Young's modulus, " + short_text(off) +
                      " degrees from the ones that are given");
  }
  if (!alike.empty())
    notes.push_back(cell.name + ": under the law " + law + " the phases " + joined(alike) +
                    ", alike in all directions, keep biot");
  return notes;
}

std::string note_on_coarse_cloth(const Law law, const Eigen::Matrix3d &stiffness)
{
  return is_of_yarns(law) ? note_on_coarse_yarns(law, stiffness)
                          : note_on_corotational_cloth(stiffness);
}

std::string note_on_coarse_yarns(const Law law, const Eigen::Matrix3d &stiffness)
{
  const meshes::YarnAxes yarns = meshes::yarn_axes(stiffness);
  if (!yarns.are_there)
    return "the coarse cloth keeps biot: its C^H is alike in all directions and has no yarns";
  const double angle = // to a hundredth, and without a sign of zero
    std::round(std::atan2(yarns.axes(1, 0), yarns.axes(0, 0)) * 18000. / M_PI) / 100. + 0.;
  return "the coarse cloth has the law " + name_of(law) +
         ", too: its yarns lie along the largest Young's modulus of C^H, " + short_text(angle) +
         " degrees from the x axis, and across";
}
} // namespace homespun::verification
