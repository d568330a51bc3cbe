// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/blocks/triangle_strips.h>

#include <algorithm>
#include <utility>

namespace quoin
{
  namespace
  {
    constexpr unsigned int none = StripEntry::no_cell;

    /**
     * Triangles are numbered within the members, nodes within the nodes of the
     * members.
     */
    class StripBuilder
    {
    public:
      StripBuilder(const std::vector<std::array<unsigned int, 3>> &cells,
                   const std::vector<unsigned int> &members)
        : members(members), used(members.size(), 0),
          visited_by(members.size(), 0)
      {
        number_nodes(cells);
        find_triangles_around_nodes();
        find_neighbours();
        free_neighbours.resize(members.size(), 0);
        for (unsigned int t = 0; t < triangles.size(); ++t)
          for (const unsigned int other : neighbours[t])
            free_neighbours[t] += (other != none);
        // The first cells are pushed last, as they should come out first.
        for (unsigned int t = triangles.size(); t-- > 0;)
          waiting[free_neighbours[t]].push_back(t);
      }

      std::vector<StripEntry> run(StripStatistics *statistics)
      {
        sequence.reserve(members.size() + members.size() / 4);
        std::size_t n_strips = 0;
        std::size_t n_turns  = 0;
        for (unsigned int start = next_start(); start != none;
             start              = next_start())
        {
          ++n_strips;
          Run run = best_run_from(start);
          emit(run.a, none);
          emit(run.b, none);
          unsigned int last = follow(run);
          while (best_run_around(last, run))
          {
            ++n_turns;
            emit(run.b, none);
            last = follow(run);
          }
        }
        if (statistics != nullptr)
        {
          statistics->n_cells += members.size();
          statistics->n_strips += n_strips;
          statistics->n_turns += n_turns;
        }
        return std::move(sequence);
      }

    private:
      /** A path along triangles, with the nodes of the first one in order. */
      struct Run
      {
        unsigned int triangle;
        unsigned int a, b, c;
      };

      void number_nodes(const std::vector<std::array<unsigned int, 3>> &cells)
      {
        for (const unsigned int m : members)
          node_names.insert(node_names.end(), cells[m].begin(), cells[m].end());
        std::sort(node_names.begin(), node_names.end());
        node_names.erase(std::unique(node_names.begin(), node_names.end()),
                         node_names.end());
        triangles.reserve(members.size());
        for (const unsigned int m : members)
        {
          std::array<unsigned int, 3> nodes;
          for (unsigned int i = 0; i < 3; ++i)
            nodes[i] = std::lower_bound(node_names.begin(), node_names.end(),
                                        cells[m][i])
                       - node_names.begin();
          triangles.push_back(nodes);
        }
      }

      void find_triangles_around_nodes()
      {
        first_around.assign(node_names.size() + 1, 0);
        for (const auto &nodes : triangles)
          for (const unsigned int node : nodes)
            ++first_around[node + 1];
        for (std::size_t node = 0; node < node_names.size(); ++node)
          first_around[node + 1] += first_around[node];
        around.resize(3 * triangles.size());
        auto next = first_around;
        for (unsigned int t = 0; t < triangles.size(); ++t)
          for (const unsigned int node : triangles[t])
            around[next[node]++] = t;
      }

      /** neighbours[t][i] is the triangle across the edge opposite corner i. */
      void find_neighbours()
      {
        neighbours.assign(triangles.size(), { none, none, none });
        for (unsigned int t = 0; t < triangles.size(); ++t)
          for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = triangles[t][(i + 1) % 3];
            const unsigned int b = triangles[t][(i + 2) % 3];
            for (unsigned int k = first_around[a]; k < first_around[a + 1]; ++k)
            {
              const auto &other = triangles[around[k]];
              if (around[k] != t
                  && (other[0] == b || other[1] == b || other[2] == b))
                neighbours[t][i] = around[k];
            }
          }
      }

