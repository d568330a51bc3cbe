// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_structures_beams_h
#define quoin_structures_beams_h

#include <quoin/base/thickness.h>
#include <quoin/blocks/node_update.h>
#include <quoin/joints/joint_history.h>
#include <quoin/joint_laws/joint_parameters.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/mesh/node_map.h>
#include <quoin/operators/force_operator.h>
#include <quoin/structures/beam_parameters.h>

#include <Eigen/Dense>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** The nodes of all beams, the same on all ranks. */
  struct BeamState
  {
    static constexpr const char *slice_name = "beams";

    AlignedArray<std::uint8_t> placed; /**< flag of each beam */
    AlignedArray<NodeRecord<2>> nodes; /**< X: where they were placed */
    AlignedArray<dealii::Tensor<1, 2>> velocity; /**< at time - dt/2 */
    AlignedArray<double> plastic;        /**< plastic turning angle [rad] */
    AlignedArray<double> moment;         /**< of the last step [N m] */
    AlignedArray<std::uint8_t> attached; /**< flag of each interface point */
    /** Opening and slip at placement [m]. */
    AlignedArray<dealii::Tensor<1, 2>> offset;
    JointHistory interface; /**< of the interface points */
    // What the last step leaves behind.
    AlignedArray<double> block_position;     /**< x, y of these points [m] */
    AlignedArray<dealii::Tensor<1, 2>> load; /**< of equilibrium [N] */
    double stored_strain = 0., stored_joint = 0.; /**< [J] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(placed, nodes, velocity, plastic, moment, attached, offset,
                   block_position, load, stored_strain, stored_joint);
      visitor.same(interface.normal_traction, interface.shear_traction,
                   interface.plastic_slip, interface.plastic_opening,
                   interface.state);
      for (AlignedArray<double> &variable : interface.internal)
        visitor.same(variable);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive_members(archive, *this);
    }
  };

  /** Mass of each node of each placed beam, without and with that of a scaled
      step [kg]. */
  using BeamMasses = std::vector<std::vector<std::array<double, 2>>>;

  /** Results of one beam at its nodes, of one beam of the spacing. */
  struct BeamFields
  {
    std::vector<std::array<double, 2>> position, displacement;
    std::vector<double> axial, shear, moment; /**< N, Q [N], M [N m] */
    std::vector<double> plastic;              /**< plastic turning [rad] */
    /** Stresses of the outer fibres [Pa], and the larger one of both by its
        strength [-]. */
    std::vector<double> least_stress, largest_stress, utilisation;
    /** Tractions [Pa], opening, slip [m] of a liner's interface, 0 else. */
    std::vector<double> normal_traction, shear_traction, opening, slip, state;
    bool is_closed = false;
  };

  /**
   * Euler-Bernoulli beams as discrete elastic rods: nodes with two
   * displacements each, straight segments with the axial force
   * N = E A (l - l0) / l0 and at nodes the moment M = E I (phi - phi0) / l0,
   * with the turning angle phi from one segment to the next and the mean length
   * l of both, which never is above the hinge moment. Of a line that is curved
   * at rest M = E I (phi / l0 - phi0 l / l0^2). Forces are the exact
   * derivatives of the stored energy, whatever the rotations. A liner's nodes
   * are at those of a boundary and connected to them by a joint law.
   *
   * All ranks have all beams and do the same with them; what they do to nodes
   * of blocks is done by the owner of the node, and the first rank counts
   * energies.
   */
  class Beams : public ForceOperator<2>
  {
  public:
    /** Keeps a reference to @p nodes. @p sets: of joints; @p thickness: of the
        model, @p group_thickness of each cell group [m]. Throws an InputError.
        Collective. */
    Beams(const std::vector<BeamParameters> &parameters,
          const NodeMap<2> &nodes, const std::vector<JointSetParameters> &sets,
          double thickness, const Thickness &group_thickness);

    const char *kind() const override
    {
      return "beams";
    }
    void prepare(State<2> &state) const override;

    /** Places the beams of the stage @p name, that begins or goes on. Throws an
        InputError. Collective. */
    void begin_stage(const std::string &name, State<2> &state);

    /** Takes from @p loads of the stage the gravity that acts everywhere. */
    void set_gravity(const std::vector<const NodalLoad<2> *> &loads);

    /** Finds masses of nodes so that @p scaled_step [s] is stable; 0: those of
        the beams. */
    void find_masses(double scaled_step, const State<2> &state);
    /** Masses of the nodes of placed beams, alike on all ranks [kg]. */
    BeamMasses masses(const State<2> &state) const;
    /** Stiffness of interfaces at each local node of blocks, as
        add_stiffness_bound() with r = 1 [N/m]; empty: there is none. */
    std::vector<double> interface_bound(const State<2> &state) const;
    /** Bound of omega^2 of the placed beams [1/s^2]. */
    double largest_eigenvalue(const State<2> &state) const;

    void add_forces(const StepContext &step, State<2> &state,
                    const NodeForces<2> &forces) override;
    void add_stored_energy(const State<2> &state,
                           EnergyAccounts &energies) const override;

    /** Stiffness of blocks at the interface points of each beam, x and y of
       each point from first_point() on: minus the derivative of the forces on
       them where the beam stays in equilibrium [N/m]. */
    using Condensed = std::vector<Eigen::MatrixXd>;

    /**
     * Finds the nodes of beams in equilibrium with the blocks of @p state at
     * @p time, from @p committed, the last equilibrium; adds forces to owned
     * nodes of blocks, updates BeamState and books dissipation and the work of
     * loads in State::energy. @p stiffness: null, or filled. Returns false if
     * there is no equilibrium. Collective.
     */
    bool settle(const TimePoint &time, const State<2> &committed,
                State<2> &state, dealii::Tensor<1, 2> *block_force,
                Condensed *stiffness) const;
    unsigned int n_points() const
    {
      return points.size();
    }
    /** Local owned node of an interface point, or NodeMap::none. */
    unsigned int node_of_point(const unsigned int p) const
    {
      return points[p].node;
    }
    unsigned int first_point(const unsigned int beam) const
    {
      return lines[beam].first_point;
    }
    unsigned int last_point(const unsigned int beam) const
    {
      return lines[beam].last_point;
    }

    /** What all beams add to the sums of a step, on the first rank. */
    struct Work
    {
      DampingWork damping;
      double unbalanced = 0., applied = 0.; /**< [N] */
    };
    /** Moves the nodes by the forces of add_forces() and books the work of
        loads. @p damping: whether there is any, and whether it is adaptive. */
    Work advance(const StepContext &step, bool damped, bool adaptive,
                 State<2> &state);

    /** As those of RigidBlocks, about the last step. */
    double kinetic_energy(const State<2> &state, double share) const;
    double squared_change(const State<2> &state) const;
    /** Kinetic energy of this rank with the velocities of @p state [J]. */
    double kinetic_energy(const State<2> &state) const;
    /** Throws a RunError if the motion is not finite. */
    void check_finite(const State<2> &state) const;

    /** Loads at @p time, numbers that change when they do. */
    std::vector<double> loads(const TimePoint &time) const;
    /** A line on each beam for the log. */
    std::vector<std::string> text() const;

    unsigned int n_beams() const
    {
      return lines.size();
    }
    /** Number of the beam @p name; n_beams(): there is none. */
    unsigned int find(const std::string &name) const;
    /** Node of @p beam that is nearest to @p point when it is not deformed. */
    unsigned int nearest_node(unsigned int beam,
                              const std::array<double, 2> &point) const;
    bool is_placed(const unsigned int beam, const State<2> &state) const
    {
      return state.get<BeamState>().placed[beam] != 0;
    }
    /** Fields of @p beam in @p state. */
    BeamFields fields(unsigned int beam, const State<2> &state) const;

  private:
    /** Nodes [begin, end) and constants of a beam; stiffness and strength are
        those in the thickness of the model. */
    struct Line
    {
      BeamParameters given;
      unsigned int begin, end;
      bool is_closed;
      double share;          /**< thickness of the model by the spacing [-] */
      double axial, bending; /**< E A [N], E I [N m^2] */
      double hinge; /**< largest moment [N m], or BeamParameters::by_section */
      unsigned int first_point, last_point; /**< into points */
      JointLaw law;
    };
    /** A node of blocks at a node of a liner. */
    struct Point
    {
      unsigned int node;  /**< local and owned, or none */
      unsigned int block; /**< in the whole mesh */
      unsigned int at;    /**< node of the beams */
      double side;        /**< 1: the block is on the left of the liner */
      double area;        /**< [m^2] */
    };
    /** Segment from its first node on. */
    struct Segment
    {
      double direction[2];
      double length, rest;
    };

    /** Mass of a node without that of a scaled step [kg]. */
    double own_mass(const Line &line, const unsigned int node) const
    {
      return line.share * line.given.density * line.given.area
             * rest_length[node];
    }
    void add_free_line(const BeamParameters &parameters);
    void add_liner(const BeamParameters &parameters,
                   const Thickness &group_thickness);
    unsigned int n_segments(const Line &line) const
    {
      return line.end - line.begin - (line.is_closed ? 0 : 1);
    }
    unsigned int next(const Line &line, const unsigned int node) const
    {
      return node + 1 == line.end ? line.begin : node + 1;
    }
    Segment segment(const Line &line, unsigned int first,
                    const BeamState &beams) const;
    /** Whether there is a moment at @p node, and the @p angle that it bends:
        phi - phi0, of a curved line phi - phi0 l/l0 [rad]. */
    bool turning(const Line &line, unsigned int node, const BeamState &beams,
                 double &angle) const;
    /** Moment at @p node [N m] for the elastic and plastic angles; @p plastic
        is updated. */
    double moment(const Line &line, unsigned int node, const BeamState &beams,
                  double angle, double &plastic) const;
    /** Largest moment at @p node [N m] and its derivative by the axial force
        there [m]. */
    std::array<double, 2> hinge_moment(const Line &line, unsigned int node,
                                       const BeamState &beams) const;
    /** Axial force of a segment [N]. */
    double axial_force(const Line &line, unsigned int first, const Segment &s,
                       const BeamState &beams) const;
    bool held(const Line &line, unsigned int node, unsigned int d) const;
    /** Unit tangent of a liner at @p node. */
    std::array<double, 2> tangent(const Line &line, unsigned int node,
                                  const BeamState &beams) const;
    /** Positions of the interface points in blocks; collective. */
    AlignedArray<double> block_positions(const State<2> &state) const;
    /** Opening and slip of point @p p at the positions of blocks. */
    std::array<double, 2> gap(const Line &line, unsigned int p,
                              const BeamState &beams, const double *position,
                              std::array<double, 2> &normal) const;
    void place(const Line &line, unsigned int beam, State<2> &state) const;
    /** Finds what follows from the places at rest. */
    void find_rest(const Line &line, const BeamState &beams);
    /** Updates plastic angles and moments; adds forces to the nodes and
        returns the sum of their sizes [N]. */
    double add_internal_forces(const Line &line, BeamState &beams,
                               EnergyAccounts &energy,
                               dealii::Tensor<1, 2> *force) const;
    /** Updates the interface, @p state tells which blocks are absent; the
        forces on blocks are the opposite of @p by_point, of each point [N]. */
    double add_interface_forces(const Line &line, const State<2> &state,
                                BeamState &beams, EnergyAccounts &energy,
                                dealii::Tensor<1, 2> *force,
                                dealii::Tensor<1, 2> *by_point) const;
    /** Minus the derivative of the forces on the nodes of @p line by their
        displacements [N/m], which went from @p before to @p now, and that of
        each of its interface points by its gap. */
    Eigen::MatrixXd stiffness(const Line &line, const State<2> &state,
                              const BeamState &before, const BeamState &now,
                              std::vector<Eigen::Matrix2d> &by_point) const;
    /** Equilibrium of one beam, see settle(). */
    bool settle(const Line &line, const TimePoint &time, const State<2> &marks,
                BeamState &beams, EnergyAccounts &energy,
                dealii::Tensor<1, 2> *by_point,
                Eigen::MatrixXd *condensed) const;
    /** Loads of one beam: weight included by length [N/m], at both ends [N]. */
    struct Loads
    {
      std::array<double, 2> by_length;
      std::array<std::array<double, 2>, 2> ends;
    };
    Loads loads_of(const Line &line, const TimePoint &time) const;
    /** The part of @p loads that acts at @p node [N]. */
    std::array<double, 2> load(const Line &line, unsigned int node,
                               const Loads &loads) const;
    unsigned int previous(const Line &line, const unsigned int node) const
    {
      return (node == line.begin ? line.end : node) - 1;
    }
    bool has_before(const Line &line, const unsigned int node) const
    {
      return node > line.begin || line.is_closed;
    }
    bool has_after(const Line &line, const unsigned int node) const
    {
      return node + 1 < line.end || line.is_closed;
    }
    /** Stiffness bound xx, yy, xy of each node [N/m]. */
    std::vector<NodeStiffness<2>> stiffness_bound_of(const State<2> &) const;

    const NodeMap<2> &node_map;
    const bool is_first_rank;
    const double model_thickness;
    std::vector<Line> lines;
    std::vector<Point> points;
    std::vector<std::array<double, 2>> rest; /**< of all nodes [m] */
    unsigned int n_internal_variables = 0;
    std::vector<const NodalLoad<2> *> gravity; /**< of the stage */

    // Each node of a placed beam at rest has the length of the segment that
    // begins there, the mean length [m], the turning angle [rad] and, where the
    // line is curved, the curvature [1/m].
    std::vector<double> rest_segment, rest_length, rest_angle, curvature;
    std::vector<double> mass, inverse_mass; /**< [kg], [1/kg] */
    AlignedArray<dealii::Tensor<1, 2>> force, viscous, velocity_before,
        point_force;
  };
} // namespace quoin

#endif
