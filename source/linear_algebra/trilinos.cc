#include "trilinos.h"

#include <Kokkos_Core.hpp>

#include <mpi.h>

namespace ephyra::linear_algebra
{
  namespace
  {
    int
    finalize_kokkos(MPI_Comm, int, void *, void *)
    {
      if (Kokkos::is_initialized())
        Kokkos::finalize();
      return MPI_SUCCESS;
    }
  } // namespace

  void
  ensure_trilinos()
  {
    if (Kokkos::is_initialized())
      return;
    Kokkos::InitArguments arguments;
    arguments.num_threads      = 1;
    arguments.disable_warnings = true;
    Kokkos::initialize(arguments);
    // MPI_Finalize deletes the attributes of MPI_COMM_SELF before all else.
    int key;
    MPI_Comm_create_keyval(
      MPI_COMM_NULL_COPY_FN, finalize_kokkos, &key, nullptr);
    MPI_Comm_set_attr(MPI_COMM_SELF, key, nullptr);
  }
} // namespace ephyra::linear_algebra
