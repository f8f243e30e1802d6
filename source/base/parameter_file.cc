#include "ephyra/base/parameter_file.h"

#include "ephyra/base/text.h"

#include <sstream>

namespace ephyra
{
  namespace
  {
    using Kind = ParameterStatement::Kind;

    const std::string allowed_lines =
      "a line is \"subsection NAME\", \"set ENTRY = VALUE\", \"end\" or "
      "\"include FILE\"";

    /// @p line is normalized and not empty.
    ParameterStatement
    parse_line(const std::string &line, const int number)
    {
      const std::size_t blank = line.find(' ');
      const std::string word  = line.substr(0, blank);
      const std::string rest =
        blank == std::string::npos ? "" : line.substr(blank + 1);
      const auto invalid = [number](const std::string &what) {
        return ParameterStatement{Kind::invalid, number, "", what};
      };
      if (word == "subsection")
        return {Kind::subsection, number, rest, ""};
      if (word == "include")
        return rest.empty()
                 ? invalid("a file name must follow \"include\"")
                 : ParameterStatement{Kind::include, number, rest, ""};
      if (word == "end")
        return rest.empty()
                 ? ParameterStatement{Kind::end, number, "", ""}
                 : invalid("nothing may follow \"end\", but there is " +
                           text::quote(rest));
      if (word == "set")
        {
          const std::size_t equals = rest.find('=');
          const std::string name   = text::normalize(rest.substr(0, equals));
          if (equals == std::string::npos || name.empty())
            return invalid(text::quote(line) +
                           " is not of the form \"set ENTRY = VALUE\"");
          return {
            Kind::set, number, name, text::normalize(rest.substr(equals + 1))};
        }
      const std::string best =
        text::nearest(word, {"subsection", "set", "end", "include"});
      return invalid(text::quote(line) + " is not understood, " +
                     (best.empty()
                        ? allowed_lines
                        : "did you mean " + text::quote(best) + "?"));
    }
  } // namespace

  std::vector<ParameterStatement>
  parse_parameter_text(const std::string &text)
  {
    std::vector<ParameterStatement> statements;
    if (text.find('\0') != std::string::npos)
      {
        statements.push_back({Kind::invalid, 1, "", "this is not a text file"});
        return statements;
      }
    const std::string  mark = "\xEF\xBB\xBF"; // byte order mark of some editors
    std::istringstream stream(text.compare(0, mark.size(), mark) == 0
                                ? text.substr(mark.size())
                                : text);

    std::string joined; // continued lines so far
    int         first = 0, number = 0;
    for (std::string line; std::getline(stream, line);)
      {
        ++number;
        line = text::normalize(line.substr(0, line.find('#')));
        if (joined.empty())
          first = number;
        const bool continued = !line.empty() && line.back() == '\\';
        if (continued)
          line.back() = ' ';
        joined = text::normalize(joined + ' ' + line);
        if (continued && !stream.eof() && stream.peek() != EOF)
          {
            joined += joined.empty() ? " " : "";
            continue;
          }
        if (continued)
          statements.push_back({Kind::invalid,
                                number,
                                "",
                                "the file ends after a backslash, which "
                                "announces a further line"});
        else if (!joined.empty())
          statements.push_back(parse_line(joined, first));
        joined.clear();
      }
    return statements;
  }
} // namespace ephyra
