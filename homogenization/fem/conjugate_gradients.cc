// SPDX-License-Identifier: MIT
#include "homogenization/fem/conjugate_gradients.h"

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

namespace homespun::homogenization
{
namespace
{
using Block = Epetra_MultiVector; ///< a column for each right-hand side

/// Some columns of a block.
Block columns_of(const Block &block, std::vector<int> &columns)
{
  return {View, block, columns.data(), static_cast<int>(columns.size())};
}

/// One vector of each load as a block, not copied.
Block block_of(const std::vector<LoadAbreast> &loads,
               dealii::TrilinosWrappers::MPI::Vector *LoadAbreast::*vector,
               const Epetra_BlockMap &map)
{
  std::vector<double *> columns;
  for (const LoadAbreast &load : loads)
    columns.push_back((load.*vector)->begin());
  return {View, map, columns.data(), static_cast<int>(columns.size())};
}

void copy(const Block &from, const int column, dealii::TrilinosWrappers::MPI::Vector &to)
{
  std::copy(from[column], from[column] + from.MyLength(), to.begin());
}

/// Conjugate gradients of several right-hand sides, of which those that are solved drop out.
class LoadsAbreast
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  LoadsAbreast(const Epetra_CrsMatrix &A,
               const std::function<void(const Block &, Block &)> &preconditioner,
               std::vector<LoadAbreast> given)
      : A(A)
      , preconditioner(preconditioner)
      , loads(std::move(given))
      , x(block_of(loads, &LoadAbreast::solution, A.DomainMap()))
      , residual(block_of(loads, &LoadAbreast::residual, A.DomainMap()))
      , image(A.DomainMap(), x.NumVectors())
      , direction(A.DomainMap(), x.NumVectors())
      , product(loads.size(), 0.)
      , found(loads.size(), 0.)
      , histories(loads.size())
      , iterations(loads.size(), 0)
  {
    open.resize(loads.size());
    std::iota(open.begin(), open.end(), 0);
    A.Apply(x, image);
    residual.Update(-1., image, 1.);
    note_residuals();
    close([this](const std::size_t load) { return is_small(load); });
  }

  std::vector<unsigned int> run(const unsigned int max_iterations)
  {
    for (unsigned int iteration = 0; !open.empty(); ++iteration)
    {
      const std::vector<double> old_product = product;
      precondition();
      close([this](const std::size_t load)
            { return is_small(load) && std::abs(product[load]) <= loads[load].target.energy; });
      for (const int k : open)
      {
        const auto load = static_cast<std::size_t>(k);
        if (iteration == max_iterations)
          throw not_converged(loads[load].target, product[load], histories[load]);
        if (!(product[load] > 0.) || !std::isfinite(product[load]))
          throw meshes::NotConverged(
            "conjugate gradients: the preconditioner is not positive definite", histories[load]);
        direction(k)->Update(1., *image(k),
                             iteration == 0 ? 0. : product[load] / old_product[load]);
      }
      if (!open.empty())
        step();
      close([this](const std::size_t load)
            { return std::isinf(loads[load].target.energy) && is_small(load); });
    }
    return iterations;
  }

private:
  bool is_small(const std::size_t load) const
  {
    return histories[load].back() <= loads[load].target.residual;
  }

  void note_residuals()
  {
    columns_of(residual, open).Norm2(found.data());
    for (std::size_t k = 0; k < open.size(); ++k)
      histories[static_cast<std::size_t>(open[k])].push_back(found[k]);
  }

  /// Those that have met their target are handed out.
  template <typename IsMet>
  void close(const IsMet &is_met)
  {
    std::vector<int> left;
    for (const int k : open)
    {
      const auto load = static_cast<std::size_t>(k);
      if (!is_met(load))
      {
        left.push_back(k);
        continue;
      }
      iterations[load] = static_cast<unsigned int>(histories[load].size()) - 1;
    }
    open = left;
  }

  /// M^-1 r, in the place of the image of the last direction, which nobody needs any more.
  void precondition()
  {
    const Block from = columns_of(residual, open);
    Block to         = columns_of(image, open);
    preconditioner(from, to);
    from.Dot(to, found.data());
    for (std::size_t k = 0; k < open.size(); ++k)
      product[static_cast<std::size_t>(open[k])] = found[k];
  }

  void step()
  {
    const Block from = columns_of(direction, open);
    Block to         = columns_of(image, open);
    A.Apply(from, to);
    from.Dot(to, found.data());
    for (std::size_t k = 0; k < open.size(); ++k)
    {
      const auto load        = static_cast<std::size_t>(open[k]);
      const double curvature = found[k];
      if (!(curvature > 0.) || !std::isfinite(curvature))
      {
        Vector flat = *loads[load].solution;
        copy(direction, open[k], flat);
        throw IndefiniteMatrix(histories[load], flat);
      }
      const double length = product[load] / curvature;
      x(open[k])->Update(length, *direction(open[k]), 1.);
      residual(open[k])->Update(-length, *image(open[k]), 1.);
    }
    note_residuals();
  }

  const Epetra_CrsMatrix &A;
  const std::function<void(const Block &, Block &)> &preconditioner;
  const std::vector<LoadAbreast> loads;
  Block x, residual; ///< the vectors of the caller
  Block image, direction;
  std::vector<double> product; ///< r . M^-1 r of each
  std::vector<double> found;   ///< of each that is open
  std::vector<std::vector<double>> histories;
  std::vector<unsigned int> iterations;
  std::vector<int> open; ///< columns of those that are not solved
};
} // namespace

std::vector<unsigned int> gradients_abreast(
  const Epetra_CrsMatrix &A,
  const std::function<void(const Epetra_MultiVector &, Epetra_MultiVector &)> &preconditioner,
  const std::vector<LoadAbreast> &loads, const unsigned int max_iterations)
{
  return LoadsAbreast(A, preconditioner, loads).run(max_iterations);
}

meshes::NotConverged not_converged(const GradientsTarget &target, const double energy,
                                   const std::vector<double> &history)
{
  std::ostringstream text;
  text << "conjugate gradients did not reach a residual of " << target.residual;
  if (!std::isinf(target.energy))
    text << " and an energy of the error of " << 0.5 * target.energy << " J";
  text << " in " << history.size() - 1 << " iterations; the last are " << history.back();
  if (!std::isinf(target.energy))
    text << " and " << 0.5 * energy << " J";
  return {text.str(), history};
}
} // namespace homespun::homogenization
