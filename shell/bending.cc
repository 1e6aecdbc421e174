// SPDX-License-Identifier: MIT
#include "shell/bending.h"

#include "meshes/errors.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace homespun::shell
{
namespace
{
// Singular values of G are 1 on regular meshes and above 0.3 where vertices are displaced by a quarter
// of the mesh width; they vanish where six points lie on a conic.
constexpr double smallest_singular_value = 0.2;

// Beyond this angle tan(theta0) says nothing that a mesh could mean.
constexpr double smallest_cosine = 0.17;

std::size_t index(const int i)
{
  return static_cast<std::size_t>(i);
}

/// One hinge as one of its triangles sees it.
struct HalfHinge
{
  int opposite  = -1; ///< vertex of the neighbour, −1 at the outline
  int neighbour = -1, neighbour_corner = -1;
  Eigen::Vector4d weights;      ///< k = Σ weights x over corners k + 1, k + 2, k, opposite [1/m²]
  Eigen::RowVector3d curvature; ///< g: k = g·κ (Voigt, engineering twist) [-]
};

/// A triangle with the hinges that it has: rows of the quadratic form.
struct Patch
{
  std::vector<int> corner;   ///< of the triangle, opposite to the hinge
  Eigen::MatrixXd stiffness; ///< A (G D^-1 G^T)^-1 over these hinges [N m^3]
};

struct Hinges
{
  std::vector<std::array<HalfHinge, 3>> of; ///< (m) hinge opposite to each corner
  std::vector<Patch> patches;               ///< (m)
  std::vector<double> area;                 ///< (m) at rest [m^2]
};

Eigen::Matrix<double, 3, 2> rest_corners(const meshes::ClothMesh &mesh, const int t)
{
  Eigen::Matrix<double, 3, 2> corners;
  for (int k = 0; k < 3; ++k)
    corners.row(k) = mesh.rest.vertices.row(mesh.rest.triangles(t, k));
  return corners;
}

double signed_area(const Eigen::Matrix<double, 3, 2> &corners)
{
  const Eigen::RowVector2d a = corners.row(1) - corners.row(0), b = corners.row(2) - corners.row(0);
  return 0.5 * (a(0) * b(1) - a(1) * b(0));
}

std::vector<std::string> faults_of(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness)
{
  std::vector<std::string> faults;
  const auto fault = [&](const std::string &message)
  {
    if (faults.size() < 10)
      faults.push_back("bending: " + message);
  };
  for (std::size_t phase = 0; phase < stiffness.size(); ++phase)
  {
    const PlateStiffness &D = stiffness[phase];
    if (!(D.matrix().allFinite() && D.D11 > 0. && D.D22 > 0. && D.D66 > 0. &&
          D.D12 * D.D12 < D.D11 * D.D22))
    {
      std::ostringstream text;
      text << "stiffness of phase " << phase << " is D11 = " << D.D11 << ", D22 = " << D.D22
           << ", D12 = " << D.D12 << ", D66 = " << D.D66
           << " N m; expected D11, D22, D66 > 0 and D12^2 < D11 D22";
      fault(text.str());
    }
  }
  if (mesh.rest.n_triangles() != mesh.n_triangles() ||
      mesh.rest.material.size() != mesh.n_triangles())
  {
    fault(std::to_string(mesh.n_triangles()) + " triangles in space, " +
          std::to_string(mesh.rest.n_triangles()) + " at rest, " +
          std::to_string(mesh.rest.material.size()) + " phases; expected one each");
    return faults;
  }
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const std::string name = "triangle " + std::to_string(t);
    const auto space = mesh.triangles.row(t), rest = mesh.rest.triangles.row(t);
    if (space.minCoeff() < 0 || space.maxCoeff() >= mesh.n_vertices() || rest.minCoeff() < 0 ||
        rest.maxCoeff() >= mesh.rest.n_vertices())
    {
      fault(name + " has a vertex out of range; expected 0 ... " +
            std::to_string(mesh.n_vertices() - 1) + " in space and 0 ... " +
            std::to_string(mesh.rest.n_vertices() - 1) + " at rest");
      continue;
    }
    const auto corners   = rest_corners(mesh, t);
    const double longest = std::max({(corners.row(1) - corners.row(0)).squaredNorm(),
                                     (corners.row(2) - corners.row(1)).squaredNorm(),
                                     (corners.row(0) - corners.row(2)).squaredNorm()});
    if (!(signed_area(corners) > 1e-14 * longest))
    {
      std::ostringstream text;
      text
        << name << " has area " << signed_area(corners)
        << " m^2 at rest; expected a counter-clockwise triangle of positive area: remove or turn it";
      fault(text.str());
    }
    if (mesh.rest.material(t) < 0 || mesh.rest.material(t) >= static_cast<int>(stiffness.size()))
      fault(name + " has phase " + std::to_string(mesh.rest.material(t)) + "; expected 0 ... " +
            std::to_string(static_cast<int>(stiffness.size()) - 1) +
            ", one stiffness is given for each");
  }
  return faults;
}

/// Which triangles share an edge in space.
void find_neighbours(const meshes::ClothMesh &mesh, Hinges &hinges)
{
  std::vector<std::string> faults;
  std::map<std::array<int, 2>, std::array<int, 2>>
    sides; // directed edge: triangle, corner opposite
  const auto name = [](const int a, const int b)
  { return "bending: edge (" + std::to_string(a) + ", " + std::to_string(b) + ") "; };
  for (int t = 0; t < mesh.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
    {
      const int a = mesh.triangles(t, (k + 1) % 3), b = mesh.triangles(t, (k + 2) % 3);
      const auto [other, is_new] = sides.insert({{a, b}, {t, k}});
      if (!is_new && faults.size() < 10)
        faults.push_back(
          name(a, b) + "is traversed the same way by triangles " +
          std::to_string(other->second[0]) + " and " + std::to_string(t) +
          "; expected two triangles that traverse it in opposite ways: turn a panel, or "
          "sew two panels only");
    }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  for (const auto &[edge, side] : sides)
    if (const auto other = sides.find({edge[1], edge[0]}); other != sides.end())
    {
      HalfHinge &hinge       = hinges.of[index(side[0])][index(side[1])];
      hinge.neighbour        = other->second[0];
      hinge.neighbour_corner = other->second[1];
      hinge.opposite         = mesh.triangles(hinge.neighbour, hinge.neighbour_corner);
    }
}

/// Weights and g of a hinge, its neighbour unfolded into the rest plane of triangle t.
void measure(const meshes::ClothMesh &mesh, const Hinges &hinges, const int t, const int corner,
             HalfHinge &hinge)
{
  const auto own = rest_corners(mesh, t), far = rest_corners(mesh, hinge.neighbour);
  const int k = corner, l = hinge.neighbour_corner;
  const Eigen::RowVector2d first = own.row((k + 1) % 3), edge = own.row((k + 2) % 3) - first,
                           far_edge = far.row((l + 1) % 3) - far.row((l + 2) % 3),
                           far_arm  = far.row(l) - far.row((l + 2) % 3);
  const double length = edge.norm(), far_length = far_edge.norm(), area = hinges.area[index(t)],
               far_area          = hinges.area[index(hinge.neighbour)];
  const Eigen::RowVector2d along = edge / length, outward(along(1), -along(0));
  // Along the edge as a part of it, so that sides of a seam may differ in length (easing).
  const double part     = far_arm.dot(far_edge) / (far_length * far_length);
  const double own_part = (own.row(k) - first).dot(along) / length;
  const double height = 2. * area / length, far_height = 2. * far_area / far_length;
  // Slopes out of t on both sides, (x at the opposite corner − x at its foot)/height; k is their
  // difference over the mean height: 2/(h + h') = |e|/(A + A').
  const double scale = 2. / (height + far_height);
  hinge.weights << -(1. - part) / far_height - (1. - own_part) / height,
    -part / far_height - own_part / height, 1. / height, 1. / far_height;
  hinge.weights *= scale;
  Eigen::Matrix<double, 4, 2> points;
  points.row(0) = Eigen::RowVector2d::Zero();
  points.row(1) = edge;
  points.row(2) = own.row(k) - first;
  points.row(3) = part * edge + far_height * outward;
  hinge.curvature.setZero();
  for (int p = 0; p < 4; ++p)
  {
    const double y1 = points(p, 0), y2 = points(p, 1);
    hinge.curvature += 0.5 * hinge.weights(p) * Eigen::RowVector3d(y1 * y1, y2 * y2, y1 * y2);
  }
}

Hinges hinges_of(const meshes::ClothMesh &mesh, const std::vector<PlateStiffness> &stiffness)
{
  if (const auto faults = faults_of(mesh, stiffness); !faults.empty())
    throw meshes::BadInput(faults);
  Hinges hinges;
  hinges.of.resize(index(mesh.n_triangles()));
  hinges.patches.resize(hinges.of.size());
  find_neighbours(mesh, hinges);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    hinges.area.push_back(signed_area(rest_corners(mesh, t)));
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    Patch &patch = hinges.patches[index(t)];
    Eigen::Matrix<double, Eigen::Dynamic, 3> G(3, 3);
    for (int k = 0; k < 3; ++k)
      if (HalfHinge &hinge = hinges.of[index(t)][index(k)]; hinge.opposite >= 0)
      {
        measure(mesh, hinges, t, k, hinge);
        G.row(static_cast<Eigen::Index>(patch.corner.size())) = hinge.curvature;
        patch.corner.push_back(k);
      }
    if (patch.corner.empty())
      continue;
    G.conservativeResize(static_cast<Eigen::Index>(patch.corner.size()), 3);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(G, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Eigen::MatrixXd tame =
      svd.matrixU() * svd.singularValues().cwiseMax(smallest_singular_value).asDiagonal() *
      svd.matrixV().transpose();
    const Eigen::Matrix3d D          = stiffness[index(mesh.rest.material(t))].matrix();
    const Eigen::MatrixXd compliance = tame * D.ldlt().solve(Eigen::MatrixXd(tame.transpose()));
    patch.stiffness                  = hinges.area[index(t)] * compliance.inverse();
    patch.stiffness = (0.5 * (patch.stiffness + patch.stiffness.transpose())).eval();
  }
  return hinges;
}

/// The four vertices of a hinge in the order of its weights.
std::array<int, 4> vertices_of(const meshes::ClothMesh &mesh, const int t, const int corner,
                               const HalfHinge &hinge)
{
  return {mesh.triangles(t, (corner + 1) % 3), mesh.triangles(t, (corner + 2) % 3),
          mesh.triangles(t, corner), hinge.opposite};
}

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
      places.push_back(matrix.place(pair[0], pair[1]));
    diagonal_places.clear();
    for (int v = 0; v < static_cast<int>(diagonal.size()); ++v)
      diagonal_places.push_back(matrix.place(v, v));
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

  std::size_t bytes() const override
  {
    return pairs.size() * (sizeof(pairs[0]) + sizeof(weights[0]) + sizeof(places[0])) +
           static_cast<std::size_t>(diagonal.size()) * (sizeof(double) + sizeof(places[0]));
  }

private:
  static void add_scalar(const BlockMatrix::Place &where, const double value, BlockMatrix &matrix)
  {
    if (where.block >= 0)
      matrix.blocks[index(where.block)].diagonal().array() += value;
  }

  std::vector<std::array<int, 2>> pairs; ///< first < second
  std::vector<double> weights;           ///< [N/m]
  Eigen::VectorXd diagonal;              ///< (n) [N/m]
  std::vector<BlockMatrix::Place> places, diagonal_places;
};

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
      return sine / cosine * rest_edge(mesh, t, corner) / (area + far_area);
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
                     length = rest_edge(mesh, t, corner);
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
          places.push_back(matrix.place(v[a], v[b]));
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
           (sizeof(factors[0]) + sizeof(hinge_vertices[0]) + 10 * sizeof(BlockMatrix::Place));
  }

