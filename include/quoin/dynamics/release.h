// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_dynamics_release_h
#define quoin_dynamics_release_h

#include <quoin/dynamics/model.h>
#include <quoin/dynamics/stage_parameters.h>

#include <vector>

namespace quoin
{
  /**
   * The forces in a stage that excavated blocks exerted on those that stay:
   * from H_0, what earlier stages left of them, to H_1 by a ramp s(t) of the
   * loads' clock, H = H_0 + s (H_1 - H_0) (@cite PanetGuenot1982). They act
   * and work as loads do.
   */
  class Release : public ForceOperator<2>
  {
  public:
    Release() = default;

    /** @p duration: of the ramp [s]; 0: at once. */
    Release(const State<2> &state, const StageParameters &stage,
            double duration);

    /** Whether the forces change in the stage. */
    bool changes() const
    {
      return is_changing;
    }

    /** s [-] */
    double share(double load_time) const;

    const char *kind() const override
    {
      return "loads";
    }
    void add_forces(double load_time, NodeVector<2> *force) const;
    void add_forces(const StepContext &step, State<2> &,
                    const NodeForces<2> &forces) override
    {
      add_forces(step.begin.stage, forces.force);
    }
    double external_power(const TimePoint &time,
                          const NodeVector<2> *velocity) const override;

  private:
    struct NodalForce
    {
      unsigned int node;
      double start[2], change[2]; /**< H_0, H_1 - H_0 [N] */
    };
    std::vector<NodalForce> forces; /**< of this rank */
    bool is_changing     = false;
    bool is_linear       = false;
    double ramp_duration = 0.;
  };
} // namespace quoin

#endif
