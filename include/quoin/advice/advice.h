// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_advice_advice_h
#define quoin_advice_advice_h

#include <quoin/base/number_text.h>
#include <quoin/dynamics/solver.h>
#include <quoin/signals/signal_frequency.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/parameters/parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  // Warnings of input that is allowed but most likely a mistake: each is a
  // sentence with a remedy. All ranks get the same; functions are collective.

  using Advice = std::vector<std::string>;

  /** Checks of one subject. */
  class Checks
  {
  public:
    /** @p about: the beginning of all sentences, such as "stage pull: ". */
    Checks(Advice &advice, std::string about)
      : advice(advice), about(std::move(about))
    {
    }

    /** Adds the text_of() @p parts if @p condition holds. */
    template <typename... Parts>
    void warn_if(const bool condition, const Parts &...parts)
    {
      if (condition)
        advice.push_back(text_of(about, parts...));
    }

  private:
    Advice &advice;
    const std::string about;
  };

  /** Warnings about the file, the mesh and the initial @p state. */
  template <int dim>
  Advice model_advice(const Parameters &parameters, const MeshReport &report,
                      const Model<dim> &model, const State<dim> &state);

  /**
   * Warnings about stage @p index of the explicit solver, which has begun with
   * @p state and takes steps of @p time_step [s].
   */
  template <int dim>
  Advice stage_advice(const Parameters &parameters, unsigned int index,
                      const Model<dim> &model, const State<dim> &state,
                      double time_step);

  /** Whether a history is the hoop stress on boundary elements. */
  bool wants_hoop_stress(const Parameters &parameters);

  /** The load on blocks with the highest frequency in stage @p index. */
  Shaking fastest_load(const Parameters &parameters, unsigned int index);
} // namespace quoin

#endif
