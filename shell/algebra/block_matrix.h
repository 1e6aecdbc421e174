// SPDX-License-Identifier: MIT
// A symmetric sparse matrix of 3 x 3 blocks over the vertices of a cloth, or of 2 x 2 of one in its
// plane. Order and sparsity are laid out once; a step writes values into places that the terms
// looked up beforehand.
//
// Free vertices stand in a fill-reducing order (approximate minimum degree), held ones after them.
// Only columns of free vertices are kept: their diagonal block, then the blocks below it. Blocks in
// rows of held vertices carry the pull of moving handles; nothing couples two held vertices.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace homespun::shell
{
/// One vector per vertex (n,dim): positions, velocities, forces.
template <int dim>
using VectorsOf = Eigen::Matrix<double, Eigen::Dynamic, dim, Eigen::RowMajor>;
using Vectors   = VectorsOf<3>;

/// @tparam dim 2 or 3, which are instantiated
template <int dim>
class BlockMatrixOf
{
public:
  using Block = Eigen::Matrix<double, dim, dim>;

  /// @param couplings pairs of different vertices, in any order, repeated or not
  /// @param is_held (n) vertices that are no unknowns
  BlockMatrixOf(const std::vector<std::array<int, 2>> &couplings, const std::vector<bool> &is_held);

  /// Where the block of a pair is stored.
  struct Slot
  {
    int block       = -1;    ///< −1: nowhere, both vertices are held
    bool transposed = false; ///< what is stored is the block (second, first)
  };

  /// Slot of the block (first, second), which may be the same vertex twice.
  /// @throws std::logic_error where the pair was not among the couplings
  Slot slot(int first, int second) const;

  /// Sets all values to zero.
  void clear();

  /// Adds the block (first, second) at its place; the one across the diagonal is implied. A
  /// diagonal block must be symmetric.
  template <typename Values>
  void add(const Slot &where, const Eigen::MatrixBase<Values> &block)
  {
    if (where.block < 0)
      return;
    Block &stored = blocks[static_cast<std::size_t>(where.block)];
    if (where.transposed)
      stored += block.transpose();
    else
      stored += block;
  }

  /// Adds a multiple of the identity.
  void add_multiple(const Slot &where, const double value)
  {
    if (where.block >= 0)
      blocks[static_cast<std::size_t>(where.block)].diagonal().array() += value;
  }

  /// Matrix times vectors, over the free vertices: held rows of x count as zero, those of y are
  /// zero.
  void multiply(const VectorsOf<dim> &x, VectorsOf<dim> &y) const;

  /// y −= (rows of free vertices, columns of held ones) x: what a moving handle pulls.
  void subtract_held(const VectorsOf<dim> &x, VectorsOf<dim> &y) const;

  /// Diagonal block of a free vertex.
  const Block &diagonal(int vertex) const
  {
    return blocks[static_cast<std::size_t>(
      first[static_cast<std::size_t>(place_of[static_cast<std::size_t>(vertex)])])];
  }

  int n_vertices() const
  {
    return static_cast<int>(place_of.size());
  }
  int n_free() const
  {
    return static_cast<int>(first.size()) - 1;
  }
  bool is_free(const int vertex) const
  {
    return place_of[static_cast<std::size_t>(vertex)] < n_free();
  }
  /// Bytes of values and indices.
  std::size_t bytes() const;

  // The storage, for the solvers. Column c holds blocks first[c] ... first[c + 1] − 1 in ascending
  // rows from the diagonal on; rows and columns are places.
  std::vector<int> place_of;  ///< (n) place of a vertex
  std::vector<int> vertex_at; ///< (n) vertex at a place
  std::vector<int> first;     ///< (n_free + 1)
  std::vector<int> row;       ///< place of each block's row
  std::vector<Block> blocks;  ///< values [N/m]
};

using BlockMatrix = BlockMatrixOf<3>;
} // namespace homespun::shell
