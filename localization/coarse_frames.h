// SPDX-License-Identifier: MIT
// Strain and lift of the coarse cloth, per triangle and blended to the vertices, and the constant
// of chi: what the up-sampled position of a fine point is made of.
//
//   x = sum_k b_k x_k + L w,   w = −(E11 chi_11 + E22 chi_22 + gamma12 chi_12)   (paper Eqs. 9, 12)
//
// F = [x1 − x0, x2 − x0] Dm^-1 (dim x 2), C = F^T F, J = det F (dim = 2) or |f1 × f2| (dim = 3),
// s = sqrt(tr C + 2 J):  U = (C + J I)/s,  R = (F + cof F)/s  with cof F = dJ/dF, E = U − I. In the
// plane R is the proper rotation nearest to F, also where a triangle is inverted.
// Of second order, w takes − sum ½ E_a² chi_aa − sum E_a E_b chi_ab too (meshes::SecondOrder).
// Where a triangle is collapsed to a line cof F counts as zero; to a point, U = 0 and R = 0. Both
// are finite and need no branch.
#pragma once

#include "localization/options.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/triangle_mesh.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace homespun::localization
{
/// Strain and lift at one place.
template <int dim>
struct Frame
{
  Eigen::Vector3d strain;             ///< E11, E22, gamma12 [-]
  Eigen::Matrix<double, dim, 2> lift; ///< [-]
};

/// Principal values of a strain E11, E22, gamma12: middle +- radius [-].
struct PrincipalStrain
{
  double middle, radius;

  /// max(|e1|, |e2|)
  double largest() const
  {
    return std::abs(middle) + radius;
  }
  /// max(0, −e2), how much shorter it is than at rest where it is so most
  double compression() const
  {
    return std::max(0., radius - middle);
  }
};
inline PrincipalStrain principal_strain(const Eigen::Vector3d &strain)
{
  return {0.5 * (strain(0) + strain(1)), 0.5 * std::hypot(strain(0) - strain(1), strain(2))};
}

/// Strains and lifts of a coarse mesh in motion.
template <int dim>
class CoarseFrames
{
public:
  /// Components of a frame in a row of values(): strain (3), then lift, row by row (2 dim).
  static constexpr int n_components = 3 + 2 * dim;
  using Values = Eigen::Matrix<double, Eigen::Dynamic, n_components, Eigen::RowMajor>;

  /// Prepares the rest state and the weights of the average.
  /// @throws BadInput where the mesh is not sound, or Strain::linear is asked for in space
  CoarseFrames(const meshes::TriangleMesh &coarse_rest, const UpsamplerOptions &options);

  /// Frames at the given positions: one row per coarse vertex (Blend::continuous) or per coarse
  /// triangle (Blend::piecewise). Writes into work space of the object: one thread at a time.
  /// @param current (n,dim) [m], finite
  /// @return (rows, n_components), valid until the next call
  const Values &values(PositionsOf<dim> current) const;
  const Values &values(const Positions<dim> &current) const
  {
    return values(PositionsOf<dim>(current.data(), current.rows(), dim));
  }

  /// What values() returned last.
  const Values &last_values() const
  {
    return options.blend == Blend::piecewise ? of_triangles : of_vertices;
  }

  /// Frame of one coarse triangle without any blending, the definition.
  Frame<dim> of_triangle(int triangle, const Positions<dim> &current) const;

  const meshes::TriangleMesh &rest() const
  {
    return mesh;
  }

private:
  /// Triangles whose frames are computed at once.
  static constexpr std::size_t abreast = 32;
  template <Strain strain, Lift lift>
  void evaluate(const double *positions, std::size_t begin) const;

  meshes::TriangleMesh mesh;
  UpsamplerOptions options;
  std::vector<int> corners;                 ///< (m, 3)
  std::vector<double> inverse_rest;         ///< entries of Dm^-1, (4, abreast) of so many triangles
  std::vector<int> first, owner;            ///< triangles around a vertex
  std::vector<double> share;                ///< weight of each of them in the average
  mutable Values of_triangles, of_vertices; ///< the second where blended
};

/// Characteristic displacements with the chosen constant.
/// @return (n,6) [m]: minus their values at the anchor, or minus their mean over the cell
/// @throws BadInput where shapes do not match or a value is not finite
meshes::Chi anchored(const meshes::HomogenizedCell &cell, Anchor anchor);

/// The same of the quadratic modes under a law.
/// @return (n,12) [m]
/// @throws BadInput as anchored(), and where the cell has none under that law
meshes::QuadraticChi anchored_quadratic(const meshes::HomogenizedCell &cell, const std::string &law,
                                        Anchor anchor);

/// The same of the deflections of a bent cell.
/// @return (n,3) [m^2]: w_a with that constant
/// @throws BadInput as anchored(), and where the cell has none
meshes::Deflection anchored_deflection(const meshes::HomogenizedCell &cell, Anchor anchor);

/// The same of fitted modes.
/// @throws BadInput as anchored()
meshes::QuadraticChi anchored_fitted(const meshes::HomogenizedCell &cell,
                                     const meshes::FittedModes &fitted, Anchor anchor);
} // namespace homespun::localization
