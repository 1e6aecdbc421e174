// SPDX-License-Identifier: MIT
// The values of neighbouring ranks that the columns of a distributed matrix ask for, several
// numbers per row at a time.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_Distributor.h>
#include <Epetra_Import.h>

#include <Eigen/Core>

namespace homespun::homogenization
{
/// A row of numbers for each unknown, one number for each right-hand side.
template <int lanes>
using LaneBlock = Eigen::Matrix<double, Eigen::Dynamic, lanes, Eigen::RowMajor>;

/// Of a matrix that stays as it is.
class Halo
{
public:
  explicit Halo(const Epetra_CrsMatrix &matrix)
      : n_columns(matrix.NumMyCols())
      , import(matrix.Importer())
  {
  }

  /// Whether the columns are the unknowns that this rank owns, in their order.
  bool is_trivial() const
  {
    return !import;
  }

  /// The values at the columns, of those that each rank owns.
  template <int lanes>
  void gather(const LaneBlock<lanes> &owned, LaneBlock<lanes> &at_columns) const
  {
    at_columns.resize(n_columns, lanes);
    const int n_same           = import->NumSameIDs();
    at_columns.topRows(n_same) = owned.topRows(n_same);
    for (int k = 0; k < import->NumPermuteIDs(); ++k)
      at_columns.row(import->PermuteToLIDs()[k]) = owned.row(import->PermuteFromLIDs()[k]);
    LaneBlock<lanes> sent(import->NumExportIDs(), lanes);
    for (int k = 0; k < import->NumExportIDs(); ++k)
      sent.row(k) = owned.row(import->ExportLIDs()[k]);
    int n_bytes  = 0;
    char *values = nullptr;
    import->Distributor().Do(reinterpret_cast<char *>(sent.data()), lanes * sizeof(double), n_bytes,
                             values);
    const Eigen::Map<const LaneBlock<lanes>> received(reinterpret_cast<const double *>(values),
                                                      import->NumRemoteIDs(), lanes);
    for (int k = 0; k < import->NumRemoteIDs(); ++k)
      at_columns.row(import->RemoteLIDs()[k]) = received.row(k);
    delete[] values;
  }

  /// The transpose of gather(): adds what stands at the columns to those who own them.
  template <int lanes>
  void scatter_add(const LaneBlock<lanes> &at_columns, LaneBlock<lanes> &owned) const
  {
    const int n_same = import->NumSameIDs();
    owned.topRows(n_same) += at_columns.topRows(n_same);
    for (int k = 0; k < import->NumPermuteIDs(); ++k)
      owned.row(import->PermuteFromLIDs()[k]) += at_columns.row(import->PermuteToLIDs()[k]);
    LaneBlock<lanes> sent(import->NumRemoteIDs(), lanes);
    for (int k = 0; k < import->NumRemoteIDs(); ++k)
      sent.row(k) = at_columns.row(import->RemoteLIDs()[k]);
    int n_bytes  = 0;
    char *values = nullptr;
    import->Distributor().DoReverse(reinterpret_cast<char *>(sent.data()), lanes * sizeof(double),
                                    n_bytes, values);
    const Eigen::Map<const LaneBlock<lanes>> received(reinterpret_cast<const double *>(values),
                                                      import->NumExportIDs(), lanes);
    for (int k = 0; k < import->NumExportIDs(); ++k)
      owned.row(import->ExportLIDs()[k]) += received.row(k);
    delete[] values;
  }

  const int n_columns;

private:
  const Epetra_Import *import; ///< of the matrix
};
} // namespace homespun::homogenization
