// SPDX-License-Identifier: MIT
#include "shell/terms/membrane_term.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/vertex_matrix.h"
#include "shell/membrane/discrete_gradient.h"
#include "shell/membrane/triangle_packs.h"
#include "shell/terms/triangle_term.h"

#include <cmath>
#include <sstream>

namespace homespun::shell
{
namespace
{
class MembraneTerm final : public TriangleTerm
{
public:
  /// @param is_elastic false: the viscous part alone
  MembraneTerm(Membrane &&given, const double viscosity, const bool is_elastic)
      : TriangleTerm(std::move(given))
      , viscosity(viscosity)
      , is_elastic(is_elastic)
      , effective(membrane.stiffness)
      , packs(membrane)
  {
    if (!membrane.cubic.empty())
    {
      tangent = std::make_unique<Tangent>(membrane);
      tangent->stiffness.reserve(membrane.rest.size());
    }
  }

  std::string name() const override
  {
    return !membrane.cubic.empty() ? "cubic membrane" : is_elastic ? "membrane" : "viscosity";
  }

  void begin_step(const StepStart &start) override
  {
    if (viscosity == 0.)
      return;
    // An infinite step, an equilibrium, has no rate of strain.
    factor = viscosity / start.step;
    for (std::size_t phase = 0; phase < effective.size(); ++phase)
      effective[phase] =
        MembraneStiffness(((is_elastic ? 1. : 0.) + factor) * membrane.stiffness[phase].D);
    old_stress.resize(index(n_triangles()));
    for (int t = 0; t < n_triangles(); ++t)
      old_stress[index(t)] =
        -factor * (membrane.stiffness[phase_of(t)].D *
                   biot_strain<3>(deformation_gradient<3>(membrane.rest[index(t)],
                                                          corners_of(start.positions, t))));
    packs.set_stiffness(effective);
    packs.set_initial_stress(old_stress);
  }

  double energy(const Vectors &positions) const override
  {
    if (!acts())
      return 0.;
    double sum = packs.energy(positions);
    if (membrane.cubic.empty())
      return sum;
    packs.strains(positions, tangent->strains);
    for (int t = 0; t < n_triangles(); ++t)
      sum += membrane.rest[index(t)].area *
             membrane.cubic[phase_of(t)].value(tangent->strains[index(t)]);
    return sum;
  }

  double stored_energy(const Vectors &positions) const override
  {
    if (!is_elastic)
      return 0.;
    return viscosity == 0. ? energy(positions) : membrane_energy<3>(membrane, positions);
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    if (!acts())
      return;
    for (int t = 0; t < n_triangles(); ++t)
    {
      const RestTriangle &rest       = membrane.rest[index(t)];
      const DeformationGradient<3> F = deformation_gradient<3>(rest, corners_of(positions, t));
      Eigen::Vector3d stress         = initial_stress(t);
      if (!membrane.cubic.empty())
        stress += membrane.cubic[phase_of(t)].gradient(biot_strain<3>(F));
      const Eigen::Matrix3d forces =
        rest.shape_gradients *
        (rest.area * energy_gradient<3>(F, effective[phase_of(t)].D, stress)).transpose();
      add_forces(t, forces, gradient);
    }
  }

  void add_derivatives(const Vectors &positions, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    if (!acts())
      return;
    const auto take = [&](const int t, const TriangleDerivatives<3> &local)
    { add(t, local, gradient, matrix); };
    if (membrane.cubic.empty())
      packs.derivatives(positions, kind, take);
    else
      tangent_at(positions).derivatives(positions, kind, take);
  }

  /// Forces that do the work of a cubic energy over a step are not known here.
  bool has_discrete_gradient() const override
  {
    return membrane.cubic.empty();
  }

  void add_discrete_gradient(const Vectors &old, const Vectors &positions, Vectors &gradient,
                             VertexMatrix &jacobian) const override
  {
    if (!acts())
      return;
    const double elastic = is_elastic ? 0.5 : 0.;
    for (int t = 0; t < n_triangles(); ++t)
    {
      const TriangleStep step =
        triangle_step(membrane.rest[index(t)], corners_of(old, t), corners_of(positions, t),
                      membrane.stiffness[phase_of(t)].D, {elastic - factor, elastic + factor});
      add_step(step, membrane.triangles.row(t), gradient, jacobian);
    }
  }

