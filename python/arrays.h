// SPDX-License-Identifier: MIT
// NumPy arrays of matrices, and matrices of NumPy arrays, where they lie: nothing is copied, and
// what cannot be taken as it is is refused by name.
#pragma once

#include "meshes/plain/errors.h"

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace homespun::python
{
namespace py = pybind11;

/// A read-only view of a matrix that an object owns; the array keeps the object alive.
template <typename Matrix>
py::array view(const Matrix &matrix, const py::handle owner)
{
  using Scalar = typename Matrix::Scalar;
  static_assert(Matrix::IsRowMajor || Matrix::ColsAtCompileTime == 1);
  const std::vector<py::ssize_t> shape = Matrix::ColsAtCompileTime == 1
                                           ? std::vector<py::ssize_t>{matrix.rows()}
                                           : std::vector<py::ssize_t>{matrix.rows(), matrix.cols()};
  py::array array(py::dtype::of<Scalar>(), shape, matrix.data(), owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// A copy, of small matrices.
inline py::array_t<double> copy_of(const Eigen::Ref<const Eigen::MatrixXd> &matrix)
{
  py::array_t<double> array({matrix.rows(), matrix.cols()});
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      array.mutable_at(i, j) = matrix(i, j);
  return array;
}

/// "(3, 2)", of a shape.
inline std::string shape_text(const py::array &array)
{
  return py::str(array.attr("shape"));
}

/// Checks that an object is an array without gaps of this type and so many columns.
/// @throws BadInput naming the argument, what was found and what was expected
template <typename Scalar>
py::array checked_array(const py::object &object, const std::string &name,
                        const Eigen::Index n_columns)
{
  if (py::isinstance<py::array_t<Scalar, py::array::c_style>>(object))
  {
    py::array array = py::reinterpret_borrow<py::array>(object);
    if (array.ndim() == 2 && array.shape(1) == n_columns)
      return array;
  }
  // Something is wrong: which it is, the first of them.
  if (!py::isinstance<py::array>(object))
    throw meshes::BadInput(name + ": found a " + std::string(py::str(py::type::of(object))) +
                           "; expected a NumPy array: numpy.asarray(...)");
  const py::array array  = py::reinterpret_borrow<py::array>(object);
  const std::string type = py::str(py::dtype::of<Scalar>());
  if (!py::isinstance<py::array_t<Scalar>>(object))
    throw meshes::BadInput(name + ": found dtype " + std::string(py::str(array.dtype())) +
                           "; expected " + type + ": .astype('" + type + "')");
  if (array.ndim() != 2 || array.shape(1) != n_columns)
    throw meshes::BadInput(name + ": found the shape " + shape_text(array) + "; expected (n, " +
                           std::to_string(n_columns) + ")");
  throw meshes::BadInput(name + ": is not contiguous; expected rows one after the other: "
                                "numpy.ascontiguousarray(...)");
}

/// The matrix of an array, where it lies.
template <typename Matrix>
Eigen::Map<const Matrix> matrix_of(const py::object &object, const std::string &name)
{
  const py::array array =
    checked_array<typename Matrix::Scalar>(object, name, Matrix::ColsAtCompileTime);
  return {static_cast<const typename Matrix::Scalar *>(array.data()), array.shape(0),
          Matrix::ColsAtCompileTime};
}

/// The same of an array that is written into.
template <typename Matrix>
Eigen::Map<Matrix> room_in(const py::object &object, const std::string &name)
{
  py::array array = checked_array<typename Matrix::Scalar>(object, name, Matrix::ColsAtCompileTime);
  if (!array.writeable())
    throw meshes::BadInput(name + ": is read-only; expected an array to write into");
  return {static_cast<typename Matrix::Scalar *>(array.mutable_data()), array.shape(0),
          Matrix::ColsAtCompileTime};
}
} // namespace homespun::python
