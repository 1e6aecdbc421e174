// SPDX-License-Identifier: MIT
#include "shell/terms/wind.h"

#include "meshes/plain/errors.h"
#include "shell/algebra/index.h"
#include "shell/terms/external_term.h"

#include <Eigen/Geometry>

#include <cmath>
#include <sstream>

namespace homespun::shell
{
namespace
{
// Twice the area over the squared sides below which a triangle counts as collapsed: round-off is
// 1e-16.
constexpr double collapsed = 1e-14;

/// Area times unit normal [m^2]; zero where the triangle is collapsed.
Eigen::Vector3d area_vector(const Vectors &x, const meshes::Triangles &triangles, const int t)
{
  const Eigen::Vector3d a     = (x.row(triangles(t, 1)) - x.row(triangles(t, 0))).transpose(),
                        b     = (x.row(triangles(t, 2)) - x.row(triangles(t, 0))).transpose(),
                        cross = a.cross(b);
  if (!(cross.norm() > collapsed * (a.squaredNorm() + b.squaredNorm())))
    return Eigen::Vector3d::Zero();
  return 0.5 * cross;
}

/// A load and a resistance per vertex, E = ½ (x − x_n)·R (x − x_n) − f·(x − x_n).
class VertexLoad : public ExternalTerm
{
public:
  explicit VertexLoad(const meshes::Triangles &triangles)
      : triangles(triangles)
  {
  }

  double energy(const Vectors &x) const override
  {
    double sum = 0.;
    for (Eigen::Index v = 0; v < force.rows(); ++v)
    {
      const Eigen::Vector3d way = (x.row(v) - begin.row(v)).transpose();
      sum -= force.row(v).dot(way);
      if (!resistance.empty())
        sum += 0.5 * way.dot(resistance[static_cast<std::size_t>(v)] * way);
    }
    return sum;
  }

  // Before the first step there is no air yet.
  void add_gradient(const Vectors &x, Vectors &gradient) const override
  {
    if (force.size() == 0)
      return;
    gradient -= force;
    for (std::size_t v = 0; v < resistance.size(); ++v)
    {
      const auto row = static_cast<Eigen::Index>(v);
      gradient.row(row) += (x.row(row) - begin.row(row)) * resistance[v];
    }
  }

  void add_derivatives(const Vectors &x, Hessian, Vectors &gradient,
                       BlockMatrix &matrix) const override
  {
    add_gradient(x, gradient);
    for (std::size_t v = 0; v < resistance.size(); ++v)
      matrix.add(places[v], resistance[v]);
  }

  std::size_t bytes() const override
  {
    return static_cast<std::size_t>(triangles.size()) * sizeof(int) +
           static_cast<std::size_t>(begin.size() + force.size()) * sizeof(double) +
           resistance.size() * sizeof(Eigen::Matrix3d) + places.size() * sizeof(BlockMatrix::Slot);
  }

protected:
  void clear(const StepStart &start, const bool resists)
  {
    begin = start.positions;
    force.setZero(begin.rows(), 3);
    resistance.assign(resists ? index(static_cast<int>(begin.rows())) : 0, Eigen::Matrix3d::Zero());
  }

  meshes::Triangles triangles;
  Vectors begin; ///< x_n
  Vectors force; ///< f [N]
  std::vector<Eigen::Matrix3d>
    resistance; ///< R, symmetric positive semi-definite [N/m]; none in an equilibrium
};

class Wind final : public VertexLoad
{
public:
  Wind(const meshes::ClothMesh &mesh, const Air &air)
      : VertexLoad(mesh.triangles)
      , air(air)
  {
    std::vector<std::string> faults;
    const auto expect = [&](const double value, const std::string &what)
    {
      std::ostringstream text;
      text << "air: " << what << " is " << value << "; expected a number not below 0";
      if (!(value >= 0. && std::isfinite(value)))
        faults.push_back(text.str());
    };
    expect(air.density, "density");
    expect(air.normal_drag, "normal drag");
    expect(air.tangential_drag, "tangential drag");
    if (!faults.empty())
      throw meshes::BadInput(faults);
  }

  std::string name() const override
  {
    return "wind";
  }

  void begin_step(const StepStart &start) override
  {
    const bool moving = std::isfinite(start.step);
    clear(start, moving);
    const double time = moving ? start.time + start.step : start.time;
    Vectors wind      = Vectors::Zero(begin.rows(), 3);
    if (air.velocity)
      for (Eigen::Index v = 0; v < wind.rows(); ++v)
      {
        wind.row(v) = air.velocity(begin.row(v).transpose(), time).transpose();
        if (!wind.row(v).allFinite())
          throw meshes::BadInput("air: the velocity at vertex " + std::to_string(v) +
                                 " is not finite at " + std::to_string(time) +
                                 " s; expected three numbers in m/s");
      }
    for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
    {
      const Eigen::Vector3d area_normal = area_vector(begin, triangles, t);
      const double area                 = area_normal.norm();
      if (area == 0.)
        continue;
      const Eigen::Vector3d n = area_normal / area;
      for (int k = 0; k < 3; ++k)
      {
        const int v             = triangles(t, k);
        const Eigen::Vector3d w = wind.row(v).transpose(),
                              u = start.velocities.row(v).transpose() - w;
        const double normal = n.dot(u), tangential = (u - normal * n).norm(),
                     scale        = 0.5 * air.density * area / 3.,
                     c_normal     = scale * air.normal_drag * std::abs(normal),
                     c_tangential = scale * air.tangential_drag * tangential;
        const Eigen::Matrix3d B   = (c_normal - c_tangential) * n * n.transpose() +
                                  c_tangential * Eigen::Matrix3d::Identity();
        force.row(v) += (B * w).transpose();
        if (moving)
          resistance[index(v)] += B / start.step;
      }
    }
  }

private:
  Air air;
};

class Pressure final : public VertexLoad
{
public:
  Pressure(const meshes::ClothMesh &mesh, std::function<double(double)> pressure)
      : VertexLoad(mesh.triangles)
      , pressure(std::move(pressure))
  {
  }

  std::string name() const override
  {
    return "pressure";
  }

  void begin_step(const StepStart &start) override
  {
    clear(start, false);
    const double p = pressure(std::isfinite(start.step) ? start.time + start.step : start.time);
    for (int t = 0; t < static_cast<int>(triangles.rows()); ++t)
    {
      const Eigen::RowVector3d third = p / 3. * area_vector(begin, triangles, t).transpose();
      for (int k = 0; k < 3; ++k)
        force.row(triangles(t, k)) += third;
    }
  }

private:
  std::function<double(double)> pressure;
};
} // namespace

std::unique_ptr<Term> wind_term(const meshes::ClothMesh &mesh, const Air &air)
{
  return std::make_unique<Wind>(mesh, air);
}

std::unique_ptr<Term> pressure_term(const meshes::ClothMesh &mesh,
                                    std::function<double(double time)> pressure)
{
  if (!pressure)
    throw meshes::BadInput("pressure: no function of time is given");
  return std::make_unique<Pressure>(mesh, std::move(pressure));
}
} // namespace homespun::shell
