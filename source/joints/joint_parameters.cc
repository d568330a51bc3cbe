// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/joints/composite_parameters.h>
#include <quoin/joints/joint_parameters.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;

    /** What JointSetParameters::law is of a rock joint. */
    CoulombLaw stand_in(const RockLaw &rock)
    {
      CoulombLaw result;
      std::visit(
          [&](const auto &law)
          {
            result.normal_stiffness = law.closure.largest_stiffness();
            result.shear_stiffness  = law.largest_shear_stiffness();
            result.peak             = { 0., std::tan(law.residual_angle), 0. };
          },
          rock);
      result.residual = result.peak;
      return result;
    }

    /**
     * Refuses strengths that the law does not have. What is another law's alone
     * may stay, so that a file can change the law of one that it includes; so
     * may the strength of an elastic joint.
     */
    void refuse_unread_parameters(const ParameterSection &section)
    {
      const std::vector<std::string> brittle
          = { "Coulomb", "Barton-Bandis", "continuously yielding" };
      refuse_unread(section, "Law",
                    { { "Residual cohesion", "0", brittle },
                      { "Residual tensile strength", "0", brittle },
                      { "Residual friction angle",
                        "same",
                        { "Coulomb", "composite", "Barton-Bandis",
                          "continuously yielding" } },
                      { "Critical shear displacement",
                        "1e300",
                        { "Coulomb", "no tension" } } });
    }

    JointStrength divided(const JointStrength &strength, const double factor)
    {
      return { strength.cohesion / factor, strength.friction / factor,
               strength.tension / factor };
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
                      "the pairs that no other set names. They are born "
                      "failed, that is with the residual strength. For large "
                      "displacements; such a set needs no curve.");
    prm.declare_entry(
        "Law", "Coulomb",
        dealii::Patterns::Selection("Coulomb|composite|elastic|no tension|"
                                    "Barton-Bandis|continuously yielding"),
        "Coulomb: cohesion, friction and tension that drop to "
        "their residual values at failure; composite: these "
        "soften with fracture energies, and a cap crushes, for "
        "masonry; elastic: never fails; no tension: Coulomb without tension "
        "whose cohesion is never lost; Barton-Bandis: rock joint that closes "
        "along a hyperbola, whose roughness is mobilised and worn by slip; "
        "continuously yielding: rock joint that yields from the first slip "
        "on.");
    prm.declare_entry("Normal stiffness", "0", Double(),
                      "kn; of 'Barton-Bandis' that of the unloaded joint, of "
                      "'continuously yielding' that at 'Reference stress' "
                      "[Pa/m]");
    prm.declare_entry("Shear stiffness", "0", Double(),
                      "ks; of 'continuously yielding' that at 'Reference "
                      "stress' [Pa/m]");
    prm.declare_entry("Cohesion", "0", Double(), "Peak cohesion c [Pa]");
    prm.declare_entry("Friction angle", "0", Double(),
                      "phi; of 'continuously yielding' that of the unworn "
                      "joint, not read if 'Law = Barton-Bandis' [deg]");
    prm.declare_entry("Tensile strength", "0", Double(), "ft [Pa]");
    prm.declare_entry("Dilation angle", "0", Double(),
                      "psi, at most the friction angle, once failed too "
                      "[deg]");
    prm.declare_entry("Critical shear displacement", "1e300", Double(),
                      "Slip beyond which the joint dilates no more [m]");
    prm.declare_entry("Residual cohesion", "0", Double(),
                      "Cohesion once failed [Pa]");
    prm.declare_entry("Residual friction angle", "same", Anything(),
                      "Friction angle once failed, or 'same'; of rock joints "
                      "that of the worn joint [deg]");
    prm.declare_entry("Residual tensile strength", "0", Double(),
                      "Tensile strength once failed [Pa]");
    declare_composite_law(prm);
    declare_rock_laws(prm);
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

    CoulombLaw &law        = set.law;
    law.normal_stiffness   = section.positive("Normal stiffness");
    law.shear_stiffness    = section.positive("Shear stiffness");
    const std::string kind = section.text("Law");
    if (kind == "elastic")
    {
      if (is_new)
        section.fail("Law", "cannot be 'elastic' for new contacts, which "
                            "would then hold together for good. Use "
                            "'Coulomb'.");
      return set;
    }

    refuse_unread_parameters(section);
    if (kind == "Barton-Bandis" || kind == "continuously yielding")
    {
      set.rock = read_rock_law(section);
      set.law  = stand_in(*set.rock);
      return set;
    }

    if (kind == "composite")
    {
      if (is_new)
        section.fail("Law", "cannot be 'composite' for new contacts, which "
                            "hold nothing together. Use 'Coulomb'.");
      set.composite               = read_composite_law(section);
      const CompositeLaw &masonry = *set.composite;
      law.peak     = { masonry.cohesion, masonry.friction, masonry.tension };
      law.residual = { 0., masonry.residual_friction, 0. };
      return set;
    }

    const double peak_angle = section.within("Friction angle", 0., 89.);
    law.peak.cohesion       = section.nonnegative("Cohesion");
    law.peak.friction       = tangent_of_degrees(peak_angle);
    law.peak.tension        = section.nonnegative("Tensile strength");
    law.critical_shear_displacement
        = section.nonnegative("Critical shear displacement");

    law.residual = law.peak;
    // A joint dilates once it has failed: beyond the residual friction that
    // would create energy.
    double highest_dilation = peak_angle;
    if (kind == "Coulomb" && section.text("Residual friction angle") != "same")
    {
      const double angle
          = section.numbers<1>("Residual friction angle").front();
      if (!(angle >= 0. && angle <= 89.))
        section.fail("Residual friction angle",
                     "must lie between 0 and 89 degrees, or be 'same'.");
      law.residual.friction = tangent_of_degrees(angle);
      highest_dilation      = std::min(peak_angle, angle);
    }
    law.dilation = tangent_of_degrees(
        section.within("Dilation angle", 0., highest_dilation));
    if (kind == "no tension")
    {
      if (law.peak.tension > 0.)
        section.fail("Tensile strength",
                     "must be 0 for the law 'no tension'; use the law "
                     "'Coulomb' for a joint that holds tension.");
      return set;
    }
    law.residual.cohesion = section.nonnegative("Residual cohesion");
    law.residual.tension  = section.nonnegative("Residual tensile strength");
    if (law.residual.cohesion > law.peak.cohesion)
      section.fail("Residual cohesion", "must not exceed 'Cohesion'.");
    if (law.residual.tension > law.peak.tension)
      section.fail("Residual tensile strength",
                   "must not exceed 'Tensile strength'.");
    return set;
  }

  JointSetParameters reduced(const JointSetParameters &set, const double factor)
  {
    JointSetParameters weak = set;
    weak.law.peak           = divided(set.law.peak, factor);
    weak.law.residual       = divided(set.law.residual, factor);
    weak.law.dilation
        = std::min(set.law.dilation, std::min(weak.law.peak.friction,
                                              weak.law.residual.friction));
    if (weak.composite)
    {
      CompositeLaw &law = *weak.composite;
      law.tension /= factor;
      law.cohesion /= factor;
      law.friction /= factor;
      law.residual_friction /= factor;
      law.dilation = std::min(law.dilation,
                              std::min(law.friction, law.residual_friction));
    }
    if (weak.rock)
      std::visit([&](auto &law) { law = reduced(law, factor); }, *weak.rock);
    return weak;
  }
} // namespace quoin
