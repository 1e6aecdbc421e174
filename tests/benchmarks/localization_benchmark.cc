// SPDX-License-Identifier: MIT
// Up-sampling at the paper's size, 20 x 20 cells of 18 x 20 x 2 triangles (144,761 vertices), one
// thread, beside a copy of the same output. Counters: bytes that must be written, flops, and the
// part of the copy's bandwidth that the writing alone reaches.
#include "localization/garment/placed_garment.h"
#include "tests/benchmarks/machine.h"
#include "tests/meshes/plain/shapes.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>

using namespace homespun;
using namespace homespun::localization;

namespace
{
/// A smooth periodic chi, zero at the lattice points.
meshes::HomogenizedCell smooth_cell(const int n1, const int n2)
{
  meshes::HomogenizedCell cell;
  cell.lattice = tests::square_lattice(0.01);
  cell.mesh    = tests::parallelogram(cell.lattice, n1, n2);
  cell.chi.resize(cell.mesh.n_vertices(), 6);
  for (int v = 0; v < cell.mesh.n_vertices(); ++v)
  {
    const Eigen::RowVector2d f = 2. * M_PI * cell.lattice.fractional(cell.mesh.vertices.row(v));
    for (int k = 0; k < 6; ++k)
      cell.chi(v, k) = 1e-4 * (std::sin(f(k % 2)) + (k - 2) * std::sin(f(0) + f(1)));
  }
  meshes::SecondOrder &second = cell.second_order["biot"];
  second.chi.resize(cell.mesh.n_vertices(), 12);
  second.chi << cell.chi, -cell.chi;
  cell.bending =
    meshes::CellBendingModes{Eigen::Matrix3d::Identity(), 1e-2 * cell.chi.leftCols<3>()};
  return cell;
}

meshes::FittedModes fitted_to(const meshes::HomogenizedCell &cell)
{
  meshes::FittedModes fitted;
  fitted.low   = Eigen::Vector3d::Constant(-0.2);
  fitted.high  = Eigen::Vector3d::Constant(0.2);
  fitted.knees = Eigen::Vector3d::Constant(0.3);
  fitted.modes = cell.second_order.at("biot").chi;
  fitted.coefficients.setConstant(0.1);
  return fitted;
}

/// Edges, clamped at the ends of axis 2.
/// @param reach of their modes, in cells
meshes::CellEdges edges_of(const meshes::HomogenizedCell &cell, const int reach)
{
  meshes::CellEdges edges;
  for (meshes::CellEdge &side : edges.sides)
  {
    side.n_cells = reach;
    side.clamped.setConstant(reach * cell.mesh.n_vertices(), 6, 1e-5);
    side.free = -side.clamped;
  }
  return edges;
}

/// What a frame writes of a surface that is curved.
enum class Written
{
  positions,
  positions_and_normals
};

/// Quads of the coarse mesh along a side of a cell, and whether edges have modes.
struct Around
{
  int quads_per_cell = 1;
  bool edges         = false;
  bool fitted        = false; ///< modes
  int reach          = 2;     ///< of the modes of edges, in cells
  Written written    = Written::positions;
};

template <int dim>
Positions<dim> bent(const meshes::TriangleMesh &coarse)
{
  Positions<dim> current(coarse.n_vertices(), dim);
  for (int v = 0; v < coarse.n_vertices(); ++v)
  {
    const double x = coarse.vertices(v, 0), y = coarse.vertices(v, 1);
    current(v, 0) = 1.05 * x + 0.1 * y * y;
    current(v, 1) = 0.98 * y + 0.2 * x * y;
    if constexpr (dim == 3)
      current(v, 2) = 0.02 * std::sin(20. * x) * std::cos(30. * y);
  }
  return current;
}

/// Times the frames of an up-sampler, with what they write beside a copy of as much.
/// @return bytes that a frame writes
template <int dim, typename Scalar>
double run_frames(benchmark::State &state, const Upsampler<dim, Scalar> &upsampler,
                  const Positions<dim> &current, const Written written = Written::positions)
{
  typename Upsampler<dim, Scalar>::Fine fine, normals;
  const bool has_normals = written == Written::positions_and_normals;
  const double n = upsampler.n_fine(), bytes = (has_normals ? 2 : 1) * n * dim * sizeof(Scalar);
  const double copied = benchmarks::copy_bandwidth(static_cast<std::size_t>(bytes));
  const double begin  = benchmarks::seconds();
  for (auto _ : state)
  {
    if (has_normals)
      upsampler.upsample(current, fine, normals);
    else
      upsampler.upsample(current, fine);
    benchmark::DoNotOptimize(fine.data());
    benchmark::DoNotOptimize(normals.data());
    benchmark::ClobberMemory();
  }
  const double of_one = (benchmarks::seconds() - begin) / static_cast<double>(state.iterations());
  state.counters["vertices"] = n;
  state.counters["written"]  = bytes;
  state.counters["tables"]   = static_cast<double>(upsampler.table_bytes());
  state.counters["of_copy"]  = bytes / copied / of_one;
  return bytes;
}

template <int dim, typename Scalar>
void upsample(benchmark::State &state, UpsamplerOptions options, const double flops_per_vertex,
              const Around &around = {})
{
  const meshes::HomogenizedCell cell = smooth_cell(18, 20);
  const meshes::Sheet sheet          = meshes::tile(cell.mesh, cell.lattice, 20, 20);
  const int r                        = around.quads_per_cell;
  const meshes::TriangleMesh coarse =
    meshes::coarse_sheet(sheet.origin, sheet.lattice.vectors / r, r * sheet.n1, r * sheet.n2);
  const meshes::CellEdges edges = edges_of(cell, around.reach);
  if (around.edges)
  {
    options.anchor     = Anchor::mean;
    options.edges      = &edges;
    options.edge_kinds = {EdgeKind::free, EdgeKind::free, EdgeKind::clamped, EdgeKind::clamped};
  }
  const meshes::FittedModes fitted = fitted_to(cell);
  if (around.fitted)
    options.fitted = &fitted;
  const Upsampler<dim, Scalar> upsampler(cell, coarse, sheet, options);
  const double bytes = run_frames(state, upsampler, bent<dim>(coarse), around.written);
  const double flops = sheet.mesh.n_vertices() * flops_per_vertex;
  const auto rate    = [&](const double amount)
  { return benchmark::Counter(amount, benchmark::Counter::kIsIterationInvariantRate); };
  state.counters["flops"]  = flops;
  state.counters["flop/s"] = rate(flops);
  state.counters["B/s"]    = rate(bytes);
}

/// The same sheet as a garment of one panel, turned by 20° against the cells: outlines cut, one
/// gather.
void upsample_garment(benchmark::State &state)
{
  const meshes::HomogenizedCell cell = smooth_cell(18, 20);
  const meshes::TriangleMesh rest =
    meshes::coarse_sheet({0., 0.}, 0.01 * Eigen::Matrix2d::Identity(), 20, 20);
  const Eigen::Matrix<double, 3, 2> placement = Eigen::Matrix<double, 3, 2>::Identity();
  const meshes::ClothMesh coarse =
    meshes::placed_sheet(rest, placement, Eigen::RowVector3d::Zero());
  meshes::FineClothOptions options;
  options.grains[0].angle       = M_PI / 9.;
  const meshes::FineCloth cloth = meshes::fine_cloth(cell.mesh, cell.lattice, coarse, options);
  const Upsampler<3, float> upsampler(placed_garment(cell, coarse, cloth));
  run_frames(state, upsampler, bent<3>(rest));
}
BENCHMARK(upsample_garment)->Name("upsample/garment/3d_float")->Unit(benchmark::kMicrosecond);

template <int dim, typename Scalar>
void copy(benchmark::State &state)
{
  const std::size_t bytes = 144761 * dim * sizeof(Scalar);
  std::vector<char> from(bytes, 1), to(bytes, 0);
  for (auto _ : state)
  {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::DoNotOptimize(to.data());
    benchmark::ClobberMemory();
  }
  state.counters["written"] = static_cast<double>(bytes);
  state.counters["B/s"] =
    benchmark::Counter(static_cast<double>(bytes), benchmark::Counter::kIsIterationInvariantRate);
}

UpsamplerOptions general()
{
  UpsamplerOptions options;
  options.path = Path::general;
  return options;
}

UpsamplerOptions without_modes()
{
  UpsamplerOptions options;
  options.microscopic = false;
  return options;
}

UpsamplerOptions general_without_modes()
{
  UpsamplerOptions options = without_modes();
  options.path             = Path::general;
  return options;
}

UpsamplerOptions piecewise()
{
  UpsamplerOptions options;
  options.blend = Blend::piecewise;
  return options;
}

UpsamplerOptions of_second_order()
{
  UpsamplerOptions options;
  options.second_order = "biot";
  return options;
}

UpsamplerOptions general_of_second_order()
{
  UpsamplerOptions options = of_second_order();
  options.path             = Path::general;
  return options;
}

UpsamplerOptions curved(UpsamplerOptions options = {})
{
  options.surface = Surface::curved;
  return options;
}

UpsamplerOptions in_plane()
{
  UpsamplerOptions options;
  options.strain = Strain::linear;
  return options;
}

template <int dim, typename Scalar>
void add_upsampling(const std::string &type)
{
  const std::string name = std::to_string(dim) + "d_" + type;
  const auto add         = [&](const std::string &variant, const UpsamplerOptions &options,
                       const double multiply_adds, const Around &around = {})
  {
    benchmark::RegisterBenchmark(
      ("upsample/" + variant + "/" + name).c_str(), [=](benchmark::State &state)
      { upsample<dim, Scalar>(state, options, 2. * multiply_adds, around); })
      ->Unit(benchmark::kMicrosecond);
  };
  benchmark::RegisterBenchmark(("copy/" + name).c_str(), copy<dim, Scalar>)
    ->Unit(benchmark::kMicrosecond);
  // Strain 6, fluctuation 6, position 2 dim; lift 4 dim and its product 2 dim.
  add("aligned", {}, 12 + 8 * dim);
  add("general", general(), 12 + 8 * dim);
  add("second_order", of_second_order(), 24 + 8 * dim);
  add("fitted", {}, 36 + 8 * dim, {1, false, true});
  add("edges", {}, 12 + 8 * dim, {1, true});
  // All that `full` adds to a coarse cloth of three-node triangles.
  add("second_order_and_edges", of_second_order(), 24 + 8 * dim, {1, true});
  // All that it takes on its own: six-node triangles are evaluated on quads of half a cell.
  add("full", of_second_order(), 24 + 8 * dim, {2, true});
  add("full_general", general_of_second_order(), 24 + 8 * dim, {2, true});
  // In the place of the quadratic modes 6 coefficients, 3 strains of free edges and their 18 modes;
  // edges of a weave reach as far as its sheet, and no two cells have the same modes.
  add("full_fitted", {}, 48 + 8 * dim, {2, true, true});
  add("full_fitted_far", {}, 48 + 8 * dim, {2, true, true, 20});
  add("piecewise", piecewise(), 6 + 4 * dim);
  add("without_modes", without_modes(), 2 * dim);
  add("general_without_modes", general_without_modes(), 2 * dim);
  if (dim == 3)
  {
    // Beside `aligned`: K and n 12, z 3, x 3; duals 12, slopes 6, the normal 6 and its length 6.
    const Around normals = {1, false, false, 2, Written::positions_and_normals};
    add("curved", curved(), 12 + 8 * dim + 18);
    add("curved_normals", curved(), 12 + 8 * dim + 48, normals);
    add("curved_normals_general", curved(general()), 12 + 8 * dim + 48, normals);
    add("curved_without_modes", curved(without_modes()), 2 * dim + 18);
  }
  if (dim == 2)
    add("linear_strain", in_plane(), 12 + 2 * dim + 1);
}

const bool added = []
{
  add_upsampling<2, float>("float");
  add_upsampling<3, float>("float");
  add_upsampling<2, double>("double");
  add_upsampling<3, double>("double");
  return true;
}();
} // namespace
