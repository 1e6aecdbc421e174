// SPDX-License-Identifier: MIT
#include "shell/terms/curved_rest.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/terms/hinges.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

namespace homespun::shell
{
namespace
{
// Beyond this angle tan(theta0) says nothing that a mesh could mean.
constexpr double smallest_cosine = 0.17;

/// E = −Σ_hinges f (x1 − x0) × (x2 − x0) · (x3 − x0).
class CurvedRest final : public Term
{
public:
  CurvedRest(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness,
             const Vectors &curved)
  {
    const Hinges hinges = hinges_of(mesh, stiffness);
    if (curved.rows() != mesh.n_vertices() || !curved.allFinite())
      throw meshes::BadInput("curved rest shape: " + std::to_string(curved.rows()) +
                             " positions; expected " + std::to_string(mesh.n_vertices()) +
                             ", all finite");
    std::vector<std::string> faults;
    const auto rest_curvature = [&](const int t, const int corner)
    {
      const HalfHinge &hinge     = hinges.of[index(t)][index(corner)];
      const std::array<int, 4> v = vertices_of(mesh, t, corner, hinge);
      const Eigen::Vector3d edge = (curved.row(v[1]) - curved.row(v[0])).transpose(),
                            arm  = (curved.row(v[2]) - curved.row(v[0])).transpose(),
                            far  = (curved.row(v[3]) - curved.row(v[0])).transpose();
      const Eigen::Vector3d n = edge.cross(arm), m = far.cross(edge);
      // Unit normals n, m: cos = n·m, sin = n × m along the edge; theta > 0 where `far` is above t.
      const double cosine = n.dot(m), sine = -n.cross(m).dot(edge) / edge.norm();
      if (!(cosine > smallest_cosine * std::hypot(cosine, sine)))
      {
        if (faults.size() < 10 && v[0] < v[1])
          faults.push_back("curved rest shape: the hinge over edge (" + std::to_string(v[0]) +
                           ", " + std::to_string(v[1]) + ") is bent by " +
                           std::to_string(std::atan2(sine, cosine) * 180. / M_PI) +
                           " degrees; expected less than 80: refine the mesh there");
        return 0.;
      }
      const double area = hinges.area[index(t)], far_area = hinges.area[index(hinge.neighbour)];
      return sine / cosine * hinge.length / (area + far_area);
    };
    std::map<std::array<int, 2>, std::size_t> known; // edge: place in `hinge_vertices`
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const Patch &patch = hinges.patches[index(t)];
      Eigen::VectorXd k0(static_cast<Eigen::Index>(patch.corner.size()));
      for (Eigen::Index i = 0; i < k0.size(); ++i)
        k0(i) = rest_curvature(t, patch.corner[static_cast<std::size_t>(i)]);
      if (k0.size() == 0)
        continue;
      const Eigen::VectorXd moments = patch.stiffness * k0;
      for (Eigen::Index i = 0; i < k0.size(); ++i)
      {
        const int corner       = patch.corner[static_cast<std::size_t>(i)];
        const HalfHinge &hinge = hinges.of[index(t)][index(corner)];
        const auto v           = vertices_of(mesh, t, corner, hinge);
        const double area = hinges.area[index(t)], far_area = hinges.area[index(hinge.neighbour)],
                     length = hinge.length;
        // k = |e| sin(theta)/(A + A'), and six volumes are 4 A A' sin(theta)/|e|.
        const double per_volume = length * length / (4. * area * far_area * (area + far_area));
        const auto [place, is_new] =
          known.insert({{std::min(v[0], v[1]), std::max(v[0], v[1])}, hinge_vertices.size()});
        if (is_new)
        {
          hinge_vertices.push_back(v);
          factors.push_back(0.);
        }
        factors[place->second] += moments(i) * per_volume;
      }
    }
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

  std::string name() const override
  {
    return "curved rest shape";
  }

  void couple(std::vector<std::array<int, 2>> &pairs) const override
  {
    for (const auto &v : hinge_vertices)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a + 1; b < 4; ++b)
          if (v[a] != v[b])
            pairs.push_back({v[a], v[b]});
  }

  void attach(const BlockMatrix &matrix) override
  {
    places.clear();
    for (const auto &v : hinge_vertices)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = a; b < 4; ++b)
          places.push_back(matrix.slot(v[a], v[b]));
  }

