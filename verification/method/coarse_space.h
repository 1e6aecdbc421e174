// SPDX-License-Identifier: MIT
// The functions in which the coarse cloth of a sheet moves: linear on the two triangles of each
// cell, or quadratic on triangles two cells wide, whose six nodes are the same vertices. What
// up-sampling reads of either is a grid of three-node triangles: the cloth's own, or, of quadratic
// functions, one half as wide, on which they are evaluated.
#pragma once

#include "meshes/plain/cubic_form.h"
#include "meshes/plain/sheet.h"
#include "shell/membrane/six_node_membrane.h"
#include "shell/solver/equilibrium.h"
#include "verification/law/laws.h"

#include <Eigen/SparseCore>

#include <memory>
#include <optional>
#include <vector>

namespace homespun::verification
{
enum class CoarseElement
{
  three_nodes, ///< linear, P1
  six_nodes    ///< quadratic, P2
};

/// Quads of two three-node triangles along either side of a sheet.
struct Quads
{
  int n1, n2;
};

/// So many along either side of each cell.
inline Quads quads_per_cell(const meshes::Sheet &sheet, const int n)
{
  return {n * sheet.n1, n * sheet.n2};
}

/// A mesh of meshes::coarse_sheet() that covers a sheet.
struct CoarseGrid
{
  meshes::TriangleMesh mesh;
  Quads quads;
};

/// The law of a homogenized sheet, coarse cloth or resolved, against a reference: `linear` and the
/// laws that coarse cloths have are their own, but for a stiffness without axes, which has none of
/// yarns; beside all others it is `biot`, which they approach as strain squared.
/// @param stiffness C^H (3,3) [N/m]
Law homogenized_law(Law of_reference, const Eigen::Matrix3d &stiffness);

/// A sheet of one stiffness under the homogenized law.
shell::Membrane homogenized_membrane(const meshes::TriangleMesh &rest,
                                     const Eigen::Matrix3d &stiffness, Law of_reference);

/// Equilibria of a coarse cloth in its plane under the homogenized law of a reference, whatever its
/// element; equilibrium.h says what each takes, returns and throws.
class CoarseSolver
{
public:
  using Positions = shell::Positions<2>;

  virtual ~CoarseSolver() = default;

  /// Where nodes are held. Under `linear` a substitution, which counts as one step.
  virtual shell::Equilibrium solve(const Positions &start, const Positions &loads = {},
                                   const shell::EquilibriumOptions &options = {}) const = 0;

  /// Forces that hold the nodes where they are (n,2) [N]; under `linear` of small strains.
  virtual Positions gradient(const Positions &positions) const = 0;
};

class CoarseSpace
{
public:
  using Positions = shell::Positions<2>;

  /// @param quads none: one per cell
  /// @throws BadInput where six-node triangles are asked for and do not fill the sheet
  CoarseSpace(const meshes::Sheet &sheet, CoarseElement element,
              const std::optional<Quads> &quads = {});

  /// Whether triangles fill a sheet: those of six nodes ask for an even number of quads along
  /// either side.
  static bool fits(const meshes::Sheet &sheet, CoarseElement element,
                   const std::optional<Quads> &quads = {});

  /// Positions, or displacements, of the grid's vertices from those of the nodes, in the plane or
  /// in space.
  template <int dim>
  shell::Positions<dim> on_grid(const shell::Positions<dim> &of_nodes) const;

  /// The vertex of the grid at a node.
  int grid_vertex(int node) const;

  /// The loads on the nodes that do the work of loads on the grid's vertices [N].
  template <int dim>
  shell::Positions<dim> loads_of_nodes(const shell::Positions<dim> &of_grid) const;

  /// @param law of the reference
  /// @param held nodes whose positions are prescribed; none where all are, and there are no
  ///   equilibria to find
  /// @param cubic energy beside the stiffness: none, or one
  std::unique_ptr<CoarseSolver> solver(const Eigen::Matrix3d &stiffness, Law law,
                                       const std::vector<int> &held,
                                       const std::vector<meshes::CubicForm> &cubic = {}) const;

  const CoarseElement element;
  const CoarseGrid nodes;                            ///< as vertices
  const std::optional<shell::SixNodeMesh> six_nodes; ///< between them, where it is the element
  const CoarseGrid grid;                             ///< which up-sampling reads

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> from_nodes; ///< empty where the grid is the nodes'
};
} // namespace homespun::verification
