#include "ephyra/fluid/transposition.h"

#include <algorithm>

namespace ephyra::fluid
{
  Transposition::Transposition(const int      n_rows,
                               const int      n_columns,
                               const MPI_Comm comm)
    : rows(mpi::share(n_rows, mpi::rank(comm), mpi::size(comm)))
    , columns(mpi::share(n_columns, mpi::rank(comm), mpi::size(comm)))
    , comm(comm)
    , n_ranks(mpi::size(comm))
    , n_rows(n_rows)
    , n_columns(n_columns)
    , row_message(static_cast<std::size_t>(rows.count) * n_columns)
    , column_message(static_cast<std::size_t>(columns.count) * n_rows)
  {
    int by_rows = 0, by_columns = 0;
    for (int q = 0; q < n_ranks; ++q)
      {
        row_count.push_back(rows.count *
                            mpi::share(n_columns, q, n_ranks).count);
        row_offset.push_back(by_rows);
        by_rows += row_count[q];
        column_count.push_back(columns.count *
                               mpi::share(n_rows, q, n_ranks).count);
        column_offset.push_back(by_columns);
        by_columns += column_count[q];
      }
  }

  template <typename Function>
  void
  Transposition::for_each_row_value(const int       stride,
                                    const Function &function) const
  {
    // Blocks for rank q: [column of q][own row].
    constexpr int tile = 8;
    for (int q = 0; q < n_ranks; ++q)
      {
        const mpi::Share other = mpi::share(n_columns, q, n_ranks);
        for (int j0 = 0; j0 < other.count; j0 += tile)
          for (int i = 0; i < rows.count; ++i)
            for (int j = j0; j < std::min(j0 + tile, other.count); ++j)
              function(static_cast<std::size_t>(i) * stride + other.first + j,
                       row_offset[q] +
                         static_cast<std::size_t>(j) * rows.count + i);
      }
  }

  template <typename Function>
  void
  Transposition::for_each_column_piece(const Function &function) const
  {
    // Blocks from rank q: [own column][row of q].
    for (int q = 0; q < n_ranks; ++q)
      {
        const mpi::Share other = mpi::share(n_rows, q, n_ranks);
        for (int j = 0; j < columns.count; ++j)
          function(static_cast<std::size_t>(j) * n_rows + other.first,
                   column_offset[q] + static_cast<std::size_t>(j) * other.count,
                   other.count);
      }
  }

  void
  Transposition::to_columns(const double *const by_rows,
                            const int           stride,
                            double *const       by_columns)
  {
    for_each_row_value(stride, [&](const std::size_t at, const std::size_t k) {
      row_message[k] = by_rows[at];
    });
    MPI_Alltoallv(row_message.data(),
                  row_count.data(),
                  row_offset.data(),
                  MPI_DOUBLE,
                  column_message.data(),
                  column_count.data(),
                  column_offset.data(),
                  MPI_DOUBLE,
                  comm);
    for_each_column_piece(
      [&](const std::size_t at, const std::size_t k, const int count) {
        std::copy_n(&column_message[k], count, &by_columns[at]);
      });
  }

  void
  Transposition::to_rows(const double *const by_columns,
                         double *const       by_rows,
                         const int           stride)
  {
    for_each_column_piece(
      [&](const std::size_t at, const std::size_t k, const int count) {
        std::copy_n(&by_columns[at], count, &column_message[k]);
      });
    MPI_Alltoallv(column_message.data(),
                  column_count.data(),
                  column_offset.data(),
                  MPI_DOUBLE,
                  row_message.data(),
                  row_count.data(),
                  row_offset.data(),
                  MPI_DOUBLE,
                  comm);
    for_each_row_value(stride, [&](const std::size_t at, const std::size_t k) {
      by_rows[at] = row_message[k];
    });
  }
} // namespace ephyra::fluid
