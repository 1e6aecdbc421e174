// SPDX-License-Identifier: MIT
#include "verification/judge/given_positions.h"

#include "homogenization/mesh_files/converted_mesh.h"
#include "homogenization/mesh_files/mesh_formats.h"
#include "meshes/files/hdf5_reader.h"
#include "meshes/files/polygons.h"
#include "meshes/plain/errors.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <regex>

namespace homespun::verification
{
namespace
{
using meshes::BadInput;
using Rows = PositionRows;

std::string shape_text(const std::string &rows, const std::string &columns)
{
  return "(" + rows + ", " + columns + ")";
}

/// @param like of that shape; flat cloth may have a third column of zeros
[[noreturn]] void refuse_shape(const std::string &file, const std::string &found, const Rows &like)
{
  const std::string n = std::to_string(like.rows());
  throw BadInput(file + ": holds an array of shape " + found + "; expected " +
                 (like.cols() == 2 ? shape_text(n, "2") + " or " : "") + shape_text(n, "3") +
                 ", a row for each vertex of the kept mesh in its order");
}

template <typename Number, int order>
Rows numbers_of(const std::string &bytes, const std::size_t begin, const Eigen::Index n_rows,
                const Eigen::Index n_columns)
{
  Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic, order> values(n_rows, n_columns);
  std::memcpy(values.data(), bytes.data() + begin, sizeof(Number) * values.size());
  return values.template cast<double>();
}

/// numpy's own format: "\x93NUMPY", version, length of the header, a dict in Python's words, data.
Rows read_npy(const std::string &file, const Rows &like)
{
  std::ifstream input(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(input), {}};
  const auto byte = [&](const std::size_t k)
  { return static_cast<std::size_t>(static_cast<unsigned char>(bytes[k])); };
  if (bytes.size() < 12 || bytes.compare(0, 6, "\x93NUMPY") != 0)
    throw BadInput(file + ": is no file of numpy.save(); expected an array of float64");
  const bool is_first      = byte(6) == 1; // later versions have longer headers
  const std::size_t begin  = is_first ? 10 : 12,
                    length = byte(8) + 256 * byte(9) +
                             (is_first ? 0 : 65536 * (byte(10) + 256 * byte(11)));
  const std::string header = bytes.substr(begin, length);
  std::smatch type, order, shape;
  static const std::regex type_of("'descr': *'([^']*)'"),
    order_of("'fortran_order': *(True|False)"),
    shape_of("'shape': *\\((\\d*),? *(\\d*),? *(\\d*)[^)]*\\)");
  if (!std::regex_search(header, type, type_of) || !std::regex_search(header, order, order_of) ||
      !std::regex_search(header, shape, shape_of))
    throw BadInput(file + ": has a header that is not numpy's; expected a file of numpy.save()");
  const bool is_double = type[1] == "<f8";
  if (!is_double && type[1] != "<f4")
    throw BadInput(file + ": holds numbers of type " + type[1].str() +
                   "; expected float64: positions.astype(float)");
  const std::string columns = shape[2];
  if (shape[1] != std::to_string(like.rows()) || (columns != "2" && columns != "3") ||
      shape[3].length() > 0)
    refuse_shape(file, shape[0].str().substr(shape[0].str().find('(')), like);
  const Eigen::Index n_vertices = like.rows(), n_columns = columns == "2" ? 2 : 3;
  const std::size_t size = is_double ? sizeof(double) : sizeof(float);
  if (bytes.size() != begin + length + size * static_cast<std::size_t>(n_vertices * n_columns))
    throw BadInput(file + ": is cut off, or longer than its header says; write it again");
  const bool is_by_column = order[1] == "True";
  if (is_double)
    return is_by_column
             ? numbers_of<double, Eigen::ColMajor>(bytes, begin + length, n_vertices, n_columns)
             : numbers_of<double, Eigen::RowMajor>(bytes, begin + length, n_vertices, n_columns);
  return is_by_column
           ? numbers_of<float, Eigen::ColMajor>(bytes, begin + length, n_vertices, n_columns)
           : numbers_of<float, Eigen::RowMajor>(bytes, begin + length, n_vertices, n_columns);
}

[[noreturn]] void refuse_triangles(const std::string &file)
{
  throw BadInput(file + ": its faces are not those of the kept mesh, or stand in another order, as "
                        "then the vertices may, too; expected the dataset `triangles` of the "
                        "kept mesh: write positions at its vertices in their order, with these "
                        "triangles or as .npy");
}

/// Where there are triangles, they must be those of the mesh.
Rows read_hdf5(const std::string &file, const meshes::Triangles &triangles, const Rows &like)
{
  const meshes::Hdf5Reader input(file, "a dataset /positions");
  const auto shape =
    input.shape_of("/positions", {meshes::Hdf5Reader::any, meshes::Hdf5Reader::any});
  if (shape[0] != static_cast<unsigned long long>(like.rows()) || shape[1] < 2 || shape[1] > 3)
    refuse_shape(file, shape_text(std::to_string(shape[0]), std::to_string(shape[1])), like);
  if (input.has("/triangles"))
  {
    const auto corners           = input.shape_of("/triangles", {meshes::Hdf5Reader::any, 3});
    const std::vector<int> found = input.integers("/triangles", corners);
    if (corners[0] != static_cast<unsigned long long>(triangles.rows()) ||
        !std::equal(found.begin(), found.end(), triangles.data()))
      refuse_triangles(file);
  }
  const std::vector<double> values = input.numbers("/positions", shape);
  return Eigen::Map<const Rows>(values.data(), like.rows(), static_cast<Eigen::Index>(shape[1]));
}

/// By meshio.
meshes::Polygons read_vtu(const std::string &file)
{
  homogenization::MeshText text(file + ", converted to .msh",
                                homogenization::converted_to_msh(file, MPI_COMM_NULL));
  const homogenization::RawMesh raw = homogenization::read_msh(text);
  meshes::Polygons found;
  found.positions.resize(static_cast<Eigen::Index>(raw.points.size()), 3);
  for (std::size_t k = 0; k < raw.points.size(); ++k)
    found.positions.row(static_cast<Eigen::Index>(k)) = raw.points[k].transpose();
  for (homogenization::RawMesh::Cell cell : raw.cells)
  {
    if (cell.n_corners == 3)
      cell.corners[3] = -1;
    found.faces.push_back(cell.corners);
  }
  return found;
}

Rows read_surface(const std::string &file, const meshes::Triangles &triangles, const Rows &like)
{
  const bool is_vtu            = std::filesystem::path(file).extension() == ".vtu";
  const meshes::Polygons found = is_vtu ? read_vtu(file) : meshes::read_polygons(file);
  if (found.positions.rows() != like.rows())
    refuse_shape(file, shape_text(std::to_string(found.positions.rows()), "3"), like);
  bool is_same = static_cast<Eigen::Index>(found.faces.size()) == triangles.rows();
  for (Eigen::Index t = 0; is_same && t < triangles.rows(); ++t)
  {
    const meshes::Polygon &face = found.faces[static_cast<std::size_t>(t)];
    is_same = face[3] < 0 && Eigen::RowVector3i(face[0], face[1], face[2]) == triangles.row(t);
  }
  if (!is_same)
    refuse_triangles(file);
  return found.positions;
}

/// The shortest text of a number that reads back exactly, D.DDDDe+DD.
struct Digits
{
  template <typename Number>
  explicit Digits(const Number value)
  {
    char text[32];
    const std::string all(
      text,
      std::to_chars(text, text + sizeof(text), std::abs(value), std::chars_format::scientific).ptr);
    const std::size_t e = all.find('e');
    significant         = static_cast<int>(e == 1 ? 1 : e - 1);
    exponent            = std::stoi(all.substr(e + 1));
  }

