// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/implicit/linear_solver.h>

#include <Teuchos_ParameterList.hpp>

#include <cmath>

namespace quoin
{
  namespace
  {
    /** Degrees of freedom beyond which LU factors cost more than iterations:
        those of a volume fill up more than those of a plane. */
    template <int dim>
    constexpr DofIndex largest_direct = dim == 2 ? 200000 : 30000;

    /** Relative residual, negligible in Newton's method [-]. */
    constexpr double iterative_tolerance   = 1e-10;
    constexpr unsigned int most_iterations = 1000;

    /** Relative residual of a solution by SparseFactors that is accepted [-],
        after so many refinements at most. */
    constexpr double accepted               = 1e-8;
    constexpr unsigned int most_refinements = 3;
  } // namespace

  template <int dim>
  LinearSolver<dim>::LinearSolver(const LinearSolverType type,
                                  const Model<dim> &model,
                                  const DofMap<dim> &dof_map)
    : model(model), dof_map(dof_map),
      direct(type == LinearSolverType::direct
             || (type == LinearSolverType::automatic
                 && dof_map.owned().size() <= largest_direct<dim>)),
      control(most_iterations, 0.)
  {
  }

  template <int dim>
  bool LinearSolver<dim>::prepare(const Matrix &new_matrix,
                                  const Configuration<dim> &configuration)
  {
    matrix = &new_matrix;
    if (direct)
      return factorise() || factorise_with_pivoting();
    find_rigid_motions(*matrix, configuration);
    Teuchos::ParameterList list;
    dealii::TrilinosWrappers::PreconditionAMG::AdditionalData data;
    data.elliptic              = true;
    data.n_cycles              = 1;
    data.smoother_sweeps       = 2;
    data.aggregation_threshold = 0.02;
    std::unique_ptr<Epetra_MultiVector> unused;
    data.set_parameters(list, unused, matrix->trilinos_matrix());
    list.set("PDE equations", int(dim));
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", rigid_motions->NumVectors());
    list.set("null space: vectors", rigid_motions->Values());
    multigrid.initialize(matrix->trilinos_matrix(), list);
    return true;
  }

  template <int dim>
  const Epetra_CrsMatrix &LinearSolver<dim>::whole_matrix()
  {
    const Epetra_CrsMatrix &rows = matrix->trilinos_matrix();
    if (rows.Comm().NumProc() == 1)
      return rows;
    if (!on_first)
    {
      const int n = rows.NumGlobalRows();
      const Epetra_Map all(n, rows.Comm().MyPID() == 0 ? n : 0, 0, rows.Comm());
      to_first = std::make_unique<Epetra_Import>(all, rows.RowMap());
      on_first = std::make_unique<Epetra_CrsMatrix>(Copy, all, 0);
    }
    on_first->Import(rows, *to_first, Insert);
    if (!on_first->Filled())
      on_first->FillComplete();
    return *on_first;
  }

  template <int dim>
  bool LinearSolver<dim>::factorise()
  {
    const Epetra_CrsMatrix &rows = whole_matrix();
    const bool is_first          = rows.Comm().MyPID() == 0;
    int *starts, *columns;
    double *values;
    int success = !is_first
                  || rows.ExtractCrsDataPointers(starts, columns, values) == 0;
    if (!is_analysed)
    {
      is_analysed = true;
      has_pattern
          = rows.RowMap().SameAs(rows.ColMap()) && success
            && (!is_first
                || sparse_factors.analyse(rows.NumMyRows(), starts, columns));
      remainder.reinit(dof_map.owned(), model.nodes().communicator());
      refinement = remainder;
    }
    factors.reset();
    if (is_first)
      success = success && has_pattern && sparse_factors.factorise(values);
    rows.Comm().Broadcast(&success, 1, 0);
    return success;
  }

  template <int dim>
  bool LinearSolver<dim>::factorise_with_pivoting()
  {
    factors = std::make_unique<dealii::TrilinosWrappers::SolverDirect>(
        control, dealii::TrilinosWrappers::SolverDirect::AdditionalData(
                     false, "Amesos_Klu"));
    try
    {
      factors->initialize(*matrix);
    }
    catch (const dealii::ExceptionBase &)
    {
      return false; // singular
    }
    return true;
  }

  template <int dim>
  void LinearSolver<dim>::apply_factors(const Vector &right_hand_side,
                                        Vector &solution)
  {
    if (!on_first)
    {
      sparse_factors.solve(right_hand_side.begin(), solution.begin());
      return;
    }
    Epetra_MultiVector known(on_first->RowMap(), 1, false),
        found(on_first->RowMap(), 1, false);
    known.Import(right_hand_side.trilinos_vector(), *to_first, Insert);
    if (known.MyLength() > 0)
      sparse_factors.solve(known[0], found[0]);
    solution.trilinos_vector().Export(found, *to_first, Insert);
  }

