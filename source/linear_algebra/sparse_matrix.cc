#include "ephyra/linear_algebra/sparse_matrix.h"

#include "ephyra/base/exceptions.h"
#include "implementation.h"

#include <algorithm>
#include <cstdlib>

namespace ephyra::linear_algebra
{
  void
  SparsityPattern::add_element(const std::vector<int> &unknowns)
  {
    for (const int row : unknowns)
      if (row >= 0)
        for (const int column : unknowns)
          if (column >= 0)
            columns[row].push_back(column);
  }

  void
  SparsityPattern::compress()
  {
    for (std::vector<int> &row : columns)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        row.shrink_to_fit();
      }
  }

  int
  SparsityPattern::half_bandwidth() const
  {
    int result = 0;
    for (int row = 0; row < n_rows(); ++row)
      for (const int column : columns[row])
        result = std::max(result, std::abs(row - column));
    return result;
  }

  bool
  SparsityPattern::contains(const int row, const int column) const
  {
    return std::binary_search(columns[row].begin(), columns[row].end(), column);
  }

  SparseMatrix::SparseMatrix(const SparsityPattern &pattern,
                             const Storage          storage,
                             const MPI_Comm         comm)
    : form(storage)
    , impl(storage == Storage::band ? make_band_matrix(pattern, comm)
                                    : make_tpetra_matrix(pattern, comm))
  {
  }

  SparseMatrix::~SparseMatrix() = default;

  int
  SparseMatrix::n_rows() const
  {
    return impl->n_rows;
  }

  SparseMatrix::Storage
  SparseMatrix::storage() const
  {
    return form;
  }

  MPI_Comm
  SparseMatrix::communicator() const
  {
    return impl->comm;
  }

  void
  SparseMatrix::begin_assembly()
  {
    impl->begin_assembly();
  }

  void
  SparseMatrix::add(const int *unknowns, const int n, const double *values)
  {
    impl->add(unknowns, n, values);
  }

  void
  SparseMatrix::add(const int row, const int column, const double value)
  {
    if (row >= 0 && column >= 0)
      impl->add(row, column, value);
  }

  void
  SparseMatrix::finish_assembly()
  {
    impl->finish_assembly();
  }

  void
  SparseMatrix::multiply(const std::vector<double> &x,
                         std::vector<double>       &y) const
  {
    impl->multiply(x, y);
  }

  std::vector<double>
  SparseMatrix::row_norms() const
  {
    return impl->row_norms();
  }
} // namespace ephyra::linear_algebra