private:
  static double rest_edge(const meshes::ClothMesh &mesh, const int t, const int corner)
  {
    const auto corners = rest_corners(mesh, t);
    return (corners.row((corner + 2) % 3) - corners.row((corner + 1) % 3)).norm();
  }

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
  std::vector<BlockMatrix::Place> places;         ///< ten per hinge, upper triangle by rows
};
} // namespace

PlateStiffness PlateStiffness::isotropic(const double D, const double nu)
{
  return {D, D, nu * D, 0.5 * (1. - nu) * D};
}

Eigen::Matrix3d PlateStiffness::matrix() const
{
  Eigen::Matrix3d D;
  D << D11, D12, 0., D12, D22, 0., 0., 0., D66;
  return D;
}

std::unique_ptr<Term> bending_term(const meshes::ClothMesh &mesh,
                                   const std::vector<PlateStiffness> &stiffness)
{
  return std::make_unique<Bending>(mesh, stiffness);
}

std::unique_ptr<Term> curved_rest_term(const meshes::ClothMesh &mesh,
                                       const std::vector<PlateStiffness> &stiffness,
                                       const Vectors &curved_rest_positions)
{
  return std::make_unique<CurvedRest>(mesh, stiffness, curved_rest_positions);
}
} // namespace homespun::shell
