// SPDX-License-Identifier: MIT
// The part of the linter that looks at numbers, not at shapes: units that were mistaken, and what
// double precision holds.
#include "homogenization/lint/cell_lint.h"

#include "meshes/plain/symmetric_eigen.h"


#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace homespun::homogenization
{
namespace
{
/// What cells of cloth are: yarns and knits from 0.1 mm on, printed patterns up to a metre [m].
constexpr double smallest_side = 1e-4, largest_side = 1.;

/// Modulus times thickness: from a loose knit to carbon fabric [N/m].
constexpr double softest = 0.1, stiffest = 1e8;

/// Mass per area: from tulle to leather armour [kg/m^2].
constexpr double lightest = 1e-3, heaviest = 100.;

/// |B|/sqrt(A D), which is between 0 and 1: its square is the part of D that the coupling changes.
constexpr double largest_coupling = 0.2;

/// The stiffness in double precision keeps 16 digits: beyond this contrast half of them at most are
/// left for the soft phase.
constexpr double large_contrast = 1e8;

meshes::Place somewhere_in(const UnitCell &cell, const std::size_t phase)
{
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (cell.mesh.material(t) == static_cast<int>(phase))
      return {(cell.mesh.vertices.row(cell.mesh.triangles(t, 0)) +
               cell.mesh.vertices.row(cell.mesh.triangles(t, 1)) +
               cell.mesh.vertices.row(cell.mesh.triangles(t, 2))) /
                3.,
              t, -1};
  return {};
}
} // namespace

std::vector<Finding> lint_size(const double side, const double metres_per_unit)
{
  if (side >= smallest_side && side <= largest_side)
    return {};
  // The unit that would give a cell of a centimetre or so.
  std::string likely = "the side of the mesh by other means";
  double nearest     = std::numeric_limits<double>::infinity();
  for (const auto &[unit, name] :
       {std::pair{1., "1 (metres)"}, std::pair{0.01, "0.01 (centimetres)"},
        std::pair{0.001, "0.001 (millimetres)"}, std::pair{1e-6, "1e-6 (micrometres)"}})
  {
    const double distance = std::abs(std::log(side / metres_per_unit * unit / 0.01));
    if (distance < nearest)
    {
      nearest = distance;
      likely  = name;
    }
  }
  std::ostringstream what;
  what << "the cell is " << side << " m wide, " << side / metres_per_unit << " mesh units of "
       << metres_per_unit << " m";
  std::ostringstream remedy;
  remedy << "expected a side of " << smallest_side << " to " << largest_side
         << " m: is `Length unit` " << likely << "?";
  return {{Severity::warning, "size", what.str(), remedy.str(), {}}};
}

std::vector<Finding> lint_phases(const UnitCell &cell, const double side)
{
  std::vector<Finding> findings;
  const auto warn =
    [&](const std::size_t p, const char *kind, const std::string &what, const std::string &remedy)
  {
    findings.push_back({Severity::warning, kind, "phase `" + cell.phases[p].name + "` " + what,
                        remedy, somewhere_in(cell, p)});
  };
  for (const int first : cell.phase_of_group()) // the others differ in their angle alone
  {
    const auto p       = static_cast<std::size_t>(first);
    const Phase &phase = cell.phases[p];
    std::ostringstream what;
    if (phase.thickness > 0.5 * side)
    {
      what << "is " << phase.thickness << " m thick in a cell of " << side
           << " m: that is no membrane";
      warn(p, "thickness", what.str(),
           "expected at most half the side: `Thickness` is in metres, 0.5 mm is 5e-4");
      continue; // what follows would repeat it
    }
    const double stiffness = std::max(phase.E1, phase.E2) * phase.thickness;
    if (stiffness < softest || stiffness > stiffest)
    {
      what << "has modulus times thickness " << stiffness << " N/m";
      std::ostringstream remedy;
      remedy << "expected " << softest << " (loose knit) to " << stiffest << " (carbon fabric): ";
      const double modulus = std::max(phase.E1, phase.E2);
      if (stiffness > stiffest)
        remedy << "is the thickness in metres and the modulus in Pa?";
      else if (modulus < 1e-1)
        remedy << "is the modulus given in GPa? In Pa it would be " << modulus * 1e9;
      else
        remedy << "is the modulus given in MPa? In Pa it would be " << modulus * 1e6;
      warn(p, "stiffness", what.str(), remedy.str());
    }
    const double mass = phase.density * phase.thickness;
    if (mass < lightest || mass > heaviest)
    {
      std::ostringstream text;
      text << "has a mass of " << mass << " kg/m^2";
      std::ostringstream remedy;
      remedy << "expected " << lightest << " to " << heaviest
             << ": `Density` is in kg/m^3, 1 g/cm^3 is 1000";
      warn(p, "mass", text.str(), remedy.str());
    }
    // Where layers end, the neutral surface jumps, and a cloth that bends is stretched.
    const auto farthest = std::max_element(cell.phases.begin(), cell.phases.end(),
                                           [&](const Phase &one, const Phase &other) {
                                             return coupling(phase, one) < coupling(phase, other);
                                           });
    if (const double ratio = coupling(phase, *farthest); phase.plate && ratio > largest_coupling)
    {
      std::ostringstream text;
      text << "has another neutral surface than phase `" << farthest->name
           << "`: B/sqrt(A D) of its entries 11 about that one is " << ratio;
      std::ostringstream remedy;
      remedy << "expected at most " << largest_coupling
             << ": C^H and D^H leave out that this cell stretches where it bends";
      warn(p, "layers", text.str(), remedy.str());
    }
  }
  return findings;
}

std::vector<Finding> lint_contrast(const UnitCell &cell)
{
  std::vector<Finding> findings;
  double least = std::numeric_limits<double>::infinity(), most = 0.;
  std::size_t softest_phase = 0, stiffest_phase = 0;
  const std::vector<Eigen::Matrix3d> stiffness = cell.stiffness_of_phase();
  for (std::size_t p = 0; p < stiffness.size(); ++p)
  {
    const Eigen::Vector3d values = meshes::symmetric_eigen<3>(stiffness[p]).values;
    if (values(0) < least)
    {
      least         = values(0);
      softest_phase = p;
    }
    if (values(2) > most)
    {
      most           = values(2);
      stiffest_phase = p;
    }
  }
  // A stiff part held by a soft one moves as a whole by what the sums of its large forces lose: one
  // rounding per row of triangles, in parts of the soft stiffness
  // (verification/cell/algebraic_limit.h).
  const double contrast = most / least, rows = std::sqrt(0.5 * cell.mesh.n_triangles());
  const double lost = rows * std::numeric_limits<double>::epsilon() * contrast;
  if (contrast > large_contrast || !(contrast > 0.))
  {
    std::ostringstream what, remedy;
    what << "the contrast between phases `" << cell.phases[stiffest_phase].name << "` and `"
         << cell.phases[softest_phase].name << "` is " << contrast
         << ": round-off displaces stiff parts by " << lost << " of the strain of the soft ones";
    const bool is_hopeless = !(lost < 1.);
    if (is_hopeless)
      what << ", so that no digit is left";
    remedy << "expected at most " << large_contrast
           << ": make what is nearly void a hole of the mesh, and what is nearly rigid a thousand "
              "times as stiff as the rest";
    findings.push_back({is_hopeless ? Severity::error : Severity::warning, "contrast", what.str(),
                        remedy.str(), somewhere_in(cell, softest_phase)});
  }
  return findings;
}
} // namespace homespun::homogenization
