// SPDX-License-Identifier: MIT
#include "verification/converge/closed_strip.h"

#include "homogenization/algebra/cholesky_factor.h"
#include "localization/coarse_frames.h"
#include "localization/edge_modes.h"
#include "meshes/plain/gauss_rule.h"
#include "meshes/plain/sheet.h"
#include "meshes/plain/triangle_kinematics.h"

#include <Eigen/LU>

#include <cmath>
#include <complex>
#include <map>
#include <vector>

namespace homespun::verification
{
namespace
{
using Complex  = std::complex<double>;
using Complex2 = Eigen::Vector2cd;
using Complex3 = Eigen::Vector3cd;

constexpr int degree   = 24; ///< of the polynomials in y: exp(−2 pi y) to round-off
constexpr int n_points = degree + 4;

/// The strain (11, 22, engineering 12) of a gradient along a direction.
Eigen::Matrix<double, 3, 2> strain_along(const Eigen::Vector2d &d)
{
  Eigen::Matrix<double, 3, 2> B;
  B << d(0), 0., 0., d(1), d(1), d(0);
  return B;
}

/// Polynomials on (0, height) by their values at the nodes of Chebyshev, both ends among them.
class Polynomials
{
public:
  explicit Polynomials(const double height)
      : height(height)
  {
    for (int i = 0; i <= degree; ++i)
      nodes(i) = 0.5 * height * (1. - std::cos(M_PI * i / degree));
  }

  /// Value, first and second derivative of each polynomial at a place.
  Eigen::Matrix<double, 3, degree + 1> at(const double y) const
  {
    Eigen::Matrix<double, 3, degree + 1> result;
    for (int i = 0; i <= degree; ++i)
    {
      Eigen::Vector3d value(1., 0., 0.);
      for (int j = 0; j <= degree; ++j)
        if (j != i)
        {
          const double slope = 1. / (nodes(i) - nodes(j)), factor = (y - nodes(j)) * slope;
          value = Eigen::Vector3d(value(0) * factor, value(1) * factor + value(0) * slope,
                                  value(2) * factor + 2. * value(1) * slope);
        }
      result.col(i) = value;
    }
    return result;
  }

  const double height;

private:
  Eigen::Matrix<double, degree + 1, 1> nodes;
};

/// Gauss points and weights on (0, height).
std::vector<std::pair<double, double>> gauss_rule(const double height)
{
  const meshes::GaussRule rule = meshes::gauss_rule(n_points);
  std::vector<std::pair<double, double>> points;
  for (int q = 0; q < n_points; ++q)
    points.emplace_back(0.5 * height * (1. + rule.points(q)), 0.5 * height * rule.weights(q));
  return points;
}

/// The sheet's own axes.
struct Strip
{
  Eigen::Vector2d t, n; ///< along the clamped edge, and inwards
  double k, height;     ///< of the wave [1/m], of the sheet [m]
};

Strip strip_of(const meshes::Lattice &lattice, const int n_cells)
{
  Strip strip;
  const Eigen::Vector2d a1 = lattice.vectors.row(0).transpose();
  strip.t                  = a1.normalized();
  strip.n                  = {-strip.t(1), strip.t(0)};
  strip.k                  = 2. * M_PI / (n_cells * a1.norm());
  strip.height             = n_cells * lattice.vectors.row(1).dot(strip.n.transpose());
  return strip;
}

/// The amplitude of a homogenized displacement and of its strain at a height.
struct Amplitude
{
  Complex2 U;
  Complex3 E, slope; ///< of the strain, and its derivative along y
};

/// Re(U(y) e^(iks)) of the homogenized sheet.
class HomogenizedStrip
{
public:
  HomogenizedStrip(const Strip &strip, const CellModel &of, const bool has_edges)
      : strip(strip)
      , polynomials(strip.height)
      , B_t(strain_along(strip.t))
      , B_n(strain_along(strip.n))
  {
    assemble(of.cell.stiffness);
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(2 * (degree + 1));
    const Complex2 F      = strip.t.cast<Complex>() - Complex(0., 1.) * strip.n;
    for (const auto &[y, weight] : gauss_rule(strip.height))
    {
      const auto values = polynomials.at(y);
      for (int i = 0; i <= degree; ++i)
        load.segment<2>(2 * i) += weight * values(0, i) * F;
    }
    U = solved(load, Complex2::Zero());
    if (!has_edges)
      return;
    const Amplitude bottom = at(0.), top = at(strip.height);
    const Eigen::VectorXcd of_edges = edge_loads(*of.edges, top.E);
    U += solved(of_edges, of.edges->sides[2].slip * bottom.E);
  }

