// SPDX-License-Identifier: MIT
// Which second derivatives of an energy a solver asks for.
#pragma once

namespace homespun::verification
{
enum class Tangent
{
  none,
  exact,
  projected ///< without the negative eigenvalues of each triangle, or of each of its points
};
} // namespace homespun::verification
