#include "ephyra/fluid/row_tridiagonal.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <cmath>

namespace ephyra::fluid
{
  namespace
  {
    /// Coefficients below this change no digit of a solution.
    constexpr double negligible = 1e-18;

    /// Bands of the interface system, in the order in which they are stored.
    enum Band
    {
      lower_2,
      lower_1,
      inverse_diagonal,
      upper_1,
      upper_2,
      n_bands
    };

    /// Number of interface unknowns of a rank.
    int
    n_unknowns(const int rank, const int n_ranks)
    {
      return rank == 0 || rank == n_ranks - 1 ? 1 : 2;
    }
    /// Index of its first one.
    int
    first_unknown(const int rank)
    {
      return rank == 0 ? 0 : 2 * rank - 1;
    }

    /// Sends n values for each column, each to the rank that owns the column
    /// in the interface system; returns them by rank of origin.
    struct ColumnExchange
    {
      std::vector<int> to_count, to_offset, from_count, from_offset;

      ColumnExchange(const int               n_values_here,
                     const std::vector<int> &values_of_rank,
                     const std::vector<int> &share_count,
                     const int               rank)
      {
        int to = 0, from = 0;
        for (std::size_t q = 0; q < share_count.size(); ++q)
          {
            to_count.push_back(n_values_here * share_count[q]);
            from_count.push_back(values_of_rank[q] * share_count[rank]);
            to_offset.push_back(to);
            from_offset.push_back(from);
            to += to_count.back();
            from += from_count.back();
          }
      }
    };
  } // namespace

  RowTridiagonal::RowTridiagonal(const Rows                &rows,
                                 const std::vector<double> &lambda,
                                 const int                  n_columns,
                                 const bool                 singular,
                                 const MPI_Comm             comm)
    : comm(comm)
    , rank(mpi::rank(comm))
    , n_ranks(mpi::size(comm))
    , n(static_cast<int>(rows.diagonal.size()))
    , first_row(rows.first)
    , n_columns(n_columns)
    , shared(lambda.size() == 1)
    , n_coefficients(static_cast<int>(lambda.size()))
    , upwards(rank < n_ranks - 1 || n_ranks == 1)
    , middle(rank > 0 && rank < n_ranks - 1)
  {
    EphyraAssert(n > 0, "every rank needs a row");
    factorize(rows, lambda, singular);
    if (n_ranks > 1)
      set_up_interfaces();
  }

  RowTridiagonal::Sparse
  RowTridiagonal::compress(const AlignedVector &full)
  {
    const int  size   = static_cast<int>(full.size());
    const auto counts = [&](const int m) {
      return std::abs(full[m]) > negligible;
    };
    Sparse result;
    for (int m = 0; m < (size + 1) / 2; ++m)
      if (counts(m))
        result.head = m + 1;
    for (int m = size - 1; m >= (size + 1) / 2; --m)
      if (counts(m))
        result.tail = size - m;
    result.values.assign(full.begin(), full.begin() + result.head);
    result.values.insert(
      result.values.end(), full.end() - result.tail, full.end());
    return result;
  }

  void
  RowTridiagonal::factorize(const Rows                &rows,
                            const std::vector<double> &lambda,
                            const bool                 singular)
  {
    behind.resize(n);
    ahead.resize(n);
    inverse.resize(static_cast<std::size_t>(n) * n_coefficients);
    AlignedVector fill_row(n_coefficients, 0.), weight(n_coefficients, 1.);
    last_behind.assign(n_coefficients, 0.);
    last_ahead.assign(n_coefficients, 0.);
    first_behind.assign(n_coefficients, 0.);
    first_ahead.assign(n_coefficients, 0.);

    const bool holds_end = upwards ? n_ranks == 1 : true;
    for (int s = 0; s < n; ++s)
      {
        const int i          = row(s) - first_row;
        behind[s]            = upwards ? rows.lower[i] : rows.upper[i];
        ahead[s]             = upwards ? rows.upper[i] : rows.lower[i];
        const bool    is_end = holds_end && i == n - 1;
        double *const inv =
          &inverse[static_cast<std::size_t>(s) * n_coefficients];
        const double *const before = inv - n_coefficients;
        for (int m = 0; m < n_coefficients; ++m)
          {
            double pivot = rows.diagonal[i] - lambda[m] * rows.weight[i];
            if (singular && is_end && lambda[m] == 0)
              pivot += rows.diagonal[i];
            if (s > 0)
              pivot -= behind[s] * ahead[s - 1] * before[m];
            inv[m] = 1. / pivot;
          }
        if (!middle)
          continue;
        for (int m = 0; m < n_coefficients; ++m)
          {
            fill_row[m] =
              s == 0 ? behind[s] * inv[m] : -behind[s] * fill_row[m] * inv[m];
            if (s > 0)
              weight[m] *= -ahead[s - 1] * before[m];
            first_behind[m] += weight[m] * fill_row[m];
          }
        fill.push_back(compress(fill_row));
        to_first.push_back(compress(weight));
      }

    const double *const inv =
      &inverse[static_cast<std::size_t>(n - 1) * n_coefficients];
    for (int m = 0; m < n_coefficients; ++m)
      {
        last_ahead[m]  = ahead[n - 1] * inv[m];
        last_behind[m] = fill_row[m];
        first_ahead[m] = weight[m] * ahead[n - 1] * inv[m];
      }
  }

