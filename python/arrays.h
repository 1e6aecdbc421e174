// SPDX-License-Identifier: MIT
// NumPy arrays of matrices, and matrices of what Python takes for arrays. Nothing is copied where
// type and order are those of the matrix; else numbers are converted, and what they would lose by
// it is refused by the name of the argument.
#pragma once

#include "meshes/plain/errors.h"

#include <Eigen/Core>
#include <pybind11/numpy.h>

#include <cmath>
#include <limits>
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

/// The shape that a matrix asks for: "(n, 3)", "(n,)" or "(3,)".
template <typename Matrix>
std::string shape_of()
{
  constexpr auto size = Matrix::IsVectorAtCompileTime ? Matrix::SizeAtCompileTime : Eigen::Dynamic;
  const std::string first = size == Eigen::Dynamic ? "n" : std::to_string(size);
  return "(" + first +
         (Matrix::IsVectorAtCompileTime ? "," : ", " + std::to_string(Matrix::ColsAtCompileTime)) +
         ")";
}

/// Whether an array has it.
template <typename Matrix>
bool has_shape_of(const py::array &array)
{
  if constexpr (Matrix::IsVectorAtCompileTime)
    return array.ndim() == 1 && (Matrix::SizeAtCompileTime == Eigen::Dynamic ||
                                 array.shape(0) == Matrix::SizeAtCompileTime);
  else
    return array.ndim() == 2 && array.shape(1) == Matrix::ColsAtCompileTime;
}

/// Refuses an entry, counted row by row.
[[noreturn]] inline void refuse_entry(const py::array &array, const py::ssize_t entry,
                                      const std::string &name, const std::string &expected)
{
  const py::ssize_t columns = array.ndim() == 2 ? array.shape(1) : 1;
  const std::string place   = std::to_string(entry / columns) +
                            (array.ndim() == 2 ? ", " + std::to_string(entry % columns) : "");
  const std::string found =
    py::str(array.attr("reshape")(-1).attr("item")(entry)); // Python writes numbers shortest
  throw meshes::BadInput(name + ": found " + found + " at [" + place + "]; expected " + expected);
}

/// Any numbers without gaps as those of a matrix, copied only where they must be.
/// @throws BadInput where one is not finite; indices where one is no whole number from 0
inline py::array_t<double> exactly(const py::array &array, const std::string &name, double /*as*/)
{
  auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  for (py::ssize_t k = 0; k < numbers.size(); ++k)
    if (!std::isfinite(numbers.data()[k]))
      refuse_entry(numbers, k, name, "finite numbers");
  return numbers;
}
inline py::array_t<int> exactly(const py::array &array, const std::string &name, int /*as*/)
{
  using Indices                  = py::array_t<int, py::array::c_style | py::array::forcecast>;
  constexpr const char *expected = "indices, whole numbers from 0";
  if (!py::isinstance<py::array_t<int>>(array))
  {
    const auto numbers = exactly(array, name, double());
    for (py::ssize_t k = 0; k < numbers.size(); ++k)
      if (const double number = numbers.data()[k];
          number != std::floor(number) || number < 0. || number > std::numeric_limits<int>::max())
        refuse_entry(array, k, name, expected); // with the digits of what was given
  }
  auto indices = Indices::ensure(array);
  for (py::ssize_t k = 0; k < indices.size(); ++k)
    if (indices.data()[k] < 0)
      refuse_entry(indices, k, name, expected);
  return indices;
}

/// An argument as the matrix that is asked for, where it lies or converted: NumPy arrays of any
/// order and type of numbers, lists, and what else NumPy makes an array of.
template <typename Matrix>
class Taken
{
public:
  /// @throws BadInput naming the argument, what was found and what was expected
  Taken(const py::object &object, const std::string &name)
  {
    const py::array given = py::array::ensure(object);
    const char kind       = given ? given.dtype().kind() : 'O';
    if (kind != 'f' && kind != 'i' && kind != 'u')
      throw meshes::BadInput(
        name + ": found a " + std::string(py::str(py::type::of(object).attr("__name__"))) +
        (given ? " of " + std::string(py::str(given.dtype())) : " that is no array") +
        "; expected numbers of the shape " + shape_of<Matrix>());
    if (!has_shape_of<Matrix>(given))
      throw meshes::BadInput(name + ": found the shape " +
                             std::string(py::str(given.attr("shape"))) + "; expected " +
                             shape_of<Matrix>());
    array = exactly(given, name, typename Matrix::Scalar());
  }

  Eigen::Map<const Matrix> operator*() const
  {
    return {array.data(), Matrix::RowsAtCompileTime == 1 ? 1 : array.shape(0),
            Matrix::ColsAtCompileTime};
  }

private:
  py::array_t<typename Matrix::Scalar> array;
};

/// The matrix of an array that is written into, where it lies: nothing is converted.
/// @throws BadInput naming the argument, what was found and what was expected
template <typename Matrix>
Eigen::Map<Matrix> room_in(const py::object &object, const std::string &name)
{
  using Scalar = typename Matrix::Scalar;
  if (!py::isinstance<py::array_t<Scalar, py::array::c_style>>(object) ||
      !has_shape_of<Matrix>(py::reinterpret_borrow<py::array>(object)))
  {
    const bool is_array = py::isinstance<py::array>(object);
    throw meshes::BadInput(
      name + ": found a " + std::string(py::str(py::type::of(object).attr("__name__"))) +
      (is_array ? " of " + std::string(py::str(object.attr("dtype"))) + " and the shape " +
                    std::string(py::str(object.attr("shape")))
                : "") +
      "; expected a contiguous array of " + std::string(py::str(py::dtype::of<Scalar>())) +
      " and the shape " + shape_of<Matrix>() + ", which is written into");
  }
  py::array array = py::reinterpret_borrow<py::array>(object);
  if (!array.writeable())
    throw meshes::BadInput(name + ": is read-only; expected an array to write into");
  return {static_cast<Scalar *>(array.mutable_data()), array.shape(0), Matrix::ColsAtCompileTime};
}
} // namespace homespun::python
