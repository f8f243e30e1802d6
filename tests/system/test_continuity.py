#!/usr/bin/env python3
"""The divergence of the velocity is at round-off after every step: with every
Poisson solver, every kind of side, with and without bodies, on 1 to 4 ranks."""

import itertools
import re

import runs

# max |div v| over max (|v_r|/dr + |v_y|/dy); each cell has some roundings of 1e-16.
ROUND_OFF = 2e-13

SIDES = {
    "closed": {"Lower": "no-slip", "Upper": "free-slip", "Outer": "velocity"},
    "periodic": {"Lower": "periodic", "Upper": "periodic", "Outer": "no-slip"},
    "stream": {"Lower": "velocity", "Upper": "outflow", "Outer": "free-slip"},
    "pipe": {"Lower": "pressure", "Upper": "pressure", "Outer": "no-slip"},
    "suction": {"Lower": "velocity", "Upper": "pressure", "Outer": "free-slip"},
    "spread": {"Lower": "velocity", "Upper": "free-slip", "Outer": "outflow"},
    "open": {"Lower": "velocity", "Upper": "outflow", "Outer": "pressure"},
}
FORMULAS = {
    "Lower velocity": ("Axial velocity = (1 + t)*(1 - s^2)",),
    "Outer velocity": ("Axial velocity = sin(pi*s/2)*(1 + 5*t)",),
    "Lower pressure": ("Pressure = 10*(1 + t)",),
}
BODIES = {
    "no body": "",
    "two bodies": """
        subsection Rigid body sphere
          set Radius   = 0.3
          set Position = 0.7
          set Motion   = free
          set Density  = 2
        end
        subsection Rigid body torus
          set Shape       = torus
          set Ring radius = 0.4
          set Core radius = 0.2
          set Position    = 1.4
          set Motion      = prescribed
          set Velocity    = 3*cos(20*t)
        end""",
}
SPACINGS = {"uniform": "0.0625", "stretched": "0.09, 0.05, 0.08"}


def scene(sides, spacings, bodies, solver, viscous):
    lines = ["subsection Scene", "set Physics = flow" + (", rigid bodies" if bodies else ""),
             "end", "subsection Time", "set Time step = 2 ms", "set Number of steps = 6", "end",
             "subsection Output", "set Progress interval = 0", "end",
             "subsection Fluid", "set Density = 1", "set Viscosity = 0.01",
             f"set Poisson solver = {solver}", f"set Viscous terms = {viscous}",
             "set Initial radial velocity = 0.3*r*(1 - r)*cos(4*y)",
             "subsection Grid", "set Radial breakpoints = 0, 0.6, 1",
             "set Radial spacings = 0.06, 0.06, 0.08",
             "set Axial breakpoints = 0, 1, 2" if "," in spacings
             else "set Axial breakpoints = 0, 2",
             f"set Axial spacings = {spacings}", "end"]
    for side, kind in sides.items():
        lines += [f"subsection {side} boundary", f"set Type = {kind}",
                  *("set " + entry for entry in FORMULAS.get(f"{side} {kind}", ())), "end"]
    return "\n".join([*lines, "end", bodies])


class ContinuityTest(runs.SystemTest):
    def solvers(self):
        text = self.run_program("--parameters").stdout
        allowed = re.search(r"Allowed: one of ([^\n]*)\.\n *set Poisson solver", text).group(1)
        names = re.findall('"([^"]+)"', allowed)
        self.assertIn("eigen", names)
        return [name for name in names if name != "automatic"]

    def test_every_step(self):
        """Each combination once; numbers of ranks and bodies take turns."""
        ranks = itertools.cycle((1, 2, 3, 4, 2, 1, 4, 3, 2))
        having = itertools.cycle(("two bodies", "no body", "two bodies", "no body",
                                  "two bodies"))
        refused, largest = set(), 0
        for (name, sides), (spacing, cells), solver in itertools.product(
                SIDES.items(), SPACINGS.items(), self.solvers()):
            n, bodies = next(ranks), next(having)
            text = BODIES[bodies]
            case = f"{name}, {spacing}, {bodies}, {solver}, {n} ranks"
            with self.subTest(case):
                viscous = "implicit" if n % 2 else "explicit"
                (self.folder / "scene.prm").write_text(
                    scene(sides, cells, text, solver, viscous), encoding="utf-8")
                process = runs.subprocess.run(
                    runs.command("scene.prm", "--output", "run", "--overwrite", "--quiet",
                                 ranks=n), cwd=self.folder, capture_output=True, text=True,
                    stdin=runs.subprocess.DEVNULL, timeout=120, check=False)
                if process.returncode != 0:
                    # No solver is for every grid; what it cannot do it has to refuse.
                    self.assertIn("a periodic flow needs a uniform axial spacing"
                                  if (name, spacing) == ("periodic", "stretched")
                                  else "oisson solver", process.stderr, case)
                    refused.add((name, spacing, solver))
                    continue
                table = self.table("run")
                self.assertEqual(len(table["step [-]"]), 7)
                self.assertGreater(table["CFL number [-]"][-1], 1e-3)
                worst = table["relative divergence [-]"][1:].max()
                largest = max(largest, worst)
                self.assertLess(worst, ROUND_OFF, case)
        print(f"largest relative divergence {largest:.2g}; refused: {sorted(refused)}")
        self.assertLessEqual({spacing for _, spacing, solver in refused if solver == "fft"},
                             {"stretched"})
        # Something solves each of the flows that exist.
        for name, spacing in itertools.product(SIDES, SPACINGS):
            if (name, spacing) != ("periodic", "stretched"):
                self.assertLess(len([r for r in refused if r[:2] == (name, spacing)]),
                                len(self.solvers()), (name, spacing))

    def test_swimmer(self):
        for ranks in (1, 4):
            self.run_scene("swim.prm", f"ranks{ranks}", *runs.sets(Time__Number_of_steps=10),
                           ranks=ranks)
            worst = self.table(f"ranks{ranks}")["relative divergence [-]"][1:].max()
            self.assertLess(worst, ROUND_OFF)


if __name__ == "__main__":
    runs.main()
