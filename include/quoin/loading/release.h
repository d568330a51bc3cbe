// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_release_h
#define quoin_loading_release_h

#include <quoin/model/construction_state.h>
#include <quoin/operators/force_operator.h>

#include <vector>

namespace quoin
{
  /**
   * Stress relaxation after excavation: the forces that excavated blocks
   * exerted on those that stay go in a stage from H_0, the rest after earlier
   * stages, to H_1 by a ramp s(t) of load time, H = H_0 + s (H_1 - H_0)
   * (@cite PanetGuenot1982). They act and work as loads.
   */
  template <int dim>
  class Release : public ForceOperator<dim>
  {
  public:
    Release() = default;

    /** @p duration: of the ramp [s]; 0: at once. @p is_linear: whether it is
        straight, not half a cosine. */
    Release(const State<dim> &state, bool is_linear, double duration);

    /** Whether the forces change in the stage. */
    bool changes() const
    {
      return is_changing;
    }

    /** The ramp s(@p load_time) [-]. */
    double share(double load_time) const;

    /** Duration of the release [s]. */
    double duration() const
    {
      return ramp_duration;
    }
    const char *kind() const override
    {
      return "loads";
    }
    void add_loads(const TimePoint &time,
                   dealii::Tensor<1, dim> *force) const override;
    double
    external_power(const TimePoint &time,
                   const dealii::Tensor<1, dim> *velocity) const override;

  private:
    struct NodalForce
    {
      unsigned int node;
      double start[dim], change[dim]; /**< H_0, H_1 - H_0 [N] */
    };
    std::vector<NodalForce> forces; /**< nodal forces of this rank */
    bool is_changing     = false;
    bool is_linear       = false;
    double ramp_duration = 0.;
  };
} // namespace quoin

#endif
