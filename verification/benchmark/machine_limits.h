// SPDX-License-Identifier: MIT
// How fast one thread of this machine moves and multiplies numbers: what the parts of the work are
// held against.
#pragma once

#include <cstddef>
#include <vector>

namespace homespun::verification
{
/// Times of some work [s], and how much that is.
struct MeasuredWork
{
  std::vector<double> seconds;
  double work = 0.;
};


/// Copies of so many bytes, which stay in the cache that they fit in.
/// @return work: bytes that are moved, read and written
MeasuredWork copy_limit(std::size_t bytes, int n_runs);

/// a = b + s c on vectors of n numbers.
/// @return work: bytes that are moved, two vectors read and one written
MeasuredWork triad_limit(std::size_t n, int n_runs);

/// The product of two full matrices of n rows and columns, by the BLAS that is loaded.
/// @return work: floating-point operations, 2 n^3
/// @throws std::logic_error where no BLAS is loaded, or its product is wrong
MeasuredWork product_limit(int n, int n_runs);
} // namespace homespun::verification
