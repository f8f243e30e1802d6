#include "ephyra/base/exceptions.h"

#include <cstdio>
#include <cstdlib>

namespace ephyra::internal
{
  void
  assertion_failed(const char *condition,
                   const char *file,
                   const int   line,
                   const char *message)
  {
    std::fprintf(
      stderr, "%s:%d: %s (violated: %s)\n", file, line, message, condition);
    std::abort();
  }
} // namespace ephyra::internal
