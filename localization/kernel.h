// SPDX-License-Identifier: MIT
// The inner loop of up-sampling: fine positions in one coarse triangle. Private to upsampler.
#pragma once

#include <array>
#include <cstddef>

namespace homespun::localization
{
/// Fine vertices are computed in blocks of this many: one AVX-512 register of floats.
constexpr int lanes = 16;

/// What a loop computes; each is compiled on its own, so that what is left out costs nothing.
enum Terms
{
  affine,           ///< coarse motion only
  constant,         ///< one strain and lift per triangle
  constant_plane,   ///< the same without lift: the fluctuation stays in the rest plane
  blended,          ///< strain and lift linear in the triangle
  blended_plane,    ///< the same without lift
  blended_rotation, ///< dim = 2 with Lift::rotation: the lift has the form [c −s; s c]
};

/// Barycentric coordinates of a block of fine vertices, for the corners 1 and 2.
template <typename Scalar>
struct alignas(64) Weights
{
  Scalar corner1[lanes], corner2[lanes];
};

/// −chi of a block of fine vertices, column 2 a + c [m].
template <typename Scalar>
struct alignas(64) ChiBlock
{
  Scalar column[6][lanes];
};

/// Minus the quadratic modes of a block of fine vertices, column 2 k + c, k of
/// meshes::strain_pairs, those of equal strains halved; or minus the fitted modes [m].
template <typename Scalar>
struct alignas(64) QuadraticBlock
{
  Scalar column[12][lanes];
};

/// How far a block of fine vertices lies off the flat coarse triangle along the normal, per unit
/// macro curvature (11, 22, 12) [m^2]: the quadric through the corners, and w_a of the cell.
template <typename Scalar>
struct alignas(64) DeflectionBlock
{
  Scalar column[3][lanes];
};

/// What a fluctuation is in the strain: linear, quadratic too, or fitted. Fitted modes scale chi
/// and what clamped edges do to it by an effective strain; what free edges do follows another one
/// (meshes::strain_of_free_edges), and has columns of its own where there are such edges.
enum Modes
{
  linear_modes,
  quadratic_modes,
  fitted_modes,
  fitted_modes_and_free_edges
};

constexpr bool are_fitted(const int modes)
{
  return modes == fitted_modes || modes == fitted_modes_and_free_edges;
}

/// What lies between the corners of a coarse triangle, and whether its normals are written too.
enum Between
{
  flat_triangle,
  curved_surface,
  curved_surface_and_normals
};

/// Numbers per coarse vertex: position (dim), strain (3), lift (2 dim), where modes are fitted
/// their coefficients (6) and the strain of free edges (3), the first being the effective one;
/// of curved surfaces K (3) and n (3), those of coarse_surface.h; padded to whole registers.
constexpr int record_size(const int modes, const int between)
{
  return are_fitted(modes) || between != flat_triangle ? 32 : 16;
}

/// Where K and n begin in it.
constexpr int bent_begin(const int dim, const int modes)
{
  return 3 + 3 * dim + (are_fitted(modes) ? 9 : 0);
}

/// Records of a coarse triangle: values at corner 0, and their differences to corners 1 and 2.
template <typename Scalar, int size>
struct alignas(64) Corners
{
  Scalar at0[size], to1[size], to2[size];
};

/// @param records of all coarse vertices, one after the other
/// @param stride numbers from one to the next, at least `size`
template <int size, typename Scalar>
Corners<Scalar, size> corners_of(const Scalar *const records, const int stride,
                                 const std::array<int, 3> &vertices)
{
  Corners<Scalar, size> corners;
  const auto record = [&](const std::size_t k)
  { return records + static_cast<std::ptrdiff_t>(vertices[k]) * stride; };
  const Scalar *const r0 = record(0), *const r1 = record(1), *const r2 = record(2);
  for (int c = 0; c < size; ++c)
  {
    corners.at0[c] = r0[c];
    corners.to1[c] = r1[c] - r0[c];
    corners.to2[c] = r2[c] - r0[c];
  }
  return corners;
}

/// Constants of a run of fine vertices, block by block.
template <typename Scalar>
struct Blocks
{
  const Weights<Scalar> *weights;
  const ChiBlock<Scalar> *chi;               ///< not read without microscopic displacement
  const QuadraticBlock<Scalar> *quadratic;   ///< not read with linear_modes
  const ChiBlock<Scalar> *free;              ///< of free edges, read beside fitted modes alone
  const DeflectionBlock<Scalar> *deflection; ///< of curved surfaces
  const ChiBlock<Scalar> *slopes;            ///< of w_a there, column 2 a + c [m]
};

/// Adds modes, each times a number of the frame, to the fluctuation of vertex n of a block.
/// @param first of the numbers
template <int number, typename Frame, typename Scalar>
inline void add_modes(const Frame &frame, const int first, const Scalar (*const columns)[lanes],
                      const int n, Scalar &w0, Scalar &w1)
{
  for (int k = 0; k < number; ++k)
  {
    const Scalar c = frame(first + k);
    w0 += c * columns[2 * k][n];
    w1 += c * columns[2 * k + 1][n];
  }
}

/// The fluctuation w of vertex n of a block.
template <int dim, int modes, typename Frame, typename Scalar>
inline void find_fluctuation(const Frame &frame, const Blocks<Scalar> &blocks, const int block,
                             const int n, Scalar &w0, Scalar &w1)
{
  const auto &columns = blocks.chi[block].column;
  const Scalar e0 = frame(0), e1 = frame(1), e2 = frame(2);
  if constexpr (modes == quadratic_modes)
  {
    // By Horner's rule: three multiply-adds for each mode of chi in place of one.
    const auto &q        = blocks.quadratic[block].column;
    const auto component = [&](const int c)
    {
      return e0 * (columns[c][n] + e0 * q[c][n] + e1 * q[6 + c][n] + e2 * q[8 + c][n]) +
             e1 * (columns[2 + c][n] + e1 * q[2 + c][n] + e2 * q[10 + c][n]) +
             e2 * (columns[4 + c][n] + e2 * q[4 + c][n]);
    };
    w0 = component(0);
    w1 = component(1);
  }
  else
  {
    w0 = e0 * columns[0][n] + e1 * columns[2][n] + e2 * columns[4][n];
    w1 = e0 * columns[1][n] + e1 * columns[3][n] + e2 * columns[5][n];
  }
  if constexpr (are_fitted(modes))
    add_modes<6>(frame, 3 + 2 * dim, blocks.quadratic[block].column, n, w0, w1);
  if constexpr (modes == fitted_modes_and_free_edges)
    add_modes<3>(frame, 9 + 2 * dim, blocks.free[block].column, n, w0, w1);
}

/// Where fine vertices are written, row after row.
template <typename Scalar>
struct FineRows
{
  Scalar *positions;
  Scalar *normals; ///< of curved surfaces; null: not asked for

