// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_redistribution_h
#define quoin_operators_redistribution_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Numbers in the whole mesh of what the entries of a rank's State belong to,
   * independent of the number of ranks. Checkpoints have those of the rank that
   * wrote them; an entry may appear more than once.
   */
  struct EntryNumbers
  {
    using List = std::vector<std::uint64_t>;

    List nodes; /**< local nodes, owned ones first */
    std::uint64_t n_owned_nodes = 0;
    List cells; /**< deformable ones; may be missing if unused */
    /** By name of a slice the numbers for Redistribution::Mover::own(), and by
        edges_of() of that name the edges of this rank. */
    std::map<std::string, List> own;

    static std::string edges_of(const std::string &slice)
    {
      return slice + ", edges";
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &nodes &n_owned_nodes &cells &own;
    }
  };

  /**
   * Assembles the State of this rank (nodes, cells, joints and so on) from
   * those of another number of ranks. They come one at a time; the first rank's
   * comes last, with the entries that only that rank has.
   *
   * Members throw a std::runtime_error if a state does not match its numbers.
   */
  class Redistribution
  {
  public:
    /** @p here: the entries of this rank, also of nodes that others own. */
    Redistribution(EntryNumbers here, bool is_first_rank);

    /** Announces the state of a rank with the entries @p there. */
    void begin_part(const EntryNumbers &there);

    /** Copies to the members of @p to what belongs to this rank from those of
        @p from, of the current part. Both list their members in visit(), by the
        functions of a Mover; @p slice is their name. */
    template <typename Part>
    void take(const std::string &slice, Part &to, Part &from);

    /** Call after the last part; throws if an entry of this rank is missing. */
    void check_complete() const;

  private:
    class Collector;
    class Mover;

    /** Where the entries of this rank are found. */
    struct Places
    {
      /** Numbers and local indices, ascending. */
      std::vector<std::pair<std::uint64_t, unsigned int>> here;
      std::vector<bool> found;
      // The part whose entries are being taken.
      std::size_t n_there = 0;
      std::vector<std::array<unsigned int, 2>> moves; /**< from, to */

      explicit Places(const EntryNumbers::List &numbers = {});
      /** Takes the first @p n_taken of @p n entries. */
      void look_up(const EntryNumbers::List &there, std::size_t n_taken,
                   std::size_t n);
      bool has(std::uint64_t number) const;
    };

    /** Copies @p n numbers for each entry. */
    template <typename Array>
    static void move(const Places &places, Array &to, const Array &from,
                     std::size_t n);

    bool is_first_rank;
    bool is_first_part = true, has_parts = false;
    Places nodes, owned_nodes, cells;
    std::map<std::string, Places> own;
  };

  /** Lists the addresses of the members of a part. */
  class Redistribution::Collector
  {
  public:
    std::vector<void *> members;

    template <typename... Values>
    void same(Values &...values)
    {
      (members.push_back(&values), ...);
    }
    template <typename... Values>
    void sums(Values &...values)
    {
      (members.push_back(&values), ...);
    }
    template <typename Array>
    void nodes(Array &array, const unsigned int = 1)
    {
      members.push_back(&array);
    }
    template <typename Array>
    void owned_nodes(Array &array, const unsigned int = 1)
    {
      members.push_back(&array);
    }
    template <typename Array>
    void cells(Array &array, const unsigned int = 1)
    {
      members.push_back(&array);
    }
    template <typename Array>
    void own(Array &array, const unsigned int = 1, const char * = nullptr)
    {
      members.push_back(&array);
    }
    template <typename Array>
    void between(Array &pairs)
    {
      members.push_back(&pairs);
    }
    template <typename T>
    void joined(std::vector<T> &entries)
    {
      members.push_back(&entries);
    }
    template <typename Item>
    void each(std::vector<Item> &items)
    {
      members.push_back(&items);
      for (Item &item : items)
        item.visit(*this);
    }
  };

  /** Functions by which visit() lists its members. */
  class Redistribution::Mover
  {
  public:
    Mover(Redistribution &all, const std::string &slice,
          const std::vector<void *> &from)
      : all(all), slice(slice), next_member(from.begin())
    {
    }

    /** Values that are the same on all ranks. */
    template <typename... Values>
    void same(Values &...values)
    {
      (assign(values, next(values)), ...);
    }

    /** Values of which each rank has a part; only their sum counts. */
    template <typename... Values>
    void sums(Values &...values)
    {
      (add(values, next(values)), ...);
    }

    /** @p n entries for each local node, those of ghosts as their owner has
        them; or empty. */
    template <typename Array>
    void nodes(Array &array, const unsigned int n = 1)
    {
      move(all.nodes, array, next(array), n);
    }

    /** @p n entries for each node that the rank owns, or empty. */
    template <typename Array>
    void owned_nodes(Array &array, const unsigned int n = 1)
    {
      move(all.owned_nodes, array, next(array), n);
    }

    /** @p n entries for each deformable cell, or empty. */
    template <typename Array>
    void cells(Array &array, const unsigned int n = 1)
    {
      move(all.cells, array, next(array), n);
    }

    /** @p n entries for each number of EntryNumbers::own under the name of the
        slice or @p name, or empty. */
    template <typename Array>
    void own(Array &array, const unsigned int n = 1, const char *name = nullptr)
    {
      move(all.own[name ? name : slice], array, next(array), n);
    }

    /** Pairs of the edges @p lower and @p upper, at least one of them of this
        rank, ascending in both. */
    template <typename Array>
    void between(Array &pairs)
    {
      const Array &from = next(pairs);
      if (all.is_first_part)
        pairs.clear();
      const Places &edges = all.own[EntryNumbers::edges_of(slice)];
      const auto key      = [](const auto &pair) {
        return std::minmax({ pair.lower, pair.upper });
      };
      for (const auto &pair : from)
        if (edges.has(pair.lower) || edges.has(pair.upper))
          pairs.push_back(pair);
      std::sort(pairs.begin(), pairs.end(),
                [&](const auto &a, const auto &b) { return key(a) < key(b); });
      pairs.erase(std::unique(pairs.begin(), pairs.end(),
                              [&](const auto &a, const auto &b)
                              { return key(a) == key(b); }),
                  pairs.end());
    }

    /** Entries of which each rank has a part; it may have all parts, too. */
    template <typename T>
    void joined(std::vector<T> &entries)
    {
      const std::vector<T> &from = next(entries);
      if (all.is_first_part)
        entries.clear();
      entries.insert(entries.begin(), from.begin(), from.end());
    }

    /** Items, as many on all ranks, that have a function visit(). */
    template <typename Item>
    void each(std::vector<Item> &items)
    {
      items.resize(next(items).size());
      for (Item &item : items)
        item.visit(*this);
    }

  private:
    template <typename T>
    T &next(T &)
    {
      return *static_cast<T *>(*next_member++);
    }

    template <typename T>
    static void assign(T &to, const T &from)
    {
      to = from;
    }
    template <typename T, std::size_t n>
    static void assign(T (&to)[n], const T (&from)[n])
    {
      std::copy(from, from + n, to);
    }

    template <typename T>
    void add(T &sum, const T &part) const
    {
      if (all.is_first_part)
        sum = T();
      if (all.is_first_rank)
        sum += part;
    }

    Redistribution &all;
    const std::string &slice;
    std::vector<void *>::const_iterator next_member;
  };

  template <typename Array>
  void Redistribution::move(const Places &places, Array &to, const Array &from,
                            const std::size_t n)
  {
    if (from.empty())
      return;
    if (from.size() != n * places.n_there)
      throw std::runtime_error("it has entries of something unknown");
    to.resize(n * places.here.size());
    for (const auto &[i, j] : places.moves)
      std::copy_n(from.begin() + n * i, n, to.begin() + n * j);
  }

  template <typename Part>
  void Redistribution::take(const std::string &slice, Part &to, Part &from)
  {
    Collector collector;
    from.visit(collector);
    Mover mover(*this, slice, collector.members);
    to.visit(mover);
  }
} // namespace quoin

#endif
