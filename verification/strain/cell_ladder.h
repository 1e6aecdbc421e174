// SPDX-License-Identifier: MIT
// A cell by three discretizations, and what methods make of each on a sheet: the half of an error
// bar that the reference does not know of (strain/reference_uncertainty.h has the other).
#pragma once

#include "homogenization/cell/unit_cell.h"
#include "verification/method/coarse_model.h"

#include <mpi.h>

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

namespace homespun::verification
{
/// A cell as methods read it, at the vertices of the given mesh.
struct DiscretizedCell
{
  CellModel model() const
  {
    return {cell, edges ? &*edges : nullptr};
  }

  meshes::HomogenizedCell cell;
  std::optional<meshes::CellEdges> edges;
};

/// By P1, P2, and P2 on the refined mesh.
using CellLadder = std::array<DiscretizedCell, 3>;

/// C^H, chi, modes of second order and terms of edges by each discretization. Up-sampling centres
/// chi by its mean over triangles of three nodes, P2 has its own: slip and bulk term of edges are
/// those of the former. All ranks must call this; terms of edges are on the first one alone.
/// @param p1 cell and terms of edges, as the methods have them
CellLadder ladder_of(const homogenization::UnitCell &cell, const DiscretizedCell &p1,
                     MPI_Comm communicator);

/// The same, made when it is first asked for, by all ranks at once.
/// @param cell to be kept by the caller
std::function<const CellLadder &()> kept_ladder(const homogenization::UnitCell &cell,
                                                DiscretizedCell p1, MPI_Comm communicator);

/// A model and where it has come to, from strain to strain.
struct MovedModel
{
  MovedModel(const CellModel &cell, const meshes::Sheet &sheet, const Load &load,
             const Method &method, const Law law)
      : model(cell, sheet, load, method, law)
  {
  }

  /// @throws NotConverged
  const CoarseState &move(const double strain)
  {
    state = model.solve(strain, state ? &*state : nullptr);
    return *state;
  }

  const CoarseModel model;
  std::optional<CoarseState> state;
};

/// Methods on a sheet by one discretization of its cell, each from strain to strain.
struct MovedMethods
{
  /// @throws NotConverged where its modes were to be fitted and could not be
  MovedModel &at(Law law, const std::string &method);

  CellModel cell; ///< its fitted modes are those of the law, below
  const meshes::Sheet &sheet;
  const Load &load;
  std::map<Law, meshes::FittedModes> fitted               = {}; ///< where a method asks for them
  std::map<std::pair<Law, std::string>, MovedModel> moved = {}; ///< that were asked for
};
} // namespace homespun::verification
