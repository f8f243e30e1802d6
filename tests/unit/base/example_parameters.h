#pragma once

// A small scene, and what is wrong with a text that sets it.
#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <string>

namespace ephyra::testing
{
  inline void
  declare_body(ParameterHandler &prm)
  {
    prm.declare_entry("Density",
                      "1100",
                      patterns::Positive("kg/m^3"),
                      "Mass density of the body.");
    ParameterHandler::Section motion(prm, "Motion");
    prm.declare_entry("Type", "fixed", patterns::Selection("fixed|free"), "");
  }

  inline void
  declare(ParameterHandler &prm)
  {
    prm.declare_entry(
      "End time", "1 s", patterns::Positive("s"), "When to end.");
    {
      ParameterHandler::Section section(prm, "Fluid");
      prm.declare_entry("Density", "1000", patterns::Positive("kg/m^3"), "");
      prm.declare_entry(
        "Viscosity", "1 mPa s", patterns::Double("Pa s", 0), "");
      prm.declare_entry("Convection", "true", patterns::Bool(), "");
      ParameterHandler::Section grid(prm, "Grid");
      prm.declare_entry("Cells", "16", patterns::Integer(1, 1000), "");
      prm.declare_entry("Sizes",
                        "1 mm, 2 mm",
                        patterns::List(patterns::Positive("m"), 1, 3),
                        "");
    }
    prm.declare_repeated_subsection("Body", declare_body, "A body.");
  }

  struct Handler : ParameterHandler
  {
    Handler()
    {
      declare(*this);
    }

    /// The message for a text, or "".
    std::string
    errors() const
    {
      try
        {
          throw_errors();
        }
      catch (const InputError &error)
        {
          return error.what();
        }
      return "";
    }
  };

  inline std::string
  errors_of(const std::string &text)
  {
    Handler prm;
    prm.read_text(text, "a.prm");
    return prm.errors();
  }

  inline const std::string one = "1 error in the parameters:\n  a.prm:";
} // namespace ephyra::testing