  template <int dim>
  bool LinearSolver<dim>::solve_by_factors(const Vector &right_hand_side,
                                           Vector &solution)
  {
    const double scale = right_hand_side.l2_norm();
    apply_factors(right_hand_side, solution);
    double left = matrix->residual(remainder, solution, right_hand_side);
    for (unsigned int i = 0; i < most_refinements && left > accepted * scale;
         ++i)
    {
      apply_factors(remainder, refinement);
      solution += refinement;
      left = matrix->residual(remainder, solution, right_hand_side);
    }
    return left <= accepted * scale; // not if it is no number
  }

  template <int dim>
  void
  LinearSolver<dim>::find_rigid_motions(const Matrix &stiffness,
                                        const Configuration<dim> &configuration)
  {
    // Translations, then the rotation in each plane of axes, xy, xz, yz.
    constexpr unsigned int n_rotations = dim * (dim - 1) / 2;
    rigid_motions                      = std::make_unique<Epetra_MultiVector>(
        stiffness.trilinos_matrix().DomainMap(), dim + n_rotations);
    const auto set
        = [&](const unsigned int mode, const DofIndex dof, const double value)
    {
      const int row
          = stiffness.trilinos_matrix().DomainMap().LID(static_cast<int>(dof));
      (*rigid_motions)[mode][row] = value;
    };
    // Rigid body modes about a corner of the model, in units of its size.
    const auto origin = model.nodes().table().box[0];
    const double size = model.nodes().table().diagonal();
    const auto place  = [&](const DofIndex first, const dealii::Point<dim> &at,
                           const std::array<bool, dim> &free)
    {
      unsigned int mode = dim;
      for (unsigned int a = 0; a < dim; ++a)
      {
        if (free[a])
          set(a, first + a, 1.);
        for (unsigned int b = a + 1; b < dim; ++b, ++mode)
        {
          if (free[a])
            set(mode, first + a, -(at[b] - origin[b]) / size);
          if (free[b])
            set(mode, first + b, (at[a] - origin[a]) / size);
        }
      }
    };
    for (unsigned int i = 0; i < model.nodes().n_owned(); ++i)
    {
      std::array<bool, dim> free;
      for (unsigned int d = 0; d < dim; ++d)
        free[d] = dof_map.is_free(i, d);
      place(dof_map.dof(i, 0), configuration.nodes[i].position(), free);
    }
    for (unsigned int b = 0; b < dof_map.bodies().size(); ++b)
    {
      const RigidBody<dim> &body = dof_map.bodies()[b];
      if (!body.counts)
        continue;
      std::array<bool, dim> free;
      for (unsigned int d = 0; d < dim; ++d)
        free[d] = !body.given[d];
      place(body.first,
            dealii::Point<dim>(body.centre
                               + vector_at<dim>(configuration.bodies[b], 0)),
            free);
      // In the planes xy, xz and yz it turns about z, -y and x.
      for (unsigned int k = 0; k < n_rotations; ++k)
      {
        const unsigned int d = dim + (n_rotations - 1 - k);
        if (!body.given[d])
          set(dim + k, body.first + d, (k == 1 ? -1. : 1.) / size);
      }
    }
  }

  template <int dim>
  bool LinearSolver<dim>::solve(const Vector &right_hand_side, Vector &solution)
  {
    iterations         = 0;
    solution           = 0.;
    const double scale = right_hand_side.l2_norm();
    if (scale == 0.)
      return true;
    try
    {
      if (direct)
      {
        if (factors || !solve_by_factors(right_hand_side, solution))
        {
          if (!factors && !factorise_with_pivoting())
            return false;
          solution = 0.;
          factors->solve(solution, right_hand_side);
        }
      }
      else
      {
        control.set_tolerance(iterative_tolerance * scale);
        dealii::TrilinosWrappers::SolverGMRES gmres(
            control,
            dealii::TrilinosWrappers::SolverGMRES::AdditionalData(false, 100));
        gmres.solve(*matrix, solution, right_hand_side, multigrid);
        iterations = control.last_step();
      }
    }
    catch (const dealii::ExceptionBase &)
    {
      return false;
    }
    return std::isfinite(solution.l2_norm());
  }

  template class LinearSolver<2>;
  template class LinearSolver<3>;
} // namespace quoin
