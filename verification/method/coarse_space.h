// SPDX-License-Identifier: MIT
// The functions in which the coarse cloth of a sheet moves: linear on the two triangles of each
// cell, or quadratic on triangles two cells wide, whose six nodes are the same vertices. What
// up-sampling reads of either is a grid of three-node triangles: the cloth's own, or, of quadratic
// functions, one half as wide, on which they are evaluated.
#pragma once

#include "meshes/plain/cubic_form.h"
#include "meshes/plain/sheet.h"
#include "verification/method/sheet_solvers.h"

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

namespace homespun::verification
{
enum class CoarseElement
{
  three_nodes, ///< linear, P1
  six_nodes    ///< quadratic, P2
};

/// A mesh of meshes::coarse_sheet() that covers a sheet.
struct CoarseGrid
{
  meshes::TriangleMesh mesh;
  int n1, n2; ///< quads along either side of the sheet
};

/// Equilibria of a coarse cloth in its plane under the homogenized law of a reference
/// (sheet_solvers.h), whatever its element; equilibrium.h says what each takes, returns and throws.
class CoarseSolver
{
public:
  using Positions = shell::Positions<2>;

  virtual ~CoarseSolver() = default;

  /// Where nodes are held.
  virtual Positions solve_linear(const Positions &prescribed,
                                 const Positions &loads = {}) const                  = 0;
  virtual shell::Equilibrium<2> solve_equilibrium(Law of_reference, const Positions &start,
                                                  const Positions &loads = {}) const = 0;

  /// Forces that hold the nodes where they are (n,2) [N]; under `linear` of small strains.
  virtual Positions gradient(Law of_reference, const Positions &positions) const = 0;
};

class CoarseSpace
{
public:
  using Positions = shell::Positions<2>;

  /// @param quads_per_cell of three-node triangles, along either side: 1 is the sheet's own lattice
  /// @throws BadInput where six-node triangles are asked for and do not fill the sheet
  CoarseSpace(const meshes::Sheet &sheet, CoarseElement element, int quads_per_cell = 1);

  /// Whether triangles fill a sheet: those of six nodes ask for an even number of quads along
  /// either side.
  static bool fits(const meshes::Sheet &sheet, CoarseElement element, int quads_per_cell = 1);

  /// Positions, or displacements, of the grid's vertices from those of the nodes, in the plane or
  /// in space.
  template <int dim>
  shell::Positions<dim> on_grid(const shell::Positions<dim> &of_nodes) const;

  /// The vertex of the grid at a node.
  int grid_vertex(int node) const;

  /// The values of the grid's vertices that are nodes.
  Positions at_nodes(const Positions &of_grid) const;

  /// The loads on the nodes that do the work of loads on the grid's vertices [N].
  template <int dim>
  shell::Positions<dim> loads_of_nodes(const shell::Positions<dim> &of_grid) const;

  /// @param held nodes whose positions are prescribed; none where all are, and there are no
  ///   equilibria to find
  /// @param cubic energy beside the stiffness: none, or one
  std::unique_ptr<CoarseSolver> solver(const Eigen::Matrix3d &stiffness,
                                       const std::vector<int> &held,
                                       const std::vector<meshes::CubicForm> &cubic = {}) const;

  const CoarseElement element;
  const CoarseGrid nodes; ///< as vertices
  const CoarseGrid grid;  ///< which up-sampling reads

private:
  Eigen::SparseMatrix<double, Eigen::RowMajor> from_nodes; ///< empty where the grid is the nodes'
};
} // namespace homespun::verification
