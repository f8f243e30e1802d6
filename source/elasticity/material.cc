#include "ephyra/elasticity/material.h"

#include "material_kernel.h"

#include "ephyra/base/exceptions.h"
#include "ephyra/base/parameter_handler.h"

#include <cmath>

namespace ephyra::elasticity
{
  Material
  Material::from_young(const double E, const double nu)
  {
    return from_moduli(E / (2. * (1. + nu)), E / (3. * (1. - 2. * nu)));
  }

  Material
  Material::from_moduli(const double mu, const double kappa)
  {
    Material material;
    material.c10 = 0.5 * mu;
    material.K   = 0.5 * kappa;
    return material;
  }

  void
  Material::declare(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Moduli",
      "c10 and K",
      patterns::Selection("c10 and K|Young and Poisson|shear and bulk"),
      "Which pair of entries below gives the stiffness.");
    prm.declare_entry("c10",
                      "400 Pa",
                      patterns::Positive("Pa"),
                      "Coefficient c10 of the strain energy, eq. (10): half "
                      "the shear modulus.");
    prm.declare_entry("K",
                      "5e4 Pa",
                      patterns::Positive("Pa"),
                      "Coefficient K of the strain energy, eq. (10): half the "
                      "bulk modulus.");
    prm.declare_entry("Young modulus",
                      "2393.6 Pa",
                      patterns::Positive("Pa"),
                      "Young's modulus at small strain.");
    prm.declare_entry(
      "Poisson ratio",
      "0.496",
      patterns::Double("", -1., 0.5, patterns::Double::Bounds::open),
      "Poisson's ratio at small strain, below 0.5.");
    prm.declare_entry("Shear modulus",
                      "800 Pa",
                      patterns::Positive("Pa"),
                      "Shear modulus, 2 c10.");
    prm.declare_entry(
      "Bulk modulus", "1e5 Pa", patterns::Positive("Pa"), "Bulk modulus, 2 K.");
    prm.declare_entry("Small strain",
                      "false",
                      patterns::Bool(),
                      "Linear elasticity with the same moduli; loads act on "
                      "the reference shape.");
  }

  void
  Material::parse(ParameterHandler &prm)
  {
    const std::string moduli = prm.get("Moduli");
    if (moduli == "Young and Poisson")
      *this = from_young(prm.get_double("Young modulus"),
                         prm.get_double("Poisson ratio"));
    else if (moduli == "shear and bulk")
      *this = from_moduli(prm.get_double("Shear modulus"),
                          prm.get_double("Bulk modulus"));
    else
      {
        c10 = prm.get_double("c10");
        K   = prm.get_double("K");
      }
    small_strain = prm.get_bool("Small strain");

    const std::pair<std::string, std::string> used[] = {
      {"c10 and K", "c10"},
      {"c10 and K", "K"},
      {"Young and Poisson", "Young modulus"},
      {"Young and Poisson", "Poisson ratio"},
      {"shear and bulk", "Shear modulus"},
      {"shear and bulk", "Bulk modulus"}};
    for (const auto &[pair, entry] : used)
      if (prm.is_set(entry) && pair != moduli)
        prm.add_error(entry,
                      "is given but not used, because Moduli is \"" + moduli +
                        "\"; set Moduli = " + pair + " or remove the entry");
  }

  double
  determinant(const AxisymmetricTensor &F)
  {
    return (F[0] * F[3] - F[1] * F[2]) * F[4];
  }

  MaterialPoint
  evaluate(const Material &material, const AxisymmetricTensor &F)
  {
    MaterialPoint            out;
    internal::TangentEntries t;
    auto                    &P = out.stress;
    if (material.small_strain)
      {
        const double mu    = material.shear_modulus();
        const double kappa = material.bulk_modulus();
        internal::linear_elastic(mu,
                                 kappa,
                                 F[0],
                                 F[1],
                                 F[2],
                                 F[3],
                                 F[4],
                                 P[0],
                                 P[1],
                                 P[2],
                                 P[3],
                                 P[4],
                                 t);
        out.energy = 0.5 * (P[0] * (F[0] - 1.) + P[3] * (F[3] - 1.) +
                            P[4] * (F[4] - 1.) + P[1] * (F[1] + F[2]));
      }
    else
      {
        const double J    = determinant(F);
        const double root = std::cbrt(J);
        const double i    = 1. / (root * root);
        internal::neo_hookean(material.c10,
                              material.K,
                              i,
                              F[0],
                              F[1],
                              F[2],
                              F[3],
                              F[4],
                              2. * material.K * (J - 1.),
                              P[0],
                              P[1],
                              P[2],
                              P[3],
                              P[4],
                              t);
        double I1 = 0;
        for (const double f : F)
          I1 += f * f;
        out.energy =
          material.c10 * (I1 * i - 3.) + material.K * (J - 1.) * (J - 1.);
      }

    out.tangent = {t.rr00, t.rr01, t.ry00, t.ry01, t.hr0, //
                   t.rr01, t.rr11, t.ry10, t.ry11, t.hr1, //
                   t.ry00, t.ry10, t.yy00, t.yy01, t.hy0, //
                   t.ry01, t.ry11, t.yy01, t.yy11, t.hy1, //
                   t.hr0,  t.hr1,  t.hy0,  t.hy1,  t.hh};
    return out;
  }

  AxisymmetricTensor
  cauchy_stress(const Material &material, const AxisymmetricTensor &F)
  {
    const AxisymmetricTensor P = evaluate(material, F).stress;
    if (material.small_strain)
      return P;
    const double j = 1. / determinant(F);
    return {j * (P[0] * F[0] + P[1] * F[1]),
            j * (P[0] * F[2] + P[1] * F[3]),
            j * (P[2] * F[0] + P[3] * F[1]),
            j * (P[2] * F[2] + P[3] * F[3]),
            j * P[4] * F[4]};
  }
} // namespace ephyra::elasticity
