// SPDX-License-Identifier: MIT
#include "shell/algebra/dense_panel.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <cmath>
#include <cstring>

namespace homespun::shell
{
namespace
{
using Panel = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// As many numbers as a register holds.
#if defined(__AVX512F__)
constexpr int lanes = 8;
#elif defined(__AVX__)
constexpr int lanes = 4;
#else
constexpr int lanes = 2;
#endif
/// From this width on a panel does not fit into the inner caches, and Eigen factors it by blocks.
constexpr int wide = 120;

typedef double Lanes __attribute__((vector_size(8 * lanes)));

/// Registers of rows that are multiplied at once: with three columns nine sums and what they are
/// made of, which 16 registers hold.
constexpr int most_registers = 3;
static_assert(most_registers * lanes <= panel_padding);

/// Lanes from any place. They stay in a register: read anew for each product, as compilers like to,
/// they would cost two cache lines each time.
inline Lanes loaded(const double *from)
{
  Lanes x;
  std::memcpy(&x, from, sizeof(Lanes));
#if defined(__AVX512F__)
  asm("" : "+v"(x));
#elif defined(__x86_64__)
  asm("" : "+x"(x));
#endif
  return x;
}

inline double sum_of(const Lanes &x)
{
  double sum = 0.;
  for (int k = 0; k < lanes; ++k)
    sum += x[k];
  return sum;
}

/// n_registers registers of rows of T = A B^T; see multiply().
template <int n_registers>
void multiply_rows(const double *a, const double *b, const int stride, const int depth, double *t,
                   const int t_stride)
{
  Lanes sum[n_registers][3];
#pragma GCC unroll 3
  for (int r = 0; r < n_registers; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c)
      sum[r][c] = Lanes{};
  for (int k = 0; k < depth; ++k, a += stride, b += stride)
  {
    Lanes x[n_registers];
#pragma GCC unroll 3
    for (int r = 0; r < n_registers; ++r)
      x[r] = loaded(a + r * lanes);
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c)
#pragma GCC unroll 3
      for (int r = 0; r < n_registers; ++r)
        sum[r][c] += x[r] * b[c];
  }
#pragma GCC unroll 3
  for (int r = 0; r < n_registers; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < 3; ++c)
      std::memcpy(t + c * t_stride + r * lanes, &sum[r][c], sizeof(Lanes));
}
} // namespace

int padded(const int n)
{
  return (n + lanes - 1) / lanes * lanes;
}

void multiply(const double *a, const double *b, const int stride, const int depth, const int n,
              double *t)
{
  const int t_stride = padded(n);
  int row            = 0;
  for (; row + (most_registers - 1) * lanes < n; row += most_registers * lanes)
    multiply_rows<most_registers>(a + row, b, stride, depth, t + row, t_stride);
  if (row + lanes < n)
    multiply_rows<2>(a + row, b, stride, depth, t + row, t_stride);
  else if (row < n)
    multiply_rows<1>(a + row, b, stride, depth, t + row, t_stride);
}

namespace
{
/// The Cholesky factor of the three leading rows of three columns with leading dimension `stride`,
/// and the rows below it solved with it.
/// @return false where a pivot is not positive
bool factorize_columns(double *const x, const int stride, const int n)
{
  double *const __restrict x0 = x;
  double *const __restrict x1 = x + stride;
  double *const __restrict x2 = x + 2 * stride;
  if (!(x0[0] > 0.))
    return false;
  const double l00 = std::sqrt(x0[0]), i0 = 1. / l00, l10 = x0[1] * i0, l20 = x0[2] * i0,
               d1 = x1[1] - l10 * l10;
  if (!(d1 > 0.))
    return false;
  const double l11 = std::sqrt(d1), i1 = 1. / l11, l21 = (x1[2] - l20 * l10) * i1,
               d2 = x2[2] - l20 * l20 - l21 * l21;
  if (!(d2 > 0.))
    return false;
  const double l22 = std::sqrt(d2), i2 = 1. / l22;
  x0[0] = l00;
  x0[1] = l10;
  x0[2] = l20;
  x1[1] = l11;
  x1[2] = l21;
  x2[2] = l22;
#pragma GCC ivdep
  for (int r = 3; r < n; ++r)
  {
    const double y0 = x0[r] * i0, y1 = (x1[r] - y0 * l10) * i1;
    x0[r] = y0;
    x1[r] = y1;
    x2[r] = (x2[r] - y0 * l20 - y1 * l21) * i2;
  }
  return true;
}
} // namespace

bool factorize_panel(double *const panel, const int width, const int size, double *const product)
{
  if (width >= wide)
  {
    Panel all(panel, size, width, Eigen::OuterStride<>(size));
    Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> top = all.topRows(width);
    const Eigen::LLT<decltype(top)> llt(top);
    if (llt.info() != Eigen::Success)
      return false;
    auto below = all.bottomRows(size - width);
    top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    return true;
  }
  for (int j = 0; j < width; j += 3)
  {
    const int n = size - j, n_padded = padded(n);
    double *const columns = panel + j * size + j;
    if (j > 0)
    {
      multiply(panel + j, panel + j, size, j, n, product);
      for (int c = 0; c < 3; ++c)
      {
        double *const __restrict to         = columns + c * size;
        const double *const __restrict from = product + c * n_padded;
        for (int r = 0; r < n; ++r)
          to[r] -= from[r];
      }
    }
    if (!factorize_columns(columns, size, n))
      return false;
  }
  return true;
}

void substitute(const double *panel, const int width, const int size, double *const x)
{
  for (int j = 0; j < width; j += 3, panel += 3 * size)
  {
    const double *const __restrict l0 = panel, *const __restrict l1 = panel + size,
                                   *const __restrict l2 = panel + 2 * size;
    const double y0 = x[j] / l0[j], y1 = (x[j + 1] - l0[j + 1] * y0) / l1[j + 1],
                 y2 = (x[j + 2] - l0[j + 2] * y0 - l1[j + 2] * y1) / l2[j + 2];
    x[j]            = y0;
    x[j + 1]        = y1;
    x[j + 2]        = y2;
#pragma GCC ivdep
    for (int r = j + 3; r < size; ++r)
      x[r] -= l0[r] * y0 + l1[r] * y1 + l2[r] * y2;
  }
}

void substitute_back(const double *panel, const int width, const int size, double *const x)
{
  for (int j = width - 3; j >= 0; j -= 3)
  {
    const double *const l0 = panel + j * size, *const l1 = l0 + size, *const l2 = l1 + size;
    Lanes s0 = {}, s1 = {}, s2 = {};
    int r = j + 3;
    for (; r + lanes <= size; r += lanes)
    {
      const Lanes y = loaded(x + r);
      s0 += y * loaded(l0 + r);
      s1 += y * loaded(l1 + r);
      s2 += y * loaded(l2 + r);
    }
    double t0 = sum_of(s0), t1 = sum_of(s1), t2 = sum_of(s2);
    for (; r < size; ++r)
    {
      t0 += l0[r] * x[r];
      t1 += l1[r] * x[r];
      t2 += l2[r] * x[r];
    }
    x[j + 2] = (x[j + 2] - t2) / l2[j + 2];
    x[j + 1] = (x[j + 1] - t1 - l1[j + 2] * x[j + 2]) / l1[j + 1];
    x[j]     = (x[j] - t0 - l0[j + 1] * x[j + 1] - l0[j + 2] * x[j + 2]) / l0[j];
  }
}
} // namespace homespun::shell
