#include "ephyra/io/pvd_collection.h"

#include "ephyra/base/mpi.h"
#include "ephyra/io/collective.h"
#include "ephyra/io/vtk_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iomanip>
#include <limits>
#include <regex>
#include <sstream>

namespace ephyra::io
{
  namespace
  {
    /// Whether two times are the same but for round-off.
    bool
    same_time(const double a, const double b)
    {
      return std::abs(a - b) <= 1e-10 * std::max(std::abs(a), std::abs(b));
    }

    bool
    later(const double a, const double b)
    {
      return a > b && !same_time(a, b);
    }

    /// Replaces what needs care in file names and in XML.
    std::string
    to_file_name(std::string name)
    {
      for (char &c : name)
        if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
          c = '_';
      return name;
    }

    std::vector<PvdCollection::Entry>
    read_entries(const std::string &file_name)
    {
      static const std::regex pattern(
        "<DataSet timestep=\"([^\"]+)\" part=\"0\" file=\"([^\"]+)\"/>");
      std::vector<PvdCollection::Entry> entries;
      std::ifstream                     in(file_name);
      std::string                       line;
      while (std::getline(in, line))
        {
          std::smatch match;
          if (std::regex_search(line, match, pattern))
            entries.push_back(
              {std::strtod(match[1].str().c_str(), nullptr), match[2].str()});
        }
      return entries;
    }
  } // namespace

  PvdCollection::PvdCollection(const std::string &folder,
                               const std::string &name,
                               const MPI_Comm     comm)
    : folder(folder)
    , name(to_file_name(name))
    , comm(comm)
  {
  }

  void
  PvdCollection::resume(const double time)
  {
    if (mpi::rank(comm) != 0)
      return;
    list.clear();
    for (const Entry &entry : read_entries(folder + "/" + name + ".pvd"))
      if (!later(entry.time, time) &&
          (list.empty() || later(entry.time, list.back().time)))
        list.push_back(entry);
  }

  std::string
  PvdCollection::next_stem(const double time)
  {
    if (!list.empty() && same_time(list.back().time, time))
      list.pop_back();
    char number[16];
    std::snprintf(number, sizeof(number), "%06zu", list.size());
    std::string stem = name + "/" + name + "_" + number;
    mpi::broadcast(stem, comm);
    on_first_rank(comm, [&]() { create_folder(folder + "/" + name); });
    return stem;
  }

  void
  PvdCollection::add(const double time, const std::string &file)
  {
    on_first_rank(comm, [&]() {
      list.push_back({time, file});
      std::ostringstream xml;
      xml << "<?xml version=\"1.0\"?>\n"
          << "<VTKFile type=\"Collection\" version=\"0.1\""
          << " byte_order=\"LittleEndian\">\n<Collection>\n"
          << std::setprecision(std::numeric_limits<double>::max_digits10);
      for (const Entry &entry : list)
        xml << "<DataSet timestep=\"" << entry.time << "\" part=\"0\" file=\""
            << entry.file << "\"/>\n";
      xml << "</Collection>\n</VTKFile>\n";
      replace_file(folder + "/" + name + ".pvd", xml.str());
    });
  }

  void
  PvdCollection::write(const double time, const GridOutput &output)
  {
    const std::string stem = next_stem(time);
    write_flow(folder + "/" + stem, output, comm);
    add(time, stem + ".pvtr");
  }

  void
  PvdCollection::write(const double time, const BezierOutput &output)
  {
    const std::string stem = next_stem(time);
    write_body(folder + "/" + stem, output, comm);
    add(time, stem + ".vtu");
  }

  void
  PvdCollection::write(const double time, const PointOutput &output)
  {
    const std::string stem = next_stem(time);
    write_points(folder + "/" + stem, output, comm);
    add(time, stem + ".vtp");
  }
} // namespace ephyra::io
