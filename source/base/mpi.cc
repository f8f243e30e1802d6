#include "ephyra/base/mpi.h"

#include <sys/resource.h>

#include <algorithm>

namespace ephyra::mpi
{
  namespace
  {
    template <typename T>
    T
    reduce(T                  value,
           const MPI_Datatype type,
           const MPI_Op       op,
           const MPI_Comm     comm)
    {
      T result;
      MPI_Allreduce(&value, &result, 1, type, op, comm);
      return result;
    }
  } // namespace

  int
  rank(const MPI_Comm comm)
  {
    int result;
    MPI_Comm_rank(comm, &result);
    return result;
  }

  int
  size(const MPI_Comm comm)
  {
    int result;
    MPI_Comm_size(comm, &result);
    return result;
  }

  double
  sum(const double value, const MPI_Comm comm)
  {
    return reduce(value, MPI_DOUBLE, MPI_SUM, comm);
  }

  double
  min(const double value, const MPI_Comm comm)
  {
    return reduce(value, MPI_DOUBLE, MPI_MIN, comm);
  }

  double
  max(const double value, const MPI_Comm comm)
  {
    return reduce(value, MPI_DOUBLE, MPI_MAX, comm);
  }

  long long
  sum(const long long value, const MPI_Comm comm)
  {
    return reduce(value, MPI_LONG_LONG, MPI_SUM, comm);
  }

  double
  cpu_time(const MPI_Comm comm)
  {
    rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval &t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * t.tv_usec;
    };
    return sum(seconds(usage.ru_utime) + seconds(usage.ru_stime), comm);
  }

  bool
  any(const bool condition, const MPI_Comm comm)
  {
    return reduce(static_cast<int>(condition), MPI_INT, MPI_MAX, comm) != 0;
  }

  void
  sum_in_place(double *values, const std::size_t n_values, const MPI_Comm comm)
  {
    MPI_Allreduce(MPI_IN_PLACE,
                  values,
                  static_cast<int>(n_values),
                  MPI_DOUBLE,
                  MPI_SUM,
                  comm);
  }

  void
  sum_in_place(std::vector<double> &values, const MPI_Comm comm)
  {
    sum_in_place(values.data(), values.size(), comm);
  }

  void
  broadcast(double           *values,
            const std::size_t n_values,
            const MPI_Comm    comm,
            const int         root)
  {
    MPI_Bcast(values, static_cast<int>(n_values), MPI_DOUBLE, root, comm);
  }

  void
  broadcast(std::string &text, const MPI_Comm comm, const int root)
  {
    int size = static_cast<int>(text.size());
    MPI_Bcast(&size, 1, MPI_INT, root, comm);
    text.resize(size);
    MPI_Bcast(text.data(), size, MPI_CHAR, root, comm);
  }

  Share
  share(const int n_items, const int rank, const int n_ranks)
  {
    const int base = n_items / n_ranks;
    const int rest = n_items % n_ranks;
    return {rank * base + std::min(rank, rest), base + (rank < rest ? 1 : 0)};
  }
} // namespace ephyra::mpi
