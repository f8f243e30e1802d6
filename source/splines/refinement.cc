#include "ephyra/splines/refinement.h"

#include "ephyra/base/exceptions.h"

#include <algorithm>

namespace ephyra::splines
{
  namespace
  {
    /// Inserts one knot into knots and rows, in place.
    void
    insert_knot(const double         x,
                const int            p,
                const int            width,
                std::vector<double> &knots,
                std::vector<double> &rows)
    {
      // Span k with knots[k] <= x < knots[k + 1].
      const int k =
        static_cast<int>(std::upper_bound(knots.begin(), knots.end(), x) -
                         knots.begin()) -
        1;
      int multiplicity = 0;
      while (knots[k - multiplicity] == x)
        ++multiplicity;
      EphyraThrowIf(multiplicity >= p,
                    InputError,
                    "Knot " << x << " cannot be inserted once more: it occurs "
                            << multiplicity << " times already at degree " << p
                            << ".");
      const int last = k - multiplicity; // its control point is doubled
      rows.insert(rows.begin() + static_cast<long>(last) * width, width, 0.);
      std::copy_n(rows.begin() + static_cast<long>(last + 1) * width,
                  width,
                  rows.begin() + static_cast<long>(last) * width);
      for (int i = last; i > k - p; --i)
        {
          const double  a    = (x - knots[i]) / (knots[i + p] - knots[i]);
          double       *to   = &rows[static_cast<std::size_t>(i) * width];
          const double *from = &rows[static_cast<std::size_t>(i - 1) * width];
          for (int c = 0; c < width; ++c)
            to[c] = a * to[c] + (1. - a) * from[c];
        }
      knots.insert(knots.begin() + k + 1, x);
    }
  } // namespace

  void
  polar_form(const KnotVector          &knots,
             const int                  span,
             const std::vector<double> &arguments,
             const int                  width,
             std::vector<double>       &coefficients)
  {
    const int                  p = knots.degree();
    const std::vector<double> &u = knots.knots();
    for (int level = 1; level <= p; ++level)
      for (int i = p; i >= level; --i)
        {
          const int    j = span - p + i;
          const double a =
            (arguments[level - 1] - u[j]) / (u[j + p - level + 1] - u[j]);
          for (int c = 0; c < width; ++c)
            coefficients[i * width + c] =
              a * coefficients[i * width + c] +
              (1. - a) * coefficients[(i - 1) * width + c];
        }
  }

  SplineRows
  insert_knots(SplineRows spline, std::vector<double> new_knots)
  {
    const int           p     = spline.knots.degree();
    std::vector<double> knots = spline.knots.knots();
    for (const double x : new_knots)
      {
        EphyraThrowIf(!(x > 0. && x < 1.),
                      InputError,
                      "Knot " << x
                              << " cannot be inserted: new knots lie between 0 "
                                 "and 1.");
        insert_knot(x, p, spline.width, knots, spline.rows);
      }
    spline.knots = KnotVector(p, std::move(knots));
    return spline;
  }

  SplineRows
  elevate_degree(const SplineRows &spline, const int times)
  {
    EphyraThrowIf(times < 0,
                  InputError,
                  "A degree can only be raised, not changed by " << times
                                                                 << ".");
    const int                  p     = spline.knots.degree();
    const int                  q     = p + times;
    const int                  width = spline.width;
    const std::vector<double> &old   = spline.knots.knots();

    std::vector<double> knots;
    for (std::size_t i = 0; i < old.size(); ++i)
      {
        knots.push_back(old[i]);
        if (i + 1 == old.size() || old[i + 1] > old[i])
          knots.insert(knots.end(), times, old[i]);
      }
    SplineRows result{KnotVector(q, knots), {}, width};
    const int  n = result.knots.n_basis();
    result.rows.assign(static_cast<std::size_t>(n) * width, 0.);

    std::vector<double> arguments(p), work;
    std::vector<bool>   chosen(q);
    for (int i = 0; i < n; ++i)
      {
        // The element in the middle of the support: least extrapolation.
        const int lowest  = spline.knots.element_of(knots[i]);
        int       highest = spline.knots.element_of(knots[i + q + 1]);
        if (knots[i + q + 1] == spline.knots.breaks()[highest])
          --highest;
        const int span = spline.knots.first_basis((lowest + highest) / 2) + p;

        std::fill(chosen.begin(), chosen.end(), false);
        std::fill_n(chosen.begin(), p, true);
        int n_choices = 0;
        do
          {
            arguments.clear();
            for (int j = 0; j < q; ++j)
              if (chosen[j])
                arguments.push_back(knots[i + 1 + j]);
            work.assign(
              spline.rows.begin() + static_cast<long>(span - p) * width,
              spline.rows.begin() + static_cast<long>(span + 1) * width);
            polar_form(spline.knots, span, arguments, width, work);
            for (int c = 0; c < width; ++c)
              result.rows[static_cast<std::size_t>(i) * width + c] +=
                work[p * width + c];
            ++n_choices;
          }
        while (std::prev_permutation(chosen.begin(), chosen.end()));
        for (int c = 0; c < width; ++c)
          result.rows[static_cast<std::size_t>(i) * width + c] /= n_choices;
      }
    return result;
  }

  std::vector<double>
  splitting_knots(const KnotVector &knots, const int n_parts)
  {
    EphyraThrowIf(n_parts < 1,
                  InputError,
                  "Elements cannot be cut into " << n_parts << " parts.");
    std::vector<double> result;
    for (int e = 0; e < knots.n_elements(); ++e)
      {
        const double from = knots.breaks()[e], to = knots.breaks()[e + 1];
        for (int k = 1; k < n_parts; ++k)
          result.push_back(from + (to - from) * k / n_parts);
      }
    return result;
  }
} // namespace ephyra::splines
