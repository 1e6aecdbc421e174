// SPDX-License-Identifier: MIT
#include "verification/ellipticity/default_law.h"

#include "meshes/plain/yarn_axes.h"
#include "verification/record/number_text.h"

#include <Eigen/LU>

#include <cmath>

namespace homespun::verification
{
using homogenization::Phase;
using homogenization::UnitCell;

namespace
{
/// Of a line from the x axis: 0 to 180, and a whole number where it is one to round-off.
double degrees_of(const Eigen::Vector2d &line)
{
  const double angle = std::atan2(line(1), line(0)) * 180. / M_PI;
  return std::fmod(std::round((angle - 180. * std::floor(angle / 180.)) * 1e6) / 1e6, 180.);
}

/// Why the default law is what it is.
std::string reason_of_default(const UnitCell &cell)
{
  const PhaseLoss loss = first_loss_of_biot(cell);
  if (loss.strain == never)
    return "under biot no phase that is pulled along its axes stops being elliptic";
  return "under biot phase " + loss.phase + ", pulled along " + axis_text(loss) +
         ", is elliptic up to " + percent_text(loss.strain) + " (E/G " + short_text(loss.ratio) +
         "), " + (loss.strain < largest_strain_of_cloth ? "less" : "more") + " than " +
         percent_text(largest_strain_of_cloth);
}
} // namespace

std::string axis_text(const PhaseLoss &loss)
{
  if (loss.angle == 0. || loss.angle == 90.)
    return loss.angle == 0. ? "its axis 1" : "its axis 2";
  return "a line " + short_text(loss.angle) + " degrees from its axis 1";
}

PhaseLoss loss_of_biot(const Eigen::Matrix3d &C)
{
  PhaseLoss loss;
  const meshes::YarnAxes yarns = meshes::yarn_axes(C);
  if (!yarns.are_there)
    return loss;
  const Eigen::Matrix3d S = yarns.C.inverse();
  for (const int axis : {1, 2})
  {
    const double strain = uniaxial_loss(Law::biot, yarns.C, axis);
    if (axis == 1 || strain < loss.strain)
    {
      loss.angle  = degrees_of(yarns.axes.col(axis - 1));
      loss.strain = strain;
      loss.ratio  = S(2, 2) / S(axis - 1, axis - 1);
    }
  }
  return loss;
}

PhaseLoss loss_of_biot(const Phase &phase)
{
  Phase straight = phase; // in its own axes
  straight.angle = 0.;
  PhaseLoss loss = loss_of_biot(homogenization::plane_stress_stiffness(straight));
  loss.phase     = phase.name;
  return loss;
}

PhaseLoss first_loss_of_biot(const UnitCell &cell)
{
  PhaseLoss first;
  for (const int p : cell.phase_of_group())
    if (const PhaseLoss loss = loss_of_biot(cell.phases[static_cast<std::size_t>(p)]);
        first.phase.empty() || loss.strain < first.strain)
      first = loss;
  return first;
}

Law default_law(const UnitCell &cell)
{
  return first_loss_of_biot(cell).strain < largest_strain_of_cloth ? Law::yarn : Law::biot;
}

std::vector<std::string> laws_for(const UnitCell &cell, const std::vector<std::string> &asked)
{
  return asked.empty() ? std::vector<std::string>{name_of(default_law(cell))} : asked;
}

std::vector<std::string> default_references(const UnitCell &cell)
{
  return {name_of(Law::linear), name_of(default_law(cell)), name_of(Law::green)};
}

std::string note_on_corotational_cloth(const Eigen::Matrix3d &C)
{
  const PhaseLoss loss = loss_of_biot(C);
  if (!(loss.strain < largest_strain_of_cloth))
    return "";
  return "the corotational cloth (law biot) of C^H, pulled along " + axis_text(loss) +
         ", is elliptic up to " + percent_text(loss.strain) + " (E/G " + short_text(loss.ratio) +
         "); beyond it the law has no minimum that finer meshes approach, and what is found "
         "belongs to the mesh and the time step";
}

std::string note_on_default_law(const UnitCell &cell)
{
  return cell.name + ": the law is " + name_of(default_law(cell)) +
         ", as none was asked for: " + reason_of_default(cell);
}

std::string note_on_default_references(const UnitCell &cell)
{
  const Law law           = default_law(cell);
  const std::string other = name_of(law == Law::biot ? Law::yarn : Law::biot);
  const auto names        = default_references(cell);
  std::string said;
  for (std::size_t k = 0; k < names.size(); ++k)
    said += (k == 0 ? "" : k + 1 == names.size() ? " and " : ", ") + names[k];
  return cell.name + ": the references are " + said + ", as none was asked for; " + name_of(law) +
         " and not " + other + ": " + reason_of_default(cell);
}
} // namespace homespun::verification
