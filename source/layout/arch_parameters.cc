// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/layout/arch_parameters.h>

#include <cmath>

#include <quoin/layout/element_limit.h>
#include "numbered_names.h"

namespace quoin
{
  namespace
  {
    void check_ring(const ParameterSection &section, const ArchParameters &arch)
    {
      if (arch.rise > 0.5 * arch.span * (1. + 1e-12))
        section.fail("Rise", "must be at most half of 'Span', as that of a "
                             "semicircle is.");
      // The centre of a flatter one is far away, and rounding would be felt.
      if (arch.rise < 1e-3 * arch.span)
        section.fail("Rise", "must be at least a thousandth of 'Span'.");
      if (arch.n_voussoirs < 2 || arch.n_voussoirs > 100000)
        section.fail("Voussoirs", "must be from 2 to 100000.");
    }

    /** Radius of the intrados [m]. */
    double radius(const ArchParameters &arch)
    {
      return (0.25 * arch.span * arch.span + arch.rise * arch.rise)
             / (2. * arch.rise);
    }

    void check_spandrels(const ParameterSection &section,
                         const ArchParameters &arch)
    {
      const double r    = radius(arch);
      const double foot = arch.ring * 0.5 * arch.span / r;
      const double top  = arch.ring * (r - arch.rise) / r;
      if (!(arch.abutment[0] >= foot * (1. - 1e-12) && arch.abutment[1] > 0.))
        section.fail("Abutments", "must be width and height, at least "
                                      + number_text(foot)
                                      + " m wide, to be below the whole joint, "
                                        "and higher than 0.");
      if (arch.backing == 0.)
        return;
      // The crown of the extrados may be the middle of a voussoir.
      const double half  = std::asin(std::min(1., 0.5 * arch.span / r));
      const double crown = arch.rise - r
                           + (r + arch.ring)
                                 * (arch.n_voussoirs % 2 == 0
                                        ? 1.
                                        : std::cos(half / arch.n_voussoirs));
      if (!(top < arch.backing && arch.backing < crown))
        section.fail("Backing", "must be between the springing of the "
                                "extrados, y = "
                                    + number_text(top) + " m, and its crown, "
                                    + number_text(crown) + " m.");
    }

    void check_elements(const ParameterSection &section, ArchParameters &arch)
    {
      if (arch.element_size == 0.)
        arch.element_size = 0.5 * arch.ring;
      if (arch.fill_element_size == 0.)
        arch.fill_element_size = arch.element_size;
      const double width = arch.span + 2. * arch.abutment[0];
      const double height
          = arch.rise + arch.ring + arch.cover + arch.abutment[1];
      const double ring = 4. * (arch.span + arch.rise) * arch.ring;
      limit_elements(section,
                     2. * ring / arch.element_size / arch.element_size);
      limit_elements(section, 2. * width * height / arch.fill_element_size
                                  / arch.fill_element_size);
    }

    void enter_arch(ParameterEntries &entries, ArchParameters &arch)
    {
      entries.nonnegative(
          "Span", arch.span,
          "Clear span of an arch that the program generates instead of reading "
          "'Mesh/File', with the springings of the intrados at y = 0 on both "
          "sides of x = 0; 0: no arch is generated [m]");
      if (!entries.reads_if(arch.span > 0.))
        return;
      entries.positive("Rise", arch.rise,
                       "Rise of the intrados, which is an arc of a circle, at "
                       "most half of the span [m]");
      entries.positive("Ring thickness", arch.ring,
                       "Thickness of the ring from intrados to extrados [m]");
      entries.integer("Voussoirs", arch.n_voussoirs, 0,
                      "Number of voussoirs, which have straight sides and "
                      "radial joints [-]");
      entries.numbers("Abutments", arch.abutment,
                      "Width of each abutment from the intrados outwards, and "
                      "its height below y = 0 [m]");
      entries.nonnegative(
          "Backing", arch.backing,
          "Level y up to which masonry backing fills the spandrels; a joint of "
          "the ring within a tenth of 'Element size' of this level replaces "
          "it; 0: no backing [m]");
      entries.nonnegative(
          "Cover", arch.cover,
          "Height of the fill above the crown of the ring; 0: no fill [m]");
      std::vector<std::pair<std::string, std::string>> names;
      const std::string form
          = "must be pairs NAME:NUMBER, or NAME:FIRST-LAST of several, with "
            "commas between them and 1 <= NUMBER <= 'Voussoirs', each "
            "voussoir at most once, such as loaded:5-7, key:10.";
      entries.pairs("Named voussoirs", names, form,
                    "Voussoirs with names of their own, counted from 1 at the "
                    "left, such as loaded:5-7, key:10; a name gives the "
                    "physical surface 'voussoir_NAME' and the curves "
                    "'extrados_NAME' and 'intrados_NAME'.");
      entries.nonnegative("Element size", arch.element_size,
                          "Longest edge of the elements of voussoirs; 0: half "
                          "the thickness of the ring [m]");
      entries.nonnegative(
          "Fill element size", arch.fill_element_size,
          "Longest edge of the elements of fill, backing and abutments away "
          "from the ring; 0: as 'Element size' [m]");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      check_ring(*section, arch);
      check_spandrels(*section, arch);
      check_elements(*section, arch);
      arch.named_voussoirs = numbered_names(*section, "Named voussoirs", names,
                                            arch.n_voussoirs, form);
    }
  } // namespace

  void ArchParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_arch);
  }

  ArchParameters ArchParameters::read(const ParameterSection &section)
  {
    return read_entries(section, enter_arch);
  }
} // namespace quoin
