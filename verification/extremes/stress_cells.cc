// SPDX-License-Identifier: MIT
#include "verification/extremes/stress_cells.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace homespun::verification
{
namespace
{
constexpr double cell_side = 0.01; ///< of the built-in cells [m]

std::size_t index(const Eigen::Index i)
{
  return static_cast<std::size_t>(i);
}

/// Drops vertices that no triangle uses.
void drop_unused(meshes::TriangleMesh &mesh)
{
  std::vector<int> place(index(mesh.n_vertices()), -1);
  meshes::Points kept(mesh.n_vertices(), 2);
  int n = 0;
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int v = mesh.triangles(t, k);
      if (place[index(v)] < 0)
      {
        kept.row(n)     = mesh.vertices.row(v);
        place[index(v)] = n++;
      }
      mesh.triangles(t, k) = place[index(v)];
    }
  mesh.vertices = kept.topRows(n);
}

bool is_in_lower_half(const double y)
{
  return y < 0.5;
}
} // namespace

GridLines equal_lines(const int n)
{
  GridLines lines;
  for (int i = 0; i <= n; ++i)
    lines.push_back(static_cast<double>(i) / n);
  return lines;
}

UnitCell grid_cell(const GridLines &x, const GridLines &y, const std::vector<Phase> &phases,
                   const std::function<int(double x, double y)> &phase_at)
{
  const int n1 = static_cast<int>(x.size()) - 1, n2 = static_cast<int>(y.size()) - 1;
  UnitCell cell;
  cell.name            = "built-in";
  cell.phases          = phases;
  cell.lattice.vectors = cell_side * Eigen::Matrix2d::Identity();
  cell.mesh            = meshes::coarse_sheet({0., 0.}, Eigen::Matrix2d::Identity(), n1, n2);
  for (int j = 0; j <= n2; ++j)
    for (int i = 0; i <= n1; ++i)
      cell.mesh.vertices.row(j * (n1 + 1) + i) << cell_side * x[index(i)], cell_side * y[index(j)];
  cell.mesh.material.resize(cell.mesh.n_triangles());
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const std::size_t i = index(t / 2 % n1), j = index(t / 2 / n1);
    cell.mesh.material(t) = phase_at(0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1]));
  }
  return cell;
}

UnitCell stripe_cell(const int n, const Phase &lower, const Phase &upper)
{
  return grid_cell(equal_lines(n), equal_lines(n), {lower, upper},
                   [](double, const double y) { return is_in_lower_half(y) ? 0 : 1; });
}

UnitCell inclusion_cell(const int n, const Phase &matrix, const Phase &inclusion)
{
  return grid_cell(equal_lines(n), equal_lines(n), {matrix, inclusion},
                   [](const double x, const double y)
                   { return std::abs(x - 0.5) < 0.25 && std::abs(y - 0.5) < 0.25 ? 1 : 0; });
}

UnitCell islands_cell(const int n, const Phase &matrix, const Phase &islands)
{
  const auto within = [](const double x, const double middle, const double half)
  { return std::abs(x - middle) < half; };
  return grid_cell(equal_lines(n), equal_lines(n), {matrix, islands},
                   [&](const double x, const double y)
                   {
                     return (within(x, 0.25, 0.125) && within(y, 0.5, 0.375)) ||
                                (within(x, 0.75, 0.125) && within(y, 0.625, 0.125))
                              ? 1
                              : 0;
                   });
}

