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

/// A method, and where its coarse cloth has come to.
struct MovedMethod
{
  MovedMethod(const CellModel &cell, const meshes::Sheet &sheet, const Load &load,
              const Method &method, const Law law)
      : model(cell, sheet, load, method, law)
  {
  }

  CoarseModel model;
  std::optional<CoarseState> state = {};
};

/// Methods of one discretization of the cell on a sheet, from strain to strain.
class DiscretizedMethods
{
public:
  /// @param cell, sheet, load, fitted to be kept by the caller; modes that are fitted under a law
  ///   stay those of P1
  DiscretizedMethods(const DiscretizedCell &cell, const meshes::Sheet &sheet, const Load &load,
                     const std::map<Law, meshes::FittedModes> &fitted);

  /// @return (n,2) at the vertices of the sheet [m]; none where the method finds no equilibrium or
  ///   lacks its modes
  meshes::Points at(const std::string &method, Law law, double strain);

private:
  const DiscretizedCell &cell;
  const meshes::Sheet &sheet;
  const Load &load;
  const std::map<Law, meshes::FittedModes> &fitted;
  std::map<std::pair<Law, std::string>, MovedMethod> moved;
};
} // namespace homespun::verification
