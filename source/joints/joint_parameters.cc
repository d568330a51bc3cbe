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
    using dealii::Patterns::Double;

    JointDamping read_damping(const ParameterSection &section)
    {
      /** The share of critical damping of the smallest restitution. */
      constexpr double most = 2.;
      JointDamping damping;
      const double restitution = section.within("Restitution", 0.05, 1.);
      damping.normal           = section.within("Normal damping", 0., most);
      if (restitution < 1. && damping.normal > 0.)
        section.fail("Normal damping",
                     "does not go with 'Restitution = "
                         + section.text("Restitution")
                         + "', which sets it. Give one of them.");
      if (restitution < 1.)
        damping.normal = damping_of_restitution(restitution);
      damping.shear = damping.normal;
      if (section.text("Shear damping") == "same")
        return damping;
      damping.shear = section.numbers<1>("Shear damping").front();
      if (!(damping.shear >= 0. && damping.shear <= most))
        section.fail("Shear damping",
                     "must be a number from 0 to 2, or 'same'.");
      return damping;
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
    prm.declare_entry("Curves", "", Anything(),
                      "Physical curves of the mesh whose joints form this set; "
                      "empty: the curve that bears the set's name; 'unnamed': "
                      "joints on no named curve; 'none': no joint at the start "
                      "of the run, for sets that only stages assign.");
    prm.declare_entry("New contacts between", "", Anything(),
                      "Pairs a:b of materials whose new contacts belong to "
                      "this set, or 'all' for the pairs that no other set "
                      "names. New contacts start at residual strength and need "
                      "'Displacements = large'; such a set needs no curve.");
    LawEntries::all().declare(prm);
    prm.declare_entry(
        "Restitution", "1", Double(),
        "Coefficient of restitution of the central impact of two blocks, each "
        "as a point mass, from 0.05 to 1; it determines 'Normal damping'; 1: "
        "'Normal damping' is as given [-]");
    prm.declare_entry(
        "Normal damping", "0", Double(),
        "Viscous damping parallel to the normal springs, as a fraction of "
        "critical damping of the two blocks on the springs in contact, at most "
        "2; it bears no tension and lowers the critical time step [-]");
    prm.declare_entry("Shear damping", "same", Anything(),
                      "Viscous damping parallel to the shear springs, as a "
                      "fraction of critical damping, limited by the friction "
                      "of the total pressure; 'same': as 'Normal damping' [-]");
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

    set.damping           = read_damping(section);
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
