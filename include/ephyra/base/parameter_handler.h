#pragma once

#include "ephyra/base/patterns.h"

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace ephyra
{
  /// Reads parameter files in deal.II's `.prm` syntax, strictly.
  ///
  ///   # comment            include other.prm
  ///   subsection Fluid
  ///     set Density = 1000 kg/m^3
  ///   end
  ///
  /// Long lines continue after a backslash. Classes declare their entries
  /// (default, pattern with unit, text) before a file is read; reading checks
  /// everything and collects *all* errors, each with file, line, key, value,
  /// what is allowed and the nearest valid key, and throws one InputError that
  /// lists them. Numbers come back in SI units.
  ///
  /// A subsection can be declared as repeatable: `subsection Body left` and
  /// `subsection Body right` then are two instances of "Body" with the same
  /// entries (deal.II has no such thing; scenes with several bodies, probes
  /// and sides need it).
  class ParameterHandler
  {
  public:
    ParameterHandler();
    ~ParameterHandler();

    // --- declaration ------------------------------------------------------
    void
    enter_subsection(const std::string &name);
    void
    leave_subsection();

    /// Enters a subsection for a scope.
    class Section
    {
    public:
      Section(ParameterHandler &prm, const std::string &name)
        : prm(prm)
      {
        prm.enter_subsection(name);
      }
      ~Section()
      {
        prm.leave_subsection();
      }
      Section(const Section &) = delete;
      Section &
      operator=(const Section &) = delete;

    private:
      ParameterHandler &prm;
    };

    void
    declare_entry(const std::string           &name,
                  const std::string           &default_value,
                  const patterns::PatternBase &pattern,
                  const std::string           &documentation);

    /// Declares `subsection NAME instance` for any instance name that a file
    /// chooses; @p declare declares the entries of one instance.
    void
    declare_repeated_subsection(
      const std::string                             &name,
      const std::function<void(ParameterHandler &)> &declare,
      const std::string                             &documentation);

    // --- reading ----------------------------------------------------------
    /// Parses a file; errors are collected, not thrown.
    void
    read_file(const std::string &file_name);
    void
    read_text(const std::string &text, const std::string &origin);
    /// "Section/Subsection/Entry = value"; errors are collected.
    void
    set_override(const std::string &assignment);
    /// An error found by a cross-check: points at an entry (path from the
    /// current subsection), with what is wrong and what would be right.
    void
    add_error(const std::string &entry, const std::string &message);
    /// Throws an InputError that lists all errors collected so far, if any.
    void
    throw_errors() const;

    // --- values (of the current subsection) -------------------------------
    double
    get_double(const std::string &name) const; ///< SI
    int
    get_integer(const std::string &name) const;
    bool
    get_bool(const std::string &name) const;
    std::string
    get(const std::string &name) const;
    std::vector<double>
    get_double_list(const std::string &name) const; ///< SI
    std::vector<std::string>
    get_list(const std::string &name) const;
    /// Whether a file or an override has set the entry to something else than
    /// its default. (A resolved file sets every entry.)
    bool
    is_set(const std::string &name) const;
    /// Whether any entry of a subsection, or of one in it, is_set().
    bool
    any_is_set(const std::string &subsection) const;
    /// "file:line" of where the entry was set, or "default".
    std::string
    origin(const std::string &name) const;
    /// Instance names ("left") of a repeated subsection, in the order of the file;
    /// enter one by enter_subsection("Body left").
    std::vector<std::string>
    instances(const std::string &name) const;

    // --- writing ----------------------------------------------------------
    /// All entries with their values: a file that reproduces the run.
    void
    write_resolved(std::ostream &out) const;
    /// Every entry with default, unit, pattern and text.
    enum class Format
    {
      text,
      markdown
    };
    void
    write_declarations(std::ostream &out, Format format) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> impl;
  };
} // namespace ephyra
