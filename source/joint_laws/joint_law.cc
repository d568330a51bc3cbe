// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_laws/joint_law.h>

namespace quoin
{
  std::array<double, 2> stiffness_bound(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.largest_stiffness(); },
                      law);
  }

  bool stiffens(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.stiffens; }, law);
  }

  bool can_fail(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.behaviour().fails; },
                      law);
  }

  double slip_of_peak(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.slip_of_peak(); }, law);
  }

  bool can_dilate(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.behaviour().dilates; },
                      law);
  }

  std::string kind_of_law(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.kind; }, law);
  }

  std::string law_text(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.text(); }, law);
  }

  std::string law_warning(const JointLaw &law)
  {
    return std::visit([](const auto &own) { return own.warning(); }, law);
  }

  unsigned int n_internal(const JointLaw &law)
  {
    return std::visit(
        [](const auto &own) -> unsigned int
        {
          using Law = std::decay_t<decltype(own)>;
          return Law::template Point<2>::internal.size();
        },
        law);
  }

  JointLaw reduced(const JointLaw &law, const double factor)
  {
    return std::visit(
        [=](const auto &own) -> JointLaw { return own.reduced(factor); }, law);
  }
} // namespace quoin
