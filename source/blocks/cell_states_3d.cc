// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/mixed_cells.h>
#include <quoin/blocks/cell_states.h>

namespace quoin
{
  namespace
  {
    SpaceStrain elastic_strain_of(const BlockForcesData<3> &data,
                                  const NodeRecord<3> *nodes,
                                  const PlasticHistory &history,
                                  const std::size_t cell)
    {
      if (data.mixed)
      {
        const std::size_t first = cell - cell % parts_of_mixed;
        return MixedCells(data, nodes, first, mixed_points(history, first))
            .strain[cell - first];
      }
      return elastic_strain(cell_motion(data, nodes, cell).H,
                            history.space_cells[cell].inverse_stretch);
    }

    /** cell_stress() of the cells of a mixed tetrahedron. */
    OfMixed<SpaceTensor> mixed_stresses(const BlockForcesData<3> &data,
                                        const NodeRecord<3> *nodes,
                                        const PlasticHistory &history,
                                        const std::size_t first)
    {
      auto points = mixed_points(history, first);
      MixedCells cells(data, nodes, first, points);
      const SpaceMohrCoulomb *law = data.law_of(first);
      if (law)
      {
        points = update_mixed(data, first, points, cells).points;
        cells  = MixedCells(data, nodes, first, points);
      }
      OfMixed<SpaceTensor> result;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        const SpaceStrain &strain = cells.strain[k];
        const SpaceTensor initial = data.initial_stress_of(first + k);
        SpaceTensor s;
        if (law)
          s = law->cauchy_stress(points[k], strain, initial);
        else
        {
          s = elastic_stress(data.stiffness_of(first), strain.e);
          for (unsigned int i = 0; i < 6; ++i)
            s[i] += initial[i];
        }
        result[k] = strain.to_global(s);
      }
      return result;
    }

