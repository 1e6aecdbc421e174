// SPDX-License-Identifier: MIT
// What edges add to a homogenized sheet in motion, to first order in the cell, as edge_terms.h does
// at rest: slip of clamped edges, which follows the strain there; tension of free ones, a term of
// the cloth (shell/terms/selvedge.h); and the force of strain gradients. Slip and gradients are
// those where a step begins, so that they lag by a step.
#pragma once

#include "localization/coarse_frames.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"
#include "shell/terms/selvedge.h"
#include "verification/method/coarse_space.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace homespun::verification
{
class MovingEdges
{
public:
  /// An edge all of whose coarse vertices are held is clamped, one with none held between its ends
  /// is free, another has no terms.
  /// @param space in which the coarse cloth of the sheet moves
  /// @param held nodes of it
  /// @throws BadInput where a free edge pushes harder than the triangles behind it bear
  MovingEdges(const meshes::HomogenizedCell &cell, const meshes::CellEdges &edges,
              const meshes::Sheet &sheet, const CoarseSpace &space, const std::vector<int> &held);

  /// Cables on the free edges.
  const std::vector<shell::SelvedgeSegment> &selvedges() const
  {
    return segments;
  }

  /// d_a E_a, lifted, of the nodes on clamped edges, elsewhere zero.
  /// @param positions of the nodes (n,3) [m]
  /// @return (n,3) [m]
  localization::Positions<3> slip(const localization::Positions<3> &positions) const;

  /// Whether strain gradients have forces: not where the cell has a centre of symmetry.
  bool has_bulk_forces() const;

  /// Those forces on the nodes (n,3) [N].
  localization::Positions<3> bulk_forces(const localization::Positions<3> &positions) const;

  /// Gives up-sampling the edges.
  /// @param edges of the cell, kept by the caller
  void give_edges(const meshes::CellEdges &edges, localization::UpsamplerOptions &options) const;

  /// Which of the four edges have which terms.
  std::string sentence() const;

private:
  struct Slip
  {
    int node;
    Eigen::Matrix<double, 2, 3> per_strain; ///< d_a [m]
  };

  const CoarseSpace space;
  localization::CoarseFrames<3> frames; ///< of its grid
  std::array<localization::EdgeKind, meshes::CellEdges::n_sides> kinds = {};
  std::vector<Slip> slips;
  std::vector<shell::SelvedgeSegment> segments;
  std::array<Eigen::Matrix3d, 2> bulk;
  double size_of_bulk; ///< what M is small beside [N]
};
} // namespace homespun::verification
