// SPDX-License-Identifier: MIT
// Fine positions from coarse positions (paper Section 2.3, Eqs. 9-12, repaired as README.md here
// says): what runs every frame. Everything that does not change with the motion is done in the
// constructor: location of the fine vertices, barycentric coordinates, anchored chi; after that a
// frame is linear in (coarse data) x (constants per vertex), about 36 multiply-adds per vertex in
// space and 28 in the plane, without branches.
//
// Aligned path, where the coarse mesh is the lattice of the sheet: all cells share one table, two
//   runs of consecutive vertices per cell, no index per vertex. The table (8 numbers per vertex of
//   one cell) stays in the first-level cache, so that the output is all that moves through memory.
// Where the coarse mesh halves the sides of the cells, as six-node triangles are read: the same,
//   with eight runs per cell, for a sheet has the vertices of each of its eight triangles together.
// General path, on any coarse mesh that covers the sheet: vertices grouped by coarse triangle, with
//   8 numbers and an index per vertex.
// Vertices that come placed, those of a garment (garment/placed_garment.h), take the general path.
// Modes of edges (edge_modes.h) are constants of the vertices near edges: on the aligned path cells
// that edges reach have a chi of their own, one for each way of being reached.
// Terms that the options leave out have loops of their own without them; with quadratic modes there
// are 18 multiply-adds in the place of 6 and 20 numbers per vertex in the place of 8. Fitted modes
// take as many numbers; their coefficients are computed at the coarse vertices and linear between.
// Slip of clamped edges, where up-sampling adds it, moves the coarse vertices, but not their
// strain.
#pragma once

