// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_base_state_h
#define quoin_base_state_h

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <vector>

namespace quoin
{
  /** Allocator for arrays that vector loads may touch: 64-byte aligned. */
  template <typename T>
  struct CacheAlignedAllocator
  {
    using value_type        = T;
    CacheAlignedAllocator() = default;
    template <typename U>
    CacheAlignedAllocator(const CacheAlignedAllocator<U> &)
    {
    }
    T *allocate(const std::size_t n)
    {
      return static_cast<T *>(
          ::operator new(n * sizeof(T), std::align_val_t(64)));
    }
    void deallocate(T *p, std::size_t)
    {
      ::operator delete(p, std::align_val_t(64));
    }
    template <typename U>
    bool operator==(const CacheAlignedAllocator<U> &) const
    {
      return true;
    }
    template <typename U>
    bool operator!=(const CacheAlignedAllocator<U> &) const
    {
      return false;
    }
  };

  template <typename T>
  using AlignedArray = std::vector<T, CacheAlignedAllocator<T>>;

  /**
   * One node of a block: reference position X and displacement u [m]; the
   * current position is X + u. Kept together, in two dimensions in 32 bytes,
   * because the block kernel loads both of every node it enters.
   */
  template <int dim>
  struct alignas(dim == 2 ? 32 : 16) NodeRecord
  {
    double X[dim];
    double u[dim];
  };

  /** A pair of components per node: velocity [m/s] or force [N]. */
  template <int dim>
  struct alignas(dim == 2 ? 16 : 8) NodeVector
  {
    double v[dim];
  };

  /** What a joint point has been through; the order is written to output. */
  enum class JointState : std::uint8_t
  {
    intact   = 0, /**< never failed */
    slipping = 1, /**< at the shear limit now */
    slipped  = 2, /**< failed earlier, closed and sticking now */
    open     = 3  /**< failed in tension or open now */
  };

  /**
   * Histories of the joint points, structure of arrays, one entry per point.
   * Tension and opening are positive; slip is positive when the upper side
   * moves along s = (n_y, -n_x), n the normal from the lower to the upper
   * side: to the right on a horizontal joint.
   */
  struct JointHistory
  {
    AlignedArray<double> normal_traction; /**< [Pa] */
    AlignedArray<double> shear_traction;  /**< [Pa] */
    AlignedArray<double> plastic_slip;    /**< inelastic slip [m] */
    AlignedArray<double> plastic_opening; /**< dilation, offsets [m] */
    /** Of each point n_internal numbers, the internal variables of its law. */
    AlignedArray<double> internal;
    unsigned int n_internal = 0;
    AlignedArray<JointState> state;
    /** Of each segment, two points: it is a general contact by now. */
    AlignedArray<std::uint8_t> handed_over;

    void resize(const std::size_t n, const unsigned int n_internal = 0)
    {
      this->n_internal = n_internal;
      internal.resize(n * n_internal, 0.);
      normal_traction.resize(n, 0.);
      shear_traction.resize(n, 0.);
      plastic_slip.resize(n, 0.);
      plastic_opening.resize(n, 0.);
      state.resize(n, JointState::intact);
      handed_over.resize(n / 2, 0);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &normal_traction &shear_traction &plastic_slip &plastic_opening
          &internal &n_internal &state &handed_over;
    }
  };

  /**
   * A cell of a material that yields, in the frame that turns with it:
   * components xx, yy, xy (the tensor's) and zz. One cache line.
   */
  struct alignas(64) PlasticCell
  {
    double strain[4]{}; /**< plastic strain [-] */
    double stress[4]{}; /**< as last computed, tension positive [Pa] */
  };

  /**
   * Histories of the deformable cells of this rank; empty unless one of them
   * yields. See MohrCoulomb.
   */
  struct PlasticHistory
  {
    AlignedArray<PlasticCell> cells;
    AlignedArray<double> shear;          /**< accumulated plastic shear [-] */
    AlignedArray<std::uint8_t> yielding; /**< bits of namespace yielding */

