// SPDX-License-Identifier: MIT
#include "shell/terms/yarn_term.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/membrane/yarn_discrete_gradient.h"
#include "shell/membrane/yarn_energy.h"
#include "shell/terms/triangle_term.h"

#include <utility>

namespace homespun::shell
{
namespace
{
class YarnTerm final : public TriangleTerm
{
public:
  using TriangleTerm::TriangleTerm;

  std::string name() const override
  {
    return "yarn membrane";
  }

  double energy(const Vectors &positions) const override
  {
    return membrane_energy<3>(membrane, positions);
  }

  std::string why_infinite(const Vectors &positions) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
      if (const meshes::YarnAxes &yarns = membrane.yarns[phase_of(t)];
          yarns.are_there &&
          !has_length<3>(deformation_gradient<3>(membrane.rest[index(t)], corners_of(positions, t)),
                         yarns))
        return "triangle " + std::to_string(t) + ": a yarn without length";
    return {};
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      add_forces(
        t,
        membrane_triangle_derivatives<3>(membrane, t, corners_of(positions, t), Hessian::exact)
          .gradient,
        gradient);
    }
  }

  void add_derivatives(const Vectors &positions, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      add(t, membrane_triangle_derivatives<3>(membrane, t, corners_of(positions, t), kind),
          gradient, matrix);
    }
  }

  bool has_discrete_gradient() const override
  {
    return true;
  }

  void add_discrete_gradient(const Vectors &old, const Vectors &positions, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      const RestTriangle &rest    = membrane.rest[index(t)];
      const std::size_t phase     = phase_of(t);
      const Eigen::Matrix3d begin = corners_of(old, t), end = corners_of(positions, t);
      const TriangleStep step =
        membrane.yarns[phase].are_there
          ? yarn_triangle_step(rest, begin, end, membrane.yarns[phase])
          : triangle_step(rest, begin, end, membrane.stiffness[phase].D, {});
      add_step(step, membrane.triangles.row(t), gradient, jacobian);
    }
  }

  std::size_t bytes() const override
  {
    return index(n_triangles()) *
           (3 * sizeof(int) + sizeof(RestTriangle) + sizeof(int) + sizeof(places[0]));
  }
};
} // namespace

std::unique_ptr<Term> yarn_term(const meshes::ClothMesh &cloth,
                                const std::vector<Eigen::Matrix3d> &stiffness)
{
  Membrane whole = membrane(cloth, stiffness);
  take_yarn_law(whole);
  if (whole.yarns.empty())
    throw meshes::BadInput("law yarn: the stiffness of every phase is alike in all directions; "
                           "expected one with axes, or membrane_term()");
  return std::make_unique<YarnTerm>(std::move(whole));
}
} // namespace homespun::shell
