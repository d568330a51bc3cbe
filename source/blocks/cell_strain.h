// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_blocks_cell_strain_h
#define quoin_source_blocks_cell_strain_h

#include <quoin/blocks/block_forces_3d.h>

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

  SpaceTensor elastic_stress(const SpaceStiffness &stiffness,
                             const SpaceTensor &e);

  /** Strain of the elastic part of a deformation, (I + H) (I + Q). */
  SpaceStrain elastic_strain(const double (&H)[3][3], const double (&Q)[6]);

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

  /** BlockForces<3>::linearise() of a cell with a yield law: the derivative is
      that of its update, by central differences of the displacement gradient.
   */
  void linearise_plastic(const BlockForcesData<3> &data, std::size_t cell,
                         const NodeRecord<3> *nodes, PlasticHistory &history,
                         CellLinearisation &result, bool with_stiffness);
} // namespace quoin

#endif
