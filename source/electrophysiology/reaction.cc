#include "ephyra/electrophysiology/reaction.h"

#include <algorithm>

namespace ephyra::electrophysiology
{
  namespace
  {
    using linear_algebra::NarrowBandSolver;

    /// f of the model in the ranges that are awake, that of sleep elsewhere.
    void
    rate_in_ranges(const IonicModel    &model,
                   const int            n_points,
                   const PointState    &state,
                   std::vector<double> &f)
    {
      int        done   = 0;
      const auto asleep = [&](const int end) {
        for (int i = done; i < end; ++i)
          f[i] = state.awake->rate_asleep(state.v[i]);
      };
      for (const AwakeRanges::Range &range : state.awake->ranges())
        {
          const int begin = range[0];
          asleep(begin);
          model.rate(range[1] - begin,
                     state.v + begin,
                     state.gates + begin,
                     n_points,
                     state.synapse + begin,
                     &f[begin]);
          done = range[1];
        }
      asleep(n_points);
    }

    /// Adds the nodal part of the load: values times int N_i r dL.
    class NodalLoad
    {
    public:
      NodalLoad(const MonodomainOperator &monodomain,
                const IonicModel         &model,
                const NodalCurrents       kind)
        : monodomain(monodomain)
        , model(model)
        , kind(kind)
        , nodal(monodomain.n_unknowns())
        , rest(monodomain.n_unknowns())
        , share(monodomain.n_unknowns())
        , no_synapses(monodomain.n_unknowns(), 0.)
      {
      }

      /// The synapses that the other part of the load sees.
      const double *
      others(const PointState &state) const
      {
        return kind == NodalCurrents::synaptic ? no_synapses.data()
                                               : state.synapse;
      }
      void
      add(const PointState &state, double *load)
      {
        const int n = monodomain.n_unknowns();
        model.rate(n, state.v, state.gates, n, state.synapse, nodal.data());
        std::fill(rest.begin(), rest.end(), 0.);
        if (kind == NodalCurrents::synaptic)
          model.rate(
            n, state.v, state.gates, n, no_synapses.data(), rest.data());
        monodomain.shares(share);
        for (int i = 0; i < n; ++i)
          load[i] += share[i] * (nodal[i] - rest[i]);
      }

    private:
      const MonodomainOperator &monodomain;
      const IonicModel         &model;
      const NodalCurrents       kind;
      std::vector<double>       nodal, rest, share, no_synapses;
    };

    class AtControlCoefficients : public Reaction
    {
    public:
      AtControlCoefficients(const MonodomainOperator &monodomain,
                            const IonicModel         &model,
                            const NodalCurrents       kind)
        : monodomain(monodomain)
        , model(model)
        , kind(kind)
        , nodal(monodomain, model, kind)
        , n_gauss(monodomain.n_gauss_points())
        , v(n_gauss)
        , gates(static_cast<std::size_t>(n_gauss) * model.n_gates())
        , synapse(n_gauss, 0.)
        , f(n_gauss)
      {
      }

      int
      n_points() const override
      {
        return monodomain.n_unknowns();
      }
      void
      to_points(const double *coefficients, double *values) const override
      {
        std::copy(coefficients, coefficients + n_points(), values);
      }
      void
      to_coefficients(const double *values, double *coefficients) const override
      {
        std::copy(values, values + n_points(), coefficients);
      }
      void
      load(const PointState &state, double *load) override
      {
        std::fill(load, load + n_points(), 0.);
        if (kind != NodalCurrents::all)
          interpolated_load(state, load);
        if (kind != NodalCurrents::none)
          nodal.add(state, load);
      }
      void
      metric_changed() override
      {
      }
      const std::vector<double> &
      theta() const override
      {
        return monodomain.greville();
      }

    private:
      void
      interpolated_load(const PointState &state, double *load)
      {
        monodomain.interpolate(state.v, v.data());
        for (int k = 0; k < model.n_gates(); ++k)
          monodomain.interpolate(state.gates + k * n_points(),
                                 &gates[static_cast<std::size_t>(k) * n_gauss]);
        if (model.has_synapses())
          monodomain.interpolate(nodal.others(state), synapse.data());
        model.rate(
          n_gauss, v.data(), gates.data(), n_gauss, synapse.data(), f.data());
        monodomain.integrate(f.data(), load);
      }

