// SPDX-License-Identifier: MIT
#include "shell/terms/bending.h"

#include "shell/algebra/index.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/terms/hinges.h"

#include <map>

namespace homespun::shell
{
namespace
{
/// E = −½ Σ_pairs w |x_a − x_b|²: the Hessian has w I at (a,b) and −Σ w I on the diagonal.
class Bending final : public Term
{
public:
  Bending(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
      : diagonal(Eigen::VectorXd::Zero(mesh.n_vertices()))
  {
    const Hinges hinges = hinges_of(mesh, stiffness);
    std::map<std::array<int, 2>, double> sums;
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const Patch &patch = hinges.patches[index(t)];
      for (std::size_t i = 0; i < patch.corner.size(); ++i)
        for (std::size_t j = 0; j < patch.corner.size(); ++j)
        {
          const HalfHinge &one   = hinges.of[index(t)][index(patch.corner[i])],
                          &other = hinges.of[index(t)][index(patch.corner[j])];
          const auto rows        = vertices_of(mesh, t, patch.corner[i], one);
          const auto cols        = vertices_of(mesh, t, patch.corner[j], other);
          const double Q =
            patch.stiffness(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
          for (int p = 0; p < 4; ++p)
            for (int q = 0; q < 4; ++q)
              if (rows[index(p)] < cols[index(q)]) // the others follow by symmetry, and translation
                sums[{rows[index(p)], cols[index(q)]}] += Q * one.weights(p) * other.weights(q);
        }
    }
    pairs.reserve(sums.size());
    weights.reserve(sums.size());
    for (const auto &[pair, weight] : sums)
    {
      pairs.push_back(pair);
      weights.push_back(weight);
      diagonal(pair[0]) -= weight;
      diagonal(pair[1]) -= weight;
    }
  }

  std::string name() const override
  {
    return "bending";
  }

  void couple(std::vector<std::array<int, 2>> &all) const override
  {
    all.insert(all.end(), pairs.begin(), pairs.end());
  }

  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (const auto &pair : pairs)
      places.push_back(matrix.slot(pair[0], pair[1]));
    diagonal_places.clear();
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      diagonal_places.push_back(matrix.slot(v, v));
  }

  double energy(const Vectors &x) const override
  {
    double sum = 0.;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      sum -= weights[p] * (x.row(pairs[p][0]) - x.row(pairs[p][1])).squaredNorm();
    return 0.5 * sum;
  }

  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      const Eigen::RowVector3d pull = weights[p] * (x.row(pairs[p][1]) - x.row(pairs[p][0]));
      gradient.row(pairs[p][0]) += pull;
      gradient.row(pairs[p][1]) -= pull;
    }
  }

  void add_derivatives(const Vectors &x, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(x, gradient);
    for (std::size_t p = 0; p < pairs.size(); ++p)
      add_scalar(places[p], weights[p], matrix);
    for (std::size_t v = 0; v < diagonal_places.size(); ++v)
      add_scalar(diagonal_places[v], diagonal(static_cast<Eigen::Index>(v)), matrix);
  }

  bool has_discrete_gradient() const override
  {
    return true;
  }

  // Of a quadratic energy it is the gradient half way.
  void add_discrete_gradient(const Vectors &old, const Vectors &x, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    add_gradient(0.5 * (old + x), gradient);
    const auto add = [&](const int a, const int b, const double weight)
    { jacobian.add(a, b, 0.5 * weight * Eigen::Matrix3d::Identity()); };
    for (std::size_t p = 0; p < pairs.size(); ++p)
    {
      add(pairs[p][0], pairs[p][1], weights[p]);
      add(pairs[p][1], pairs[p][0], weights[p]);
    }
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      add(v, v, diagonal(v));
  }

  std::size_t bytes() const override
  {
    return pairs.size() * (sizeof(pairs[0]) + sizeof(weights[0]) + sizeof(places[0])) +
           static_cast<std::size_t>(diagonal.size()) * (sizeof(double) + sizeof(places[0]));
  }

private:
  static void add_scalar(const BlockMatrix::Slot &where, const double value, BlockMatrix &matrix)
  {
    if (where.block >= 0)
      matrix.blocks[index(where.block)].diagonal().array() += value;
  }

  std::vector<std::array<int, 2>> pairs; ///< first < second
  std::vector<double> weights;           ///< [N/m]
  Eigen::VectorXd diagonal;              ///< (n) [N/m]
  std::vector<BlockMatrix::Slot> places, diagonal_places;
};
} // namespace

std::unique_ptr<Term> bending_term(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness)
{
  return std::make_unique<Bending>(mesh, stiffness);
}
} // namespace homespun::shell
