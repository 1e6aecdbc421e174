// SPDX-License-Identifier: MIT
#include "verification/stress/stress_cells.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/sheet.h"
#include "verification/cell/algebraic_limit.h"

#include <algorithm>
#include <cmath>

namespace homespun::verification
{
namespace
{
constexpr double cell_side = 0.01; ///< of the cells made here [m]

std::size_t index(const int i)
{
  return static_cast<std::size_t>(i);
}

std::vector<double> equal_lines(const int n)
{
  std::vector<double> lines;
  for (int i = 0; i <= n; ++i)
    lines.push_back(static_cast<double>(i) / n);
  return lines;
}

/// n columns of two triangles per rectangle.
/// @param rows where their sides stand, in parts of the cell's
/// @param phase_at of the middle of a rectangle
UnitCell grid_cell(const int n, const std::vector<double> &rows, const std::vector<Phase> &phases,
                   int (*const phase_at)(double x, double y))
{
  const int n_rows                  = static_cast<int>(rows.size()) - 1;
  const std::vector<double> columns = equal_lines(n);
  UnitCell cell;
  cell.name            = "built-in";
  cell.phases          = phases;
  cell.lattice.vectors = cell_side * Eigen::Matrix2d::Identity();
  cell.mesh            = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), n, n_rows);
  for (int j = 0; j <= n_rows; ++j)
    for (int i = 0; i <= n; ++i)
      cell.mesh.vertices.row(j * (n + 1) + i) << cell_side * columns[index(i)],
        cell_side * rows[index(j)];
  cell.mesh.material.resize(cell.mesh.n_triangles());
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const std::size_t i = index(t / 2 % n), j = index(t / 2 / n);
    cell.mesh.material(t) =
      phase_at(0.5 * (columns[i] + columns[i + 1]), 0.5 * (rows[j] + rows[j + 1]));
  }
  return cell;
}

/// The softest and the stiffest phase.
auto extremes_of(const UnitCell &cell)
{
  return std::minmax_element(cell.phases.begin(), cell.phases.end(),
                             [](const Phase &a, const Phase &b) { return a.E1 < b.E1; });
}
} // namespace

UnitCell stripe_cell(const int n, const Phase &lower, const Phase &upper, const double thin)
{
  std::vector<double> rows = equal_lines(n);
  if (thin < 1.)
    rows.insert(rows.begin() + n / 2 + 1, 0.5 + thin / n);
  return grid_cell(n, rows, {lower, upper}, [](double, const double y) { return y < 0.5 ? 0 : 1; });
}

UnitCell inclusion_cell(const int n, const Phase &matrix, const Phase &inclusion)
{
  return grid_cell(n, equal_lines(n), {matrix, inclusion},
                   [](const double x, const double y)
                   { return std::abs(x - 0.5) < 0.25 && std::abs(y - 0.5) < 0.25 ? 1 : 0; });
}

UnitCell capped_stripes(const int n, const Phase &lower, const Phase &upper, const double height)
{
  // The lower triangle (a, b, c) of a rectangle in the lower layer becomes three about a point
  // above the middle of its edge ab, of which one is obtuse.
  UnitCell cell                    = stripe_cell(n, lower, upper);
  meshes::TriangleMesh &mesh       = cell.mesh;
  const int t                      = 2 * (n * (n / 4) + n / 2);
  const Eigen::RowVector3i corners = mesh.triangles.row(t);
  const int m = mesh.n_triangles(), v = mesh.n_vertices();
  mesh.vertices.conservativeResize(v + 1, 2);
  mesh.vertices.row(v) = 0.5 * (mesh.vertices.row(corners(0)) + mesh.vertices.row(corners(1)));
  mesh.vertices(v, 1) += height * cell_side / n;
  mesh.triangles.conservativeResize(m + 2, 3);
  mesh.material.conservativeResize(m + 2);
  mesh.triangles.row(t) << corners(0), corners(1), v;
  mesh.triangles.row(m) << corners(1), corners(2), v;
  mesh.triangles.row(m + 1) << corners(2), corners(0), v;
  mesh.material(m) = mesh.material(m + 1) = mesh.material(t);
  return cell;
}

bool has_contrast(const UnitCell &cell)
{
  const auto [soft, stiff] = extremes_of(cell);
  return soft->E1 < stiff->E1;
}

UnitCell with_contrast(const UnitCell &cell, const double contrast)
{
  const auto [soft, stiff] = extremes_of(cell);
  const double least = soft->E1, most = stiff->E1;
  UnitCell other = cell;
  for (Phase &phase : other.phases)
  {
    const double factor =
      std::pow(contrast, std::log(phase.E1 / least) / std::log(most / least)) * least / phase.E1;
    for (double *value : {&phase.E1, &phase.E2, &phase.G12})
      *value *= factor;
  }
  return other;
}

homogenization::Homogenization solved(const UnitCell &cell, const unsigned int order)
{
  homogenization::HomogenizationOptions options;
  options.order = order;
  return homogenization::homogenize(cell, options, MPI_COMM_SELF);
}

Limit limit_of(const UnitCell &cell, const std::string &is)
{
  const int n = cell.mesh.n_triangles();
  // Beyond what algebraic_limit() has: one rounding of the mean for each triangle.
  const double of_size = n > 100000 ? n * meshes::epsilon : 0.;
  return {algebraic_limit(cell, std::sqrt(0.5 * n)) + of_size, is,
          "round-off: 1e-11 for sums over up to 1e5 triangles, 2.2e-16 for each where there are "
          "more; (rows x 2.2e-16 x contrast)^2 for a stiff part that a soft one holds; 16 x "
          "2.2e-16 x anisotropy of a phase, whose entries are rounded"};
}
} // namespace homespun::verification
