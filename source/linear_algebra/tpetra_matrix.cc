#include "tpetra_matrix.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "trilinos.h"

#include <Teuchos_DefaultMpiComm.hpp>

#include <algorithm>
#include <cmath>

namespace ephyra::linear_algebra
{
  namespace
  {
    [[noreturn]] void
    throw_not_in_pattern(const int row, const int column)
    {
      EphyraThrowIf(true,
                    InputError,
                    "Unknowns " << row << " and " << column
                                << " do not couple in the pattern of the "
                                   "matrix they are added to.");
      std::abort();
    }
  } // namespace

  TpetraMatrix::TpetraMatrix(const SparsityPattern &pattern,
                             const MPI_Comm         comm)
    : Implementation(pattern.n_rows(), comm)
    , rank(mpi::rank(comm))
  {
    ensure_trilinos();
    row_start.push_back(0);
    for (const std::vector<int> &row : pattern.columns)
      {
        columns.insert(columns.end(), row.begin(), row.end());
        row_start.push_back(static_cast<int>(columns.size()));
      }
    values.resize(columns.size());
    for (int r = 0; r < mpi::size(comm); ++r)
      {
        const mpi::Share share = mpi::share(n_rows, r, mpi::size(comm));
        rows_of_rank.push_back(share.count);
        first_of_rank.push_back(share.first);
        entries_of_rank.push_back(row_start[share.first + share.count] -
                                  row_start[share.first]);
      }

    using Map                = Matrix::map_type;
    using Index              = Matrix::global_ordinal_type;
    const auto trilinos_comm = Teuchos::rcp(new Teuchos::MpiComm<int>(comm));
    const auto rows          = Teuchos::rcp(new Map(
      n_rows, static_cast<std::size_t>(n_owned_rows()), 0, trilinos_comm));
    std::vector<std::size_t> row_sizes(n_owned_rows());
    for (int i = 0; i < n_owned_rows(); ++i)
      row_sizes[i] = pattern.columns[first_owned_row() + i].size();
    const auto graph = Teuchos::rcp(new Matrix::crs_graph_type(
      rows, Teuchos::ArrayView<const std::size_t>(row_sizes)));
    for (int i = 0; i < n_owned_rows(); ++i)
      {
        const int                row = first_owned_row() + i;
        const std::vector<Index> indices(pattern.columns[row].begin(),
                                         pattern.columns[row].end());
        graph->insertGlobalIndices(
          row, static_cast<int>(indices.size()), indices.data());
      }
    graph->fillComplete();
    matrix = Teuchos::rcp(new Matrix(graph));
    matrix->fillComplete();

    const auto local = matrix->getLocalMatrixHost();
    for (int i = 0; i < n_owned_rows(); ++i)
      {
        const int row = first_owned_row() + i;
        for (auto k = local.graph.row_map(i); k < local.graph.row_map(i + 1);
             ++k)
          {
            const int column = static_cast<int>(
              matrix->getColMap()->getGlobalElement(local.graph.entries(k)));
            const auto from = columns.begin() + row_start[row];
            const auto to   = columns.begin() + row_start[row + 1];
            position.push_back(static_cast<int>(
              std::lower_bound(from, to, column) - columns.begin()));
          }
      }
  }

  void
  TpetraMatrix::begin_assembly()
  {
    std::fill(values.begin(), values.end(), 0.);
  }

  void
  TpetraMatrix::add(const int *unknowns, const int n, const double *element)
  {
    for (int i = 0; i < n; ++i)
      {
        const int row = unknowns[i];
        if (row < 0)
          continue;
        const int begin = row_start[row], end = row_start[row + 1];
        int       k = begin;
        for (int j = 0; j < n; ++j)
          {
            const int column = unknowns[j];
            if (column < 0)
              continue;
            if (k == end || columns[k] > column)
              k = begin;
            while (k < end && columns[k] < column)
              ++k;
            if (k == end || columns[k] != column)
              throw_not_in_pattern(row, column);
            values[k] += element[i * n + j];
          }
      }
  }

