// SPDX-License-Identifier: MIT
// The method under test, as a game would run it: the coarse cloth in equilibrium under the load,
// and the fine positions up-sampled from it; with the variants that a report holds beside the
// default.
#pragma once

#include "localization/upsampler.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "verification/method/coarse_space.h"
#include "verification/record/timing.h"
#include "verification/reference/laws.h"
#include "verification/reference/load_forces.h"
#include "verification/reference/loads.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace homespun::verification
{
/// The energy of the coarse cloth.
enum class CoarseEnergy
{
  quadratic, ///< ½ e.C^H.e
  cubic      ///< and the cell's cubic energy under the law (HomogenizedCell::second_order), guarded
};

/// What a coarse cloth is made of.
struct CoarseChoice
{
  CoarseEnergy energy   = CoarseEnergy::quadratic;
  CoarseElement element = CoarseElement::three_nodes;

  bool operator<(const CoarseChoice &other) const
  {
    return std::pair(energy, element) < std::pair(other.energy, other.element);
  }
};

/// A way to the fine positions, by its name:
/// - affine: the coarse motion interpolated, no microscopic displacement; the baseline
/// - localized: anchored chi, blended strain, rotation lift
/// - quadratic: the same at second order in strain, against the laws that have one: the coarse
///   cloth with the cell's cubic energy, chi with its quadratic modes
/// - edges: as edge_terms.h says
/// - p2: localized, from a coarse cloth of six-node triangles with the same vertices
/// - full: p2, quadratic and edges in one
/// - first-order: p2 and edges in one, against laws of yarns, whose second order reaches tenths of
///   a per cent
/// - fitted: a variant of quadratic for large strains, its modes fitted over a box of them
///   (mode_fit.h); beyond the box those at its border. Under yarn the
///   coarse cloth has C^H alone
/// - full-fitted: first-order with fitted modes, against `yarn`; slip and layers follow the
///   effective strain of the modes
/// - localized-affine-lift, localized-mean-anchor, localized-piecewise: one choice turned each
class Method
{
public:
  /// @throws BadInput listing the names, where it is none of them
  explicit Method(const std::string &name);

  static const std::vector<std::string> &names();

  /// The options against a law: the linear one takes the linear strain and no lift.
  localization::UpsamplerOptions options(Law law) const;

  /// Whether the method says something of its own under a law: a lift and a second order have no
  /// meaning in linear theory, and `first-order` is for laws of yarns.
  bool has_meaning(Law law) const;

  /// Whether the coarse cloth has a cubic energy, against a law that has one.
  bool is_of_second_order() const
  {
    return of_coarse.energy == CoarseEnergy::cubic;
  }
  bool is_of_second_order(Law law) const;

  /// Whether modes are fitted, and against which laws.
  bool has_fitted_modes() const
  {
    return has_fitted;
  }
  bool has_fitted_modes(Law law) const;

  /// Whether edges of a sheet have their terms (edge_terms.h).
  bool has_edge_terms() const
  {
    return has_edges;
  }

  /// The coarse cloth against a law.
  CoarseChoice coarse(Law law) const;

  bool has_six_nodes() const
  {
    return of_coarse.element == CoarseElement::six_nodes;
  }

  /// What is left of the method where there are no terms of edges, or no six-node triangles.
  Method without_edge_terms() const;
  Method without_six_nodes() const;

  std::string name;

private:
  CoarseChoice of_coarse;
  bool has_edges, has_fitted;
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

/// The lightweight cloth of a sheet: two coarse triangles per cell, or two of six nodes per four.
class LightweightCloth
{
public:
  /// @throws BadInput as CoarseSpace
  LightweightCloth(const meshes::HomogenizedCell &cell, const meshes::Sheet &sheet,
                   const Load &load, CoarseChoice choice = {});

  /// The coarse equilibrium; of periodic loads the affine motion itself. Under the law `linear` the
  /// small-strain form, under `yarn` that of C^H's own yarns, else the corotational energy. Later
  /// strains start from earlier ones.
  /// @throws NotConverged; BadInput where a cubic energy is asked for and the cell has none under
  ///   the law
  CoarseStep solve(Law law, double strain);

  /// The equilibrium at a strain near to that of a step, from which it starts; nothing is timed.
  /// @throws NotConverged
  shell::Positions<2> near(const CoarseStep &step, Law law, double strain) const;

  /// @param method whose coarse cloth this is
  /// @param fitted its modes under that law, where it has fitted ones
  UpsampledSheet upsample(const Method &method, Law law,
                          const shell::Positions<2> &coarse_positions,
                          const meshes::FittedModes *fitted = nullptr) const;

  /// The law of the coarse cloth against a reference: corotational, but beside linear theory.
  static Law own_law(Law law);

  const meshes::TriangleMesh coarse; ///< its vertices are those of the positions

private:
  /// What the strains of free sides come from.
  struct Sides
  {
    Law law = Law::biot;
    std::unique_ptr<shell::GuardedCubic> cubic; ///< none where the energy is quadratic
    meshes::YarnAxes yarns;                     ///< of a cubic energy that is one of their strain
  };
  static Load with_own_sides(const Load &load, const Eigen::Matrix3d &stiffness,
                             const std::shared_ptr<Sides> &sides);
  std::unique_ptr<CoarseSolver> made_solver(const std::vector<meshes::CubicForm> &cubic) const;
  void take_cubic(Law law);
  void put_held(const shell::Positions<2> &prescribed, shell::Positions<2> &positions) const;
  LoadForces forces_at(Law law, const shell::Positions<2> &positions) const;

  const meshes::HomogenizedCell &cell;
  const meshes::Sheet &sheet;
  const CoarseChoice choice;
  const CoarseSpace space;
  const std::shared_ptr<Sides> own_sides; ///< of the motion that is asked for, for free sides
  const Load load;
  std::unique_ptr<CoarseSolver> solver; ///< of periodic loads for the forces alone
  Law law_of_cubic = Law::linear;
  shell::Positions<2> last_displacement;
  double last_strain = 0.;
  Law last_law       = Law::linear;
};
} // namespace homespun::verification
