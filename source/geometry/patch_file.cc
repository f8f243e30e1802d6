#include "ephyra/geometry/patch_file.h"

#include "ephyra/base/exceptions.h"

#include <fstream>
#include <sstream>

namespace ephyra::geometry
{
  namespace
  {
    /// Reads the lines of a patch file and keeps what they say.
    class Reader
    {
    public:
      explicit Reader(const std::string &file_name)
        : file_name(file_name)
        , in(file_name)
      {
        EphyraThrowIf(!in,
                      InputError,
                      "The patch file '" << file_name
                                         << "' cannot be opened; check its "
                                            "name and permissions.");
      }

      PatchFile
      read()
      {
        std::string keyword;
        while (next_line() && line >> keyword)
          if (!read_entry(keyword))
            fail("'" + keyword +
                 "' is none of dimension, unit, degree, knots, dry, reversed, "
                 "closed, control_points");
          else if (keyword == "control_points")
            break;
        read_points();
        return result;
      }

    private:
      [[noreturn]] void
      fail(const std::string &message) const
      {
        std::ostringstream text;
        text << file_name << ":" << line_number << ": " << message << ".";
        throw InputError(text.str());
      }

      /// Next line that holds more than a comment.
      bool
      next_line()
      {
        std::string text;
        while (std::getline(in, text))
          {
            ++line_number;
            text = text.substr(0, text.find('#'));
            if (text.find_first_not_of(" \t\r") != std::string::npos)
              {
                line = std::istringstream(text);
                return true;
              }
          }
        return false;
      }

      template <typename T>
      std::vector<T>
      numbers()
      {
        std::vector<T> values;
        T              value;
        while (line >> value)
          values.push_back(value);
        if (!line.eof())
          fail("a number was expected");
        return values;
      }

      bool
      read_entry(const std::string &keyword)
      {
        std::string word;
        if (keyword == "dimension")
          {
            if (!(line >> result.dimension) || result.dimension < 1 ||
                result.dimension > 2)
              fail("the dimension must be 1 or 2");
          }
        else if (keyword == "unit")
          {
            line >> word;
            if (word != "m" && word != "cm" && word != "mm")
              fail("the unit must be m, cm or mm, not '" + word + "'");
            scale = word == "m" ? 1. : word == "cm" ? 1e-2 : 1e-3;
          }
        else if (keyword == "degree")
          degrees = numbers<int>();
        else if (keyword == "knots")
          {
            const std::size_t direction = result.knot_vectors.size();
            if (direction >= degrees.size())
              fail("there are more knot vectors than degrees before them");
            const std::vector<double> knots = numbers<double>();
            try
              {
                result.knot_vectors.emplace_back(degrees[direction], knots);
              }
            catch (const InputError &error)
              {
                std::string reason = error.what();
                reason.pop_back(); // its full stop
                fail(reason);
              }
          }
        else if (keyword == "dry")
          {
            const std::vector<std::string> names{
              "theta1_0", "theta1_1", "theta2_0", "theta2_1"};
            while (line >> word)
              {
                std::size_t k = 0;
                while (k < names.size() && names[k] != word)
                  ++k;
                if (k == names.size())
                  fail("'" + word +
                       "' is no side; sides are theta1_0, theta1_1, theta2_0 "
                       "and theta2_1");
                result.dry.push_back(static_cast<Side>(k));
              }
          }
        else if (keyword == "reversed")
          result.reversed = true;
        else if (keyword == "closed")
          result.closed = true;
        else
          return keyword == "control_points";
        return true;
      }

      void
      read_points()
      {
        if (result.dimension == 0)
          fail("the line 'dimension' is missing");
        if (static_cast<int>(result.knot_vectors.size()) != result.dimension)
          fail("one line 'knots' is needed for each direction");
        std::size_t n = 1;
        for (const splines::KnotVector &knots : result.knot_vectors)
          n *= knots.n_basis();
        while (next_line())
          {
            const std::vector<double> values = numbers<double>();
            if (values.size() != 3)
              fail("a control point is a line 'r y weight'");
            if (!(values[2] > 0.))
              fail("the weight of a control point must be positive");
            result.points.push_back({values[0] * scale, values[1] * scale});
            result.weights.push_back(values[2]);
          }
        if (result.points.size() != n)
          fail("the knot vectors ask for " + std::to_string(n) +
               " control points, but the file holds " +
               std::to_string(result.points.size()));
      }

      const std::string  file_name;
      std::ifstream      in;
      std::istringstream line;
      int                line_number = 0;
      PatchFile          result;
      std::vector<int>   degrees;
      double             scale = 1.;
    };
  } // namespace

  PatchFile
  read_patch_file(const std::string &file_name)
  {
    return Reader(file_name).read();
  }
} // namespace ephyra::geometry
