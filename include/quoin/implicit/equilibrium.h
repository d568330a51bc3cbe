// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_equilibrium_h
#define quoin_implicit_equilibrium_h

#include <quoin/farfield/static_far_field.h>
#include <quoin/dynamics/release.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/loads/nodal_load.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  /** What acts at a configuration, and what brought it there. */
  struct Balance
  {
    AlignedArray<NodeVector<2>> force; /**< out of balance, owned nodes [N] */
    AlignedArray<NodeVector<2>> external; /**< of loads, part of it [N] */
    /** Of bodies, besides what acts on their nodes [N, N m]. */
    std::vector<std::array<double, 3>> drives, held;
    AlignedArray<NodeVector<2>>
        drag;               /**< against the motion, not in force [N] */
    double unbalanced = 0.; /**< with it, summed over degrees of freedom [N] */
    double dragged    = 0.; /**< the sum of the drag [N] */
    double applied    = 0.; /**< by joints, loads and reactions [N] */

    JointHistory joints; /**< brought to the configuration */
    PlasticHistory plastic;
    double far_field_energy = 0.; /**< of all ranks [J] */
    /** By it on the nodes that are free there, x, y [N] and their moment about
     * the origin [N m], of this rank. */
    std::array<double, 3> far_field_force{ { 0., 0., 0. } };
    EnergyAccounts lost; /**< by joints and cells on the way, this rank [J] */

    /** Inelastic opening and slip on the way, mean over the joints that
        measure the path [m]. */
    double path = 0.;

    double ratio() const
    {
      return applied > 0. ? unbalanced / applied : unbalanced > 0. ? 1. : 0.;
    }
  };

  /** Where a step goes from a configuration. */
  struct Advance
  {
    double load_time = 0.; /**< there [s] */
    double released  = 1.; /**< there [-] */
  };

  /** Derivatives at a configuration, besides the stiffness matrix. */
  struct Slopes
  {
    /** Change of the residual as loads and given motions go all of an Advance
     * [N]. */
    DofMap::Vector by_advance;
    /** Changes of Balance::path: by degree of freedom [-], and as given motions
     * go all of an Advance [m]. */
    DofMap::Vector path_by_dof;
    double path_by_advance = 0.;
  };

  /**
   * The equations of equilibrium in a stage: residuals by the operators of the
   * explicit solver, and their derivative.
   */
  class Equilibrium
  {
  public:
    /**
     * Keeps references. @p path_sets: of each joint set, whether its inelastic
     * motion measures the path; @p far_field: what is beyond the blocks, or
     * null.
     */
    Equilibrium(const Model &model, DofMap &dof_map,
                const std::vector<const NodalLoad<2> *> &loads,
                const std::vector<bool> &path_sets, double stage_start,
                const StaticFarField *far_field);

    /** Forces of what was excavated act too, from now on; kept by reference. */
    void set_release(const Release &forces)
    {
      release = &forces;
    }

    /**
     * From now on nodes drag: by @p drag times a typical stiffness, shared out
     * by mass, times what they moved since the last equilibrium; 0: not.
     */
    void set_drag(const double new_drag)
    {
      drag = new_drag;
    }

    /**
     * Forces at @p configuration, to which the histories of @p committed are
     * brought. @p broken: see MatchedJoints::linearise(). Collective.
     */
    void find_forces(const State<2> &committed,
                     const Configuration &configuration,
                     const std::vector<std::uint8_t> &broken, Balance &balance);

    /**
     * The same and derivatives: stiffness() and @p slopes, for increments that
     * DofMap::constraints() then describe. Collective.
     */
    void linearise(const State<2> &committed,
                   const Configuration &configuration,
                   const std::vector<std::uint8_t> &broken,
                   const Advance &advance, Balance &balance, Slopes &slopes);

    const dealii::TrilinosWrappers::SparseMatrix &stiffness() const
    {
      return matrix;
    }

    /** Whether any joint measures the path. */
    bool measures_path() const
    {
      return path_area > 0.;
    }

  private:
    void make_pattern();
    void find_far_stiffness();
    /** For models without deformable blocks: the stiffest point [N/m]. */
    double joint_stiffness() const;
    void add_forces(const State<2> &committed,
                    const Configuration &configuration,
                    const std::vector<std::uint8_t> &broken, Balance &balance,
                    Slopes *slopes);
    void add_loads(const State<2> &committed,
                   const Configuration &configuration, Balance &balance);
    void add_drag(const State<2> &committed, const Configuration &configuration,
                  Balance &balance, Slopes *slopes);
    /** Of loads, on nodes that are there. */
    void add_external(double load_time,
                      AlignedArray<NodeVector<2>> &force) const;
    void find_ratio(const AlignedArray<NodeVector<2>> &applied,
                    Balance &balance);
    /** Adds @p share of an element with @p n nodes, its degrees of freedom
        those of dof_map, and what its given motion takes from by_advance. */
    template <std::size_t size>
    void
    add_stiffness(const unsigned int *nodes, unsigned int n,
                  const std::array<std::array<double, size>, size> &element,
                  double share, DofMap::Vector &by_advance);
    void add_far_field(const State<2> &committed,
                       const Configuration &configuration, Balance &balance,
                       const Slopes *slopes);
    void fill_unused_rows();
    void add_turning(const AlignedArray<NodeVector<2>> &force);

    const Model &model;
    DofMap &dof_map;
    const std::vector<const NodalLoad<2> *> loads;
    const std::vector<bool> path_sets;
    const double stage_start;
    const Release *release = nullptr;
    MPI_Comm communicator;
    double path_area     = 0.; /**< of the joints that measure the path [m^2] */
    double least_applied = 0.; /**< Balance::applied is not less [N] */
    double drag          = 0.; /**< [-] */
    std::vector<double> drag_stiffness; /**< of local nodes, for 1 [N/m] */

    const StaticFarField *far_field;
    /** Minus the derivative of its forces on free degrees of freedom. */
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
        far_stiffness;
    std::vector<DofMap::Index> far_rows, far_columns; /**< of this rank, all */

    dealii::TrilinosWrappers::SparseMatrix matrix;
    dealii::FullMatrix<double> element_matrix;
    dealii::Vector<double> no_load; /**< of an element */
    std::vector<DofMap::Index> element_dofs;
    AlignedArray<NodeVector<2>> joint_force;
  };
} // namespace quoin

#endif
