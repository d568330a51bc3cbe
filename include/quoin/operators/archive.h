// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_archive_h
#define quoin_operators_archive_h

#include <quoin/base/archive_members.h>
#include <quoin/base/node_record.h>
#include <quoin/operators/redistribution.h>
#include <quoin/operators/state_slices.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/binary_object.hpp>
#include <boost/serialization/split_free.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <type_traits>

// Serialisation of the arrays of a State by Boost as one block of bytes.
// Element by element it would take some hundred times as long; with the padding
// they stay bitwise equal.
namespace boost
{
  namespace serialization
  {
    template <typename Archive, typename T>
    void save(Archive &archive,
              const std::vector<T, quoin::CacheAlignedAllocator<T>> &array,
              const unsigned int)
    {
      static_assert(std::is_trivially_copyable_v<T>,
                    "Only plain data can be copied as bytes.");
      const std::uint64_t n = array.size();
      archive << n;
      if (n > 0)
        archive << make_binary_object(const_cast<T *>(array.data()),
                                      n * sizeof(T));
    }

    template <typename Archive, typename T>
    void load(Archive &archive,
              std::vector<T, quoin::CacheAlignedAllocator<T>> &array,
              const unsigned int)
    {
      std::uint64_t n = 0;
      archive >> n;
      array.resize(n);
      if (n > 0)
        archive >> make_binary_object(array.data(), n * sizeof(T));
    }

    template <typename Archive, typename T>
    void serialize(Archive &archive,
                   std::vector<T, quoin::CacheAlignedAllocator<T>> &array,
                   const unsigned int version)
    {
      split_free(archive, array, version);
    }
  } // namespace serialization
} // namespace boost

namespace quoin
{
  template <typename Slice>
  Slice &StateSlices::add(const std::string &name)
  {
    if (const Slice *slice = find<Slice>(name))
      return const_cast<Slice &>(*slice);
    const auto data = std::make_shared<Slice>();
    entries.push_back(
        { name, &typeid(Slice), data,
          [](const void *slice) -> std::shared_ptr<void> {
            return std::make_shared<Slice>(*static_cast<const Slice *>(slice));
          },
          [](boost::archive::binary_oarchive &archive, const void *slice)
          { archive << *static_cast<const Slice *>(slice); },
          [](boost::archive::binary_iarchive &archive, void *slice)
          { archive >> *static_cast<Slice *>(slice); },
          [](Redistribution &moves, const std::string &name, void *slice,
             void *part)
          {
            moves.take(name, *static_cast<Slice *>(slice),
                       *static_cast<Slice *>(part));
          } });
    return *data;
  }
} // namespace quoin

#endif
