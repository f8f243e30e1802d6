#include "ephyra/base/parameter_writer.h"

#include "ephyra/base/text.h"

#include <ostream>
#include <sstream>

namespace ephyra
{
  namespace
  {
    std::string
    indent(const int level)
    {
      return std::string(2 * level, ' ');
    }

    std::string
    assignment(const std::string &name, const std::string &value)
    {
      return "set " + name + " =" + (value.empty() ? "" : " " + value);
    }

    void
    write_values(std::ostream           &out,
                 const ParameterSection &section,
                 const int               level)
    {
      for (const auto &entry : section.entries)
        out << indent(level) << assignment(entry->name, entry->value)
            << (entry->is_default() ? "  # default\n" : "\n");
      for (const auto &subsection : section.subsections)
        {
          std::ostringstream inside;
          write_values(inside, *subsection, level + 1);
          const bool is_instance = !subsection->instance_of.empty();
          if (!inside.str().empty() || is_instance)
            out << indent(level) << "subsection " << subsection->name << '\n'
                << inside.str() << indent(level) << "end\n";
        }
    }

    /// Text in comment lines of at most 80 characters.
    void
    write_comment(std::ostream &out, const std::string &text, const int level)
    {
      const std::string  begin = indent(level) + "#";
      std::string        line  = begin;
      std::istringstream words(text);
      for (std::string word; words >> word;)
        {
          if (line != begin && line.size() + 1 + word.size() > 80)
            {
              out << line << '\n';
              line = begin;
            }
          line += " " + word;
        }
      out << line << '\n';
    }

    std::string
    with_unit(const ParameterEntry &entry)
    {
      // Bare numbers are shown with their unit.
      const std::string unit = entry.pattern->unit();
      const bool        bare = entry.default_value.find_first_not_of(
                          "0123456789.eE+-") == std::string::npos;
      return entry.default_value +
             (bare && !unit.empty() && !entry.default_value.empty() ? " " + unit
                                                                    : "");
    }

    void
    write_as_text(std::ostream           &out,
                  const ParameterSection &section,
                  const int               level)
    {
      for (const auto &entry : section.entries)
        {
          if (!entry->documentation.empty())
            write_comment(out, entry->documentation, level);
          write_comment(
            out, "Allowed: " + entry->pattern->description() + ".", level);
          out << indent(level) << assignment(entry->name, with_unit(*entry))
              << "\n\n";
        }
      for (const auto &subsection : section.subsections)
        if (subsection->instance_of.empty())
          {
            out << indent(level) << "subsection " << subsection->name << '\n';
            write_as_text(out, *subsection, level + 1);
            out << indent(level) << "end\n\n";
          }
      for (const RepeatedSection &repeated : section.repeated)
        {
          ParameterHandler instance;
          repeated.declare(instance);
          write_comment(out,
                        repeated.documentation +
                          " (any number of these, each with a NAME)",
                        level);
          out << indent(level) << "subsection " << repeated.name << " NAME\n";
          std::ostringstream inside;
          instance.write_declarations(inside, ParameterHandler::Format::text);
          std::istringstream lines(inside.str());
          for (std::string line; std::getline(lines, line);)
            out << (line.empty() ? "" : indent(level + 1)) << line << '\n';
          out << indent(level) << "end\n\n";
        }
    }

    /// Bars separate the columns of a table.
    std::string
    cell(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '|' ? std::string("\\|") : std::string(1, c);
      return result;
    }

    void
    write_as_markdown(std::ostream           &out,
                      const ParameterSection &section,
                      const std::string      &path)
    {
      if (!section.entries.empty())
        {
          out << "## " << (path.empty() ? "Outside of subsections" : path)
              << "\n\n| Entry | Default | Unit | Allowed | Meaning |\n"
              << "|---|---|---|---|---|\n";
          for (const auto &entry : section.entries)
            out << "| " << cell(entry->name) << " | "
                << (entry->default_value.empty()
                      ? ""
                      : "`" + cell(entry->default_value) + "`")
                << " | " << cell(entry->pattern->unit()) << " | "
                << cell(entry->pattern->description()) << " | "
                << cell(entry->documentation) << " |\n";
          out << '\n';
        }
      const std::string prefix = path.empty() ? "" : path + "/";
      for (const auto &subsection : section.subsections)
        if (subsection->instance_of.empty())
          write_as_markdown(out, *subsection, prefix + subsection->name);
      for (const RepeatedSection &repeated : section.repeated)
        {
          ParameterHandler instance;
          instance.enter_subsection(prefix + repeated.name + " NAME");
          repeated.declare(instance);
          instance.leave_subsection();
          instance.write_declarations(out, ParameterHandler::Format::markdown);
        }
    }
  } // namespace

  void
  write_parameter_values(std::ostream &out, const ParameterSection &root)
  {
    write_values(out, root, 0);
  }

  void
  write_parameter_declarations(std::ostream                  &out,
                               const ParameterSection        &root,
                               const ParameterHandler::Format format)
  {
    if (format == ParameterHandler::Format::text)
      write_as_text(out, root, 0);
    else
      write_as_markdown(out, root, "");
  }
} // namespace ephyra
