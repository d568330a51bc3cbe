// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_layout_arch_parameters_h
#define quoin_layout_arch_parameters_h

#include <quoin/base/parameter_section.h>

#include <array>
#include <map>
#include <string>

namespace quoin
{
  /** The section 'Arch'. */
  struct ArchParameters
  {
    double span              = 0.; /**< span of the intrados; 0: no arch [m] */
    double rise              = 0.; /**< rise of the intrados [m] */
    double ring              = 0.; /**< thickness of the voussoirs [m] */
    unsigned int n_voussoirs = 0;
    /** Width from the intrados outwards and height below y = 0 [m]. */
    std::array<double, 2> abutment{ { 1., 1. } };
    double backing = 0.; /**< level y of the backing; 0: none [m] */
    double cover = 0.; /**< height of the fill over the crown; 0: no fill [m] */
    /** Names of voussoirs, counted from 1. */
    std::map<unsigned int, std::string> named_voussoirs;

    double element_size = 0.; /**< longest edge, about [m] */
    /** Element size of fill and abutments [m]. */
    double fill_element_size = 0.;

    static void declare(dealii::ParameterHandler &prm);
    static ArchParameters read(const ParameterSection &section);
  };
} // namespace quoin

#endif
