// SPDX-License-Identifier: MIT
// In which order the unknowns of a large sparse matrix are eliminated, so that its factor fills in
// little.
#pragma once

#include <Eigen/SparseCore>

#include <vector>

namespace homespun::homogenization
{
/// Nested dissection of the graph of a symmetric matrix in which neighbouring unknowns with the
/// same entries, those of a node, are one: three unknowns at a vertex make a graph of a ninth of
/// the edges, and the unknowns of a node stay together.
/// @param lower_triangle compressed
/// @return (n) which unknown is eliminated first, second, ...
/// Source: G. Karypis and V. Kumar, SIAM J. Sci. Comput. 20, 1998 (METIS).
std::vector<int> elimination_order(const Eigen::SparseMatrix<double> &lower_triangle);
} // namespace homespun::homogenization
