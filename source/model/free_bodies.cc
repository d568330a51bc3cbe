// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/point_text.h>
#include <quoin/base/exceptions.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/model/free_bodies.h>

#include <quoin/base/eigen_core.h>

#include <Eigen/Eigenvalues>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace quoin
{
  namespace
  {
    /** Rigid body modes: translations, and rotations times the size. */
    template <int dim>
    constexpr int n_motions = dim == 2 ? 3 : 6;
    template <int dim>
    using Motion = Eigen::Matrix<double, n_motions<dim>, 1>;
    template <int dim>
    using Gram = Eigen::Matrix<double, n_motions<dim>, n_motions<dim>>;

    /** Eigenvalue by the largest one below which a mode counts as free. */
    constexpr double not_held = 1e-8;

    /** Resultant by the sum of all forces below which it is rounding. */
    constexpr double least_push = 1e-6;

    /** Component @p d of the displacement by each rigid body mode, at the arm
        @p r divided by the size. */
    template <int dim>
    Motion<dim> row(const unsigned int d, const dealii::Tensor<1, dim> &r)
    {
      Motion<dim> result = Motion<dim>::Zero();
      result[d]          = 1.;
      if constexpr (dim == 2)
        result[2] = d == 0 ? -r[1] : r[0];
      else
      {
        // (omega x r) e_d = omega (r x e_d)
        const unsigned int e = (d + 1) % 3, f = (d + 2) % 3;
        result[3 + e] = r[f];
        result[3 + f] = -r[e];
      }
      return result;
    }

    /** Contribution of a restrained component to a Gram matrix. */
    template <int dim>
    Gram<dim> square(const Motion<dim> &row)
    {
      return row * row.transpose();
    }

    /**
     * Blocks that joints and platens make one body, and the Gram matrix of the
     * restrained components of each body.
     */
    template <int dim>
    class Bodies
    {
    public:
      /** @p with_drag: whether dashpots count as restraints. Collective. */
      Bodies(const Model<dim> &model,
             const std::vector<MotionConstraint<dim> *> &constraints,
             const State<dim> &state, bool with_drag);

      /** The block that represents the body of @p block. */
      unsigned int body(const unsigned int block)
      {
        return sets.find_set(block);
      }
      const Gram<dim> &gram(const unsigned int block)
      {
        return grams[body(block)];
      }
      /** Arm from the centre of rotation, divided by the model's size. */
      dealii::Tensor<1, dim> arm(const dealii::Point<dim> &p) const
      {
        return (p - origin) / size;
      }
      /** The model's size [m]. */
      double length() const
      {
        return size;
      }

    private:
      std::array<bool, 3> held_by(const MotionConstraint<dim> &constraint,
                                  bool with_drag) const;
      void add_nodes(const MotionConstraint<dim> &constraint,
                     const std::array<bool, 3> &holds);
      /** All blocks of a platen are one body; its rows go to the first. */
      void add_platen(const MotionConstraint<dim> &constraint,
                      const std::array<bool, 3> &holds);
      void add_joints(const State<dim> &state);
      void add(const unsigned int block, const Motion<dim> &row)
      {
        Eigen::Map<Gram<dim>>(&entries[n_entries * block]) += square<dim>(row);
      }

      static constexpr unsigned int n_entries = n_motions<dim> * n_motions<dim>;

      const NodeMap<dim> &nodes;
      const unsigned int n;
      const dealii::Point<dim> origin;
      const double size;
      std::vector<double> entries;
      std::vector<unsigned int> rank, parent;
      boost::disjoint_sets<unsigned int *, unsigned int *> sets;
      std::vector<Gram<dim>> grams;
    };

    template <int dim>
    Bodies<dim>::Bodies(const Model<dim> &model,
                        const std::vector<MotionConstraint<dim> *> &constraints,
                        const State<dim> &state, const bool with_drag)
      : nodes(model.nodes()), n(nodes.table().n_blocks()),
        origin(nodes.table().box[0]), size(nodes.table().diagonal()),
        entries(n_entries * n, 0.), rank(n), parent(n),
        sets(rank.data(), parent.data()), grams(n, Gram<dim>::Zero())
    {
      for (unsigned int b = 0; b < n; ++b)
        sets.make_set(b);
      for (const MotionConstraint<dim> *constraint : constraints)
      {
        const auto holds = held_by(*constraint, with_drag);
        // A platen free to rotate restrains its centre alone, which lies within
        // its nodes, with one row for each prescribed component.
        if (!constraint->traits().is_rigid_body() || (dim == 2 && holds[2]))
          add_nodes(*constraint, holds);
        if (constraint->traits().is_rigid_body())
          add_platen(*constraint, holds);
      }
      dealii::Utilities::MPI::sum(entries, nodes.communicator(), entries);
      add_joints(state);
      for (unsigned int b = 0; b < n; ++b)
        grams[body(b)] += Eigen::Map<Gram<dim>>(&entries[n_entries * b]);
    }

    template <int dim>
    std::array<bool, 3>
    Bodies<dim>::held_by(const MotionConstraint<dim> &constraint,
                         const bool with_drag) const
    {
      const bool drags
          = with_drag && constraint.traits().kind == MotionKind::absorbing;
      if (constraint.traits().supports || drags)
        return { { true, true, dim == 3 } };
      return constraint.traits().holds;
    }

    template <int dim>
    void Bodies<dim>::add_nodes(const MotionConstraint<dim> &constraint,
                                const std::array<bool, 3> &holds)
    {
      for (const unsigned int node : constraint.nodes())
      {
        const unsigned int block = nodes.block_of_node(node);
        for (unsigned int d = 0; d < dim; ++d)
          if (holds[d])
            add(block, row<dim>(d, arm(nodes.point(node))));
        if (dim == 2 && holds[2])
          add(block, Motion<dim>::Unit(2)); // the rotation of a platen
      }
    }

    template <int dim>
    void Bodies<dim>::add_platen(const MotionConstraint<dim> &constraint,
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
      // The block may lie on several ranks: one of them adds the row.
      namespace MPI          = dealii::Utilities::MPI;
      const MPI_Comm all     = nodes.communicator();
      const unsigned int own = MPI::this_mpi_process(all);
      const bool has_first   = !blocks.empty() && *blocks.begin() == first;
      const unsigned int from
          = MPI::min(has_first ? own : MPI::n_mpi_processes(all), all);
      if ((dim == 2 && holds[2]) || own != from)
        return;
      for (unsigned int d = 0; d < dim; ++d)
        if (holds[d])
          add(first, row<dim>(d, arm(nodes.point(constraint.nodes().front()))));
      if constexpr (dim == 3)
        for (unsigned int d = 0; d < dim; ++d)
        {
          const LoadQuantity quantity
              = (*constraint.rigid_motion()->rotations())[d].quantity;
          if (quantity == LoadQuantity::velocity
              || quantity == LoadQuantity::displacement)
            add(first, Motion<dim>::Unit(dim + d));
        }
    }

    template <int dim>
    void Bodies<dim>::add_joints(const State<dim> &state)
    {
      for (const auto &[a, b] : nodes.table().joined)
        if (!state.is_absent(a) && !state.is_absent(b))
          sets.union_set(a, b);
    }

    /** Forces along the rigid body modes [N]: sums of the components, moments
        by the size; and the sum of their absolute values. */
    template <int dim>
    struct Push
    {
      Motion<dim> resultant = Motion<dim>::Zero();
      double total          = 0.;
    };

    /** Adds the force and the moment of a platen, in equal parts at its nodes,
        to @p force and, of each body, @p sums. */
    template <int dim>
    void add_platen(const MotionConstraint<dim> &platen, const TimePoint &time,
                    const Model<dim> &model, Bodies<dim> &bodies,
                    std::vector<dealii::Tensor<1, dim>> &force,
                    std::vector<double> &sums)
    {
      constexpr unsigned int n_all = n_motions<dim>;
      const NodeExchange &exchange = model.nodes().exchange();
      const unsigned int n         = dealii::Utilities::MPI::sum(
                  unsigned(platen.nodes().size()), exchange.communicator());
      std::array<double, n_all> part{};
      unsigned int i = 0;
      for (const auto *parts :
           { platen.parts(), platen.rigid_motion()->rotations() })
        for (unsigned int d = 0; parts && d < 3; ++d, ++i)
          if ((*parts)[d].quantity == LoadQuantity::force)
            part[i] = (*parts)[d].value(time) / n;
      for (const unsigned int node : platen.nodes())
      {
        double *sum = &sums[(n_all + 1)
                            * bodies.body(model.nodes().block_of_node(node))];
        for (unsigned int d = 0; d < dim; ++d)
          force[node][d] += part[d];
        for (unsigned int d = dim; d < n_all; ++d)
        {
          sum[d] += part[d] / bodies.length();
          sum[n_all] += std::abs(part[d]) / bodies.length();
        }
      }
    }

    template <int dim>
    std::vector<Push<dim>>
    pushes(const Model<dim> &model, Bodies<dim> &bodies,
           const std::vector<MotionConstraint<dim> *> &constraints,
           const std::vector<const NodalLoad<dim> *> &loads,
           const TimePoint &time)
    {
      const NodeMap<dim> &nodes    = model.nodes();
      const unsigned int n_blocks  = nodes.table().n_blocks();
      const NodeExchange &exchange = model.nodes().exchange();
      std::vector<dealii::Tensor<1, dim>> force(exchange.n_local(),
                                                dealii::Tensor<1, dim>());
      for (const NodalLoad<dim> *load : loads)
        load->add_loads(time, force.data());
      constexpr unsigned int n = n_motions<dim> + 1;
      std::vector<double> sums(n * n_blocks, 0.);
      for (const MotionConstraint<dim> *constraint : constraints)
        if (constraint->traits().is_rigid_body())
          add_platen(*constraint, time, model, bodies, force, sums);
      for (unsigned int i = 0; i < exchange.n_owned(); ++i)
      {
        if (force[i] == dealii::Tensor<1, dim>())
          continue; // most nodes
        double *sum   = &sums[n * bodies.body(nodes.block_of_node(i))];
        double square = 0.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double f = force[i][d];
          Eigen::Map<Motion<dim>>(sum)
              += f * row<dim>(d, bodies.arm(nodes.point(i)));
          square += f * f;
        }
        sum[n - 1] += std::sqrt(square);
      }
      dealii::Utilities::MPI::sum(sums, exchange.communicator(), sums);
      std::vector<Push<dim>> result(n_blocks);
      for (unsigned int b = 0; b < n_blocks; ++b)
        result[b]
            = { Eigen::Map<Motion<dim>>(&sums[n * b]), sums[n * b + n - 1] };
      return result;
    }

    /** Rigid body modes that @p gram does not restrain. */
    template <int dim>
    std::vector<Motion<dim>> free_motions(const Gram<dim> &gram)
    {
      const Eigen::SelfAdjointEigenSolver<Gram<dim>> modes(gram);
      std::vector<Motion<dim>> motions;
      for (unsigned int i = 0; i < n_motions<dim>; ++i) // ascending
        if (modes.eigenvalues()[i] <= not_held * modes.eigenvalues().maxCoeff())
          motions.push_back(modes.eigenvectors().col(i));
      return motions;
    }

    template <int dim>
    bool pushes_along(const Push<dim> &push, const Motion<dim> &motion)
    {
      return std::abs(push.resultant.dot(motion)) > least_push * push.total;
    }
  } // namespace

  namespace
  {
    /** " It is 0.001 m away from block 3 ..." of the nearest block that is not
        of the body of @p block, if it is near; or nothing. Collective. */
    std::string gap_text(const Model<2> &model, Bodies<2> &bodies,
                         const unsigned int block)
    {
      /** The widest gap of which it is said, by the size of the block. */
      constexpr double widest = 0.02;
      const NodeMap<2> &nodes = model.nodes();
      const auto faces        = gather_faces(
                 nodes, std::vector<bool>(nodes.table().face_names.size(), true));
      const auto box               = box_of_block(nodes, block);
      double gap                   = widest * box[0].distance(box[1]);
      const BoundaryFace<2> *found = nullptr;
      for (const BoundaryFace<2> &own : faces)
        for (unsigned int o = 0; own.block == block && o < faces.size(); ++o)
        {
          const BoundaryFace<2> &other = faces[o];
          if (bodies.body(other.block) == bodies.body(block))
            continue;
          for (unsigned int k = 0; k < 2; ++k)
          {
            const double distance
                = std::min(distance_to_segment(own.points[k], other.points[0],
                                               other.points[1]),
                           distance_to_segment(other.points[k], own.points[0],
                                               own.points[1]));
            if (distance < gap)
            {
              gap   = distance;
              found = &other;
            }
          }
        }
      if (!found)
        return "";
      return text_of(" The nearest block, ", found->block, " near ",
                     point_text(found->points[0]), " m, ",
                     gap > 0. ? text_of("is only ", gap, " m away")
                              : std::string("touches it without a joint"),
                     ": if they are to bear on each other, let their meshes "
                     "have the same nodes there.");
    }
    std::string gap_text(const Model<3> &, Bodies<3> &, const unsigned int)
    {
      return "";
    }
  } // namespace

  template <int dim>
  void
  check_no_free_bodies(const Model<dim> &model,
                       const std::vector<MotionConstraint<dim> *> &constraints,
                       const std::string &stage, const State<dim> &state)
  {
    Bodies<dim> bodies(model, constraints, state, false);
    for (unsigned int b = 0; b < model.nodes().table().n_blocks(); ++b)
    {
      if (state.is_absent(b) || free_motions<dim>(bodies.gram(b)).empty())
        continue;
      throw InputError(text_of(
          "section 'Stages/", stage, "': block ", b, " at ",
          point_text(point_of_block(model.nodes(), b)),
          " m and what is joined to it can move freely, so neither the "
          "implicit solver nor a stage with 'End = static ratio' would reach "
          "equilibrium. Hold it by a prescribed motion or a driven platen, or "
          "let the explicit solver end the stage by 'time'.",
          gap_text(model, bodies, b)));
    }
  }

  template <int dim>
  std::vector<UnsupportedBody<dim>> find_unsupported_bodies(
      const Model<dim> &model,
      const std::vector<MotionConstraint<dim> *> &constraints,
      const std::vector<const NodalLoad<dim> *> &loads,
      const std::vector<TimePoint> &times, const State<dim> &state)
  {
    Bodies<dim> bodies(model, constraints, state, true);
    std::vector<unsigned int> n_blocks(model.nodes().table().n_blocks(), 0);
    std::vector<UnsupportedBody<dim>> found;
    std::vector<std::vector<Motion<dim>>> motions;
    for (unsigned int b = 0; b < n_blocks.size(); ++b)
    {
      if (state.is_absent(b) || n_blocks[bodies.body(b)]++ > 0)
        continue;
      const auto motions_of_body = free_motions<dim>(bodies.gram(b));
      if (motions_of_body.empty())
        continue;
      found.push_back({ b, 0, {}, motions_of_body.size() == n_motions<dim> });
      motions.push_back(motions_of_body);
    }
    std::vector<bool> is_pushed(found.size(), false);
    for (unsigned int t = 0; t < times.size() && !found.empty(); ++t)
    {
      const auto push = pushes(model, bodies, constraints, loads, times[t]);
      for (unsigned int i = 0; i < found.size(); ++i)
        for (const auto &motion : motions[i])
          if (pushes_along<dim>(push[bodies.body(found[i].block)], motion))
            is_pushed[i] = true;
    }
    std::vector<UnsupportedBody<dim>> result;
    for (unsigned int i = 0; i < found.size(); ++i)
      if (is_pushed[i])
      {
        found[i].n_blocks = n_blocks[bodies.body(found[i].block)];
        result.push_back(found[i]);
      }
    // Of all, there may be thousands, it would take long.
    if (!result.empty())
    {
      const auto [low, high]
          = box_of_block(model.nodes(), result.front().block);
      result.front().centre = low + 0.5 * (high - low);
    }
    return result;
  }

  template <int dim>
  std::string
  unsupported_body_text(const std::vector<UnsupportedBody<dim>> &bodies)
  {
    const UnsupportedBody<dim> &first = bodies.front();
    std::string text                  = text_of("block ", first.block, ", at ",
                                                point_text(first.centre), " m");
    if (first.n_blocks > 1)
      text += ", and the " + count_text(first.n_blocks - 1, "block")
              + " joined to it,";
    text += first.is_loose ? " is held by nothing"
                           : " is not held where its loads push it";
    text += ": it will move away as a rigid body.";
    if (bodies.size() > 1)
      text += " So will " + std::to_string(bodies.size() - 1) + " more.";
    if constexpr (dim == 3)
      return text + " Hold it by a load.";
    return text
           + " Join it to its neighbours ('Joints along' in section 'Mesh'), "
             "hold it by a load, or, if it lies on other blocks, take "
             "'Displacements = large' in section 'Contact'.";
  }

  template void check_no_free_bodies(const Model<2> &,
                                     const std::vector<MotionConstraint<2> *> &,
                                     const std::string &, const State<2> &);
  template std::vector<UnsupportedBody<2>>
  find_unsupported_bodies(const Model<2> &,
                          const std::vector<MotionConstraint<2> *> &,
                          const std::vector<const NodalLoad<2> *> &,
                          const std::vector<TimePoint> &, const State<2> &);
  template std::string
  unsupported_body_text(const std::vector<UnsupportedBody<2>> &);
  template void check_no_free_bodies(const Model<3> &,
                                     const std::vector<MotionConstraint<3> *> &,
                                     const std::string &, const State<3> &);
  template std::vector<UnsupportedBody<3>>
  find_unsupported_bodies(const Model<3> &,
                          const std::vector<MotionConstraint<3> *> &,
                          const std::vector<const NodalLoad<3> *> &,
                          const std::vector<TimePoint> &, const State<3> &);
  template std::string
  unsupported_body_text(const std::vector<UnsupportedBody<3>> &);
} // namespace quoin
