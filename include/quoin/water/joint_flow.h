// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_water_joint_flow_h
#define quoin_water_joint_flow_h

#include <quoin/joint_elements/matched_joints.h>
#include <quoin/operators/force_operator.h>
#include <quoin/water/joint_channels.h>
#include <quoin/water/water_parameters.h>

#include <map>
#include <string>
#include <vector>

namespace quoin
{
  /** Water in the joints. */
  struct JointFlowState
  {
    static constexpr const char *slice_name = "joint flow";

    bool acts   = false;
    double time = 0.;             /**< of the last solution [s] */
    std::vector<double> pressure; /**< of the nodes of the network [Pa] */
    std::vector<double> content;  /**< see FlowSolution [m^3] */

    // Volumes since the start of the run [m^3].
    double inflow = 0., outflow = 0., stored = 0., residual = 0.;
    std::vector<double> boundary_flow; /**< into the joints [m^3/s] */
    std::vector<double> node_inflow;   /**< into each node [m^3/s] */

    // Of the segments of joints of this rank and of their points.
    std::vector<double> point_pressure;   /**< [Pa] */
    std::vector<double> point_aperture;   /**< hydraulic; 0: no water [m] */
    std::vector<double> point_saturation; /**< filled share [-] */
    std::vector<double> flow;     /**< from point 0 to point 1 [m^3/s] */
    std::vector<double> velocity; /**< mean over the aperture [m/s] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(acts, time, pressure, content, inflow, outflow, stored,
                   residual, boundary_flow, node_inflow);
      visitor.own(point_pressure, 2, JointHistory::slice_name);
      visitor.own(point_aperture, 2, JointHistory::slice_name);
      visitor.own(point_saturation, 2, JointHistory::slice_name);
      visitor.own(flow, 1, JointHistory::slice_name);
      visitor.own(velocity, 1, JointHistory::slice_name);
    }
  };

  /** Growth of the forces of water in joints at blocks that are placed. */
  struct GrowingWater
  {
    std::vector<unsigned int> blocks; /**< of the mesh, ascending */
    Growth growth;

    bool has(unsigned int block) const;
  };

  /** Volumes of water since the start of the run [m^3]. */
  struct FlowVolumes
  {
    double inflow, outflow, stored, residual;
  };

  /**
   * Water that flows along matched joints and presses their faces apart: a
   * FlowNetwork of the joints of all ranks, which every rank solves. Where
   * joints meet they share a node. Joints at absent blocks have no water, and
   * ends of others there the pressure 0 unless another value is given.
   *
   * The pressure acts on the reference area, along its normal. Apertures follow
   * from the openings of joints. In explicit steps the flow is solved every so
   * often with those of the moment, and goes on until the next solution; an
   * implicit solver iterates, see follow().
   */
  class JointFlow : public ForceOperator<2>
  {
  public:
    /**
     * Keeps references to @p nodes and @p joints; @p sets: of joints. Throws an
     * InputError about names that the model does not have. Collective.
     */
    JointFlow(const WaterParameters &parameters, const NodeMap<2> &nodes,
              const MatchedJoints &joints,
              const std::vector<JointSetParameters> &sets,
              const Thickness &thickness);

    const char *kind() const override
    {
      return "water";
    }
    void prepare(State<2> &state) const override;

    /** Adds the forces of the water of @p state in joints between @p blocks,
        which are about to be taken away, and others to the owned nodes of both
        [N]. @p growing: as given to let_grow() in the stage of @p state, which
        may not have been this object's last one. */
    void add_forces_between(const std::vector<unsigned int> &blocks,
                            const std::vector<GrowingWater> &growing,
                            const State<2> &state,
                            dealii::Tensor<1, 2> *force) const;
    /** Begins stage @p name, with steady flow at once if that is wanted.
        Collective. */
    void begin_stage(const std::string &name, State<2> &state);
    /** Lets the forces of the water in joints at the blocks of @p parts grow in
        the stage that has begun; of several parts the last one counts. */
    void let_grow(const std::vector<GrowingWater> &parts);
    /** Continues it with the water of @p state. Collective. */
    void resume_stage(const State<2> &state);
    /** Volumes of @p state until @p time by the clock of loads, not before the
        last solution [s]. */
    FlowVolumes volumes(const State<2> &state, double time) const;
    /** Whether there is water in the stage. */
    bool acts() const
    {
      return now.acts;
    }