  void
  RowTridiagonal::set_up_interfaces()
  {
    for (int q = 0; q < n_ranks; ++q)
      {
        const mpi::Share share = mpi::share(n_columns, q, n_ranks);
        share_first.push_back(share.first);
        share_count.push_back(share.count);
      }
    g_first.assign(n_columns, 0.);
    x_behind.assign(n_columns, 0.);
    x_ahead.assign(n_columns, 0.);

    // Gather the four coefficients of all ranks for the own share of columns.
    const std::vector<int> four(n_ranks, 4);
    const ColumnExchange   layout(4, four, share_count, rank);
    std::vector<double>    send(4 * static_cast<std::size_t>(n_columns));
    const int              count = share_count[rank];
    std::vector<double> received(4 * static_cast<std::size_t>(n_ranks) * count);
    std::size_t         position = 0;
    for (int q = 0; q < n_ranks; ++q)
      for (const AlignedVector *c :
           {&first_behind, &first_ahead, &last_behind, &last_ahead})
        for (int m = share_first[q]; m < share_first[q] + share_count[q]; ++m)
          send[position++] = (*c)[shared ? 0 : m];
    MPI_Alltoallv(send.data(),
                  layout.to_count.data(),
                  layout.to_offset.data(),
                  MPI_DOUBLE,
                  received.data(),
                  layout.from_count.data(),
                  layout.from_offset.data(),
                  MPI_DOUBLE,
                  comm);

    // Factorise the pentadiagonal matrices (unit diagonal, dominant: no
    // pivoting). Entry of band b, unknown k, column c: see `at`.
    const int n_all = 2 * n_ranks - 2;
    pentadiagonal.assign(static_cast<std::size_t>(n_bands) * n_all * count, 0.);
    const auto at = [&](const Band b, const int k, const int c) -> double & {
      return pentadiagonal[(static_cast<std::size_t>(k) * n_bands + b) * count +
                           c];
    };
    for (int c = 0; c < count; ++c)
      {
        const auto coefficient = [&](const int q, const int which) {
          return received[(4 * static_cast<std::size_t>(q) + which) * count +
                          c];
        };
        for (int q = 0; q < n_ranks; ++q)
          {
            const int k = first_unknown(q);
            if (q == 0)
              at(upper_1, k, c) = coefficient(q, 3);
            else if (q == n_ranks - 1)
              at(lower_1, k, c) = coefficient(q, 3);
            else
              {
                at(lower_1, k, c)     = coefficient(q, 0);
                at(upper_2, k, c)     = coefficient(q, 1);
                at(lower_2, k + 1, c) = coefficient(q, 2);
                at(upper_1, k + 1, c) = coefficient(q, 3);
              }
          }
        for (int k = 0; k < n_all; ++k)
          {
            double diagonal = 1;
            if (k > 1)
              {
                at(lower_2, k, c) *= at(inverse_diagonal, k - 2, c);
                at(lower_1, k, c) -= at(lower_2, k, c) * at(upper_1, k - 2, c);
                diagonal -= at(lower_2, k, c) * at(upper_2, k - 2, c);
              }
            if (k > 0)
              {
                at(lower_1, k, c) *= at(inverse_diagonal, k - 1, c);
                diagonal -= at(lower_1, k, c) * at(upper_1, k - 1, c);
                at(upper_1, k, c) -= at(lower_1, k, c) * at(upper_2, k - 1, c);
              }
            at(inverse_diagonal, k, c) = 1. / diagonal;
          }
      }
  }

  void
  RowTridiagonal::eliminate(const int s, double *const f)
  {
    const double *const inv =
      &inverse[static_cast<std::size_t>(s) * n_coefficients];
    if (s == 0)
      {
        for (int m = 0; m < n_columns; ++m)
          f[m] *= inv[shared ? 0 : m];
        if (middle)
          std::fill(g_first.begin(), g_first.end(), 0.);
      }
    else
      {
        const double        b      = behind[s];
        const double *const before = previous;
        if (shared)
          {
            const double pivot = inv[0];
            for (int m = 0; m < n_columns; ++m)
              f[m] = (f[m] - b * before[m]) * pivot;
          }
        else
          for (int m = 0; m < n_columns; ++m)
            f[m] = (f[m] - b * before[m]) * inv[m];
      }
    if (middle)
      add_product(to_first[s], 1., f, g_first.data());
    previous = last = f;
  }

