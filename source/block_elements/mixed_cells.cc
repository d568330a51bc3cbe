// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/mixed_cells.h>

namespace quoin
{
  namespace
  {
    /** Stress of a cell by the strain that it shares [Pa]. */
    SpaceTensor trial_stress(const BlockForcesData<3> &data,
                             const std::size_t cell,
                             const SpacePlasticPoint &point,
                             const SpaceTensor &e)
    {
      SpaceTensor s = elastic_stress(data.stiffness_of(cell), e);
      if (point.state == 0)
      {
        const SpaceTensor initial = data.initial_stress_of(cell);
        for (unsigned int i = 0; i < 6; ++i)
          s[i] += initial[i];
      }
      return s;
    }
  } // namespace

  OfMixed<SpacePlasticPoint> mixed_points(const PlasticHistory &history,
                                          const std::size_t first)
  {
    OfMixed<SpacePlasticPoint> points;
    if (!history.space_cells.empty())
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
        points[k] = space_plastic_point(history, first + k);
    return points;
  }

  MixedCells::MixedCells(const BlockForcesData<3> &data,
                         const NodeRecord<3> *nodes, const std::size_t first,
                         const OfMixed<SpacePlasticPoint> &points)
    : volume(0.)
  {
    const SpaceStiffness &stiffness = data.stiffness_of(first);
    bulk                            = stiffness.lambda + 2. / 3. * stiffness.mu;
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
    {
      double Q[6];
      std::copy_n(points[k].inverse_stretch.begin(), 6, Q);
      motion[k]  = cell_motion(data, nodes, first + k);
      strain[k]  = data.law_of(first) ? elastic_strain(motion[k].H, Q)
                                      : SpaceStrain(motion[k].H);
      share[k]   = motion[k].geometry.det / 6.;
      initial[k] = trace(data.initial_stress_of(first + k)) / 3.;
      own[k]     = bulk * trace(strain[k].e)
               + (points[k].state == 0 ? initial[k] : 0.);
      volume += share[k];
    }
    for (double &s : share)
      s /= volume;
    mean         = average(own);
    mean_initial = average(initial);
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
      add_trace((mean + beyond_mean(k) - own[k]) / bulk, strain[k].e);
  }

  MixedStep update_mixed(const BlockForcesData<3> &data,
                         const std::size_t first,
                         const OfMixed<SpacePlasticPoint> &points,
                         const MixedCells &cells, const unsigned int n_passes)
  {
    MixedStep step{};
    constexpr auto now = yielding::shear_now | yielding::tension_now;
    OfMixed<double> drop, of_force, stored; // of mean stresses, or those
    for (unsigned int pass = 0; pass < n_passes; ++pass)
    {
      bool flows      = false;
      step.dissipated = 0.;
      step.points     = points;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        const SpaceTensor initial = data.initial_stress_of(first + k);
        SpaceStrain strain        = cells.strain[k];
        add_trace(step.exchanged[k], strain.e);
        const SpacePlasticStep own
            = data.law_of(first)->update(step.points[k], strain, initial);
        step.stress[k] = own.stress;
        of_force[k]    = trace(own.stress) / 3. - cells.beyond_mean(k);
        stored[k] = trace(step.points[k].stress) / 3. - cells.beyond_mean(k);
        drop[k]   = cells.mean + cells.bulk * step.exchanged[k] - stored[k];
        step.dissipated += cells.share[k] * own.dissipated;
        flows = flows || (step.points[k].state & now) != 0;
      }
      if (!flows || pass + 1 == n_passes)
        break;
      const double mean_drop = cells.average(drop);
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
        step.exchanged[k] = (drop[k] - mean_drop) / cells.bulk;
    }
    const double mean_of_force = cells.average(of_force),
                 mean_stored   = cells.average(stored);
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
    {
      const double rise = mean_stored - stored[k];
      add_trace(3. * (mean_of_force - of_force[k]), step.stress[k]);
      add_trace(3. * rise, step.points[k].stress);
      step.dissipated += cells.share[k] * rise * rise / (2. * cells.bulk);
    }
    step.dissipated *= cells.volume;
    return step;
  }

  double update_mixed(const BlockForcesData<3> &data, const std::size_t first,
                      const NodeRecord<3> *nodes, PlasticHistory &history)
  {
    const auto points    = mixed_points(history, first);
    const MixedStep step = update_mixed(data, first, points,
                                        MixedCells(data, nodes, first, points));
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
      set_plastic_point(step.points[k], first + k, history);
    return step.dissipated;
  }

  double mixed_energy(const BlockForcesData<3> &data,
                      const NodeRecord<3> *nodes, const PlasticHistory &history,
                      const std::size_t first)
  {
    const auto points = mixed_points(history, first);
    const MixedCells cells(data, nodes, first, points);
    const double mu = data.stiffness_of(first).mu;
    double energy   = 0.5 * (cells.mean - cells.mean_initial)
                    * (cells.mean + cells.mean_initial) / cells.bulk;
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
    {
      SpaceTensor s
          = trial_stress(data, first + k, points[k], cells.strain[k].e),
          s0 = data.initial_stress_of(first + k);
      add_trace(-trace(s), s);
      add_trace(-trace(s0), s0);
      double deviatoric = 0.;
      for (unsigned int i = 0; i < 6; ++i)
        deviatoric += (i < 3 ? 1. : 2.) * (s[i] - s0[i]) * (s[i] + s0[i]);
      energy += cells.share[k]
                * (deviatoric / (4. * mu)
                   + cells.beyond_mean(k) * (cells.own[k] - cells.initial[k])
                         / cells.bulk);
    }
    return cells.volume * energy;
  }

  double add_mixed_forces(const BlockForcesData<3> &data,
                          const std::size_t first, const NodeRecord<3> *nodes,
                          PlasticHistory &history, dealii::Tensor<1, 3> *force)
  {
    const auto points = mixed_points(history, first);
    const MixedCells cells(data, nodes, first, points);
    if (!data.law_of(first))
    {
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        double T[3][3];
        cells.strain[k].turning_stress(
            trial_stress(data, first + k, points[k], cells.strain[k].e), T);
        add_cell_forces(data, first + k, cells.motion[k].geometry,
                        cells.strain[k].R, T, force);
      }
      return 0.;
    }
    const MixedStep step = update_mixed(data, first, points, cells);
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
    {
      // P = P_e (I + Q): on gradients on which (I + Q) has acted.
      double T[3][3], Q[6];
      std::copy_n(points[k].inverse_stretch.begin(), 6, Q);
      cells.strain[k].turning_stress(step.stress[k], T);
      Tetrahedron<OneLane> flowed = cells.motion[k].geometry;
      flowed.flow(Q);
      add_cell_forces(data, first + k, flowed, cells.strain[k].R, T, force);
      set_plastic_point(step.points[k], first + k, history);
    }
    return step.dissipated;
  }
} // namespace quoin