    /** Solves the flow if it is due in this step. */
    void update(const StepContext &step, State<2> &state) override;
    void add_loads(const TimePoint &time,
                   dealii::Tensor<1, 2> *force) const override;
    double external_power(const TimePoint &time,
                          const dealii::Tensor<1, 2> *velocity) const override;
    /** Bound of the stiffness of the water in explicit steps at each owned
        node, as of ForceOperator::add_stiffness_bound() [N/m]. */
    std::vector<NodeStiffness<2>> stiffness_bound() const;

    /** Takes the water of the last equilibrium, @p state. */
    void begin_step(const State<2> &state);
    /**
     * Solves the flow with the apertures of @p nodes, which are in equilibrium
     * with the present pressures, @p end of a step, which began with the last
     * equilibrium. If the pressures were others there are new ones, for which
     * another equilibrium is to be found. Collective.
     */
    enum class Followed
    {
      balanced, /**< pressures and apertures belong together */
      changed,  /**< there are new pressures */
      lost      /**< they do not come into balance */
    };
    Followed follow(const NodeRecord<2> *nodes, const TimePoint &end);
    /** Gives the water of follow() to @p state. */
    void commit(State<2> &state) const
    {
      if (now.acts)
        state.get<JointFlowState>() = now;
    }

    const WaterParameters &parameters() const
    {
      return given;
    }
    /** The network of flow and where it lies in the mesh. */
    const JointChannels &channels() const
    {
      return places;
    }

  private:
    /** Opens and closes channels and finds ends at absent blocks, and where
        blocks were placed. */
    void find_open_channels(const State<2> &state);
    /** Gives channels the apertures of @p nodes; collective. */
    void set_apertures(const NodeRecord<2> *nodes);
    FlowConditions conditions(const TimePoint &time) const;
    /** Flow over @p dt since @p before [s]. */
    FlowSolution solve(const TimePoint &time, double dt,
                       const JointFlowState &before) const;
    /** Throws a RunError about water without a way out. */
    FlowSolution solve_steady(const FlowConditions &at,
                              const JointFlowState &before) const;
    /** Gives @p solution the water with which a stage begins, or in which flow
        @p begins. */
    void start_free_surface(bool begins, FlowSolution &solution) const;
    /** Makes @p solution, of the last @p dt since @p before, that of now. */
    void take(const FlowSolution &solution, double time, double dt,
              const JointFlowState &before);
    /** Adds what flows until @p time after the last solution, if that is
        steady, to the volumes of @p water. */
    void flow_on(double time, JointFlowState &water) const;
    /** Adds the forces of the water @p water in the channel @p c to owned
        nodes. */
    void add_forces_in(unsigned int c, const JointFlowState &water,
                       std::map<unsigned int, dealii::Tensor<1, 2>> &sum) const;
    /** Which of @p parts counts for the channel @p c; their number: none. */
    std::size_t part_of(unsigned int c,
                        const std::vector<GrowingWater> &parts) const;
    /** Forces of the pressures of now. */
    void find_forces();

    const WaterParameters given;
    const NodeMap<2> &node_map;
    const MatchedJoints &joints;
    const JointChannels places;
    FlowNetwork flow_network;            /**< with the apertures of now */
    std::vector<std::uint8_t> is_wall;   /**< nodes at absent blocks */
    std::vector<double> compliance;      /**< of nodes [m^3/Pa] */
    AlignedArray<double> placed_opening; /**< see JointHistory [m] */

    JointFlowState now, before;
    /** Forces on nodes. */
    struct Forces
    {
      std::vector<unsigned int> nodes;          /**< local, owned */
      std::vector<dealii::Tensor<1, 2>> values; /**< [N] */

      void set(const std::map<unsigned int, dealii::Tensor<1, 2>> &sum);
    };
    Forces forces; /**< of all water that is there */
    /** What grows in the stage, a part of these. */
    struct GrowingForces
    {
      GrowingWater given;
      std::vector<std::uint8_t> has; /**< channels */
      Forces forces;
    };
    std::vector<GrowingForces> growing;
    FixedPointAcceleration acceleration;
    unsigned int n_iterations = 0;
  };
} // namespace quoin

#endif
