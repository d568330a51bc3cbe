// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/layout/wall_layout.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "wall_names.h"

namespace quoin
{
  namespace
  {

    /** What gmsh is to mesh: a unit, its half, or a cell between columns. */
    struct Piece
    {
      const WallUnit *unit;
      double left;
      double right;
    };

    std::string length_text(const double length)
    {
      std::ostringstream text;
      text.precision(9);
      text << length;
      return text.str();
    }

    class WallWriter
    {
    public:
      WallWriter(const WallParameters &wall, const WallLayout &layout)
        : wall(wall), layout(layout), exact(1e-9 * wall.unit_length)
      {
      }

      GmshGeometry write()
      {
        make_pieces();
        make_points();
        write_head();
        write_points();
        write_beds();
        write_vertical_lines();
        write_surfaces();
        write_mesh();
        text << physical_names(surfaces, curves);
        return { text.str(), { joints.begin(), joints.end() } };
      }

    private:
      void make_pieces();
      void split_at_columns(const std::vector<double> &columns);
      void make_points();
      void write_head();
      void write_points();
      void write_beds();
      void write_vertical_lines();
      void write_surfaces();
      void write_mesh();

      void add_joint(const std::string &name, const unsigned int line)
      {
        if (name.empty())
          return;
        joints.insert(name);
        curves[name].push_back(line);
      }

      void unite(std::vector<double> &x) const
      {
        std::sort(x.begin(), x.end());
        x.erase(std::unique(x.begin(), x.end(),
                            [&](const double a, const double b)
                            { return b - a < exact; }),
                x.end());
      }

      /** Name of the outer vertical side at @p x of a unit. */
      std::string outer_name(const WallUnit &unit, const double x) const
      {
        const std::string side = x < exact                   ? "left"
                                 : x > layout.length - exact ? "right"
                                                             : "opening";
        return unit.kind == WallUnit::slab ? surface_name(unit) + "_" + side
                                           : side;
      }

      /** Index of @p x among the points of @p level. */
      unsigned int column(const unsigned int level, const double x) const
      {
        const auto &all = points[level];
        return std::lower_bound(all.begin(), all.end(), x - exact)
               - all.begin();
      }

      unsigned int point(const unsigned int level, const double x) const
      {
        return first_point[level] + column(level, x);
      }

      /** Number of the line that begins at this point and runs to the right. */
      unsigned int bed_line(const unsigned int level,
                            const unsigned int i) const
      {
        return first_point[level] + i;
      }

      /** The piece of @p row that holds @p x; null outside. */
      const Piece *at(const unsigned int row, const double x) const
      {
        if (row >= rows.size())
          return nullptr;
        for (const Piece &piece : rows[row])
          if (piece.left < x && x < piece.right)
            return &piece;
        return nullptr;
      }

      const WallParameters &wall;
      const WallLayout &layout;
      const double exact;

      std::vector<std::vector<Piece>> rows;
      std::vector<std::vector<double>> points; /**< x by level */
      GmshNumbers first_point;                 /**< first point of each level */
      /** Vertical lines by row: those at x. */
      std::vector<std::map<double, unsigned int>> vertical_lines;
      std::map<std::string, GmshNumbers> curves, surfaces;
      std::set<std::string> joints; /**< joint curves */
      /** Lines by their length, for the number of elements. */
      std::map<std::string, GmshNumbers> lines_of_length;
      std::ostringstream text;
    };

    void WallWriter::make_pieces()
    {
      rows.resize(layout.levels.size() - 1);
      std::vector<double> columns;
      for (const WallUnit &unit : layout.units)
      {
        std::vector<double> x = { unit.left, unit.right };
        if (unit.cracks)
          x.insert(x.begin() + 1, unit.middle());
        for (std::size_t i = 1; i < x.size(); ++i)
          rows[unit.row].push_back({ &unit, x[i - 1], x[i] });
        columns.insert(columns.end(), x.begin(), x.end());
      }
      if (wall.structured)
      {
        unite(columns);
        split_at_columns(columns);
      }
    }

    void WallWriter::split_at_columns(const std::vector<double> &columns)
    {
      for (std::size_t i = 1; i < columns.size(); ++i)
        if (columns[i] - columns[i - 1] < 0.2 * wall.element_size)
          throw InputError(
              "section 'Wall': 'Elements = structured' would need a column of "
              "elements from x = "
              + number_text(columns[i - 1]) + " to " + number_text(columns[i])
              + " m, much narrower than the element size of "
              + number_text(wall.element_size)
              + " m. Take 'Elements = free', or dimensions that fit the bond.");
      for (auto &row : rows)
      {
        std::vector<Piece> cells;
        for (const Piece &piece : row)
          for (std::size_t i = 1; i < columns.size(); ++i)
            if (piece.left < columns[i] - exact
                && columns[i] < piece.right + exact)
              cells.push_back({ piece.unit, columns[i - 1], columns[i] });
        row = cells;
      }
    }

