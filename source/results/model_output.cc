// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/field_output.h>
#include <quoin/results/model_output.h>
#include <quoin/results/result_origin.h>

namespace quoin
{
  template <int dim>
  ModelOutput<dim>::ModelOutput(const std::string &folder,
                                const Model<dim> &model, Solver<dim> &solver,
                                const FieldFormat format)
    : model(model), solver(solver),
      blocks(folder, model.nodes().communicator(), format),
      joints(folder, model.nodes().communicator(), "joints", format),
      contacts(folder, model.nodes().communicator(), "contacts", format),
      cables(folder, model.nodes().communicator(), format),
      beams(folder, model.nodes().communicator(), format)
  {
  }

  template <int dim>
  void ModelOutput<dim>::start()
  {
    blocks.start();
    joints.start();
    if (model.contacts())
      contacts.start();
    if (!model.reinforcement().empty())
      cables.start();
    if (solver.loads().beams)
      beams.start();
  }

  template <int dim>
  void ModelOutput<dim>::write(const double time, const State<dim> &state)
  {
    // Internal variables are those of the previous step.
    State<dim> now = state;
    solver.update_histories(now);
    blocks.write(time, block_fields(model, now));
    joints.write(time, joint_fields(model, now));
    if constexpr (dim == 2)
    {
      if (const BlockContacts *all = model.contacts())
        contacts.write(time, contact_fields(model.joints(), *all, now));
      if (!model.reinforcement().empty())
        cables.write(time, cable_fields(model.reinforcement(), now),
                     earlier_displacement(model.reinforcement(), now));
      if (const Beams *all = solver.loads().beams.get())
        beams.write(time, *all, now);
    }
  }

  template class ModelOutput<2>;
  template class ModelOutput<3>;
} // namespace quoin
