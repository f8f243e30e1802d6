// VTK output is decoded again by an independent reader and compared.
#include "vtk_reader.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/mpi.h"
#include "ephyra/io/pvd_collection.h"
#include "ephyra/io/vtk_writer.h"

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace ephyra;

namespace
{
  /// A grid of 5 x 3 cells whose fields tell the cell.
  GridOutput
  example_grid(const MPI_Comm comm)
  {
    GridOutput grid;
    grid.r_faces           = {0., 0.1, 0.25, 0.5, 0.8, 1.2};
    grid.y_faces           = {-1., 0., 2., 5.};
    const mpi::Share share = mpi::share(5, mpi::rank(comm), mpi::size(comm));
    grid.first_row         = share.first;
    grid.n_rows            = share.count;
    GridField pressure{"pressure [Pa]", {{}}},
      velocity{"velocity <[m/s]>", {{}, {}, {}}};
    for (int i = share.first; i < share.first + share.count; ++i)
      for (int j = 0; j < 3; ++j)
        {
          pressure.components[0].push_back(10 * i + j);
          for (int c = 0; c < 3; ++c)
            velocity.components[c].push_back(100 * c + 10 * i + j);
        }
    grid.fields = {pressure, velocity};
    return grid;
  }

  /// A quarter of an annulus with radii 1 and 2, exact in one rational cell.
  BezierOutput
  quarter_annulus()
  {
    BezierOutput body;
    body.name         = "ring";
    body.degree       = {{2, 1}};
    const double w    = std::sqrt(0.5);
    body.r            = {1, 1, 0, 2, 2, 0};
    body.y            = {0, 1, 1, 0, 2, 2};
    body.weight       = {1, w, 1, 1, w, 1};
    body.point_fields = {{"index [1]", 1, {0, 1, 2, 3, 4, 5}}};
    return body;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(vtk)

BOOST_AUTO_TEST_CASE(flow_pieces_hold_the_cells_of_their_rank)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  io::write_flow(folder.path + "/flow", example_grid(comm), comm);

  const mpi::Share share = mpi::share(5, mpi::rank(comm), mpi::size(comm));
  const testing::VtkReader piece(folder.path + "/flow_" +
                                 std::to_string(mpi::rank(comm)) + ".vtr");
  const auto               pressure = piece.array<float>("pressure [Pa]");
  const auto velocity = piece.array<float>("velocity &lt;[m/s]&gt;");
  const auto r        = piece.array<double>("r [m]");
  BOOST_REQUIRE_EQUAL(pressure.size(), 3 * share.count);
  BOOST_REQUIRE_EQUAL(velocity.size(), 9 * share.count);
  BOOST_REQUIRE_EQUAL(r.size(), share.count + 1);
  BOOST_TEST(r[1] == example_grid(comm).r_faces[share.first + 1]);
  BOOST_TEST(piece.array<double>("y [m]").size() == 4u);
  // VTK's order: x (our rows) fastest.
  std::size_t k = 0;
  for (int j = 0; j < 3; ++j)
    for (int i = share.first; i < share.first + share.count; ++i, ++k)
      {
        BOOST_TEST(pressure[k] == 10 * i + j);
        for (int c = 0; c < 3; ++c)
          BOOST_TEST(velocity[3 * k + c] == 100 * c + 10 * i + j);
      }
  BOOST_TEST(piece.text.find("<Piece Extent=\"" + std::to_string(share.first) +
                             " " + std::to_string(share.first + share.count) +
                             " 0 3 0 0\">") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(list_of_pieces_covers_the_grid)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  // The last rank holds nothing where there is more than one.
  GridOutput grid = example_grid(comm);
  if (mpi::size(comm) == 2)
    {
      grid = example_grid(MPI_COMM_SELF);
      if (mpi::rank(comm) == 1)
        {
          grid.first_row = 5;
          grid.n_rows    = 0;
        }
    }
  io::write_flow(folder.path + "/flow", grid, comm);
  MPI_Barrier(comm);
  const std::string list = testing::read_whole_file(folder.path + "/flow.pvtr");
  BOOST_TEST(list.find("WholeExtent=\"0 5 0 3 0 0\"") != std::string::npos);
  BOOST_TEST(list.find("Source=\"flow_0.vtr\"") != std::string::npos);
  if (mpi::size(comm) == 2)
    BOOST_TEST(list.find("flow_1.vtr") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(bezier_order_is_that_of_vtk)
{
  // Cubic by quadratic, numbered i + 4 j: corners, edges, interior.
  const std::vector<int> quadrilateral = {0, 3, 11, 8, 1, 2, 7, 9, 10, 4, 5, 6};
  BOOST_TEST(io::vtk_bezier_order(2, {{3, 2}}) == quadrilateral,
             boost::test_tools::per_element());
  const std::vector<int> curve = {0, 3, 1, 2};
  BOOST_TEST(io::vtk_bezier_order(1, {{3, 0}}) == curve,
             boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(body_is_decoded_to_the_same_cell)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  const BezierOutput             body = quarter_annulus();
  io::write_body(folder.path + "/ring", body, comm);
  MPI_Barrier(comm);

  const testing::VtkReader file(folder.path + "/ring.vtu");
  BOOST_TEST(file.array<std::uint8_t>("types").at(0) == 77);
  BOOST_TEST(file.array<std::int64_t>("offsets").at(0) == 6);
  const std::vector<std::int64_t> order = {0, 2, 5, 3, 1, 4};
  BOOST_TEST(file.array<std::int64_t>("connectivity") == order,
             boost::test_tools::per_element());
  const std::vector<double> degrees = {2, 1, 0};
  BOOST_TEST(file.array<double>("HigherOrderDegrees") == degrees,
             boost::test_tools::per_element());
  BOOST_TEST(file.array<double>("RationalWeights") == body.weight,
             boost::test_tools::per_element());
  const auto points = file.array<double>("Points");
  for (std::size_t k = 0; k < 6; ++k)
    {
      BOOST_TEST(points[3 * k] == body.r[k]);
      BOOST_TEST(points[3 * k + 1] == body.y[k]);
      BOOST_TEST(file.array<float>("index [1]")[k] == k);
    }
}

BOOST_AUTO_TEST_CASE(large_arrays_take_several_blocks)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  GridOutput                     grid;
  const int                      n = 400;
  for (int i = 0; i <= n; ++i)
    grid.r_faces.push_back(i);
  grid.y_faces = grid.r_faces;
  grid.n_rows  = mpi::rank(comm) == 0 ? n : 0;
  GridField field{"x [1]", {{}}};
  for (int k = 0; k < grid.n_rows * n; ++k)
    field.components[0].push_back(k % 9973);
  grid.fields = {field};
  io::write_flow(folder.path + "/flow", grid, comm);
  MPI_Barrier(comm);
  const auto values =
    testing::VtkReader(folder.path + "/flow_0.vtr").array<float>("x [1]");
  BOOST_REQUIRE_EQUAL(values.size(), n * n);
  for (const int k : {0, 1, 65535, 65536, 159998, 159999})
    BOOST_TEST(values[k] == ((k % n) * n + k / n) % 9973);
}

BOOST_AUTO_TEST_CASE(series_grows_and_survives_a_restart)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  const BezierOutput             body  = quarter_annulus();
  const auto                     times = [&]() {
    MPI_Barrier(comm);
    std::vector<std::string> found;
    const std::string        text =
      testing::read_whole_file(folder.path + "/ring.pvd");
    for (std::size_t at = 0;
         (at = text.find("timestep=\"", at)) != std::string::npos;)
      {
        at += 10;
        found.push_back(text.substr(at, text.find('"', at) - at));
      }
    return found;
  };
  const auto expect = [&](const std::vector<std::string> &expected) {
    BOOST_TEST(times() == expected, boost::test_tools::per_element());
    MPI_Barrier(comm);
  };

  {
    io::PvdCollection series(folder.path, "ring", comm);
    series.write(0., body);
    series.write(0.25, body);
    series.write(0.5, body);
    expect({"0", "0.25", "0.5"});
    series.write(0.5 * (1 + 1e-15), body); // the same time once more
    BOOST_TEST(times().size() == 3u);
    series.write(0.75, body);
  }
  {
    // Resumed between two outputs: later ones go, none is doubled.
    io::PvdCollection series(folder.path, "ring", comm);
    series.resume(0.3);
    series.write(0.5, body);
    expect({"0", "0.25", "0.5"});
  }
  {
    // Resumed at an output that the run writes again.
    io::PvdCollection series(folder.path, "ring", comm);
    series.resume(0.5);
    series.write(0.5, body);
    series.write(0.75, body);
    expect({"0", "0.25", "0.5", "0.75"});
  }
  {
    // A new run starts a new list.
    io::PvdCollection series(folder.path, "ring", comm);
    series.write(0., body);
    expect({"0"});
    BOOST_TEST(
      testing::read_whole_file(folder.path + "/ring/ring_000000.vtu").size() >
      0u);
  }
}

BOOST_AUTO_TEST_CASE(unwritable_folder_is_one_error_on_all_ranks)
{
  const BezierOutput body = quarter_annulus();
  io::PvdCollection  series("/proc/ephyra", "ring", MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(
    series.write(0., body), InputError, [](const InputError &error) {
      return std::string(error.what())
               .find("/proc/ephyra/ring cannot be "
                     "created") != std::string::npos;
    });
}

BOOST_AUTO_TEST_CASE(points_and_none)
{
  const MPI_Comm                 comm = MPI_COMM_WORLD;
  const testing::TemporaryFolder folder;
  PointOutput                    points;
  points.r      = {0.1, 0.2, 0.3};
  points.y      = {-1., 0., 1e-9};
  points.fields = {{"age [s]", {3., 2., 1. / 3.}}};
  io::PvdCollection series(folder.path, "dye", comm);
  series.write(0., PointOutput{{}, {}, {{"age [s]", {}}}});
  series.write(1., points);
  if (mpi::rank(comm) != 0)
    return;
  BOOST_REQUIRE(series.entries().size() == 2u);
  const testing::VtkReader none(folder.path + "/" + series.entries()[0].file);
  BOOST_TEST(none.array<double>("Points").empty());
  BOOST_TEST(none.text.find("NumberOfPoints=\"0\"") != std::string::npos);
  const testing::VtkReader  file(folder.path + "/" + series.entries()[1].file);
  const std::vector<double> expected{0.1, -1., 0., 0.2, 0., 0., 0.3, 1e-9, 0.};
  BOOST_TEST(file.array<double>("Points") == expected);
  BOOST_TEST(file.array<double>("age [s]") == points.fields[0].values);
  BOOST_TEST(file.array<std::int64_t>("offsets") ==
             (std::vector<std::int64_t>{1, 2, 3}));
}

BOOST_AUTO_TEST_SUITE_END()