  /// @param offset in numbers
  FineRows from(const std::ptrdiff_t offset) const
  {
    return {positions + offset, normals == nullptr ? nullptr : normals + offset};
  }
};

/// Positions x = P + L w in blocks of `lanes` vertices.
///
/// Not inlined, so that the coefficients are broadcast from memory and not taken apart from the
/// registers in which the caller made them: they are 36 for at most a dozen blocks.
/// @param out (n_blocks * lanes, dim), components side by side
template <int dim, int terms, int modes, typename Scalar>
[[gnu::noinline]] void
fine_positions(const Corners<Scalar, record_size(modes, flat_triangle)> &corners,
               const Blocks<Scalar> &blocks, const int n_blocks, Scalar *__restrict out)
{
  constexpr bool is_blended =
    terms == blended || terms == blended_plane || terms == blended_rotation;
  constexpr bool is_in_plane         = terms == constant_plane || terms == blended_plane;
  const Scalar *const __restrict at0 = corners.at0, *const __restrict to1 = corners.to1,
                                 *const __restrict to2 = corners.to2;
  for (int block = 0; block < n_blocks; ++block)
  {
    const Weights<Scalar> &b      = blocks.weights[block];
    Scalar *const __restrict rows = out + block * lanes * dim;
#pragma GCC ivdep
    for (int n = 0; n < lanes; ++n)
    {
      const Scalar u = b.corner1[n], v = b.corner2[n];
      const auto linear = [&](const int k) { return at0[k] + u * to1[k] + v * to2[k]; };
      const auto frame  = [&](const int k) { return is_blended ? linear(dim + k) : at0[dim + k]; };
      Scalar x[dim];
      for (int i = 0; i < dim; ++i)
        x[i] = linear(i);
      if constexpr (terms != affine)
      {
        Scalar w0, w1;
        find_fluctuation<dim, modes>(frame, blocks, block, n, w0, w1);
        if constexpr (is_in_plane)
        {
          x[0] += w0;
          x[1] += w1;
        }
        else if constexpr (terms == blended_rotation)
        {
          const Scalar cosine = frame(3), sine = frame(5);
          x[0] = x[0] + cosine * w0 - sine * w1;
          x[1] = x[1] + sine * w0 + cosine * w1;
        }
        else
          for (int i = 0; i < dim; ++i)
            x[i] = x[i] + frame(3 + 2 * i) * w0 + frame(4 + 2 * i) * w1;
      }
      for (int i = 0; i < dim; ++i)
        rows[dim * n + i] = x[i];
    }
  }
}
} // namespace homespun::localization
