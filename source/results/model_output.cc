// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/results/field_output.h>
#include <quoin/results/model_output.h>

namespace quoin
{
  ModelOutput::ModelOutput(const std::string &folder, const Model &model,
                           Solver &solver)
    : model(model), solver(solver),
      blocks(folder, model.exchange().communicator()),
      joints(folder, model.exchange().communicator()),
      contacts(folder, model.exchange().communicator(), "contacts")
  {
  }

  void ModelOutput::start()
  {
    blocks.start();
    joints.start();
    if (solver.contacts())
      contacts.start();
  }

  void ModelOutput::write(const double time, const State<2> &state,
                          const State<2> *base)
  {
    // Internal variables are those of the step before.
    State<2> now = state;
    solver.update_histories(now);
    BlockFields fields = block_fields(model, now);
    if (base)
    {
      // Of the blocks that are left.
      State<2> begin          = *base;
      begin.block_marks       = now.block_marks;
      const BlockFields start = block_fields(model, begin);
      for (std::size_t i = 0; i < fields.position.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          fields.position[i][d] += start.displacement[i][d];
          fields.displacement[i][d] -= start.displacement[i][d];
        }
    }
    blocks.write(time, fields);
    joints.write(time, joint_fields(model, now));
    if (const BlockContacts *all = solver.contacts())
      contacts.write(time, contact_fields(*all, now));
  }
} // namespace quoin