  void
  TpetraMatrix::add(const int row, const int column, const double value)
  {
    const auto begin = columns.begin() + row_start[row];
    const auto end   = columns.begin() + row_start[row + 1];
    const auto found = std::lower_bound(begin, end, column);
    if (found == end || *found != column)
      throw_not_in_pattern(row, column);
    values[found - columns.begin()] += value;
  }

  void
  TpetraMatrix::finish_assembly()
  {
    if (rows_of_rank.size() > 1)
      {
        std::vector<double> owned(entries_of_rank[rank]);
        MPI_Reduce_scatter(values.data(),
                           owned.data(),
                           entries_of_rank.data(),
                           MPI_DOUBLE,
                           MPI_SUM,
                           comm);
        std::copy(owned.begin(),
                  owned.end(),
                  values.begin() + row_start[first_owned_row()]);
      }
    const auto local = matrix->getLocalMatrixHost();
    for (std::size_t k = 0; k < position.size(); ++k)
      local.values(k) = values[position[k]];
  }

  void
  TpetraMatrix::gather(std::vector<double> &replicated) const
  {
    if (rows_of_rank.size() > 1)
      MPI_Allgatherv(MPI_IN_PLACE,
                     0,
                     MPI_DATATYPE_NULL,
                     replicated.data(),
                     rows_of_rank.data(),
                     first_of_rank.data(),
                     MPI_DOUBLE,
                     comm);
  }

  void
  TpetraMatrix::multiply(const std::vector<double> &x,
                         std::vector<double>       &y) const
  {
    y.resize(n_rows);
    const int first = first_owned_row();
    for (int row = first; row < first + n_owned_rows(); ++row)
      {
        double sum = 0.;
        for (int k = row_start[row]; k < row_start[row + 1]; ++k)
          sum += values[k] * x[columns[k]];
        y[row] = sum;
      }
    gather(y);
  }

  std::vector<double>
  TpetraMatrix::row_norms() const
  {
    std::vector<double> norms(n_rows, 0.);
    const int           first = first_owned_row();
    for (int row = first; row < first + n_owned_rows(); ++row)
      for (int k = row_start[row]; k < row_start[row + 1]; ++k)
        norms[row] = std::isfinite(values[k])
                       ? std::max(norms[row], std::abs(values[k]))
                       : std::nan("");
    gather(norms);
    return norms;
  }

  std::unique_ptr<TpetraMatrix>
  TpetraMatrix::serial_structure() const
  {
    SparsityPattern pattern(n_rows);
    for (int row = 0; row < n_rows; ++row)
      pattern.columns[row].assign(columns.begin() + row_start[row],
                                  columns.begin() + row_start[row + 1]);
    return std::make_unique<TpetraMatrix>(pattern, MPI_COMM_SELF);
  }

  void
  TpetraMatrix::copy_values_to(TpetraMatrix &serial) const
  {
    std::vector<int> first_entry;
    for (const int row : first_of_rank)
      first_entry.push_back(row_start[row]);
    MPI_Allgatherv(values.data() + row_start[first_owned_row()],
                   entries_of_rank[rank],
                   MPI_DOUBLE,
                   serial.values.data(),
                   entries_of_rank.data(),
                   first_entry.data(),
                   MPI_DOUBLE,
                   comm);
    serial.finish_assembly();
  }

  void
  TpetraMatrix::to_tpetra(const std::vector<double> &replicated,
                          Vector                    &vector) const
  {
    const auto view = vector.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int i = 0; i < n_owned_rows(); ++i)
      view(i, 0) = replicated[first_owned_row() + i];
  }

  void
  TpetraMatrix::to_replicated(const Vector        &vector,
                              std::vector<double> &replicated) const
  {
    replicated.resize(n_rows);
    const auto view = vector.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int i = 0; i < n_owned_rows(); ++i)
      replicated[first_owned_row() + i] = view(i, 0);
    gather(replicated);
  }

  std::unique_ptr<SparseMatrix::Implementation>
  make_tpetra_matrix(const SparsityPattern &pattern, const MPI_Comm comm)
  {
    return std::make_unique<TpetraMatrix>(pattern, comm);
  }
} // namespace ephyra::linear_algebra