UnitCell without_phase(const UnitCell &cell, const int phase)
{
  UnitCell rest = cell;
  int n         = 0;
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    if (cell.mesh.material(t) != phase)
    {
      rest.mesh.triangles.row(n) = cell.mesh.triangles.row(t);
      rest.mesh.material(n++)    = cell.mesh.material(t);
    }
  rest.mesh.triangles.conservativeResize(n, 3);
  rest.mesh.material.conservativeResize(n);
  drop_unused(rest.mesh);
  return rest;
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

namespace
{
/// The lattice vectors by which a triangle is moved so that its middle lies in the parallelogram
/// that begins at a point.
Eigen::RowVector2i move_into(const UnitCell &cell, const int t, const Eigen::RowVector2d &origin)
{
  Eigen::RowVector2d middle = Eigen::RowVector2d::Zero();
  for (int k = 0; k < 3; ++k)
    middle += cell.mesh.vertices.row(cell.mesh.triangles(t, k)) / 3.;
  const Eigen::RowVector2d f = cell.lattice.fractional(middle) - origin;
  return {-static_cast<int>(std::floor(f(0))), -static_cast<int>(std::floor(f(1)))};
}
} // namespace

bool cuts_a_hole(const UnitCell &cell, const Eigen::RowVector2d &origin)
{
  std::vector<int> hole_of(static_cast<std::size_t>(cell.mesh.n_vertices()), -1);
  const std::vector<std::vector<int>> loops = meshes::boundary_loops(cell.mesh);
  const std::vector<int> outline            = meshes::outline(cell.mesh);
  for (std::size_t k = 0; k < loops.size(); ++k)
    if (std::find(loops[k].begin(), loops[k].end(), outline.front()) == loops[k].end())
      for (const int v : loops[k])
        hole_of[index(v)] = static_cast<int>(k);
  std::map<int, Eigen::RowVector2i> move_of; // of a hole
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const int hole = hole_of[index(cell.mesh.triangles(t, k))]; hole >= 0)
      {
        const Eigen::RowVector2i move = move_into(cell, t, origin);
        if (move_of.emplace(hole, move).first->second != move)
          return true;
      }
  return false;
}

UnitCell shifted(const UnitCell &cell, const Eigen::RowVector2d &origin)
{
  const meshes::ImageClasses classes = meshes::match_images(cell.mesh.vertices, cell.lattice);
  UnitCell other                     = cell;
  std::vector<Eigen::RowVector2d> points;
  std::map<std::array<int, 3>, int> vertex_of; // by class and the lattice point it is moved by
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
  {
    const Eigen::RowVector2i move = move_into(cell, t, origin);
    for (int k = 0; k < 3; ++k)
    {
      const int v = cell.mesh.triangles(t, k), r = classes.representative[index(v)];
      const Eigen::RowVector2i n = classes.offset.row(v) + move;
      const auto [place, is_new] =
        vertex_of.emplace(std::array<int, 3>{r, n(0), n(1)}, static_cast<int>(points.size()));
      if (is_new)
        points.emplace_back(cell.mesh.vertices.row(r) + n.cast<double>() * cell.lattice.vectors);
      other.mesh.triangles(t, k) = place->second;
    }
  }
  other.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 2);
  for (std::size_t v = 0; v < points.size(); ++v)
    other.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v];
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

UnitCell turned(const UnitCell &cell, const double angle)
{
  const double a = angle * M_PI / 180.;
  Eigen::Matrix2d Q;
  Q << std::cos(a), -std::sin(a), std::sin(a), std::cos(a);
  UnitCell other        = cell;
  other.mesh.vertices   = cell.mesh.vertices * Q.transpose();
  other.lattice.vectors = cell.lattice.vectors * Q.transpose();
  for (Phase &phase : other.phases)
    phase.angle += angle;
  return other;
}

UnitCell mirrored(const UnitCell &cell)
{
  UnitCell other = cell;
  other.mesh.vertices.col(0) *= -1.;
  other.mesh.triangles.col(1) = cell.mesh.triangles.col(2);
  other.mesh.triangles.col(2) = cell.mesh.triangles.col(1);
  other.lattice.vectors.col(0) *= -1.;
  other.lattice.vectors.row(0).swap(other.lattice.vectors.row(1)); // a1 x a2 > 0 again
  for (Phase &phase : other.phases)
    phase.angle = -phase.angle;
  return other;
}

UnitCell in_units(const UnitCell &cell, const double length, const double thickness,
                  const double modulus)
{
  UnitCell other = cell;
  other.mesh.vertices *= length;
  other.lattice.vectors *= length;
  for (Phase &phase : other.phases)
  {
    phase.thickness *= thickness;
    for (double *value : {&phase.E1, &phase.E2, &phase.G12})
      *value *= modulus;
  }
  return other;
}

bool has_contrast(const UnitCell &cell)
{
  const auto softer        = [](const Phase &a, const Phase &b) { return a.E1 < b.E1; };
  const auto [soft, stiff] = std::minmax_element(cell.phases.begin(), cell.phases.end(), softer);
  return soft->E1 < stiff->E1;
}

