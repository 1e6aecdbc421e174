// SPDX-License-Identifier: MIT
// The fluctuation of a resolved sheet: what it does beside the motion of the homogenized sheet. It
// is what up-sampling has to restore, and by its size an error of up-sampling is judged.
#pragma once

#include "verification/method/coarse_model.h"

#include <Eigen/Core>

namespace homespun::verification
{
/// mean |x − u| over the fine vertices, x the resolved sheet, u the homogenized one.
struct Fluctuation
{
  double mean    = 0.; ///< [m]
  double bar     = 0.; ///< change of the mean from a homogenized sheet half as fine [m]
  double seconds = 0.; ///< of both homogenized sheets, one thread
};

/// Whether the cell fluctuates under a macroscopic strain: by its chi, which is not zero to 1e-10
/// of the cell side. Nothing does in one material, nor where phases differ in the shear modulus
/// alone and are pulled along its axes.
/// @param strain 11, 22, 12 with engineering shear, of size one
bool fluctuates(const meshes::HomogenizedCell &cell, const Eigen::Vector3d &strain);

/// Fluctuations of one sheet under one load, from strain to strain.
///
/// The homogenized sheet has the stiffness C^H in every triangle, the same edges held, and quads a
/// quarter of a cell wide, so that its own discretization counts little; how much, `bar` says. Its
/// law is homogenized_law(). In an infinite cloth it is the affine motion, exactly.
class FluctuationMeasure
{
public:
  /// @param cell, sheet to be kept by the caller
  FluctuationMeasure(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                     const Load &load);

  /// @param law of the reference
  /// @param reference (n,2) positions of the resolved sheet [m]
  /// @throws NotConverged where the homogenized sheet finds no equilibrium
  Fluctuation at(Law law, double strain, const meshes::Points &reference);

private:
  struct Sheet
  {
    CoarseModel model;
    std::optional<CoarseState> last; ///< level
  };
  static double distance(Sheet &of, double strain, const meshes::Points &reference);

  const meshes::HomogenizedCell *cell;
  const meshes::Sheet *sheet;
  Load load;
  std::unique_ptr<Sheet> fine, half_as_fine; ///< under the law of the last level
};
} // namespace homespun::verification
