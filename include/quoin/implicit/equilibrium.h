// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_equilibrium_h
#define quoin_implicit_equilibrium_h

#include <quoin/farfield/static_far_field.h>
#include <quoin/loading/load_pattern.h>
#include <quoin/implicit/dof_map.h>
#include <quoin/operators/force_operator.h>
#include <quoin/structures/beams.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  /** Forces at a configuration, and the state updated for it. */
  template <int dim>
  struct Balance
  {
    AlignedArray<dealii::Tensor<1, dim>>
        force; /**< unbalanced, owned nodes [N] */
    AlignedArray<dealii::Tensor<1, dim>>
        external; /**< of loads, part of it [N] */
    /** Drives of bodies and held forces, besides those on nodes [N, N m]. */
    BodyValues<dim> drives, held;
    AlignedArray<dealii::Tensor<1, dim>>
        drag;               /**< against the motion, not in force [N] */
    double unbalanced = 0.; /**< with drag, sum over all components [N] */
    double dragged    = 0.; /**< the sum of the drag [N] */
    double applied    = 0.; /**< by joints, loads and reactions [N] */

    /** Internal variables of operators, updated for the configuration, and the
        energy dissipated by this, of this rank [J]. */
    State<dim> state;
    double far_field_energy = 0.; /**< of all ranks [J] */
    /** Force x, y [N] of the far field on free nodes and its moment about the
        origin [N m], of this rank. */
    Resultant<2> far_field_force{};

    /** A beam that is in no equilibrium with the blocks; the unbalanced force
        is then infinite. Empty: none. */
    std::string failed_beam;

    /** What the controlled displacement of a load pattern lacks [m]. */
    double lacking = 0.;

    /** Increment of inelastic opening and slip, mean over the joints that
        measure the path [m]. */
    double path = 0.;

    double ratio() const
    {
      return applied > 0. ? unbalanced / applied : unbalanced > 0. ? 1. : 0.;
    }
  };

  /** Target of a step from a configuration. */
  struct Advance
  {
    double load_time = 0.;    /**< there [s] */
    double released  = 1.;    /**< there [-] */
    bool on_path     = false; /**< whether slopes of the path are needed */
  };

  /** Derivatives at a configuration, besides the stiffness matrix. */
  struct Slopes
  {
    /** Change of the residual by the loads and prescribed motions of a whole
        Advance [N]. */
    DofVector by_advance;
    /** Derivatives of Balance::path, if the Advance is on_path: by degree of
        freedom [-], and by the prescribed motions of a whole Advance [m]. */
    DofVector path_by_dof;
    double path_by_advance = 0.;
  };

  /**
   * The equations of equilibrium in a stage: residuals by the operators of the
   * explicit solver, and their derivative. With a load pattern, p and c of
   * LoadPattern, its factor is one more unknown and the controlled displacement
   * one more equation,
   * @f[ K \, \Delta u - p \, \Delta\lambda = r, \quad
   *     c \cdot \Delta u = \hat w(t) - w , @f]
   * in one matrix, which is regular also at a limit load, where K is not.
   *
   * Boundary elements and beams belong to two dimensions.
   */
  template <int dim>
  class Equilibrium
  {
  public:
    /** Operators of the explicit solver, with derivatives (linearise()) or
        forces that follow from time (add_loads()). */
    using Operators = std::vector<const ForceOperator<dim> *>;

    /**
     * Keeps references. @p path_sets: whether the inelastic motion of each
     * joint set measures the path; @p far_field: boundary elements, or null;
     * @p pattern: loads that a factor scales, or null; it needs a DofMap with
     * factor(). @p beams: those of the run, or null.
     */
    Equilibrium(const Model<dim> &model, DofMap<dim> &dof_map,
                const Operators &operators, const std::vector<bool> &path_sets,
                double stage_start, const StaticFarField *far_field,
                const LoadPattern<dim> *pattern = nullptr,
                const Beams *beams              = nullptr);

    /**
     * Sets the drag on nodes: @p drag times a typical stiffness, distributed by
     * mass, times their displacement since the last equilibrium; 0: none.
     */
    void set_drag(const double new_drag)
    {
      drag = new_drag;
    }

    /**
     * Finds forces at @p configuration and updates the internal variables of
     * @p committed for it. @p broken: see BreakingJoints.
     * Collective.
     */
    void find_forces(const State<dim> &committed,
                     const Configuration<dim> &configuration,
                     const std::vector<std::uint8_t> &broken,
                     Balance<dim> &balance);

    /**
     * As find_forces(), with derivatives: stiffness() and @p slopes, for
     * increments with DofMap::constraints(). Collective.
     */
    void linearise(const State<dim> &committed,
                   const Configuration<dim> &configuration,
                   const std::vector<std::uint8_t> &broken,
                   const Advance &advance, Balance<dim> &balance,
                   Slopes &slopes);

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
    /** Stiffest joint point, for models without deformable blocks [N/m]. */
    double joint_stiffness() const;
    void add_forces(const State<dim> &committed,
                    const Configuration<dim> &configuration,
                    const std::vector<std::uint8_t> &broken,
                    Balance<dim> &balance, Slopes *slopes,
                    bool on_path = false);
    void add_loads(const State<dim> &committed,
                   const Configuration<dim> &configuration,
                   Balance<dim> &balance);
    void add_drag(const State<dim> &committed,
                  const Configuration<dim> &configuration,
                  Balance<dim> &balance, Slopes *slopes);
    /** Adds forces of loads, with @p factor of the pattern, on nodes that are
        present. */
    void add_external(double load_time, double factor,
                      AlignedArray<dealii::Tensor<1, dim>> &force) const;
    /** Adds the column and the row of the factor to the matrix and, to the
        advance of a step to @p load_time [s], the displacement that it wants
        beside prescribed motions. */
    void add_pattern(const Configuration<dim> &configuration, double load_time,
                     DofVector &by_advance);
    void find_ratio(const AlignedArray<dealii::Tensor<1, dim>> &applied,
                    Balance<dim> &balance);
    /** Finds the values of the matrix that an element adds to. */
    void find_places(const ElementLinearisation<dim> &element);
    /** Adds an element to matrix and, by prescribed motion, @p by_advance. */
    void add_stiffness(const ElementLinearisation<dim> &element,
                       DofVector &by_advance);
    /** Whether the inelastic motion of @p element measures the path. */
    bool is_on_path(const ElementLinearisation<dim> &element) const
    {
      return element.inelastic_gradient && path_sets[element.set];
    }
    /** Adds the forces of an element to @p force and its derivatives to those
        of @p slopes, unless that is null. */
    void add_element(const ElementLinearisation<dim> &element,
                     AlignedArray<dealii::Tensor<1, dim>> &force, double &path,
                     bool on_path, Slopes *slopes);
    /** Numbers the interface points of beams and adds their entries. */
    void add_beam_entries(dealii::TrilinosWrappers::SparsityPattern &entries);
    /** Adds forces of beams to applied_force and, where @p slopes are wanted,
        their derivatives to the matrix. */
    void add_beams(const State<dim> &committed,
                   const Configuration<dim> &configuration,
                   Balance<dim> &balance, bool slopes);
    void add_far_field(const State<dim> &committed,
                       const Configuration<dim> &configuration,
                       Balance<dim> &balance, const Slopes *slopes);
    void fill_unused_rows();
    /** Adds the change of moments by the turn of the arms to the matrix and,
        by prescribed rotations, to @p by_advance. */
    void add_turning(const AlignedArray<dealii::Tensor<1, dim>> &force,
                     DofVector &by_advance);

    const Model<dim> &model;
    DofMap<dim> &dof_map;
    const Operators operators;
    const std::vector<bool> path_sets;
    const double stage_start;
    MPI_Comm communicator;
    double path_area     = 0.; /**< of the joints that measure the path [m^2] */
    double least_applied = 0.; /**< lower bound of Balance::applied [N] */
    double drag          = 0.; /**< [-] */
    std::vector<double> drag_stiffness; /**< of local nodes, for drag 1 [N/m] */

    const LoadPattern<dim> *pattern;
    const StaticFarField *far_field;
    const Beams *beams;
    /** Degrees of freedom of the interface points of beams; invalid: held. */
    std::vector<DofIndex> beam_dofs;
    /** Minus the derivative of its forces on free degrees of freedom. */
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>
        far_stiffness;
    std::vector<DofIndex> far_rows, far_columns; /**< of this rank, all */

    /** Places of an element's stiffness in the matrix's values, row by row,
        from a first one on in all places. An element some of whose degrees of
        freedom are constrained, or of another rank, has none: n_values is 0. */
    static constexpr unsigned int most_nodes = 10;
    struct ElementPlaces
    {
      std::size_t first;
      unsigned int n_values;
      std::array<unsigned int, most_nodes> nodes;
    };

    dealii::TrilinosWrappers::SparseMatrix matrix;
    double *matrix_values = nullptr;          /**< of the rows of this rank */
    std::vector<std::size_t> diagonal_places; /**< of owned rows */
    /** Places of elements in the order in which operators give them, which is
       the same every time; found when they are first added. */
    std::vector<ElementPlaces> element_places;
    std::vector<int> all_places;
    std::size_t next_element = 0; /**< in that order */
    dealii::FullMatrix<double> element_matrix;
    dealii::Vector<double> no_load; /**< of an element */
    std::vector<DofIndex> element_dofs;
    AlignedArray<dealii::Tensor<1, dim>>
        applied_force; /**< see Balance::applied */
  };

  // Members that exist in two dimensions only.
  template <>
  void Equilibrium<2>::find_far_stiffness();
  template <>
  void Equilibrium<2>::add_beam_entries(
      dealii::TrilinosWrappers::SparsityPattern &entries);
  template <>
  void Equilibrium<2>::add_beams(const State<2> &committed,
                                 const Configuration<2> &configuration,
                                 Balance<2> &balance, bool slopes);
  template <>
  void Equilibrium<2>::add_far_field(const State<2> &committed,
                                     const Configuration<2> &configuration,
                                     Balance<2> &balance, const Slopes *slopes);
} // namespace quoin

#endif
