// SPDX-License-Identifier: MIT
#include "localization/garment/unit_question.h"

#include "meshes/cloth/seams.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace homespun::localization
{
namespace
{
std::string text_of(const double value, const int digits)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.*g", digits, value);
  return text;
}

/// The roundest number within 5 % of another.
std::string round_text(const double value)
{
  double rounded = 0.;
  for (int digits = 1; digits <= 3 && !(std::abs(rounded - value) <= 0.05 * value); ++digits)
    rounded = std::stod(text_of(value, digits));
  return text_of(rounded, 6);
}

std::string percent_text(const double value)
{
  return text_of(100. * value, 3) + " %";
}

/// An answer as it is given; without a value a name, of a switch with the value `True` in Python.
std::string answer(const RestUnits &units, std::string name, const std::string &value = "")
{
  const bool is_keyword = units.answer == AnswerBy::keyword;
  if (is_keyword)
    std::replace(name.begin(), name.end(), '-', '_');
  return (is_keyword ? "`" : "`--") + name +
         (value.empty() ? "" : (is_keyword ? "=" : " ") + value) + "`";
}

std::string or_else(const RestUnits &units)
{
  return "; " + answer(units, "accept-strain", units.answer == AnswerBy::keyword ? "True" : "") +
         " goes on as it is";
}

/// Means over the triangles by rest area: of the larger principal strain without its sign, and of
/// how much shorter a triangle is than at rest.
struct MeanStrain
{
  double strain = 0., compression = 0.;
};

MeanStrain mean_strain(const meshes::ClothMesh &rest, const CoarseFrames<3> &coarse,
                       const meshes::SpacePoints &positions)
{
  const Eigen::VectorXi space = meshes::space_of_rest(rest);
  Positions<3> at_rest_vertices(space.size(), 3);
  for (Eigen::Index v = 0; v < space.size(); ++v)
    at_rest_vertices.row(v) = positions.row(space(v));
  const Eigen::VectorXd areas = meshes::signed_areas(rest.rest);
  MeanStrain mean;
  for (int t = 0; t < rest.n_triangles(); ++t)
  {
    const PrincipalStrain its = principal_strain(coarse.of_triangle(t, at_rest_vertices).strain);
    mean.strain += areas(t) / areas.sum() * its.largest();
    mean.compression += areas(t) / areas.sum() * its.compression();
  }
  return mean;
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
  return units.file + ": triangle " + std::to_string(of) + " is " + text_of(longest, 6) +
         " m long at rest, which are " + round_text(longest / cell_side) +
         " cells; expected a hundred at most: is " +
         (units.has_vt ? "vt in metres? " + answer(units, "vt-unit", "0.01") + " takes centimetres"
                       : "it in metres? " + answer(units, "unit", "0.01") +
                           " takes rest mesh and frames in centimetres") +
         ", 0.001 millimetres" + or_else(units);
}

std::string question_of_strain(const meshes::ClothMesh &rest, const CoarseFrames<3> &coarse,
                               const std::string &frame, const meshes::SpacePoints &positions,
                               const RestUnits &units)
{
  const auto [strain, compression] = mean_strain(rest, coarse, positions);
  const bool is_pressed            = compression > questionable_compression;
  if (!is_pressed && !(strain > questionable_strain))
    return "";
  const double stretch = stretch_of(rest, positions);
  std::string text     = frame + ": against " + (frame == units.file ? "its vt" : units.file) +
                     (is_pressed ? " it is pressed together by " + percent_text(compression)
                                 : " it is strained by " + percent_text(strain)) +
                     " in the mean; expected " +
                     percent_text(is_pressed ? questionable_compression : questionable_strain) +
                     " at most: ";
  if (units.has_vt)
  {
    text += "are positions and vt in metres? " +
            answer(units, "vt-unit", round_text(units.vt_unit * stretch)) +
            " makes them fit where positions are, " +
            answer(units, "unit", round_text(units.unit / stretch)) + " where vt is";
    if (units.may_be_flat)
      text += ", " + answer(units, "flat", units.answer == AnswerBy::keyword ? "True" : "") +
              " takes x and y of the rest mesh for the rest state";
  }
  else
    text += "are the rest mesh and the frames in one unit? lengths differ by a factor of " +
            round_text(stretch) + ": write both in one, which " + answer(units, "unit") + " names";
  return text + or_else(units);
}
} // namespace homespun::localization