UnitCell with_contrast(const UnitCell &cell, const double contrast)
{
  if (!has_contrast(cell))
    throw meshes::BadInput(cell.name +
                           ": all phases have the same Young's modulus; expected two that differ");
  double least = cell.phases[0].E1, most = least;
  for (const Phase &phase : cell.phases)
  {
    least = std::min(least, phase.E1);
    most  = std::max(most, phase.E1);
  }
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

Eigen::Matrix3d moved_tensor(const Eigen::Matrix3d &C, const Eigen::Matrix2d &Q)
{
  const int voigt[2][2]  = {{0, 2}, {2, 1}};
  Eigen::Matrix3d moved  = Eigen::Matrix3d::Zero();
  const int row_of[3][2] = {{0, 0}, {1, 1}, {0, 1}};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
          for (int r = 0; r < 2; ++r)
            for (int s = 0; s < 2; ++s)
              moved(a, b) += Q(row_of[a][0], p) * Q(row_of[a][1], q) * Q(row_of[b][0], r) *
                             Q(row_of[b][1], s) * C(voigt[p][q], voigt[r][s]);
  return moved;
}

Eigen::Matrix3d factorized_stiffness(const UnitCell &cell)
{
  const meshes::TriangleMesh &mesh            = cell.mesh;
  const std::vector<Eigen::Matrix3d> of_phase = cell.stiffness_of_phase();
  const meshes::ImageClasses classes          = meshes::match_images(mesh.vertices, cell.lattice);
  std::vector<int> node(index(mesh.n_vertices()), -1); // the first class is held: node −1
  int n = 0;
  for (int v = 1; v < mesh.n_vertices(); ++v)
  {
    const int r    = classes.representative[index(v)];
    node[index(v)] = r == v ? n++ : node[index(r)];
  }

  // B of each triangle, its strains being B u.
  const Eigen::VectorXd areas = meshes::signed_areas(mesh);
  const auto B_of             = [&](const int t)
  {
    Eigen::Matrix<double, 3, 6> B;
    for (int k = 0; k < 3; ++k)
    {
      const Eigen::RowVector2d opposite = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) -
                                          mesh.vertices.row(mesh.triangles(t, (k + 1) % 3));
      const double gx = -opposite(1) / (2. * areas(t)), gy = opposite(0) / (2. * areas(t));
      B.col(2 * k) << gx, 0., gy;
      B.col(2 * k + 1) << 0., gy, gx;
    }
    return B;
  };
  const auto dof = [&](const int t, const int i)
  {
    const int at = node[index(mesh.triangles(t, i / 2))];
    return at < 0 ? -1 : 2 * at + i % 2;
  };

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(2 * n, 3);
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const Eigen::Matrix<double, 3, 6> B = B_of(t);
    const Eigen::Matrix<double, 6, 3> rows =
      areas(t) * B.transpose() * of_phase[index(mesh.material(t))];
    const Eigen::Matrix<double, 6, 6> K = rows * B;
    for (int i = 0; i < 6; ++i)
      if (dof(t, i) >= 0)
      {
        loads.row(dof(t, i)) += rows.row(i);
        for (int j = 0; j < 6; ++j)
          if (dof(t, j) >= 0)
            entries.emplace_back(dof(t, i), dof(t, j), K(i, j));
      }
  }
  Eigen::MatrixXd chi = Eigen::MatrixXd::Zero(2 * n, 3);
  if (n > 0)
  {
    Eigen::SparseMatrix<double> matrix(2 * n, 2 * n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
    if (factors.info() != Eigen::Success)
      throw meshes::NotConverged("the factorization of the cell problem broke down", {});
    chi = factors.solve(loads);
    chi += factors.solve(loads - matrix * chi); // one refinement removes what the pivots lost
  }
  Eigen::Matrix3d energy = Eigen::Matrix3d::Zero();
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Eigen::Matrix<double, 6, 3> u = Eigen::Matrix<double, 6, 3>::Zero();
    for (int i = 0; i < 6; ++i)
      if (dof(t, i) >= 0)
        u.row(i) = chi.row(dof(t, i));
    const Eigen::Matrix3d strain = Eigen::Matrix3d::Identity() - B_of(t) * u;
    energy += areas(t) * strain.transpose() * of_phase[index(mesh.material(t))] * strain;
  }
  return energy / cell.lattice.area();
}
} // namespace homespun::verification
