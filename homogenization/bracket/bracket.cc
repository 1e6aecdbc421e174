// SPDX-License-Identifier: MIT
#include "homogenization/bracket/bracket.h"

#include "homogenization/bracket/bracket_sides.h"
#include "homogenization/bracket/compatible_strain.h"
#include "homogenization/bracket/drawn_mesh.h"
#include "homogenization/bracket/equilibrated_stress.h"
#include "homogenization/bracket/loewner.h"
#include "meshes/plain/index.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <limits>
#include <numeric>

namespace homespun::homogenization
{
using meshes::at;

namespace
{
/// Triangles of a mesh, as a mesh.
struct Part
{
  TorusMesh mesh;
  std::vector<char> is_flat;
  std::vector<int> number; ///< of each triangle of the whole, -1 where it is none of the part
};

Part whole(const DrawnMesh &drawing)
{
  Part part{drawing.mesh, drawing.is_flat, std::vector<int>(drawing.mesh.triangles.size())};
  std::iota(part.number.begin(), part.number.end(), 0);
  return part;
}

/// What is certainly in no hole.
Part sure_part(const DrawnMesh &drawing)
{
  Part part{drawing.mesh, {}, std::vector<int>(drawing.mesh.triangles.size(), -1)};
  std::vector<char> is_sure(drawing.mesh.triangles.size());
  int n_sure = 0;
  for (std::size_t t = 0; t < is_sure.size(); ++t)
    if ((is_sure[t] = !drawing.is_void_below[t]))
    {
      part.is_flat.push_back(drawing.is_flat[t]);
      part.number[t] = n_sure++;
    }
  if (n_sure < drawing.mesh.n_triangles())
    part.mesh = with_only(drawing.mesh, is_sure);
  return part;
}

/// Stresses beside which the displacements of an order leave about as wide a gap: reduced triangles
/// beside linear ones, where the mesh has no triangles that are flat.
NormalDerivatives normal_derivatives_of(const TorusMesh &given, const unsigned order)
{
  return order == 1 && !given.is_drawn() ? NormalDerivatives::linear : NormalDerivatives::quadratic;
}

/// Both problems, each on its part of a drawing. What may be a part of a hole belongs to the side
/// that gains by it: there are no stresses where a hole is empty, no strains where it is rigid.
struct Sides
{
  Sides(const TorusMesh &given, const std::vector<Eigen::Matrix3d> &stiffness_of_material,
        const unsigned order, const Holes holes)
      : both(drawn(given, stiffness_of_material))
      , of_stress(holes == Holes::empty ? sure_part(both) : whole(both))
      , of_strain(holes == Holes::rigid ? sure_part(both) : whole(both))
      , below(of_stress.mesh, both.lower,
              given.is_drawn() ? of_stress.is_flat : std::vector<char>{}, holes,
              normal_derivatives_of(given, order))
      , above(of_strain.mesh, both.upper, order, holes)
  {
  }
  Sides(const Sides &)            = delete; // the problems refer to the parts
  Sides &operator=(const Sides &) = delete;

  const DrawnMesh both;
  const Part of_stress, of_strain;
  const EquilibratedStress below;
  const CompatibleStrain above;
};

/// The fields of both sides on a triangle.
struct Fields
{
  Fields(const Sides &sides, const int t)
  {
    if (const int number = sides.of_stress.number[at(t)]; number >= 0)
      stress = sides.below.stress(number);
    if (const int number = sides.of_strain.number[at(t)]; number >= 0)
      strain = sides.above.strain(number);
  }