    double contraction(const SpaceTensor &a, const SpaceTensor &b)
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 6; ++i)
        sum += (i < 3 ? 1. : 2.) * a[i] * b[i];
      return sum;
    }
  } // namespace

  PlasticHistory initial_history(const BlockForces<3> &blocks)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    PlasticHistory history;
    if (!data.is_plastic())
      return history;
    history.resize<3>(data.cells.size());
    for (unsigned int k = 0; k < data.cells.size(); ++k)
      forget_history(blocks, k, history);
    return history;
  }

  void forget_history(const BlockForces<3> &blocks, const unsigned int cell,
                      PlasticHistory &history)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    if (!data.is_plastic())
      return;
    SpacePlasticPoint point;
    if (data.law_of(cell))
      point.stress = data.initial_stress_of(cell);
    set_plastic_point(point, cell, history);
  }

  SpacePlasticPoint cell_history(const BlockForces<3> &blocks,
                                 const NodeRecord<3> *nodes,
                                 const PlasticHistory &history,
                                 const unsigned int cell)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    if (data.mixed)
    {
      const std::size_t first = cell - cell % parts_of_mixed;
      const auto points       = mixed_points(history, first);
      return update_mixed(data, first, points,
                          MixedCells(data, nodes, first, points))
          .points[cell - first];
    }
    SpacePlasticPoint point = space_plastic_point(history, cell);
    data.law_of(cell)->update(point,
                              elastic_strain_of(data, nodes, history, cell),
                              data.initial_stress_of(cell));
    return point;
  }

  double add_forces_by_cell(const BlockForces<3> &blocks,
                            const unsigned int tile, const NodeRecord<3> *nodes,
                            PlasticHistory &history,
                            dealii::Tensor<1, 3> *force)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    const NodeRange cells          = blocks.tile_cells(tile);
    double dissipated              = 0.;
    for (std::size_t k = cells.begin; k < cells.end; k += data.n_joined_cells())
    {
      if (data.mixed)
      {
        dissipated += add_mixed_forces(data, k, nodes, history, force);
        continue;
      }
      if (data.law_of(k))
      {
        dissipated += add_plastic_forces(data, k, nodes, history, force);
        continue;
      }
      const CellMotion motion = cell_motion(data, nodes, k);
      const SpaceStrain strain(motion.H);
      double T[3][3];
      strain.turning_stress(data.initial_stress_of(k), T);
      const SpaceTensor s = elastic_stress(data.stiffness_of(k), strain.e);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          T[r][c] += s[symmetric_index[r][c]];
      add_cell_forces(data, k, motion.geometry, strain.R, T, force);
    }
    return dissipated;
  }

  double strain_energy(const BlockForces<3> &blocks, const NodeRecord<3> *nodes,
                       const PlasticHistory &history)
  {
    return blocks.strain_energy(nodes, history);
  }

  double cell_energy(const BlockForcesData<3> &data, const NodeRecord<3> *nodes,
                     const PlasticHistory &history, const std::size_t cell)
  {
    if (data.mixed)
      return mixed_energy(data, nodes, history, cell);
    const CellMotion motion        = cell_motion(data, nodes, cell);
    const SpaceTensor s0           = data.initial_stress_of(cell);
    const SpaceMohrCoulomb *yields = data.law_of(cell);
    double density;
    if (yields && history.yielding[cell] != 0)
    {
      const SpaceStrain strain
          = elastic_strain(motion.H, history.space_cells[cell].inverse_stretch);
      density = yields->stored_energy(yields->trial_stress(
                    space_plastic_point(history, cell), strain.e))
                - yields->stored_energy(s0);
    }
    else
    {
      const SpaceStrain strain(motion.H);
      const SpaceTensor s = elastic_stress(data.stiffness_of(cell), strain.e);
      density = 0.5 * contraction(s, strain.e) + contraction(s0, strain.e);
    }
    return motion.geometry.det / 6. * density;
  }

  SpaceTensor cell_stress(const BlockForces<3> &blocks,
                          const NodeRecord<3> *nodes,
                          const PlasticHistory &history, const std::size_t cell,
                          SpaceTensor *strain_out)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    const CellMotion motion        = cell_motion(data, nodes, cell);
    const SpaceStrain strain(motion.H);
    if (strain_out)
      *strain_out = strain.to_global(strain.e);
    if (data.mixed)
      return mixed_stresses(data, nodes, history,
                            cell
                                - cell % parts_of_mixed)[cell % parts_of_mixed];
    const SpaceTensor s0 = data.initial_stress_of(cell);
    if (const SpaceMohrCoulomb *yields = data.law_of(cell))
    {
      const SpacePlasticPoint point
          = cell_history(blocks, nodes, history, cell);
      double Q[6];
      std::copy(point.inverse_stretch.begin(), point.inverse_stretch.end(), Q);
      const SpaceStrain elastic = elastic_strain(motion.H, Q);
      return elastic.to_global(yields->cauchy_stress(point, elastic, s0));
    }
    SpaceTensor s = elastic_stress(data.stiffness_of(cell), strain.e);
    for (unsigned int i = 0; i < 6; ++i)
      s[i] += s0[i];
    return strain.to_global(s);
  }

  void cell_stresses(const BlockForces<3> &blocks, const NodeRecord<3> *nodes,
                     const PlasticHistory &history,
                     std::vector<SpaceTensor> &stress,
                     std::vector<SpaceTensor> &strain)
  {
    const std::size_t n_cells = blocks.cell_data().cells.size();
    stress.resize(n_cells);
    strain.resize(n_cells);
    const BlockForcesData<3> &data = blocks.cell_data();
    if (!data.mixed)
    {
      for (std::size_t k = 0; k < n_cells; ++k)
        stress[k] = cell_stress(blocks, nodes, history, k, &strain[k]);
      return;
    }
    for (std::size_t first = 0; first < n_cells; first += parts_of_mixed)
    {
      const auto stresses = mixed_stresses(data, nodes, history, first);
      std::copy(stresses.begin(), stresses.end(), stress.begin() + first);
      for (std::size_t k = first; k < first + parts_of_mixed; ++k)
      {
        const SpaceStrain own(cell_motion(data, nodes, k).H);
        strain[k] = own.to_global(own.e);
      }
    }
  }

  SpaceTensor stress_of_strain(const BlockForces<3> &blocks,
                               const NodeRecord<3> *nodes,
                               const PlasticHistory &history,
                               const std::size_t cell,
                               const SpaceStiffness &stiffness)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    SpaceTensor e = SpaceStrain(cell_motion(data, nodes, cell).H).e;
    if (data.mixed)
    {
      const std::size_t first = cell - cell % parts_of_mixed;
      const MixedCells cells(data, nodes, first, mixed_points(history, first));
      add_trace((cells.mean - cells.mean_initial) / cells.bulk - trace(e), e);
    }
    return elastic_stress(stiffness, e);
  }

  SpaceTensor turning_stress(const BlockForces<3> &blocks,
                             const NodeRecord<3> *nodes,
                             const PlasticHistory &history,
                             const std::size_t cell)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    const CellMotion motion        = cell_motion(data, nodes, cell);
    const auto &Q                  = history.space_cells[cell].inverse_stretch;
    const SpaceStrain whole(motion.H),
        strain = elastic_strain_of(data, nodes, history, cell);
    double T[3][3], PQ[3][3];
    strain.turning_stress(
        data.law_of(cell)->trial_stress(space_plastic_point(history, cell),
                                        strain.e, data.initial_stress_of(cell)),
        T);
    // R^T R_e T (I + Q), R that of the whole deformation.
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = 0; c < 3; ++c)
      {
        PQ[r][c] = 0.;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            PQ[r][c] += strain.R[r][i] * T[i][k]
                        * (Q[symmetric_index[k][c]] + (k == c ? 1. : 0.));
      }
    SpaceTensor result{};
    for (unsigned int r = 0; r < 3; ++r)
      for (unsigned int c = r; c < 3; ++c)
        for (unsigned int i = 0; i < 3; ++i)
          result[symmetric_index[r][c]]
              += 0.5 * (whole.R[i][r] * PQ[i][c] + whole.R[i][c] * PQ[i][r]);
    return result;
  }

  void take_over_stress(const BlockForces<3> &blocks,
                        const NodeRecord<3> *nodes, const std::size_t cell,
                        const SpaceMohrCoulomb &law,
                        const PlasticHistory &before, PlasticHistory &history)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    SpacePlasticPoint point        = space_plastic_point(before, cell);
    law.take_over(point, elastic_strain_of(data, nodes, before, cell),
                  *data.law_of(cell));
    set_plastic_point(point, cell, history);
  }

  unsigned int first_inverted_cell(const BlockForces<3> &blocks,
                                   const NodeRecord<3> *nodes)
  {
    const BlockForcesData<3> &data = blocks.cell_data();
    unsigned int k                 = 0;
    for (; k < data.cells.size(); ++k)
    {
      const CellMotion motion = cell_motion(data, nodes, k);
      if (!(motion.geometry.det > 0.) || !(SpaceStrain(motion.H).polar.j > -1.))
        break;
    }
    return k;
  }
} // namespace quoin
