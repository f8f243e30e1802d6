#include "band_matrix.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>

namespace ephyra::linear_algebra
{
  BandMatrix::BandMatrix(const SparsityPattern &pattern, const MPI_Comm comm)
    : Implementation(pattern.n_rows(), comm)
    , half_bandwidth(pattern.half_bandwidth())
    , full(3 * half_bandwidth + 1 >= n_rows)
    , offset(full ? 0 : half_bandwidth)
    , stride(full ? n_rows : 2 * half_bandwidth)
    , values(full ? static_cast<std::size_t>(n_rows) * n_rows
                  : static_cast<std::size_t>(n_rows) * (stride + 1))
  {
  }

  int
  BandMatrix::first_column(const int row) const
  {
    return full ? 0 : std::max(0, row - half_bandwidth);
  }

  int
  BandMatrix::last_column(const int row) const
  {
    return full ? n_rows : std::min(n_rows, row + half_bandwidth + 1);
  }

  void
  BandMatrix::begin_assembly()
  {
    std::fill(values.begin(), values.end(), 0.);
  }

  void
  BandMatrix::add(const int *unknowns, const int n, const double *element)
  {
    int lowest = n_rows, highest = -1;
    for (int i = 0; i < n; ++i)
      if (unknowns[i] >= 0)
        {
          lowest  = std::min(lowest, unknowns[i]);
          highest = std::max(highest, unknowns[i]);
        }
    EphyraThrowIf(highest >= n_rows || highest - lowest > half_bandwidth,
                  InputError,
                  "Unknowns " << lowest << " and " << highest
                              << " do not couple in the pattern of the matrix "
                                 "they are added to.");
    for (int i = 0; i < n; ++i)
      if (unknowns[i] >= 0)
        {
          double *row = &values[offset + unknowns[i] * stride];
          for (int j = 0; j < n; ++j)
            if (unknowns[j] >= 0)
              row[unknowns[j]] += element[i * n + j];
        }
  }

  void
  BandMatrix::add(const int row, const int column, const double value)
  {
    EphyraThrowIf(row >= n_rows || column < first_column(row) ||
                    column >= last_column(row),
                  InputError,
                  "Unknowns " << row << " and " << column
                              << " do not couple in the pattern of the matrix "
                                 "they are added to.");
    values[offset + row * stride + column] += value;
  }

  void
  BandMatrix::finish_assembly()
  {
    if (mpi::size(comm) > 1)
      mpi::sum_in_place(values, comm);
  }

  void
  BandMatrix::multiply(const std::vector<double> &x,
                       std::vector<double>       &y) const
  {
    y.resize(n_rows);
    for (int row = 0; row < n_rows; ++row)
      {
        const double *a     = row_values(row);
        const int     first = first_column(row);
        const int     count = last_column(row) - first;
        double        sum   = 0.;
        for (int k = 0; k < count; ++k)
          sum += a[k] * x[first + k];
        y[row] = sum;
      }
  }

  std::vector<double>
  BandMatrix::row_norms() const
  {
    std::vector<double> norms(n_rows, 0.);
    for (int row = 0; row < n_rows; ++row)
      {
        const double *a     = row_values(row);
        const int     count = last_column(row) - first_column(row);
        for (int k = 0; k < count; ++k)
          norms[row] = std::isfinite(a[k])
                         ? std::max(norms[row], std::abs(a[k]))
                         : std::nan("");
      }
    return norms;
  }

  std::unique_ptr<SparseMatrix::Implementation>
  make_band_matrix(const SparsityPattern &pattern, const MPI_Comm comm)
  {
    return std::make_unique<BandMatrix>(pattern, comm);
  }
} // namespace ephyra::linear_algebra
