// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_archive_members_h
#define quoin_base_archive_members_h

#include <boost/serialization/serialization.hpp>

#include <utility>
#include <vector>

namespace quoin
{
  /**
   * Archives the members that a function visit() names, in that order. That
   * function is a part's only list of its members and states for each what its
   * entries belong to; Redistribution is the other visitor, and
   * Redistribution::Mover defines the names.
   */
  template <typename Archive>
  class ArchiveMembers
  {
  public:
    explicit ArchiveMembers(Archive &archive) : archive(archive)
    {
    }

    template <typename... Values>
    void same(Values &...values)
    {
      (archive & ... & values);
    }
    template <typename... Values>
    void sums(Values &...values)
    {
      (archive & ... & values);
    }
    template <typename Array>
    void nodes(Array &array, const unsigned int = 1)
    {
      archive &array;
    }
    template <typename Array>
    void owned_nodes(Array &array, const unsigned int = 1)
    {
      archive &array;
    }
    template <typename Array>
    void cells(Array &array, const unsigned int = 1)
    {
      archive &array;
    }
    template <typename Array>
    void own(Array &array, const unsigned int = 1, const char * = nullptr)
    {
      archive &array;
    }
    template <typename Array>
    void between(Array &pairs)
    {
      archive &pairs;
    }
    template <typename T>
    void joined(std::vector<T> &entries)
    {
      archive &entries;
    }
    template <typename Item>
    void each(std::vector<Item> &items)
    {
      archive &items;
    }

  private:
    Archive &archive;
  };

  /** Archives a part with a function visit(). Boost calls it with this type of
      its version, for which its own serialize() needs a conversion. */
  template <typename Archive, typename Part>
  auto serialize(Archive &archive, Part &part,
                 const boost::serialization::version_type)
      -> decltype(part.visit(std::declval<ArchiveMembers<Archive> &>()))
  {
    ArchiveMembers<Archive> members(archive);
    part.visit(members);
  }
} // namespace quoin

#endif
