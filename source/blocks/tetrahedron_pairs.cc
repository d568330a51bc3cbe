// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/tetrahedron_pairs.h>

#include <algorithm>
#include <utility>

namespace quoin
{
  namespace
  {
    using Cells = std::vector<std::array<unsigned int, 4>>;

    constexpr unsigned int none = -1;

    /** Neighbour across the face opposite to each node, or none. Neighbours
        are only among @p n_joined cells that follow one another. */
    std::vector<std::array<unsigned int, 4>>
    neighbours_of(const Cells &cells, const std::size_t n_joined)
    {
      struct Face
      {
        std::array<unsigned int, 3> nodes;
        unsigned int cell, opposite;
      };
      std::vector<Face> faces;
      for (unsigned int c = 0; c < cells.size(); ++c)
        for (unsigned int k = 0; k < 4; ++k)
        {
          Face face{ { cells[c][(k + 1) % 4], cells[c][(k + 2) % 4],
                       cells[c][(k + 3) % 4] },
                     c,
                     k };
          std::sort(face.nodes.begin(), face.nodes.end());
          faces.push_back(face);
        }
      std::sort(faces.begin(), faces.end(),
                [](const Face &a, const Face &b) { return a.nodes < b.nodes; });
      std::vector<std::array<unsigned int, 4>> result(
          cells.size(), { none, none, none, none });
      for (unsigned int f = 0; f + 1 < faces.size(); ++f)
        if (faces[f].nodes == faces[f + 1].nodes
            && faces[f].cell / n_joined == faces[f + 1].cell / n_joined)
        {
          const Face &a = faces[f], &b = faces[f + 1];
          result[a.cell][a.opposite] = b.cell;
          result[b.cell][b.opposite] = a.cell;
        }
      return result;
    }

    /** The cluster of two cells, the second across from node @p opposite of
        the first. */
    TetrahedronCluster join(const Cells &cells, const unsigned int first,
                            const unsigned int opposite,
                            const unsigned int second)
    {
      // Even permutations that make each node the last one.
      constexpr unsigned int last[4][4]
          = { { 3, 2, 1, 0 }, { 0, 2, 3, 1 }, { 0, 3, 1, 2 }, { 0, 1, 2, 3 } };
      TetrahedronCluster pair{ {}, { first, second } };
      const auto &nodes = cells[first];
      for (unsigned int k = 0; k < 4; ++k)
        pair.nodes[k] = nodes[last[opposite][k]];
      pair.nodes[4] = *std::find_if(
          cells[second].begin(), cells[second].end(),
          [&](const unsigned int node) {
            return std::find(nodes.begin(), nodes.end(), node) == nodes.end();
          });
      return pair;
    }
  } // namespace

  TetrahedronPairs pair_tetrahedra(const Cells &cells,
                                   const std::size_t n_joined)
  {
    const auto neighbours = neighbours_of(cells, n_joined);
    std::vector<char> is_free(cells.size(), true);
    const auto n_free_neighbours = [&](const unsigned int cell)
    {
      return std::count_if(neighbours[cell].begin(), neighbours[cell].end(),
                           [&](const unsigned int n)
                           { return n != none && is_free[n]; });
    };

    TetrahedronPairs result;
    std::vector<unsigned int> last_chance; // cells with one free neighbour
    const auto take = [&](const unsigned int cell)
    {
      is_free[cell] = false;
      for (const unsigned int n : neighbours[cell])
        if (n != none && is_free[n] && n_free_neighbours(n) == 1)
          last_chance.push_back(n);
    };
    const auto pair_up = [&](const unsigned int cell)
    {
      if (!is_free[cell])
        return;
      unsigned int best = none;
      for (unsigned int k = 0; k < 4; ++k)
      {
        const unsigned int n = neighbours[cell][k];
        if (n != none && is_free[n]
            && (best == none
                || n_free_neighbours(n)
                       < n_free_neighbours(neighbours[cell][best])))
          best = k;
      }
      take(cell);
      if (best == none)
        result.singles.push_back({ { cells[cell][0], cells[cell][1],
                                     cells[cell][2], cells[cell][3] },
                                   { cell } });
      else
      {
        result.pairs.push_back(join(cells, cell, best, neighbours[cell][best]));
        take(neighbours[cell][best]);
      }
    };
    const auto pair_last_chances = [&]()
    {
      while (!last_chance.empty())
      {
        const unsigned int cell = last_chance.back();
        last_chance.pop_back();
        pair_up(cell);
      }
    };
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
      if (n_free_neighbours(cell) == 1)
        last_chance.push_back(cell);
    pair_last_chances();
    for (unsigned int cell = 0; cell < cells.size(); ++cell)
    {
      pair_up(cell);
      pair_last_chances();
    }
    for (auto *clusters : { &result.pairs, &result.singles })
      std::sort(clusters->begin(), clusters->end(),
                [](const TetrahedronCluster &a, const TetrahedronCluster &b)
                { return a.cells[0] < b.cells[0]; });
    return result;
  }
} // namespace quoin
