// SPDX-License-Identifier: MIT
#include "shell/membrane/membrane.h"

#include "meshes/plain/epsilon.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_area.h"
#include "shell/membrane/triangle_blocks.h"
#include "shell/membrane/yarn_energy.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <sstream>

namespace homespun::shell
{
namespace
{
std::vector<std::string> stiffness_faults(const std::vector<Eigen::Matrix3d> &stiffness)
{
  std::vector<std::string> faults;
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
  {
    const Eigen::Matrix3d &D = stiffness[phase];
    const std::string name   = "stiffness of phase " + std::to_string(phase);
    if (!D.allFinite())
    {
      faults.push_back(name + ": has an entry that is not finite; expected numbers in N/m");
      continue;
    }
    const double gap = (D - D.transpose()).cwiseAbs().maxCoeff(), size = D.cwiseAbs().maxCoeff();
    std::ostringstream text;
    if (gap > 1e-9 * size)
    {
      text << name << ": is not symmetric, entries differ by " << gap
           << " N/m where the largest is " << size << " N/m; expected C = C^T (Voigt 11, 22, 12)";
      faults.push_back(text.str());
    }
    else if (const Eigen::LLT<Eigen::Matrix3d> cholesky(D / (size > 0. ? size : 1.));
             cholesky.info() != Eigen::Success)
    {
      text << name << ": is not positive definite, [" << D.row(0) << "; " << D.row(1) << "; "
           << D.row(2) << "] N/m; expected positive energy for every strain";
      faults.push_back(text.str());
    }
  }
  return faults;
}

template <int dim>
Eigen::Matrix<double, 3, dim> corners_of(const Membrane &membrane, const Positions<dim> &positions,
                                         const int t)
{
  Eigen::Matrix<double, 3, dim> corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = positions.row(membrane.triangles(t, k));
  return corners;
}

std::size_t phase_of(const Membrane &membrane, const int t)
{
  return static_cast<std::size_t>(membrane.phase[static_cast<std::size_t>(t)]);
}

const MembraneStiffness &stiffness_of(const Membrane &membrane, const int t)
{
  return membrane.stiffness[phase_of(membrane, t)];
}

/// The axes of a triangle under the law of yarns, null where it is corotational.
const meshes::YarnAxes *yarns_of(const Membrane &membrane, const int t)
{
  if (membrane.yarns.empty() || !membrane.yarns[phase_of(membrane, t)].are_there)
    return nullptr;
  return &membrane.yarns[phase_of(membrane, t)];
}

/// The energy of a triangle but for the cubic part of the corotational law.
template <int dim>
double energy_of(const Membrane &membrane, const int t,
                 const Eigen::Matrix<double, 3, dim> &corners)
{
  const RestTriangle &rest = membrane.rest[static_cast<std::size_t>(t)];
  if (const meshes::YarnAxes *const yarns = yarns_of(membrane, t))
    return rest.area * yarn_energy_density<dim>(deformation_gradient<dim>(rest, corners), *yarns);
  return triangle_energy<dim>(rest, corners, stiffness_of(membrane, t).D);
}

/// The forces of the whole energy of a triangle, cubic part included.
template <int dim>
Eigen::Matrix<double, 3, dim> forces_of(const Membrane &membrane, const int t,
                                        const Eigen::Matrix<double, 3, dim> &corners)
{
  const RestTriangle &rest = membrane.rest[static_cast<std::size_t>(t)];
  const Eigen::Matrix3d &D = stiffness_of(membrane, t).D;
  if (const meshes::YarnAxes *const yarns = yarns_of(membrane, t))
    return yarn_triangle_gradient<dim>(rest, corners, *yarns);
  if (membrane.cubic.empty())
    return triangle_gradient<dim>(rest, corners, D);
  const DeformationGradient<dim> F = deformation_gradient<dim>(rest, corners);
  const Eigen::Vector3d stress =
    membrane.cubic[phase_of(membrane, t)].gradient(biot_strain<dim>(F));
  return rest.shape_gradients * (rest.area * energy_gradient<dim>(F, D, stress)).transpose();
}
} // namespace

Membrane membrane(const meshes::TriangleMesh &mesh, const std::vector<Eigen::Matrix3d> &stiffness)
{
  std::vector<std::string> faults = stiffness_faults(stiffness);
  const auto fault                = [&](const int t, const std::string &message)
  {
    if (faults.size() < 10)
      faults.push_back("triangle " + std::to_string(t) + ": " + message);
  };
  if (mesh.material.size() != mesh.n_triangles())
    throw meshes::BadInput("mesh: " + std::to_string(mesh.material.size()) + " phases for " +
                           std::to_string(mesh.n_triangles()) + " triangles; expected one each");
  if (const int v = first_not_finite<2>(mesh.vertices); v >= 0)
    throw meshes::BadInput("vertex " + std::to_string(v) + ": rest position is not finite");

  Membrane result;
  result.vertices  = mesh.vertices;
  result.triangles = mesh.triangles;
  result.stiffness.assign(stiffness.begin(), stiffness.end());
  result.rest.resize(static_cast<std::size_t>(mesh.n_triangles()));
  result.phase.assign(mesh.material.data(), mesh.material.data() + mesh.material.size());
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const auto corners = mesh.triangles.row(t);
    if (corners.minCoeff() < 0 || corners.maxCoeff() >= mesh.n_vertices())
    {
      std::ostringstream text;
      text << "has vertices " << corners << "; expected indices 0 ... " << mesh.n_vertices() - 1;
      fault(t, text.str());
      continue;
    }
    Eigen::Matrix<double, 3, 2> points;
    for (int k = 0; k < 3; ++k)
      points.row(k) = mesh.vertices.row(corners(k));
    result.rest[static_cast<std::size_t>(t)] = rest_triangle(points);
    const meshes::TriangleArea its           = meshes::triangle_area<2>(points);
    if (!its.is_there() || its.area < 0.)
    {
      std::ostringstream text;
      text << "has area " << its.area << " m^2 at rest (longest side " << its.longest_edge
           << " m); expected a counter-clockwise triangle of positive area: remove or turn it";
      fault(t, text.str());
    }
    if (mesh.material(t) < 0 || mesh.material(t) >= static_cast<int>(stiffness.size()))
      fault(t, "has phase " + std::to_string(mesh.material(t)) + "; expected 0 ... " +
                 std::to_string(static_cast<int>(stiffness.size()) - 1) +
                 ", one stiffness is given for each");
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  return result;
}

Membrane membrane(const meshes::ClothMesh &cloth, const std::vector<Eigen::Matrix3d> &stiffness)
{
  Membrane result = membrane(cloth.rest, stiffness);
  result.vertices.resize(0, 2);
  result.triangles = cloth.triangles;
  return result;
}

void add_cubic_energy(Membrane &membrane, const std::vector<meshes::CubicForm> &energies)
{
  if (energies.empty())
    return;
  if (energies.size() != membrane.stiffness.size())
    throw meshes::BadInput("cubic energy: found " + std::to_string(energies.size()) +
                           "; expected one for each of " +
                           std::to_string(membrane.stiffness.size()) + " phases");
  for (std::size_t phase = 0; phase < energies.size(); ++phase)
  {
    if (!energies[phase].derivatives.allFinite())
      throw meshes::BadInput("cubic energy of phase " + std::to_string(phase) +
                             ": is not finite; expected ten numbers in N/m");
    membrane.cubic.emplace_back(energies[phase], membrane.stiffness[phase].D);
  }
}

void take_yarn_law(Membrane &membrane)
{
  std::vector<meshes::YarnAxes> yarns;
  for (const MembraneStiffness &stiffness : membrane.stiffness)
    yarns.push_back(meshes::yarn_axes(stiffness.D));
  if (std::none_of(yarns.begin(), yarns.end(),
                   [](const meshes::YarnAxes &each) { return each.are_there; }))
    return;
  if (!membrane.cubic.empty())
    throw meshes::BadInput(
      "membrane: found a cubic energy beside the law of yarns; expected one of "
      "the two");
  membrane.yarns = std::move(yarns);
}

template <int dim>
double membrane_energy(const Membrane &membrane, const Positions<dim> &positions)
{
  double energy = 0.;
  if (!membrane.cubic.empty())
    for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
    {
      const RestTriangle &rest = membrane.rest[static_cast<std::size_t>(t)];
      energy +=
        rest.area * membrane.cubic[phase_of(membrane, t)].value(biot_strain<dim>(
                      deformation_gradient<dim>(rest, corners_of<dim>(membrane, positions, t))));
    }
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
    energy += energy_of<dim>(membrane, t, corners_of<dim>(membrane, positions, t));
  return energy;
}

template <int dim>
MembraneGradient<dim> membrane_gradient(const Membrane &membrane, const Positions<dim> &positions)
{
  MembraneGradient<dim> result;
  result.gradient.setZero(positions.rows(), dim);
  result.magnitude.setZero(positions.rows());
  result.round_off.setZero(positions.rows());
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
  {
    const RestTriangle &rest                     = membrane.rest[static_cast<std::size_t>(t)];
    const auto corners                           = corners_of<dim>(membrane, positions, t);
    const Eigen::Matrix3d &D                     = stiffness_of(membrane, t).D;
    const Eigen::Matrix<double, 3, dim> gradient = forces_of<dim>(membrane, t, corners);
    const Eigen::Vector3d hats                   = rest.shape_gradients.rowwise().norm();
    const Eigen::Vector3d sizes                  = corners.rowwise().norm();
    // One rounding of the positions changes F by this, and the forces by the stiffness times it.
    const double rounding =
      meshes::epsilon * (1. + hats.dot(sizes)) * rest.area * D.diagonal().maxCoeff();
    for (int k = 0; k < 3; ++k)
    {
      const int v = membrane.triangles(t, k);
      result.gradient.row(v) += gradient.row(k);
      result.magnitude(v) += gradient.row(k).norm();
      result.round_off(v) += rounding * hats(k);
      result.energy_round_off +=
        meshes::epsilon * gradient.row(k).norm() * (sizes(k) + 1. / hats(k));
    }
  }
  return result;
}

Positions<2> linear_membrane_gradient(const Membrane &membrane, const Positions<2> &displacement)
{
  Positions<2> gradient = Positions<2>::Zero(displacement.rows(), 2);
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
  {
    const RestTriangle &rest       = membrane.rest[static_cast<std::size_t>(t)];
    const DeformationGradient<2> G = // of the displacement
      deformation_gradient<2>(rest, corners_of<2>(membrane, displacement, t));
    const Eigen::Vector3d stress =
      rest.area *
      (stiffness_of(membrane, t).D * Eigen::Vector3d(G(0, 0), G(1, 1), G(0, 1) + G(1, 0)));
    Eigen::Matrix2d tensor;
    tensor << stress(0), stress(2), stress(2), stress(1);
    const Eigen::Matrix<double, 3, 2> forces = rest.shape_gradients * tensor;
    for (int k = 0; k < 3; ++k)
      gradient.row(membrane.triangles(t, k)) += forces.row(k);
  }
  return gradient;
}

template <int dim>
TriangleDerivatives<dim> membrane_triangle_derivatives(const Membrane &membrane, const int t,
                                                       const Eigen::Matrix<double, 3, dim> &corners,
                                                       const Hessian kind)
{
  const RestTriangle &rest            = membrane.rest[static_cast<std::size_t>(t)];
  const meshes::YarnAxes *const yarns = yarns_of(membrane, t);
  if (yarns == nullptr)
    return triangle_derivatives<dim>(rest, corners, stiffness_of(membrane, t), kind);
  return yarn_triangle_derivatives<dim>(rest, corners, *yarns, kind);
}

template <int dim>
Eigen::Matrix<double, 3 * dim, 3 * dim> membrane_hessian(const Membrane &membrane, const int t,
                                                         const Positions<dim> &positions,
                                                         const Hessian kind)
{
  const RestTriangle &rest = membrane.rest[static_cast<std::size_t>(t)];
  const auto corners       = corners_of<dim>(membrane, positions, t);
  if (membrane.cubic.empty())
    return hessian_of_blocks<dim>(
      membrane_triangle_derivatives<dim>(membrane, t, corners, kind).blocks);
  const TangentLaw law = tangent_law(
    stiffness_of(membrane, t).D, membrane.cubic[phase_of(membrane, t)],
    biot_strain<dim>(deformation_gradient<dim>(rest, corners)), Eigen::Vector3d::Zero());
  return triangle_hessian<dim>(rest, corners, law.stiffness, kind, law.initial_stress);
}

void add_membrane_hessian(const Membrane &membrane, const Positions<2> &positions,
                          const Hessian kind, PlaneMatrix &matrix)
{
  for (int t = 0; t < static_cast<int>(membrane.triangles.rows()); ++t)
    matrix.add(t, membrane_hessian<2>(membrane, t, positions, kind));
}

template <int dim>
int first_not_finite(const Positions<dim> &positions)
{
  for (int v = 0; v < static_cast<int>(positions.rows()); ++v)
    if (!positions.row(v).allFinite())
      return v;
  return -1;
}

#define HOMESPUN_INSTANTIATE(dim)                                                                  \
  template double membrane_energy<dim>(const Membrane &, const Positions<dim> &);                  \
  template TriangleDerivatives<dim> membrane_triangle_derivatives<dim>(                            \
    const Membrane &, int, const Eigen::Matrix<double, 3, dim> &, Hessian);                        \
  template MembraneGradient<dim> membrane_gradient<dim>(const Membrane &, const Positions<dim> &); \
  template Eigen::Matrix<double, 3 * dim, 3 * dim> membrane_hessian<dim>(                          \
    const Membrane &, int, const Positions<dim> &, Hessian);                                       \
  template int first_not_finite<dim>(const Positions<dim> &);
HOMESPUN_INSTANTIATE(2)
HOMESPUN_INSTANTIATE(3)
#undef HOMESPUN_INSTANTIATE
} // namespace homespun::shell
