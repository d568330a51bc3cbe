// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_state_slices_h
#define quoin_operators_state_slices_h

#include <boost/archive/archive_exception.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

namespace boost
{
  namespace archive
  {
    class binary_iarchive;
    class binary_oarchive;
  } // namespace archive
} // namespace boost

namespace quoin
{
  class Redistribution;

  /**
   * Plain structs that operators keep in a State, each under a name. A slice is
   * declared in the module that uses it; it is copied and archived with the
   * State.
   *
   * A struct of which a State has one carries its name as
   * @c Slice::slice_name; loads, of which there may be several, give their
   * own. A slice lists its members in a function visit(), which says what their
   * entries belong to: see Redistribution. add() needs archive.h; the other
   * members do not.
   */
  class StateSlices
  {
  public:
    StateSlices() = default;
    StateSlices(const StateSlices &other);
    StateSlices(StateSlices &&) = default;
    StateSlices &operator=(const StateSlices &other);
    StateSlices &operator=(StateSlices &&) = default;

    /** The slice @p name, added unless it exists; see archive.h. */
    template <typename Slice>
    Slice &add(const std::string &name);
    template <typename Slice>
    Slice &add()
    {
      return add<Slice>(Slice::slice_name);
    }

    /** Null if no operator has added it. */
    template <typename Slice>
    const Slice *find(const std::string_view name = Slice::slice_name) const
    {
      return static_cast<const Slice *>(find_data(name, typeid(Slice)));
    }

    /** An operator must have added it. */
    template <typename Slice>
    const Slice &get(const std::string_view name) const
    {
      const Slice *slice = find<Slice>(name);
      if (!slice)
        refuse_missing(name);
      return *slice;
    }
    template <typename Slice>
    Slice &get(const std::string_view name)
    {
      return const_cast<Slice &>(
          static_cast<const StateSlices *>(this)->get<Slice>(name));
    }
    template <typename Slice>
    const Slice &get() const
    {
      return get<Slice>(Slice::slice_name);
    }
    template <typename Slice>
    Slice &get()
    {
      return get<Slice>(Slice::slice_name);
    }

    /** Copies the slices of @p other that this one has, too. */
    void copy_slices(const StateSlices &other);

    /** Throw a boost::archive::archive_exception if the archive has other
        slices than those that were added. */
    void archive_slices(boost::archive::binary_oarchive &archive);
    void archive_slices(boost::archive::binary_iarchive &archive);

  protected:
    /** Copies what belongs to this rank from the same slices of @p part. */
    void take_slices(StateSlices &part, Redistribution &moves);

  private:
    /** A slice of any type. */
    struct Entry
    {
      std::string name;
      const std::type_info *type;
      std::shared_ptr<void> data;
      std::shared_ptr<void> (*copy)(const void *);
      void (*save)(boost::archive::binary_oarchive &, const void *);
      void (*load)(boost::archive::binary_iarchive &, void *);
      void (*take)(Redistribution &, const std::string &, void *, void *);
    };

    const void *find_data(const std::string_view name,
                          const std::type_info &type) const
    {
      for (const Entry &entry : entries)
        if (entry.name == name && *entry.type == type)
          return entry.data.get();
      return nullptr;
    }
    [[noreturn]] static void refuse_missing(std::string_view name);

    std::vector<Entry> entries;
  };
} // namespace quoin

#endif
