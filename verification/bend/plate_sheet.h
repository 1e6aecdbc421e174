// SPDX-License-Identifier: MIT
// A sheet of whole cells that bends, in linear theory: how it is held and loaded, the resolved
// plate of its phases and the homogenized one, and what its edges add to that.
#pragma once

#include "homogenization/bracket/plate.h"
#include "homogenization/edges/plate_edges.h"
#include "meshes/plain/cell_edges.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::verification
{
enum class BentBy
{
  pressure, ///< the same everywhere on the material, as the weight of phases that weigh the same
  moment,   ///< a line moment along the edge 1
  turn      ///< of the edge 1, clamped, about its normal in the plane through its middle
};

/// How a sheet is held and what bends it; edges that are not clamped are free.
struct BendingLoad
{
  const char *name;
  std::array<bool, meshes::CellEdges::n_sides> is_clamped; ///< in the order of meshes::CellEdges
  BentBy by;
};

inline constexpr std::array<BendingLoad, 5> bending_loads = {{
  {"roll", {true, false, false, false}, BentBy::moment},
  {"cantilever-1", {true, false, false, false}, BentBy::pressure},
  {"cantilever-2", {false, false, true, false}, BentBy::pressure},
  {"twist", {true, true, false, false}, BentBy::turn},
  {"pressure", {true, true, true, true}, BentBy::pressure},
}};

/// A mesh of a sheet as a plate, with its edges.
class PlateSheet
{
public:
  /// @param mesh of the whole sheet @param bending_stiffness_of_material [N m]
  PlateSheet(const meshes::Sheet &sheet, const meshes::TriangleMesh &mesh,
             std::vector<Eigen::Matrix3d> bending_stiffness_of_material);

  /// The deflection under a load of size 1: N/m^2, N, or a turn of 1.
  /// @param pressure on its triangles [N/m^2], where the load is one
  /// @return (n_dofs), as a ThinPlate has them
  Eigen::VectorXd deflection(const BendingLoad &load, double pressure) const;

  /// What edges add to a homogenized plate, w1 of homogenization/edges/plate_edges.h.
  /// @param deflection w0
  Eigen::VectorXd correction(const BendingLoad &load, const homogenization::PlateEdges &edges,
                             const Eigen::VectorXd &deflection) const;

  /// sqrt(mean of kappa11² + kappa22² + 2 kappa12²) [1/m], of three points of each triangle.
  double mean_curvature(const Eigen::VectorXd &deflection) const;

  const homogenization::ThinPlate plate;

private:
  /// A side of a triangle on an edge of the sheet.
  struct EdgeSide
  {
    homogenization::RimSide rim;
    int edge;                       ///< 0 to 3, as in meshes::CellEdges
    Eigen::Vector2d along, inwards; ///< of length 1, the sheet on the left
    double length;
  };

  /// The point of a side at a part of its length.
  static Eigen::Vector3d on_side(const homogenization::RimSide &rim, double part);

  std::array<Eigen::Vector2d, 2> ends_of(const homogenization::RimSide &rim) const;

  /// What a clamp prescribes at a point.
  struct Clamped
  {
    double value;
    Eigen::Vector2d gradient;
  };

  template <typename ClampedAt>
  std::vector<homogenization::HeldDof> held(const BendingLoad &load, ClampedAt &&clamped_at) const;

  const meshes::Sheet &sheet;
  std::vector<EdgeSide> edge_sides;
};
} // namespace homespun::verification
