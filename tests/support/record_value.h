#pragma once

#include "ephyra/base/record.h"

#include <boost/test/unit_test.hpp>

#include <string>

namespace ephyra::test
{
  /// Value of a column of a record; the test fails where there is none.
  inline double
  value(const Record &record, const std::string &name)
  {
    for (const auto &[column, x] : record.all())
      if (column == name)
        return x;
    BOOST_FAIL("no column " + name);
    return 0.;
  }
} // namespace ephyra::test
