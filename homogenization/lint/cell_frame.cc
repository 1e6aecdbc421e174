// SPDX-License-Identifier: MIT
#include "homogenization/lint/cell_frame.h"

#include "meshes/plain/drawn_lattice.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

namespace homespun::homogenization
{
MatchedCell match_drawn_sides(const meshes::TriangleMesh &mesh,
                              const std::vector<CurvedSide> &curved_sides, const SideRules &rules,
                              const std::string &name)
{
  const Eigen::RowVector2d box =
    mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff();
  const double gap = image_gap(rules, {Eigen::Matrix2d(box.asDiagonal())});
  std::optional<MatchedCell> nearly; // a frame that has images on all sides, but faults
  const auto fits = [&](const meshes::Frame &frame) -> std::optional<MatchedCell>
  {
    MatchedCell cell = match_sides(mesh, curved_sides, frame.lattice, rules, name);
    for (const Eigen::RowVector2i &pair : frame.pairs)
      if (std::none_of(cell.matched_offsets.begin(), cell.matched_offsets.end(),
                       [&](const Eigen::RowVector2i &offset)
                       { return offset == pair || offset == -pair; }))
        return std::nullopt;
    if (cell.faults.empty())
      return cell;
    if (!nearly)
      nearly = std::move(cell);
    return std::nullopt;
  };
  std::optional<MatchedCell> found;
  for (const meshes::Frame &frame : meshes::frames_of(mesh, gap))
    if (auto cell = fits(frame))
    {
      if (!found)
        found = std::move(cell);
      else if (std::abs(cell->lattice.area() / found->lattice.area() - 1.) > 1e-3)
        found->alternatives.push_back(cell->lattice);
    }
  if (found)
  {
    if (found->cuts_holes)
      for (const meshes::Lattice &lattice : meshes::lattices_of_outline(found->mesh, gap))
        if (std::abs(lattice.area() / found->lattice.area() - 1.) > 1e-3)
          found->alternatives.push_back(lattice);
    return *found;
  }
  MatchedCell cell{{}, mesh, curved_sides, 0., -1, false, {}, {}, {}};
  std::string lines;
  for (const meshes::Frame &frame : meshes::frame_meant(mesh))
    if (!nearly && fits(frame))
      cell.alternatives.push_back(frame.lattice);
  for (const meshes::Lattice &lattice : meshes::lattices_of_outline(mesh, gap))
    if (match_sides(mesh, curved_sides, lattice, rules, name).faults.empty())
      cell.alternatives.push_back(lattice);
  for (const meshes::Lattice &lattice : cell.alternatives)
    lines += (lines.empty() ? " `" : " or `") + lattice_line(lattice, rules.metres_per_unit) + "`";
  if (nearly && lines.empty())
  {
    cell.lattice = nearly->lattice;
    cell.faults  = std::move(nearly->faults);
    return cell;
  }
  cell.faults.push_back(
    {name +
       ": `Lattice vectors` = auto: neither the parallelogram or hexagon around the drawing nor "
       "its bounding box has edges on all of its sides that are periodic images: " +
       (lines.empty()
          ? "the frame is another one, or opposite sides are not meshed alike; expected "
            "`Lattice vectors`: give the two translations that repeat the cell, and mesh opposite "
            "sides alike (Gmsh: Periodic Curve)"
          : "the outline is wavy or toothed; expected the line" + lines +
              ", under which the whole outline matches"),
     {}});
  return cell;
}

MatchedCell match_given_or_drawn_sides(const meshes::TriangleMesh &mesh,
                                       const std::vector<CurvedSide> &curved_sides,
                                       const std::optional<meshes::Lattice> &given,
                                       const SideRules &rules, const std::string &name)
{
  const auto matched_by = [&](const SideRules &these)
  {
    return given ? match_sides(mesh, curved_sides, *given, these, name)
                 : match_drawn_sides(mesh, curved_sides, these, name);
  };
  MatchedCell cell = matched_by(rules);
  SideRules wider  = rules;
  for (const double tolerance : {1e-6, 1e-5, 1e-4, 1e-3})
  {
    if (cell.faults.empty() || !cell.alternatives.empty())
      break;
    wider.tolerance         = tolerance;
    const MatchedCell other = matched_by(wider);
    const double gap        = image_gap(rules, other.lattice);
    if (!other.faults.empty() || other.moved_vertex < 0 || image_gap(wider, other.lattice) <= gap)
      continue;
    std::ostringstream text;
    text.precision(6);
    text << name << ": opposite sides match only within a wider tolerance than " << gap
         << " m: onto its images vertex " << other.moved_vertex << " at ("
         << mesh.vertices.row(other.moved_vertex) << ") m would move farthest, by "
         << other.largest_move
         << " m; expected coordinates in double precision with 16 digits: write them anew; where "
            "there are no more digits, as in single precision far from the origin, add the line "
            "`set Matching tolerance = "
         << tolerance << "`";
    // A single point off its place is named as well; of more it is their digits.
    if (cell.faults.size() > 1 || !cell.faults[0].place.is_known())
      cell.faults.clear();
    cell.faults.insert(
      cell.faults.begin(),
      {text.str(), {mesh.vertices.row(other.moved_vertex), -1, other.moved_vertex}});
    break;
  }
  return cell;
}

std::string lattice_line(const meshes::Lattice &lattice, const double metres_per_unit)
{
  std::ostringstream text;
  text.precision(12);
  // Round-off of the unit prints as zero.
  const auto number = [&](const int row, const int column)
  {
    const double value = lattice.vectors(row, column) / metres_per_unit;
    return std::abs(value) < 1e-12 * lattice.vectors.norm() / metres_per_unit ? 0. : value;
  };
  text << "set Lattice vectors = " << number(0, 0) << " " << number(0, 1) << "; " << number(1, 0)
       << " " << number(1, 1);
  return text.str();
}
} // namespace homespun::homogenization
