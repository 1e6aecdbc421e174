// SPDX-License-Identifier: MIT
// Dense linear algebra of the panels of a sparse Cholesky factor: column-major, a few to a hundred
// columns wide, their width and height multiples of the block size dim, 2 or 3. At such sizes
// general libraries spend more time on packing and dispatch than on arithmetic; here rows stay in
// registers.
#pragma once

namespace homespun::shell
{
/// Numbers behind the last one of a panel that multiply() may read: rows are read by whole
/// registers.
constexpr int panel_padding = 32;

/// Rows of T that multiply() writes for n: whole registers.
int padded(int n);

/// T = A B^T for a panel A (n,depth) and the rows B (dim,depth) at b, both with leading dimension
/// `stride`; T (n,dim) with leading dimension padded(n). Reads and writes padded(n) rows.
template <int dim>
void multiply(const double *a, const double *b, int stride, int depth, int n, double *t);

/// L of a panel (size,width) in place: its first rows are the lower half of a symmetric matrix.
/// @param product room for dim padded(size) numbers
/// @return false where a pivot is not positive
template <int dim>
bool factorize_panel(double *panel, int width, int size, double *product);

/// The leading rows of L y = x in place, for a panel L (size,width); what they contribute is taken
/// from the rows below.
/// @param x (size)
template <int dim>
void substitute(const double *panel, int width, int size, double *x);

/// The leading rows of L^T y = x in place, the rows below being known.
/// @param x (size)
template <int dim>
void substitute_back(const double *panel, int width, int size, double *x);
} // namespace homespun::shell
