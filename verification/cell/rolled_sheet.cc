// SPDX-License-Identifier: MIT
#include "verification/cell/rolled_sheet.h"

#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <cmath>
#include <cstdio>

namespace homespun::verification
{
using homogenization::Finding;
using homogenization::UnitCell;

namespace
{
Finding warning_of_folds(const UnitCell &cell, const std::string &what, const std::string &remedy)
{
  return {homogenization::Severity::warning, "folds", cell.file + ": " + what, remedy, {}};
}
} // namespace

std::vector<Finding> findings_of_folds(const UnitCell &cell)
{
  if (cell.mesh.n_triangles() > most_triangles_rolled_at_once)
    return {};
  const auto not_known = [&](const std::exception &why) -> std::vector<Finding>
  {
    return {warning_of_folds(
      cell, std::string("the radius from which on D^H holds is not known: ") + why.what(), "")};
  };
  try
  {
    const auto worst =
      homogenization::rolled_cell(homogenization::glued(cell.mesh, cell.lattice, cell.curved_sides),
                                  cell.bending_stiffness_of_phase(), cell.stiffness_of_phase())
        .worst(tolerated_stiffening);
    if (worst.radius <= radius_of_folds)
      return {};
    return {warning_of_folds(
      cell,
      "D^H holds to " + percent_text(tolerated_stiffening) +
        " where the sheet is rolled to a radius of at least " + short_text(100. * worst.radius) +
        " cm (the worst direction, " + std::to_string(worst.degrees) +
        " deg from x), and cloth folds more tightly than that: there it is stiffer",
      "draw a smaller period or thicker phases, or take D^H as a lower bound")};
  }
  catch (const meshes::BadInput &bad)
  {
    return not_known(bad);
  }
  catch (const meshes::NotConverged &failed)
  {
    return not_known(failed);
  }
}

std::string roll_text(const KnownRoll &known)
{
  if (!known.rolled)
    return "The radius from which on D^H holds is not known: " + known.why_not;
  const homogenization::RolledCell &rolled = *known.rolled;
  const std::string holds = "D^H holds to " + percent_text(tolerated_stiffening) + " ";
  const auto worst        = rolled.worst(tolerated_stiffening);
  if (worst.radius == 0.)
    return holds + "however tightly the sheet is rolled";
  char line[400];
  std::snprintf(line, sizeof(line),
                "where the sheet is rolled to a radius of at least %.3g cm (the "
                "worst direction, %d deg from x; along x %.3g, along y %.3g cm)%s",
                100. * worst.radius, worst.degrees,
                100. * rolled.least_radius(0., tolerated_stiffening),
                100. * rolled.least_radius(0.5 * M_PI, tolerated_stiffening),
                worst.radius > radius_of_folds
                  ? "\nwarning: cloth folds more tightly than that: there it is stiffer than D^H, "
                    "because the period is long beside the thickness"
                  : "");
  return holds + line;
}

nlohmann::ordered_json json_rolled(const KnownRoll &known)
{
  nlohmann::ordered_json json = {
    {"of", "mesh"}, {"tolerance", tolerated_stiffening}, {"says", roll_text(known)}};
  if (!known.rolled)
    return json;
  for (int degrees = 0; degrees < 180; degrees += 2)
  {
    const double angle = degrees * M_PI / 180.;
    json["degrees_from_x"].push_back(degrees);
    json["least_radius_m"].push_back(known.rolled->least_radius(angle, tolerated_stiffening));
    json["most_stiffening"].push_back(known.rolled->stiffest(angle));
  }
  return json;
}
} // namespace homespun::verification