#include "localization/cell_modes.h"
#include "localization/cell_tables.h"
#include "localization/coarse_frames.h"
#include "localization/coarse_surface.h"
#include "localization/edge_modes.h"
#include "localization/kernel.h"
#include "localization/options.h"
#include "localization/vertex_table.h"
#include "meshes/plain/homogenized_cell.h"
#include "meshes/plain/sheet.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace homespun::localization
{
/// Fine vertices placed one by one, each with its own modes.
struct PlacedVertices
{
  UpsamplerOptions options;
  meshes::TriangleMesh coarse_rest; ///< coarse mesh at rest, in the frame of the modes
  Eigen::VectorXi space_of_rest;    ///< coarse vertex in space of each of its vertices
  int n_space = 0;                  ///< coarse vertices in space
  Eigen::VectorXi triangle;         ///< (n) coarse triangle of each fine vertex
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> weights; ///< (n,3) barycentric
  CellModes modes; ///< of each vertex, those of edges among them [m]
  BentModes bent;  ///< the same of a bent cell, where the surface is curved
  EdgeSlip slip;   ///< where it is added
};

/// @tparam dim 2: in-plane scenes carry two components; 3: cloth in space
/// @tparam Scalar of the fine positions; the coarse positions and their strains are double
template <int dim, typename Scalar = float>
class Upsampler
{
public:
  /// Fine positions, one vertex per row, components side by side (x y z x y z ...): what vertex
  /// buffers and files take as it is. Shape (n_fine, dim) [m].
  using Fine = Eigen::Matrix<Scalar, Eigen::Dynamic, dim, Eigen::RowMajor>;

  /// Places the fine vertices on the coarse mesh.
  /// @param cell homogenized cell whose chi is superposed, and of a curved surface its deflection;
  ///   its stiffness is not used
  /// @param coarse_rest coarse mesh at rest, in the plane of the sheet
  /// @param fine resolved sheet of that cell
  /// @throws BadInput where the coarse mesh is not sound or does not hold a fine vertex (which is
  ///   named), where cell and sheet do not belong together, or where options contradict each other
  Upsampler(const meshes::HomogenizedCell &cell, const meshes::TriangleMesh &coarse_rest,
            const meshes::Sheet &fine, const UpsamplerOptions &options = {});

  /// Takes vertices as they are placed.
  explicit Upsampler(const PlacedVertices &placed);

  /// Whether the fast path is taken: the coarse mesh is meshes::coarse_sheet() of the sheet's own
  /// lattice, two triangles per cell, or of that lattice with the sides of cells halved.
  bool is_aligned() const;

  /// Number of fine vertices.
  int n_fine() const;

  /// Number of coarse vertices, in space where vertices come placed.
  int n_coarse() const;

  /// Fine positions of the current coarse positions. Uses work space of the object: one thread at a
  /// time. Collapsed or inverted coarse triangles give finite positions (coarse_frames.h).
  /// @param coarse_current (n_coarse,dim) [m]
  /// @param fine_current (n_fine,dim) [m]; resized if need be, else nothing is allocated
  /// @throws BadInput where a coarse position is not finite or their number is wrong
  void upsample(const Positions<dim> &coarse_current, Fine &fine_current) const;

  /// The same from and into memory of the caller's.
  /// @throws BadInput where there is no room for (n_fine,dim)
  void upsample(PositionsOf<dim> coarse_current, Eigen::Map<Fine> fine_current) const;

  /// The same with the unit normals of the curved surface, slopes of the deflection of the bent
  /// cell among them.
  /// @param normals (n_fine,3); zero where the coarse cloth is collapsed
  /// @throws BadInput where the surface is flat
  void upsample(PositionsOf<dim> coarse_current, Eigen::Map<Fine> fine_current,
                Eigen::Map<Fine> normals) const;
  void upsample(const Positions<dim> &coarse_current, Fine &fine_current, Fine &normals) const;

  /// Bytes of the constants that a frame reads, for benchmarks.
  std::size_t table_bytes() const;

private:
  /// Consecutive rows of a table that lie in one coarse triangle.
  struct Group
  {
    int triangle, begin, count;
  };

  /// A fine vertex in a coarse triangle.
  struct Member
  {
    int vertex;
    Eigen::Vector3d weights;
  };

  template <typename Append>
  void place(const Append &append, const meshes::Sheet &fine, int from);
  template <typename Append>
  void tabulate(const std::vector<std::vector<Member>> &in_triangle, const Append &append);
  template <typename ModesAt, typename BentAt>
  auto appending(const ModesAt &modes_at, const BentAt &bent_at) const;
  void run_frame(PositionsOf<dim> coarse_current, const FineRows<Scalar> &to) const;
  PositionsOf<dim> gathered(PositionsOf<dim> coarse_current) const;
  void fill_records(PositionsOf<dim> coarse_current) const;
  void fill_fitted_records(const typename CoarseFrames<dim>::Values &values) const;
  void add_slip(PositionsOf<dim> coarse_current) const;
  void check_room(Eigen::Index n_rows, const std::string &name) const;
  int n_numbers() const;
  void add_surface(PositionsOf<3> coarse_current) const;
  template <int terms, int modes>
  void run_surface(const FineRows<Scalar> &to) const;
  template <int terms, int modes, int between>
  void run(const FineRows<Scalar> &to) const;
  template <int terms>
  void run_modes(const FineRows<Scalar> &to) const;
  template <int terms, int modes, int between>
  void run_cells(const FineRows<Scalar> &to) const;
  template <int terms, int modes, int between>
  Corners<Scalar, record_size(modes, between)> corners_at(int triangle) const;

  CoarseFrames<dim> frames;
  UpsamplerOptions options;
  std::vector<int> space_of_rest;          ///< of placed vertices; else empty
  int n_space = 0;                         ///< coarse vertices
  int n_total = 0;                         ///< fine vertices
  CellTables<Scalar> cells;                ///< aligned: of all vertices but the last
  VertexTable<Scalar> own;                 ///< of all vertices that stand in no block
  std::vector<Group> groups;               ///< of `own`
  std::vector<int> target;                 ///< fine vertex of each row of `own`, −1 for padding
  mutable Positions<dim> at_rest_vertices; ///< of placed vertices: positions by rest vertex
  meshes::FittedResponse fitted;           ///< where the options take fitted modes
  mutable Positions<dim> moves_of_edges, moves; ///< by slip, of its sources and coarse vertices
  EdgeSlip slip;                                ///< where it is added
  std::optional<CoarseSurface> surface;         ///< where it is curved
  mutable std::vector<Scalar> records;          ///< of each coarse vertex: see record_size()
};
} // namespace homespun::localization
