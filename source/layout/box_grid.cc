// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/box_grid.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <unordered_map>

namespace quoin
{
  namespace
  {
    /** The bricks of a grid: planes of the grid and between them. */
    struct FinePlanes
    {
      std::vector<double> x;            /**< [m] */
      std::vector<unsigned int> begins; /**< the first one of each cell */

      FinePlanes(const std::vector<double> &planes, const double size)
      {
        for (std::size_t i = 0; i + 1 < planes.size(); ++i)
        {
          const double width = planes[i + 1] - planes[i];
          const auto n       = static_cast<unsigned int>(
              std::max(1., std::ceil(width / size - 1e-6)));
          begins.push_back(x.size());
          for (unsigned int k = 0; k < n; ++k)
            x.push_back(planes[i] + width * k / n);
        }
        begins.push_back(x.size());
        x.push_back(planes.back());
      }
    };

    using Corner = std::array<unsigned int, 3>; /**< fine planes in x, y, z */

    bool is_even(const Corner &corner)
    {
      return (corner[0] + corner[1] + corner[2]) % 2 == 0;
    }

    /** Collects nodes and elements, and writes them. */
    class MeshText
    {
    public:
      explicit MeshText(const std::array<FinePlanes, 3> &fine) : fine(fine)
      {
      }

      /** Five tetrahedra: one joins the even corners, the others cut off the
          odd ones, so that the next brick has the same diagonals. */
      void add_brick(const Corner &low, const std::string &name);

      /** Two triangles on the side of the brick at @p low normal to @p axis,
          along the diagonal between even corners. */
      void add_side(const Corner &low, unsigned int axis,
                    const std::string &name);

      std::string text() const;

    private:
      struct Element
      {
        unsigned int name;
        std::array<unsigned int, 4> nodes; /**< the first three of a triangle */
      };
      /** Elements and physical names of one dimension. */
      struct Part
      {
        std::vector<std::string> names;
        std::unordered_map<std::string, unsigned int> numbers;
        std::vector<Element> elements;

        unsigned int number(const std::string &name)
        {
          const auto [place, is_new] = numbers.emplace(name, names.size() + 1);
          if (is_new)
            names.push_back(name);
          return place->second;
        }
      };

      unsigned int node(const Corner &corner);
      static void append(const Part &part, unsigned int dim,
                         unsigned int &number, std::string &text);

      const std::array<FinePlanes, 3> &fine;
      std::unordered_map<std::uint64_t, unsigned int> node_of;
      std::vector<Corner> nodes;
      Part volumes, surfaces;
    };

    unsigned int MeshText::node(const Corner &corner)
    {
      const std::uint64_t key
          = (std::uint64_t(corner[2]) * fine[1].x.size() + corner[1])
                * fine[0].x.size()
            + corner[0];
      const auto [place, is_new] = node_of.emplace(key, nodes.size() + 1);
      if (is_new)
        nodes.push_back(corner);
      return place->second;
    }

    void MeshText::add_brick(const Corner &low, const std::string &name)
    {
      const unsigned int number = volumes.number(name);
      const auto corner         = [&](const unsigned int bits) -> Corner
      {
        return { { low[0] + (bits & 1), low[1] + (bits >> 1 & 1),
                   low[2] + (bits >> 2 & 1) } };
      };
      // Bits of the corners of the middle one, in positive order, and those
      // of the others, if the corner at low is even; if not, the opposite in x.
      const unsigned int flip = is_even(low) ? 0 : 1;
      constexpr std::array<std::array<unsigned int, 4>, 5> corners
          = { { { { 0, 3, 6, 5 } },
                { { 0, 1, 3, 5 } },
                { { 0, 2, 6, 3 } },
                { { 0, 4, 5, 6 } },
                { { 3, 6, 5, 7 } } } };
      for (std::array<unsigned int, 4> tetrahedron : corners)
      {
        for (unsigned int &v : tetrahedron)
          v = node(corner(v ^ flip));
        if (flip == 1)
          std::swap(tetrahedron[0], tetrahedron[1]);
        volumes.elements.push_back({ number, tetrahedron });
      }
    }

    void MeshText::add_side(const Corner &low, const unsigned int axis,
                            const std::string &name)
    {
      const unsigned int number = surfaces.number(name);
      std::array<Corner, 4> around{ { low, low, low, low } };
      const unsigned int first = (axis + 1) % 3, second = (axis + 2) % 3;
      ++around[1][first];
      ++around[2][first];
      ++around[2][second];
      ++around[3][second];
      if (!is_even(low))
        std::rotate(around.begin(), around.begin() + 1, around.end());
      const std::array<unsigned int, 4> n{
        { node(around[0]), node(around[1]), node(around[2]), node(around[3]) }
      };
      surfaces.elements.push_back({ number, { { n[0], n[1], n[2], 0 } } });
      surfaces.elements.push_back({ number, { { n[0], n[2], n[3], 0 } } });
    }

    void MeshText::append(const Part &part, const unsigned int dim,
                          unsigned int &number, std::string &text)
    {
      for (const Element &element : part.elements)
      {
        const std::string name = std::to_string(element.name);
        text += std::to_string(number++) + (dim == 3 ? " 4 2 " : " 2 2 ") + name
                + " " + name;
        for (unsigned int i = 0; i < dim + 1; ++i)
          text += " " + std::to_string(element.nodes[i]);
        text += "\n";
      }
    }

