// SPDX-License-Identifier: MIT
// A method on a sheet, as a game would run it: the coarse cloth in equilibrium under the load, and
// the fine positions up-sampled from it.
#pragma once

#include "localization/upsampler.h"
#include "meshes/plain/sheet.h"
#include "verification/method/coarse_space.h"
#include "verification/method/edge_terms.h"
#include "verification/method/method.h"
#include "verification/reference/load_forces.h"
#include "verification/reference/loads.h"

#include <memory>
#include <optional>

namespace homespun::verification
{
inline CoarseElement element_of(const Method &method)
{
  return method.has(Term::p2) ? CoarseElement::six_nodes : CoarseElement::three_nodes;
}

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
                     const CellModel &cell, int quads_per_cell = 1);

  /// @param cell, sheet to be kept by the caller; with fitted modes where used() has them
  /// @param law of the reference; the coarse cloth has homogenized_law() of it
  /// @param quads_per_cell of the coarse mesh, along either side: 1 is the sheet's own lattice
  /// @throws BadInput where used() asks for second order and the cell has none under the law
  CoarseModel(const CellModel &cell, const meshes::Sheet &sheet, const Load &load,
              const Method &method, Law law, int quads_per_cell = 1);

  /// The coarse equilibrium; of periodic loads the affine motion itself.
  /// @param earlier state to start from; null: the affine motion that agrees with what is held
  /// @throws NotConverged
  CoarseState solve(double strain, const CoarseState *earlier = nullptr) const;

  /// What holds a state without its terms of edges: the forces of its own clamps, its mean stress.
  LoadForces forces(const CoarseState &state) const;

  /// The coarse positions as up-sampling reads them.
  Positions on_grid(const CoarseState &state) const
  {
    return space.on_grid<2>(state.positions);
  }

  /// @tparam Scalar of the fine positions
  template <typename Scalar>
  localization::Upsampler<2, Scalar> upsampler() const
  {
    return {cell.cell, space.grid.mesh, sheet, options};
  }

  /// @return (n_fine,2) in double precision [m]
  meshes::Points upsample(const CoarseState &state) const;

  const Law law;
  const Method method; ///< as it is used
  /// Its vertices are the nodes; of six-node triangles, too, cut into those of three.
  const meshes::TriangleMesh &mesh() const
  {
    return space.nodes.mesh;
  }

private:
  Load with_own_sides(const Load &load) const;
  void put_held(const Positions &prescribed, Positions &positions) const;
  shell::Equilibrium<2> equilibrium(const Positions &start) const;

  const CellModel cell;
  const meshes::Sheet &sheet;
  const CoarseSpace space;
  const Load load; ///< its free sides are the coarse cloth's own
  const std::vector<int> held;
  const std::unique_ptr<CoarseSolver> solver; ///< of periodic loads for the forces alone
  std::optional<EdgeTerms> edges;
  localization::UpsamplerOptions options;
};
} // namespace homespun::verification
