// SPDX-License-Identifier: MIT
#include "homogenization/bracket/bracket.h"

#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/bracket/drawn_mesh.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/bracket/loewner.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <numeric>

namespace homespun::homogenization
{
namespace
{
std::size_t at(const int index)
{
  return static_cast<std::size_t>(index);
}
} // namespace

Bracket bracket(const TorusMesh &given, const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                const unsigned order)
{
  Bracket result;
  const DrawnMesh both  = drawn(given, stiffness_of_material);
  const TorusMesh &mesh = both.mesh;
  // Which triangles the stresses may use, and their numbers there.
  std::vector<char> is_sure(mesh.triangles.size());
  std::vector<char> is_flat;
  std::vector<int> below_of(mesh.triangles.size(), -1);
  int n_sure = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if ((is_sure[t] = !both.is_void_below[t]))
    {
      is_flat.push_back(both.is_flat[t]);
      below_of[t] = n_sure++;
    }
  const TorusMesh sure_mesh = n_sure < mesh.n_triangles() ? with_only(mesh, is_sure) : mesh;
  const EquilibratedStress below(sure_mesh, both.lower,
                                 given.is_drawn() ? is_flat : std::vector<char>{});
  const CompatibleStrain above(mesh, both.upper, order);
  // The vectors of the edges carry the shape to a few units of round-off.
  const double of_shape    = 16. * std::numeric_limits<double>::epsilon();
  const double below_error = below.round_off + of_shape, above_error = above.round_off + of_shape;
  const RoundedInverse lower = inverse_of(raised(below.compliance, below_error));
  result.lower               = (1. - lower.round_off) * lower.value;
  result.upper               = raised(above.stiffness, above_error);
  result.round_off = 3. * below_error * weakness(below.compliance) + 2. * lower.round_off +
                     3. * above_error * weakness(above.stiffness);
  result.width =
    std::max(relative_width(result.lower, result.upper, result.round_off), result.round_off);
  result.is_of_drawing       = given.is_drawn();
  result.excess              = std::max(below.excess, above.excess);
  result.compliance          = below.compliance;
  result.stiffness           = above.stiffness;
  result.stiffness_by_flux   = above.stiffness_by_flux;
  result.chi                 = above.chi_at_given_vertices();
  result.n_triangles         = static_cast<unsigned>(mesh.n_triangles());
  result.n_displacement_dofs = above.n_dofs;
  result.n_stress_dofs       = below.n_dofs;
  result.iterations          = std::max(above.iterations, below.iterations);

  // Of all mean stresses, compliance^-1 e comes closest to the strains of e.
  const Eigen::Matrix3d mean_stress = below.compliance.inverse();
  const Eigen::Matrix3d weights     = above.stiffness.inverse() / mesh.lattice.area();
  const Eigen::VectorXd jumps_above = above.unbalanced_tractions(weights),
                        jumps_below =
                          below.incompatible_strains(mean_stress * weights * mean_stress);
  std::vector<Eigen::Matrix3d> compliances, slack;
  for (std::size_t m = 0; m < both.upper.size(); ++m)
  {
    compliances.emplace_back(both.upper[m].inverse());
    slack.emplace_back(both.lower[m].inverse() - compliances[m]);
  }
  result.gaps.setZero(given.n_triangles());
  result.indicators.setZero(given.n_triangles());
  Eigen::VectorXd of_arcs = result.gaps;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const auto shape              = triangle.shape(mesh.edges);
    const double area             = 0.5 * (shape[1](0) * shape[2](1) - shape[1](1) * shape[2](0));
    FieldOfLoads stress           = FieldOfLoads::Zero();
    if (is_sure[at(t)])
      stress = below.stress(below_of[at(t)]) * mean_stress;
    const FieldOfLoads strain = above.strain(t);
    const auto energy         = [&](const Eigen::Matrix3d &form, const Eigen::Matrix3d &field)
    { return (field.transpose() * form * field).cwiseProduct(weights).sum(); };
    double gap = 0.;
    for (int q = 0; q < n_field_points; ++q)
    {
      const Eigen::Matrix3d sigma = stress.middleRows<3>(3 * q);
      const Eigen::Matrix3d differs =
        sigma - both.upper[at(triangle.material)] * strain.middleRows<3>(3 * q);
      gap += area / n_field_points * energy(compliances[at(triangle.material)], differs);
      if (both.is_uncertain(t))
        gap += area / n_field_points * energy(slack[at(triangle.material)], sigma);
    }
    const int parent = both.parent[at(t)];
    result.gaps(parent) += gap;
    if (both.is_uncertain(t))
      of_arcs(parent) += gap;
    result.indicators(parent) += jumps_above(t);
    if (is_sure[at(t)])
      result.indicators(parent) += jumps_below(below_of[at(t)]);
  }
  // Jumps are errors but for a factor: that of the part of the gap which is not due to the curves.
  const double rest = result.gaps.sum() - of_arcs.sum();
  if (result.is_of_drawing && rest > 0.)
    result.indicators += result.indicators.sum() / rest * of_arcs;
  return result;
}

std::vector<char> largest(const Eigen::VectorXd &values, const double part)
{
  std::vector<int> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](const int a, const int b)
            { return values(a) != values(b) ? values(a) > values(b) : a < b; });
  std::vector<char> is_marked(order.size(), 0);
  const double wanted = part * values.sum();
  double held         = 0.;
  for (const int t : order)
  {
    if (held >= wanted)
      break;
    held += values(t);
    is_marked[at(t)] = 1;
  }
  return is_marked;
}

AdaptiveBracket adaptive_bracket(const TorusMesh &mesh,
                                 const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                                 const AdaptiveOptions &options,
                                 const std::function<void(const Bracket &)> &observe)
{
  // Squares of edges are far above the smallest numbers.
  constexpr double finest = 1e-100;
  AdaptiveBracket result{{}, mesh, AdaptiveEnd::tolerance};
  while (true)
  {
    result.bracket = bracket(result.mesh, stiffness_of_material, options.order);
    observe(result.bracket);
    result.ending = AdaptiveEnd::tolerance;
    if (result.bracket.width <= options.tolerance)
      return result;
    result.ending = result.bracket.width <= 2. * result.bracket.round_off ? AdaptiveEnd::round_off
                    : relative_resolution(result.mesh) < finest           ? AdaptiveEnd::resolution
                                                                          : AdaptiveEnd::max_dofs;
    if (result.ending != AdaptiveEnd::max_dofs)
      return result;
    TorusMesh finer =
      bisected(result.mesh, largest(result.bracket.indicators, options.marked_part));
    // Each arc has a vertex and three edges of its own.
    const int n_vertices = finer.n_vertices + finer.n_arcs(),
              n_edges    = finer.n_edges() + 3 * finer.n_arcs();
    const int n_dofs =
      std::max(3 * n_vertices + n_edges, 2 * (n_vertices + (options.order == 2 ? n_edges : 0)));
    if (n_dofs > static_cast<int>(options.max_dofs))
      return result;
    result.mesh = std::move(finer);
  }
}
} // namespace homespun::homogenization
