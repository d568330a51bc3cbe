// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_blocks_cell_states_h
#define quoin_blocks_cell_states_h

#include <quoin/blocks/block_forces_3d.h>

// Energy, stresses and internal variables of the cells of BlockForces, one by
// one.

namespace quoin
{
  /**
   * Energy of all cells with the plastic stretch of @p history [J]; minus
   * its gradient are the forces. With initial stress it counts from the
   * undeformed state and may be negative.
   */
  double strain_energy(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                       const PlasticHistory &history);
  double strain_energy(const BlockForces<3> &blocks, const NodeRecord<3> *nodes,
                       const PlasticHistory &history);

  /** Part of strain_energy() of one cell, or of the cells of a mixed
      tetrahedron of which @p cell is the first [J]. */
  double cell_energy(const BlockForcesData<2> &data, const NodeRecord<2> *nodes,
                     const PlasticHistory &history, std::size_t cell);
  double cell_energy(const BlockForcesData<3> &data, const NodeRecord<3> *nodes,
                     const PlasticHistory &history, std::size_t cell);

  /**
   * Stress [Pa] and, if asked for, strain of a cell in the fixed frame:
   * R S R^T and R e R^T. In the plane the stress is xx, yy, xy, zz, the strain
   * xx, yy, xy; in space both are 11, 22, 33, 12, 13, 23. The initial stress is
   * part of the stress. A cell with a yield law has Cauchy's stress instead, by
   * its @p history updated for the positions. In a mixed tetrahedron the stress
   * has the mean that its cells share, the strain is the cell's own.
   */
  std::array<double, 4> cell_stress(const BlockForces<2> &blocks,
                                    const NodeRecord<2> *nodes,
                                    const PlasticHistory &history,
                                    std::size_t cell,
                                    PlaneTensor *strain = nullptr);
  SpaceTensor cell_stress(const BlockForces<3> &blocks,
                          const NodeRecord<3> *nodes,
                          const PlasticHistory &history, std::size_t cell,
                          SpaceTensor *strain = nullptr);

  /** cell_stress() of all cells. */
  void cell_stresses(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                     const PlasticHistory &history,
                     std::vector<std::array<double, 4>> &stress,
                     std::vector<PlaneTensor> &strain);
  void cell_stresses(const BlockForces<3> &blocks, const NodeRecord<3> *nodes,
                     const PlasticHistory &history,
                     std::vector<SpaceTensor> &stress,
                     std::vector<SpaceTensor> &strain);

  /**
   * Stress [Pa] in the rotating frame by the strain of a cell,
   * with any @p stiffness. With that of the cell plus the initial stress it is
   * the cell's stress, if it has never yielded. In a mixed tetrahedron the
   * change of volume is that which its cells share, by their @p history.
   */
  std::array<double, 4> stress_of_strain(const BlockForces<2> &blocks,
                                         const NodeRecord<2> *nodes,
                                         const PlasticHistory &history,
                                         std::size_t cell,
                                         const PlaneStiffness &stiffness);
  SpaceTensor stress_of_strain(const BlockForces<3> &blocks,
                               const NodeRecord<3> *nodes,
                               const PlasticHistory &history, std::size_t cell,
                               const SpaceStiffness &stiffness);

  /**
   * Stress [Pa] in the rotating frame of a cell with a yield law and a @p
   * history that is up to date, initial stress included: an elastic cell with
   * this stress has its forces.
   */
  std::array<double, 4> turning_stress(const BlockForces<2> &blocks,
                                       const NodeRecord<2> *nodes,
                                       const PlasticHistory &history,
                                       std::size_t cell);
  SpaceTensor turning_stress(const BlockForces<3> &blocks,
                             const NodeRecord<3> *nodes,
                             const PlasticHistory &history, std::size_t cell);

  /** Sets the plastic stretch of a cell that has yielded so that @p law
      gives the same stress. @p before: the history of all cells by their
      present laws. */
  void take_over_stress(const BlockForces<2> &blocks,
                        const NodeRecord<2> *nodes, std::size_t cell,
                        const MohrCoulomb &law, const PlasticHistory &before,
                        PlasticHistory &history);
  void take_over_stress(const BlockForces<3> &blocks,
                        const NodeRecord<3> *nodes, std::size_t cell,
                        const SpaceMohrCoulomb &law,
                        const PlasticHistory &before, PlasticHistory &history);

  /** Internal variables of cells without strain; empty: no cell yields. */
  PlasticHistory initial_history(const BlockForces<2> &blocks);
  PlasticHistory initial_history(const BlockForces<3> &blocks);

  /** Resets @p cell to initial_history(), if any cell yields. */
  void forget_history(const BlockForces<2> &blocks, unsigned int cell,
                      PlasticHistory &history);
  void forget_history(const BlockForces<3> &blocks, unsigned int cell,
                      PlasticHistory &history);

  /** Internal variables of a cell that yields, updated for the positions. */
  PlasticPoint cell_history(const BlockForces<2> &blocks,
                            const NodeRecord<2> *nodes,
                            const PlasticHistory &history, unsigned int cell);
  SpacePlasticPoint cell_history(const BlockForces<3> &blocks,
                                 const NodeRecord<3> *nodes,
                                 const PlasticHistory &history,
                                 unsigned int cell);

  /**
   * The first cell that is inverted, also in the reference configuration; the
   * number of cells if there is none. A stress of the order of Young's modulus
   * can invert a cell: its forces are finite and push it back, but results are
   * meaningless from then on.
   */
  unsigned int first_inverted_cell(const BlockForces<3> &blocks,
                                   const NodeRecord<3> *nodes);

  // Forces of a tile cell by cell, as references for strips and lanes.

  /** BlockForces::add_forces(); returns the energy dissipated [J]. */
  double add_forces_by_cell(const BlockForces<2> &blocks, unsigned int tile,
                            const NodeRecord<2> *nodes, PlasticHistory &history,
                            dealii::Tensor<1, 2> *force);
  double add_forces_by_cell(const BlockForces<3> &blocks, unsigned int tile,
                            const NodeRecord<3> *nodes, PlasticHistory &history,
                            dealii::Tensor<1, 3> *force);

  /** BlockForces::add_viscous_forces(). */
  void add_viscous_forces_by_cell(const BlockForces<2> &blocks,
                                  unsigned int tile, const NodeRecord<2> *nodes,
                                  const dealii::Tensor<1, 2> *velocity,
                                  double beta, dealii::Tensor<1, 2> *force);
} // namespace quoin

#endif
