// SPDX-License-Identifier: MIT
#include "localization/upsampler_faults.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::localization
{
void check_lattice(const meshes::HomogenizedCell &cell, const meshes::Lattice &lattice,
                   const std::string &name, std::vector<std::string> &faults)
{
  const double gap = (cell.lattice.vectors - lattice.vectors).cwiseAbs().maxCoeff();
  if (!(gap <= meshes::image_tolerance * std::sqrt(lattice.area())))
  {
    std::ostringstream text;
    text << name << ": its lattice vectors differ from the cell's by " << gap
         << " m; expected the same cell in both";
    faults.push_back(text.str());
  }
}

void check_image(const meshes::HomogenizedCell &cell, const int vertex,
                 const Eigen::RowVector2d &place, const std::string &name, const int fine,
                 std::vector<std::string> &faults)
{
  // What another program's single precision may leave.
  const double tolerance = 1e-5 * std::sqrt(cell.lattice.area()),
               gap       = cell.lattice.shortest(place - cell.mesh.vertices.row(vertex)).norm();
  if (gap <= tolerance)
    return;
  std::ostringstream text;
  text << name << ": vertex " << fine << " lies " << gap << " m from vertex " << vertex
       << " of the cell and its images; expected none: it was tiled from another cell";
  faults.push_back(text.str());
}

std::vector<std::string> sheet_faults(const meshes::HomogenizedCell &cell,
                                      const meshes::Sheet &sheet)
{
  std::vector<std::string> faults;
  const int n = sheet.mesh.n_vertices();
  if (sheet.n1 < 1 || sheet.n2 < 1 || sheet.n_per_cell < 1 || sheet.begin_of_eighth.front() != 0 ||
      sheet.begin_of_eighth.back() != sheet.n_per_cell ||
      !std::is_sorted(sheet.begin_of_eighth.begin(), sheet.begin_of_eighth.end()) ||
      n < sheet.n1 * sheet.n2 * sheet.n_per_cell)
    faults.push_back("fine sheet: its numbers of cells and of vertices per cell do not fit its " +
                     std::to_string(n) + " vertices; make it by meshes::tile()");
  if (sheet.cell_vertex.size() != n)
    faults.push_back("fine sheet: has " + std::to_string(sheet.cell_vertex.size()) +
                     " entries in cell_vertex; expected " + std::to_string(n) + ", one per vertex");
  else if (n > 0 && (sheet.cell_vertex.minCoeff() < 0 ||
                     sheet.cell_vertex.maxCoeff() >= cell.mesh.n_vertices()))
    faults.push_back("fine sheet: names cell vertex " +
                     std::to_string(sheet.cell_vertex.minCoeff() < 0
                                      ? sheet.cell_vertex.minCoeff()
                                      : sheet.cell_vertex.maxCoeff()) +
                     "; expected 0 ... " + std::to_string(cell.mesh.n_vertices() - 1) +
                     ": it was tiled from another cell");
  check_lattice(cell, sheet.lattice, "fine sheet", faults);
  for (int v = 0; v < n && faults.empty(); ++v)
    check_image(cell, sheet.cell_vertex(v), sheet.mesh.vertices.row(v), "fine sheet", v, faults);
  return faults;
}

std::vector<std::string> mode_faults(const UpsamplerOptions &options)
{
  std::vector<std::string> faults;
  if (!options.second_order.empty() && options.strain == Strain::linear)
    faults.push_back("up-sampling: quadratic modes of the law " + options.second_order +
                     " are asked for with the linear strain; expected Strain::biot, whose second "
                     "order they are");
  if (options.surface == Surface::curved && options.microscopic &&
      (options.lift == Lift::identity || options.blend != Blend::continuous))
    faults.emplace_back("up-sampling: a curved surface is asked for with Lift::identity or "
                        "Blend::piecewise; expected neither");
  if (options.fitted == nullptr)
    return faults;
  if (options.strain == Strain::linear)
    faults.emplace_back("up-sampling: fitted modes are asked for with the linear strain; expected "
                        "Strain::biot, over which they are fitted");
  if (!options.second_order.empty())
    faults.push_back("up-sampling: fitted modes are asked for beside quadratic ones of the law " +
                     options.second_order + "; expected one of the two");
  if (options.blend != Blend::continuous)
    faults.emplace_back("up-sampling: fitted modes are asked for with Blend::piecewise; expected "
                        "Blend::continuous");
  return faults;
}

} // namespace homespun::localization