  double energy(const Vectors &x) const override
  {
    double sum = 0.;
    for (std::size_t h = 0; h < factors.size(); ++h)
    {
      const Eigen::Matrix3d d = arms(x, h);
      sum -= factors[h] * d.col(0).cross(d.col(1)).dot(d.col(2));
    }
    return sum;
  }

  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    for (std::size_t h = 0; h < factors.size(); ++h)
    {
      const Eigen::Matrix3d d = arms(x, h);
      Eigen::Matrix3d slope;
      slope << d.col(1).cross(d.col(2)), d.col(2).cross(d.col(0)), d.col(0).cross(d.col(1));
      slope *= -factors[h];
      const auto &v = hinge_vertices[h];
      for (int a = 0; a < 3; ++a)
        gradient.row(v[index(a + 1)]) += slope.col(a).transpose();
      gradient.row(v[0]) -= slope.rowwise().sum().transpose();
    }
  }

  void add_derivatives(const Vectors &x, const Hessian kind, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(x, gradient);
    for (std::size_t h = 0; h < factors.size(); ++h)
    {
      const Eigen::Matrix3d d            = arms(x, h);
      Eigen::Matrix<double, 9, 9> second = Eigen::Matrix<double, 9, 9>::Zero();
      const auto cross                   = [&](const int a) { // v -> d_a × v
        Eigen::Matrix3d m;
        m << 0., -d(2, a), d(1, a), d(2, a), 0., -d(0, a), -d(1, a), d(0, a), 0.;
        return m;
      };
      // d_0 · (d_1 × d_2): the block (0,1) is −[d_2]x, and so on in a circle.
      second.block<3, 3>(0, 3) = -cross(2);
      second.block<3, 3>(3, 6) = -cross(0);
      second.block<3, 3>(6, 0) = -cross(1);
      second.block<3, 3>(3, 0) = cross(2);
      second.block<3, 3>(6, 3) = cross(0);
      second.block<3, 3>(0, 6) = cross(1);
      second *= -factors[h];
      if (kind == Hessian::projected)
      {
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> modes(second);
        second = modes.eigenvectors() * modes.eigenvalues().cwiseMax(0.).asDiagonal() *
                 modes.eigenvectors().transpose();
        second = (0.5 * (second + second.transpose())).eval();
      }
      // From arms to vertices: x0 moves all three arms backwards.
      Eigen::Matrix<double, 12, 12> all;
      all.bottomRightCorner<9, 9>() = second;
      for (int a = 0; a < 3; ++a)
        all.block<3, 3>(0, 3 * a + 3) =
          -(second.block<3, 3>(0, 3 * a) + second.block<3, 3>(3, 3 * a) +
            second.block<3, 3>(6, 3 * a));
      all.block<3, 3>(0, 0) =
        -(all.block<3, 3>(0, 3) + all.block<3, 3>(0, 6) + all.block<3, 3>(0, 9));
      const auto &v     = hinge_vertices[h];
      std::size_t place = 10 * h;
      for (int a = 0; a < 4; ++a)
        for (int b = a; b < 4; ++b, ++place)
        {
          Eigen::Matrix3d block = all.block<3, 3>(3 * a, 3 * b);
          if (a != b && v[index(a)] == v[index(b)]) // both blocks across the diagonal land on it
            block += Eigen::Matrix3d(block.transpose());
          matrix.add(places[place], block);
        }
    }
  }

  std::size_t bytes() const override
  {
    return factors.size() *
           (sizeof(factors[0]) + sizeof(hinge_vertices[0]) + 10 * sizeof(BlockMatrix::Slot));
  }

private:
  /// Columns: from vertex 0 of a hinge to the others.
  Eigen::Matrix3d arms(const Vectors &x, const std::size_t hinge) const
  {
    const auto &v = hinge_vertices[hinge];
    Eigen::Matrix3d d;
    for (int a = 0; a < 3; ++a)
      d.col(a) = (x.row(v[index(a + 1)]) - x.row(v[0])).transpose();
    return d;
  }

  std::vector<std::array<int, 4>> hinge_vertices; ///< edge, corner of its first triangle, opposite
  std::vector<double> factors;                    ///< per six volumes [N/m^2]
  std::vector<BlockMatrix::Slot> places;          ///< ten per hinge, upper triangle by rows
};
} // namespace

std::unique_ptr<Term> curved_rest_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const Vectors &curved_rest_positions)
{
  return std::make_unique<CurvedRest>(mesh, stiffness, curved_rest_positions);
}
} // namespace homespun::shell
