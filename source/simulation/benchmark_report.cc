#include "ephyra/simulation/benchmark_report.h"

#include "ephyra/base/mpi.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <ostream>
#include <vector>

namespace ephyra::simulation
{
  double
  least_time(const int                    repetitions,
             const MPI_Comm               comm,
             const std::function<void()> &work)
  {
    double result = std::numeric_limits<double>::infinity();
    for (int k = 0; k < repetitions; ++k)
      {
        MPI_Barrier(comm);
        const double start = MPI_Wtime();
        work();
        result = std::min(result, mpi::max(MPI_Wtime() - start, comm));
      }
    return result;
  }

  BenchmarkReport::BenchmarkReport(std::ostream &out, const MPI_Comm comm)
    : out(out)
    , writes(mpi::rank(comm) == 0)
  {
    const std::size_t   n = 20000000 / mpi::size(comm);
    std::vector<double> a(n, 0.), b(n, 1.), c(n, 2.);
    const double        time = least_time(5, comm, [&] {
      for (std::size_t i = 0; i < n; ++i)
        a[i] = b[i] + 3. * c[i];
    });
    bandwidth = 24. * static_cast<double>(n) * mpi::size(comm) / time;
    if (writes)
      out << "Ranks: " << mpi::size(comm)
          << "\nMemory bandwidth (triad): " << std::fixed
          << std::setprecision(1) << 1e-9 * bandwidth << " GB/s\n\n"
          << std::left << std::setw(56) << "phase" << std::right
          << std::setw(10) << "ns each" << std::setw(14) << "triad bytes"
          << std::endl;
  }

  void
  BenchmarkReport::line(const std::string &what,
                        const double       seconds,
                        const double       unknowns)
  {
    if (writes)
      out << std::left << std::setw(56) << what << std::right << std::fixed
          << std::setprecision(1) << std::setw(10) << 1e9 * seconds / unknowns
          << std::setw(14) << bandwidth * seconds / unknowns << std::endl;
  }

  void
  BenchmarkReport::heading(const std::string &text)
  {
    if (writes)
      out << text << std::endl;
  }
} // namespace ephyra::simulation
