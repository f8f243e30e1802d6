#include "ephyra/base/timer_tree.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace ephyra
{
  struct TimerTree::Node
  {
    std::string                        name;
    Node                              *parent = nullptr;
    std::vector<std::unique_ptr<Node>> children;
    double seconds = 0, calls = 0, unknowns = 0; ///< unknowns over all calls

    Node &
    child(const std::string &child_name)
    {
      for (const auto &candidate : children)
        if (candidate->name == child_name)
          return *candidate;
      children.push_back(std::make_unique<Node>());
      children.back()->name   = child_name;
      children.back()->parent = this;
      return *children.back();
    }

    const Node *
    find(const std::string &path) const
    {
      const std::size_t slash = path.find('/');
      for (const auto &candidate : children)
        if (candidate->name == path.substr(0, slash))
          return slash == std::string::npos
                   ? candidate.get()
                   : candidate->find(path.substr(slash + 1));
      return nullptr;
    }

    /// Paths of all nodes below this one, parents first.
    void
    list_paths(const std::string &prefix, std::vector<std::string> &paths) const
    {
      for (const auto &node : children)
        {
          paths.push_back(prefix + node->name);
          node->list_paths(paths.back() + '/', paths);
        }
    }
  };

  /// A line of the table: the largest values over the ranks.
  struct TimerTree::Row
  {
    std::string path;
    double      seconds = 0, calls = 0, unknowns = 0;

    /// Nanoseconds for each unknown and call, 0 where no unknowns are stated.
    double
    nanoseconds() const
    {
      return unknowns > 0 ? 1e9 * seconds / unknowns : 0.;
    }
  };

  TimerTree::Scope::Scope(TimerTree   &tree,
                          const char  *name,
                          const double unknowns)
    : tree(tree)
    , start(MPI_Wtime())
  {
    tree.current = &tree.current->child(name);
    tree.current->unknowns += unknowns;
  }

  TimerTree::Scope::~Scope()
  {
    tree.current->seconds += MPI_Wtime() - start;
    tree.current->calls += 1;
    tree.current = tree.current->parent;
  }

  TimerTree::TimerTree()
    : root(std::make_unique<Node>())
    , current(root.get())
    , birth(MPI_Wtime())
  {
  }

  TimerTree::~TimerTree() = default;

  std::vector<TimerTree::Row>
  TimerTree::rows(const MPI_Comm comm) const
  {
    // Ranks may have run different phases: merge the trees of all.
    Node merged;
    for (int rank = 0; rank < mpi::size(comm); ++rank)
      {
        std::vector<std::string> paths;
        root->list_paths("", paths);
        std::string text;
        for (const std::string &path : paths)
          text += path + '\n';
        mpi::broadcast(text, comm, rank);
        std::istringstream stream(text);
        for (std::string path; std::getline(stream, path);)
          {
            Node              *node = &merged;
            std::istringstream parts(path);
            for (std::string name; std::getline(parts, name, '/');)
              node = &node->child(name);
          }
      }
    std::vector<std::string> paths;
    merged.list_paths("", paths);
    std::vector<double> values;
    for (const std::string &path : paths)
      {
        const Node *const node = root->find(path);
        for (double Node::*member :
             {&Node::seconds, &Node::calls, &Node::unknowns})
          values.push_back(node == nullptr ? 0. : node->*member);
      }
    MPI_Allreduce(MPI_IN_PLACE,
                  values.data(),
                  static_cast<int>(values.size()),
                  MPI_DOUBLE,
                  MPI_MAX,
                  comm);
    std::vector<Row> result;
    for (std::size_t i = 0; i < paths.size(); ++i)
      result.push_back(
        {paths[i], values[3 * i], values[3 * i + 1], values[3 * i + 2]});
    return result;
  }

  void
  TimerTree::print(std::ostream &out, const MPI_Comm comm) const
  {
    const std::vector<Row> all   = rows(comm);
    const double           total = mpi::max(MPI_Wtime() - birth, comm);
    const auto             level = [](const std::string &path) {
      return std::count(path.begin(), path.end(), '/');
    };
    const auto line = [&](const std::string &name,
                          const long         depth,
                          const Row         &row,
                          const bool         is_phase) {
      std::ostringstream text;
      text << std::left << std::setw(36) << std::string(2 * depth, ' ') + name
           << std::right << std::fixed << std::setprecision(3) << std::setw(12)
           << row.seconds << std::setprecision(1) << std::setw(8)
           << 100 * row.seconds / std::max(total, 1e-300);
      if (is_phase)
        text << std::setprecision(0) << std::setw(12) << row.calls;
      if (row.nanoseconds() > 0)
        text << std::setprecision(2) << std::setw(14) << row.nanoseconds();
      out << text.str() << '\n';
    };
    out << std::left << std::setw(36) << "phase" << std::right << std::setw(12)
        << "seconds" << std::setw(8) << "%" << std::setw(12) << "calls"
        << std::setw(14) << "ns/unknown" << '\n';

    // Rows come parents first, so what lies below one follows it.
    const auto print_below = [&](const auto  &self,
                                 std::size_t &i,
                                 const long   depth,
                                 const double seconds) -> void {
      double     rest = seconds;
      const bool any  = i < all.size() && level(all[i].path) >= depth;
      while (i < all.size() && level(all[i].path) == depth)
        {
          const Row &row = all[i++];
          line(row.path.substr(row.path.rfind('/') + 1), depth, row, true);
          self(self, i, depth + 1, row.seconds);
          rest -= row.seconds;
        }
      Row other;
      other.seconds = std::max(rest, 0.);
      if (any)
        line("other", depth, other, false);
    };
    std::size_t i = 0;
    print_below(print_below, i, 0, total);
    Row whole;
    whole.seconds = total;
    line("total", 0, whole, false);
  }

  void
  TimerTree::write_csv(const std::string &file_name, const MPI_Comm comm) const
  {
    const std::vector<Row> all    = rows(comm);
    const double           total  = mpi::max(MPI_Wtime() - birth, comm);
    bool                   failed = false;
    if (mpi::rank(comm) == 0)
      {
        std::ofstream out(file_name);
        out << "phase,calls,seconds [s],unknowns,time per unknown [ns]\n"
            << std::setprecision(10);
        for (const Row &row : all)
          out << row.path << ',' << row.calls << ',' << row.seconds << ','
              << row.unknowns << ',' << row.nanoseconds() << '\n';
        out << "total,1," << total << ",0,0\n";
        failed = !out.flush();
      }
    EphyraThrowIf(mpi::any(failed, comm),
                  InputError,
                  "The file \"" << file_name
                                << "\" cannot be written; check the rights of "
                                   "its folder and the free space.");
  }

  double
  TimerTree::seconds(const std::string &path) const
  {
    const Node *const node = root->find(path);
    return node == nullptr ? 0. : node->seconds;
  }

  TimerTree &
  timer()
  {
    static TimerTree instance;
    return instance;
  }
} // namespace ephyra
