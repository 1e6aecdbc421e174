// SPDX-License-Identifier: MIT
// Cells for the tests of brackets: plain meshes and stiffnesses, without deal.II.
#pragma once

#include "homogenization/bracket/bracket.h"
#include "homogenization/cell/material.h"
#include "meshes/plain/symmetric_eigen.h"
#include "tests/meshes/plain/shapes.h"

#include <functional>

namespace homespun::tests
{
struct BracketCell
{
  meshes::TriangleMesh mesh;
  meshes::Lattice lattice;
  std::vector<Eigen::Matrix3d> stiffness;
};

/// n1 x n2 x 2 triangles; the material is chosen by the fractional coordinates of a square.
inline BracketCell bracket_cell(const meshes::Lattice &lattice, const int n1, const int n2,
                                const std::vector<Eigen::Matrix3d> &stiffness,
                                const std::function<int(double f1, double f2)> &material_at)
{
  BracketCell cell{parallelogram(lattice, n1, n2), lattice, stiffness};
  for (int t = 0; t < cell.mesh.n_triangles(); ++t)
    cell.mesh.material(t) =
      material_at((t / 2 % n1 + 0.5) / n1, (static_cast<double>(t / 2 / n1) + 0.5) / n2);
  return cell;
}

inline Eigen::Matrix3d isotropic_stiffness(const double E, const double nu)
{
  return homogenization::plane_stress_stiffness(homogenization::isotropic("p", E, nu, 1., 1.));
}

inline std::vector<Eigen::Matrix3d> contrasting(const double contrast)
{
  return {isotropic_stiffness(1., 0.3), isotropic_stiffness(contrast, 0.3)};
}

/// Soft and hard halves, stacked along axis 2.
inline BracketCell stripes(const int n1, const int n2, const double contrast)
{
  return bracket_cell(square_lattice(1.), n1, n2, contrasting(contrast),
                      [](double, double f2) { return f2 < 0.5 ? 0 : 1; });
}

/// A stiff square of a quarter of the area, n a multiple of 4.
inline BracketCell square_inclusion_cell(const int n, const double contrast)
{
  return bracket_cell(square_lattice(1.), n, n, contrasting(contrast),
                      [](double f1, double f2)
                      { return std::abs(f1 - 0.5) < 0.25 && std::abs(f2 - 0.5) < 0.25 ? 1 : 0; });
}

/// Two by two squares, stiff ones meeting at corners, n a multiple of 2.
inline BracketCell checkerboard_cell(const int n, const double contrast)
{
  return bracket_cell(square_lattice(1.), n, n, contrasting(contrast),
                      [](double f1, double f2) { return (f1 < 0.5) == (f2 < 0.5) ? 1 : 0; });
}

/// A pattern without symmetry.
inline int odd_pattern(const double f1, const double f2)
{
  const int i = static_cast<int>(8. * f1), j = static_cast<int>(8. * f2);
  return (i > 1 && i < 5 && j > 2 && j < 5) || (i == 4 && j > 4) ? 1 : 0;
}

/// The phase with area bulk modulus K and shear modulus G: E = 4 K G / (K + G), nu = (K − G)/(K +
/// G).
inline Eigen::Matrix3d of_bulk_and_shear(const double K, const double G)
{
  return isotropic_stiffness(4. * K * G / (K + G), (K - G) / (K + G));
}

inline homogenization::Bracket bracketed(const BracketCell &cell, const unsigned order)
{
  return homogenization::bracket(homogenization::glued(cell.mesh, cell.lattice), cell.stiffness,
                                 order);
}

/// Whether lower <= upper in the sense of Loewner, but for a part of the largest entry.
inline bool is_ordered(const Eigen::Matrix3d &lower, const Eigen::Matrix3d &upper,
                       const double slack = 0.)
{
  return meshes::symmetric_eigen<3>(upper - lower).values(0) >=
         -slack * upper.cwiseAbs().maxCoeff();
}
} // namespace homespun::tests