    void WallWriter::make_points()
    {
      points.resize(layout.levels.size());
      unsigned int next = 1;
      for (std::size_t level = 0; level < points.size(); ++level)
      {
        for (std::size_t row = level > 0 ? level - 1 : 0;
             row < std::min(level + 1, rows.size()); ++row)
          for (const Piece &piece : rows[row])
          {
            points[level].push_back(piece.left);
            points[level].push_back(piece.right);
          }
        unite(points[level]);
        first_point.push_back(next);
        next += points[level].size();
      }
    }

    void WallWriter::write_head()
    {
      text.precision(12);
      text << "// A wall, " << layout.length << " m long and " << wall.height()
           << " m high; lengths in metres. Joints have no\n"
              "// thickness: names of physical curves say which lines are "
              "joints.\n\n"
              "DefineConstant[ size = {"
           << wall.element_size
           << ", Name \"Element size\"} ]; // edges are no longer\n\n";
    }

    void WallWriter::write_points()
    {
      for (std::size_t level = 0; level < points.size(); ++level)
        for (std::size_t i = 0; i < points[level].size(); ++i)
          text << "Point(" << first_point[level] + i << ") = {"
               << points[level][i] << ", " << layout.levels[level]
               << ", 0, size};\n";
    }

    void WallWriter::write_beds()
    {
      for (std::size_t level = 0; level < points.size(); ++level)
        for (std::size_t i = 0; i + 1 < points[level].size(); ++i)
        {
          const double left = points[level][i], right = points[level][i + 1];
          const double x     = 0.5 * (left + right);
          const Piece *below = level > 0 ? at(level - 1, x) : nullptr;
          const Piece *above = at(level, x);
          if (below == nullptr && above == nullptr)
            continue;
          const unsigned int line = bed_line(level, i);
          text << "Line(" << line << ") = {" << first_point[level] + i << ", "
               << first_point[level] + i + 1 << "};\n";
          lines_of_length[length_text(right - left)].push_back(line);
          if (below != nullptr && above != nullptr)
            add_joint(joint_name(*below->unit, *above->unit, "bed"), line);
          else
            curves[level == 0                   ? "base"
                   : level == points.size() - 1 ? "top"
                                                : "opening"]
                .push_back(line);
        }
    }

    void WallWriter::write_vertical_lines()
    {
      unsigned int next = first_point.back() + points.back().size();
      vertical_lines.resize(rows.size());
      for (std::size_t row = 0; row < rows.size(); ++row)
      {
        const double height   = layout.levels[row + 1] - layout.levels[row];
        const std::string key = length_text(height);
        std::vector<double> all;
        for (const Piece &piece : rows[row])
        {
          all.push_back(piece.left);
          all.push_back(piece.right);
        }
        unite(all);
        for (const double x : all)
        {
          const Piece *left  = at(row, x - 10. * exact);
          const Piece *right = at(row, x + 10. * exact);
          text << "Line(" << next << ") = {" << point(row, x) << ", "
               << point(row + 1, x) << "};\n";
          lines_of_length[key].push_back(next);
          vertical_lines[row][x] = next;
          if (left == nullptr || right == nullptr)
            curves[outer_name(left == nullptr ? *right->unit : *left->unit, x)]
                .push_back(next);
          else if (left->unit != right->unit)
            add_joint(joint_name(*left->unit, *right->unit, "head"), next);
          else if (left->unit->cracks
                   && std::abs(x - left->unit->middle()) < exact)
            add_joint(with_name("crack", left->unit->part), next);
          ++next;
        }
      }
    }

    void WallWriter::write_surfaces()
    {
      const auto vertical = [&](const unsigned int row, const double x)
      { return vertical_lines[row].lower_bound(x - exact)->second; };
      unsigned int next = 1;
      for (std::size_t row = 0; row < rows.size(); ++row)
        for (const Piece &piece : rows[row])
        {
          text << "Curve Loop(" << next << ") = {";
          for (unsigned int i = column(row, piece.left);
               i < column(row, piece.right); ++i)
            text << bed_line(row, i) << ", ";
          text << vertical(row, piece.right);
          for (unsigned int i = column(row + 1, piece.right);
               i > column(row + 1, piece.left); --i)
            text << ", -" << bed_line(row + 1, i - 1);
          text << ", -" << vertical(row, piece.left) << "};\n"
               << "Plane Surface(" << next << ") = {" << next << "};\n";
          surfaces[surface_name(*piece.unit)].push_back(next);
          ++next;
        }
    }

    void WallWriter::write_mesh()
    {
      if (!wall.structured)
        return;
      // An even number of elements on each side, and alternating diagonals: no
      // direction is preferred, and two triangles meet in each corner.
      for (const auto &[length, lines] : lines_of_length)
        text << "Transfinite Curve " << braces(lines) << " = 2 * Ceil("
             << length << " / size / 2 - 1e-6) + 1;\n";
      text << "Transfinite Surface {:} AlternateLeft;\n";
    }
  } // namespace

  GmshGeometry wall_geometry(const WallParameters &wall,
                             const WallLayout &layout)
  {
    return WallWriter(wall, layout).write();
  }
} // namespace quoin
