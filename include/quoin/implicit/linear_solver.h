// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_implicit_linear_solver_h
#define quoin_implicit_linear_solver_h

#include <quoin/implicit/dof_map.h>
#include <quoin/implicit/implicit_parameters.h>
#include <quoin/implicit/sparse_factors.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_MultiVector.h>

#include <memory>

namespace quoin
{
  /**
   * Solves with the stiffness matrix, by LU factors or by GMRES that is
   * preconditioned by smoothed aggregation multigrid. Multigrid gets the rigid
   * body modes as near null space. The first rank finds the factors of the
   * whole matrix, SparseFactors, and their solutions are checked. Matrices that
   * these do not solve have the factors of KLU, which exchanges any rows.
   */
  template <int dim>
  class LinearSolver
  {
  public:
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    using Vector = DofVector;

    LinearSolver(LinearSolverType type, const Model<dim> &model,
                 const DofMap<dim> &dof_map);

    /** Factorises or sets up the preconditioner; returns success. */
    bool prepare(const Matrix &matrix, const Configuration<dim> &configuration);

    /** Solves; returns success. */
    bool solve(const Vector &right_hand_side, Vector &solution);

    bool is_direct() const
    {
      return direct;
    }
    /** Iterations of the last solve; 0 if direct. */
    unsigned int n_iterations() const
    {
      return iterations;
    }

  private:
    void find_rigid_motions(const Matrix &matrix,
                            const Configuration<dim> &configuration);
    /** Factorises by SparseFactors; returns success. */
    bool factorise();
    /** The matrix, if there are several ranks its copy on the first one.
        Collective. */
    const Epetra_CrsMatrix &whole_matrix();
    /** Factorises by KLU; returns success. */
    bool factorise_with_pivoting();
    /** Sets @p solution to what SparseFactors find. */
    void apply_factors(const Vector &right_hand_side, Vector &solution);
    /** Solves by SparseFactors; false: the residual stays too large. */
    bool solve_by_factors(const Vector &right_hand_side, Vector &solution);

    const Model<dim> &model;
    const DofMap<dim> &dof_map;
    bool direct;
    const Matrix *matrix = nullptr;
    dealii::SolverControl control;
    bool is_analysed = false, has_pattern = false;
    /** Factors of the matrix; the first rank alone has them. */
    SparseFactors sparse_factors;
    // Several ranks send their rows to the first one, which has the matrix.
    std::unique_ptr<Epetra_Import> to_first;
    std::unique_ptr<Epetra_CrsMatrix> on_first;
    Vector remainder, refinement;
    /** Factors of KLU; null: sparse_factors are those of the matrix. */
    std::unique_ptr<dealii::TrilinosWrappers::SolverDirect> factors;
    std::unique_ptr<Epetra_MultiVector> rigid_motions;
    dealii::TrilinosWrappers::PreconditionAMG multigrid;
    unsigned int iterations = 0;
  };
} // namespace quoin

#endif
