#include "ephyra/simulation/window_checks.h"

#include <sstream>

namespace ephyra::simulation
{
  namespace
  {
    const std::string follow_entry = "Fluid/Moving window/Follow";
    const std::string swimmer      = "swimmer";

    /// Adds an error where there is no such body, or it never moves.
    void
    check_followed_body(const Scene &scene, ParameterHandler &prm)
    {
      const std::string &name = scene.fluid.window.follow;
      if (name == swimmer && !scene.rigid_bodies)
        {
          if (!scene.elasticity)
            prm.add_error(follow_entry,
                          "there is no deformable body to follow; add "
                          "elasticity to Scene/Physics, or name a rigid body.");
          return;
        }
      std::string known = scene.elasticity ? swimmer : "";
      for (const auto &body : scene.bodies)
        {
          known += (known.empty() ? "\"" : ", \"") + body.name + "\"";
          if (body.name != name)
            continue;
          if (body.motion == immersed_boundary::RigidBody::Motion::fixed)
            prm.add_error(follow_entry,
                          "the body does not move (Motion = fixed), so that "
                          "the window would not either; follow another one, "
                          "or none.");
          return;
        }
      prm.add_error(follow_entry,
                    "there is no such body in the scene; " +
                      (known.empty() ? "it has none that could be followed."
                                     : "choose " + known + ", or none."));
    }

    void
    check_frames(const Scene &scene, ParameterHandler &prm)
    {
      const auto check = [&prm](const auto &lines, const std::string &section) {
        for (const auto &line : lines)
          if (line.moves)
            prm.add_error(section + " " + line.name + "/Frame",
                          "there is no moving window (Fluid/Moving "
                          "window/Follow is empty); set Frame = fixed.");
      };
      check(scene.flow_sampling.probes, "Flow probe");
      check(scene.flow_sampling.lines, "Flow line");
    }
  } // namespace

  void
  check_window(const Scene                 &scene,
               const fluid::GridLine *const y,
               ParameterHandler            &prm)
  {
    if (!scene.fluid.window.on())
      {
        check_frames(scene, prm);
        return;
      }
    check_followed_body(scene, prm);
    if (y != nullptr && !y->uniform)
      prm.add_error("Fluid/Grid/Axial spacings",
                    "a moving window needs a uniform axial spacing: give one "
                    "value, or leave Fluid/Moving window/Follow empty.");
  }
} // namespace ephyra::simulation
