// SPDX-License-Identifier: MIT
// Terms that act on the masses of a cloth: gravity, and damping against the air at rest.
#pragma once

#include "shell/terms/term.h"

#include <memory>

namespace homespun::shell
{
/// Uniform gravity, E = −Σ m g·x.
/// @param masses (n) [kg]
/// @param acceleration g [m/s^2]
std::unique_ptr<Term> gravity_term(const Eigen::VectorXd &masses,
                                   const Eigen::RowVector3d &acceleration);

/// Damping in proportion to the mass, f = −α m v: E = Σ α m |x − x_n|² / (2h). A free cloth slows
/// down by 1/(1 + α h) per step.
/// @param rate α [1/s]
std::unique_ptr<Term> mass_damping_term(const Eigen::VectorXd &masses, double rate);
} // namespace homespun::shell
