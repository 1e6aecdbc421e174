// SPDX-License-Identifier: MIT
#include "verification/cell/rolled_sheet.h"

#include "meshes/plain/errors.h"

#include <cmath>
#include <cstdio>

namespace homespun::verification
{
std::optional<homogenization::RolledCell> rolled_of(const homogenization::UnitCell &cell,
                                                    const BracketOptions &options)
{
  if (!too_large_text(cell, options).empty())
    return std::nullopt;
  try
  {
    return homogenization::rolled_cell(
      torus_of(cell, options.refine), cell.bending_stiffness_of_phase(), cell.stiffness_of_phase());
  }
  catch (const meshes::BadInput &)
  {
    return std::nullopt;
  }
  catch (const meshes::NotConverged &)
  {
    return std::nullopt;
  }
}

std::string roll_text(const homogenization::RolledCell &rolled)
{
  const auto radius = [&](const int degrees)
  { return rolled.least_radius(degrees * M_PI / 180., tolerated_stiffening); };
  int worst = 0;
  for (int degrees = 1; degrees < 180; ++degrees)
    if (radius(degrees) > (1. + 1e-9) * radius(worst))
      worst = degrees;
  if (radius(worst) == 0.)
    return "D^H holds to 2 % however tightly the sheet is rolled";
  constexpr double tight = 0.05; // [m]
  char line[400];
  std::snprintf(line, sizeof(line),
                "D^H holds to 2 %% where the sheet is rolled to a radius of at least %.3g cm (the "
                "worst direction, %d deg from x; along x %.3g, along y %.3g cm)%s",
                100. * radius(worst), worst, 100. * radius(0), 100. * radius(90),
                radius(worst) > tight
                  ? "\nwarning: cloth folds more tightly than that: there it is stiffer than D^H, "
                    "because the period is long beside the thickness"
                  : "");
  return line;
}

nlohmann::ordered_json json_rolled(const homogenization::RolledCell &rolled)
{
  nlohmann::ordered_json json = {
    {"of", "mesh"}, {"tolerance", tolerated_stiffening}, {"says", roll_text(rolled)}};
  for (int degrees = 0; degrees < 180; degrees += 2)
  {
    const double angle = degrees * M_PI / 180.;
    json["degrees_from_x"].push_back(degrees);
    json["least_radius_m"].push_back(rolled.least_radius(angle, tolerated_stiffening));
    json["most_stiffening"].push_back(rolled.stiffest(angle));
  }
  return json;
}
} // namespace homespun::verification
