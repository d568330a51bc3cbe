// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_block_elements_mixed_cells_h
#define quoin_block_elements_mixed_cells_h

#include <quoin/block_elements/cell_strain.h>

// The eight cells of a mixed tetrahedron, see theory.md, "Mixed tetrahedra".

namespace quoin
{
  /** An entry for each cell of a mixed tetrahedron. */
  template <typename T>
  using OfMixed = std::array<T, parts_of_mixed>;

  /** Internal variables of the cells from @p first on; where @p history is
      empty those of cells that have never yielded. */
  OfMixed<SpacePlasticPoint> mixed_points(const PlasticHistory &history,
                                          std::size_t first);

  /**
   * Elastic strains of the cells of a mixed tetrahedron. Each has its own
   * deviatoric part, and a trace by which the mean stress less the own initial
   * one is the mean of what the cells had by themselves, weighted with volumes.
   */
  struct MixedCells
  {
    /** @p first: the first cell; @p points: their internal variables. */
    MixedCells(const BlockForcesData<3> &data, const NodeRecord<3> *nodes,
               std::size_t first, const OfMixed<SpacePlasticPoint> &points);

    OfMixed<CellMotion> motion;
    OfMixed<double> share; /**< of the volume [-] */
    double volume;         /**< [m^3] */
    /** Strain by the elastic deformation, (I + H)(I + Q), with the rotation
        that is the cell's own. */
    OfMixed<SpaceStrain> strain;
    OfMixed<double> own;     /**< mean stress by the cell's own strain [Pa] */
    OfMixed<double> initial; /**< mean initial stress [Pa] */
    double mean;             /**< of own [Pa] */
    double mean_initial;     /**< of initial [Pa] */
    double bulk;             /**< bulk modulus [Pa] */

    /** Initial mean stress of cell @p k beyond that of all [Pa]. */
    double beyond_mean(const unsigned int k) const
    {
      return initial[k] - mean_initial;
    }

    double average(const OfMixed<double> &values) const
    {
      double sum = 0.;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
        sum += share[k] * values[k];
      return sum;
    }
  };

  /** What becomes of the cells of a mixed tetrahedron with a yield law. */
  struct MixedStep
  {
    OfMixed<SpacePlasticPoint> points;
    OfMixed<SpaceTensor> stress; /**< see PlasticStep [Pa] */
    /** Change of volume that each has taken from the others [-]. */
    OfMixed<double> exchanged;
    double dissipated; /**< [J] */
  };

  /** Passes of update_mixed() for large steps. */
  constexpr unsigned int implicit_passes = 8;

  /**
   * Lets the cells yield each by itself, then share their mean stress. A
   * further pass first exchanges the volumes by which the mean stresses would
   * have differed, so that they hardly do after it. Explicit steps need none:
   * what differs is small and goes on in the next step.
   */
  MixedStep update_mixed(const BlockForcesData<3> &data, std::size_t first,
                         const OfMixed<SpacePlasticPoint> &points,
                         const MixedCells &cells, unsigned int n_passes = 1);

  /** Updates @p history by this and returns the energy dissipated [J]. */
  double update_mixed(const BlockForcesData<3> &data, std::size_t first,
                      const NodeRecord<3> *nodes, PlasticHistory &history);

  /** Elastic energy of a mixed tetrahedron from the undeformed state on [J]. */
  double mixed_energy(const BlockForcesData<3> &data,
                      const NodeRecord<3> *nodes, const PlasticHistory &history,
                      std::size_t first);

  /** add_plastic_forces() of a mixed tetrahedron, with or without yield law. */
  double add_mixed_forces(const BlockForcesData<3> &data, std::size_t first,
                          const NodeRecord<3> *nodes, PlasticHistory &history,
                          dealii::Tensor<1, 3> *force);
} // namespace quoin

#endif
