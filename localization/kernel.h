// SPDX-License-Identifier: MIT
// The inner loop of up-sampling: fine positions in one coarse triangle. Private to upsampler.cc.
#pragma once

namespace homespun::localization
{
/// Fine vertices are computed in blocks of this many: one AVX-512 register of floats.
constexpr int lanes = 16;
/// Numbers per coarse vertex: position (dim), strain (3), lift (2 dim), padded to whole registers.
constexpr int record_size = 16;

/// What a loop computes; each is compiled on its own, so that what is left out costs nothing.
enum Terms
{
  affine,         ///< coarse motion only
  constant,       ///< one strain and lift per triangle
  constant_plane, ///< the same without lift: the fluctuation stays in the rest plane
  blended,        ///< strain and lift linear in the triangle
  blended_plane
};

/// Values at the corner 0 of a coarse triangle and their differences to corners 1 and 2, in the order
/// of a record.
template <typename Scalar>
struct Corners
{
  Scalar at0[record_size], to1[record_size], to2[record_size];
};

/// Positions x = P + L w for `count` vertices, a multiple of `lanes`.
/// @param b1, b2 barycentric coordinates
/// @param modes −chi, column 2 a + c
/// @param out (count,dim), components side by side
template <int dim, int terms, typename Scalar>
inline void fine_positions(const Corners<Scalar> &corners, const Scalar *__restrict b1,
                           const Scalar *__restrict b2, const Scalar *__restrict mode0,
                           const Scalar *__restrict mode1, const Scalar *__restrict mode2,
                           const Scalar *__restrict mode3, const Scalar *__restrict mode4,
                           const Scalar *__restrict mode5, const int count, Scalar *__restrict out)
{
  const Corners<Scalar> c    = corners; // a local copy, which no store can change
  constexpr bool is_blended  = terms == blended || terms == blended_plane;
  constexpr bool is_in_plane = terms == constant_plane || terms == blended_plane;
  const auto linear          = [&](const int k, const Scalar u, const Scalar v)
  { return c.at0[k] + u * c.to1[k] + v * c.to2[k]; };
  const auto frame = [&](const int k, const Scalar u, const Scalar v)
  { return is_blended ? linear(dim + k, u, v) : c.at0[dim + k]; };
#pragma GCC ivdep
  for (int n = 0; n < count; ++n)
  {
    const Scalar u = b1[n], v = b2[n];
    Scalar x[dim];
    for (int i = 0; i < dim; ++i)
      x[i] = linear(i, u, v);
    if constexpr (terms != affine)
    {
      const Scalar e0 = frame(0, u, v), e1 = frame(1, u, v), e2 = frame(2, u, v);
      const Scalar w0 = e0 * mode0[n] + e1 * mode2[n] + e2 * mode4[n],
                   w1 = e0 * mode1[n] + e1 * mode3[n] + e2 * mode5[n];
      if constexpr (is_in_plane)
      {
        x[0] += w0;
        x[1] += w1;
      }
      else
        for (int i = 0; i < dim; ++i)
          x[i] += frame(3 + 2 * i, u, v) * w0 + frame(4 + 2 * i, u, v) * w1;
    }
    for (int i = 0; i < dim; ++i)
      out[dim * n + i] = x[i];
  }
}
} // namespace homespun::localization
