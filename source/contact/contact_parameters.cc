// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/contact/contact_parameters.h>

namespace quoin
{
  void ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Selection;
    prm.declare_entry("Displacements", "small", Selection("small|large"),
                      "small: blocks touch at the matched joints of the mesh "
                      "alone; large: joints may slide and open without limit, "
                      "and blocks come into contact wherever they meet.");
    prm.declare_entry("Corner rounding", "0.001", Double(),
                      "Share of the shorter edge over which the normal of a "
                      "contact turns where a corner passes a corner [-]");
    prm.declare_entry("Handover", "0.0005", Double(),
                      "Slip or opening of a matched joint, as a share of its "
                      "edge, at which the joints between its two blocks "
                      "become general contacts [-]");
    prm.declare_entry("Skin", "0", Double(),
                      "Edges that are nearer than this are watched; they are "
                      "searched again when a block has moved half of it; 0: "
                      "automatic [m]");
    prm.declare_entry("Deepest overlap", "0.25", Double(),
                      "Of two blocks, as a share of the height of the cells "
                      "behind the edges; the run stops beyond it [-]");
    prm.declare_entry("Box", "", Anything(),
                      "xmin, ymin, xmax, ymax of the box that blocks should "
                      "not leave; empty: none [m]");
    prm.declare_entry("Outside the box", "report",
                      Selection("report|delete|stop"),
                      "What happens to a block that has left the box with all "
                      "of its nodes. delete: it is gone, with its energy, "
                      "unless a load of this or a later stage moves it, or "
                      "matched joints tie it to a block that stays.");
  }

  ContactParameters ContactParameters::read(const ParameterSection &section)
  {
    ContactParameters contact;
    contact.large_displacements = section.text("Displacements") == "large";
    contact.rounding            = section.within("Corner rounding", 1e-6, 0.5);
    contact.handover            = section.within("Handover", 1e-6, 0.5);
    contact.skin                = section.nonnegative("Skin");
    contact.deepest             = section.within("Deepest overlap", 1e-6, 1.);
    contact.has_box             = !section.text("Box").empty();
    if (!contact.has_box && section.text("Outside the box") != "report")
      section.fail("Outside the box", "needs a 'Box': give one, or leave this "
                                      "at 'report'.");
    if (contact.has_box)
    {
      if (!contact.large_displacements)
        section.fail("Box", "needs 'Displacements = large': with small ones "
                            "no block goes anywhere.");
      contact.box = section.numbers<4>("Box");
      if (!(contact.box[0] < contact.box[2] && contact.box[1] < contact.box[3]))
        section.fail("Box", "must be xmin, ymin, xmax, ymax with xmin < xmax "
                            "and ymin < ymax.");
    }
    contact.outside = section.choice<Outside>("Outside the box",
                                              { { "report", Outside::report },
                                                { "delete", Outside::remove },
                                                { "stop", Outside::stop } });
    return contact;
  }
} // namespace quoin
