// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/operators/archive.h>
#include <quoin/operators/state_slices.h>

#include <stdexcept>

namespace quoin
{
  StateSlices::StateSlices(const StateSlices &other) : entries(other.entries)
  {
    for (Entry &entry : entries)
      entry.data = entry.copy(entry.data.get());
  }

  StateSlices &StateSlices::operator=(const StateSlices &other)
  {
    if (this != &other)
      *this = StateSlices(other);
    return *this;
  }

  void StateSlices::copy_slices(const StateSlices &other)
  {
    for (Entry &entry : entries)
      for (const Entry &from : other.entries)
        if (entry.name == from.name && *entry.type == *from.type)
          entry.data = from.copy(from.data.get());
  }

  void StateSlices::refuse_missing(const std::string_view name)
  {
    throw std::logic_error("No operator has added the slice '"
                           + std::string(name) + "' to the state.");
  }

  void StateSlices::archive_slices(boost::archive::binary_oarchive &archive)
  {
    for (const Entry &entry : entries)
    {
      archive << entry.name;
      entry.save(archive, entry.data.get());
    }
    archive << std::string();
  }

  void StateSlices::archive_slices(boost::archive::binary_iarchive &archive)
  {
    // In the order of the archive: loads of one stage may have added theirs
    // before those of another.
    std::size_t n = 0;
    std::string name;
    for (archive >> name; !name.empty(); archive >> name, ++n)
    {
      const auto entry
          = std::find_if(entries.begin(), entries.end(),
                         [&](const Entry &own) { return own.name == name; });
      if (entry == entries.end())
        boost::serialization::throw_exception(boost::archive::archive_exception(
            boost::archive::archive_exception::unregistered_class,
            name.c_str()));
      entry->load(archive, entry->data.get());
    }
    if (n != entries.size())
      boost::serialization::throw_exception(boost::archive::archive_exception(
          boost::archive::archive_exception::input_stream_error));
  }

  void StateSlices::take_slices(StateSlices &part, Redistribution &moves)
  {
    for (std::size_t i = 0; i < entries.size(); ++i)
      entries[i].take(moves, entries[i].name, entries[i].data.get(),
                      part.entries[i].data.get());
  }
} // namespace quoin