  void
  RowTridiagonal::solve_interfaces(const bool add)
  {
    if (n_ranks == 1)
      return;
    const int        here  = n_unknowns(rank, n_ranks);
    const int        count = share_count[rank];
    std::vector<int> of_rank(n_ranks);
    for (int q = 0; q < n_ranks; ++q)
      of_rank[q] = n_unknowns(q, n_ranks);
    const ColumnExchange layout(here, of_rank, share_count, rank);
    const int            n_all = 2 * n_ranks - 2;

    // Right-hand sides to the owners of the columns.
    own_values.resize(static_cast<std::size_t>(here) * n_columns);
    interface_values.resize(static_cast<std::size_t>(n_all) * count);
    double *send = own_values.data();
    for (int q = 0; q < n_ranks; ++q)
      {
        const int begin = share_first[q], end = begin + share_count[q];
        if (middle)
          send = std::copy(&g_first[begin], g_first.data() + end, send);
        send = std::copy(last + begin, last + end, send);
      }
    MPI_Alltoallv(own_values.data(),
                  layout.to_count.data(),
                  layout.to_offset.data(),
                  MPI_DOUBLE,
                  interface_values.data(),
                  layout.from_count.data(),
                  layout.from_offset.data(),
                  MPI_DOUBLE,
                  comm);

    // The ranks are in order, so unknown k lies at interface_values[k][c].
    double *const x     = interface_values.data();
    const auto    bands = [&](const Band b, const int k) {
      return &pentadiagonal[(static_cast<std::size_t>(k) * n_bands + b) *
                            count];
    };
    for (int k = 1; k < n_all; ++k)
      for (int c = 0; c < count; ++c)
        x[k * count + c] -=
          bands(lower_1, k)[c] * x[(k - 1) * count + c] +
          (k > 1 ? bands(lower_2, k)[c] * x[(k - 2) * count + c] : 0.);
    for (int k = n_all - 1; k >= 0; --k)
      for (int c = 0; c < count; ++c)
        {
          double value = x[k * count + c];
          if (k + 1 < n_all)
            value -= bands(upper_1, k)[c] * x[(k + 1) * count + c];
          if (k + 2 < n_all)
            value -= bands(upper_2, k)[c] * x[(k + 2) * count + c];
          x[k * count + c] = value * bands(inverse_diagonal, k)[c];
        }

    // Each rank gets the values beside its own rows: those behind and ahead.
    returned_values.resize(interface_values.size());
    double *back = returned_values.data();
    for (int q = 0; q < n_ranks; ++q)
      {
        const auto append = [&](const int k) {
          back = std::copy(x + k * count, x + (k + 1) * count, back);
        };
        if (q == 0)
          append(1);
        else if (q == n_ranks - 1)
          append(n_all - 2);
        else
          {
            append(2 * q - 2);
            append(2 * q + 1);
          }
      }
    MPI_Alltoallv(returned_values.data(),
                  layout.from_count.data(),
                  layout.from_offset.data(),
                  MPI_DOUBLE,
                  own_values.data(),
                  layout.to_count.data(),
                  layout.to_offset.data(),
                  MPI_DOUBLE,
                  comm);
    const double *from = own_values.data();
    const auto    take = [&](AlignedVector &values, const int q) {
      double *const to = &values[share_first[q]];
      for (int c = 0; c < share_count[q]; ++c)
        to[c] = add ? to[c] + from[c] : from[c];
      from += share_count[q];
    };
    for (int q = 0; q < n_ranks; ++q)
      {
        if (middle)
          take(x_behind, q);
        take(x_ahead, q);
      }
  }

  void
  RowTridiagonal::substitute(const int           s,
                             const double *const f,
                             double *const       x)
  {
    const double *const inv =
      &inverse[static_cast<std::size_t>(s) * n_coefficients];
    const double *const next =
      s < n - 1 ? previous : (n_ranks > 1 ? x_ahead.data() : nullptr);
    if (next == nullptr)
      std::copy(f, f + n_columns, x);
    else if (shared)
      {
        const double factor = ahead[s] * inv[0];
        for (int m = 0; m < n_columns; ++m)
          x[m] = f[m] - factor * next[m];
      }
    else
      {
        const double a = ahead[s];
        for (int m = 0; m < n_columns; ++m)
          x[m] = f[m] - a * inv[m] * next[m];
      }
    if (middle)
      add_product(fill[s], -1., x_behind.data(), x);
    previous = x;
  }

  void
  RowTridiagonal::add_product(const Sparse       &coefficients,
                              const double        factor,
                              const double *const x,
                              double *const       y) const
  {
    if (shared)
      {
        if (coefficients.head == 0)
          return;
        const double c = factor * coefficients.values[0];
        for (int m = 0; m < n_columns; ++m)
          y[m] += c * x[m];
        return;
      }
    for (int m = 0; m < coefficients.head; ++m)
      y[m] += factor * coefficients.values[m] * x[m];
    const int start = n_columns - coefficients.tail;
    for (int m = 0; m < coefficients.tail; ++m)
      y[start + m] +=
        factor * coefficients.values[coefficients.head + m] * x[start + m];
  }
} // namespace ephyra::fluid
