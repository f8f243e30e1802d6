#include "ephyra/base/memory_archive.h"

#include <boost/test/unit_test.hpp>

#include <stdexcept>

using namespace ephyra;

BOOST_AUTO_TEST_SUITE(memory_archive)

namespace
{
  struct State
  {
    double              time = 0;
    std::int64_t        step = 0;
    std::vector<double> values;
    std::vector<double> field = std::vector<double>(8, 0.);

    // Two rows of three values in a memory with four to a row.
    RowLayout layout{2, 0, 2, 3, 4};

    void
    serialize(Archive &archive)
    {
      Archive::Group group(archive, "state");
      archive.value("time", time);
      archive.values("values", values);
      archive.rows("field", field.data(), layout);
      archive.value("step", step);
    }
  };
} // namespace

BOOST_AUTO_TEST_CASE(restores_what_was_saved)
{
  State state;
  state.time   = 1.5;
  state.step   = -7;
  state.values = {1, 2, 3};
  state.field  = {1, 2, 3, -1, 4, 5, 6, -1};
  MemoryArchive memory;
  BOOST_TEST(memory.empty());
  memory.begin_writing();
  state.serialize(memory);
  BOOST_TEST(!memory.reading());

  for (int i = 0; i < 2; ++i) // a state is restored as often as needed
    {
      state.time   = 0;
      state.step   = 0;
      state.values = {9};
      state.field.assign(8, 0.);
      memory.begin_reading();
      BOOST_TEST(memory.reading());
      state.serialize(memory);
      BOOST_TEST(state.time == 1.5);
      BOOST_TEST(state.step == -7);
      BOOST_TEST(state.values == (std::vector<double>{1, 2, 3}),
                 boost::test_tools::per_element());
      // What lies between the rows is not touched.
      BOOST_TEST(state.field == (std::vector<double>{1, 2, 3, 0, 4, 5, 6, 0}),
                 boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(misuse_is_noticed)
{
  MemoryArchive memory;
  BOOST_CHECK_THROW(memory.begin_reading(), std::logic_error);
  memory.begin_writing();
  double x = 1;
  memory.value("x", x);
  memory.begin_reading();
  memory.value("x", x);
  BOOST_CHECK_THROW(memory.value("y", x), std::logic_error);

  State state;
  memory.begin_writing();
  state.serialize(memory);
  state.layout.n_columns = 2;
  memory.begin_reading();
  BOOST_CHECK_THROW(state.serialize(memory), std::logic_error);
}

BOOST_AUTO_TEST_SUITE_END()
