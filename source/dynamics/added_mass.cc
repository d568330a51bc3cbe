// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/dynamics/added_mass.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    /** Share of its mass by which a block becomes noticeably slower. */
    constexpr double felt = 0.05;
    /** A warning is given from this share of such blocks in the model on, and
        if frequencies up to this multiple of the loads' highest are lowered. */
    constexpr double most_slow = 0.01, least_frequency = 4.;
    /** Added share of the mass of the model from which on histories change by a
        hundredth; verification/bar. */
    constexpr double most_added = 0.0025;
  } // namespace

  std::string AddedMass::text() const
  {
    return text_of("mass scaling adds ", 100. * share, " % of mass, on ",
                   100. * bodies, " % of the nodes and rigid blocks, up to ",
                   factor, " times theirs; it lowers frequencies above ",
                   frequency, " Hz, and ", n_slow, " blocks and beams, ",
                   100. * slow_share,
                   " % of the mass, become heavier by 5 % or more");
  }

  std::string AddedMass::warning(const double highest) const
  {
    if (share > most_added)
      return text_of("mass scaling adds ", 100. * share,
                     " % of mass to a stage that follows motion, which changes "
                     "histories by up to four times as much. Take a shorter "
                     "'Scaled time step'.");
    if (slow_share > most_slow)
      return text_of("mass scaling makes blocks and beams with ",
                     100. * slow_share,
                     " % of the mass heavier by 5 % or more, so that they move "
                     "too slowly. Take a shorter 'Scaled time step', or larger "
                     "elements where the log says that the step is limited.");
    if (frequency < least_frequency * highest)
      return text_of("mass scaling lowers frequencies above ", frequency,
                     " Hz, and loads bring up to ", highest,
                     " Hz. Take a 'Scaled time step' of at most ",
                     1. / (dealii::numbers::PI * least_frequency * highest),
                     " s.");
    return "";
  }

  template <int dim>
  AddedMass find_added_mass(const Model<dim> &model,
                            const std::vector<double> &mass,
                            const std::vector<double> &factors,
                            const BeamMasses &beams, const double time_step)
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::sum;
    const NodeMap<dim> &nodes = model.nodes();
    const RigidBlocks &rigid  = model.rigid_blocks();
    const MPI_Comm all        = nodes.communicator();
    AddedMass result;
    result.frequency = 1. / (dealii::numbers::PI * time_step);

    // Own and added mass of each block of the mesh.
    const std::size_t n_blocks = nodes.table().n_blocks();
    std::vector<double> own(n_blocks, 0.), added(n_blocks, 0.);
    double n_bodies = 0., n_heavier = 0.;
    const auto add_body
        = [&](const unsigned int block, const double has, const double factor)
    {
      own[block] += has;
      added[block] += (factor - 1.) * has;
      ++n_bodies;
      n_heavier += factor > 1.;
      result.factor = std::max(result.factor, factor);
    };
    for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
      add_body(nodes.block_of_node(i), model.mass()[i],
               mass[i] / model.mass()[i]);
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      double has = 0.;
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
        has += model.mass()[i];
      add_body(nodes.block_of_node(rigid.block(b).begin), has, factors[b]);
    }
    sum(own, all, own);
    sum(added, all, added);
    n_bodies  = sum(n_bodies, all);
    n_heavier = sum(n_heavier, all);
    // All ranks have all beams.
    for (const auto &beam : beams)
    {
      own.push_back(0.);
      added.push_back(0.);
      for (const auto &[has, scaled] : beam)
        add_body(own.size() - 1, has, scaled / has);
    }
    double all_own = 0., all_added = 0.;
    for (std::size_t b = 0; b < own.size(); ++b)
    {
      all_own += own[b];
      all_added += added[b];
      if (added[b] > felt * own[b])
      {
        ++result.n_slow;
        result.slow_share += own[b];
      }
    }
    result.slow_share /= all_own;
    result.share  = all_added / all_own;
    result.bodies = n_heavier / n_bodies;
    result.factor = max(result.factor, all);
    return result;
  }

  template <>
  void ScaledMasses<2>::find_beam_masses(const StableTimeStep<2> &stability,
                                         const double dt, BeamMotion &beams,
                                         const State<2> &state)
  {
    beams.find_masses(dt, state);
    double eigenvalue                 = beams.largest_eigenvalue(state);
    const std::vector<double> springs = beams.interface_bound(state);
    for (unsigned int i = 0; i < springs.size(); ++i)
    {
      if (springs[i] == 0.)
        continue;
      if (dt > 0.)
        nodes[i] = std::max(nodes[i], stability.mass_for(i, dt)
                                          + 0.25 * dt * dt * springs[i]);
      eigenvalue = std::max(eigenvalue, stability.squared_frequency(i, nodes[i])
                                            + springs[i] / nodes[i]);
    }
    beam_eigenvalue = eigenvalue;
  }

  template <int dim>
  ScaledMasses<dim>::ScaledMasses(const Model<dim> &model,
                                  const StableTimeStep<dim> &stability,
                                  const double time_step,
                                  BeamMotion *const beams,
                                  const State<dim> &state)
    : nodes(model.mass())
  {
    const RigidBlocks &rigid = model.rigid_blocks();
    rigid_factor.resize(rigid.n_blocks(), 1.);
    for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
    {
      double &factor = rigid_factor[b];
      factor = time_step > 0. ? stability.rigid_factor(b, time_step) : 1.;
      for (unsigned int i = rigid.block(b).begin; i < rigid.block(b).end; ++i)
        nodes[i] *= factor;
    }
    if (time_step > 0.)
      for (unsigned int i = 0; i < model.nodes().n_deformable_nodes(); ++i)
        nodes[i] = std::max(nodes[i], stability.mass_for(i, time_step));
    if constexpr (dim == 2)
      if (beams)
        find_beam_masses(stability, time_step, *beams, state);
    if (time_step == 0.)
      return;
    BeamMasses of_beams;
    if constexpr (dim == 2)
      if (beams)
        of_beams = beams->masses(state);
    added = find_added_mass(model, nodes, rigid_factor, of_beams, time_step);
  }

  template AddedMass find_added_mass(const Model<2> &,
                                     const std::vector<double> &,
                                     const std::vector<double> &,
                                     const BeamMasses &, double);
  template AddedMass find_added_mass(const Model<3> &,
                                     const std::vector<double> &,
                                     const std::vector<double> &,
                                     const BeamMasses &, double);
  template struct ScaledMasses<2>;
  template struct ScaledMasses<3>;
} // namespace quoin
