// SPDX-License-Identifier: MIT
// A method on a sheet, as a game would run it: the coarse cloth in equilibrium under the load, and
// the fine positions up-sampled from it.
#pragma once

#include "verification/method/coarse_parts.h"
#include "verification/reference/load_forces.h"
#include "verification/reference/loads.h"

#include <memory>
#include <optional>

namespace homespun::verification
{
/// The coarse cloth at one strain.
struct CoarseState
{
  double strain = 0.;                ///< of the load, as a fraction
  shell::Positions<2> positions;     ///< of the nodes, with the terms of edges (n,2) [m]
  shell::Positions<2> without_edges; ///< before those; the same where there are none (n,2) [m]
  int iterations = 0; ///< Newton steps, 1 for a linear solve, 0 where the motion is given
};

/// A method under a law and load on a sheet: two coarse triangles per cell, or two of six nodes per
/// four.
class CoarseModel
{
public:
  using Positions = shell::Positions<2>;

  /// The method as it is used: without what has no meaning under the law and load, without
  /// triangles of six nodes where they do not fill the sheet, without edges where none are known.
  static Method used(const Method &method, Law law, const Load &load, const meshes::Sheet &sheet,
                     const CellModel &cell, const std::optional<Quads> &quads = {});

  /// @param cell, sheet to be kept by the caller; with fitted modes where used() has them
  /// @param law of the reference; the coarse cloth has homogenized_law() of it
  /// @param quads of the coarse mesh; none: one per cell
  /// @throws BadInput where used() asks for second order and the cell has none under the law
  CoarseModel(const CellModel &cell, const meshes::Sheet &sheet, const Load &load,
              const Method &method, Law law, const std::optional<Quads> &quads = {});

  /// The coarse equilibrium; of periodic loads the affine motion itself.
  /// @param earlier state to start from; null: the affine motion that agrees with what is held
  /// @throws NotConverged
  CoarseState solve(double strain, const CoarseState *earlier = nullptr,
                    const shell::EquilibriumOptions &options = {}) const;

  /// A state with the terms of edges: u0 + u1. In linear theory one more substitution with the
  /// factored stiffness; under other laws the equilibrium under the same forces, from u0.
  /// @param terms of the model's nodes, its own or others
  /// @throws NotConverged
  CoarseState with_edges(const EdgeTerms<2> &terms, CoarseState state) const;

  /// What holds a state without its terms of edges: the forces of its own clamps, its mean stress.
  LoadForces forces(const CoarseState &state) const;

  /// The coarse positions as up-sampling reads them.
  Positions on_grid(const CoarseState &state) const
  {
    return parts.space.on_grid<2>(state.positions);
  }

  /// @tparam Scalar of the fine positions
  template <typename Scalar>
  localization::Upsampler<2, Scalar> upsampler() const
  {
    return {cell.cell, parts.space.grid.mesh, sheet, parts.options};
  }

  /// @return (n_fine,2) in double precision [m]
  meshes::Points upsample(const CoarseState &state) const;

  /// Its vertices are the nodes; of six-node triangles, too, cut into those of three.
  const meshes::TriangleMesh &mesh() const
  {
    return parts.space.nodes.mesh;
  }

  const Law law;
  const Method method; ///< as it is used
  const CellModel cell;
  const meshes::Sheet &sheet;
  const CoarseParts<2> parts;

private:
  Load with_own_sides(const Load &load) const;

  const Load load; ///< its free sides are the coarse cloth's own
  const std::vector<int> held;
  const std::unique_ptr<CoarseSolver> solver; ///< of periodic loads for the forces alone
};
} // namespace homespun::verification
