// SPDX-License-Identifier: MIT
#include "verification/stress/stress_cells.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Geometry>

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
Eigen::Matrix2d turn(const double degrees)
{
  return Eigen::Rotation2Dd(degrees * M_PI / 180.).toRotationMatrix();
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

std::vector<UnitCell> made_cells()
{
  const auto phase = [](const char *const name, const double E, const double angle)
  {
    Phase made = homogenization::isotropic(name, E, 0.3, 5e-4, 400.);
    made.angle = angle;
    return made;
  };
  constexpr int rows = 16;
  UnitCell stripes   = stripe_cell(rows, phase("soft", 1e6, 0.), phase("stiff", 1e7, 30.)),
           inclusion = inclusion_cell(rows, phase("soft", 1e6, 0.), phase("stiff", 1e7, 45.));
  stripes.name       = "stripes";
  inclusion.name     = "square inclusion";
  return {stripes, inclusion};
}

UnitCell with_sliver(const UnitCell &cell, const double height)
{
  // The triangle (a, b, c) becomes three about a point above the middle of its edge ab, of which
  // one is obtuse.
  UnitCell other             = cell;
  meshes::TriangleMesh &mesh = other.mesh;
  const int m = mesh.n_triangles(), v = mesh.n_vertices(), t = m / 2;
  const Eigen::RowVector3i corners = mesh.triangles.row(t);
  const Eigen::RowVector2d a = mesh.vertices.row(corners(0)), b = mesh.vertices.row(corners(1));
  mesh.vertices.conservativeResize(v + 1, 2);
  mesh.vertices.row(v) =
    0.5 * (a + b) + height * Eigen::RowVector2d(a(1) - b(1), b(0) - a(0)); // counter-clockwise
  mesh.triangles.conservativeResize(m + 2, 3);
  mesh.material.conservativeResize(m + 2);
  mesh.triangles.row(t) << corners(0), corners(1), v;
  mesh.triangles.row(m) << corners(1), corners(2), v;
  mesh.triangles.row(m + 1) << corners(2), corners(0), v;
  mesh.material(m) = mesh.material(m + 1) = mesh.material(t);
  return other;
}

UnitCell with_phases(const UnitCell &cell,
                     const std::function<void(Phase &phase, bool is_stiffest)> &change)
{
  UnitCell other    = cell;
  const double most = extremes_of(cell).second->E1;
  for (Phase &phase : other.phases)
    change(phase, phase.E1 == most);
  return other;
}

void set_poisson(Phase &phase, const double ratio)
{
  const double largest = std::sqrt(phase.E1 / phase.E2);
  phase.G12 *= (1. + phase.nu12 / largest) / (1. + ratio);
  phase.nu12 = ratio * largest;
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

UnitCell repeated(const UnitCell &cell, const int n1, const int n2)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n1, n2);
  UnitCell larger           = cell;
  larger.mesh               = sheet.mesh;
  larger.lattice.vectors    = sheet.sides();
  return larger;
}

UnitCell mapped(const UnitCell &cell, const Eigen::Matrix2d &A)
{
  UnitCell other        = cell;
  other.mesh.vertices   = cell.mesh.vertices * A.transpose();
  other.lattice.vectors = cell.lattice.vectors * A.transpose();
  if (A.determinant() < 0.)
  {
    other.mesh.triangles.col(1).swap(other.mesh.triangles.col(2));
    other.lattice.vectors.row(0).swap(other.lattice.vectors.row(1)); // a1 x a2 > 0 again
  }
  for (Phase &phase : other.phases)
  {
    const Eigen::Vector2d axis = A * turn(phase.angle).col(0);
    phase.angle                = std::atan2(axis(1), axis(0)) * 180. / M_PI;
  }
  return other;
}

UnitCell in_units(const UnitCell &cell, const Units &units)
{
  UnitCell other = mapped(cell, units.length * Eigen::Matrix2d::Identity());
  for (Phase &phase : other.phases)
  {
    phase.thickness *= units.thickness;
    for (double *value : {&phase.E1, &phase.E2, &phase.G12})
      *value *= units.modulus;
  }
  return other;
}

void refuse_unsound(const UnitCell &cell)
{
  std::vector<std::string> faults = meshes::faults_of(cell.mesh, "cell");
  for (const Phase &phase : cell.phases)
    for (const std::string &fault : homogenization::faults_of(phase))
      faults.push_back(fault);
  if (faults.empty())
    faults = meshes::periodicity_faults(cell.mesh, cell.lattice, "cell");
  if (!faults.empty())
    throw meshes::BadInput(faults);
}

homogenization::Homogenization solved(const UnitCell &cell, const unsigned int order)
{
  refuse_unsound(cell);
  homogenization::HomogenizationOptions options;
  options.order = order;
  return homogenization::homogenize(cell, options, MPI_COMM_SELF);
}
} // namespace homespun::verification
