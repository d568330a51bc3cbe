// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "cell_linearisation.h"

namespace quoin
{
  std::array<std::array<double, 3>, 4>
  shape_gradients(const Tetrahedron<OneLane> &geometry)
  {
    std::array<std::array<double, 3>, 4> g{};
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        g[k + 1][i] = geometry.cofactor[k][i] / geometry.det;
        g[0][i] -= g[k + 1][i];
      }
    return g;
  }

  std::array<double, 12> nodal_forces(const Tetrahedron<OneLane> &geometry,
                                      const SpaceMatrix &stress)
  {
    double P[3][3], f[3][3];
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        P[r][c] = -stress[r][c] / 6.;
    geometry.nodal_forces(P, f);
    std::array<double, 12> force{};
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        force[3 * (k + 1) + i] = f[k][i];
        force[i] -= f[k][i];
      }
    return force;
  }

  namespace
  {
    /** A cell whose displacement gradient changes while its history does not.
     */
    struct FlowingCell
    {
      const SpaceMohrCoulomb &law;
      const SpacePlasticPoint &before;
      const SpaceTensor initial_stress;

      /** Stress R T [Pa] by the forces on gradients on which (I + Q) has acted.
          Updates @p after, the history, and the energy @p dissipated [J/m^3].
       */
      SpaceMatrix stress(const double (&H)[3][3], SpacePlasticPoint &after,
                         double &dissipated) const
      {
        double Q[6], T[3][3];
        std::copy(before.inverse_stretch.begin(), before.inverse_stretch.end(),
                  Q);
        const SpaceStrain strain    = elastic_strain(H, Q);
        after                       = before;
        const SpacePlasticStep step = law.update(after, strain, initial_stress);
        dissipated                  = step.dissipated;
        strain.turning_stress(step.stress, T);
        SpaceMatrix P{};
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int i = 0; i < 3; ++i)
              P[r][c] += strain.R[r][i] * T[i][c];
        return P;
      }
    };

    /** linearise_cell() of a cell with a yield law: the derivative is that of
        its update, by central differences of the displacement gradient. */
    void linearise_plastic(const BlockForcesData<3> &data,
                           const std::size_t cell, const NodeRecord<3> *nodes,
                           PlasticHistory &history, CellLinearisation &result,
                           const bool with_stiffness)
    {
      CellMotion motion              = cell_motion(data, nodes, cell);
      const SpacePlasticPoint before = space_plastic_point(history, cell);
      const FlowingCell own{ *data.law_of(cell), before,
                             data.initial_stress_of(cell) };
      Tetrahedron<OneLane> flowed = motion.geometry;
      flowed.flow(history.space_cells[cell].inverse_stretch);

      SpacePlasticPoint after;
      double dissipated;
      const SpaceMatrix stress = own.stress(motion.H, after, dissipated);
      set_plastic_point(after, cell, history);
      result.n_nodes    = 4;
      result.dissipated = motion.geometry.det / 6. * dissipated;
      std::copy(data.cells[cell].begin(), data.cells[cell].end(),
                result.nodes.begin());
      const auto force = nodal_forces(flowed, stress);
      std::copy(force.begin(), force.end(), result.force.begin());
      if (!with_stiffness)
        return;

      const auto gradients = shape_gradients(motion.geometry);
      for (auto &row : result.stiffness)
        row.fill(0.);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const double H = motion.H[i][j];
          SpacePlasticPoint unused;
          double lost;
          motion.H[i][j]          = H + gradient_difference;
          const SpaceMatrix plus  = own.stress(motion.H, unused, lost);
          motion.H[i][j]          = H - gradient_difference;
          const SpaceMatrix minus = own.stress(motion.H, unused, lost);
          motion.H[i][j]          = H;
          SpaceMatrix slope;
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int c = 0; c < 3; ++c)
              slope[r][c]
                  = (plus[r][c] - minus[r][c]) / (2. * gradient_difference);
          const auto change = nodal_forces(flowed, slope);
          for (unsigned int k = 0; k < 4; ++k)
            for (unsigned int q = 0; q < 12; ++q)
              result.stiffness[q][3 * k + i] -= change[q] * gradients[k][j];
        }
    }
  } // namespace

  void linearise_elastic(const CellMotion &motion, const SpaceStrain &strain,
                         const ElasticCellStress &stress,
                         CellLinearisation &result, const bool with_stiffness)
  {
    const auto &polar   = strain.polar;
    const auto &R       = strain.R;
    const double volume = motion.geometry.det / 6.;
    double e[6], S0[6], T[3][3];
    std::copy(strain.e.begin(), strain.e.end(), e);
    std::copy(stress.initial.begin(), stress.initial.end(), S0);
    polar.turning_stress(S0, e, T);
    double w[3], y[3]; // of the turning stress
    polar.commutator(S0, e, w);
    polar.solve_spin(w, y);
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        T[r][c] += stress.elastic[symmetric_index[r][c]];

    const auto g = shape_gradients(motion.geometry);
    // V (R T) grad N of all nodes.
    const auto nodal = [&](const double(&T)[3][3], double *f)
    {
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int i = 0; i < 3; ++i)
        {
          f[3 * k + i] = 0.;
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int c = 0; c < 3; ++c)
              f[3 * k + i] += volume * R[i][r] * T[r][c] * g[k][c];
        }
    };
    result.n_nodes    = 4;
    result.dissipated = 0.;
    nodal(T, result.force.data());
    for (double &f : result.force)
      f = -f;
    if (!with_stiffness)
      return;

    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        double A[3][3], dU[6], dT[3][3];
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            A[r][c] = R[i][r] * g[k][c];
        const PolarRate rate(strain, A);
        std::copy(rate.U.begin(), rate.U.end(), dU);
        const SpaceTensor dS = elastic_stress(stress.rate, rate.U);
        // From (tr U I - U) y = w.
        double dw[3], dy[3];
        polar.commutator(S0, dU, dw);
        for (unsigned int r = 0; r < 3; ++r)
        {
          dw[r] -= (dU[0] + dU[1] + dU[2]) * y[r];
          for (unsigned int c = 0; c < 3; ++c)
            dw[r] += dU[symmetric_index[r][c]] * y[c];
        }
        polar.solve_spin(dw, dy);
        for (unsigned int c = 0; c < 3; ++c)
        {
          const double column[3] = { T[0][c], T[1][c], T[2][c] };
          const double unit[3]
              = { c == 0 ? 1. : 0., c == 1 ? 1. : 0., c == 2 ? 1. : 0. };
          double turned[3], minus[3];
          PolarRate::cross(rate.spin, column, turned);
          PolarRate::cross(dy, unit, minus);
          for (unsigned int r = 0; r < 3; ++r)
            dT[r][c] = turned[r] + dS[symmetric_index[r][c]] - minus[r];
        }
        std::array<double, 12> column;
        nodal(dT, column.data());
        for (unsigned int q = 0; q < 12; ++q)
          result.stiffness[q][3 * k + i] = column[q];
      }
  }

  bool linearise_cell(const BlockForcesData<3> &data, const unsigned int cell,
                      const NodeRecord<3> *nodes, PlasticHistory &history,
                      CellLinearisation &result, const bool with_stiffness)
  {
    if (data.law_of(cell) && !history.space_cells.empty())
    {
      linearise_plastic(data, cell, nodes, history, result, with_stiffness);
      return true;
    }
    const CellMotion motion = cell_motion(data, nodes, cell);
    const SpaceStrain strain(motion.H);
    const SpaceStiffness &C = data.stiffness_of(cell);
    std::copy(data.cells[cell].begin(), data.cells[cell].end(),
              result.nodes.begin());
    linearise_elastic(
        motion, strain,
        { data.initial_stress_of(cell), elastic_stress(C, strain.e), C },
        result, with_stiffness);
    return true;
  }
} // namespace quoin