    void resize(const std::size_t n)
    {
      cells.resize(n);
      shear.resize(n, 0.);
      yielding.resize(n, 0);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &cells &shear &yielding;
    }
  };

  /**
   * Work and energy accumulated since the start of the run [J]. Each work is
   * the exact trapezoidal one of the central difference scheme, so that with
   * elastic forces the balance closes to rounding.
   */
  struct EnergyAccounts
  {
    double external = 0.; /**< done by loads and prescribed motion */
    double friction = 0.; /**< dissipated in slip and dilation of joints */
    double fracture = 0.; /**< lost when joints break */
    double crushing = 0.; /**< dissipated by crushed joints */
    double plastic  = 0.; /**< dissipated by blocks that yield */
    double damping  = 0.; /**< taken by local, adaptive, Rayleigh damping */
    double viscous  = 0.; /**< left through viscous boundaries */
    double contact  = 0.; /**< lost as contacts changed their length */
    double radiated = 0.; /**< given to boundary elements */

    EnergyAccounts &operator+=(const EnergyAccounts &other)
    {
      external += other.external;
      friction += other.friction;
      fracture += other.fracture;
      crushing += other.crushing;
      plastic += other.plastic;
      damping += other.damping;
      viscous += other.viscous;
      contact += other.contact;
      radiated += other.radiated;
      return *this;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &external &friction &fracture &crushing &plastic &damping &viscous
          &contact &radiated;
    }
  };

  /** One end of the overlap of two edges in contact; as JointHistory. */
  struct ContactPoint
  {
    double normal_traction = 0.; /**< [Pa] */
    double shear_traction  = 0.; /**< [Pa] */
    double plastic_slip    = 0.; /**< [m] */
    double plastic_opening = 0.; /**< [m] */
    double slip_offset     = 0.; /**< slip at the anchors [m] */
    double anchor_lower    = 0.; /**< where on the edges, 0 to 1, slip is */
    double anchor_upper    = 0.; /**< counted from */
    double area            = 0.; /**< as last used [m^2] */
    /** Internal variables of its law; there is room for most_internal. */
    static constexpr unsigned int most_internal = 4;
    double internal[most_internal]{};
    JointState state = JointState::slipped;
  };

  /** Two edges of blocks that touch or may soon do so. */
  struct ContactPair
  {
    unsigned int lower     = 0; /**< edges, see ContactEdges */
    unsigned int upper     = 0;
    unsigned int set       = 0; /**< of joints, whose law it follows */
    std::uint8_t active    = 0; /**< whether the points have a history */
    std::uint8_t was_joint = 0; /**< whether it was a matched joint */
    std::uint8_t was_open  = 0; /**< whether the edges were seen apart */
    /** Slip of the matched joint that became this pair [m], and what of it is
        still allowed for in the overlap. */
    double shift       = 0.;
    double shift_start = 0.; /**< slip at that time [m] */
    ContactPoint points[2];
  };

  /** Contacts that come and go; empty if displacements are small. */
  struct ContactState
  {
    AlignedArray<ContactPair> pairs; /**< ascending in their edges */

    AlignedArray<std::uint8_t> handed_over; /**< of interfaces of joints */