  std::size_t bytes() const override
  {
    return index(n_triangles()) *
             (3 * sizeof(int) + sizeof(RestTriangle) + sizeof(int) + sizeof(places[0]) +
              (viscosity > 0. ? sizeof(Eigen::Vector3d) : 0)) +
           packs.bytes() +
           (tangent ? tangent->packs.bytes() + index(n_triangles()) * (sizeof(MembraneStiffness) +
                                                                       2 * sizeof(Eigen::Vector3d))
                    : 0);
  }

private:
  /// Viscosity alone does nothing before the first step and in an equilibrium.
  bool acts() const
  {
    return is_elastic || factor > 0.;
  }
  /// With a cubic energy: the packs with the law of each triangle at its strain.
  const TrianglePacks &tangent_at(const Vectors &positions) const
  {
    packs.strains(positions, tangent->strains);
    tangent->stiffness.clear();
    tangent->stress.clear();
    for (int t = 0; t < n_triangles(); ++t)
    {
      const TangentLaw law = tangent_law(effective[phase_of(t)].D, membrane.cubic[phase_of(t)],
                                         tangent->strains[index(t)], initial_stress(t));
      tangent->stiffness.push_back(law.stiffness);
      tangent->stress.push_back(law.initial_stress);
    }
    tangent->packs.set_stiffness_of_triangles(tangent->stiffness);
    tangent->packs.set_initial_stress(tangent->stress);
    return tangent->packs;
  }
  Eigen::Vector3d initial_stress(const int t) const
  {
    if (viscosity == 0. || old_stress.empty())
      return Eigen::Vector3d::Zero();
    return old_stress[index(t)];
  }

  const double viscosity; ///< [s]
  const bool is_elastic;
  double factor = 0.;                       ///< β/h
  std::vector<MembraneStiffness> effective; ///< (1 + β/h) D, or β/h D
  std::vector<Eigen::Vector3d> old_stress;  ///< −β/h D e_n; empty without viscosity
  TrianglePacks packs;                      ///< with the effective stiffness and the old stress
  /// Work space of a cubic energy; none without.
  struct Tangent
  {
    explicit Tangent(const Membrane &membrane)
        : packs(membrane)
    {
    }
    TrianglePacks packs;
    std::vector<MembraneStiffness> stiffness;
    std::vector<Eigen::Vector3d> stress, strains;
  };
  std::unique_ptr<Tangent> tangent;
};
} // namespace

std::unique_ptr<Term> membrane_term(const meshes::ClothMesh &cloth,
                                    const std::vector<Eigen::Matrix3d> &stiffness,
                                    const double viscosity,
                                    const std::vector<meshes::CubicForm> &cubic)
{
  if (!(viscosity >= 0.) || !std::isfinite(viscosity))
    throw meshes::BadInput("viscosity of the membrane: found " + std::to_string(viscosity) +
                           " s; expected zero or a positive time");
  Membrane whole = membrane(cloth, stiffness);
  add_cubic_energy(whole, cubic);
  return std::make_unique<MembraneTerm>(std::move(whole), viscosity, true);
}

std::unique_ptr<Term> viscosity_term(const meshes::ClothMesh &cloth,
                                     const std::vector<Eigen::Matrix3d> &stiffness,
                                     const double viscosity)
{
  if (!(viscosity > 0.) || !std::isfinite(viscosity))
    throw meshes::BadInput("viscosity of the membrane: found " + std::to_string(viscosity) +
                           " s; expected a positive time");
  return std::make_unique<MembraneTerm>(membrane(cloth, stiffness), viscosity, false);
}

Eigen::VectorXd lumped_masses(const meshes::ClothMesh &cloth,
                              const std::vector<double> &areal_density)
{
  std::vector<std::string> faults;
  for (std::size_t phase = 0; phase < areal_density.size(); ++phase)
    if (!(areal_density[phase] > 0.) || !std::isfinite(areal_density[phase]))
      faults.push_back("areal density of phase " + std::to_string(phase) + ": found " +
                       std::to_string(areal_density[phase]) +
                       " kg/m^2; expected a positive number");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  Eigen::VectorXd masses      = Eigen::VectorXd::Zero(cloth.n_vertices());
  const Eigen::VectorXd areas = meshes::signed_areas(cloth.rest);
  for (int t = 0; t < cloth.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      masses(cloth.triangles(t, k)) +=
        areas(t) / 3. * areal_density.at(index(cloth.rest.material(t)));
  for (int v = 0; v < cloth.n_vertices(); ++v)
    if (!(masses(v) > 0.))
      faults.push_back("vertex " + std::to_string(v) +
                       ": belongs to no triangle and has no mass; remove it");
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return masses;
}
} // namespace homespun::shell
