#pragma once

#include <mpi.h>

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  /// Wall time of the phases of a run, nested as they are called. The log ends
  /// with the tree, each level closed by an "other" row; timing.csv holds the
  /// same with calls, unknowns and nanoseconds for each unknown and call.
  class TimerTree
  {
  public:
    /// Measures its own life time as a phase below the one that is running.
    /// @p unknowns is what one call works on, on this rank (0: not stated).
    /// Names hold no '/'.
    class Scope
    {
    public:
      Scope(TimerTree &tree, const char *name, double unknowns = 0);
      ~Scope();
      Scope(const Scope &) = delete;
      Scope &
      operator=(const Scope &) = delete;

    private:
      TimerTree &tree;
      double     start;
    };

    TimerTree();
    ~TimerTree();

    /// The tree as text: seconds (largest over the ranks), share of the whole,
    /// calls, ns for each unknown that a rank works on. Collective.
    void
    print(std::ostream &out, MPI_Comm comm) const;

    /// timing.csv: phase (path with '/'), calls, seconds, unknowns, ns each.
    /// Collective; the first rank writes.
    void
    write_csv(const std::string &file_name, MPI_Comm comm) const;

    /// Seconds spent in a phase, by path ("flow/poisson"); 0 if it never ran.
    double
    seconds(const std::string &path) const;

  private:
    struct Node;
    struct Row;
    std::vector<Row>
    rows(MPI_Comm comm) const;

    std::unique_ptr<Node> root;
    Node                 *current;
    double                birth;
  };

  /// The tree of this process.
  TimerTree &
  timer();
} // namespace ephyra