    std::string MeshText::text() const
    {
      std::string text
          = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
            + std::to_string(volumes.names.size() + surfaces.names.size())
            + "\n";
      for (const Part *part : { &surfaces, &volumes })
        for (std::size_t i = 0; i < part->names.size(); ++i)
          text += std::string(part == &volumes ? "3 " : "2 ")
                  + std::to_string(i + 1) + " \"" + part->names[i] + "\"\n";
      text += "$EndPhysicalNames\n$Nodes\n" + std::to_string(nodes.size())
              + "\n";
      std::array<char, 128> line;
      for (std::size_t i = 0; i < nodes.size(); ++i)
      {
        std::snprintf(line.data(), line.size(), "%zu %.12g %.12g %.12g\n",
                      i + 1, fine[0].x[nodes[i][0]], fine[1].x[nodes[i][1]],
                      fine[2].x[nodes[i][2]]);
        text += line.data();
      }
      text += "$EndNodes\n$Elements\n"
              + std::to_string(volumes.elements.size()
                               + surfaces.elements.size())
              + "\n";
      unsigned int number = 1;
      append(surfaces, 2, number, text);
      append(volumes, 3, number, text);
      return text + "$EndElements\n";
    }
  } // namespace

  BoxGrid::BoxGrid(const std::vector<Box> &boxes,
                   const std::array<std::vector<double>, 3> &cuts,
                   const double exact)
    : planes_of(cuts), exact(exact)
  {
    std::size_t n_cells = 1;
    for (unsigned int d = 0; d < 3; ++d)
    {
      std::vector<double> &x = planes_of[d];
      for (const Box &box : boxes)
      {
        x.push_back(box.low[d]);
        x.push_back(box.high[d]);
      }
      std::sort(x.begin(), x.end());
      x.erase(std::unique(x.begin(), x.end(),
                          [&](const double a, const double b)
                          { return b - a < exact; }),
              x.end());
      n_cells *= x.size() - 1;
    }
    box_of.assign(n_cells, -1);
    const std::size_t nx = planes_of[0].size() - 1;
    const std::size_t ny = planes_of[1].size() - 1;
    for (std::size_t b = 0; b < boxes.size(); ++b)
    {
      Cell low, high;
      for (unsigned int d = 0; d < 3; ++d)
      {
        low[d]  = plane(d, boxes[b].low[d]);
        high[d] = plane(d, boxes[b].high[d]);
      }
      for (unsigned int k = low[2]; k < high[2]; ++k)
        for (unsigned int j = low[1]; j < high[1]; ++j)
          for (unsigned int i = low[0]; i < high[0]; ++i)
            box_of[(k * ny + j) * nx + i] = b;
    }
  }

  unsigned int BoxGrid::plane(const unsigned int axis, const double x) const
  {
    const auto &all = planes_of[axis];
    return std::lower_bound(all.begin(), all.end(), x - exact) - all.begin();
  }

  int BoxGrid::box_at(const Cell &cell) const
  {
    // What lies before the first cell wraps to a number beyond the last.
    for (unsigned int d = 0; d < 3; ++d)
      if (cell[d] >= planes_of[d].size() - 1)
        return -1;
    return box_of[(std::size_t(cell[2]) * (planes_of[1].size() - 1) + cell[1])
                      * (planes_of[0].size() - 1)
                  + cell[0]];
  }

  std::string
  BoxGrid::mesh(const double element_size,
                const std::function<std::string(unsigned int)> &box_name,
                const std::function<std::string(const Face &)> &face_name) const
  {
    const std::array<FinePlanes, 3> fine{ { { planes_of[0], element_size },
                                            { planes_of[1], element_size },
                                            { planes_of[2], element_size } } };
    MeshText made(fine);
    // Calls add(corner) for the bricks of a cell, or for those at its lower
    // side normal to axis, if that is below 3.
    const auto over_bricks
        = [&](const Cell &cell, const unsigned int axis, const auto &add)
    {
      Corner end;
      for (unsigned int d = 0; d < 3; ++d)
        end[d] = d == axis ? fine[d].begins[cell[d]] + 1
                           : fine[d].begins[cell[d] + 1];
      for (unsigned int k = fine[2].begins[cell[2]]; k < end[2]; ++k)
        for (unsigned int j = fine[1].begins[cell[1]]; j < end[1]; ++j)
          for (unsigned int i = fine[0].begins[cell[0]]; i < end[0]; ++i)
            add(Corner{ { i, j, k } });
    };
    for (unsigned int k = 0; k < planes_of[2].size(); ++k)
      for (unsigned int j = 0; j < planes_of[1].size(); ++j)
        for (unsigned int i = 0; i < planes_of[0].size(); ++i)
        {
          const Cell cell{ { i, j, k } };
          const int box = box_at(cell);
          if (box >= 0)
            over_bricks(cell, 3,
                        [&](const Corner &corner)
                        { made.add_brick(corner, box_name(box)); });
          for (unsigned int axis = 0; axis < 3; ++axis)
          {
            Cell before = cell;
            --before[axis];
            const int below = box_at(before);
            if (box < 0 && below < 0)
              continue;
            const std::string name = face_name({ axis, cell, below, box });
            if (!name.empty())
              over_bricks(cell, axis,
                          [&](const Corner &corner)
                          { made.add_side(corner, axis, name); });
          }
        }
    return made.text();
  }
} // namespace quoin
