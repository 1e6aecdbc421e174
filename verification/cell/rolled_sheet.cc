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
    char where[160];
    std::snprintf(
      where, sizeof(where),
      " where the sheet is rolled to a radius of at least %.3g cm (the worst direction, "
      "%d deg from x), and cloth folds more tightly than that: there it is stiffer",
      100. * worst.radius, worst.degrees);
    return {
      warning_of_folds(cell, "D^H holds to " + percent_text(tolerated_stiffening) + where,
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
  int stiffest = 0; // degrees from x
  for (int degrees = 1; degrees < 180; ++degrees)
    if (rolled.stiffest(degrees * M_PI / 180.) >
        (1. + 1e-9) * rolled.stiffest(stiffest * M_PI / 180.))
      stiffest = degrees;
  char line[600];
  std::snprintf(line, sizeof(line),
                "where the sheet is rolled to a radius of at least %.3g cm (the "
                "worst direction, %d deg from x; along x %.3g, along y %.3g cm)\n"
                "Rolled ever more tightly, bending without stretching, it is up to %.3g times as "
                "stiff as D^H (the worst direction, %d deg from x; along x %.3g, along y %.3g)%s",
                100. * worst.radius, worst.degrees,
                100. * rolled.least_radius(0., tolerated_stiffening),
                100. * rolled.least_radius(0.5 * M_PI, tolerated_stiffening),
                rolled.stiffest(stiffest * M_PI / 180.), stiffest, rolled.stiffest(0.),
                rolled.stiffest(0.5 * M_PI),
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
  for (const homogenization::IsometricBending &its : known.rolled->isometric)
    json["isometric"].push_back({{"ruling", its.ruling},
                                 {"degrees_from_x", its.angle * 180. / M_PI},
                                 {"D_inf", its.stiffness},
                                 {"most_stiffening", known.rolled->stiffest(its.angle)}});
  return json;
}
} // namespace homespun::verification
