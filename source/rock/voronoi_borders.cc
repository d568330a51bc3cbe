// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/rock/joint_traces.h>

#include <boost/polygon/point_data.hpp>
#include <boost/polygon/voronoi.hpp>

#include <cmath>

namespace quoin
{
  namespace
  {
    using Point      = dealii::Point<2>;
    using Site       = boost::polygon::point_data<int>;
    using Voronoi    = boost::polygon::voronoi_diagram<double>;
    using Cell       = Voronoi::cell_type;
    using BorderEdge = Voronoi::edge_type;

    /** Sites are whole numbers below this. */
    constexpr double resolution = 1 << 28;
    /** Sites beyond the box, in block sizes: borders inside are finite. */
    constexpr double margin = 4.;

    /** Middle of the area of @p cell; false if it is not bounded. */
    bool find_centroid(const Cell &cell, double &x, double &y)
    {
      const BorderEdge *first = cell.incident_edge();
      if (first == nullptr)
        return false;
      double twice_area = 0., sum_x = 0., sum_y = 0.;
      const BorderEdge *edge = first;
      do
      {
        if (!edge->is_finite())
          return false;
        const double ax = edge->vertex0()->x(), ay = edge->vertex0()->y();
        const double bx = edge->vertex1()->x(), by = edge->vertex1()->y();
        const double cross = ax * by - ay * bx;
        twice_area += cross;
        sum_x += (ax + bx) * cross;
        sum_y += (ay + by) * cross;
        edge = edge->next();
      } while (edge != first);
      if (!(std::abs(twice_area) > 0.))
        return false;
      x = sum_x / (3. * twice_area);
      y = sum_y / (3. * twice_area);
      return true;
    }
  } // namespace

  std::vector<Piece> voronoi_borders(const std::array<double, 4> &box,
                                     const double block_size,
                                     const unsigned int relaxation,
                                     RandomStream random)
  {
    const double left   = box[0] - margin * block_size;
    const double low    = box[1] - margin * block_size;
    const double width  = box[2] - box[0] + 2. * margin * block_size;
    const double height = box[3] - box[1] + 2. * margin * block_size;
    const double scale  = resolution / std::max(width, height);

    std::vector<Site> sites;
    const auto n = static_cast<std::size_t>(
        std::ceil(width * height / (block_size * block_size)));
    for (std::size_t i = 0; i < n; ++i)
    {
      const double x = random.uniform(), y = random.uniform();
      sites.emplace_back(int(x * width * scale), int(y * height * scale));
    }
    const auto limited = [&](const double value, const double size)
    { return int(std::clamp(value, 0., size * scale)); };

    Voronoi diagram;
    for (unsigned int step = 0;; ++step)
    {
      diagram.clear();
      boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);
      if (step == relaxation)
        break;
      for (const Cell &cell : diagram.cells())
      {
        double x = 0., y = 0.;
        if (find_centroid(cell, x, y))
          sites[cell.source_index()]
              = Site(limited(x, width), limited(y, height));
      }
    }

    std::vector<Piece> borders;
    for (const BorderEdge &edge : diagram.edges())
    {
      if (!edge.is_finite() || &edge > edge.twin())
        continue; // each border once
      const auto point = [&](const Voronoi::vertex_type &v)
      { return Point(left + v.x() / scale, low + v.y() / scale); };
      borders.push_back({ { point(*edge.vertex0()), point(*edge.vertex1()) } });
    }
    return borders;
  }
} // namespace quoin
