// SPDX-License-Identifier: MIT
#include "verification/benchmark/machine_limits.h"

#include "verification/benchmark/repeated.h"
#include "verification/record/blas.h"

#include <cmath>
#include <cstring>
#include <stdexcept>

namespace homespun::verification
{
namespace
{
/// Has the compiler believe that memory is read, so that no work is left out.
void keep(const void *memory)
{
  asm volatile("" : : "g"(memory) : "memory");
}
} // namespace

MeasuredWork copy_limit(const std::size_t bytes, const int n_runs)
{
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes, 0);
  MeasuredWork copy;
  copy.seconds = repeated_seconds(
    [&]()
    {
      std::memcpy(to.data(), from.data(), bytes);
      keep(to.data());
    },
    n_runs);
  copy.work = 2. * static_cast<double>(bytes);
  return copy;
}

MeasuredWork triad_limit(const std::size_t n, const int n_runs)
{
  std::vector<double> a(n, 0.);
  const std::vector<double> b(n, 1.), c(n, 2.);
  MeasuredWork triad;
  triad.seconds = repeated_seconds(
    [&]()
    {
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + 3. * c[i];
      keep(a.data());
    },
    n_runs);
  triad.work = 3. * sizeof(double) * static_cast<double>(n);
  return triad;
}

MeasuredWork product_limit(const int n, const int n_runs)
{
  const auto size = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  std::vector<double> a(size), b(size), c(size, 0.);
  for (std::size_t i = 0; i < size; ++i)
  {
    a[i] = 1. + 1e-3 * static_cast<double>(i % 7);
    b[i] = 1. - 1e-3 * static_cast<double>(i % 5);
  }
  bool is_there = true;
  MeasuredWork product;
  product.seconds = repeated_seconds(
    [&]()
    {
      is_there = multiply_by_blas(n, a.data(), b.data(), c.data());
      keep(c.data());
    },
    n_runs);
  // One entry, so that what is timed is a product.
  double last = 0.;
  for (int k = 0; k < n; ++k)
    last += a[static_cast<std::size_t>(n - 1 + k * n)] * b[size - static_cast<std::size_t>(n - k)];
  if (!is_there || !(std::abs(c.back() - last) <= 1e-10 * std::abs(last)))
    throw std::logic_error("the product of the BLAS that is loaded is wrong, or there is none");
  product.work = 2. * std::pow(n, 3);
  return product;
}
} // namespace homespun::verification
