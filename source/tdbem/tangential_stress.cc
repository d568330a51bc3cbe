// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/tdbem/tangential_stress.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Eigen::Vector2d;

    constexpr unsigned none = -1;

    /** Derivatives at s[0] of Lagrange's polynomials through s[0], ... */
    std::array<double, 3> derivatives(const std::array<double, 3> &s,
                                      const unsigned n)
    {
      if (n < 2)
        return { { 0., 0., 0. } };
      const double a = s[1] - s[0];
      if (n == 2)
        return { { -1. / a, 1. / a, 0. } };
      const double b = s[2] - s[0];
      return { { -1. / a - 1. / b, b / (a * (b - a)), -a / (b * (b - a)) } };
    }
  } // namespace

  TangentialStress::TangentialStress(const Boundary &boundary,
                                     const ElasticMedium &medium)
  {
    const double lambda = medium.lambda(), mu = medium.mu();
    of_traction = lambda / (lambda + 2. * mu);
    of_strain   = 4. * mu * (lambda + mu) / (lambda + 2. * mu);

    const auto &elements = boundary.elements;
    const unsigned n     = unsigned(elements.size());
    std::vector<unsigned> before(n, none), after(n, none);
    for (unsigned e = 0; e < n; ++e)
      for (unsigned f = 0; f < n; ++f)
        if ((elements[e].b - elements[f].a).norm()
            < 1e-9 * (elements[e].length() + elements[f].length()))
        {
          after[e]  = f;
          before[f] = e;
        }
    const auto is_corner = [&](const unsigned e, const unsigned f)
    {
      return elements[e].tangent().dot(elements[f].tangent())
             < std::cos(30.001 * constants::pi / 180.);
    };

    std::vector<Vector2d> places(n);
    for (unsigned e = 0; e < n; ++e)
    {
      double turn = 0., n_turns = 0.;
      const auto add_turn = [&](const unsigned first, const unsigned second)
      {
        if (first == none || second == none || is_corner(first, second))
          return;
        // Positive to the left, where the curve bulges along the normal.
        turn += -std::asin(std::clamp(
            elements[second].tangent().dot(elements[first].normal()), -1., 1.));
        n_turns += 1.;
      };
      add_turn(before[e], e);
      add_turn(e, after[e]);
      places[e] = elements[e].middle();
      if (n_turns > 0.)
        places[e] += elements[e].length() * turn / n_turns / 12.
                     * elements[e].normal();
    }

    for (unsigned e = 0; e < n; ++e)
    {
      const unsigned left = before[e], right = after[e];
      const bool has_left  = left != none && !is_corner(left, e);
      const bool has_right = right != none && !is_corner(e, right);
      // Middles in order of use, with their place along the elements.
      std::array<unsigned, 3> chosen{ { e, e, e } };
      std::array<double, 3> s{};
      unsigned n_chosen = 1;
      const auto choose = [&](const unsigned f, const double place)
      {
        chosen[n_chosen] = f;
        s[n_chosen++]    = place;
      };
      const auto half
          = [&](const unsigned f) { return 0.5 * elements[f].length(); };
      const auto two_on_a_side
          = [&](const std::vector<unsigned> &next, const double sign)
      {
        const unsigned f = next[e];
        double place     = sign * (half(e) + half(f));
        choose(f, place);
        const unsigned g = next[f];
        const bool turn
            = g != none && (sign > 0. ? is_corner(f, g) : is_corner(g, f));
        if (g != none && g != e && !turn)
          choose(g, place + sign * (half(f) + half(g)));
      };
      if (has_left == has_right && left != none && right != none
          && left != right)
      {
        choose(left, -half(left) - half(e));
        choose(right, half(e) + half(right));
      }
      else if (has_right || (right != none && !has_left))
        two_on_a_side(after, 1.);
      else if (left != none)
        two_on_a_side(before, -1.);

      const auto slopes = derivatives(s, n_chosen);
      Vector2d x_prime  = Vector2d::Zero();
      for (unsigned k = 0; k < n_chosen; ++k)
        x_prime += slopes[k] * places[chosen[k]];
      Stencil stencil{ chosen, {} };
      for (unsigned k = 0; k < 3; ++k)
        stencil.weights[k]
            = n_chosen > 1
                  ? Vector2d(slopes[k] / x_prime.squaredNorm() * x_prime)
                  : Vector2d(Vector2d::Zero());
      stencils.push_back(stencil);
      normals.push_back(elements[e].normal());
    }
  }

  Eigen::VectorXd TangentialStress::operator()(const Eigen::VectorXd &u,
                                               const Eigen::VectorXd &p) const
  {
    Eigen::VectorXd stress(stencils.size());
    for (std::size_t e = 0; e < stencils.size(); ++e)
    {
      double strain = 0.;
      for (unsigned k = 0; k < 3; ++k)
        strain += stencils[e].weights[k].dot(
            u.segment<2>(2 * stencils[e].elements[k]));
      stress[e] = of_traction * normals[e].dot(p.segment<2>(2 * e))
                  + of_strain * strain;
    }
    return stress;
  }
} // namespace quoin
