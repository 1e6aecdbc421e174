// SPDX-License-Identifier: MIT
// The method under test, as a game would run it: the coarse cloth in equilibrium under the load,
// and the fine positions up-sampled from it; with the variants that a report holds beside the
// default.
#pragma once

#include "localization/upsampler.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "shell/solver/equilibrium.h"
#include "verification/record/timing.h"
#include "verification/reference/laws.h"
#include "verification/reference/load_forces.h"
#include "verification/reference/loads.h"

#include <memory>
#include <string>
#include <vector>

namespace homespun::verification
{
/// A way to the fine positions, by its name:
/// - affine: the coarse motion interpolated, no microscopic displacement; the baseline
/// - localized: anchored chi, blended strain, rotation lift
/// - localized-affine-lift, localized-mean-anchor, localized-piecewise: one choice turned each
class Method
{
public:
  /// @throws BadInput listing the names, where it is none of them
  explicit Method(const std::string &name);

  static const std::vector<std::string> &names();

  /// The options against a law: the linear one takes the linear strain and no lift.
  localization::UpsamplerOptions options(Law law) const;

  /// Whether the method differs from `localized` under a law: a lift has no meaning in linear
  /// theory.
  bool has_meaning(Law law) const;

  const std::string name;
};

/// The coarse cloth at one strain.
struct CoarseStep
{
  shell::Positions<2> positions; ///< (n_coarse,2) [m]
  int iterations = 0;  ///< Newton steps, 1 for a linear solve, 0 where the motion is given
  double seconds = 0.; ///< median of five runs, one thread
  LoadForces forces;   ///< of its own clamps, and its mean stress: up-sampling changes neither
};

/// Fine positions of a method.
struct UpsampledSheet
{
  meshes::Points positions; ///< (n_fine,2), computed in double precision [m]
  double seconds = 0.;      ///< median of five runs in float, one thread
};

/// The lightweight cloth of a sheet: two coarse triangles per cell.
class LightweightCloth
{
public:
  LightweightCloth(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                   const Load &load);

  /// The coarse equilibrium; of periodic loads the affine motion itself. Under the law `linear` the
  /// small-strain form, else the corotational energy. Later strains start from earlier ones.
  /// @throws NotConverged
  CoarseStep solve(Law law, double strain);

  /// The equilibrium at a strain near to that of a step, from which it starts; nothing is timed.
  /// @throws NotConverged
  shell::Positions<2> near(const CoarseStep &step, Law law, double strain) const;

  UpsampledSheet upsample(const Method &method, Law law,
                          const shell::Positions<2> &coarse_positions) const;

  /// The law of the coarse cloth against a reference: corotational, but beside linear theory.
  static Law own_law(Law law);

  const meshes::TriangleMesh coarse;

private:
  shell::Positions<2> prescribed(double strain) const;
  void put_held(const shell::Positions<2> &prescribed, shell::Positions<2> &positions) const;
  LoadForces forces_at(Law law, const shell::Positions<2> &positions) const;

  const meshes::HomogenizedCell &cell;
  const meshes::Sheet &sheet;
  const std::shared_ptr<Law> law_of_sides; ///< of the motion that is asked for, for free sides
  const Load load;
  const shell::Membrane membrane; ///< for the forces, under periodic loads too
  std::unique_ptr<shell::MembraneSolver<2>> solver;
  shell::Positions<2> last_displacement;
  double last_strain = 0.;
  Law last_law       = Law::linear;
};
} // namespace homespun::verification
