#pragma once

#include <sstream>
#include <stdexcept>
#include <string>

namespace ephyra
{
  /// Exit codes of the program; scripts rely on them.
  enum class ExitCode : int
  {
    success        = 0,
    input_error    = 1, ///< parameters, files or folders of the user
    diverged       = 2, ///< a computation that failed or was not accepted
    interrupted    = 3, ///< stopped early; a checkpoint allows to resume
    internal_error = 4  ///< a mistake in the program, or no memory left
  };

  /// An error with a message for the user: one clean sentence that says what
  /// happened, where, the value, and the remedy.
  class Error : public std::runtime_error
  {
  public:
    Error(const ExitCode code, const std::string &message)
      : std::runtime_error(message)
      , code(code)
    {
    }

    const ExitCode code;
  };

  /// Something in the input is wrong (exit code 1).
  class InputError : public Error
  {
  public:
    explicit InputError(const std::string &message)
      : Error(ExitCode::input_error, message)
    {
    }
  };

  /// A computation diverged or did not converge (exit code 2).
  class DivergedError : public Error
  {
  public:
    explicit DivergedError(const std::string &message)
      : Error(ExitCode::diverged, message)
    {
    }
  };

  namespace internal
  {
    [[noreturn]] void
    assertion_failed(const char *condition,
                     const char *file,
                     int         line,
                     const char *message);
  }
} // namespace ephyra

/// Checks a condition that only a programming error can violate; off in
/// Release builds.
#ifdef NDEBUG
#  define EphyraAssert(condition, message) ((void)0)
#else
#  define EphyraAssert(condition, message)               \
    ((condition) ? (void)0                               \
                 : ::ephyra::internal::assertion_failed( \
                     #condition, __FILE__, __LINE__, message))
#endif

/// Throws @p Exception with a streamed message where a condition that a user
/// can violate does not hold:
///   EphyraThrowIf(dt <= 0, InputError, "The time step " << dt << " s ...");
#define EphyraThrowIf(condition, Exception, streamed)    \
  do                                                     \
    if (condition)                                       \
      {                                                  \
        std::ostringstream ephyra_message;               \
        ephyra_message << streamed;                      \
        throw ::ephyra::Exception(ephyra_message.str()); \
      }                                                  \
  while (false)
