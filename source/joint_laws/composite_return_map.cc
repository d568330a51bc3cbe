// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_laws/composite_return_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr double eps = std::numeric_limits<double>::epsilon();

    double square(const double x)
    {
      return x * x;
    }

    /**
     * Root of @p f between @p x2, where it is @p f2 <= 0, and @p x1, where it
     * is @p f1 > 0, by inverse quadratic interpolation and bisection
     * (@cite Chandrupatla1997), to a value of at most @p tolerance or until
     * rounding ends it. Never leaves the interval; values may overflow.
     */
    template <typename Function>
    double find_root(const Function &f, double x2, double f2, double x1,
                     double f1, const double tolerance)
    {
      double t = f1 / (f1 - f2);
      if (!(t > 0.01 && t < 0.99))
        t = 0.5;
      for (unsigned int i = 0; i < 200; ++i)
      {
        const double x = x1 + t * (x2 - x1), fx = f(x);
        double x3 = x1, f3 = f1;
        if ((fx > 0.) != (f1 > 0.))
        {
          x3 = x2;
          f3 = f2;
          x2 = x1;
          f2 = f1;
        }
        x1 = x;
        f1 = fx;

        const bool first  = std::abs(f1) <= std::abs(f2);
        const double best = first ? x1 : x2;
        if (std::abs(first ? f1 : f2) <= tolerance)
          return best;
        const double width = std::abs(x2 - x1);
        const double limit = 2. * eps * std::abs(best);
        if (width <= 2. * limit)
          break;

        const double xi  = (x1 - x2) / (x3 - x2);
        const double phi = (f1 - f2) / (f3 - f2);
        t                = 0.5;
        if (phi * phi < xi && (1. - phi) * (1. - phi) < 1. - xi)
          t = f1 / (f2 - f1) * f3 / (f2 - f3)
              + (x3 - x1) / (x2 - x1) * f1 / (f3 - f1) * f2 / (f3 - f2);
        t = std::clamp(t, limit / width, 1. - limit / width);
      }
      return f1 <= 0. ? x1 : x2;
    }

    /**
     * The flow of @p map whose @p excess is zero: its argument is sought
     * between zero and @p high, where the excess is @p f_high > 0, with a
     * @p guess between. If the excess is positive throughout, the flow at
     * zero.
     */
    template <typename Map, typename Excess>
    CompositeFlow find_flow(const Map &map, const Excess &excess,
                            const double guess, double high, double f_high,
                            const double tolerance)
    {
      CompositeFlow flow;
      double at    = -1.;
      const auto f = [&](const double x)
      {
        at   = x;
        flow = map(x);
        return excess(flow);
      };
      double low = guess, f_low = f(guess);
      if (std::abs(f_low) <= tolerance)
        return flow;
      // The slope is near one: a narrow bracket, and a wide one if not.
      const double next = std::clamp(guess - 2. * f_low, 0., high);
      if (f_low > 0.)
      {
        high   = guess;
        f_high = f_low;
        low    = next;
        f_low  = f(low);
        if (f_low > 0. && low > 0.)
        {
          high   = low;
          f_high = f_low;
          low    = 0.;
          f_low  = f(0.);
        }
        if (f_low >= -tolerance)
          return flow;
      }
      else if (next < high)
      {
        const double f_next            = f(next);
        (f_next > 0. ? high : low)     = next;
        (f_next > 0. ? f_high : f_low) = f_next;
      }
      const double x = find_root(f, low, f_low, high, f_high, tolerance);
      return x == at ? flow : map(x);
    }
  } // namespace

  CompositeReturnMap::CompositeReturnMap(const CompositeLaw &law,
                                         const double bond_start,
                                         const double crushing_start,
                                         const double sigma_trial,
                                         const double tau_trial)
    : law(law),
      fade(law.slip_softening() > 0. ? law.dilation_decay / law.slip_softening()
                                     : 0.),
      bond_start(bond_start), crushing_start(crushing_start),
      sigma_trial(sigma_trial), tau_trial(tau_trial)
  {
  }

  CompositeFlow CompositeReturnMap::end() const
  {
    const bool opens = sigma_trial > law.tension * bond_start;
    const bool slips = tau_trial + sigma_trial * law.friction_at(bond_start)
                       > law.cohesion * bond_start;
    CompositeFlow flow;
    if (slips && !opens && law.dilation == 0. && slide(flow))
      return flow;
    if ((opens || slips)
        && (iterate(flow, opens, slips)
            || (opens != slips && iterate(flow, true, true))))
      return flow;
    return crush(flow) ? flow : opened();
  }

  bool CompositeReturnMap::slide(CompositeFlow &flow) const
  {
    const double ks = law.shear_stiffness, softening = law.slip_softening();
    const double most = tolerance(sigma_trial);
    // |tau| + sigma tan(phi) - c = drive - ks slip - loss bond
    const double drive = tau_trial + sigma_trial * law.residual_friction;
    const double loss
        = law.cohesion - sigma_trial * (law.friction - law.residual_friction);
    flow.bond = bond_start;
    for (unsigned int i = 0; i < 10; ++i)
    {
      const double excess = drive - ks * flow.slip - loss * flow.bond;
      if (i > 0 && std::abs(excess) <= most)
      {
        flow.sigma    = sigma_trial;
        flow.tau      = tau_trial - ks * flow.slip;
        flow.crushing = crushing_start;
        return opening_excess(flow) <= most && within_cap(flow);
      }
      const double slope = ks - softening * loss * flow.bond;
      flow.slip += excess / slope;
      if (!(slope > 0. && flow.slip >= 0. && ks * flow.slip <= tau_trial))
        return false;
      flow.bond = bond_start * std::exp(-softening * flow.slip);
    }
    return false;
  }

  bool CompositeReturnMap::crush(CompositeFlow &flow) const
  {
    const CompositeCap &cap = law.cap;
    const double start      = cap.limit(crushing_start);
    const double load       = cap.load(sigma_trial, tau_trial);
    if (!(load > start * start))
      return false;
    const double stiffness = 2. * law.normal_stiffness * cap.normal;
    const double ratio     = 2. * law.shear_stiffness * cap.shear / stiffness;
    const double centre    = -0.5 * cap.offset / cap.normal;
    const auto relax_by    = [&](const double y)
    {
      flow.sigma          = centre + (sigma_trial - centre) / (1. + y);
      flow.tau            = tau_trial / (1. + ratio * y);
      flow.cap            = y / stiffness;
      const double normal = 2. * cap.normal * flow.sigma + cap.offset;
      const double shear  = 2. * cap.shear * flow.tau;
      const double norm   = std::sqrt(normal * normal + shear * shear);
      flow.crushing       = crushing_start + flow.cap * norm;
      return std::array<double, 3>{ { normal, shear, norm } };
    };
    // First guess, right if the cap does not harden, its centre is zero and
    // ks Css = kn Cnn.
    double y         = std::sqrt(load) / start - 1.;
    bool is_accurate = false;
    for (unsigned int i = 0; i < 10 && !is_accurate; ++i)
    {
      const auto [normal, shear, norm] = relax_by(y);
      double slope;
      const double limit  = cap.limit(flow.crushing, slope);
      const double excess = cap.load(flow.sigma, flow.tau) - limit * limit;
      // Derivatives by y.
      const double d_normal = -normal / (1. + y);
      const double d_shear  = -ratio * shear / (1. + ratio * y);
      const double d_load
          = 0.5
            * (normal * d_normal / cap.normal + shear * d_shear / cap.shear);
      const double d_norm = (normal * d_normal + shear * d_shear) / norm;
      const double d_excess
          = d_load - 2. * limit * slope * (norm + y * d_norm) / stiffness;
      if (!(d_excess < steepest_softening * d_load))
        return false;
      const double step = excess / d_excess;
      is_accurate       = step < y
                    && step * step * std::max(norm, stiffness * flow.crushing)
                           <= accurate_step * stiffness * flow.crushing;
      y = step < y ? y - step : 0.25 * y;
    }
    if (!is_accurate)
      return false;
    relax_by(y);
    flow.opening = flow.slip = 0.;
    flow.bond                = bond_start;
    return opening_excess(flow) <= tolerance(0.)
           && slip_excess(flow) <= tolerance(flow.sigma);
  }

  bool CompositeReturnMap::within_cap(const CompositeFlow &flow) const
  {
    // The cap itself needs a root or an exponential: only near it.
    const double load = law.cap.load(flow.sigma, flow.tau);
    return load <= law.cap.lowest_load()
           || load <= square(law.cap.limit(crushing_start));
  }

  bool CompositeReturnMap::iterate(CompositeFlow &flow, const bool opens,
                                   const bool slips) const
  {
    const double kn = law.normal_stiffness, ks = law.shear_stiffness;
    double sigma
        = opens ? std::min(law.tension * bond_start, sigma_trial) : sigma_trial;
    double tau = slips ? std::clamp(law.cohesion * bond_start
                                        - sigma * law.friction_at(bond_start),
                                    0., tau_trial)
                       : tau_trial;
    for (unsigned int i = 0; i < 10; ++i)
    {
      flow              = loosened(sigma, tau);
      const double f1   = opening_excess(flow);
      const double f2   = slip_excess(flow);
      const double most = tolerance(sigma);
      if ((!opens || std::abs(f1) <= most) && (!slips || std::abs(f2) <= most))
        return f1 <= most && f2 <= most && within_cap(flow);

      // Of bond = exp(-root((a dl1)^2 + (b dl2)^2)) by what is left of the
      // trial tractions.
      const double a = law.opening_softening(), b = law.slip_softening();
      const double u = a * flow.opening, v = b * flow.slip;
      const double growth     = std::sqrt(u * u + v * v);
      const double factor     = growth > 0. ? flow.bond / growth : 0.;
      const double bond_sigma = factor * a * u / kn;
      const double bond_tau   = factor * b * v / ks;

      // sigma (1 + A/sigma_u) = sigma* - A with A = kn tan(psi) dl2.
      const double full    = free_dilation(flow.bond);
      const double pressed = flow.sigma < 0. ? 1. / law.dilation_pressure : 0.;
      const double share   = std::max(0., 1. + flow.sigma * pressed);
      const double divisor
          = share > 0. ? 1. + kn * full * flow.slip * pressed : 1.;
      const double by_bond
          = flow.bond > 0. ? kn * fade * full / flow.bond * flow.slip : 0.;
      const double d_sigma = (1. - share * by_bond * bond_sigma) / divisor;
      const double d_tau
          = share * (kn * full / ks - by_bond * bond_tau) / divisor;

      const double f2_bond
          = flow.sigma * (law.friction - law.residual_friction) - law.cohesion;
      const double friction = law.friction_at(flow.bond);
      const double J11      = opens ? d_sigma - law.tension * bond_sigma : 1.;
      const double J12      = opens ? d_tau - law.tension * bond_tau : 0.;
      const double J21 = slips ? friction * d_sigma + f2_bond * bond_sigma : 0.;
      const double J22
          = slips ? 1. + friction * d_tau + f2_bond * bond_tau : 1.;
      const double r1 = opens ? f1 : 0., r2 = slips ? f2 : 0.;
      const double determinant = J11 * J22 - J12 * J21;
      sigma -= (J22 * r1 - J12 * r2) / determinant;
      tau -= (J11 * r2 - J21 * r1) / determinant;
      if (!(sigma <= sigma_trial && tau >= 0. && tau <= tau_trial))
        return false;
    }
    return false;
  }

  CompositeFlow CompositeReturnMap::opened() const
  {
    const CompositeFlow closed = slipped(sigma_trial);
    const double f_closed      = opening_excess(closed);
    if (!(f_closed > tolerance(0.)))
      return closed;
    // The surface of before is near where a small increment ends.
    const double guess = std::min(law.tension * bond_start, sigma_trial);
    return find_flow([this](const double sigma) { return slipped(sigma); },
                     [this](const CompositeFlow &f)
                     { return opening_excess(f); },
                     guess, sigma_trial, f_closed, tolerance(0.));
  }

  CompositeFlow CompositeReturnMap::slipped(const double sigma) const
  {
    const CompositeFlow stuck = crushed(sigma, tau_trial);
    const double f_stuck      = slip_excess(stuck);
    if (!(f_stuck > tolerance(sigma)) || tau_trial == 0.)
      return stuck;
    // Exact if neither strength nor sigma changes. Beyond the apex of the
    // cone no shear is left, and opening has to do the rest.
    const double guess = std::clamp(law.cohesion * bond_start
                                        - sigma * law.friction_at(bond_start),
                                    0., tau_trial);
    return find_flow([this, sigma](const double tau)
                     { return crushed(sigma, tau); },
                     [this](const CompositeFlow &f) { return slip_excess(f); },
                     guess, tau_trial, f_stuck, tolerance(sigma));
  }

  CompositeFlow CompositeReturnMap::loosened(const double sigma,
                                             const double tau) const
  {
    CompositeFlow flow;
    flow.opening   = (sigma_trial - sigma) / law.normal_stiffness;
    flow.slip      = (tau_trial - tau) / law.shear_stiffness;
    const double a = law.opening_softening() * flow.opening;
    const double b = law.slip_softening() * flow.slip;
    flow.bond      = bond_start * std::exp(-std::sqrt(a * a + b * b));
    relax(flow, sigma, tau, 1.);
    return flow;
  }

  CompositeFlow CompositeReturnMap::crushed(const double sigma,
                                            const double tau) const
  {
    CompositeFlow flow = loosened(sigma, tau);
    // The cap itself needs a root or an exponential: only near it.
    if (law.cap.load(flow.sigma, flow.tau) <= law.cap.lowest_load())
      return flow;
    double high = 1., f_high = overload(flow);
    if (!(f_high > 0.))
      return flow;

    const auto f = [&](const double share)
    {
      relax(flow, sigma, tau, share);
      return overload(flow);
    };
    const double limit = law.cap.limit(crushing_start);
    double low = limit / std::sqrt(f_high + limit * limit), f_low = f(low);
    while (f_low > 0. && low > 1e-200)
    {
      high   = low;
      f_high = f_low;
      low *= 0.25;
      f_low = f(low);
    }
    f(find_root(f, low, f_low, high, f_high, 4. * eps * limit * limit));
    return flow;
  }

  void CompositeReturnMap::relax(CompositeFlow &flow, const double sigma,
                                 const double tau, const double share) const
  {
    const double widening
        = law.dilation > 0. && flow.slip > 0.
              ? law.normal_stiffness * free_dilation(flow.bond) * flow.slip
              : 0.;
    const double centre = -0.5 * law.cap.offset / law.cap.normal;
    const double before = share * sigma + (1. - share) * centre;
    const double taken  = share * widening;
    if (before >= taken)
      flow.sigma = before - taken;
    else if (before <= -law.dilation_pressure)
      flow.sigma = before;
    else
      flow.sigma = (before - taken) / (1. + taken / law.dilation_pressure);

    flow.tau      = tau;
    flow.cap      = 0.;
    flow.crushing = crushing_start;
    if (share == 1.)
      return;
    const double ratio = law.shear_stiffness * law.cap.shear
                         / (law.normal_stiffness * law.cap.normal);
    flow.tau = tau * share / (share + ratio * (1. - share));
    flow.cap = (1. / share - 1.) / (2. * law.normal_stiffness * law.cap.normal);
    const double normal = 2. * law.cap.normal * flow.sigma + law.cap.offset;
    const double shear  = 2. * law.cap.shear * flow.tau;
    flow.crushing       = crushing_start
                    + flow.cap * std::sqrt(normal * normal + shear * shear);
  }

  double CompositeReturnMap::opening_excess(const CompositeFlow &flow) const
  {
    return flow.sigma - law.tension * flow.bond;
  }

  double CompositeReturnMap::slip_excess(const CompositeFlow &flow) const
  {
    return flow.tau + flow.sigma * law.friction_at(flow.bond)
           - law.cohesion * flow.bond;
  }

  double CompositeReturnMap::tolerance(const double sigma) const
  {
    return 4. * eps * (law.tension + law.cohesion + std::abs(sigma));
  }

  double CompositeReturnMap::overload(const CompositeFlow &flow) const
  {
    const double limit = law.cap.limit(flow.crushing);
    return law.cap.load(flow.sigma, flow.tau) - limit * limit;
  }

  double CompositeReturnMap::free_dilation(const double bond) const
  {
    return fade > 0. ? law.dilation * std::pow(bond, fade) : law.dilation;
  }

  double CompositeReturnMap::dilation(const CompositeFlow &flow) const
  {
    return free_dilation(flow.bond)
           * std::max(0.,
                      1. + std::min(0., flow.sigma) / law.dilation_pressure);
  }
} // namespace quoin
