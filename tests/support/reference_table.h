#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Rows of numbers of a reference file (commas between them); lines that do
/// not begin with a number are skipped.
inline std::vector<std::vector<double>>
read_reference(const std::string &name)
{
  const std::string path =
    std::string(EPHYRA_SOURCE_DIR) + "/tests/verification/reference/" + name;
  std::ifstream in(path);
  if (!in)
    throw std::runtime_error("cannot read " + path);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(in, line);)
    {
      for (char &c : line)
        if (c == ',')
          c = ' ';
      std::istringstream  numbers(line);
      std::vector<double> row;
      for (double x; numbers >> x;)
        row.push_back(x);
      if (!row.empty())
        rows.push_back(row);
    }
  return rows;
}
