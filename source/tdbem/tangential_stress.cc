// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/base/constants.h>
#include <quoin/tdbem/tangential_stress.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {

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

    /** Which elements come before and after each of them. */
    class Neighbours
    {
    public:
      explicit Neighbours(const std::vector<BoundaryElement> &elements)
        : before(elements.size(), none), after(elements.size(), none),
          elements(elements)
      {
        for (unsigned e = 0; e < elements.size(); ++e)
          for (unsigned f = 0; f < elements.size(); ++f)
            if ((elements[e].b - elements[f].a).norm()
                < 1e-9 * (elements[e].length() + elements[f].length()))
            {
              after[e]  = f;
              before[f] = e;
            }
      }

      bool is_corner(const unsigned e, const unsigned f) const
      {
        return elements[e].tangent() * elements[f].tangent()
               < std::cos(30.001 * constants::degree);
      }

      /** Neighbouring elements, or none. */
      std::vector<unsigned> before, after;

    private:
      const std::vector<BoundaryElement> &elements;
    };

    /** Where the middle of element @p e is on the curve that the elements
        stand for. */
    dealii::Point<2>
    place_on_curve(const std::vector<BoundaryElement> &elements,
                   const Neighbours &neighbours, const unsigned e)
    {
      double turn = 0., n_turns = 0.;
      const auto add_turn = [&](const unsigned first, const unsigned second)
      {
        if (first == none || second == none
            || neighbours.is_corner(first, second))
          return;
        // Positive to the left, where the curve bulges along the normal.
        turn += -std::asin(std::clamp(
            elements[second].tangent() * elements[first].normal(), -1., 1.));
        n_turns += 1.;
      };
      add_turn(neighbours.before[e], e);
      add_turn(e, neighbours.after[e]);
      dealii::Point<2> place = elements[e].middle();
      if (n_turns > 0.)
        place += elements[e].length() * turn / n_turns / 12.
                 * elements[e].normal();
      return place;
    }

    /** Up to three elements, the first one that of the derivative, and where
        their middles are along the elements. */
    struct Chosen
    {
      std::array<unsigned, 3> elements;
      std::array<double, 3> s{};
      unsigned n = 1;

      void add(const unsigned element, const double place)
      {
        elements[n] = element;
        s[n++]      = place;
      }
    };

    /** Neighbours on both sides, or two on one side: not across a corner if
        that can be avoided. */
    Chosen choose(const std::vector<BoundaryElement> &elements,
                  const Neighbours &neighbours, const unsigned e)
    {
      const unsigned left = neighbours.before[e], right = neighbours.after[e];
      const bool has_left  = left != none && !neighbours.is_corner(left, e);
      const bool has_right = right != none && !neighbours.is_corner(e, right);
      Chosen chosen{ { { e, e, e } } };
      const auto half
          = [&](const unsigned f) { return 0.5 * elements[f].length(); };
      const auto two_on_a_side
          = [&](const std::vector<unsigned> &next, const double sign)
      {
        const unsigned f = next[e];
        double place     = sign * (half(e) + half(f));
        chosen.add(f, place);
        const unsigned g = next[f];
        const bool turn  = g != none
                          && (sign > 0. ? neighbours.is_corner(f, g)
                                        : neighbours.is_corner(g, f));
        if (g != none && g != e && !turn)
          chosen.add(g, place + sign * (half(f) + half(g)));
      };
      if (has_left == has_right && left != none && right != none
          && left != right)
      {
        chosen.add(left, -half(left) - half(e));
        chosen.add(right, half(e) + half(right));
      }
      else if (has_right || (right != none && !has_left))
        two_on_a_side(neighbours.after, 1.);
      else if (left != none)
        two_on_a_side(neighbours.before, -1.);
      return chosen;
    }
  } // namespace

  TangentialStress::TangentialStress(const Boundary &boundary,
                                     const ElasticMedium &medium)
  {
    const double lambda = medium.lambda(), mu = medium.mu();
    of_traction = lambda / (lambda + 2. * mu);
    of_strain   = 4. * mu * (lambda + mu) / (lambda + 2. * mu);

    const auto &elements = boundary.elements;
    const Neighbours neighbours(elements);
    std::vector<dealii::Point<2>> places;
    for (unsigned e = 0; e < elements.size(); ++e)
      places.push_back(place_on_curve(elements, neighbours, e));

    for (unsigned e = 0; e < elements.size(); ++e)
    {
      const Chosen chosen = choose(elements, neighbours, e);
      const auto slopes   = derivatives(chosen.s, chosen.n);
      dealii::Tensor<1, 2> x_prime;
      for (unsigned k = 0; k < chosen.n; ++k)
        x_prime += slopes[k] * places[chosen.elements[k]];
      Stencil stencil{ chosen.elements, {} };
      for (unsigned k = 0; k < 3; ++k)
        if (chosen.n > 1)
          stencil.weights[k] = slopes[k] / x_prime.norm_square() * x_prime;
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
        strain
            += stencils[e].weights[k] * vector_at(u, stencils[e].elements[k]);
      stress[e]
          = of_traction * (normals[e] * vector_at(p, e)) + of_strain * strain;
    }
    return stress;
  }
} // namespace quoin
