#include "ephyra/fluid/moving_window.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/log.h"
#include "ephyra/base/mpi.h"
#include "ephyra/base/parameter_handler.h"
#include "ephyra/fluid/flow_solver.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

namespace ephyra::fluid
{
  void
  MovingWindowParameters::declare(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Moving window");
    prm.declare_entry("Follow",
                      "",
                      patterns::Anything(),
                      "What the grid follows along y by whole cells: the name "
                      "of a rigid body, or \"swimmer\", the centre of mass of "
                      "the deformable body. Empty: the grid is at rest.");
    prm.declare_entry(
      "Position",
      "",
      patterns::List(
        patterns::Double("", 0., 1., patterns::Double::Bounds::open), 0, 1),
      "Where the followed point is kept, as a fraction of the "
      "height of the window from below. Empty: where it "
      "starts.");
    prm.declare_entry("Cells",
                      "4",
                      patterns::Integer(1),
                      "The window moves when the point is so many cells away "
                      "from its place. Each move costs a Poisson solve.");
  }

  void
  MovingWindowParameters::parse(ParameterHandler &prm)
  {
    const ParameterHandler::Section section(prm, "Moving window");
    follow                              = prm.get("Follow");
    cells                               = prm.get_integer("Cells");
    const std::vector<double> fractions = prm.get_double_list("Position");
    if (!fractions.empty())
      position = fractions.front();
    if (on())
      return;
    for (const char *entry : {"Position", "Cells"})
      if (prm.is_set(entry))
        prm.add_error(entry,
                      "is given, but Follow is empty: name the body that the "
                      "window follows, or remove it.");
  }

  MovingWindow::MovingWindow(const MovingWindowParameters &parameters,
                             FlowSolver                   &flow,
                             const double                  y_start)
    : flow(flow)
    , n_cells(parameters.cells)
  {
    const GridLine &y = flow.grid().y;
    place             = parameters.position ? *parameters.position * y.length()
                                            : y_start - y.face.front();
    const double room = n_cells * y.width.front();
    EphyraThrowIf(place <= room || place >= y.length() - room,
                  InputError,
                  "The moving window keeps the body '"
                    << parameters.follow << "' " << place
                    << " m above its lower end, within " << parameters.cells
                    << " cells (" << room << " m) of an end of its "
                    << y.length()
                    << " m: change Fluid/Moving window/Position, or fewer "
                       "Cells.");
    std::ostringstream text;
    text << "Flow: the window of " << y.length() << " m follows '"
         << parameters.follow << "', kept " << place
         << " m above its lower end, by " << n_cells << " cells (" << room
         << " m) or more at a time.";
    log().line(text.str());
  }

  int
  MovingWindow::cells_to(const double y) const
  {
    const GridLine &line = flow.grid().y;
    const double    cells =
      (y - (line.face.front() + place)) / (line.length() / line.n_cells);
    return std::abs(cells) < n_cells ? 0 : static_cast<int>(cells);
  }

  void
  MovingWindow::follow(const double y)
  {
    // The first rank decides: round-off must not part the ranks.
    double cells = std::isfinite(y) ? cells_to(y) : 0.;
    mpi::broadcast(&cells, 1, flow.grid().communicator());
    if (cells != 0.)
      flow.shift_window(static_cast<int>(cells));
  }

  void
  MovingWindow::evaluate(Record &record) const
  {
    record.add("window y [m]", flow.grid().y.face.front());
    record.add("window shift [cells]", flow.grid().shift());
  }
} // namespace ephyra::fluid
