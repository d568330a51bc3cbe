// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// BlockForces cell by cell, without strips.

#include <quoin/blocks/cell_states.h>

#include "cell_strain.h"

namespace quoin
{
  CorotatedStrain cell_strain(const BlockForcesData<2> &data,
                              const NodeRecord<2> *nodes,
                              const std::size_t cell, double *area)
  {
    if (data.quadratic)
    {
      const CellPoint point = cell_point(data, nodes, cell);
      if (area)
        *area = point.area;
      return CorotatedStrain(point.displacement_gradient(nodes));
    }
    const auto [a, b, c] = data.cells[cell];
    const Triangle triangle(nodes[a], nodes[b], nodes[c]);
    if (area)
      *area = triangle.area();
    return CorotatedStrain(
        triangle.gradient(nodes[a].u, nodes[b].u, nodes[c].u));
  }

  PlasticHistory initial_history(const BlockForces<2> &blocks)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    PlasticHistory history;
    if (!data.is_plastic())
      return history;
    history.resize(data.cells.size());
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

  double update_cell(const BlockForcesData<2> &data, const std::size_t cell,
                     const PlaneTensor &strain, PlasticHistory &history)
  {
    PlasticPoint point      = plastic_point(history, cell);
    const double dissipated = data.law_of(cell)->update(
        point, strain, data.initial_stress_of(cell));
    set_plastic_point(point, cell, history);
    return dissipated;
  }

  PlasticPoint cell_history(const BlockForces<2> &blocks,
                            const NodeRecord<2> *nodes,
                            const PlasticHistory &history,
                            const unsigned int cell)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    PlasticPoint point             = plastic_point(history, cell);
    data.law_of(cell)->update(point, cell_strain(data, nodes, cell).e,
                              data.initial_stress_of(cell));
    return point;
  }

  double BlockForces<2>::update(const NodeRecord<2> *nodes,
                                PlasticHistory &history) const
  {
    double dissipated = 0.;
    if (!data.is_plastic())
      return dissipated;
    for (std::size_t k = 0; k < data.cells.size(); ++k)
      if (data.law_of(k))
      {
        double area;
        const CorotatedStrain strain = cell_strain(data, nodes, k, &area);
        dissipated
            += data.thickness * area * update_cell(data, k, strain.e, history);
      }
    return dissipated;
  }

  double add_forces_by_cell(const BlockForces<2> &blocks,
                            const unsigned int tile, const NodeRecord<2> *nodes,
                            PlasticHistory &history, NodeVector<2> *force)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const NodeRange cells          = blocks.tile_cells(tile);
    double dissipated              = 0.;
    for (std::size_t k = cells.begin; k < cells.end; ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const CorotatedStrain strain = cell_strain(data, nodes, k);
      PlaneTensor elastic = elastic_stress(data.stiffness_of(k), strain.e);
      const auto s        = data.initial_stress_of(k);
      PlaneTensor turning{ s[0], s[1], s[2] };
      if (data.law_of(k))
      {
        dissipated += data.thickness * triangle.area()
                      * update_cell(data, k, strain.e, history);
        elastic = {};
        std::copy_n(history.cells[k].stress, 3, turning.begin());
      }
      add_nodal_forces(triangle, data.thickness,
                       piola_stress(strain, elastic, turning), force[a],
                       force[b], force[c]);
    }
    return dissipated;
  }

  void add_viscous_forces_by_cell(const BlockForces<2> &blocks,
                                  const unsigned int tile,
                                  const NodeRecord<2> *nodes,
                                  const NodeVector<2> *velocity,
                                  const double beta, NodeVector<2> *force)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const NodeRange cells          = blocks.tile_cells(tile);
    for (std::size_t k = cells.begin; k < cells.end; ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const CorotatedStrain strain = cell_strain(data, nodes, k);
      const auto L
          = triangle.gradient(velocity[a].v, velocity[b].v, velocity[c].v);
      // sym(R^T L)
      const double cs = strain.c, sn = strain.s;
      const PlaneTensor rate{ beta * (cs * L[0] + sn * L[2]),
                              beta * (cs * L[3] - sn * L[1]),
                              0.5 * beta
                                  * (cs * (L[1] + L[2]) + sn * (L[3] - L[0])) };
      add_nodal_forces(triangle, data.thickness,
                       piola_stress(strain,
                                    elastic_stress(data.stiffness_of(k), rate),
                                    { 0., 0., 0. }),
                       force[a], force[b], force[c]);
    }
  }

  double strain_energy(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                       const PlasticHistory &history)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    double energy                  = 0.;
    for (std::size_t k = 0; k < data.cells.size(); ++k)
    {
      double area;
      PlaneTensor e                = cell_strain(data, nodes, k, &area).e;
      const PlaneStiffness &moduli = data.stiffness_of(k);
      const auto s0                = data.initial_stress_of(k);
      double density               = 0.;
      if (const MohrCoulomb *yields = data.law_of(k))
      {
        const auto &p = history.cells[k].strain;
        for (unsigned int i = 0; i < 3; ++i)
          e[i] -= p[i];
        // Out of the plane the elastic strain is -p_zz.
        if (yields->plane_assumption() == PlaneAssumption::plane_strain)
          density
              = (0.5 * moduli.c11 * p[3] - moduli.c12 * (e[0] + e[1]) - s0[3])
                * p[3];
      }
      const auto s = elastic_stress(moduli, e);
      density += (0.5 * s[0] + s0[0]) * e[0] + (0.5 * s[1] + s0[1]) * e[1]
                 + 2. * (0.5 * s[2] + s0[2]) * e[2];
      energy += data.thickness * area * density;
    }
    return energy;
  }

  std::array<double, 4> cell_stress(const BlockForces<2> &blocks,
                                    const NodeRecord<2> *nodes,
                                    const PlasticHistory &history,
                                    const std::size_t cell,
                                    PlaneTensor *strain_out)
  {
    const BlockForcesData<2> &data = blocks.cell_data();
    const CorotatedStrain strain   = cell_strain(data, nodes, cell);
    if (strain_out)
      *strain_out = strain.to_global(strain.e);
    std::array<double, 4> s = data.initial_stress_of(cell);
    if (data.law_of(cell))
      s = cell_history(blocks, nodes, history, cell).stress;
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

  std::array<double, 4>
  stress_of_strain(const BlockForces<2> &blocks, const NodeRecord<2> *nodes,
                   const PlasticHistory &history, const std::size_t cell,
                   const PlaneStiffness &stiffness, const MohrCoulomb *law)
  {
    const PlaneTensor e = cell_strain(blocks.cell_data(), nodes, cell).e;
    if (law)
      return law->trial_stress(plastic_point(history, cell), e);
    const auto s = elastic_stress(stiffness, e);
    return { s[0], s[1], s[2], stiffness.zz_over_sum * (s[0] + s[1]) };
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
