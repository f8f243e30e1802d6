#include "ephyra/base/parameter_handler.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_reader.h"
#include "ephyra/base/parameter_writer.h"
#include "ephyra/base/quantity.h"
#include "ephyra/base/text.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace ephyra
{
  namespace
  {
    [[noreturn]] void
    misuse(const std::string &what)
    {
      throw std::logic_error("Parameters: " + what + ".");
    }

    void
    check_name(const std::string &name)
    {
      if (name.empty() || name != text::normalize(name) ||
          name.find_first_of("/=#\\") != std::string::npos)
        misuse(text::quote(name) + " cannot be the name of an entry");
    }

    bool
    any_entry_is_set(const ParameterSection &section)
    {
      return std::any_of(section.entries.begin(),
                         section.entries.end(),
                         [](const auto &e) { return !e->is_default(); }) ||
             std::any_of(section.subsections.begin(),
                         section.subsections.end(),
                         [](const auto &s) { return any_entry_is_set(*s); });
    }
  } // namespace

  struct ParameterHandler::Implementation
  {
    explicit Implementation(ParameterHandler &handler)
      : reader(
          root,
          errors,
          [&handler, this ](ParameterSection & parent,
                            const RepeatedSection &repeated,
                            const std::string     &name) -> auto & {
            ParameterSection &instance   = parent.add_subsection(name);
            instance.instance_of         = repeated.name;
            ParameterSection *const here = std::exchange(current, &instance);
            repeated.declare(handler);
            current = here;
            return instance;
          })
    {
    }

    ParameterEntry &
    entry(const std::string &name) const
    {
      ParameterEntry *const found = current->find_entry(name);
      if (found == nullptr)
        misuse("the entry " + text::quote(current->path(name)) +
               " is not declared");
      return *found;
    }

    ParameterSection         root;
    ParameterSection        *current = &root;
    std::vector<std::string> errors;
    ParameterReader          reader;
  };

  ParameterHandler::ParameterHandler()
    : impl(std::make_unique<Implementation>(*this))
  {
  }

  ParameterHandler::~ParameterHandler() = default;

  // --- declaration --------------------------------------------------------

  void
  ParameterHandler::enter_subsection(const std::string &name)
  {
    ParameterSection *const known = impl->current->find_subsection(name);
    impl->current =
      known != nullptr ? known : &impl->current->add_subsection(name);
  }

  void
  ParameterHandler::leave_subsection()
  {
    if (impl->current == &impl->root)
      misuse("there is no subsection to leave");
    impl->current = const_cast<ParameterSection *>(impl->current->parent);
  }

  void
  ParameterHandler::declare_entry(const std::string           &name,
                                  const std::string           &default_value,
                                  const patterns::PatternBase &pattern,
                                  const std::string           &documentation)
  {
    check_name(name);
    const std::string path = impl->current->path(name);
    if (impl->current->find_entry(name) != nullptr)
      misuse("the entry " + text::quote(path) + " is declared twice");
    const std::string value = pattern.resolve(default_value, "");
    const std::string wrong = pattern.error(value);
    if (!wrong.empty())
      misuse("the default of " + text::quote(path) +
             " is not allowed: " + wrong);
    auto entry           = std::make_unique<ParameterEntry>();
    entry->name          = name;
    entry->default_value = default_value;
    entry->value         = value;
    entry->pattern       = pattern.clone();
    entry->documentation = documentation;
    impl->current->entries.push_back(std::move(entry));
  }

  void
  ParameterHandler::declare_repeated_subsection(
    const std::string                             &name,
    const std::function<void(ParameterHandler &)> &declare,
    const std::string                             &documentation)
  {
    check_name(name);
    for (const RepeatedSection &other : impl->current->repeated)
      if (other.name == name)
        misuse("the repeated subsection " +
               text::quote(impl->current->path(name)) + " is declared twice");
    impl->current->repeated.push_back({name, declare, documentation});
  }

  // --- reading ------------------------------------------------------------

  void
  ParameterHandler::read_file(const std::string &file_name)
  {
    impl->reader.read_file(file_name);
  }

  void
  ParameterHandler::read_text(const std::string &text,
                              const std::string &origin)
  {
    impl->reader.read_text(text, origin);
  }

  void
  ParameterHandler::set_override(const std::string &assignment)
  {
    impl->reader.set_override(assignment);
  }

  void
  ParameterHandler::add_error(const std::string &entry,
                              const std::string &message)
  {
    const ParameterSection *section = impl->current;
    std::string             path    = entry;
    for (std::size_t slash;
         section != nullptr && (slash = path.find('/')) != std::string::npos;
         path.erase(0, slash + 1))
      section = section->find_subsection(path.substr(0, slash));
    const ParameterEntry *const found =
      section == nullptr ? nullptr : section->find_entry(path);
    if (found == nullptr)
      impl->errors.push_back(impl->current->path(entry) + ": " + message);
    else
      impl->errors.push_back(
        (found->origin.empty() ? "default" : found->origin) + ": " +
        section->path(path) + " = " + text::quote(found->value) + ": " +
        message);
  }

  void
  ParameterHandler::throw_errors() const
  {
    constexpr std::size_t    most = 100; // a file of another kind has thousands
    std::vector<std::string> errors;     // each once
    for (const std::string &error : impl->errors)
      if (std::find(errors.begin(), errors.end(), error) == errors.end())
        errors.push_back(error);
    if (errors.empty())
      return;
    std::string message = std::to_string(errors.size()) +
                          (errors.size() == 1 ? " error" : " errors") +
                          " in the parameters:";
    for (std::size_t i = 0; i < std::min(errors.size(), most); ++i)
      message += "\n  " + errors[i];
    if (errors.size() > most)
      message += "\n  and " + std::to_string(errors.size() - most) + " more";
    throw InputError(message);
  }

  // --- values ---------------------------------------------------------------

  double
  ParameterHandler::get_double(const std::string &name) const
  {
    return parse_quantity(get(name)).value;
  }

  int
  ParameterHandler::get_integer(const std::string &name) const
  {
    return std::stoi(get(name));
  }

  bool
  ParameterHandler::get_bool(const std::string &name) const
  {
    const std::string value = get(name);
    return value == "true" || value == "yes";
  }

  std::string
  ParameterHandler::get(const std::string &name) const
  {
    return impl->entry(name).value;
  }

  std::vector<double>
  ParameterHandler::get_double_list(const std::string &name) const
  {
    std::vector<double> values;
    for (const std::string &item : get_list(name))
      values.push_back(parse_quantity(item).value);
    return values;
  }

  std::vector<std::string>
  ParameterHandler::get_list(const std::string &name) const
  {
    return text::split_list(get(name));
  }

  bool
  ParameterHandler::is_set(const std::string &name) const
  {
    return !impl->entry(name).is_default();
  }

  bool
  ParameterHandler::any_is_set(const std::string &subsection) const
  {
    const ParameterSection *const found =
      impl->current->find_subsection(subsection);
    return found != nullptr && any_entry_is_set(*found);
  }

  std::string
  ParameterHandler::origin(const std::string &name) const
  {
    const std::string &origin = impl->entry(name).origin;
    return origin.empty() ? "default" : origin;
  }

  std::vector<std::string>
  ParameterHandler::instances(const std::string &name) const
  {
    std::vector<std::string> names;
    for (const auto &subsection : impl->current->subsections)
      if (subsection->instance_of == name)
        names.push_back(subsection->name.substr(name.size() + 1));
    return names;
  }

  // --- writing --------------------------------------------------------------

  void
  ParameterHandler::write_resolved(std::ostream &out) const
  {
    write_parameter_values(out, impl->root);
  }

  void
  ParameterHandler::write_declarations(std::ostream &out,
                                       const Format  format) const
  {
    write_parameter_declarations(out, impl->root, format);
  }
} // namespace ephyra
