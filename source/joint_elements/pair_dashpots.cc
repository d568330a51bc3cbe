// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/none.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/joint_elements/pair_dashpots.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Blocks = std::array<unsigned int, 2>;

    Blocks ascending(Blocks blocks)
    {
      std::sort(blocks.begin(), blocks.end());
      return blocks;
    }

    void sort_once(std::vector<Blocks> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  } // namespace

  void PairDashpots::bind(const std::vector<Item> &items)
  {
    std::vector<Blocks> found;
    for (const Item &item : items)
      found.push_back(ascending(item.blocks));
    sort_once(found);
    pairs.clear();
    std::vector<Blocks> divided;
    for (const Blocks &pair : found)
    {
      double inverse
          = blocks.inverse_mass[pair[0]] + blocks.inverse_mass[pair[1]];
      if (inverse == 0. && !blocks.own_inverse_mass.empty())
        inverse = blocks.own_inverse_mass[pair[0]]
                  + blocks.own_inverse_mass[pair[1]];
      const bool is_divided
          = blocks.is_divided[pair[0]] || blocks.is_divided[pair[1]];
      pairs.push_back(
          { pair, inverse > 0. ? 1. / inverse : 0., is_divided, {} });
      if (is_divided)
        divided.push_back(pair);
    }
    const auto place = [&](const Blocks &pair) -> unsigned int
    {
      const auto at = std::lower_bound(found.begin(), found.end(), pair);
      return at != found.end() && *at == pair ? at - found.begin() : none;
    };

    item_pairs.clear();
    item_impedance.clear();
    for (const Item &item : items)
    {
      item_pairs.push_back(place(ascending(item.blocks)));
      const auto &a = blocks.impedance[item.groups[0]];
      const auto &b = blocks.impedance[item.groups[1]];
      item_impedance.push_back(
          { { std::min(a[0], b[0]), std::min(a[1], b[1]) } });
    }

    divided_pairs.clear();
    if (std::find(blocks.is_divided.begin(), blocks.is_divided.end(), true)
        == blocks.is_divided.end())
      return;
    std::vector<Blocks> of_all;
    for (const auto &list :
         dealii::Utilities::MPI::all_gather(blocks.communicator, divided))
      of_all.insert(of_all.end(), list.begin(), list.end());
    sort_once(of_all);
    for (const Blocks &pair : of_all)
      divided_pairs.push_back(place(pair));
  }

  void PairDashpots::clear()
  {
    for (Pair &pair : pairs)
      pair.springs.clear();
  }

  void PairDashpots::add_springs(const unsigned int item, const double share,
                                 const double kn, const double ks)
  {
    // Both ranks of two whole blocks have all that is between them.
    Pair &pair          = pairs[item_pairs[item]];
    const double weight = pair.is_divided ? share : 1.;
    pair.springs[0] += weight * kn;
    pair.springs[1] += weight * ks;
  }

  void PairDashpots::sum_over_ranks()
  {
    if (divided_pairs.empty())
      return;
    std::vector<double> springs(2 * divided_pairs.size(), 0.);
    for (unsigned int i = 0; i < divided_pairs.size(); ++i)
      if (divided_pairs[i] != none)
        set_vector(springs, i, pairs[divided_pairs[i]].springs);
    MPI_Allreduce(MPI_IN_PLACE, springs.data(), springs.size(), MPI_DOUBLE,
                  MPI_SUM, blocks.communicator);
    for (unsigned int i = 0; i < divided_pairs.size(); ++i)
      if (divided_pairs[i] != none)
        pairs[divided_pairs[i]].springs = vector_at(springs, i);
  }

  std::array<double, 2>
  PairDashpots::times(const unsigned int item, const JointDamping &damping,
                      const std::array<double, 2> &stiffness) const
  {
    const Pair &pair = pairs[item_pairs[item]];
    const auto time  = [&](const unsigned int d, const double xi)
    {
      return std::min(2. * xi * std::sqrt(pair.mass / pair.springs[d]),
                      item_impedance[item][d] / stiffness[d]);
    };
    return { { time(0, damping.normal), time(1, damping.shear) } };
  }
} // namespace quoin
