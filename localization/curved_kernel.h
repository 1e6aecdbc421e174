// SPDX-License-Identifier: MIT
// The inner loop of up-sampling where the surface is curved, as kernel.h has that of flat coarse
// triangles. Private to upsampler.
#pragma once

#include "localization/kernel.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace homespun::localization
{
/// 1/sqrt(q) of a q that is zero or above; where q = 0 any finite number.
inline double inverse_root(const double q)
{
  return 1. / std::sqrt(q > 0. ? q : 1.);
}

/// By Newton's method from the exponent that is about right, faster than a root and a quotient: its
/// first step with the constants of J. Kadlec leaves 6.5e-4, the second 7e-7 of the result.
inline float inverse_root(const float q)
{
  std::int32_t bits;
  std::memcpy(&bits, &q, sizeof bits);
  bits = 0x5f1ffff9 - (bits >> 1);
  float y;
  std::memcpy(&y, &bits, sizeof y);
  y *= 0.703952253F * (2.38924456F - q * y * y);
  return y * (1.5F - 0.5F * q * y * y);
}

/// Components side by side.
template <typename Scalar>
inline void write_rows(const Scalar (&components)[3][lanes], Scalar *const __restrict rows)
{
  const Scalar *const __restrict x = components[0], *const __restrict y = components[1],
                                 *const __restrict z = components[2];
#pragma GCC ivdep
#pragma GCC unroll 1
  for (int n = 0; n < lanes; ++n)
  {
    rows[3 * n]     = x[n];
    rows[3 * n + 1] = y[n];
    rows[3 * n + 2] = z[n];
  }
}

/// Positions x = P + L w + z n in blocks of `lanes` vertices, z = sum_a K_a z_a, and the normals
/// n − sum_a K_a L grad w_a, brought to length one: n follows the slope of the quadric by itself,
/// and the slope of the bent cell is turned by L as w is.
///
/// Piece by piece through the first-level cache: no loop has more coefficients than registers, so
/// that each is broadcast once for a block.
/// @param to (n_blocks * lanes, 3), components side by side; normals where `between` says so
template <int terms, int modes, int between, typename Scalar>
[[gnu::noinline]] void
curved_positions(const Corners<Scalar, record_size(modes, curved_surface)> &corners,
                 const Blocks<Scalar> &blocks, const int n_blocks, const FineRows<Scalar> &to)
{
  constexpr bool has_cell = terms != affine, has_normals = between == curved_surface_and_normals;
  constexpr int bent                 = bent_begin(3, modes);
  const Scalar *const __restrict at0 = corners.at0, *const __restrict to1 = corners.to1,
                                 *const __restrict to2 = corners.to2;
  for (int block = 0; block < n_blocks; ++block)
  {
    const Weights<Scalar> &b = blocks.weights[block];
    const auto linear        = [&](const int k, const int n)
    { return at0[k] + b.corner1[n] * to1[k] + b.corner2[n] * to2[k]; };
    alignas(64) Scalar w[2][lanes], z[lanes], slope[2][lanes], x[3][lanes], normal[3][lanes];
    if constexpr (has_cell)
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int n = 0; n < lanes; ++n)
        find_fluctuation<3, modes>([&](const int k) { return linear(3 + k, n); }, blocks, block, n,
                                   w[0][n], w[1][n]);
    const auto &deflection = blocks.deflection[block].column;
    const auto &slopes     = blocks.slopes[block].column;
#pragma GCC ivdep
#pragma GCC unroll 1
    for (int n = 0; n < lanes; ++n)
    {
      const Scalar K0 = linear(bent, n), K1 = linear(bent + 1, n), K2 = linear(bent + 2, n);
      z[n] = K0 * deflection[0][n] + K1 * deflection[1][n] + K2 * deflection[2][n];
      if constexpr (has_normals && has_cell)
        for (int c = 0; c < 2; ++c)
          slope[c][n] = K0 * slopes[c][n] + K1 * slopes[2 + c][n] + K2 * slopes[4 + c][n];
    }
    for (int i = 0; i < 3; ++i)
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int n = 0; n < lanes; ++n)
      {
        Scalar place = linear(i, n), own = linear(bent + 3 + i, n);
        place += z[n] * own;
        if constexpr (has_cell)
        {
          const Scalar lift0 = linear(6 + 2 * i, n), lift1 = linear(7 + 2 * i, n);
          place += lift0 * w[0][n] + lift1 * w[1][n];
          if constexpr (has_normals)
            own -= lift0 * slope[0][n] + lift1 * slope[1][n];
        }
        x[i][n]      = place;
        normal[i][n] = own;
      }
    if constexpr (has_normals)
#pragma GCC ivdep
#pragma GCC unroll 1
      for (int n = 0; n < lanes; ++n)
      {
        const Scalar N0 = normal[0][n], N1 = normal[1][n], N2 = normal[2][n],
                     scale = inverse_root(N0 * N0 + N1 * N1 + N2 * N2);
        normal[0][n]       = scale * N0;
        normal[1][n]       = scale * N1;
        normal[2][n]       = scale * N2;
      }
    write_rows(x, to.positions + block * lanes * 3);
    if constexpr (has_normals)
      write_rows(normal, to.normals + block * lanes * 3);
  }
}
} // namespace homespun::localization
