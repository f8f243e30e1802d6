#pragma once

#include "ephyra/base/parameter_file.h"
#include "ephyra/base/parameter_tree.h"

#include <functional>
#include <string>
#include <vector>

namespace ephyra
{
  /// Fills a tree of declared parameters from files, texts and command-line
  /// assignments. Whatever is wrong is appended to a list of errors, each of
  /// which names file and line; what follows an error is read on, so that one
  /// run shows them all.
  class ParameterReader
  {
  public:
    /// Makes the instance of a repeated subsection below @p parent and declares
    /// its entries.
    using MakeInstance =
      std::function<ParameterSection &(ParameterSection      &parent,
                                       const RepeatedSection &repeated,
                                       const std::string     &name)>;

    /// Keeps references to @p root and @p errors.
    ParameterReader(ParameterSection         &root,
                    std::vector<std::string> &errors,
                    MakeInstance              make_instance);

    void
    read_file(const std::string &file_name);
    void
    read_text(const std::string &text, const std::string &origin);
    /// "Section/Entry = value".
    void
    set_override(const std::string &assignment);

  private:
    /// Where the reader stands.
    struct Cursor
    {
      ParameterSection *section; ///< nullptr: unknown, contents are skipped
      bool store; ///< false: the section was guessed, values are only checked
    };

    /// A file that is being read.
    struct File
    {
      int         id;
      std::string name;      ///< as shown in messages
      std::string canonical; ///< finds cycles of includes
      std::string folder;
    };

    void
    read_stream(const std::string &file_name,
                const std::string &mentioned_at,
                Cursor             cursor);
    void
    read_statements(const std::vector<ParameterStatement> &statements,
                    Cursor                                 cursor);
    Cursor
    open_subsection(const std::string &name, const std::string &at, Cursor);
    void
    set_entry(const std::string &name,
              const std::string &value,
              const std::string &at,
              Cursor             cursor);
    /// Checks and keeps a value; the entry is known.
    void
    set_value(ParameterEntry    &entry,
              const std::string &value,
              const std::string &subject,
              const std::string &folder,
              bool               store);
    std::string
    unknown_entry(const ParameterSection &section,
                  const std::string      &name) const;

    ParameterSection         &root;
    std::vector<std::string> &errors;
    const MakeInstance        make_instance;
    std::vector<File>         files; ///< the file being read and its includers
    int                       n_files = 0;
  };
} // namespace ephyra
