// SPDX-License-Identifier: MIT
#include "homogenization/fem/homogenize.h"

#include "homogenization/fem/cell_forces.h"
#include "homogenization/fem/elastic_solver.h"
#include "homogenization/fem/periodic_constraints.h"
#include "homogenization/fem/second_order.h"
#include "homogenization/fem/solution_pieces.h"
#include "meshes/plain/errors.h"
#include "meshes/plain/refine.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>
#include <deal.II/lac/full_matrix.h>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace homespun::homogenization
{
using namespace dealii;
using Vector = ElasticSolver::Vector;

namespace
{
constexpr int most_shapes = 12; ///< of a triangle: P2, two components
/// The strain-displacement matrix B (3,n) of a triangle at one quadrature point.
using StrainMatrix = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_shapes>;
using ElementMatrix =
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_shapes, most_shapes>;
using ThreeLoads = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, most_shapes, 3>;

StrainMatrix strain_displacement(const FEValues<2> &fe_values, const unsigned int q)
{
  const FEValuesExtractors::Vector displacement(0);
  StrainMatrix B(3, fe_values.dofs_per_cell);
  for (const unsigned int i : fe_values.dof_indices())
  {
    const SymmetricTensor<2, 2> strain = fe_values[displacement].symmetric_gradient(i, q);
    B.col(i) << strain[0][0], strain[1][1], 2. * strain[0][1];
  }
  return B;
}

constexpr unsigned int most_iterations = 2000; ///< of conjugate gradients

/// Of a positive definite matrix. Not by cofactors, whose determinant loses twice the digits of the
/// condition number.
Eigen::Matrix3d inverse_of(const Eigen::Matrix3d &matrix)
{
  return matrix.ldlt().solve(Eigen::Matrix3d::Identity());
}

/// The cell problems on one mesh.
class CellProblems
{
public:
  CellProblems(const UnitCell &cell, const HomogenizationOptions &options,
               const MPI_Comm communicator)
      : cell(cell)
      , options(options)
      , stiffness_of_phase(cell.stiffness_of_phase())
      , discretization(meshes::refined(cell.mesh, static_cast<int>(options.refine)), options.order,
                       communicator)
  {
  }

  Homogenization run()
  {
    constrain();
    solver = std::make_unique<ElasticSolver>(discretization, constraints);
    lap(result.seconds.setup);
    assemble();
    lap(result.seconds.assembly);
    precondition();
    lap(result.seconds.preconditioner);
    solve();
    lap(result.seconds.solve);
    evaluate();
    sample_at_vertices();
    if (!options.pieces.empty())
      write_pieces(options.pieces, discretization, solutions);
    lap(result.seconds.evaluation);
    for (const Law law : options.second_order)
      result.second_order[name_of(law)] = second_order(law);
    lap(result.seconds.second_order);
    return result;
  }

  meshes::Chi run_with(const CellForces &forces)
  {
    constrain();
    solver = std::make_unique<ElasticSolver>(discretization, constraints);
    assemble();
    for (int a = 0; a < 3; ++a)
    {
      const Vector further = forces.load_vector(a, discretization, constraints);
      loads[a] += further;
      load_sizes[a] = std::hypot(load_sizes[a], further.l2_norm());
    }
    precondition();
    solve();
    for (int a = 0; a < 3; ++a)
    {
      Vector owned = solver->owned_vector();
      for (const types::global_dof_index dof : discretization.locally_owned)
        owned(dof) = solutions[a](dof);
      owned.compress(VectorOperation::insert);
      forces.look(a, discretization, owned);
    }
    sample_at_vertices();
    return result.chi;
  }

private:
  void lap(double &seconds)
  {
    seconds = Utilities::MPI::max(timer.wall_time(), discretization.communicator);
    timer.restart();
  }

  void constrain()
  {
    result.anchor                   = meshes::anchor_vertex(cell.mesh, cell.lattice);
    const Eigen::RowVector2d anchor = cell.mesh.vertices.row(result.anchor);
    const std::vector<Node> nodes   = discretization.boundary_nodes();
    make_periodic_constraints(discretization, cell.lattice, anchor, nodes, constraints);
    result.audit =
      audit_periodic_constraints(discretization, cell.lattice, anchor, nodes, constraints);
    result.n_dofs = discretization.n_dofs();
  }

  void assemble()
  {
    for (int a = 0; a < 3; ++a)
    {
      loads[a]      = solver->owned_vector();
      load_sizes[a] = 0.;
    }
    FEValues<2> fe_values = discretization.fe_values(discretization.stiffness_quadrature);
    const unsigned int n  = fe_values.dofs_per_cell;
    FullMatrix<double> matrix(n, n);
    dealii::Vector<double> load(n);
    discretization.for_owned_cells(
      [&](const auto &cell, const std::vector<types::global_dof_index> &dofs)
      {
        fe_values.reinit(cell);
        const Eigen::Matrix3d &c     = stiffness_of_phase[cell->material_id()];
        ElementMatrix element_matrix = ElementMatrix::Zero(n, n);
        ThreeLoads element_loads     = ThreeLoads::Zero(n, 3);
        for (const unsigned int q : fe_values.quadrature_point_indices())
        {
          const StrainMatrix B         = strain_displacement(fe_values, q);
          const ThreeLoads stress_rows = fe_values.JxW(q) * B.transpose() * c;
          element_matrix.noalias() += stress_rows * B;
          element_loads += stress_rows; // B^T c e_a for the three unit strains
        }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            matrix(i, j) = element_matrix(i, j);
        constraints.distribute_local_to_global(matrix, dofs, solver->matrix);
        for (int a = 0; a < 3; ++a)
        {
          for (unsigned int i = 0; i < n; ++i)
            load(i) = element_loads(i, a);
          constraints.distribute_local_to_global(load, dofs, loads[a]);
          load_sizes[a] += element_loads.col(a).squaredNorm();
        }
      });
    solver->matrix.compress(VectorOperation::add);
    for (int a = 0; a < 3; ++a)
    {
      loads[a].compress(VectorOperation::add);
      load_sizes[a] = std::sqrt(Utilities::MPI::sum(load_sizes[a], discretization.communicator));
    }
  }

  /// Twice the energies of the unit strains if all triangles had the same stress [J].
  Eigen::Vector3d energies_at_equal_stress() const
  {
    const Eigen::VectorXd areas = meshes::signed_areas(cell.mesh);
    Eigen::Matrix3d compliance  = Eigen::Matrix3d::Zero();
    for (int t = 0; t < cell.mesh.n_triangles(); ++t)
      compliance +=
        areas(t) * inverse_of(stiffness_of_phase[static_cast<std::size_t>(cell.mesh.material(t))]);
    return std::pow(areas.sum(), 2) * inverse_of(compliance).diagonal();
  }

  /// The tolerance is relative to the element loads before they cancel: in a homogeneous cell what
  /// is left of them is round-off, and chi is exactly zero. These loads are those of the stiff
  /// phases; what is left of the energy of the error is held against the soft ones, with the mean
  /// of their compliance.
  void solve()
  {
    const Eigen::Vector3d softest = energies_at_equal_stress();
    const IndexSet ghosted        = constraints.get_local_lines();
    std::vector<Vector> owned(3, solver->owned_vector());
    std::vector<ElasticSolver::Target> targets;
    for (std::size_t a = 0; a < 3; ++a)
      targets.push_back(
        {options.tolerance * load_sizes[a],
         std::pow(1e2 * options.tolerance, 2) * softest(static_cast<Eigen::Index>(a))});
    const ElasticSolver::Solved solved = solver->solve_all(owned, loads, targets, most_iterations);
    std::copy(solved.iterations.begin(), solved.iterations.end(), result.iterations.begin());
    result.abandoned = solved.abandoned;
    if (!solved.abandoned.empty())
      result.solver = CellSolver::direct;
    for (std::size_t a = 0; a < 3; ++a)
    {
      constraints.distribute(owned[a]);
      solutions[a].reinit(discretization.locally_owned, ghosted, discretization.communicator);
      solutions[a] = owned[a];
    }
  }

  void precondition()
  {
    result.solver = options.solver != CellSolver::fastest ? options.solver
                    : solver->is_small()                  ? CellSolver::direct
                                                          : CellSolver::multigrid;
    if (result.solver == CellSolver::direct)
      solver->factorize();
    else
      solver->build_preconditioner();
  }

  void evaluate()
  {
    Eigen::Matrix3d energy = Eigen::Matrix3d::Zero(), flux = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d mean = Eigen::Matrix3d::Zero(), mean_compliance = Eigen::Matrix3d::Zero();
    std::vector<Eigen::Matrix3d> compliance_of_phase;
    for (const Eigen::Matrix3d &c : stiffness_of_phase)
      compliance_of_phase.push_back(inverse_of(c));
    result.strains.setZero(cell.mesh.n_triangles(), 9);
    FEValues<2> fe_values = discretization.fe_values(discretization.stiffness_quadrature);
    discretization.for_owned_cells(
      [&](const auto &element, const std::vector<types::global_dof_index> &dofs)
      {
        fe_values.reinit(element);
        const Eigen::Matrix3d &c = stiffness_of_phase[element->material_id()];
        const auto given_triangle =
          static_cast<Eigen::Index>(element->active_cell_index() >> 2 * options.refine);
        ThreeLoads chi(dofs.size(), 3);
        for (std::size_t a = 0; a < 3; ++a)
          for (std::size_t i = 0; i < dofs.size(); ++i)
            chi(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(a)) = solutions[a](dofs[i]);
        for (const unsigned int q : fe_values.quadrature_point_indices())
        {
          const double weight = fe_values.JxW(q);
          const Eigen::Matrix3d strain =
            Eigen::Matrix3d::Identity() - strain_displacement(fe_values, q) * chi;
          energy += weight * strain.transpose() * c * strain;
          flux += weight * c * strain;
          mean += weight * c;
          mean_compliance += weight * compliance_of_phase[element->material_id()];
          result.strains.row(given_triangle) +=
            weight * Eigen::Map<const Eigen::Matrix<double, 1, 9>>(strain.data());
        }
      });
    const auto averaged = [&](Eigen::Matrix3d matrix) -> Eigen::Matrix3d
    {
      MPI_Allreduce(MPI_IN_PLACE, matrix.data(), 9, MPI_DOUBLE, MPI_SUM,
                    discretization.communicator);
      return matrix / cell.lattice.area();
    };
    MPI_Allreduce(MPI_IN_PLACE, result.strains.data(), static_cast<int>(result.strains.size()),
                  MPI_DOUBLE, MPI_SUM, discretization.communicator);
    const Eigen::VectorXd areas = meshes::signed_areas(cell.mesh);
    result.strains.array().colwise() /= areas.array();
    const Eigen::Matrix3d unsymmetric = averaged(energy);
    result.stiffness                  = 0.5 * (unsymmetric + unsymmetric.transpose());
    result.stiffness_by_flux          = averaged(flux);
    result.voigt                      = averaged(mean);
    // With holes the mean compliance is infinite and the bound is zero.
    const double covered = areas.sum() / cell.lattice.area();
    result.reuss =
      covered < 1. - 1e-9 ? Eigen::Matrix3d::Zero() : inverse_of(averaged(mean_compliance));
  }

  void sample_at_vertices()
  {
    result.chi = at_vertices<3>(solutions);
  }

  /// Column 2 k + c: component c of field k at the vertices of the given mesh.
  template <int n_fields, typename Fields>
  Eigen::Matrix<double, Eigen::Dynamic, 2 * n_fields, Eigen::RowMajor>
  at_vertices(const Fields &fields) const
  {
    const auto dofs = discretization.vertex_dofs();
    const int n     = cell.mesh.n_vertices(); // refinement keeps these in front
    Eigen::Matrix<double, Eigen::Dynamic, 2 * n_fields, Eigen::RowMajor> rows;
    rows.setZero(n, 2 * n_fields);
    for (int v = 0; v < n; ++v)
      for (int k = 0; k < n_fields; ++k)
        for (int c = 0; c < 2; ++c)
          if (discretization.locally_owned.is_element(dofs(v, c)))
            rows(v, 2 * k + c) = fields[static_cast<std::size_t>(k)](dofs(v, c));
    MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(rows.size()), MPI_DOUBLE, MPI_SUM,
                  discretization.communicator);
    return rows;
  }

  meshes::SecondOrder second_order(const Law law)
  {
    const SecondOrderFields found = second_order_fields(
      {cell, discretization, constraints, solutions}, law,
      {options.tolerance, energies_at_equal_stress(), most_iterations}, *solver);
    if (result.abandoned.empty())
      result.abandoned = found.abandoned;
    return {found.energy, at_vertices<6>(found.modes)};
  }

  const UnitCell &cell;
  const HomogenizationOptions options;
  const std::vector<Eigen::Matrix3d> stiffness_of_phase;
  Timer timer; ///< started before the discretization is made
  Discretization discretization;
  AffineConstraints<double> constraints;
  std::unique_ptr<ElasticSolver> solver;
  std::vector<Vector> loads = std::vector<Vector>(3);
  std::array<double, 3> load_sizes;
  std::array<Vector, 3> solutions;
  Homogenization result;
};
} // namespace

Homogenization homogenize(const UnitCell &cell, const HomogenizationOptions &options,
                          const MPI_Comm communicator)
{
  return CellProblems(cell, options, communicator).run();
}

meshes::Chi chi_under_forces(const UnitCell &cell, const HomogenizationOptions &options,
                             const CellForces &forces, const MPI_Comm communicator)
{
  return CellProblems(cell, options, communicator).run_with(forces);
}

meshes::HomogenizedCell homogenized_cell(const UnitCell &cell, const Homogenization &result,
                                         const std::string &provenance)
{
  return {cell.mesh,
          cell.lattice,
          result.chi,
          result.anchor,
          result.stiffness,
          cell.areal_density(),
          provenance,
          std::nullopt,
          cell.shift ? sentence_of(*cell.shift) : "",
          result.second_order,
          {},
          {}};
}

EngineeringConstants engineering_constants(const Eigen::Matrix3d &stiffness)
{
  const Eigen::Matrix3d S = inverse_of(stiffness);
  return {1. / S(0, 0), 1. / S(1, 1), 1. / S(2, 2), -S(0, 1) / S(0, 0), -S(0, 1) / S(1, 1)};
}
} // namespace homespun::homogenization
