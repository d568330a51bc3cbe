// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/dynamics/added_water.h>
#include <quoin/mesh/global_geometry.h>

#include <algorithm>

namespace quoin
{
  template <int dim>
  AddedWater<dim>::AddedWater(const Model<dim> &model,
                              const std::vector<LoadParameters> &loads)
    : model(model)
  {
    for (const LoadParameters &load : loads)
      if constexpr (dim == 2)
        if (load.has_added_mass)
          reservoirs.emplace_back(load, model.nodes(), model.thickness());
  }

  template <int dim>
  void AddedWater<dim>::begin_stage(const StageParameters &stage,
                                    const double start)
  {
    all.clear();
    reservoir_masses.assign(reservoirs.size(), {});
    // Water has no inertia in what looks for equilibria.
    if (!stage.is_dynamic() || stage.pattern)
      return;
    for (unsigned int r = 0; r < reservoirs.size(); ++r)
      if (names_load(stage, reservoirs[r].name()))
        if constexpr (dim == 2)
        {
          reservoir_masses[r] = reservoirs[r].masses(start);
          all                 = merged(all, reservoir_masses[r]);
        }
  }

  template <int dim>
  void AddedWater<dim>::check_levels(const StageParameters &stage,
                                     const double start) const
  {
    for (const HydrodynamicMass &reservoir : reservoirs)
      if (reservoir.changes(start, stage.duration)
          && names_load(stage, reservoir.name()) && stage.is_dynamic())
        throw InputError(
            "section 'Stages/" + stage.name + "': the level of the water of '"
            + reservoir.name()
            + "' changes in a stage that follows motion, but 'Added mass' is "
              "that of a level that stands. Fill the reservoir in a stage "
              "before, or give this stage a load without added mass.");
  }

  template <int dim>
  void AddedWater<dim>::check_constraints(
      const std::vector<MotionConstraint<dim> *> &constraints,
      const StageParameters &stage) const
  {
    if (reservoirs.empty())
      return;
    for (const MotionConstraint<dim> *constraint : constraints)
    {
      if (constraint->traits().kind == MotionKind::prescribed)
        continue;
      unsigned int first = NodeMap<dim>::none;
      for (const NodeMass<dim> &each : all)
        if (first == NodeMap<dim>::none
            && std::binary_search(constraint->nodes().begin(),
                                  constraint->nodes().end(), each.node))
          first = each.node;
      dealii::Point<dim> p;
      if (!first_point(model.nodes(), first, p))
        continue;
      throw InputError("section 'Stages/" + stage.name + "': the load '"
                       + constraint->name() + "' moves the node at "
                       + point_text(p)
                       + " m, to which a load with 'Added mass' adds water. "
                         "Only a prescribed motion can move both: end the face "
                         "below water where that load begins.");
    }
  }

  template <int dim>
  double AddedWater<dim>::total() const
  {
    double trace = 0.;
    for (const NodeMass<dim> &each : all)
      for (unsigned int d = 0; d < dim; ++d)
        trace += each.mass[d][d];
    return dealii::Utilities::MPI::sum(trace, model.nodes().communicator());
  }

  template <int dim>
  Resultant<dim>
  AddedWater<dim>::resultant(const std::string &load,
                             const CentralDifferences<dim> &stepper) const
  {
    Resultant<dim> sums{};
    for (unsigned int r = 0; r < reservoir_masses.size(); ++r)
      for (const NodeMass<dim> &mass : reservoir_masses[r])
        if (reservoirs[r].name() == load)
          add_force<dim>(stepper.inertia_force(mass),
                         model.nodes().point(mass.node), sums);
    MPI_Allreduce(MPI_IN_PLACE, sums.data(), sums.size(), MPI_DOUBLE, MPI_SUM,
                  model.nodes().communicator());
    return sums;
  }

  template class AddedWater<2>;
  template class AddedWater<3>;
} // namespace quoin
