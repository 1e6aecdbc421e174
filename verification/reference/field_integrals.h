// SPDX-License-Identifier: MIT
// Integrals over the elements that need the shapes themselves and functions of the rest point: the
// load vector of a body force, and the distance of a finite-element field from one that is known.
#pragma once

#include "homogenization/fem/elastic_solver.h"
#include "verification/reference/known_field.h"

#include <functional>

namespace homespun::verification
{
/// Integral of f N_i for every shape, by a formula of degree 5, with held degrees of freedom left
/// out and periodic images added up as the constraints say.
/// @param force per rest area [N/m^2]
homogenization::ElasticSolver::Vector
load_vector(const homogenization::Discretization &discretization,
            const dealii::AffineConstraints<double> &constraints,
            const std::function<FieldValue(const Eigen::RowVector2d &)> &force);

/// The distance of a finite-element field from a known one, by a formula of degree 7.
/// @param field values of the nodes, of the ones that this rank owns
/// @param modulo_translation the mean difference is left out: of periodic problems, whose solution
///   is known up to a constant
FieldDistance distance(const homogenization::Discretization &discretization,
                       const homogenization::ElasticSolver::Vector &field, const KnownField &known,
                       bool modulo_translation = false);
} // namespace homespun::verification
