// SPDX-License-Identifier: MIT
#include "verification/method/sheet_reading.h"

#include "meshes/plain/errors.h"
#include "meshes/plain/triangle_kinematics.h"
#include "shell/algebra/plane_matrix.h"
#include "shell/membrane/corotational_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace homespun::verification
{
namespace
{
/// Strain and lift of a deformation gradient; the linear law takes sym(F − I) and no lift.
Eigen::Matrix<double, 1, 7> frame_of(const Law law, const Eigen::Matrix2d &F)
{
  Eigen::Matrix<double, 1, 7> frame;
  if (law == Law::linear)
  {
    frame << F(0, 0) - 1., F(1, 1) - 1., F(0, 1) + F(1, 0), 1., 0., 0., 1.;
    return frame;
  }
  const Eigen::Matrix2d R = meshes::nearest_rotation(F), U = R.transpose() * F;
  frame << U(0, 0) - 1., U(1, 1) - 1., U(0, 1) + U(1, 0), R(0, 0), R(0, 1), R(1, 0), R(1, 1);
  return frame;
}
} // namespace

meshes::Points localized(const LocalState &state, const meshes::HomogenizedCell &cell,
                         const meshes::Sheet &sheet, const NonlinearLocalization *excess)
{
  meshes::Points result = state.positions;
  for (Eigen::Index v = 0; v < result.rows(); ++v)
  {
    const int image              = sheet.cell_vertex(v);
    const Eigen::Vector3d strain = state.frames.row(v).head<3>().transpose();
    Eigen::RowVector2d w         = Eigen::RowVector2d::Zero();
    for (int a = 0; a < 3; ++a)
      w -= strain(a) * (cell.chi.row(image) - cell.chi.row(cell.anchor)).segment<2>(2 * a);
    if (excess != nullptr)
      w += excess->excess_fluctuation(image, strain);
    const auto &lift = state.frames.row(v).tail<4>();
    result(v, 0) += lift(0) * w(0) + lift(1) * w(1);
    result(v, 1) += lift(2) * w(0) + lift(3) * w(1);
  }
  return result;
}

SheetReading::SheetReading(const meshes::Sheet &sheet, const Quads quads)
    : sheet(sheet)
    , n1(quads.n1)
    , n2(quads.n2)
    , mesh(CoarseSpace(sheet, CoarseElement::three_nodes, quads).nodes.mesh)
{
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d fraction = sheet.fraction(sheet.mesh.vertices.row(v));
    const int i    = std::clamp(static_cast<int>(std::floor(fraction(0) * n1)), 0, n1 - 1);
    const int j    = std::clamp(static_cast<int>(std::floor(fraction(1) * n2)), 0, n2 - 1);
    const double s = fraction(0) * n1 - i, t = fraction(1) * n2 - j;
    triangle.push_back(2 * (j * n1 + i) + (t > s));
    weights.push_back(t > s ? Eigen::Vector3d(1. - t, s, t - s)
                            : Eigen::Vector3d(1. - s, s - t, t));
  }
}

shell::Positions<2> SheetReading::with_excess(const Law law, const Eigen::Matrix3d &stiffness,
                                              const Load &load, const NonlinearLocalization &excess,
                                              const shell::Positions<2> &start) const
{
  const shell::Membrane membrane = homogenized_membrane(mesh, stiffness, law);
  std::vector<bool> is_held(static_cast<std::size_t>(mesh.n_vertices()), false);
  for (const int v : held_vertices(load, sheet, mesh.vertices))
    is_held[static_cast<std::size_t>(v)] = true;
  shell::PlaneMatrix matrix(membrane.triangles, is_held);
  shell::add_membrane_hessian(membrane, start, shell::Hessian::exact, matrix);
  if (!matrix.factorize())
    throw meshes::NotConverged(
      "homogenized sheet: its Hessian is not positive definite at the start", {});
  shell::Positions<2> positions = start;
  std::vector<double> history;
  constexpr int most_steps = 60;
  for (int step = 0; step < most_steps; ++step)
  {
    shell::Positions<2> gradient         = shell::Positions<2>::Zero(mesh.n_vertices(), 2);
    const std::vector<Eigen::Matrix2d> F = gradients(positions);
    for (int t = 0; t < mesh.n_triangles(); ++t)
    {
      const auto index             = static_cast<std::size_t>(t);
      const Eigen::Vector3d strain = frame_of(Law::biot, F[index]).head<3>().transpose();
      const Eigen::Matrix2d stress =
        membrane.rest[index].area *
        shell::energy_gradient<2>(F[index], membrane.stiffness[0].D, excess.excess_stress(strain));
      const Eigen::Matrix<double, 3, 2> forces =
        membrane.rest[index].shape_gradients * stress.transpose();
      for (int k = 0; k < 3; ++k)
        gradient.row(mesh.triangles(t, k)) += forces.row(k);
    }
    const shell::Positions<2> move = matrix.solve(gradient);
    positions -= move;
    history.push_back(move.norm());
    // Relative to what the excess moves at all; where it moves nothing, to what the load does; and
    // no finer than rounded gradients allow, which are differences of positions over 1/n of the
    // sheet.
    const double round_off =
      4. * std::numeric_limits<double>::epsilon() * std::max(n1, n2) * mesh.vertices.norm();
    if (history.back() <= std::max({1e-6 * (positions - start).norm(),
                                    1e-12 * (start - mesh.vertices).norm(), round_off}))
      return positions;
  }
  throw meshes::NotConverged(
    "homogenized sheet: the excess over the linear theory is too large for Newton's method with "
    "the Hessian without it",
    history);
}

