// SPDX-License-Identifier: MIT
#include "localization/upsampler.h"

#include "meshes/cloth_faults.h"
#include "meshes/errors.h"
#include "meshes/point_location.h"
#include "meshes/seams.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace homespun::localization
{
namespace
{
/// A coarse mesh is the sheet's lattice if its vertices agree to this part of the cell size. Far below
/// image_tolerance: what agrees less well is up-sampled by the general path, right to all digits.
constexpr double aligned_tolerance = 1e-10;

bool is_lattice_of(const meshes::Sheet &sheet, const meshes::TriangleMesh &coarse)
{
  const meshes::TriangleMesh lattice =
    meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors, sheet.n1, sheet.n2);
  return coarse.n_vertices() == lattice.n_vertices() &&
         coarse.triangles.rows() == lattice.triangles.rows() &&
         coarse.triangles == lattice.triangles &&
         (coarse.vertices - lattice.vertices).cwiseAbs().maxCoeff() <=
           aligned_tolerance * std::sqrt(sheet.lattice.area());
}

std::vector<std::string> faults_between(const meshes::HomogenizedCell &cell,
                                        const meshes::Sheet &sheet)
{
  std::vector<std::string> faults;
  const int n = sheet.mesh.n_vertices();
  if (sheet.n1 < 1 || sheet.n2 < 1 || sheet.n_per_cell < 1 || sheet.n_below < 0 ||
      sheet.n_below > sheet.n_per_cell || n < sheet.n1 * sheet.n2 * sheet.n_per_cell)
    faults.push_back("fine sheet: its numbers of cells and of vertices per cell do not fit its " +
                     std::to_string(n) + " vertices; make it by meshes::tile()");
  if (sheet.cell_vertex.size() != n)
    faults.push_back("fine sheet: has " + std::to_string(sheet.cell_vertex.size()) +
                     " entries in cell_vertex; expected " + std::to_string(n) + ", one per vertex");
  else if (n > 0 && (sheet.cell_vertex.minCoeff() < 0 ||
                     sheet.cell_vertex.maxCoeff() >= cell.mesh.n_vertices()))
    faults.push_back("fine sheet: names cell vertex " +
                     std::to_string(sheet.cell_vertex.minCoeff() < 0
                                      ? sheet.cell_vertex.minCoeff()
                                      : sheet.cell_vertex.maxCoeff()) +
                     "; expected 0 ... " + std::to_string(cell.mesh.n_vertices() - 1) +
                     ": it was tiled from another cell");
  const double gap = (cell.lattice.vectors - sheet.lattice.vectors).cwiseAbs().maxCoeff();
  if (!(gap <= meshes::image_tolerance * std::sqrt(sheet.lattice.area())))
  {
    std::ostringstream text;
    text << "fine sheet: its lattice vectors differ from the cell's by " << gap
         << " m; expected the same cell in both";
    faults.push_back(text.str());
  }
  return faults;
}

std::vector<std::string> faults_between(const meshes::HomogenizedCell &cell,
                                        const meshes::ClothMesh &coarse,
                                        const meshes::FineCloth &fine,
                                        const UpsamplerOptions &options)
{
  std::vector<std::string> faults = meshes::cloth_faults(coarse, "coarse cloth");
  if (!(options.seam_fade >= 0.) || !(options.seam_fade <= meshes::seam_reach))
  {
    std::ostringstream text;
    text << "up-sampling: the fluctuation fades over " << options.seam_fade
         << " cell sides at seams; expected 0 to " << meshes::seam_reach;
    faults.push_back(text.str());
  }
  const double gap = (cell.lattice.vectors - fine.lattice.vectors).cwiseAbs().maxCoeff();
  if (!(gap <= meshes::image_tolerance * std::sqrt(fine.lattice.area())))
  {
    std::ostringstream text;
    text << "fine cloth: its lattice vectors differ from the cell's by " << gap
         << " m; expected the same cell in both";
    faults.push_back(text.str());
  }
  const auto n        = static_cast<Eigen::Index>(fine.n_vertices());
  const bool has_size = fine.panel.size() == n && fine.cell_vertex.size() == n &&
                        fine.cell_triangle.size() == n && fine.cell_weights.rows() == n &&
                        fine.coarse_triangle.size() == n && fine.coarse_weights.rows() == n &&
                        fine.seam_distance.size() == n;
  if (!has_size || n == 0)
    faults.push_back("fine cloth: its arrays do not all have one entry for each of its " +
                     std::to_string(n) + " vertices; make it by meshes::fine_cloth()");
  if (!faults.empty())
    return faults;

  for (int v = 0; v < n && faults.size() < 3; ++v)
  {
    const int image = fine.cell_vertex(v), inside = fine.cell_triangle(v),
              triangle = fine.coarse_triangle(v), panel = fine.panel(v);
    const std::string name = "fine cloth: vertex " + std::to_string(v) + " ";
    if (image >= cell.mesh.n_vertices() || inside >= cell.mesh.n_triangles() ||
        (image < 0 && inside < 0))
      faults.push_back(name + "names vertex " + std::to_string(image) + " and triangle " +
                       std::to_string(inside) + " of the cell, which has " +
                       std::to_string(cell.mesh.n_vertices()) + " and " +
                       std::to_string(cell.mesh.n_triangles()) +
                       "; expected one of them: it was tiled from another cell");
    else if (triangle < 0 || triangle >= coarse.n_triangles() || panel < 0 ||
             panel >= static_cast<int>(fine.grains.size()))
      faults.push_back(name + "lies in triangle " + std::to_string(triangle) + " of panel " +
                       std::to_string(panel) + "; expected one of " +
                       std::to_string(coarse.n_triangles()) +
                       " triangles: it was made from another coarse cloth");
    else
    {
      Eigen::RowVector2d point = Eigen::RowVector2d::Zero();
      for (int k = 0; k < 3; ++k)
        point +=
          fine.coarse_weights(v, k) * coarse.rest.vertices.row(coarse.rest.triangles(triangle, k));
      const double distance = (point - fine.rest.vertices.row(v)).norm();
      if (!(distance <= 1e-6 * std::sqrt(fine.lattice.area()) + 1e-14 * point.norm()))
      {
        std::ostringstream text;
        text << name << "lies " << distance << " m from its place in coarse triangle " << triangle
             << " at rest; expected none: it was made from another coarse cloth";
        faults.push_back(text.str());
      }
    }
  }
  return faults;
}

/// chi of a cell that is turned against the rest frame: w = Q w_cell(Q^T E Q).
Eigen::Matrix<double, 6, 6> turned_modes(const Eigen::Matrix2d &Q)
{
  Eigen::Matrix<double, 6, 6> map = Eigen::Matrix<double, 6, 6>::Zero(); // chi row times map
  for (int b = 0; b < 3; ++b)
  {
    Eigen::Matrix2d strain = Eigen::Matrix2d::Zero();
    if (b < 2)
      strain(b, b) = 1.;
    else
      strain(0, 1) = strain(1, 0) = 0.5;
    const Eigen::Matrix2d in_cell = Q.transpose() * strain * Q;
    const Eigen::Vector3d voigt(in_cell(0, 0), in_cell(1, 1), 2. * in_cell(0, 1));
    for (int a = 0; a < 3; ++a)
      map.block<2, 2>(2 * a, 2 * b) = voigt(a) * Q.transpose();
  }
  return map;
}

/// Grows from 0 at 0 to 1 at 1, with slope zero at both.
double smooth_step(const double s)
{
  const double t = std::clamp(s, 0., 1.);
  return t * t * (3. - 2. * t);
}
} // namespace

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::Table::append(const Eigen::Vector3d &barycentric,
                                           const Eigen::Matrix<double, 1, 6> &chi)
{
  if (size % lanes == 0)
  {
    weights.push_back({});
    modes.push_back({});
  }
  const int lane               = size++ % lanes;
  weights.back().corner1[lane] = static_cast<Scalar>(barycentric(1));
  weights.back().corner2[lane] = static_cast<Scalar>(barycentric(2));
  for (int k = 0; k < 6; ++k)
    modes.back().column[k][lane] = static_cast<Scalar>(-chi(k));
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::Table::pad()
{
  size = (size + lanes - 1) / lanes * lanes;
}

template <int dim, typename Scalar>
Upsampler<dim, Scalar>::Upsampler(const meshes::HomogenizedCell &cell,
                                  const meshes::TriangleMesh &coarse_rest,
                                  const meshes::Sheet &fine, const UpsamplerOptions &options)
    : frames(coarse_rest, options)
    , options(options)
{
  if (const auto faults = faults_between(cell, fine); !faults.empty())
    throw meshes::BadInput(faults);
  const meshes::CharacteristicDisplacements chi =
    options.microscopic
      ? anchored(cell, options.anchor)
      : meshes::CharacteristicDisplacements::Zero(cell.mesh.n_vertices(), 6).eval();
  n_total = fine.mesh.n_vertices();
  n_space = coarse_rest.n_vertices();
  aligned = options.path == Path::automatic && is_lattice_of(fine, coarse_rest);
  if (aligned)
  {
    n_cells = fine.n1 * fine.n2;
    n_block = fine.n_per_cell;
    n_below = fine.n_below;
    for (int v = 0; v < n_block; ++v)
    {
      // s along a1 and t along a2: below, corners (0,0) (1,0) (1,1); above, (0,0) (1,1) (0,1).
      const Eigen::RowVector2d f = fine.lattice.fractional(fine.mesh.vertices.row(v) - fine.origin);
      const double s = f(0), t = f(1);
      if (v == n_below)
        shared.pad();
      shared.append(v < n_below ? Eigen::Vector3d(1. - s, s - t, t)
                                : Eigen::Vector3d(1. - t, s, t - s),
                    chi.row(fine.cell_vertex(v)));
    }
    shared.pad();
  }
  place(chi, fine, n_cells * n_block);
  records.resize(static_cast<std::size_t>(coarse_rest.n_vertices()) * record_size);
}

template <int dim, typename Scalar>
Upsampler<dim, Scalar>::Upsampler(const meshes::HomogenizedCell &cell,
                                  const meshes::ClothMesh &coarse, const meshes::FineCloth &fine,
                                  const UpsamplerOptions &options)
    : frames(coarse.rest, options)
    , options(options)
{
  if (const auto faults = faults_between(cell, coarse, fine, options); !faults.empty())
    throw meshes::BadInput(faults);
  const meshes::CharacteristicDisplacements chi =
    options.microscopic
      ? anchored(cell, options.anchor)
      : meshes::CharacteristicDisplacements::Zero(cell.mesh.n_vertices(), 6).eval();
  n_total                     = fine.n_vertices();
  n_space                     = coarse.n_vertices();
  const Eigen::VectorXi space = meshes::space_of_rest(coarse);
  space_of_rest.assign(space.data(), space.data() + space.size());
  std::vector<Eigen::Matrix<double, 6, 6>> turned;
  for (const meshes::Grain &grain : fine.grains)
    turned.push_back(turned_modes(grain.rotation()));
  const double fade   = options.seam_fade * std::sqrt(cell.lattice.area());
  const auto modes_of = [&](const int v)
  {
    Eigen::Matrix<double, 1, 6> modes = Eigen::Matrix<double, 1, 6>::Zero();
    if (fine.cell_vertex(v) >= 0)
      modes = chi.row(fine.cell_vertex(v));
    else
      for (int k = 0; k < 3; ++k)
        modes += fine.cell_weights(v, k) * chi.row(cell.mesh.triangles(fine.cell_triangle(v), k));
    const auto panel = static_cast<std::size_t>(fine.panel(v));
    if (fine.grains[panel].angle != 0.)
      modes = (modes * turned[panel]).eval();
    const double distance = fine.seam_distance(v);
    if (distance < fade)
      modes *= smooth_step(distance / fade);
    return modes;
  };
  std::vector<std::vector<Member>> in_triangle(static_cast<std::size_t>(coarse.n_triangles()));
  for (int v = 0; v < n_total; ++v)
    in_triangle[static_cast<std::size_t>(fine.coarse_triangle(v))].push_back(
      {v, fine.coarse_weights.row(v).transpose()});
  tabulate(in_triangle, modes_of);
  at_rest_vertices.resize(coarse.rest.n_vertices(), dim);
  records.resize(static_cast<std::size_t>(coarse.rest.n_vertices()) * record_size);
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::place(const meshes::CharacteristicDisplacements &chi,
                                   const meshes::Sheet &fine, const int from)
{
  const meshes::PointLocation location(frames.rest());
  // Points on a coarse edge belong to the triangle at their upper right and below the diagonal, as in
  // the order of the sheet; without blending it matters.
  const Eigen::RowVector2d towards =
    1e-5 * Eigen::RowVector2d(2. / 3., 1. / 3.) * fine.lattice.vectors;
  std::vector<std::vector<Member>> in_triangle(
    static_cast<std::size_t>(frames.rest().n_triangles()));
  std::vector<std::string> faults;
  for (int v = from; v < n_total && faults.size() < 3; ++v)
  {
    const Eigen::RowVector2d point = fine.mesh.vertices.row(v);
    const meshes::Location found   = location.locate(point, towards);
    if (found.triangle >= 0)
    {
      in_triangle[static_cast<std::size_t>(found.triangle)].push_back({v, found.weights});
      continue;
    }
    std::ostringstream text;
    text << "fine vertex " << v << " at (" << point(0) << ", " << point(1)
         << ") m: lies in no coarse triangle; expected a coarse mesh that covers the whole sheet";
    faults.push_back(text.str());
  }
  if (!faults.empty())
    throw meshes::BadInput(faults);
  tabulate(in_triangle, [&](const int v) { return chi.row(fine.cell_vertex(v)); });
}

template <int dim, typename Scalar>
template <typename ModesOf>
void Upsampler<dim, Scalar>::tabulate(const std::vector<std::vector<Member>> &in_triangle,
                                      const ModesOf &modes_of)
{
  for (std::size_t t = 0; t < in_triangle.size(); ++t)
  {
    if (in_triangle[t].empty())
      continue;
    groups.push_back({static_cast<int>(t), own.size, static_cast<int>(in_triangle[t].size())});
    for (const Member &member : in_triangle[t])
    {
      own.append(member.weights, modes_of(member.vertex));
      target.push_back(member.vertex);
    }
    own.pad();
    target.resize(static_cast<std::size_t>(own.size), -1);
  }
  if (!options.microscopic)
    for (Table *table : {&shared, &own})
      table->modes = std::vector<Modes<Scalar>>();
}

template <int dim, typename Scalar>
bool Upsampler<dim, Scalar>::is_aligned() const
{
  return aligned;
}

template <int dim, typename Scalar>
int Upsampler<dim, Scalar>::n_fine() const
{
  return n_total;
}

template <int dim, typename Scalar>
int Upsampler<dim, Scalar>::n_coarse() const
{
  return n_space;
}

template <int dim, typename Scalar>
std::size_t Upsampler<dim, Scalar>::table_bytes() const
{
  std::size_t bytes = sizeof(int) * target.size();
  for (const Table *table : {&shared, &own})
    bytes +=
      sizeof(Weights<Scalar>) * table->weights.size() + sizeof(Modes<Scalar>) * table->modes.size();
  return bytes;
}

template <int dim, typename Scalar>
const Positions<dim> &Upsampler<dim, Scalar>::gathered(const Positions<dim> &coarse_current) const
{
  for (std::size_t v = 0; v < space_of_rest.size(); ++v)
    at_rest_vertices.row(static_cast<Eigen::Index>(v)) = coarse_current.row(space_of_rest[v]);
  return at_rest_vertices;
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::fill_records(const Positions<dim> &coarse_current) const
{
  const Eigen::Index n = coarse_current.rows();
  for (Eigen::Index v = 0; v < n; ++v)
    for (int i = 0; i < dim; ++i)
      records[static_cast<std::size_t>(v * record_size + i)] =
        static_cast<Scalar>(coarse_current(v, i));
  if (!options.microscopic)
    return;
  const auto &values = frames.values(coarse_current);
  if (options.blend == Blend::continuous)
    for (Eigen::Index v = 0; v < n; ++v)
      for (int c = 0; c < frames.n_components; ++c)
        records[static_cast<std::size_t>(v * record_size + dim + c)] =
          static_cast<Scalar>(values(v, c));
}

template <int dim, typename Scalar>
template <int terms>
void Upsampler<dim, Scalar>::evaluate(const Table &table, const int triangle, const int begin,
                                      const int count, Scalar *const out) const
{
  Corners<Scalar> corners;
  const auto record = [&](const int k)
  {
    return records.data() +
           static_cast<std::size_t>(frames.rest().triangles(triangle, k)) * record_size;
  };
  const Scalar *const r0 = record(0), *const r1 = record(1), *const r2 = record(2);
  for (int c = 0; c < record_size; ++c)
  {
    corners.at0[c] = r0[c];
    corners.to1[c] = r1[c] - r0[c];
    corners.to2[c] = r2[c] - r0[c];
  }
  if constexpr (terms == constant || terms == constant_plane)
    for (int c = 0; c < CoarseFrames<dim>::n_components; ++c)
      corners.at0[dim + c] = static_cast<Scalar>(frames.last_values()(triangle, c));
  const int block = begin / lanes;
  fine_positions<dim, terms, Scalar>(corners, table.weights.data() + block,
                                     terms == affine ? nullptr : table.modes.data() + block,
                                     (count + lanes - 1) / lanes, out);
}

template <int dim, typename Scalar>
template <int terms>
void Upsampler<dim, Scalar>::run(Scalar *const fine_current) const
{
  // A run is computed in whole blocks of lanes. What it writes too much lies in the run after it, which
  // is written later; at the end of the output it goes through a buffer.
  constexpr int chunk = 8 * lanes;
  Scalar buffer[chunk * dim];
  const int begin_above = (n_below + lanes - 1) / lanes * lanes;
  const auto block      = [&](const int triangle, const int begin, const int first, const int count)
  {
    if (first + count + lanes <= n_total)
      evaluate<terms>(shared, triangle, begin, count, fine_current + first * dim);
    else
      for (int done = 0; done < count; done += chunk)
      {
        const int part = std::min(chunk, count - done);
        evaluate<terms>(shared, triangle, begin + done, part, buffer);
        std::copy_n(buffer, part * dim, fine_current + (first + done) * dim);
      }
  };
  for (int cell = 0; cell < n_cells; ++cell)
  {
    block(2 * cell, 0, cell * n_block, n_below);
    block(2 * cell + 1, begin_above, cell * n_block + n_below, n_block - n_below);
  }
  for (const Group &group : groups)
    for (int done = 0; done < group.count; done += chunk)
    {
      const int part = std::min(chunk, group.count - done);
      evaluate<terms>(own, group.triangle, group.begin + done, part, buffer);
      const int *const to = target.data() + group.begin + done;
      for (int k = 0; k < part; ++k)
        for (int i = 0; i < dim; ++i)
          fine_current[to[k] * dim + i] = buffer[k * dim + i];
    }
}

template <int dim, typename Scalar>
void Upsampler<dim, Scalar>::upsample(const Positions<dim> &coarse_current,
                                      Fine &fine_current) const
{
  if (coarse_current.rows() != n_space)
    throw meshes::BadInput("coarse positions: have " + std::to_string(coarse_current.rows()) +
                           " rows; expected " + std::to_string(n_space) +
                           ", one per coarse vertex");
  if (!coarse_current.allFinite())
    for (Eigen::Index v = 0; v < coarse_current.rows(); ++v)
      if (!coarse_current.row(v).allFinite())
        throw meshes::BadInput(
          "coarse vertex " + std::to_string(v) +
          ": its position is not finite; the coarse solver should have refused it");
  fine_current.resize(n_total, dim);
  fill_records(space_of_rest.empty() ? coarse_current : gathered(coarse_current));
  const bool in_plane  = options.lift == Lift::identity || options.strain == Strain::linear;
  const bool is_smooth = options.blend == Blend::continuous;
  if (!options.microscopic)
    run<affine>(fine_current.data());
  else if (is_smooth && in_plane)
    run<blended_plane>(fine_current.data());
  else if (is_smooth && dim == 2 && options.lift == Lift::rotation)
    run<dim == 2 ? blended_rotation : blended>(fine_current.data());
  else if (is_smooth)
    run<blended>(fine_current.data());
  else if (in_plane)
    run<constant_plane>(fine_current.data());
  else
    run<constant>(fine_current.data());
}

template class Upsampler<2, float>;
template class Upsampler<2, double>;
template class Upsampler<3, float>;
template class Upsampler<3, double>;
} // namespace homespun::localization
