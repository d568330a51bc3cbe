// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/dynamics/free_bodies.h>
#include <quoin/loads/platen.h>

#include <deal.II/base/symmetric_tensor.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Gram = dealii::SymmetricTensor<2, 3>;

    /** Adds the square of one held freedom's row on the rigid motions. */
    void add_row(Gram &gram, const double x, const double y, const double turn)
    {
      const double row[3] = { x, y, turn };
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          gram[i][j] += row[i] * row[j];
    }
  } // namespace

  void check_no_free_bodies(const Model &model,
                            const std::vector<NodeConstraint *> &constraints,
                            const std::string &stage, const State &state)
  {
    const BlockMesh<2> &mesh     = model.mesh();
    const NodeExchange &exchange = model.exchange();
    const unsigned int n         = mesh.n_blocks();
    const auto centre            = mesh.vertices[0];
    double size                  = 0.;
    for (const auto &p : mesh.vertices)
      size = std::max(size, p.distance(centre));

    // What holds each block: rows x, y, size * rotation. All blocks of a
    // platen are one body, whose rows go to the first of them.
    std::vector<double> gram_entries(6 * n, 0.);
    std::vector<unsigned int> rank(n), parent(n);
    boost::disjoint_sets<unsigned int *, unsigned int *> bodies(rank.data(),
                                                                parent.data());
    for (unsigned int b = 0; b < n; ++b)
      bodies.make_set(b);
    for (const NodeConstraint *constraint : constraints)
    {
      const auto holds   = constraint->supports()
                               ? std::array<bool, 3>{ { true, true, false } }
                               : constraint->holds();
      unsigned int first = n;
      std::set<unsigned int> blocks;
      for (const unsigned int node : constraint->nodes())
      {
        const unsigned int v     = exchange.global(node);
        const unsigned int block = mesh.block_of_vertex(v);
        blocks.insert(block);
        const auto r = (mesh.vertices[v] - centre) / size;
        Gram gram;
        if (holds[0])
          add_row(gram, 1., 0., -r[1]);
        if (holds[1])
          add_row(gram, 0., 1., r[0]);
        if (holds[2])
          add_row(gram, 0., 0., 1.);
        if (constraint->is_global() && !holds[2])
          // A platen that may turn holds its centre alone, which lies
          // within its nodes; a single row each is what it prescribes.
          gram = Gram();
        for (unsigned int k = 0; k < 6; ++k)
          gram_entries[6 * block + k]
              += gram[Gram::unrolled_to_component_indices(k)];
      }
      if (!constraint->is_global())
        continue;
      first = dealii::Utilities::MPI::min(blocks.empty() ? n : *blocks.begin(),
                                          exchange.communicator());
      std::vector<unsigned int> member(n, 0);
      for (const unsigned int block : blocks)
        member[block] = 1;
      dealii::Utilities::MPI::max(member, exchange.communicator(), member);
      for (unsigned int block = 0; block < n; ++block)
        if (member[block])
          bodies.union_set(block, first);
      if (!holds[2] && !blocks.empty() && *blocks.begin() == first)
      {
        Gram gram;
        const auto r
            = (mesh.vertices[exchange.global(constraint->nodes().front())]
               - centre)
              / size;
        if (holds[0])
          add_row(gram, 1., 0., -r[1]);
        if (holds[1])
          add_row(gram, 0., 1., r[0]);
        for (unsigned int k = 0; k < 6; ++k)
          gram_entries[6 * first + k]
              += gram[Gram::unrolled_to_component_indices(k)];
      }
    }
    dealii::Utilities::MPI::sum(gram_entries, exchange.communicator(),
                                gram_entries);
    for (const JointFace &face : mesh.joint_faces)
    {
      const unsigned int a = mesh.block_of_vertex(face.lower[0]);
      const unsigned int b = mesh.block_of_vertex(face.upper[0]);
      if (!state.is_absent(a) && !state.is_absent(b))
        bodies.union_set(a, b);
    }

    std::vector<Gram> body_gram(n);
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int k = 0; k < 6; ++k)
        body_gram[bodies.find_set(b)][Gram::unrolled_to_component_indices(k)]
            += gram_entries[6 * b + k];
    for (unsigned int b = 0; b < n; ++b)
    {
      const auto values
          = dealii::eigenvalues(body_gram[bodies.find_set(b)]); // descending
      if (state.is_absent(b) || values[2] > 1e-8 * values[0])
        continue;
      const auto &p = mesh.vertices[mesh.block_first_vertex[b]];
      std::ostringstream message;
      message << "section 'Stages/" << stage << "': block " << b << " at ("
              << p[0] << ", " << p[1]
              << ") m and what is joined to it can move freely, so a stage "
                 "with 'End = static ratio' would not come to rest. Hold "
                 "it by a prescribed motion or a driven platen, or end the "
                 "stage by 'time'.";
      throw InputError(message.str());
    }
  }
} // namespace quoin
