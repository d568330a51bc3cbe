// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/joint_laws/law_entries.h>

#include <optional>

namespace quoin
{
  namespace
  {
    void enter_damping(ParameterEntries &entries, JointDamping &damping)
    {
      /** The share of critical damping of the smallest restitution. */
      constexpr double most = 2.;
      constexpr double same = -1.;
      double restitution    = 1.;
      entries.within(
          "Restitution", restitution, 0.05, 1.,
          "Coefficient of restitution of the central impact of two blocks, "
          "each as a point mass, from 0.05 to 1; it determines 'Normal "
          "damping'; 1: 'Normal damping' is as given [-]");
      entries.within(
          "Normal damping", damping.normal, 0., most,
          "Viscous damping parallel to the normal springs, as a fraction of "
          "critical damping of the two blocks on the springs in contact, at "
          "most 2; it bears no tension and lowers the critical time step [-]");
      damping.shear = same;
      entries.number_or(
          "same", same, "Shear damping", damping.shear,
          "Viscous damping parallel to the shear springs, as a fraction of "
          "critical damping, limited by the friction of the total pressure; "
          "'same': as 'Normal damping' [-]");

      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (restitution < 1. && damping.normal > 0.)
        section->fail("Normal damping",
                      "does not go with 'Restitution = "
                          + section->text("Restitution")
                          + "', which sets it. Give one of them.");
      if (restitution < 1.)
        damping.normal = damping_of_restitution(restitution);
      if (section->text("Shear damping") == "same")
        damping.shear = damping.normal;
      else if (!(damping.shear >= 0. && damping.shear <= most))
        section->fail("Shear damping",
                      "must be a number from 0 to 2, or 'same'.");
    }

    void enter_places(ParameterEntries &entries, JointSetParameters &set)
    {
      entries.list("Curves", set.curves,
                   "Physical curves of the mesh, in three dimensions surfaces, "
                   "whose joints form this set; "
                   "empty: the curve that bears the set's name, but none with "
                   "'New contacts between'; 'unnamed': "
                   "joints on no named curve; 'none': no joint at the start "
                   "of the run, for sets that only stages assign.");
      entries.pairs("New contacts between", set.new_contacts,
                    "must be 'all' or pairs of materials such as "
                    "rock:concrete.",
                    "Pairs a:b of materials whose new contacts belong to "
                    "this set, or 'all' for the pairs that no other set "
                    "names. New contacts start at residual strength and need "
                    "'Displacements = large'; such a set needs no curve.",
                    &set.all_new_contacts);
    }

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
    declare_entries(prm, enter_places);
    LawEntries::declare(prm);
    declare_entries(prm, enter_damping);
  }

  JointSetParameters JointSetParameters::read(const ParameterSection &section,
                                              const std::string &name)
  {
    auto set          = read_entries(section, enter_places);
    set.name          = name;
    set.damping       = read_entries(section, enter_damping);
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
