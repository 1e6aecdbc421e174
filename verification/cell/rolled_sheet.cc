// SPDX-License-Identifier: MIT
#include "verification/cell/rolled_sheet.h"

#include "meshes/plain/errors.h"
#include "verification/record/number_text.h"

#include <cmath>
#include <cstdio>

namespace homespun::verification
{
KnownRoll roll_of(const homogenization::UnitCell &cell, const BracketOptions &options)
{
  if (const std::string why = too_large_text(cell, options); !why.empty())
    return {std::nullopt, why};
  try
  {
    return {homogenization::rolled_cell(torus_of(cell, options.refine),
                                        cell.bending_stiffness_of_phase(),
                                        cell.stiffness_of_phase()),
            ""};
  }
  catch (const meshes::BadInput &bad)
  {
    return {std::nullopt, bad.what()};
  }
  catch (const meshes::NotConverged &failed)
  {
    return {std::nullopt, failed.what()};
  }
}

std::string roll_text(const KnownRoll &known)
{
  if (!known.rolled)
    return "The radius from which on D^H holds is not known: " + known.why_not;
  const homogenization::RolledCell &rolled = *known.rolled;
  const std::string holds = "D^H holds to " + percent_text(tolerated_stiffening) + " ";
  const auto radius       = [&](const int degrees)
  { return rolled.least_radius(degrees * M_PI / 180., tolerated_stiffening); };
  int worst = 0;
  for (int degrees = 1; degrees < 180; ++degrees)
    if (radius(degrees) > (1. + 1e-9) * radius(worst))
      worst = degrees;
  if (radius(worst) == 0.)
    return holds + "however tightly the sheet is rolled";
  constexpr double tight = 0.05; // of the folds of cloth [m]
  char line[400];
  std::snprintf(line, sizeof(line),
                "where the sheet is rolled to a radius of at least %.3g cm (the "
                "worst direction, %d deg from x; along x %.3g, along y %.3g cm)%s",
                100. * radius(worst), worst, 100. * radius(0), 100. * radius(90),
                radius(worst) > tight
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
