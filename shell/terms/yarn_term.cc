// SPDX-License-Identifier: MIT
#include "shell/terms/yarn_term.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/algebra/triangle_slots.h"
#include "shell/membrane/yarn_energy.h"

#include <utility>

namespace homespun::shell
{
namespace
{
class YarnTerm final : public Term
{
public:
  explicit YarnTerm(Membrane &&membrane)
      : membrane(std::move(membrane))
  {
  }

  std::string name() const override
  {
    return "yarn membrane";
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    couple_corners(membrane.triangles, pairs);
  }

  void attach(const BlockMatrix &matrix) override
  {
    places = places_of(membrane.triangles, matrix);
  }

  double energy(const Vectors &positions) const override
  {
    return membrane_energy<3>(membrane, positions);
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      const Eigen::Matrix3d forces =
        yarn_triangle_gradient<3>(membrane.rest[index(t)], corners_of(positions, t), yarns_of(t));
      for (int k = 0; k < 3; ++k)
        gradient.row(membrane.triangles(t, k)) += forces.row(k);
    }
  }

  void add_derivatives(const Vectors &positions, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
    {
      const TriangleDerivatives<3> local = yarn_triangle_derivatives<3>(
        membrane.rest[index(t)], corners_of(positions, t), yarns_of(t), kind);
      for (int k = 0; k < 3; ++k)
        gradient.row(membrane.triangles(t, k)) += local.gradient.row(k);
      for (std::size_t b = 0; b < 6; ++b)
        matrix.add(places[index(t)][b], local.blocks[b]);
    }
  }

  std::size_t bytes() const override
  {
    return index(n_triangles()) *
           (3 * sizeof(int) + sizeof(RestTriangle) + sizeof(int) + sizeof(places[0]));
  }

private:
  int n_triangles() const
  {
    return static_cast<int>(membrane.triangles.rows());
  }
  const meshes::YarnAxes &yarns_of(const int t) const
  {
    return membrane.yarns[index(membrane.phase[index(t)])];
  }
  Eigen::Matrix3d corners_of(const Vectors &positions, const int t) const
  {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k)
      corners.row(k) = positions.row(membrane.triangles(t, k));
    return corners;
  }

  const Membrane membrane;
  std::vector<TriangleSlots> places; ///< (m)
};
} // namespace

std::unique_ptr<Term> yarn_term(const meshes::ClothMesh &cloth,
                                const std::vector<Eigen::Matrix3d> &stiffness)
{
  Membrane whole = membrane(cloth, stiffness);
  std::vector<std::string> faults;
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
    if (!meshes::yarn_axes(stiffness[phase]).are_there)
      faults.push_back("law yarn: stiffness of phase " + std::to_string(phase) +
                       " is alike in all directions; expected one with axes, or membrane_term()");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  take_yarn_law(whole);
  return std::make_unique<YarnTerm>(std::move(whole));
}
} // namespace homespun::shell
