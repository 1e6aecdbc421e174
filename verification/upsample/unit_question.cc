// SPDX-License-Identifier: MIT
#include "verification/upsample/unit_question.h"

#include "verification/record/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace homespun::verification
{
namespace
{
constexpr const char *or_else = "; `--accept-strain` goes on as it is";

/// The roundest number within 5 % of another.
std::string round_text(const double value)
{
  char text[32];
  for (const int digits : {1, 2, 3})
  {
    std::snprintf(text, sizeof(text), "%.*g", digits, value);
    if (std::abs(std::stod(text) - value) <= 0.05 * value)
      break;
  }
  return text;
}

/// How much longer lengths are in space than at rest: the root of the ratio of the areas.
double stretch_of(const meshes::ClothMesh &rest, const meshes::SpacePoints &positions)
{
  double in_space = 0.;
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const Eigen::RowVector3d a = positions.row(rest.triangles(t, 0)),
                             b = positions.row(rest.triangles(t, 1)),
                             c = positions.row(rest.triangles(t, 2));
    in_space += 0.5 * (b - a).cross(c - a).norm();
  }
  return std::sqrt(in_space / meshes::signed_areas(rest.rest).sum());
}
} // namespace

std::string question_of_cells(const meshes::ClothMesh &rest, const double cell_side,
                              const RestUnits &units)
{
  double longest = 0.;
  int of         = 0;
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const double length = (rest.rest.vertices.row(rest.rest.triangles(t, (k + 1) % 3)) -
                             rest.rest.vertices.row(rest.rest.triangles(t, k)))
                              .norm();
      if (length > longest)
      {
        longest = length;
        of      = t;
      }
    }
  if (!(longest > questionable_cells * cell_side))
    return "";
  return units.file + ": triangle " + std::to_string(of) + " is " + short_text(longest) +
         " m long at rest, which are " + round_text(longest / cell_side) +
         " cells; expected a hundred at most: is " +
         (units.has_vt ? "vt in metres? `--vt-unit 0.01` takes centimetres"
                       : "it in metres? `--unit 0.01` takes rest mesh and frames in centimetres") +
         ", 0.001 millimetres" + or_else;
}

std::string question_of_strain(const meshes::ClothMesh &rest, const std::string &frame,
                               const meshes::SpacePoints &positions, const double strain,
                               const double compression, const RestUnits &units)
{
  const bool is_pressed = compression > questionable_compression;
  if (!is_pressed && !(strain > questionable_strain))
    return "";
  const double stretch = stretch_of(rest, positions);
  std::string text     = frame + ": against " + units.file +
                     (is_pressed ? " it is pressed together by " + percent_text(compression)
                                 : " it is strained by " + percent_text(strain)) +
                     " in the mean; expected " +
                     percent_text(is_pressed ? questionable_compression : questionable_strain) +
                     " at most: ";
  if (units.has_vt)
  {
    text += "are positions and vt in metres? `--vt-unit " + round_text(units.vt_unit * stretch) +
            "` makes them fit where positions are, `--unit " + round_text(units.unit / stretch) +
            "` where vt is";
    if (units.may_be_flat)
      text += ", `--flat` takes x and y of the rest mesh for the rest state";
  }
  else
    text += "are the rest mesh and the frames in one unit? lengths differ by a factor of " +
            round_text(stretch) + ": write both in one, which `--unit` names";
  return text + or_else;
}
} // namespace homespun::verification