  Amplitude at(const double y) const
  {
    const auto values = polynomials.at(y);
    Amplitude result;
    Complex2 slope = Complex2::Zero(), curvature = Complex2::Zero();
    result.U = Complex2::Zero();
    for (int i = 0; i <= degree; ++i)
    {
      const Complex2 node = U.segment<2>(2 * i);
      result.U += values(0, i) * node;
      slope += values(1, i) * node;
      curvature += values(2, i) * node;
    }
    const Complex ik(0., strip.k);
    result.E     = ik * (B_t * result.U) + B_n * slope;
    result.slope = ik * (B_t * slope) + B_n * curvature;
    return result;
  }

private:
  /// The strain of the polynomial i with the values of both components.
  Eigen::Matrix<Complex, 3, 2> strain_of(const Eigen::Matrix<double, 3, degree + 1> &values,
                                         const int i) const
  {
    return Complex(0., strip.k) * values(0, i) * B_t + Complex(values(1, i)) * B_n;
  }

  void assemble(const Eigen::Matrix3d &stiffness)
  {
    matrix = Eigen::MatrixXcd::Zero(2 * (degree + 1), 2 * (degree + 1));
    for (const auto &[y, weight] : gauss_rule(strip.height))
    {
      const auto values = polynomials.at(y);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; j <= degree; ++j)
          matrix.block<2, 2>(2 * i, 2 * j) +=
            weight * strain_of(values, i).adjoint() * (stiffness * strain_of(values, j));
    }
  }

  Eigen::VectorXcd edge_loads(const meshes::CellEdges &edges, const Complex3 &of_top) const
  {
    const Complex ik(0., strip.k);
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(2 * (degree + 1));
    for (const auto &[y, weight] : gauss_rule(strip.height))
    {
      const auto values          = polynomials.at(y);
      const Amplitude here       = at(y);
      Eigen::RowVector3cd stress = Eigen::RowVector3cd::Zero(); // of E_c(V)
      for (int b = 0; b < 2; ++b)
        stress += (ik * strip.t(b) * here.E + strip.n(b) * here.slope).transpose() *
                  edges.bulk[static_cast<std::size_t>(b)];
      for (int i = 0; i <= degree; ++i)
        load.segment<2>(2 * i) -= weight * strain_of(values, i).adjoint() * stress.transpose();
    }
    const Complex pull = edges.sides[3].tension.cast<Complex>().dot(of_top);
    load.tail<2>() -= std::conj(ik) * pull * strip.t;
    return load;
  }

  /// @param held value at y = 0
  Eigen::VectorXcd solved(const Eigen::VectorXcd &load, const Complex2 &held) const
  {
    const int n = 2 * degree;
    Eigen::VectorXcd result(n + 2);
    result.head<2>() = held;
    result.tail(n)   = matrix.bottomRightCorner(n, n).partialPivLu().solve(
        load.tail(n) - matrix.bottomLeftCorner(n, 2) * held);
    return result;
  }

