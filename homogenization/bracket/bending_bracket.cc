// SPDX-License-Identifier: MIT
#include "homogenization/bracket/bending_bracket.h"

#include "homogenization/bracket/bracket_sides.h"
#include "homogenization/bracket/loewner.h"

#include <Eigen/LU>

#include <algorithm>
#include <limits>

namespace homespun::homogenization
{
namespace
{
/// P, its own transpose: products with it are exact.
Eigen::Matrix3d exchange()
{
  Eigen::Matrix3d P;
  P << 0., 1., 0., 1., 0., 0., 0., 0., -0.5;
  return P;
}

/// The stresses of the analogous membrane under unit mean stresses are P (curvatures) under K =
/// P^-1 Sigma.
FieldProducts of_curvatures(const FieldProducts &of_stresses)
{
  Eigen::Matrix3d P_inverse;
  P_inverse << 0., 1., 0., 1., 0., 0., 0., 0., -2.;
  // f_new = P^-1 f P: the block of the loads a, b is sum_cd P_ca P_db (P^-1 block_cd P^-T).
  const Eigen::Matrix3d P = exchange();
  FieldProducts result    = FieldProducts::Zero();
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d)
          if (P(c, a) != 0. && P(d, b) != 0.)
            result.block<3, 3>(3 * a, 3 * b) += P(c, a) * P(d, b) * P_inverse *
                                                of_stresses.block<3, 3>(3 * c, 3 * d) *
                                                P_inverse.transpose();
  return result;
}

/// Between a plate and its analogous membrane the inverse is rounded: of the weakest plate,
/// relative to any energy.
double rounding_of_analogy(const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material)
{
  double largest = 0.;
  for (const Eigen::Matrix3d &D : bending_stiffness_of_material)
    largest = std::max(largest, weakness(analogous_membrane(D)));
  return 3. * std::numeric_limits<double>::epsilon() * largest;
}
} // namespace

Eigen::Matrix3d analogous_membrane(const Eigen::Matrix3d &bending_stiffness)
{
  const Eigen::Matrix3d inverse =
    bending_stiffness.cast<long double>().inverse().cast<double>(); // rounded once
  return exchange() * (0.5 * (inverse + inverse.transpose())) * exchange();
}

std::vector<Eigen::Matrix3d>
analogous_membranes(const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material)
{
  std::vector<Eigen::Matrix3d> membranes;
  for (const Eigen::Matrix3d &D : bending_stiffness_of_material)
    membranes.push_back(analogous_membrane(D));
  return membranes;
}

BendingBracket
bending_bracket_from(const Bracket &membrane,
                     const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material)
{
  const Eigen::Matrix3d P       = exchange();
  const RoundedInverse of_upper = inverse_of(membrane.upper), of_lower = inverse_of(membrane.lower);
  const double of_analogy = rounding_of_analogy(bending_stiffness_of_material);
  BendingBracket plate;
  plate.lower = (1. - of_upper.round_off - of_analogy) * P * of_upper.value * P;
  plate.upper = (1. + 2. * of_lower.round_off + of_analogy) * P * of_lower.value * P;
  plate.round_off =
    membrane.round_off + 2. * (of_upper.round_off + 2. * of_lower.round_off + of_analogy);
  plate.width =
    std::max(relative_width(plate.lower, plate.upper, plate.round_off), plate.round_off);
  plate.is_of_drawing = membrane.is_of_drawing;
  plate.excess        = membrane.excess;
  plate.stiffness     = P * membrane.compliance * P;
  plate.deflection    = membrane.stress_function * P;
  for (const FieldProducts &products : membrane.stress_products)
    plate.curvature_products.push_back(of_curvatures(products));
  plate.n_triangles       = membrane.n_triangles;
  plate.n_deflection_dofs = membrane.n_stress_dofs;
  plate.n_moment_dofs     = membrane.n_displacement_dofs;
  plate.iterations        = membrane.iterations;
  return plate;
}

BendingBracket bending_bracket(const TorusMesh &mesh,
                               const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
                               const unsigned order)
{
  return bending_bracket_from(
    bracket_sides(mesh, analogous_membranes(bending_stiffness_of_material), order, Holes::rigid),
    bending_stiffness_of_material);
}

AdaptiveBendingBracket adaptive_bending_bracket(
  const TorusMesh &mesh, const std::vector<Eigen::Matrix3d> &bending_stiffness_of_material,
  const AdaptiveOptions &options, const std::function<void(const BendingBracket &)> &observe)
{
  AdaptiveOptions of_membrane = options;
  of_membrane.holes           = Holes::rigid;
  // Between membrane and plate the width grows by round-off alone.
  AdaptiveBracket reached =
    adaptive_bracket(mesh, analogous_membranes(bending_stiffness_of_material), of_membrane,
                     [&](const Bracket &step)
                     { observe(bending_bracket_from(step, bending_stiffness_of_material)); });
  return {bending_bracket_from(reached.bracket, bending_stiffness_of_material),
          std::move(reached.mesh), reached.ending};
}
} // namespace homespun::homogenization
