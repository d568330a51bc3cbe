// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/joints/composite_parameters.h>
#include <quoin/joints/joint_parameters.h>
#include <quoin/joints/rock_laws.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;

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

    /** The angle [degrees] of a joint that has failed. */
    double residual_angle(const ParameterSection &section, const double peak)
    {
      const std::string name = "Residual friction angle";
      if (section.text(name) == "same")
        return peak;
      const double angle = section.numbers<1>(name).front();
      if (!(angle >= 0. && angle <= 89.))
        section.fail(name, "must lie between 0 and 89 degrees, or be 'same'.");
      return angle;
    }

    CoulombLaw read_elastic_law(const ParameterSection &section)
    {
      CoulombLaw law;
      law.normal_stiffness = section.positive("Normal stiffness");
      law.shear_stiffness  = section.positive("Shear stiffness");
      return law;
    }

    /** The laws 'Coulomb' and 'no tension'. */
    CoulombLaw read_coulomb_law(const ParameterSection &section)
    {
      CoulombLaw law          = read_elastic_law(section);
      const bool is_brittle   = section.text("Law") == "Coulomb";
      const double peak_angle = section.within("Friction angle", 0., 89.);
      law.peak.cohesion       = section.nonnegative("Cohesion");
      law.peak.friction       = tangent_of_degrees(peak_angle);
      law.peak.tension        = section.nonnegative("Tensile strength");
      law.critical_shear_displacement
          = section.nonnegative("Critical shear displacement");

      const double failed_angle
          = is_brittle ? residual_angle(section, peak_angle) : peak_angle;
      law.residual          = law.peak;
      law.residual.friction = tangent_of_degrees(failed_angle);
      // A joint dilates once it has failed: beyond the residual friction that
      // would create energy.
      law.dilation = tangent_of_degrees(section.within(
          "Dilation angle", 0., std::min(peak_angle, failed_angle)));
      if (!is_brittle)
      {
        if (law.peak.tension > 0.)
          section.fail("Tensile strength",
                       "must be 0 for the law 'no tension'; use the law "
                       "'Coulomb' for a joint that holds tension.");
        return law;
      }
      law.residual.cohesion = section.nonnegative("Residual cohesion");
      law.residual.tension  = section.nonnegative("Residual tensile strength");
      if (law.residual.cohesion > law.peak.cohesion)
        section.fail("Residual cohesion", "must not exceed 'Cohesion'.");
      if (law.residual.tension > law.peak.tension)
        section.fail("Residual tensile strength",
                     "must not exceed 'Tensile strength'.");
      return law;
    }

    JointLaw read_law(const ParameterSection &section)
    {
      const std::string kind = section.text("Law");
      if (kind == "elastic")
        return read_elastic_law(section);
      refuse_unread_parameters(section);
      if (kind == "composite")
        return read_composite_law(section);
      if (kind == "Barton-Bandis" || kind == "continuously yielding")
        return read_rock_law(section);
      return read_coulomb_law(section);
    }

    /** New contacts are born failed: some laws make no sense of that. */
    void refuse_law_of_new_contacts(const ParameterSection &section)
    {
      const std::string kind = section.text("Law");
      if (kind == "elastic")
        section.fail("Law", "cannot be 'elastic' for new contacts, which "
                            "would then hold together for good. Use "
                            "'Coulomb'.");
      if (kind == "composite")
        section.fail("Law", "cannot be 'composite' for new contacts, which "
                            "hold nothing together. Use 'Coulomb'.");
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

    if (is_new)
      refuse_law_of_new_contacts(section);
    set.law = read_law(section);
    return set;
  }
} // namespace quoin
