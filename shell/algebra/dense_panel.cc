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
template <int dim, int n_registers>
void multiply_rows(const double *a, const double *b, const int stride, const int depth, double *t,
                   const int t_stride)
{
  Lanes sum[n_registers][dim];
#pragma GCC unroll 3
  for (int r = 0; r < n_registers; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < dim; ++c)
      sum[r][c] = Lanes{};
  for (int k = 0; k < depth; ++k, a += stride, b += stride)
  {
    Lanes x[n_registers];
#pragma GCC unroll 3
    for (int r = 0; r < n_registers; ++r)
      x[r] = loaded(a + r * lanes);
#pragma GCC unroll 3
    for (int c = 0; c < dim; ++c)
#pragma GCC unroll 3
      for (int r = 0; r < n_registers; ++r)
        sum[r][c] += x[r] * b[c];
  }
#pragma GCC unroll 3
  for (int r = 0; r < n_registers; ++r)
#pragma GCC unroll 3
    for (int c = 0; c < dim; ++c)
      std::memcpy(t + c * t_stride + r * lanes, &sum[r][c], sizeof(Lanes));
}
} // namespace

int padded(const int n)
{
  return (n + lanes - 1) / lanes * lanes;
}

template <int dim>
void multiply(const double *a, const double *b, const int stride, const int depth, const int n,
              double *t)
{
  const int t_stride = padded(n);
  int row            = 0;
  for (; row + (most_registers - 1) * lanes < n; row += most_registers * lanes)
    multiply_rows<dim, most_registers>(a + row, b, stride, depth, t + row, t_stride);
  if (row + lanes < n)
    multiply_rows<dim, 2>(a + row, b, stride, depth, t + row, t_stride);
  else if (row < n)
    multiply_rows<dim, 1>(a + row, b, stride, depth, t + row, t_stride);
}

namespace
{
/// The Cholesky factor of the leading rows of dim columns with leading dimension `stride`, and the
/// rows below it solved with it.
/// @return false where a pivot is not positive
template <int dim>
bool factorize_columns(double *const x, const int stride, const int n)
{
  double l[dim][dim], inverse[dim];
  for (int c = 0; c < dim; ++c)
  {
    double *const column = x + c * stride;
    double square        = column[c];
    for (int k = 0; k < c; ++k)
      square -= l[c][k] * l[c][k];
    if (!(square > 0.))
      return false;
    column[c] = l[c][c] = std::sqrt(square);
    inverse[c]          = 1. / l[c][c];
    for (int r = c + 1; r < dim; ++r)
    {
      double sum = column[r];
      for (int k = 0; k < c; ++k)
        sum -= l[r][k] * l[c][k];
      column[r] = l[r][c] = sum * inverse[c];
    }
  }
#pragma GCC ivdep
  for (int r = dim; r < n; ++r)
  {
    double y[dim];
#pragma GCC unroll 3
    for (int c = 0; c < dim; ++c)
    {
      double sum = x[c * stride + r];
#pragma GCC unroll 3
      for (int k = 0; k < c; ++k)
        sum -= y[k] * l[c][k];
      x[c * stride + r] = y[c] = sum * inverse[c];
    }
  }
  return true;
}
} // namespace

template <int dim>
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
  for (int j = 0; j < width; j += dim)
  {
    const int n = size - j, n_padded = padded(n);
    double *const columns = panel + j * size + j;
    if (j > 0)
    {
      multiply<dim>(panel + j, panel + j, size, j, n, product);
      for (int c = 0; c < dim; ++c)
      {
        double *const __restrict to         = columns + c * size;
        const double *const __restrict from = product + c * n_padded;
        for (int r = 0; r < n; ++r)
          to[r] -= from[r];
      }
    }
    if (!factorize_columns<dim>(columns, size, n))
      return false;
  }
  return true;
}

template <int dim>
void substitute(const double *panel, const int width, const int size, double *const x)
{
  for (int j = 0; j < width; j += dim, panel += dim * size)
  {
    double y[dim];
    for (int c = 0; c < dim; ++c)
    {
      y[c] = x[j + c];
      for (int k = 0; k < c; ++k)
        y[c] -= panel[k * size + j + c] * y[k];
      x[j + c] = y[c] /= panel[c * size + j + c];
    }
#pragma GCC ivdep
    for (int r = j + dim; r < size; ++r)
    {
      double sum = panel[r] * y[0];
#pragma GCC unroll 2
      for (int c = 1; c < dim; ++c)
        sum += panel[c * size + r] * y[c];
      x[r] -= sum;
    }
  }
}

template <int dim>
void substitute_back(const double *panel, const int width, const int size, double *const x)
{
  for (int j = width - dim; j >= 0; j -= dim)
  {
    const double *const l = panel + j * size;
    Lanes sums[dim]       = {};
    int r                 = j + dim;
    for (; r + lanes <= size; r += lanes)
    {
      const Lanes y = loaded(x + r);
#pragma GCC unroll 3
      for (int c = 0; c < dim; ++c)
        sums[c] += y * loaded(l + c * size + r);
    }
    double rest[dim];
    for (int c = 0; c < dim; ++c)
      rest[c] = sum_of(sums[c]);
    for (; r < size; ++r)
      for (int c = 0; c < dim; ++c)
        rest[c] += l[c * size + r] * x[r];
    for (int c = dim - 1; c >= 0; --c)
    {
      double left = x[j + c] - rest[c];
      for (int k = c + 1; k < dim; ++k)
        left -= l[c * size + j + k] * x[j + k];
      x[j + c] = left / l[c * size + j + c];
    }
  }
}

template void multiply<2>(const double *, const double *, int, int, int, double *);
template void multiply<3>(const double *, const double *, int, int, int, double *);
template bool factorize_panel<2>(double *, int, int, double *);
template bool factorize_panel<3>(double *, int, int, double *);
template void substitute<2>(const double *, int, int, double *);
template void substitute<3>(const double *, int, int, double *);
template void substitute_back<2>(const double *, int, int, double *);
template void substitute_back<3>(const double *, int, int, double *);
} // namespace homespun::shell
