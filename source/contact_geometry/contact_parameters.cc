// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/contact_geometry/contact_parameters.h>

namespace quoin
{
  namespace
  {
    void check_box(const ParameterSection &section,
                   const ContactParameters &contact)
    {
      if (!contact.has_box && section.text("Outside the box") != "report")
        section.fail("Outside the box", "needs a 'Box': give one, or leave "
                                        "this at 'report'.");
      if (!contact.has_box)
        return;
      if (!contact.large_displacements)
        section.fail("Box", "needs 'Displacements = large': with small "
                            "displacements no block leaves its place.");
      if (!(contact.box[0] < contact.box[2] && contact.box[1] < contact.box[3]))
        section.fail("Box", "must be xmin, ymin, xmax, ymax with xmin < xmax "
                            "and ymin < ymax.");
    }

    void enter(ParameterEntries &entries, ContactParameters &contact)
    {
      using Outside = ContactParameters::Outside;
      entries.choice("Displacements", contact.large_displacements,
                     { { "small", false }, { "large", true } },
                     "Contact detection. small: blocks are in contact only at "
                     "the matched joints of the mesh; large: joints may slide "
                     "and open without limit, and new contacts are detected.");
      entries.within("Corner rounding", contact.rounding, 1e-6, 0.5,
                     "Fraction of the shorter edge over which the contact "
                     "normal rotates where a corner passes a corner [-]");
      entries.within("Handover", contact.handover, 1e-6, 0.5,
                     "Slip or opening of a matched joint, as a fraction of the "
                     "length of its edge, at which the joints between its two "
                     "blocks become general contacts [-]");
      entries.nonnegative(
          "Skin", contact.skin,
          "Distance within which pairs of edges are candidates for contact; "
          "the search is repeated when a block has moved half of this "
          "distance; 0: automatic, from the velocities of the blocks [m]");
      entries.within("Deepest overlap", contact.deepest, 1e-6, 1.,
                     "Largest admissible overlap of two blocks, as a fraction "
                     "of the height of the cells behind the edges; the run "
                     "stops if it is exceeded [-]");
      entries.other("Box", "",
                    "Box xmin, ymin, xmax, ymax that blocks should not leave; "
                    "empty: no box [m]",
                    [&](const ParameterSection &section)
                    {
                      contact.has_box = !section.text("Box").empty();
                      if (contact.has_box && contact.large_displacements)
                        contact.box = section.numbers<4>("Box");
                    });
      entries.choice(
          "Outside the box", contact.outside,
          { { "report", Outside::report },
            { "delete", Outside::remove },
            { "stop", Outside::stop } },
          "Action when all nodes of a block are outside the box. report: the "
          "block is reported; delete: the block and its energy are removed, "
          "unless a load of this or a later stage moves it, or matched joints "
          "connect it to a block that stays; stop: the run stops.");
      if (const ParameterSection *section = entries.read_section())
        check_box(*section, contact);
    }
  } // namespace

  void ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  ContactParameters ContactParameters::read(const ParameterSection &section)
  {
    return read_entries(section, enter);
  }
} // namespace quoin
