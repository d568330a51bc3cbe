// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_far_field_h
#define quoin_farfield_far_field_h

#include <quoin/base/eigen_core.h>
#include <quoin/farfield/interface_transfer.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/elastodynamics/boundary.h>
#include <quoin/tdbem/boundary_history.h>
#include <quoin/tdbem/time_marching.h>
#include <quoin/elastodynamics/elastic_medium.h>
#include <quoin/tdbem/formulation.h>

#include <Eigen/Dense>
#include <Eigen/SparseCore>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace quoin
{
  /** Coupling of the boundary elements' forces to the nodes in a step. */
  enum class CouplingScheme
  {
    /**
     * The impedance of the newest step acts on the mean velocity of each
     * block step, implicitly on the nodes of the interface alone; the history
     * is frozen. Does not lower the critical step, and creates no energy if
     * the boundary elements are passive.
     */
    implicit,
    /**
     * Eqs. 17 and 18 of @cite JinWangZhang1998: the displacement at the end
     * of the boundary elements' step is extrapolated from that of the block
     * step; their traction is the mean of those that acted. Unstable in most
     * uses.
     */
    staggered
  };

  /** Domain beyond the interface. */
  struct FarFieldDomain
  {
    Boundary boundary;
    ElasticMedium medium{};
    /** Elements of @p boundary along the blocks. */
    std::vector<unsigned int> interface;
    /** Whether the traction is prescribed, for each unknown off the interface.
     */
    std::vector<bool> traction_is_given;

    FormulationOptions formulation; /**< without time step and n_steps */
    CouplingScheme scheme = CouplingScheme::implicit;

    /**
     * Boundary values of the step from begin to end [s], total fields; those on
     * the interface are not used. Null: zero.
     */
    std::function<Eigen::VectorXd(double begin, double end)> given;
  };

  /** Energies of the boundary elements' steps finished so far [J]. */
  struct FarFieldLedger
  {
    /** Work of the scattered tractions on the scattered motion. */
    double radiated = 0.;
    /** Energy lost in the block steps of a boundary element step: not negative.
     */
    double substeps = 0.;
    /** Energy from the incident field. */
    double incident = 0.;
    /** Work like radiated on the rest of the boundary, by boundary values. */
    double given = 0.;
    /** Largest |p - (p_h + Z0 v)| by the largest p: rounding [-]. */
    double mismatch = 0.;
  };

  /** Boundary elements coupled to the blocks; see FarField. */
  struct FarFieldState
  {
    static constexpr const char *slice_name = "far field";

    bool active           = false; /**< whether it has begun */
    std::uint64_t n_steps = 0; /**< completed steps of the boundary elements */
    unsigned int substep  = 0; /**< block steps done in the next */
    std::vector<double> held;  /**< forces on its nodes [N] */
    /** Motion of elements on the interface, last step [m]. */
    std::vector<double> last_motion;
    /** Motion of elements when the far field began [m]. */
    std::vector<double> origin;
    std::vector<double> frozen;       /**< p_h of the step under way [Pa] */
    std::vector<double> velocity_sum; /**< over block steps [m] */
    std::vector<double> traction_sum; /**< over block steps [Pa] */
    double duration   = 0.;           /**< duration of those block steps [s] */
    double square_sum = 0.;           /**< sum of v Z0 v over block steps [J] */
    FarFieldLedger ledger;
    /** Scattered field of all boundary elements in the last step: [m], [m/s],
        [Pa]. */
    std::vector<double> displacement, velocity, traction;
    SavedHistory history; /**< convolution history, saved in checkpoints */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active, n_steps, substep);
      visitor.own(held, 2);
      visitor.same(last_motion, origin, frozen, velocity_sum, traction_sum,
                   duration, square_sum, ledger.radiated, ledger.substeps,
                   ledger.incident, ledger.given, ledger.mismatch, displacement,
                   velocity, traction);
      history.visit(visitor);
    }
  };

  /**
   * Boundary elements beyond the outer boundary of blocks, from which waves
   * come in and into which they leave (@cite JinWangZhang1998, Eqs. 14-18).
   *
   * The elements take steps of several block steps each, K. In step M their
   * tractions on the interface are p = p_h + Z0 v, v the mean
   * velocity over each element: Z0, the lag-0 impedance condensed to the
   * interface, times a velocity, and p_h, which follows from the history, the
   * boundary values and the incident field, and is frozen during the step.
   *
   * Time of the boundary elements begins when it first acts. What forces are
   * unbalanced on the interface then are held from there on: so reactions of a
   * static stage, or an initial stress, do not set anything in motion.
   */
  class FarField : public MotionConstraint<2>
  {
  public:
    /**
     * @p faces: of all ranks, along the interface; see faces_of_curves().
     * Throws an InputError that begins with the section.
     */
    FarField(const std::string &name, FarFieldDomain domain,
             const NodeMap<2> &node_map,
             const std::vector<BoundaryFace<2>> &faces, double thickness);
    ~FarField() override;

    /**
     * Must be called before a stage begins: the step of the boundary elements
     * [s], always the same, @p n_substeps block steps, and the most steps that
     * there will be. Makes the operators when called first; collective.
     */
    void set_time_step(double time_step, unsigned int n_substeps,
                       unsigned long n_steps);

    /**
     * Incident field on the whole boundary: displacements at a time
     * [m], and the tractions of the step from begin to end [Pa]. Must be
     * called before it first acts.
     */
    void set_incident_field(
        std::function<Eigen::VectorXd(double time)> displacement,
        std::function<Eigen::VectorXd(double begin, double end)> traction)
    {
      incident_displacement = std::move(displacement);
      incident_traction     = std::move(traction);
      last_incident.reset();
    }

    /** 0 before set_time_step() [s]. */
    double time_step() const
    {
      return dt;
    }
    unsigned int n_substeps() const
    {
      return substeps;
    }

    const FarFieldDomain &domain() const
    {
      return problem;
    }
    const InfluenceKernel &influence_kernel() const
    {
      return *kernel;
    }
    const BoundaryHistory &boundary_history() const
    {
      return *history;
    }

    /** Values given on the boundary in the last step, total fields; those on
        the interface are not used. */
    Eigen::VectorXd given_values(const State<2> &state) const;

    /** Total fields on the boundary, two entries per element. */
    struct TotalFields
    {
      Eigen::VectorXd displacement; /**< [m] */
      Eigen::VectorXd velocity;     /**< mean over the step [m/s] */
      Eigen::VectorXd traction;     /**< [Pa] */
    };
    /** Total fields after the last step. */
    TotalFields total_fields(const State<2> &state) const;

    void prepare(State<2> &state) const override;
    void begin_stage(State<2> &state, bool continues) override;
    void resume_stage(const State<2> &state) override;
    /** Called before a checkpoint: completes the state. */
    void save(State<2> &state) const;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;

  private:
    using SparseMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    void start(const std::vector<CapturedNode<2>> &captured, State<2> &state);
    void prepare_step(const StepContext &step,
                      const std::vector<CapturedNode<2>> &captured);
    /** Time of the blocks that the boundary elements have reached after so many
        steps [s]: velocities of the blocks are centred, so that the K steps
       that begin with the positions of 0 move them until half a step of the
       blocks before the step of the boundary elements is over. */
    double time_of_steps(std::uint64_t n_steps) const;
    void find_incident(const FarFieldState &far);
    void begin_element_step(State<2> &state);
    void finish_element_step(State<2> &state);
    /** All over the boundary, of a step of the boundary elements. */
    Eigen::VectorXd scattered_values(std::uint64_t step);
    /** Incident waves all over the boundary in a step of the boundary elements:
        displacements at its begin and end, mean tractions. */
    struct IncidentStep
    {
      std::uint64_t step = 0;
      Eigen::VectorXd before, displacement, traction;
    };
    /** The incident waves in @p step, which are evaluated once. */
    const IncidentStep &incident_step(std::uint64_t step);

    FarFieldDomain problem;
    InterfaceTransfer transfer;
    std::function<Eigen::VectorXd(double)>
        incident_displacement; /**< null: no incident wave */
    std::function<Eigen::VectorXd(double, double)> incident_traction;
    std::optional<IncidentStep> last_incident;
    bool incident_is_due = false; /**< in a run that goes on */
    double thickness;
    MPI_Comm communicator;
    bool is_first_rank;
    /** Degrees of freedom of the interface. */
    std::vector<unsigned int> unknowns;
    Eigen::VectorXd area;       /**< areas of these degrees of freedom [m^2] */
    Eigen::VectorXd outer_area; /**< areas off the interface, 0 on it [m^2] */

    double dt             = 0.;
    unsigned int substeps = 0;
    std::unique_ptr<InfluenceKernel> kernel;
    std::unique_ptr<BoundaryHistory> history;
    std::unique_ptr<TimeMarching> marching;
    Eigen::MatrixXd stiffness; /**< dp/du of one step [Pa/m] */
    Eigen::MatrixXd impedance; /**< Z0 [Pa s/m] */

    /** For the block steps, as long as these are the same; 0: not made. */
    double prepared_step = 0., prepared_damping = 0.;
    /** Staggered: the step that begins at rest belongs to no other. */
    bool from_rest = false;
    std::vector<double> gain;     /**< velocity by force, of the nodes */
    SparseMatrix mobility;        /**< v of elements by their p [m/(Pa s)] */
    Eigen::MatrixXd from_history; /**< p by p_h */
    SparseMatrix from_motion;     /**< p by velocities before and free */
    /** from_history times frozen, or not made since either changed. */
    Eigen::VectorXd p_of_history;
    bool p_of_history_is_due = true;

    /** Tractions [Pa] and velocities [m/s] of the elements in this step. */
    Eigen::VectorXd p, v_before, v_free, v_after, v_mean;
    /** Displacement of the elements since the start [m]. */
    Eigen::VectorXd last_u;
    /** Values of the boundary elements' present step. */
    Eigen::VectorXd frozen, incident_u, incident_velocity, incident_p;
  };
} // namespace quoin

#endif