      const MonodomainOperator &monodomain;
      const IonicModel         &model;
      const NodalCurrents       kind;
      NodalLoad                 nodal;
      const int                 n_gauss;
      std::vector<double>       v, gates, synapse, f; ///< at Gauss points
    };

    class AtGrevillePoints : public Reaction
    {
    public:
      AtGrevillePoints(const MonodomainOperator &monodomain,
                       const IonicModel         &model,
                       const NodalCurrents       kind)
        : monodomain(monodomain)
        , model(model)
        , kind(kind)
        , nodal(monodomain, model, kind)
        , f(monodomain.n_unknowns())
      {
        collocation.factorize(monodomain.collocation(),
                              "matrix of the Greville points");
      }

      int
      n_points() const override
      {
        return monodomain.n_unknowns();
      }
      void
      to_points(const double *coefficients, double *values) const override
      {
        monodomain.collocation().multiply(coefficients, values);
      }
      void
      to_coefficients(const double *values, double *coefficients) const override
      {
        std::copy(values, values + n_points(), coefficients);
        collocation.solve(coefficients);
      }
      void
      load(const PointState &state, double *load) override
      {
        std::fill(load, load + n_points(), 0.);
        if (kind != NodalCurrents::all)
          {
            PointState interpolated = state;
            interpolated.synapse    = nodal.others(state);
            rate_in_ranges(model, n_points(), interpolated, f);
            collocation.solve(f.data());
            monodomain.consistent_mass().multiply(f.data(), load);
          }
        if (kind != NodalCurrents::none)
          nodal.add(state, load);
      }
      void
      metric_changed() override
      {
      }
      const std::vector<double> &
      theta() const override
      {
        return monodomain.greville();
      }

    private:
      const MonodomainOperator &monodomain;
      const IonicModel         &model;
      const NodalCurrents       kind;
      NodalLoad                 nodal;
      NarrowBandSolver          collocation;
      std::vector<double>       f;
    };

    class AtQuadraturePoints : public Reaction
    {
    public:
      AtQuadraturePoints(const MonodomainOperator &monodomain,
                         const IonicModel         &model)
        : monodomain(monodomain)
        , model(model)
        , n_gauss(monodomain.n_gauss_points())
        , f(n_gauss)
      {
        // Gauss points are kept in the order of interpolate().
        const std::vector<double> &theta = monodomain.gauss_theta();
        const int n_per_element          = monodomain.points_per_element();
        for (int q = 0; q < n_per_element; ++q)
          for (int i = q; i < n_gauss; i += n_per_element)
            point_theta.push_back(theta[i]);
        metric_changed();
      }

      int
      n_points() const override
      {
        return n_gauss;
      }
      void
      to_points(const double *coefficients, double *values) const override
      {
        monodomain.interpolate(coefficients, values);
      }
      void
      to_coefficients(const double *values, double *coefficients) const override
      {
        monodomain.integrate(values, coefficients);
        mass.solve(coefficients);
      }
      void
      load(const PointState &state, double *load) override
      {
        rate_in_ranges(model, n_gauss, state, f);
        monodomain.integrate(f.data(), load);
      }
      void
      metric_changed() override
      {
        mass.factorize(monodomain.consistent_mass(), "mass matrix");
      }
      const std::vector<double> &
      theta() const override
      {
        return point_theta;
      }

    private:
      const MonodomainOperator &monodomain;
      const IonicModel         &model;
      const int                 n_gauss;
      NarrowBandSolver          mass;
      std::vector<double>       point_theta;
      std::vector<double>       f;
    };
  } // namespace

  std::unique_ptr<Reaction>
  make_reaction(const Placement           placement,
                const NodalCurrents       nodal,
                const MonodomainOperator &monodomain,
                const IonicModel         &model)
  {
    switch (placement)
      {
      case Placement::control_coefficients:
        return std::make_unique<AtControlCoefficients>(
          monodomain, model, nodal);
      case Placement::greville_points:
        return std::make_unique<AtGrevillePoints>(monodomain, model, nodal);
      default:
        return std::make_unique<AtQuadraturePoints>(monodomain, model);
      }
  }
} // namespace ephyra::electrophysiology
