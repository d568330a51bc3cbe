// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// BlockForces cell by cell, without strips.

#include <quoin/blocks/block_forces.h>

namespace quoin
{
  CorotatedStrain BlockForces<2>::cell_strain(const NodeRecord<2> *nodes,
                                              const std::size_t cell,
                                              double *area) const
  {
    if (data.quadratic)
    {
      const CellPoint point = cell_point(nodes, cell);
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

  PlasticHistory BlockForces<2>::initial_history() const
  {
    PlasticHistory history;
    if (!is_plastic())
      return history;
    history.resize(data.cells.size());
    for (unsigned int k = 0; k < data.cells.size(); ++k)
      forget_history(k, history);
    return history;
  }

  void BlockForces<2>::forget_history(const unsigned int cell,
                                      PlasticHistory &history) const
  {
    if (!is_plastic())
      return;
    history.cells[cell]    = PlasticCell();
    history.shear[cell]    = 0.;
    history.yielding[cell] = 0;
    if (!cell_law(cell))
      return;
    const auto s = initial_stress(cell);
    std::copy(s.begin(), s.end(), history.cells[cell].stress);
  }

  double BlockForces<2>::update_cell(const std::size_t cell,
                                     const PlaneTensor &strain,
                                     PlasticHistory &history) const
  {
    PlasticPoint point = plastic_point(history, cell);
    const double dissipated
        = cell_law(cell)->update(point, strain, initial_stress(cell));
    set_plastic_point(point, cell, history);
    return dissipated;
  }

  PlasticPoint BlockForces<2>::cell_history(const NodeRecord<2> *nodes,
                                            const PlasticHistory &history,
                                            const unsigned int cell) const
  {
    PlasticPoint point = plastic_point(history, cell);
    cell_law(cell)->update(point, cell_strain(nodes, cell).e,
                           initial_stress(cell));
    return point;
  }

  double BlockForces<2>::update(const NodeRecord<2> *nodes,
                                PlasticHistory &history) const
  {
    double dissipated = 0.;
    if (!is_plastic())
      return dissipated;
    for (std::size_t k = 0; k < data.cells.size(); ++k)
      if (cell_law(k))
      {
        double area;
        const CorotatedStrain strain = cell_strain(nodes, k, &area);
        dissipated += data.thickness * area * update_cell(k, strain.e, history);
      }
    return dissipated;
  }

  double BlockForces<2>::add_forces_by_cell(const unsigned int tile,
                                            const NodeRecord<2> *nodes,
                                            PlasticHistory &history,
                                            NodeVector<2> *force) const
  {
    double dissipated = 0.;
    for (std::size_t k = tiles[tile].cells.begin; k < tiles[tile].cells.end;
         ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const CorotatedStrain strain = cell_strain(nodes, k);
      PlaneTensor elastic = elastic_stress(cell_stiffness(k), strain.e);
      const auto s        = initial_stress(k);
      PlaneTensor turning{ s[0], s[1], s[2] };
      if (cell_law(k))
      {
        dissipated += data.thickness * triangle.area()
                      * update_cell(k, strain.e, history);
        elastic = {};
        std::copy_n(history.cells[k].stress, 3, turning.begin());
      }
      add_nodal_forces(triangle, data.thickness,
                       piola_stress(strain, elastic, turning), force[a],
                       force[b], force[c]);
    }
    return dissipated;
  }

  void BlockForces<2>::add_viscous_forces_by_cell(const unsigned int tile,
                                                  const NodeRecord<2> *nodes,
                                                  const NodeVector<2> *velocity,
                                                  const double beta,
                                                  NodeVector<2> *force) const
  {
    for (std::size_t k = tiles[tile].cells.begin; k < tiles[tile].cells.end;
         ++k)
    {
      const auto [a, b, c] = data.cells[k];
      const Triangle triangle(nodes[a], nodes[b], nodes[c]);
      const CorotatedStrain strain = cell_strain(nodes, k);
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
                                    elastic_stress(cell_stiffness(k), rate),
                                    { 0., 0., 0. }),
                       force[a], force[b], force[c]);
    }
  }

  double BlockForces<2>::strain_energy(const NodeRecord<2> *nodes,
                                       const PlasticHistory &history) const
  {
    double energy = 0.;
    for (std::size_t k = 0; k < data.cells.size(); ++k)
    {
      double area;
      PlaneTensor e                = cell_strain(nodes, k, &area).e;
      const PlaneStiffness &moduli = cell_stiffness(k);
      const auto s0                = initial_stress(k);
      double density               = 0.;
      if (const MohrCoulomb *yields = cell_law(k))
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

  std::array<double, 4> BlockForces<2>::cell_stress(
      const NodeRecord<2> *nodes, const PlasticHistory &history,
      const std::size_t cell, PlaneTensor *strain_out) const
  {
    const CorotatedStrain strain = cell_strain(nodes, cell);
    if (strain_out)
      *strain_out = strain.to_global(strain.e);
    std::array<double, 4> s = initial_stress(cell);
    if (cell_law(cell))
      s = cell_history(nodes, history, cell).stress;
    else
    {
      const auto elastic = elastic_stress(cell_stiffness(cell), strain.e);
      s[3] += cell_stiffness(cell).zz_over_sum * (elastic[0] + elastic[1]);
      for (unsigned int i = 0; i < 3; ++i)
        s[i] += elastic[i];
    }
    const auto in_plane = strain.to_global({ s[0], s[1], s[2] });
    return { in_plane[0], in_plane[1], in_plane[2], s[3] };
  }

  std::array<double, 4> BlockForces<2>::stress_of_strain(
      const NodeRecord<2> *nodes, const PlasticHistory &history,
      const std::size_t cell, const PlaneStiffness &stiffness,
      const MohrCoulomb *law) const
  {
    const PlaneTensor e = cell_strain(nodes, cell).e;
    if (law)
      return law->trial_stress(plastic_point(history, cell), e);
    const auto s = elastic_stress(stiffness, e);
    return { s[0], s[1], s[2], stiffness.zz_over_sum * (s[0] + s[1]) };
  }

  void BlockForces<2>::stresses(const NodeRecord<2> *nodes,
                                const PlasticHistory &history,
                                std::vector<std::array<double, 4>> &stress_out,
                                std::vector<PlaneTensor> &strain_out) const
  {
    stress_out.resize(data.cells.size());
    strain_out.resize(data.cells.size());
    for (std::size_t k = 0; k < data.cells.size(); ++k)
      stress_out[k] = cell_stress(nodes, history, k, &strain_out[k]);
  }
} // namespace quoin
