// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// BlockForces cell by cell, without strips.

#include <quoin/block_elements/cell_strain.h>
#include <quoin/blocks/cell_states.h>

namespace quoin
{
  namespace
  {
    /** Strain of the elastic part of a cell's deformation. */
    CorotatedStrain elastic_strain(const std::array<double, 4> &gradient,
                                   const PlasticHistory &history,
                                   const std::size_t cell)
    {
      return CorotatedStrain(
          stretched_gradient(gradient, history.cells[cell].inverse_stretch));
    }

    /** First Piola-Kirchhoff stress of the whole deformation [Pa]. */
    std::array<double, 4> plastic_piola_stress(const CorotatedStrain &strain,
                                               const PlaneTensor &stress,
                                               const PlasticCell &cell)
    {
      return stretched(piola_stress(strain, { 0., 0., 0. }, stress),
                       cell.inverse_stretch);
    }
  } // namespace

  PlasticHistory initial_history(const BlockForces<2> &blocks)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    PlasticHistory history;
    if (!data.is_plastic())
      return history;
    history.resize<2>(data.cells.size());
    for (unsigned int k = 0; k < data.cells.size(); ++k)
      forget_history(blocks, k, history);
    return history;
  }

  void forget_history(const BlockForces<2> &blocks, const unsigned int cell,
                      PlasticHistory &history)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    if (!data.is_plastic())
      return;
    history.cells[cell]    = PlasticCell();
    history.shear[cell]    = 0.;
    history.yielding[cell] = 0;
    if (!data.law_of(cell))
      return;
    const auto s = data.initial_stress_of(cell);
    std::copy(s.begin(), s.end(), history.cells[cell].stress);
  }

  PlasticPoint cell_history(const BlockForces<2> &blocks,
                            const NodeRecord<2> *nodes,
                            const PlasticHistory &history,
                            const unsigned int cell)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    PlasticPoint point             = plastic_point(history, cell);
    data.law_of(cell)->update(
        point,
        elastic_strain(cell_gradient(data, nodes, cell), history, cell).e,
        data.initial_stress_of(cell));
    return point;
  }

  double add_forces_by_cell(const BlockForces<2> &blocks,
                            const unsigned int tile, const NodeRecord<2> *nodes,
                            PlasticHistory &history,
                            dealii::Tensor<1, 2> *force)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const NodeRange cells          = blocks.tile_cells(tile);
    double dissipated              = 0.;
    for (std::size_t k = cells.begin; k < cells.end; ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const auto gradient = cell_gradient(data, nodes, k);
      std::array<double, 4> P;
      if (data.law_of(k))
      {
        const PlasticCell before     = history.cells[k];
        const CorotatedStrain strain = elastic_strain(gradient, history, k);
        const PlasticStep step       = update_cell(data, k, strain.e, history);
        dissipated += data.thickness_of(k) * triangle.area() * step.dissipated;
        P = plastic_piola_stress(strain, step.stress, before);
      }
      else
      {
        const CorotatedStrain strain(gradient);
        const auto s = data.initial_stress_of(k);
        P = piola_stress(strain, elastic_stress(data.stiffness_of(k), strain.e),
                         { s[0], s[1], s[2] });
      }
      add_nodal_forces(triangle, data.thickness_of(k), P, force[a], force[b],
                       force[c]);
    }
    return dissipated;
  }

  void add_viscous_forces_by_cell(const BlockForces<2> &blocks,
                                  const unsigned int tile,
                                  const NodeRecord<2> *nodes,
                                  const dealii::Tensor<1, 2> *velocity,
                                  const double beta,
                                  dealii::Tensor<1, 2> *force)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const NodeRange cells          = blocks.tile_cells(tile);
    for (std::size_t k = cells.begin; k < cells.end; ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const CorotatedStrain strain(cell_gradient(data, nodes, k));
      const auto L = triangle.gradient(velocity[a], velocity[b], velocity[c]);
      // sym(R^T L)
      const double cs = strain.c, sn = strain.s;
      const PlaneTensor rate{ beta * (cs * L[0] + sn * L[2]),
                              beta * (cs * L[3] - sn * L[1]),
                              0.5 * beta
                                  * (cs * (L[1] + L[2]) + sn * (L[3] - L[0])) };
      add_nodal_forces(triangle, data.thickness_of(k),
                       piola_stress(strain,
                                    elastic_stress(data.stiffness_of(k), rate),
                                    { 0., 0., 0. }),
                       force[a], force[b], force[c]);
    }
  }

  double strain_energy(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                       const PlasticHistory &history)
  {
    return blocks.strain_energy(nodes, history);
  }

  double cell_energy(const BlockForcesData<2> &data, const NodeRecord<2> *nodes,
                     const PlasticHistory &history, const std::size_t cell)
  {
    double area;
    const auto gradient       = cell_gradient(data, nodes, cell, &area);
    const auto s0             = data.initial_stress_of(cell);
    const MohrCoulomb *yields = data.law_of(cell);
    double density;
    if (yields && history.yielding[cell] != 0)
      density = yields->stored_energy(yields->trial_stress(
                    plastic_point(history, cell),
                    elastic_strain(gradient, history, cell).e))
                - yields->stored_energy(s0);
    else
    {
      const PlaneTensor e = CorotatedStrain(gradient).e;
      const auto s        = elastic_stress(data.stiffness_of(cell), e);
      density = (0.5 * s[0] + s0[0]) * e[0] + (0.5 * s[1] + s0[1]) * e[1]
                + 2. * (0.5 * s[2] + s0[2]) * e[2];
    }
    return data.thickness_of(cell) * area * density;
  }

  std::array<double, 4> cell_stress(const BlockForces<2> &blocks,
                                    const NodeRecord<2> *nodes,
                                    const PlasticHistory &history,
                                    const std::size_t cell,
                                    PlaneTensor *strain_out)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const auto gradient            = cell_gradient(data, nodes, cell);
    CorotatedStrain strain(gradient);
    if (strain_out)
      *strain_out = strain.to_global(strain.e);
    std::array<double, 4> s = data.initial_stress_of(cell);
    if (const MohrCoulomb *yields = data.law_of(cell))
    {
      const PlasticPoint point = cell_history(blocks, nodes, history, cell);
      strain                   = CorotatedStrain(
                            stretched_gradient(gradient, point.inverse_stretch));
      s = yields->cauchy_stress(point, strain.e, s);
    }
    else
    {
      const auto elastic = elastic_stress(data.stiffness_of(cell), strain.e);
      s[3] += data.stiffness_of(cell).zz_over_sum * (elastic[0] + elastic[1]);
      for (unsigned int i = 0; i < 3; ++i)
        s[i] += elastic[i];
    }
    const auto in_plane = strain.to_global({ s[0], s[1], s[2] });
    return { in_plane[0], in_plane[1], in_plane[2], s[3] };
  }

  std::array<double, 4> stress_of_strain(const BlockForces<2> &blocks,
                                         const NodeRecord<2> *nodes,
                                         const PlasticHistory &,
                                         const std::size_t cell,
                                         const PlaneStiffness &stiffness)
  {
    const CorotatedStrain strain(
        cell_gradient(blocks.cell_data(), nodes, cell));
    const auto s = elastic_stress(stiffness, strain.e);
    return { s[0], s[1], s[2], stiffness.zz_over_sum * (s[0] + s[1]) };
  }

  std::array<double, 4> turning_stress(const BlockForces<2> &blocks,
                                       const NodeRecord<2> *nodes,
                                       const PlasticHistory &history,
                                       const std::size_t cell)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const auto gradient            = cell_gradient(data, nodes, cell);
    const CorotatedStrain whole(gradient);
    const PlasticPoint point     = plastic_point(history, cell);
    const CorotatedStrain strain = elastic_strain(gradient, history, cell);
    const auto stress            = data.law_of(cell)->trial_stress(
                   point, strain.e, data.initial_stress_of(cell));
    const auto P = plastic_piola_stress(
        strain, { stress[0], stress[1], stress[2] }, history.cells[cell]);
    // sym(R^T P)
    const double co = whole.c, si = whole.s;
    return { co * P[0] + si * P[2], co * P[3] - si * P[1],
             0.5 * (co * (P[1] + P[2]) + si * (P[3] - P[0])),
             (1. + point.inverse_stretch[3]) * stress[3] };
  }

  void take_over_stress(const BlockForces<2> &blocks,
                        const NodeRecord<2> *nodes, const std::size_t cell,
                        const MohrCoulomb &law, const PlasticHistory &before,
                        PlasticHistory &history)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    PlasticPoint point             = plastic_point(before, cell);
    law.take_over(
        point, elastic_strain(cell_gradient(data, nodes, cell), before, cell).e,
        *data.law_of(cell));
    set_plastic_point(point, cell, history);
  }

  void cell_stresses(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                     const PlasticHistory &history,
                     std::vector<std::array<double, 4>> &stress_out,
                     std::vector<PlaneTensor> &strain_out)
  {
    const std::size_t n_cells = blocks.cell_data().cells.size();
    stress_out.resize(n_cells);
    strain_out.resize(n_cells);
    for (std::size_t k = 0; k < n_cells; ++k)
      stress_out[k] = cell_stress(blocks, nodes, history, k, &strain_out[k]);
  }
} // namespace quoin