    /** Of the boundary nodes, when pairs were last searched [m]. */
    AlignedArray<NodeVector<2>> search_positions;
    std::uint64_t next_check = 0; /**< step of the next look at motions */
    std::uint64_t n_searches = 0;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &pairs &handed_over &search_positions &next_check &n_searches;
    }
  };

  /** A rigid platen: freedoms x [m], y [m], rotation [rad, anticlockwise]. */
  struct PlatenState
  {
    bool active = false;
    double centre[2]{};       /**< where it was when it took hold [m] */
    double displacement[3]{}; /**< since then */
    double stage_start[3]{};  /**< displacement at that time */
    double velocity[3]{};     /**< at time - dt/2 */
    std::vector<double> arms; /**< x, y of each node, from centre, then [m] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &centre &displacement &stage_start &velocity &arms;
    }
  };

  /** Boundary elements coupled to the blocks; see FarField. */
  struct FarFieldState
  {
    bool active           = false;    /**< whether it has begun */
    std::uint64_t n_steps = 0;        /**< of the boundary elements, done */
    unsigned int substep  = 0;        /**< block steps done in the next */
    std::vector<double> held;         /**< forces on its nodes [N] */
    std::vector<double> last_motion;  /**< of elements, interface [m] */
    std::vector<double> origin;       /**< the same when it began [m] */
    std::vector<double> frozen;       /**< p_h of the step under way [Pa] */
    std::vector<double> velocity_sum; /**< over block steps [m] */
    std::vector<double> traction_sum; /**< over block steps [Pa] */
    double duration   = 0.;           /**< of those block steps [s] */
    double square_sum = 0.;           /**< of v Z0 v over block steps [J] */
    // As FarField::Ledger says.
    double radiated    = 0.; /**< [J] */
    double substep_sum = 0.; /**< its substeps [J] */
    double incident    = 0.; /**< [J] */
    double given       = 0.; /**< [J] */
    double mismatch    = 0.; /**< [-] */
    /** Of all boundary elements in the last step, scattered. */
    std::vector<double> displacement, velocity, traction;
    std::vector<double> history; /**< in checkpoints */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &n_steps &substep &held &last_motion &origin &frozen
          &velocity_sum &traction_sum &duration &square_sum &radiated
              &substep_sum &incident &given &mismatch &displacement &velocity
                  &traction &history;
    }
  };

  /** Static boundary elements beyond the blocks; see StaticFarField. */
  struct StaticFarFieldState
  {
    bool active = false;        /**< whether it has begun */
    std::vector<double> held;   /**< forces on its nodes [N] */
    std::vector<double> origin; /**< motion of elements at its start [m] */
    double stored        = 0.;  /**< elastic energy of the domain [J] */
    double stored_before = 0.;  /**< when it began [J] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &held &origin &stored &stored_before;
    }
  };

  /** A viscous boundary that came after other stages. */
  struct ViscousBoundaryState
  {
    bool active = false;      /**< whether it has begun */
    std::vector<double> held; /**< forces on its nodes [N]; empty: none */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &held;
    }
  };

  /** A column beside the blocks; see FreeFieldBoundary. */
  struct FreeFieldState
  {
    bool active = false;              /**< whether it has begun */
    std::vector<double> displacement; /**< x, y of its nodes [m] */
    std::vector<double> velocity;     /**< the same at time - dt/2 [m/s] */
    std::vector<double> held;         /**< forces on nodes of blocks [N] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &active &displacement &velocity &held;
    }
  };

  template <int dim>
  struct State;

  /** What the implicit solver keeps from step to step; see ImplicitSolver. */
  template <int dim>
  struct ImplicitState
  {
    /** Out-of-balance forces with which the stage began, x, y of owned nodes
        and three of each platen [N, N m]; empty: none. */
    std::vector<double> held;
    double released  = 1.; /**< share of them that is gone [-] */
    double step      = 0.; /**< to try next, share of the stage [-] */
    double last_step = 0.; /**< of the loads that converged last, likewise */

    bool follows_path  = false; /**< the load time is an unknown */
    double path_step   = 0.;    /**< to try next, of the path's length [m] */
    double path_length = 0.;    /**< in the stage so far [m] */
    double farthest    = 0.;    /**< load time reached in the stage [s] */
    unsigned int ahead = 0;     /**< steps on the path that reached farther */

    bool jumps          = false; /**< on the way to another equilibrium */
    double jump_time    = 0.;    /**< load time of that [s] */
    double drag_step    = 0.;    /**< to try next, of the way [-] */
    unsigned int n_drag = 0;     /**< steps of the way so far */
    double jump_loss    = 0.;    /**< taken by the drag since it began [J] */
    /** In checkpoints within a jump: the equilibrium before it. */
    std::vector<State<dim>> before_jump;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &held &released &step &last_step &follows_path &path_step
          &path_length &farthest &ahead &jumps &jump_time &drag_step &n_drag
              &jump_loss &before_jump;
    }
  };

  /** A rigid block: freedoms x [m], y [m], rotation [rad, anticlockwise]. */
  struct RigidBlockState
  {
    double displacement[2]{}; /**< of the centroid, from the reference */
    double rotation = 0.;     /**< counts full turns */
    double velocity[3]{};     /**< of the centroid and spin, at time - dt/2 */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &displacement &rotation &velocity;
    }
  };

  /** Marks of State::block_marks. */
  namespace block_mark
  {
    constexpr std::uint8_t present  = 0;
    constexpr std::uint8_t left_box = 1; /**< present, outside the box */
    constexpr std::uint8_t removed  = 2; /**< deleted outside the box */
    constexpr std::uint8_t absent   = 3; /**< excavated, or not placed yet */
  }                                      // namespace block_mark

  /** What excavated blocks exerted on those that stay, as it is let go. */
  struct HeldForces
  {
    /** x, y of owned nodes, as the blocks were taken away [N]. */
    std::vector<double> force;
    double left        = 1.; /**< share where the stage begins [-] */
    double left_at_end = 1.; /**< and at the end of its release [-] */

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &force &left &left_at_end;
    }
  };

  /** What the stages did to the model; see Construction. */
  struct ConstructionState
  {
    std::vector<HeldForces> held; /**< of each excavation not let go yet */
    /** xx, yy, xy, zz of each deformable cell without strain, as changes of
        materials and fill left it [Pa]; empty: as at the start. */
    AlignedArray<double> initial_stress;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &held &initial_stress;
    }
  };

  /**
   * All that changes in time. Everything else is constant once prepared, so a
   * checkpoint is this and the parameters.
   *
   * Nodes are numbered block by block, the nodes a rank owns first and the
   * joint partners it mirrors after them.
   */
  template <int dim>
  struct State
  {
    double time              = 0.; /**< [s] */
    std::uint64_t step       = 0;  /**< since the start of the run */
    unsigned int stage       = 0;
    double stage_start       = 0.; /**< [s] */
    std::uint64_t stage_step = 0;  /**< steps done in this stage */
    double load_time         = 0.; /**< in the stage, by the loads' clock [s] */
    double load_rate         = 1.; /**< of that clock [-] */
    double load_rate_growth  = 1.; /**< a step [-] */

    AlignedArray<NodeRecord<dim>> nodes;
    AlignedArray<NodeVector<dim>> velocity; /**< at time - dt/2 */
    PlasticHistory plastic;
    JointHistory joints;
    ContactState contacts;            /**< empty if displacements are small */
    std::vector<PlatenState> platens; /**< in the order of the loads */
    std::vector<RigidBlockState> rigid_blocks; /**< of this rank */
    FarFieldState far_field;
    StaticFarFieldState static_far_field;
    std::vector<ViscousBoundaryState> viscous_boundaries; /**< as platens */
    std::vector<FreeFieldState> free_fields; /**< in the order of the loads */
    ImplicitState<dim> implicit;
    /** Of all blocks of the mesh, block_mark; empty: all are present. */
    AlignedArray<std::uint8_t> block_marks;
    ConstructionState construction;
    double adaptive_damping   = 0.; /**< [1/s] */
    double previous_time_step = 0.; /**< [s] */
    double unbalanced_ratio   = 1.; /**< as last measured [-] */

    /** Complete at time, and what the step under way adds for time + dt/2. */
    EnergyAccounts energy, pending;

    /** Whether @p block of the mesh was taken away or is not placed yet. */
    bool is_absent(const unsigned int block) const
    {
      return !block_marks.empty() && block_marks[block] >= block_mark::removed;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &time &step &stage &stage_start &stage_step &load_time &load_rate
          &load_rate_growth &nodes &velocity &plastic &joints &contacts &platens
              &rigid_blocks &far_field &static_far_field &viscous_boundaries
                  &free_fields &implicit &block_marks &construction
                      &adaptive_damping &previous_time_step &unbalanced_ratio
                          &energy &pending;
    }
  };
} // namespace quoin

#endif
