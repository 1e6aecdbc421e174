// SPDX-License-Identifier: MIT
// A membrane law at second order in the displacement gradient, point by point: what the quadratic
// modes and the cubic energy of a cell are made of.
//
// A law W = ½ e.c.e with a strain e(H) of the displacement gradient H,
//   e(H) = eps + q(H) + O(H³),   eps = (H11, H22, H12 + H21),
// has the energy W = ½ eps.c.eps + W3(H) + O(H⁴) with W3(H) = (c eps).q(H). Of q a quadratic form
// per component is all that is asked, so that a further law is a further matrix.
//   biot:   U − I:      q = (½ (g om + om²), ½ (−g om + om²), (H22 − H11) om),
//           g = H12 + H21, om = (H21 − H12)/2: where nothing turns there is no second order
//   green:  ½ (F^T F − I):  q = ½ H^T H
// The law `yarn` has one, too, which reaches a tenth of a per cent in weaves: modes that are fitted
// go beyond it (verification/method/mode_fit.h), and it is left out.
#pragma once

#include "meshes/plain/law.h"

#include <Eigen/Core>

#include <array>

namespace homespun::homogenization
{
using meshes::Law;

/// The entries of a displacement gradient, H11, H12, H21, H22.
using GradientEntries = Eigen::Vector4d;

/// q of a law: component k of q(F, G) is F.Q_k G, each Q_k symmetric [-].
using QuadraticStrain = std::array<Eigen::Matrix4d, 3>;

/// @param law that has_second_order
/// @throws std::logic_error of another law
QuadraticStrain quadratic_strain(Law law);

/// eps of the entries of a gradient, (H11, H22, H12 + H21): a matrix (3,4).
Eigen::Matrix<double, 3, 4> linear_strain();

/// A2[F, G], the third derivative of W3 in two of its three places:
///   A2[F,G]:H = 2 { (c eps_H).q(F,G) + (c eps_F).q(G,H) + (c eps_G).q(F,H) }.
/// @param c (3,3) [N/m]
/// @param F,G displacement gradients
/// @return a nominal stress, in the order 11, 12, 21, 22 [N/m]
GradientEntries second_order_stress(const Eigen::Matrix3d &c, const QuadraticStrain &q,
                                    const GradientEntries &F, const GradientEntries &G);
} // namespace homespun::homogenization
