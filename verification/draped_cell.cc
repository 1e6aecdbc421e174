// SPDX-License-Identifier: MIT
#include "verification/draped_cell.h"

#include "meshes/errors.h"
#include "meshes/obj_file.h"
#include "verification/cloth_reference.h"
#include "verification/on_root.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace homespun::verification
{
namespace
{
int nearest_to_middle(const meshes::SpacePoints &positions)
{
  const Eigen::RowVector3d middle = positions.colwise().mean();
  Eigen::Index nearest            = 0;
  (positions.rowwise() - middle).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

meshes::ClothMesh placed(const meshes::TriangleMesh &rest, const SheetPlacement &placement)
{
  meshes::ClothMesh cloth;
  cloth.rest      = rest;
  cloth.triangles = rest.triangles;
  cloth.positions.resize(rest.n_vertices(), 3);
  for (int v = 0; v < rest.n_vertices(); ++v)
    cloth.positions.row(v) = placement.start(rest.vertices.row(v));
  return cloth;
}
} // namespace

Scene scaled(const Scene &scene, const int n_cells)
{
  Scene result       = scene;
  const double ratio = static_cast<double>(n_cells) / scene.n1;
  for (HeldPlace &held : result.held)
    if (held.motion.kind == Motion::Kind::translate)
      held.motion.along *= ratio;
  result.n2 = std::max(1, static_cast<int>(std::lround(ratio * scene.n2)));
  result.n1 = n_cells;
  result.disturbance *= ratio;
  return result;
}

DrapedCell::DrapedCell(const Scene &given, const homogenization::UnitCell &cell,
                       const meshes::HomogenizedCell &homogenized)
    : scene(given)
    , cell(cell)
    , homogenized(homogenized)
    , side(std::sqrt(cell.lattice.area()))
{
  effective        = {{homogenized.stiffness}, {homogenized.areal_density}};
  phases.stiffness = cell.stiffness_of_phase();
  for (const homogenization::Phase &phase : cell.phases)
    phases.areal_density.push_back(phase.thickness * phase.density);
  meshes::TriangleMesh fine_rest;
  if (scene.is_sheet())
  {
    sheet     = meshes::tile(cell.mesh, cell.lattice, scene.n1, scene.n2);
    placement = placement_of(scene, sheet->origin, sheet->sides());
    meshes::TriangleMesh rest =
      meshes::coarse_sheet(sheet->origin, sheet->lattice.vectors, scene.n1, scene.n2);
    rest.material = Eigen::VectorXi::Zero(rest.n_triangles());
    coarse        = placed(rest, *placement);
    fine          = placed(sheet->mesh, *placement);
  }
  else
  {
    coarse = meshes::read_cloth(scene.mesh_file, scene.vt_unit);
    coarse.rest.material.setZero(coarse.n_triangles());
    garment = meshes::fine_cloth(cell.mesh, cell.lattice, coarse);
    // Vertices in space are numbered without gaps.
    space_vertex.assign(static_cast<std::size_t>(garment->n_vertices()), -1);
    int n = 0;
    for (int v = 0; v < garment->n_vertices(); ++v)
    {
      const int first = garment->same_in_space(v);
      space_vertex[static_cast<std::size_t>(v)] =
        first == v ? n++ : space_vertex[static_cast<std::size_t>(first)];
    }
    fine.rest = garment->rest;
    fine.positions.resize(n, 3);
    fine.triangles = garment->rest.triangles;
    for (int t = 0; t < fine.n_triangles(); ++t)
      for (int k = 0; k < 3; ++k)
        fine.triangles(t, k) = space_vertex[static_cast<std::size_t>(fine.triangles(t, k))];
    for (int v = 0; v < garment->n_vertices(); ++v)
    {
      Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
      for (int k = 0; k < 3; ++k)
        at += garment->coarse_weights(v, k) *
              coarse.positions.row(coarse.triangles(garment->coarse_triangle(v), k));
      fine.positions.row(space_vertex[static_cast<std::size_t>(v)]) = at;
    }
  }
  centre_vertex      = nearest_to_middle(coarse.positions);
  fine_centre_vertex = nearest_to_middle(at_fine_vertices(fine.positions));

  // A vertex belongs to the phase of most of its triangles.
  Eigen::MatrixXf share =
    Eigen::MatrixXf::Zero(n_fine(), static_cast<Eigen::Index>(cell.phases.size()));
  const meshes::TriangleMesh &rest = sheet ? sheet->mesh : garment->rest;
  for (int t = 0; t < rest.n_triangles(); ++t)
    for (int k = 0; k < 3; ++k)
      share(rest.triangles(t, k), rest.material(t)) += 1.f;
  meshes::VertexData material{"material", {}};
  material.values.resize(n_fine(), 1);
  for (int v = 0; v < n_fine(); ++v)
  {
    Eigen::Index phase = 0;
    share.row(v).maxCoeff(&phase);
    material.values(v, 0) = static_cast<float>(phase);
  }
  data = {material};
}

HeldMotion DrapedCell::coarse_motion() const
{
  if (sheet)
    return {scene, *placement, sheet->origin, sheet->sides()};
  return {scene, coarse};
}

HeldMotion DrapedCell::fine_motion() const
{
  if (sheet)
    return {scene, *placement, sheet->origin, sheet->sides()};
  return {scene, fine};
}

int DrapedCell::n_fine() const
{
  return sheet ? sheet->mesh.n_vertices() : garment->n_vertices();
}

meshes::Triangles DrapedCell::fine_triangles() const
{
  return sheet ? sheet->mesh.triangles : garment->sewn_triangles();
}

meshes::SpacePoints DrapedCell::at_fine_vertices(const meshes::SpacePoints &positions) const
{
  if (sheet)
    return positions;
  meshes::SpacePoints result(garment->n_vertices(), 3);
  for (int v = 0; v < garment->n_vertices(); ++v)
    result.row(v) = positions.row(space_vertex[static_cast<std::size_t>(v)]);
  return result;
}

namespace
{
class DealiiRun : public FineRun
{
public:
  DealiiRun(const DrapedCell &draped, const Law law, const unsigned int order,
            const MPI_Comm communicator)
      : motion(draped.fine_motion())
      , reference(draped.fine.rest, draped.phases.stiffness, draped.phases.areal_density,
                  options_of(law, order), communicator)
      , n(draped.fine.n_vertices())
  {
    ClothLoads loads;
    if (draped.scene.has("gravity"))
      loads.gravity = draped.scene.gravity;
    if (draped.scene.has("damping"))
      loads.mass_damping = draped.scene.damping_rate;
    reference.start(
      draped.placement->start,
      [this](const Eigen::RowVector2d &point, const double time) { return motion.at(point, time); },
      loads);
  }
  FineStep advance(const bool to_equilibrium, const double step, const double time) override
  {
    const ClothStep report =
      to_equilibrium ? reference.solve_equilibrium(time) : reference.step(step);
    return {report.reached ? "" : report.why.empty() ? "not reached" : report.why, report.seconds};
  }
  void resume(const meshes::ClothState &state) override
  {
    reference.resume(state.positions, state.velocities, state.time);
  }
  const meshes::SpacePoints &positions() const override
  {
    return reference.positions();
  }
  meshes::SpacePoints velocities() const override
  {
    return reference.velocities();
  }
  double time() const override
  {
    return reference.time();
  }
  double kinetic_energy() const override
  {
    return reference.kinetic_energy();
  }
  double stored_energy() const override
  {
    return reference.stored_energy();
  }
  int n_vertices() const override
  {
    return n;
  }
  unsigned long n_dofs() const override
  {
    return reference.n_dofs();
  }

private:
  static ClothReferenceOptions options_of(const Law law, const unsigned int order)
  {
    ClothReferenceOptions options;
    options.law   = law;
    options.order = order;
    // Lumped P2 shows second order only.
    options.consistent_mass = order == 2;
    return options;
  }
  const HeldMotion motion;
  ClothReference reference;
  const int n;
};

class ShellRun : public FineRun
{
public:
  ShellRun(const DrapedCell &draped, const MPI_Comm communicator)
      : communicator(communicator)
      , n(draped.fine.n_vertices())
      , here(draped.fine.positions)
  {
    on_root(communicator,
            [&]()
            {
              run = std::make_unique<SceneCloth>(draped.scene, draped.fine, draped.phases,
                                                 draped.fine_motion());
            });
  }
  FineStep advance(const bool to_equilibrium, const double step, const double time) override
  {
    FineStep result;
    int failed = 0;
    if (run)
    {
      const auto begin = std::chrono::steady_clock::now();
      try
      {
        if (to_equilibrium)
          run->solve_equilibrium(time);
        else
          run->step(step);
        here = run->cloth().positions();
      }
      catch (const meshes::NotConverged &failure)
      {
        result.why = failure.what();
        failed     = 1;
      }
      result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    MPI_Bcast(&failed, 1, MPI_INT, 0, communicator);
    MPI_Bcast(&result.seconds, 1, MPI_DOUBLE, 0, communicator);
    if (failed && result.why.empty())
      result.why = "the first rank failed";
    return result;
  }
  void resume(const meshes::ClothState &state) override
  {
    if (run)
      run->cloth().set_state(state.positions, state.velocities, state.time);
    here = state.positions;
  }
  const meshes::SpacePoints &positions() const override
  {
    return here;
  }
  meshes::SpacePoints velocities() const override
  {
    return run ? run->cloth().velocities() : meshes::SpacePoints::Zero(n, 3).eval();
  }
  double time() const override
  {
    return run ? run->cloth().time() : 0.;
  }
  double kinetic_energy() const override
  {
    return run ? run->cloth().kinetic_energy() : 0.;
  }
  double stored_energy() const override
  {
    return run ? run->cloth().stored_energy() : 0.;
  }
  int n_vertices() const override
  {
    return n;
  }
  unsigned long n_dofs() const override
  {
    return 3ul * static_cast<unsigned long>(n);
  }

private:
  const MPI_Comm communicator;
  const int n;
  meshes::SpacePoints here;
  std::unique_ptr<SceneCloth> run;
};
} // namespace

std::unique_ptr<FineRun> dealii_run(const DrapedCell &draped, const Law law,
                                    const unsigned int order, const MPI_Comm communicator)
{
  return std::make_unique<DealiiRun>(draped, law, order, communicator);
}

std::unique_ptr<FineRun> shell_run(const DrapedCell &draped, const MPI_Comm communicator)
{
  return std::make_unique<ShellRun>(draped, communicator);
}
} // namespace homespun::verification