  int significant, exponent;
};

/// The last digit that a file of text has of a vertex's largest coordinate, as a length, in the
/// mean. A file has as many decimals as any of its numbers, as by %.6f, or as many significant
/// digits, as by %.6g: near zero the latter have more decimals than they have elsewhere.
template <typename Number>
double last_digit(const Rows &values)
{
  int decimals = 0, significant = 1;
  for (Eigen::Index k = 0; k < values.size(); ++k)
    if (values.data()[k] != 0.)
    {
      const Digits its(static_cast<Number>(values.data()[k]));
      decimals    = std::max(decimals, its.significant - 1 - its.exponent);
      significant = std::max(significant, its.significant);
    }
  double sum = 0.;
  for (Eigen::Index v = 0; v < values.rows(); ++v)
  {
    const double largest = values.row(v).cwiseAbs().maxCoeff();
    const int last       = largest > 0. ? Digits(largest).exponent + 1 - significant : -decimals;
    sum += std::pow(10., std::max(-decimals, last));
  }
  return sum / static_cast<double>(values.rows());
}
} // namespace

GivenPositions read_positions(const std::string &file, const meshes::Triangles &triangles,
                              const PositionRows &like)
{
  const std::string kind = std::filesystem::path(file).extension();
  const bool is_surface  = kind == ".obj" || kind == ".ply" || kind == ".vtu"; // may be text
  Rows values;
  if (kind == ".npy")
    values = read_npy(file, like);
  else if (kind == ".h5" || kind == ".hdf5")
    values = read_hdf5(file, triangles, like);
  else if (is_surface)
    values = read_surface(file, triangles, like);
  else
    throw BadInput(file + ": is of a kind that is not read; expected .npy, .h5, .obj, .ply or "
                          ".vtu");
  if (!values.allFinite())
    throw BadInput(file + ": holds NaN or infinite numbers; expected the position of each vertex");
  const double length    = values.cwiseAbs().maxCoeff();
  const Eigen::Index dim = like.cols();
  if (values.cols() < dim)
    throw BadInput(file +
                   ": holds positions in the plane; expected three components, of a cloth in "
                   "space");
  if (values.cols() > dim && values.col(2).cwiseAbs().maxCoeff() > 1e-9 * length)
    throw BadInput(file + ": its third column is not zero; expected positions in the plane of the "
                          "sheet");
  const bool is_single = values.cast<float>().cast<double>() == values;
  double resolution    = is_single ? length * std::numeric_limits<float>::epsilon() : 0.;
  if (is_surface)
    resolution =
      std::max(resolution, is_single ? last_digit<float>(values) : last_digit<double>(values));
  return {values.leftCols(dim), resolution};
}
} // namespace homespun::verification
