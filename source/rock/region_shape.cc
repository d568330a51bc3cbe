// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/rock/region_shape.h>

#include <algorithm>
#include <array>

namespace quoin
{
  namespace
  {
    using Point = dealii::Point<2>;

    enum class RegionShape
    {
      polygon,
      circle,
      arch
    };
  } // namespace

  /** "x, y; x, y; ..." */
  Polygon read_points(const ParameterSection &section, const std::string &name,
                      const std::size_t at_least)
  {
    Polygon points;
    for (const auto &row :
         number_rows(section, name, 2,
                     "must be points x, y [m], separated by semicolons, "
                     "such as '0, 0; 10, 0; 10, 5'."))
      points.emplace_back(row[0], row[1]);
    if (points.size() < at_least)
      section.fail(name, "needs at least " + std::to_string(at_least)
                             + " points x, y, separated by semicolons.");
    return points;
  }

  void check_polygon(const ParameterSection &section, const std::string &name,
                     const Polygon &polygon)
  {
    if (!is_simple(polygon) || signed_area(polygon) == 0.)
      section.fail(name, "must be the corners of a polygon with an area "
                         "whose sides do not cross or touch.");
  }

  void enter_region_shape(ParameterEntries &entries, Polygon &polygon)
  {
    RegionShape shape = RegionShape::polygon;
    entries.choice(
        "Shape", shape,
        { { "polygon", RegionShape::polygon },
          { "circle", RegionShape::circle },
          { "arch", RegionShape::arch } },
        "Shape of the region. polygon: given by its corners; circle: a "
        "polygon with corners on a circle; arch: a tunnel section with "
        "floor, walls and a roof that is an arc of a circle.");
    const ParameterSection *section = entries.read_section();
    std::array<double, 2> centre{};
    double radius = 0., width = 0., height = 0., rise = 0.;
    unsigned int n = 24;
    if (entries.reads_if(shape == RegionShape::polygon))
      entries.other("Points", "",
                    "Corners of the polygon as x, y; x, y; ... [m]",
                    [&](const ParameterSection &from)
                    {
                      polygon = read_points(from, "Points", 3);
                      check_polygon(from, "Points", polygon);
                    });
    entries.numbers(
        "Centre", centre,
        "Centre x, y of the circle, or of the floor of the arch [m]");
    if (entries.reads_if(shape == RegionShape::circle))
      entries.positive("Radius", radius, "Radius of the circle [m]");
    if (entries.reads_if(shape == RegionShape::arch))
    {
      entries.positive("Width", width, "Width of the arch-shaped section [m]");
      entries.nonnegative("Wall height", height,
                          "Height of the walls below the roof arch [m]");
      entries.within("Rise", rise, 0., 0.5 * width,
                     "Rise of the roof arch above the walls, at most half of "
                     "the width [m]");
      if (section && height + rise == 0.)
        section->fail("Wall height", "and 'Rise' must not both be zero.");
    }
    entries.integer("Corners", n, 3,
                    "Number of corners of the polygon that stands for the "
                    "circle, or of chords of the roof arch [-]",
                    10000);
    const Point middle(centre[0], centre[1]);
    if (section && shape == RegionShape::circle)
      polygon = circle_polygon(middle, radius, n);
    if (section && shape == RegionShape::arch)
      polygon = arch_polygon(middle, width, height, rise, n);
    if (section && signed_area(polygon) < 0.)
      std::reverse(polygon.begin(), polygon.end());
  }
} // namespace quoin
