#include "ephyra/base/parameter_reader.h"

#include "ephyra/base/text.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

namespace ephyra
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Path of the first section below @p section that has the entry.
    std::string
    find_elsewhere(const ParameterSection &section, const std::string &entry)
    {
      for (const auto &subsection : section.subsections)
        {
          if (subsection->find_entry(entry) != nullptr)
            return subsection->path();
          const std::string found = find_elsewhere(*subsection, entry);
          if (!found.empty())
            return found;
        }
      return "";
    }

    /// The repeated subsection that "Body left" is an instance of, or nullptr.
    const RepeatedSection *
    find_repeated(const ParameterSection &section, const std::string &name)
    {
      for (const RepeatedSection &repeated : section.repeated)
        if (name == repeated.name ||
            name.compare(0, repeated.name.size() + 1, repeated.name + " ") == 0)
          return &repeated;
      return nullptr;
    }

    /// Names that @p name may be a misspelling of. Of repeated subsections the
    /// instance name is kept: "Bdy left" becomes "Body left".
    std::vector<std::string>
    subsection_candidates(const ParameterSection &section,
                          const std::string      &name)
    {
      std::vector<std::string> candidates;
      for (const auto &subsection : section.subsections)
        if (subsection->instance_of.empty())
          candidates.push_back(subsection->name);
      const std::size_t last = name.rfind(' ');
      const std::string instance =
        last == std::string::npos ? " NAME" : name.substr(last);
      for (const RepeatedSection &repeated : section.repeated)
        candidates.push_back(repeated.name + instance);
      return candidates;
    }

    std::string
    in_section(const ParameterSection &section)
    {
      const std::string path = section.path();
      return path.empty() ? "" : " in " + text::quote(path);
    }
  } // namespace

  ParameterReader::ParameterReader(ParameterSection         &root,
                                   std::vector<std::string> &errors,
                                   MakeInstance              make_instance)
    : root(root)
    , errors(errors)
    , make_instance(std::move(make_instance))
  {
  }

  void
  ParameterReader::read_file(const std::string &file_name)
  {
    read_stream(file_name, "", {&root, true});
  }

  void
  ParameterReader::read_text(const std::string &text, const std::string &origin)
  {
    files.push_back(
      {n_files++, origin, origin, fs::path(origin).parent_path().string()});
    read_statements(parse_parameter_text(text), {&root, true});
    files.pop_back();
  }

  void
  ParameterReader::read_stream(const std::string &file_name,
                               const std::string &mentioned_at,
                               const Cursor       cursor)
  {
    const std::string prefix =
      mentioned_at.empty() ? "" : mentioned_at + ": include: ";
    std::error_code ignored;
    std::ifstream   stream(file_name);
    if (!stream || fs::is_directory(file_name, ignored))
      {
        errors.push_back(
          prefix + "the parameter file " + text::quote(file_name) +
          (fs::is_directory(file_name, ignored) ? " is a folder"
           : fs::exists(file_name, ignored)     ? " cannot be read"
                                                : " does not exist"));
        return;
      }
    const std::string canonical = fs::weakly_canonical(file_name).string();
    for (const File &file : files)
      if (file.canonical == canonical)
        {
          errors.push_back(
            prefix + text::quote(file_name) + " includes itself" +
            (&file == &files.back()
               ? ""
               : " by way of " + text::quote(files.back().name)));
          return;
        }
    std::ostringstream content;
    content << stream.rdbuf();
    const auto statements = parse_parameter_text(content.str());
    if (statements.empty() && mentioned_at.empty())
      errors.push_back("the parameter file " + text::quote(file_name) +
                       " sets nothing; is it the right one?");
    files.push_back({n_files++,
                     file_name,
                     canonical,
                     fs::path(file_name).parent_path().string()});
    read_statements(statements, cursor);
    files.pop_back();
  }

  void
  ParameterReader::read_statements(
    const std::vector<ParameterStatement> &statements, const Cursor cursor)
  {
    using Kind = ParameterStatement::Kind;
    struct Open
    {
      Cursor      cursor;
      std::string name;
      std::string at;
    };
    std::vector<Open> open{{cursor, "", ""}};
    for (const ParameterStatement &statement : statements)
      {
        const std::string at =
          files.back().name + ":" + std::to_string(statement.line);
        const Cursor here = open.back().cursor;
        switch (statement.kind)
          {
          case Kind::subsection:
            open.push_back(
              {open_subsection(statement.name, at, here), statement.name, at});
            break;
          case Kind::set:
            set_entry(statement.name, statement.value, at, here);
            break;
          case Kind::end:
            if (open.size() > 1)
              open.pop_back();
            else
              errors.push_back(at + ": there is no subsection open that "
                                    "this \"end\" could close");
            break;
          case Kind::include:
            read_stream((fs::path(files.back().folder) / statement.name)
                          .lexically_normal()
                          .string(),
                        at,
                        here);
            break;
          case Kind::invalid:
            errors.push_back(at + ": " + statement.value);
            break;
          }
      }
    for (std::size_t i = 1; i < open.size(); ++i)
      errors.push_back(open[i].at + ": subsection " +
                       text::quote(open[i].name) +
                       " is not closed by an \"end\"");
  }

  ParameterReader::Cursor
  ParameterReader::open_subsection(const std::string &name,
                                   const std::string &at,
                                   const Cursor       cursor)
  {
    if (name.empty())
      {
        errors.push_back(at + ": a name must follow \"subsection\"");
        return {nullptr, false};
      }
    if (cursor.section == nullptr)
      return cursor;
    ParameterSection &section = *cursor.section;
    if (ParameterSection *known = section.find_subsection(name))
      return {known, cursor.store};
    if (const RepeatedSection *repeated = find_repeated(section, name))
      {
        if (name == repeated->name)
          errors.push_back(at + ": subsection " + text::quote(name) +
                           " needs a name of its own, such as " +
                           text::quote(name + " one"));
        else if (name.find_first_of("/=") != std::string::npos)
          errors.push_back(at + ": subsection " + text::quote(name) +
                           " must not have \"/\" or \"=\" in its name");
        else if (cursor.store)
          return {&make_instance(section, *repeated, name), true};
        return {nullptr, false};
      }
    const std::vector<std::string> candidates =
      subsection_candidates(section, name);
    errors.push_back(at + ": there is no subsection " + text::quote(name) +
                     in_section(section) + ", " +
                     text::suggestion(name, candidates, "subsections"));
    return {section.find_subsection(text::nearest(name, candidates)), false};
  }

  void
  ParameterReader::set_entry(const std::string &name,
                             const std::string &value,
                             const std::string &at,
                             const Cursor       cursor)
  {
    if (cursor.section == nullptr)
      return;
    const std::string subject =
      at + ": " + cursor.section->path(name) + " = " + text::quote(value);
    ParameterEntry *const entry = cursor.section->find_entry(name);
    if (entry == nullptr)
      {
        errors.push_back(subject + ": " + unknown_entry(*cursor.section, name));
        return;
      }
    const File &file = files.back();
    if (cursor.store)
      {
        const bool same_file = entry->file_id == file.id;
        const bool includer  = std::any_of(
          files.begin(), files.end() - 1, [entry](const File &other) {
            return other.id == entry->file_id;
          });
        if (same_file || includer)
          errors.push_back(subject + ": it is already set at " + entry->origin +
                           (same_file
                              ? ", remove one of the two"
                              : ", set it after the include to change it"));
        entry->file_id = file.id;
        entry->origin  = at;
      }
    set_value(*entry, value, subject, file.folder, cursor.store);
  }

  void
  ParameterReader::set_override(const std::string &assignment)
  {
    const std::string at     = "--set " + text::quote(assignment);
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos)
      {
        errors.push_back(at + ": it is not of the form "
                              "\"Section/Entry = value\"");
        return;
      }
    const std::string value   = text::normalize(assignment.substr(equals + 1));
    ParameterSection *section = &root;
    std::string       path    = assignment.substr(0, equals);
    for (std::size_t slash; (slash = path.find('/')) != std::string::npos;
         path.erase(0, slash + 1))
      {
        const std::string       name = text::normalize(path.substr(0, slash));
        ParameterSection *const next = section->find_subsection(name);
        if (next == nullptr)
          {
            // Only a file opens instances: a misspelt name is no new body.
            std::vector<std::string> candidates;
            for (const auto &subsection : section->subsections)
              candidates.push_back(subsection->name);
            errors.push_back(at + ": there is no subsection " +
                             text::quote(name) + in_section(*section) + ", " +
                             text::suggestion(name, candidates, "subsections"));
            return;
          }
        section = next;
      }
    const std::string     name  = text::normalize(path);
    ParameterEntry *const entry = section->find_entry(name);
    if (entry == nullptr)
      {
        errors.push_back(at + ": " + unknown_entry(*section, name));
        return;
      }
    entry->origin = "--set";
    set_value(*entry, value, at, "", true);
  }

  void
  ParameterReader::set_value(ParameterEntry    &entry,
                             const std::string &value,
                             const std::string &subject,
                             const std::string &folder,
                             const bool         store)
  {
    const std::string resolved = entry.pattern->resolve(value, folder);
    const std::string wrong    = entry.pattern->error(resolved);
    if (!wrong.empty())
      errors.push_back(subject + ": " +
                       (value.empty() ? "the value is missing" : wrong) +
                       "; allowed is " + entry.pattern->description());
    else if (resolved.find('#') != std::string::npos ||
             (!resolved.empty() && resolved.back() == '\\'))
      errors.push_back(subject + ": " + text::quote(resolved) +
                       " has a character that means a comment (#) or a "
                       "continued line (\\) in a parameter file");
    else if (store)
      entry.value = resolved;
  }

  std::string
  ParameterReader::unknown_entry(const ParameterSection &section,
                                 const std::string      &name) const
  {
    const std::string elsewhere = find_elsewhere(root, name);
    return "there is no such entry" +
           (elsewhere.empty()
              ? ", " + text::suggestion(name, section.entry_names(), "entries")
              : " here, but in subsection " + text::quote(elsewhere));
  }
} // namespace ephyra
