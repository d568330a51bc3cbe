// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/exceptions.h>
#include <quoin/dynamics/free_bodies.h>

#include <deal.II/base/symmetric_tensor.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace quoin
{
  namespace
  {
    using Gram = dealii::SymmetricTensor<2, 3>;

    /** Below this share of the largest a motion counts as not held. */
    constexpr double not_held = 1e-8;

    /** Below this share of all forces a resultant is rounding. */
    constexpr double least_push = 1e-6;

    /** Adds the square of one held freedom's row on the rigid motions. */
    void add_row(Gram &gram, const double x, const double y, const double turn)
    {
      const double row[3] = { x, y, turn };
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = i; j < 3; ++j)
          gram[i][j] += row[i] * row[j];
    }

    /**
     * Blocks that joints and platens make one body, and what holds each body:
     * the sum of the squared rows x, y, size * rotation.
     */
    class Bodies
    {
    public:
      /** @p with_drag: whether dashpots and the like hold. Collective. */
      Bodies(const Model &model,
             const std::vector<MotionConstraint<2> *> &constraints,
             const State<2> &state, bool with_drag);

      /** The block that stands for the body of @p block. */
      unsigned int body(const unsigned int block)
      {
        return sets.find_set(block);
      }
      const Gram &gram(const unsigned int block)
      {
        return grams[body(block)];
      }
      /** From the point that rotations are about, by the model's size. */
      dealii::Tensor<1, 2> arm(const dealii::Point<2> &p) const
      {
        return (p - origin) / size;
      }
      /** The model's size [m]. */
      double length() const
      {
        return size;
      }

    private:
      std::array<bool, 3> held_by(const MotionConstraint<2> &constraint,
                                  bool with_drag) const;
      void add_nodes(const MotionConstraint<2> &constraint,
                     const std::array<bool, 3> &holds);
      /** All blocks of a platen are one body, its rows go to the first. */
      void add_platen(const MotionConstraint<2> &constraint,
                      const std::array<bool, 3> &holds);
      void add_joints(const State<2> &state);
      void add(const unsigned int block, const Gram &gram)
      {
        for (unsigned int k = 0; k < 6; ++k)
          entries[6 * block + k]
              += gram[Gram::unrolled_to_component_indices(k)];
      }

      const NodeMap<2> &nodes;
      const unsigned int n;
      const dealii::Point<2> origin;
      const double size;
      std::vector<double> entries;
      std::vector<unsigned int> rank, parent;
      boost::disjoint_sets<unsigned int *, unsigned int *> sets;
      std::vector<Gram> grams;
    };

    Bodies::Bodies(const Model &model,
                   const std::vector<MotionConstraint<2> *> &constraints,
                   const State<2> &state, const bool with_drag)
      : nodes(model.nodes()), n(nodes.table().n_blocks()),
        origin(nodes.table().box[0]), size(nodes.diagonal()),
        entries(6 * n, 0.), rank(n), parent(n),
        sets(rank.data(), parent.data()), grams(n)
    {
      for (unsigned int b = 0; b < n; ++b)
        sets.make_set(b);
      for (const MotionConstraint<2> *constraint : constraints)
      {
        const auto holds = held_by(*constraint, with_drag);
        // A platen that may turn holds its centre alone, which lies within
        // its nodes; a single row each is what it prescribes.
        if (!constraint->is_rigid_body() || holds[2])
          add_nodes(*constraint, holds);
        if (constraint->is_rigid_body())
          add_platen(*constraint, holds);
      }
      dealii::Utilities::MPI::sum(entries, nodes.communicator(), entries);
      add_joints(state);
      for (unsigned int b = 0; b < n; ++b)
        for (unsigned int k = 0; k < 6; ++k)
          grams[body(b)][Gram::unrolled_to_component_indices(k)]
              += entries[6 * b + k];
    }

    std::array<bool, 3> Bodies::held_by(const MotionConstraint<2> &constraint,
                                        const bool with_drag) const
    {
      const bool drags
          = with_drag && constraint.kind() == MotionKind::absorbing;
      if (constraint.supports() || drags)
        return { { true, true, false } };
      return constraint.holds();
    }

    void Bodies::add_nodes(const MotionConstraint<2> &constraint,
                           const std::array<bool, 3> &holds)
    {
      for (const unsigned int node : constraint.nodes())
      {
        const auto r = arm(nodes.point(node));
        Gram gram;
        if (holds[0])
          add_row(gram, 1., 0., -r[1]);
        if (holds[1])
          add_row(gram, 0., 1., r[0]);
        if (holds[2])
          add_row(gram, 0., 0., 1.);
        add(nodes.block_of_node(node), gram);
      }
    }

    void Bodies::add_platen(const MotionConstraint<2> &constraint,
                            const std::array<bool, 3> &holds)
    {
      std::set<unsigned int> blocks;
      for (const unsigned int node : constraint.nodes())
        blocks.insert(nodes.block_of_node(node));
      const unsigned int first = dealii::Utilities::MPI::min(
          blocks.empty() ? n : *blocks.begin(), nodes.communicator());
      std::vector<unsigned int> member(n, 0);
      for (const unsigned int block : blocks)
        member[block] = 1;
      dealii::Utilities::MPI::max(member, nodes.communicator(), member);
      for (unsigned int block = 0; block < n; ++block)
        if (member[block])
          sets.union_set(block, first);
      // The block may lie on several ranks: one of them gives the row.
      namespace MPI          = dealii::Utilities::MPI;
      const MPI_Comm all     = nodes.communicator();
      const unsigned int own = MPI::this_mpi_process(all);
      const bool has_first   = !blocks.empty() && *blocks.begin() == first;
      const unsigned int from
          = MPI::min(has_first ? own : MPI::n_mpi_processes(all), all);
      if (holds[2] || own != from)
        return;
      Gram gram;
      const auto r = arm(nodes.point(constraint.nodes().front()));
      if (holds[0])
        add_row(gram, 1., 0., -r[1]);
      if (holds[1])
        add_row(gram, 0., 1., r[0]);
      add(first, gram);
    }

    void Bodies::add_joints(const State<2> &state)
    {
      for (const auto &[a, b] : nodes.table().joined)
        if (!state.is_absent(a) && !state.is_absent(b))
          sets.union_set(a, b);
    }

    /** Force x, y [N] and moment over the size [N], and all forces [N]. */
    struct Push
    {
      std::array<double, 3> resultant{};
      double total = 0.;
    };

    /** Adds the force and the moment of a platen, in equal parts at its nodes,
        to @p force and, of each body, @p sums. */
    void add_platen(const MotionConstraint<2> &platen, const TimePoint &time,
                    const Model &model, Bodies &bodies,
                    std::vector<NodeVector<2>> &force,
                    std::vector<double> &sums)
    {
      const NodeExchange &exchange = model.exchange();
      const unsigned int n         = dealii::Utilities::MPI::sum(
                  unsigned(platen.nodes().size()), exchange.communicator());
      std::array<double, 3> part{};
      for (unsigned int d = 0; d < 3; ++d)
        if ((*platen.parts())[d].quantity == LoadQuantity::force)
          part[d] = (*platen.parts())[d].value(time) / n;
      for (const unsigned int i : platen.nodes())
      {
        for (unsigned int d = 0; d < 2; ++d)
          force[i].v[d] += part[d];
        double *sum = &sums[4 * bodies.body(model.nodes().block_of_node(i))];
        sum[2] += part[2] / bodies.length();
        sum[3] += std::abs(part[2]) / bodies.length();
      }
    }

    std::vector<Push>
    pushes(const Model &model, Bodies &bodies,
           const std::vector<MotionConstraint<2> *> &constraints,
           const std::vector<const NodalLoad<2> *> &loads,
           const TimePoint &time)
    {
      const NodeMap<2> &nodes      = model.nodes();
      const unsigned int n_blocks  = nodes.table().n_blocks();
      const NodeExchange &exchange = model.exchange();
      std::vector<NodeVector<2>> force(exchange.n_local(),
                                       NodeVector<2>{ { 0., 0. } });
      for (const NodalLoad<2> *load : loads)
        load->add_forces(time, force.data());
      std::vector<double> sums(4 * n_blocks, 0.);
      for (const MotionConstraint<2> *constraint : constraints)
        if (constraint->is_rigid_body())
          add_platen(*constraint, time, model, bodies, force, sums);
      for (unsigned int i = 0; i < exchange.n_owned(); ++i)
      {
        const auto r    = bodies.arm(nodes.point(i));
        const double *f = force[i].v;
        double *sum     = &sums[4 * bodies.body(nodes.block_of_node(i))];
        sum[0] += f[0];
        sum[1] += f[1];
        sum[2] += r[0] * f[1] - r[1] * f[0];
        sum[3] += std::hypot(f[0], f[1]);
      }
      dealii::Utilities::MPI::sum(sums, exchange.communicator(), sums);
      std::vector<Push> result(n_blocks);
      for (unsigned int b = 0; b < n_blocks; ++b)
        result[b] = { { { sums[4 * b], sums[4 * b + 1], sums[4 * b + 2] } },
                      sums[4 * b + 3] };
      return result;
    }

    /** Rigid motions that @p gram does not hold. */
    std::vector<dealii::Tensor<1, 3>> free_motions(const Gram &gram)
    {
      std::vector<dealii::Tensor<1, 3>> motions;
      if (gram.norm() == 0.)
      {
        for (unsigned int d = 0; d < 3; ++d)
        {
          motions.emplace_back();
          motions.back()[d] = 1.;
        }
        return motions;
      }
      const auto modes = dealii::eigenvectors(gram); // descending
      for (const auto &[value, motion] : modes)
        if (value <= not_held * modes[0].first)
          motions.push_back(motion);
      return motions;
    }

    bool pushes_along(const Push &push, const dealii::Tensor<1, 3> &motion)
    {
      double along = 0.;
      for (unsigned int d = 0; d < 3; ++d)
        along += push.resultant[d] * motion[d];
      return std::abs(along) > least_push * push.total;
    }
  } // namespace

  void
  check_no_free_bodies(const Model &model,
                       const std::vector<MotionConstraint<2> *> &constraints,
                       const std::string &stage, const State<2> &state)
  {
    Bodies bodies(model, constraints, state, false);
    for (unsigned int b = 0; b < model.table().n_blocks(); ++b)
    {
      const auto values = dealii::eigenvalues(bodies.gram(b)); // descending
      if (state.is_absent(b) || values[2] > not_held * values[0])
        continue;
      const auto p = model.nodes().point_of_block(b);
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

  std::vector<PushedBody>
  find_pushed_bodies(const Model &model,
                     const std::vector<MotionConstraint<2> *> &constraints,
                     const std::vector<const NodalLoad<2> *> &loads,
                     const std::vector<TimePoint> &times, const State<2> &state)
  {
    Bodies bodies(model, constraints, state, true);
    std::vector<unsigned int> n_blocks(model.table().n_blocks(), 0);
    std::vector<PushedBody> found;
    std::vector<std::vector<dealii::Tensor<1, 3>>> motions;
    for (unsigned int b = 0; b < n_blocks.size(); ++b)
    {
      if (state.is_absent(b) || n_blocks[bodies.body(b)]++ > 0)
        continue;
      const auto motions_of_body = free_motions(bodies.gram(b));
      if (motions_of_body.empty())
        continue;
      const auto [low, high] = model.nodes().box_of_block(b);
      found.push_back(
          { b, 0, low + 0.5 * (high - low), motions_of_body.size() == 3 });
      motions.push_back(motions_of_body);
    }
    std::vector<bool> is_pushed(found.size(), false);
    for (unsigned int t = 0; t < times.size() && !found.empty(); ++t)
    {
      const auto push = pushes(model, bodies, constraints, loads, times[t]);
      for (unsigned int i = 0; i < found.size(); ++i)
        for (const auto &motion : motions[i])
          if (pushes_along(push[bodies.body(found[i].block)], motion))
            is_pushed[i] = true;
    }
    std::vector<PushedBody> result;
    for (unsigned int i = 0; i < found.size(); ++i)
      if (is_pushed[i])
      {
        found[i].n_blocks = n_blocks[bodies.body(found[i].block)];
        result.push_back(found[i]);
      }
    return result;
  }

  std::string pushed_body_text(const std::vector<PushedBody> &bodies)
  {
    const PushedBody &first = bodies.front();
    std::string text = text_of("block ", first.block, ", at (", first.centre[0],
                               ", ", first.centre[1], ") m");
    if (first.n_blocks > 1)
      text += ", and the " + count_text(first.n_blocks - 1, "block")
              + " joined to it,";
    text += first.is_loose ? " is held by nothing"
                           : " is not held where its loads push it";
    text += ": it will move away as a rigid body.";
    if (bodies.size() > 1)
      text += " So will " + std::to_string(bodies.size() - 1) + " more.";
    return text
           + " Join it to its neighbours ('Joints along' in section 'Mesh'), "
             "hold it by a load, or, if it lies on other blocks, take "
             "'Displacements = large' in section 'Contact'.";
  }
} // namespace quoin
