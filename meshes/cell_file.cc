// SPDX-License-Identifier: MIT
#include "meshes/cell_file.h"

#include "meshes/errors.h"
#include "meshes/hdf5_writer.h"

#include <Eigen/Eigenvalues>

#include <hdf5.h>
#include <hdf5_hl.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <vector>

namespace homespun::meshes
{
namespace
{
/// An open HDF5 file.
class File
{
public:
  File(const hid_t id)
      : id(id)
  {
  }
  File(const File &)            = delete;
  File &operator=(const File &) = delete;
  ~File()
  {
    if (id >= 0)
      H5Fclose(id);
  }
  const hid_t id;
};

std::string shape_text(const std::vector<hsize_t> &shape)
{
  std::ostringstream text;
  text << '(';
  for (std::size_t k = 0; k < shape.size(); ++k)
    text << (k ? "," : "") << shape[k];
  text << ')';
  return text.str();
}

void require(const bool condition, const std::string &message)
{
  if (!condition)
    throw BadInput(message);
}

/// The shape of a dataset, which must have the given number of axes; 0 in `expected` is free.
std::vector<hsize_t> shape_of(const File &file, const std::string &path, const char *name,
                              const std::vector<hsize_t> &expected)
{
  int rank = -1;
  require(H5LTfind_dataset(file.id, name + 1) == 1 &&
            H5LTget_dataset_ndims(file.id, name, &rank) >= 0,
          path + ": dataset " + name +
            " is missing; expected a cell written by `homespun homogenize`: run it again");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5T_class_t type;
  std::size_t bytes;
  require(H5LTget_dataset_info(file.id, name, shape.data(), &type, &bytes) >= 0 &&
            (type == H5T_FLOAT || type == H5T_INTEGER),
          path + ": dataset " + name + " does not hold numbers; expected numbers");
  bool fits = shape.size() == expected.size();
  for (std::size_t k = 0; fits && k < shape.size(); ++k)
    fits = expected[k] == 0 || expected[k] == shape[k];
  std::string wanted = shape_text(expected);
  for (std::size_t at = 0; (at = wanted.find('0', at)) != std::string::npos && expected.size();)
    if ((at == 1 || wanted[at - 1] == ',') && (wanted[at + 1] == ',' || wanted[at + 1] == ')'))
      wanted.replace(at++, 1, "any");
    else
      ++at;
  require(fits,
          path + ": dataset " + name + " has shape " + shape_text(shape) + "; expected " + wanted);
  return shape;
}

void read(const File &file, const std::string &path, const char *name, double *values)
{
  require(H5LTread_dataset_double(file.id, name, values) >= 0,
          path + ": dataset " + name + " cannot be read: the file is damaged, write it again");
}

void read(const File &file, const std::string &path, const char *name, int *values)
{
  require(H5LTread_dataset_int(file.id, name, values) >= 0,
          path + ": dataset " + name + " cannot be read: the file is damaged, write it again");
}

/// What every cell fulfils, whoever made it.
std::vector<std::string> faults_of(const HomogenizedCell &cell, const std::string &path)
{
  std::vector<std::string> faults = faults_of(cell.mesh, path);
  const auto add = [&](const std::string &message) { faults.push_back(path + ": " + message); };
  if (!cell.chi.allFinite())
    add("/chi holds values that are not finite");
  if (cell.chi.rows() != cell.mesh.n_vertices())
    add("/chi has " + std::to_string(cell.chi.rows()) + " rows for " +
        std::to_string(cell.mesh.n_vertices()) + " vertices");
  else if (cell.anchor < 0 || cell.anchor >= cell.mesh.n_vertices())
    add("attribute anchor of /chi is " + std::to_string(cell.anchor) + "; expected a vertex index");
  else if (cell.chi.row(cell.anchor).cwiseAbs().maxCoeff() >
           1e-12 * std::max(cell.chi.cwiseAbs().maxCoeff(), 1e-300))
    add("/chi is not zero at its anchor, vertex " + std::to_string(cell.anchor));
  if (!cell.stiffness.allFinite())
    add("/C holds values that are not finite");
  else
  {
    const double scale = cell.stiffness.cwiseAbs().maxCoeff();
    if ((cell.stiffness - cell.stiffness.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
      add("/C is not symmetric; expected an effective stiffness");
    else if (!(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(cell.stiffness).eigenvalues()(0) >
               0.))
      add("/C is not positive definite; expected an effective stiffness");
  }
  if (!(cell.areal_density > 0.) || !(cell.areal_density < 1e300))
    add("/areal_density is " + std::to_string(cell.areal_density) +
        " kg/m^2; expected a positive number");
  if (!cell.lattice.vectors.allFinite() || !(cell.lattice.area() > 0.))
    add("/lattice spans no area; expected two independent vectors");
  return faults;
}
} // namespace

void write_cell(const HomogenizedCell &cell, const std::string &path)
{
  const std::vector<std::string> faults = faults_of(cell, path);
  if (!faults.empty())
    throw BadInput(faults);

  Hdf5Writer file(path);
  const auto n = static_cast<unsigned long long>(cell.mesh.n_vertices());
  const auto m = static_cast<unsigned long long>(cell.mesh.n_triangles());
  file.write("/vertices", {n, 2}, cell.mesh.vertices.data(), "m");
  file.write("/triangles", {m, 3}, cell.mesh.triangles.data());
  file.write("/material", {m}, cell.mesh.material.data());
  const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> lattice = cell.lattice.vectors;
  file.write("/lattice", {2, 2}, lattice.data(), "m");
  // Stored as (vertex, component, load); in memory a row is load-major.
  std::vector<double> chi(6 * static_cast<std::size_t>(n));
  for (Eigen::Index v = 0; v < cell.chi.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 2; ++c)
        chi[static_cast<std::size_t>(6 * v + 3 * c + a)] = cell.chi(v, 2 * a + c);
  file.write("/chi", {n, 2, 3}, chi.data(), "m");
  file.attribute("/chi", "anchor", cell.anchor);
  file.attribute(
    "/chi", "convention",
    "w = -(E11 chi_11 + E22 chi_22 + gamma12 chi_12), engineering shear; axes: vertex, "
    "component, load (11, 22, 12)");
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> stiffness = cell.stiffness;
  file.write("/C", {3, 3}, stiffness.data(), "N/m");
  file.attribute("/C", "convention", "Voigt 11, 22, 12 with engineering shear");
  file.write("/areal_density", {1}, &cell.areal_density, "kg/m^2");
  file.attribute("/", "provenance", cell.provenance);
  file.finish();
}

HomogenizedCell read_cell(const std::string &path)
{
  silence_hdf5();
  require(std::filesystem::is_regular_file(path),
          path + ": no such file; expected a cell.h5: make it with `homespun homogenize`");
  const File file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
  require(file.id >= 0,
          path +
            ": is not a readable HDF5 file (truncated, or of another kind); expected a cell.h5: "
            "make it with `homespun homogenize`");

  HomogenizedCell cell;
  const hsize_t n = shape_of(file, path, "/vertices", {0, 2})[0];
  const hsize_t m = shape_of(file, path, "/triangles", {0, 3})[0];
  shape_of(file, path, "/material", {m});
  shape_of(file, path, "/lattice", {2, 2});
  shape_of(file, path, "/chi", {n, 2, 3});
  shape_of(file, path, "/C", {3, 3});
  shape_of(file, path, "/areal_density", {1});

  cell.mesh.vertices.resize(static_cast<Eigen::Index>(n), 2);
  cell.mesh.triangles.resize(static_cast<Eigen::Index>(m), 3);
  cell.mesh.material.resize(static_cast<Eigen::Index>(m));
  read(file, path, "/vertices", cell.mesh.vertices.data());
  read(file, path, "/triangles", cell.mesh.triangles.data());
  read(file, path, "/material", cell.mesh.material.data());
  Eigen::Matrix<double, 2, 2, Eigen::RowMajor> lattice;
  read(file, path, "/lattice", lattice.data());
  cell.lattice.vectors = lattice;
  std::vector<double> chi(6 * static_cast<std::size_t>(n));
  read(file, path, "/chi", chi.data());
  cell.chi.resize(static_cast<Eigen::Index>(n), 6);
  for (Eigen::Index v = 0; v < cell.chi.rows(); ++v)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 2; ++c)
        cell.chi(v, 2 * a + c) = chi[static_cast<std::size_t>(6 * v + 3 * c + a)];
  require(H5LTget_attribute_int(file.id, "/chi", "anchor", &cell.anchor) >= 0,
          path + ": attribute anchor of /chi is missing; expected the vertex where chi is zero");
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> stiffness;
  read(file, path, "/C", stiffness.data());
  cell.stiffness = stiffness;
  read(file, path, "/areal_density", &cell.areal_density);

  hsize_t length = 0;
  H5T_class_t type;
  std::size_t bytes = 0;
  if (H5LTget_attribute_info(file.id, "/", "provenance", &length, &type, &bytes) >= 0 &&
      type == H5T_STRING && bytes < 1000000)
  {
    std::vector<char> text(bytes + 1, '\0');
    if (H5LTget_attribute_string(file.id, "/", "provenance", text.data()) >= 0)
      cell.provenance = text.data();
  }
  const std::vector<std::string> faults = faults_of(cell, path);
  if (!faults.empty())
    throw BadInput(faults);
  return cell;
}
} // namespace homespun::meshes
