// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joints/joint_parameters.h>
#include <quoin/joints/law_entries.h>

#include <optional>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    JointLaw read_law(const ParameterSection &section)
    {
      LawEntries entries(section);
      std::optional<JointLaw> result;
      for_each_law(
          [&](const auto *law)
          {
            using Law = std::decay_t<decltype(*law)>;
            for (const LawName &name : Law::names)
              if (entries.law() == name.word)
                result = Law::read(entries);
          });
      // The strength of an elastic joint may stay, so that a file can change
      // the law of one that it includes.
      if (can_fail(*result))
        entries.refuse_unread();
      return *result;
    }
  } // namespace

  void JointSetParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Curves", "", Anything(),
                      "Physical curves of the mesh whose joints form this "
                      "set; empty: the curve that bears the set's own name; "
                      "'unnamed': joints on no named curve; 'none': no joint "
                      "where the run begins, only what stages lead to.");
    prm.declare_entry("New contacts between", "", Anything(),
                      "Pairs a:b of materials between which contacts that "
                      "come up while blocks move follow this set, or 'all': "
                      "the pairs that no other set names. They start at "
                      "residual strength. For large displacements; such a "
                      "set needs no curve.");
    LawEntries::all().declare(prm);
  }

  JointSetParameters JointSetParameters::read(const ParameterSection &section,
                                              const std::string &name)
  {
    JointSetParameters set;
    set.name   = name;
    set.curves = section.list("Curves");
    set.new_contacts
        = section.pairs("New contacts between",
                        "must be 'all' or pairs of materials such as "
                        "rock:concrete.",
                        &set.all_new_contacts);
    const bool is_new = set.all_new_contacts || !set.new_contacts.empty();
    if (set.curves.empty() && !is_new)
      set.curves = { name };
    if (set.curves == std::vector<std::string>{ "none" })
      set.curves.clear();

    set.law               = read_law(section);
    const std::string why = std::visit(
        [](const auto &law) { return law.no_new_contacts(); }, set.law);
    if (is_new && !why.empty())
      section.fail("Law", "cannot be '" + section.text("Law")
                              + "' for new contacts, " + why
                              + ". Use 'Coulomb'.");
    return set;
  }
} // namespace quoin