      unsigned int next_start()
      {
        for (unsigned int n = 0; n < 4;)
          if (waiting[n].empty())
            ++n;
          else
          {
            const unsigned int t = waiting[n].back();
            waiting[n].pop_back();
            if (!used[t] && free_neighbours[t] == n)
              return t;
          }
        return none;
      }

      /** Moves on across the edge of the two last nodes; false at the end. */
      template <typename IsFree>
      bool advance(Run &run, const IsFree &is_free) const
      {
        const auto &here = triangles[run.triangle];
        const unsigned int corner
            = here[0] == run.a ? 0 : (here[1] == run.a ? 1 : 2);
        const unsigned int next = neighbours[run.triangle][corner];
        if (next == none || !is_free(next))
          return false;
        const auto &nodes    = triangles[next];
        const unsigned int d = nodes[0] + nodes[1] + nodes[2] - run.b - run.c;
        run                  = { next, run.b, run.c, d };
        return true;
      }

      unsigned int length(Run run)
      {
        ++stamp;
        visited_by[run.triangle] = stamp;
        unsigned int n           = 1;
        while (advance(run, [this](const unsigned int t)
                       { return !used[t] && visited_by[t] != stamp; }))
        {
          visited_by[run.triangle] = stamp;
          ++n;
        }
        return n;
      }

      Run best_run_from(const unsigned int t)
      {
        Run best{ t, 0, 0, 0 };
        unsigned int best_length = 0;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 1; j < 3; ++j)
          {
            const Run run{ t, triangles[t][i], triangles[t][(i + j) % 3],
                           triangles[t][(i + 3 - j) % 3] };
            const unsigned int n = length(run);
            if (n > best_length)
            {
              best        = run;
              best_length = n;
            }
          }
        return best;
      }

      /** Finds the longest path from @p node; false if all around is used. */
      bool best_run_around(const unsigned int node, Run &best)
      {
        unsigned int best_length = 0;
        for (unsigned int k = first_around[node]; k < first_around[node + 1];
             ++k)
        {
          const unsigned int t = around[k];
          if (used[t])
            continue;
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 1; j < 3 && triangles[t][i] == node; ++j)
            {
              const Run run{ t, node, triangles[t][(i + j) % 3],
                             triangles[t][(i + 3 - j) % 3] };
              const unsigned int n = length(run);
              if (n > best_length)
              {
                best        = run;
                best_length = n;
              }
            }
        }
        return best_length > 0;
      }

      /** Takes a run's triangles and returns its last node. */
      unsigned int follow(Run run)
      {
        do
        {
          take(run.triangle);
          emit(run.c, run.triangle);
        } while (
            advance(run, [this](const unsigned int t) { return !used[t]; }));
        return run.c;
      }

      void take(const unsigned int t)
      {
        used[t] = 1;
        for (const unsigned int other : neighbours[t])
          if (other != none && !used[other])
            waiting[--free_neighbours[other]].push_back(other);
      }

      void emit(const unsigned int node, const unsigned int t)
      {
        sequence.push_back(
            { node_names[node], t == none ? StripEntry::no_cell : members[t] });
      }

      const std::vector<unsigned int> &members;
      std::vector<unsigned int> node_names;
      std::vector<std::array<unsigned int, 3>> triangles;
      std::vector<std::array<unsigned int, 3>> neighbours;
      std::vector<unsigned int> first_around;
      std::vector<unsigned int> around;
      std::vector<unsigned char> used;
      std::vector<unsigned char> free_neighbours;
      std::vector<unsigned int> visited_by;
      std::vector<unsigned int> waiting[4];
      std::vector<StripEntry> sequence;
      unsigned int stamp = 0;
    };
  } // namespace

  std::vector<StripEntry>
  make_strips(const std::vector<std::array<unsigned int, 3>> &cells,
              const std::vector<unsigned int> &members,
              StripStatistics *statistics)
  {
    return StripBuilder(cells, members).run(statistics);
  }
} // namespace quoin
