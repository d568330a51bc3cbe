// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/elastodynamics/boundary.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  Eigen::VectorXd Boundary::lengths() const
  {
    Eigen::VectorXd result(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
      result[e] = elements[e].length();
    return result;
  }

  double Boundary::diameter() const
  {
    double square = 0.;
    for (const BoundaryElement &e : elements)
      for (const BoundaryElement &f : elements)
        square = std::max({ square, (e.a - f.a).norm_square(),
                            (e.a - f.b).norm_square(),
                            (e.b - f.b).norm_square() });
    return std::sqrt(square);
  }

  void Boundary::add_curve(const std::vector<dealii::Point<2>> &points,
                           const bool closed)
  {
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      elements.push_back({ points[k], points[k + 1] });
    if (closed)
      elements.push_back({ points.back(), points.front() });
  }

  Boundary Boundary::polygon(const std::vector<dealii::Point<2>> &vertices,
                             const double element_length, const bool exterior)
  {
    std::vector<dealii::Point<2>> points;
    for (std::size_t k = 0; k < vertices.size(); ++k)
    {
      const dealii::Point<2> &a = vertices[k];
      const dealii::Point<2> &b = vertices[(k + 1) % vertices.size()];
      // The small reduction keeps a quotient that should be whole from
      // rounding up.
      const double quotient = (b - a).norm() / element_length;
      const int n = std::max(1, static_cast<int>(std::ceil(quotient - 1e-9)));
      for (int i = 0; i < n; ++i)
        points.push_back(a + (b - a) * (static_cast<double>(i) / n));
    }
    if (exterior)
      std::reverse(points.begin(), points.end());
    Boundary boundary;
    boundary.add_curve(points, true);
    return boundary;
  }

  Boundary Boundary::circle(const dealii::Point<2> &centre, const double radius,
                            const unsigned n, const bool exterior)
  {
    std::vector<dealii::Point<2>> points(n);
    for (unsigned k = 0; k < n; ++k)
    {
      const double angle = (exterior ? -2. : 2.) * constants::pi * k / n;
      points[k]          = centre
                  + radius * dealii::Point<2>(std::cos(angle), std::sin(angle));
    }
    Boundary boundary;
    boundary.add_curve(points, true);
    return boundary;
  }
} // namespace quoin
