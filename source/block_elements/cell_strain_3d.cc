// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/cell_strain.h>

namespace quoin
{
  SpaceStrain elastic_strain(const double (&H)[3][3], const double (&Q)[6])
  {
    double A[3][3];
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
      {
        A[r][c] = H[r][c] + Q[symmetric_index[r][c]];
        for (unsigned int i = 0; i < 3; ++i)
          A[r][c] += H[r][i] * Q[symmetric_index[i][c]];
      }
    return SpaceStrain(A);
  }

  SpaceTensor elastic_stress(const SpaceStiffness &stiffness,
                             const SpaceTensor &e)
  {
    SpaceTensor s;
    for (unsigned int i = 0; i < 6; ++i)
      s[i] = 2. * stiffness.mu * e[i]
             + (i < 3 ? stiffness.lambda * (e[0] + e[1] + e[2]) : 0.);
    return s;
  }

  CellMotion cell_motion(const BlockForcesData<3> &data,
                         const NodeRecord<3> *nodes, const std::size_t cell)
  {
    const auto &n = data.cells[cell];
    double e[3][3], d[3][3];
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        e[k][i] = nodes[n[k + 1]].X[i] - nodes[n[0]].X[i];
        d[k][i] = nodes[n[k + 1]].u[i] - nodes[n[0]].u[i];
      }
    CellMotion motion;
    motion.geometry.set_edges(e);
    motion.geometry.gradient(d, motion.H);
    return motion;
  }

  void add_cell_forces(const BlockForcesData<3> &data, const std::size_t cell,
                       const Tetrahedron<OneLane> &geometry,
                       const double (&R)[3][3], const double (&T)[3][3],
                       dealii::Tensor<1, 3> *force)
  {
    double P[3][3], f[3][3];
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
        P[r][c]
            = -(R[r][0] * T[0][c] + R[r][1] * T[1][c] + R[r][2] * T[2][c]) / 6.;
    geometry.nodal_forces(P, f);
    const auto &n = data.cells[cell];
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < 3; ++i)
      {
        force[n[k + 1]][i] += f[k][i];
        force[n[0]][i] -= f[k][i];
      }
  }

  double add_plastic_forces(const BlockForcesData<3> &data,
                            const std::size_t cell, const NodeRecord<3> *nodes,
                            PlasticHistory &history,
                            dealii::Tensor<1, 3> *force)
  {
    const CellMotion motion       = cell_motion(data, nodes, cell);
    const SpacePlasticCell before = history.space_cells[cell];
    const SpaceStrain strain = elastic_strain(motion.H, before.inverse_stretch);
    SpacePlasticPoint point  = space_plastic_point(history, cell);
    const SpacePlasticStep step = data.law_of(cell)->update(
        point, strain, data.initial_stress_of(cell));
    set_plastic_point(point, cell, history);
    // P = P_e (I + Q): on gradients on which (I + Q) has acted.
    double T[3][3];
    strain.turning_stress(step.stress, T);
    Tetrahedron<OneLane> flowed = motion.geometry;
    flowed.flow(before.inverse_stretch);
    add_cell_forces(data, cell, flowed, strain.R, T, force);
    return motion.geometry.det / 6. * step.dissipated;
  }
} // namespace quoin
