// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_cell_strain_h
#define quoin_block_elements_cell_strain_h

#include <quoin/block_elements/block_forces_data.h>
#include <quoin/block_elements/tetrahedron.h>
#include <quoin/block_elements/triangle.h>
#include <quoin/materials/plastic_history.h>

// Geometry and strain of single cells.

namespace quoin
{
  /** Nodes of a triangle, the gradients of their shape functions at its point
      [1/m] and the area that the point counts for [m^2]. */
  struct CellPoint
  {
    unsigned int n_nodes;
    std::array<unsigned int, 6> nodes;
    std::array<dealii::Tensor<1, 2>, 6> gradients;
    double area;

    /** Displacement gradient [[11, 12], [21, 22]]. */
    std::array<double, 4>
    displacement_gradient(const NodeRecord<2> *records) const;
  };
  CellPoint cell_point(const BlockForcesData<2> &data,
                       const NodeRecord<2> *nodes, unsigned int cell);

  /** Displacement gradient of a cell, and area if it is asked for. */
  std::array<double, 4> cell_gradient(const BlockForcesData<2> &data,
                                      const NodeRecord<2> *nodes,
                                      std::size_t cell, double *area = nullptr);

  /** Updates @p history for an elastic strain, see MohrCoulomb::update(). */
  PlasticStep update_cell(const BlockForcesData<2> &data, std::size_t cell,
                          const PlaneTensor &strain, PlasticHistory &history);

  /** Geometry of a tetrahedron, and its displacement gradient. */
  struct CellMotion
  {
    Tetrahedron<OneLane> geometry;
    double H[3][3];
  };
  CellMotion cell_motion(const BlockForcesData<3> &data,
                         const NodeRecord<3> *nodes, std::size_t cell);

  inline double trace(const SpaceTensor &t)
  {
    return t[0] + t[1] + t[2];
  }
  /** Adds an isotropic tensor of that trace. */
  inline void add_trace(const double a, SpaceTensor &t)
  {
    for (unsigned int i = 0; i < 3; ++i)
      t[i] += a / 3.;
  }

  SpaceTensor elastic_stress(const SpaceStiffness &stiffness,
                             const SpaceTensor &e);

  /** Strain of the elastic part of a deformation, (I + H) (I + Q). */
  SpaceStrain elastic_strain(const double (&H)[3][3], const double (&Q)[6]);

  /** Rate of a polar decomposition F = R U. */
  struct PolarRate
  {
    double spin[3]; /**< axial vector of R^T dR/dt */
    SpaceTensor U;  /**< dU/dt */

    /** @p A: R^T dF/dt. */
    PolarRate(const SpaceStrain &strain, const double (&A)[3][3])
    {
      const SpaceTensor &e = strain.e;
      const double w[3]
          = { A[2][1] - A[1][2], A[0][2] - A[2][0], A[1][0] - A[0][1] };
      strain.polar.solve_spin(w, spin);
      for (unsigned int c = 0; c < 3; ++c)
      {
        double column[3], turned[3];
        for (unsigned int r = 0; r < 3; ++r)
          column[r] = e[symmetric_index[r][c]] + (r == c ? 1. : 0.);
        cross(spin, column, turned);
        for (unsigned int r = 0; r <= c; ++r)
          U[symmetric_index[r][c]] = A[r][c] - turned[r];
      }
    }

    static void cross(const double (&a)[3], const double (&b)[3],
                      double (&result)[3])
    {
      for (unsigned int r = 0; r < 3; ++r)
      {
        const unsigned int p = (r + 1) % 3, q = (r + 2) % 3;
        result[r] = a[p] * b[q] - a[q] * b[p];
      }
    }
  };

  /** Adds the forces of a first Piola-Kirchhoff stress R T [Pa]. */
  void add_cell_forces(const BlockForcesData<3> &data, std::size_t cell,
                       const Tetrahedron<OneLane> &geometry,
                       const double (&R)[3][3], const double (&T)[3][3],
                       dealii::Tensor<1, 3> *force);

  /** Updates @p history of a cell with a yield law, adds its forces and returns
      the energy that this dissipates [J]. */
  double add_plastic_forces(const BlockForcesData<3> &data, std::size_t cell,
                            const NodeRecord<3> *nodes, PlasticHistory &history,
                            dealii::Tensor<1, 3> *force);
} // namespace quoin

#endif