std::vector<Eigen::Matrix2d> SheetReading::gradients(const shell::Positions<2> &positions) const
{
  std::vector<Eigen::Matrix2d> result;
  result.reserve(static_cast<std::size_t>(mesh.n_triangles()));
  for (int t = 0; t < mesh.n_triangles(); ++t)
    result.push_back(meshes::deformation_gradient<2>(mesh, t, positions));
  return result;
}

SheetReading::FrameRows
SheetReading::blended(const Law law, const std::vector<Eigen::Matrix2d> &gradient_of_triangle) const
{
  FrameRows frames;
  frames.setZero(mesh.n_vertices(), 7);
  Eigen::VectorXd number = Eigen::VectorXd::Zero(mesh.n_vertices()); // all areas are equal
  for (int t = 0; t < mesh.n_triangles(); ++t)
  {
    const auto frame = frame_of(law, gradient_of_triangle[static_cast<std::size_t>(t)]);
    for (int k = 0; k < 3; ++k)
    {
      frames.row(mesh.triangles(t, k)) += frame;
      number(mesh.triangles(t, k)) += 1.;
    }
  }
  return number.cwiseInverse().asDiagonal() * frames;
}

template <typename Rows>
Rows SheetReading::sampled(const Rows &of_vertices) const
{
  Rows result(sheet.mesh.n_vertices(), of_vertices.cols());
  for (int v = 0; v < sheet.mesh.n_vertices(); ++v)
  {
    const auto index = static_cast<std::size_t>(v);
    result.row(v).setZero();
    for (int k = 0; k < 3; ++k)
      result.row(v) += weights[index](k) * of_vertices.row(mesh.triangles(triangle[index], k));
  }
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, 3>
SheetReading::strains(const Law law, const shell::Positions<2> &positions) const
{
  const std::vector<Eigen::Matrix2d> F = gradients(positions);
  Eigen::Matrix<double, Eigen::Dynamic, 3> result(mesh.n_triangles(), 3);
  for (int t = 0; t < mesh.n_triangles(); ++t)
    result.row(t) = frame_of(law, F[static_cast<std::size_t>(t)]).head<3>();
  return result;
}

LocalState SheetReading::at_fine_vertices(const Law law, const shell::Positions<2> &positions) const
{
  return {sampled<meshes::Points>(positions), sampled(blended(law, gradients(positions)))};
}

LocalState SheetReading::at_fine_vertices(const Law law, const shell::Positions<2> &positions,
                                          const SheetReading &coarser) const
{
  const int r                          = n1 / coarser.n1;
  const std::vector<Eigen::Matrix2d> F = gradients(positions);
  std::vector<Eigen::Matrix2d> mean(static_cast<std::size_t>(coarser.mesh.n_triangles()),
                                    Eigen::Matrix2d::Zero());
  // A quad on the diagonal of its coarse quad has one triangle on either side, others have both on
  // one.
  for (int j = 0; j < n2; ++j)
    for (int i = 0; i < n1; ++i)
      for (int upper = 0; upper < 2; ++upper)
      {
        const int a = i % r, b = j % r;
        const int is_above = b > a || (a == b && upper == 1);
        mean[static_cast<std::size_t>(2 * ((j / r) * coarser.n1 + i / r) + is_above)] +=
          F[static_cast<std::size_t>(2 * (j * n1 + i) + upper)] / (r * r);
      }
  return {sampled<meshes::Points>(positions), coarser.sampled(coarser.blended(law, mean))};
}
} // namespace homespun::verification
