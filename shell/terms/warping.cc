// SPDX-License-Identifier: MIT
#include "shell/terms/warping.h"

#include "meshes/plain/errors.h"
#include "shell/terms/triangle_term.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>

namespace homespun::shell
{
namespace
{
/// Stiffness of a triangle at rest in its plane, embedded in space: rows and columns of the third
/// component are zero.
Eigen::Matrix<double, 9, 9> flat_stiffness(const RestTriangle &rest, const Eigen::Matrix3d &D)
{
  Eigen::Matrix<double, 3, 9> strain = Eigen::Matrix<double, 3, 9>::Zero();
  for (int k = 0; k < 3; ++k)
  {
    strain(0, 3 * k)     = rest.shape_gradients(k, 0);
    strain(1, 3 * k + 1) = rest.shape_gradients(k, 1);
    strain(2, 3 * k)     = rest.shape_gradients(k, 1);
    strain(2, 3 * k + 1) = rest.shape_gradients(k, 0);
  }
  return rest.area * strain.transpose() * D * strain;
}

class NodalWarping final : public TriangleTerm
{
public:
  NodalWarping(const meshes::ClothMesh &cloth,
               const std::vector<Eigen::Matrix3d> &stiffness_of_phase,
               const Eigen::VectorXd &masses)
      : TriangleTerm(shell::membrane(cloth, stiffness_of_phase))
      , rest(cloth.rest)
      , masses(masses)
      , rotations(index(cloth.n_vertices()), Eigen::Matrix3d::Identity())
      , ring(index(cloth.n_vertices()))
  {
    for (int t = 0; t < n_triangles(); ++t)
      stiffness.push_back(
        flat_stiffness(membrane.rest[index(t)], membrane.stiffness[phase_of(t)].D));
    std::vector<std::string> faults;
    for (int t = 0; t < n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
      {
        if (rest.triangles(t, k) != membrane.triangles(t, k) && faults.empty())
          faults.push_back("nodal warping: triangle " + std::to_string(t) +
                           " lies at a seam, where a vertex has two rest positions; expected "
                           "another membrane, such as that of the law biot");
        for (int l = 0; l < 3; ++l)
          ring[index(membrane.triangles(t, k))].push_back(membrane.triangles(t, l));
      }
    if (!faults.empty())
      throw meshes::BadInput(faults);
    for (auto &of_vertex : ring)
    {
      std::sort(of_vertex.begin(), of_vertex.end());
      of_vertex.erase(std::unique(of_vertex.begin(), of_vertex.end()), of_vertex.end());
    }
  }

  std::string name() const override
  {
    return "nodal warping";
  }

  std::size_t bytes() const override
  {
    return index(n_triangles()) * (sizeof(stiffness[0]) + sizeof(places[0]) + sizeof(RestTriangle));
  }

  void begin_step(const StepStart &start) override
  {
    const std::vector<Eigen::Matrix3d> old = rotations;
    const Vectors normals                  = vertex_normals(start.positions);
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      Eigen::RowVector3d c = Eigen::RowVector3d::Zero(), C = c;
      double mass = 0.;
      for (const int j : ring[i])
      {
        c += masses(j) * start.positions.row(j);
        C.head<2>() += masses(j) * rest.vertices.row(j);
        mass += masses(j);
      }
      c /= mass;
      C /= mass;
      Eigen::Matrix3d moment = Eigen::Matrix3d::Zero(), at_rest = moment;
      for (const int j : ring[i])
      {
        Eigen::RowVector3d X = -C;
        X.head<2>() += rest.vertices.row(j);
        moment += masses(j) * (start.positions.row(j) - c).transpose() * X;
        at_rest += masses(j) * X.transpose() * X;
        // The ellipse of a vertex: as wide as a disc of its share of the area, whose mean square
        // radius is that of its ring over the ring's size.
        // The first time no rotations are known.
        const double share =
          is_first ? 0. : 0.25 * masses(j) * X.squaredNorm() / static_cast<double>(ring[i].size());
        const Eigen::Matrix3d disc = share * Eigen::Vector3d(1., 1., 0.).asDiagonal();
        moment += old[index(j)] * disc;
        at_rest += disc;
      }
      const double weight = 0.5 * at_rest.trace();
      moment += weight * normals.row(static_cast<Eigen::Index>(i)).transpose() *
                Eigen::RowVector3d::UnitZ();
      at_rest(2, 2) += weight;
      const Eigen::Matrix3d A = moment * at_rest.inverse();
      if (!A.allFinite())
        continue;
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
      const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0. ? -1. : 1.;
      rotations[i] =
        svd.matrixU() * Eigen::Vector3d(1., 1., sign).asDiagonal() * svd.matrixV().transpose();
    }
    is_first = false;
  }

  double energy(const Vectors &) const override
  {
    return 0.;
  }
  bool has_energy() const override
  {
    return false;
  }

  void add_gradient(const Vectors &positions, Vectors &gradient) const override
  {
    for (int t = 0; t < n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
      {
        const int i              = membrane.triangles(t, k);
        const Eigen::Matrix3d &R = rotations[index(i)];
        Eigen::Matrix<double, 9, 1> u;
        for (int l = 0; l < 3; ++l)
          u.segment<3>(3 * l) =
            R.transpose() *
              (positions.row(membrane.triangles(t, l)) - positions.row(i)).transpose() -
            (rest_corner(t, l) - rest_corner(t, k));
        gradient.row(i) += (R * (stiffness[index(t)].middleRows<3>(3 * k) * u)).transpose();
      }
  }

  void add_derivatives(const Vectors &positions, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(positions, gradient);
    for (int t = 0; t < n_triangles(); ++t)
      for (int k = 0, b = 0; k < 3; ++k)
        for (int l = k; l < 3; ++l, ++b)
          matrix.add(places[index(t)][index(b)],
                     rotations[index(membrane.triangles(t, k))] *
                       stiffness[index(t)].block<3, 3>(3 * k, 3 * l) *
                       rotations[index(membrane.triangles(t, l))].transpose());
  }

private:
  /// Rest position of corner k, in space.
  Eigen::Vector3d rest_corner(const int t, const int k) const
  {
    const int v = rest.triangles(t, k);
    return {rest.vertices(v, 0), rest.vertices(v, 1), 0.};
  }

  Vectors vertex_normals(const Vectors &positions) const
  {
    Vectors normals = Vectors::Zero(positions.rows(), 3);
    for (int t = 0; t < n_triangles(); ++t)
    {
      const Eigen::RowVector3d x0     = positions.row(membrane.triangles(t, 0)),
                               x1     = positions.row(membrane.triangles(t, 1)),
                               x2     = positions.row(membrane.triangles(t, 2));
      const Eigen::RowVector3d normal = (x1 - x0).cross(x2 - x0);
      for (int k = 0; k < 3; ++k)
        normals.row(membrane.triangles(t, k)) += normal;
    }
    return normals.rowwise().normalized();
  }

  const meshes::TriangleMesh rest;
  std::vector<Eigen::Matrix<double, 9, 9>> stiffness;
  const Eigen::VectorXd masses;
  std::vector<Eigen::Matrix3d> rotations;
  bool is_first = true;
  std::vector<std::vector<int>> ring; ///< vertices around each, itself included
};
} // namespace

std::unique_ptr<Term> nodal_warping_term(const meshes::ClothMesh &cloth,
                                         const std::vector<Eigen::Matrix3d> &stiffness,
                                         const Eigen::VectorXd &masses)
{
  return std::make_unique<NodalWarping>(cloth, stiffness, masses);
}
} // namespace homespun::shell