  const Strip strip;
  const Polynomials polynomials;
  const Eigen::Matrix<double, 3, 2> B_t, B_n;
  Eigen::MatrixXcd matrix;
  Eigen::VectorXcd U; ///< at the nodes
};

/// The unknowns of the vertices of a sheet that closes along its first axis and is held below; −1
/// where it is held.
std::vector<int> unknowns_of(const meshes::Sheet &sheet, int &n_unknowns)
{
  // A vertex at the closing end is that of its cell's image at the other one.
  std::map<std::pair<int, int>, int> first; // (cell above the edge, vertex of the cell) -> unknown
  std::vector<int> unknown(static_cast<std::size_t>(sheet.mesh.n_vertices()), -1);
  n_unknowns = 0;
  for (const bool closes : {false, true})
    for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    {
      const Eigen::RowVector2d f = sheet.fraction(sheet.mesh.vertices.row(v));
      if (f(1) < 1e-6 || closes != (f(0) > 1. - 1e-6))
        continue;
      const auto index = static_cast<std::size_t>(v);
      const auto key   = std::pair(sheet.cell(v, 1), sheet.cell_vertex(v));
      if (closes)
        unknown[index] = first.at(key);
      else
      {
        unknown[index] = n_unknowns++;
        if (f(0) < 1e-6)
          first[key] = unknown[index];
      }
    }
  return unknown;
}

/// Displacements of the resolved sheet (n,2) [m].
meshes::Points resolved(const homogenization::UnitCell &cell, const meshes::Sheet &sheet,
                        const Strip &strip, unsigned long &n_dofs)
{
  int n                                        = 0;
  const std::vector<int> unknown               = unknowns_of(sheet, n);
  n_dofs                                       = 2ul * static_cast<unsigned long>(n);
  const std::vector<Eigen::Matrix3d> stiffness = cell.stiffness_of_phase();
  std::vector<Eigen::Triplet<double>> entries;
  // Of a cell with holes the material carries the force of all of the cell.
  const double share =
    meshes::signed_areas(sheet.mesh).sum() / (sheet.n1 * sheet.n2 * sheet.lattice.area());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * n);
  for (int t = 0; t < sheet.mesh.n_triangles(); ++t)
  {
    const auto [area, gradients] = meshes::triangle_geometry(
      meshes::sides_of_triangle<2>(sheet.mesh.triangles.row(t), sheet.mesh.vertices));
    const Eigen::Matrix<double, 2, 3> slopes = gradients.transpose();
    const Eigen::Matrix3d c = area * stiffness[static_cast<std::size_t>(sheet.mesh.material(t))];
    for (int i = 0; i < 3; ++i)
    {
      const int row = unknown[static_cast<std::size_t>(sheet.mesh.triangles(t, i))];
      if (row < 0)
        continue;
      const double phase =
        strip.k * (sheet.mesh.vertices.row(sheet.mesh.triangles(t, i)) - sheet.origin)
                    .dot(strip.t.transpose());
      load.segment<2>(2 * row) +=
        area / (3. * share) * (std::cos(phase) * strip.t + std::sin(phase) * strip.n);
      for (int j = 0; j < 3; ++j)
      {
        const int column = unknown[static_cast<std::size_t>(sheet.mesh.triangles(t, j))];
        if (column < 0)
          continue;
        const Eigen::Matrix2d block =
          strain_along(slopes.col(i)).transpose() * c * strain_along(slopes.col(j));
        for (int a = 0; a < 2; ++a)
          for (int b = 0; b < 2; ++b)
            if (2 * row + a >= 2 * column + b)
              entries.emplace_back(2 * row + a, 2 * column + b, block(a, b));
      }
    }
  }
  Eigen::SparseMatrix<double> lower(2 * n, 2 * n);
  lower.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd solution =
    homogenization::CholeskyFactor(std::move(lower), "displacements of a sheet that closes")
      .solve(load);
  meshes::Points result = meshes::Points::Zero(sheet.mesh.n_vertices(), 2);
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
    if (const int row = unknown[static_cast<std::size_t>(v)]; row >= 0)
      result.row(v) = solution.segment<2>(2 * row).transpose();
  return result;
}
} // namespace

ClosedStripErrors closed_strip_errors(const homogenization::UnitCell &cell,
                                      const CellModel &homogenized, const int n)
{
  const meshes::Sheet sheet = meshes::tile(cell.mesh, cell.lattice, n, n);
  const Strip strip         = strip_of(cell.lattice, n);
  ClosedStripErrors errors;
  const meshes::Points fine = resolved(cell, sheet, strip, errors.n_dofs);

  const HomogenizedStrip plain(strip, homogenized, false), with_edges(strip, homogenized, true);
  localization::UpsamplerOptions options;
  options.anchor     = localization::Anchor::mean;
  options.edges      = homogenized.edges;
  options.edge_kinds = {localization::EdgeKind::none, localization::EdgeKind::none,
                        localization::EdgeKind::clamped, localization::EdgeKind::free};
  const localization::EdgeModes near_edges(homogenized.cell, options);
  const localization::Panel panel = localization::panel_of(sheet);
  const meshes::Chi mean = localization::anchored(homogenized.cell, localization::Anchor::mean),
                    anchored =
                      localization::anchored(homogenized.cell, localization::Anchor::lattice);
  double strain = 0.;
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d from = sheet.mesh.vertices.row(v) - sheet.origin;
    const double y                = from.dot(strip.n.transpose());
    const Complex turn            = std::polar(1., strip.k * from.dot(strip.t.transpose()));
    const auto displacement = [&](const Amplitude &amplitude, const Eigen::Matrix<double, 1, 6> &w)
    {
      const Eigen::Vector3d E = (turn * amplitude.E).real();
      Eigen::RowVector2d u    = (turn * amplitude.U).real().transpose();
      for (int a = 0; a < 3; ++a)
        u += E(a) * w.segment<2>(2 * a);
      return u;
    };
    const Amplitude without  = plain.at(y);
    const Eigen::Index image = sheet.cell_vertex(v);
    strain += (turn * without.E).real().norm();
    errors.localized += (displacement(without, -anchored.row(image)) - fine.row(v)).norm();
    errors.full +=
      (displacement(with_edges.at(y),
                    near_edges.at(panel, localization::point_of(sheet, v)) - mean.row(image)) -
       fine.row(v))
        .norm();
  }
  errors.full /= strain;
  errors.localized /= strain;
  return errors;
}
} // namespace homespun::verification