  FieldOfLoads stress = FieldOfLoads::Zero(), strain = FieldOfLoads::Zero();
};

/// Adds a triangle to the products of the fields.
void add_to_products(const Fields &fields, const double part_of_cell, const int material,
                     Bracket &result)
{
  for (int q = 0; q < n_field_points; ++q)
  {
    const double weight = part_of_cell / n_field_points;
    add_products(weight, fields.stress.middleRows<3>(3 * q), result.stress_products[at(material)]);
    add_products(weight, fields.strain.middleRows<3>(3 * q), result.strain_products[at(material)]);
  }
}

void begin_products(const Sides &sides, Bracket &result)
{
  result.strain_products.assign(at(sides.both.n_certain), FieldProducts::Zero());
  result.stress_products = result.strain_products;
}

/// The products of the fields of both sides alone.
void multiply(const TorusMesh &given, const Sides &sides, Bracket &result)
{
  const TorusMesh &mesh = sides.both.mesh;
  begin_products(sides, result);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    add_to_products(Fields(sides, t),
                    area_of(mesh.triangles[at(t)].shape(mesh.edges)) / mesh.lattice.area(),
                    given.triangles[at(sides.both.parent[at(t)])].material, result);
}

/// The gaps, indicators and products of the fields of both sides.
void compare(const TorusMesh &given, const Sides &sides, Bracket &result)
{
  const auto &[both, of_stress, of_strain, below, above] = sides;
  const TorusMesh &mesh                                  = both.mesh;
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
  begin_products(sides, result);
  result.gaps.setZero(given.n_triangles());
  result.indicators.setZero(given.n_triangles());
  Eigen::VectorXd of_arcs = result.gaps;
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const TorusTriangle &triangle = mesh.triangles[at(t)];
    const int parent              = both.parent[at(t)];
    const double area             = area_of(triangle.shape(mesh.edges));
    const double weight           = area / n_field_points;
    const Fields fields(sides, t);
    add_to_products(fields, area / mesh.lattice.area(), given.triangles[at(parent)].material,
                    result);
    const auto energy = [&](const Eigen::Matrix3d &form, const Eigen::Matrix3d &field)
    { return (field.transpose() * form * field).cwiseProduct(weights).sum(); };
    double gap = 0.;
    for (int q = 0; q < n_field_points; ++q)
    {
      const Eigen::Matrix3d sigma = fields.stress.middleRows<3>(3 * q) * mean_stress;
      const Eigen::Matrix3d differs =
        sigma - both.upper[at(triangle.material)] * fields.strain.middleRows<3>(3 * q);
      gap += weight * energy(compliances[at(triangle.material)], differs);
      if (both.is_uncertain(t))
        gap += weight * energy(slack[at(triangle.material)], sigma);
    }
    result.gaps(parent) += gap;
    if (both.is_uncertain(t))
      of_arcs(parent) += gap;
    if (of_strain.number[at(t)] >= 0)
      result.indicators(parent) += jumps_above(of_strain.number[at(t)]);
    if (of_stress.number[at(t)] >= 0)
      result.indicators(parent) += jumps_below(of_stress.number[at(t)]);
  }
  // Jumps are errors but for a factor: that of the part of the gap which is not due to the curves.
  const double rest = result.gaps.sum() - of_arcs.sum();
  if (result.is_of_drawing && rest > 0.)
    result.indicators += result.indicators.sum() / rest * of_arcs;
}

/// What is known of both sides as a whole.
Bracket summary_of(const TorusMesh &given, const Sides &sides)
{
  Bracket result;
  const EquilibratedStress &below = sides.below;
  const CompatibleStrain &above   = sides.above;
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
  result.stress_function     = below.stress_function_at_given_vertices();
  result.n_triangles         = static_cast<unsigned>(sides.both.mesh.n_triangles());
  result.n_displacement_dofs = above.n_dofs;
  result.n_stress_dofs       = below.n_dofs;
  result.iterations          = std::max(above.iterations, below.iterations);
  return result;
}
} // namespace

Bracket bracket(const TorusMesh &given, const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                const unsigned order, const Holes holes)
{
  const Sides sides(given, stiffness_of_material, order, holes);
  Bracket result = summary_of(given, sides);
  compare(given, sides, result);
  return result;
}

Bracket bracket_sides(const TorusMesh &given,
                      const std::vector<Eigen::Matrix3d> &stiffness_of_material,
                      const unsigned order, const Holes holes)
{
  const Sides sides(given, stiffness_of_material, order, holes);
  Bracket result = summary_of(given, sides);
  multiply(given, sides, result);
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
    result.bracket = bracket(result.mesh, stiffness_of_material, options.order, options.holes);
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
    const bool has_unknowns_of_edges =
      normal_derivatives_of(finer, options.order) == NormalDerivatives::quadratic;
    const int n_dofs = std::max(3 * n_vertices + (has_unknowns_of_edges ? n_edges : 0),
                                2 * (n_vertices + (options.order == 2 ? n_edges : 0)));
    if (n_dofs > static_cast<int>(options.max_dofs))
      return result;
    result.mesh = std::move(finer);
  }
}
} // namespace homespun::homogenization
