// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/joint_elements/joint_tangent.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/dynamics/highest_frequency.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace quoin
{
  namespace
  {
    constexpr unsigned int n_iterations = 80;
    /** The result is rounded up to as many binary digits, so that it is the
        same on any number of ranks. */
    constexpr int n_digits = 20;

    /** A number of the normal distribution that follows from @p seed. */
    double random_number(std::uint64_t seed)
    {
      const auto uniform = [&seed]() // splitmix64, in (0, 1]
      {
        seed += 0x9e3779b97f4a7c15U;
        std::uint64_t z = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
        z               = (z ^ (z >> 27)) * 0x94d049bb133111ebU;
        return double((z >> 11) + 1) / 9007199254740992.;
      };
      const double radius = std::sqrt(-2. * std::log(uniform()));
      return radius * std::cos(6.283185307179586 * uniform());
    }

    /** So many degrees of freedom of two vectors fit the first cache. */
    constexpr Eigen::Index piece = 1024;

    /** Calls @p use (first entry, number of entries) for the pieces of vectors
        of @p n entries: what it does one after the other takes them from memory
        once. */
    template <typename Use>
    void for_each_piece(const Eigen::Index n, const Use &use)
    {
      for (Eigen::Index begin = 0; begin < n; begin += piece)
        use(begin, std::min(piece, n - begin));
    }

    /** The stiffness between unit masses: M^-1/2 K M^-1/2 of the degrees of
        freedom of this rank, dim of each deformable node and three of each
        rigid block. */
    template <int dim>
    class ScaledStiffness
    {
    public:
      ScaledStiffness(const Model<dim> &model, const std::vector<double> &mass,
                      const RigidBlockStage &rigid_stage)
        : model(model), nodes(model.nodes()), state(model.initial_state()),
          velocity(nodes.n_local(), dealii::Tensor<1, dim>()),
          force(nodes.n_local(), dealii::Tensor<1, dim>())
      {
        const RigidBlocks &rigid = model.rigid_blocks();
        scale.resize(n_nodal() + 3 * rigid.n_blocks());
        double *next = scale.data();
        for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
          for (unsigned int d = 0; d < dim; ++d)
            *next++ = 1. / std::sqrt(mass[i]);
        for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
        {
          const double factor = rigid_stage.mass_factor[b];
          const auto &block   = rigid.block(b);
          for (const double inertia : { block.mass, block.mass, block.inertia })
            *next++ = 1. / std::sqrt(factor * inertia);
        }
        if constexpr (dim == 2)
          if (model.contacts())
          {
            contacts.assign(nodes.n_local(), NodeStiffness<dim>{});
            model.contacts()->add_stiffness_bound(state, {}, contacts);
            nodes.exchange().add_to_owners(contacts.data());
          }
      }

      Eigen::Index size() const
      {
        return scale.size();
      }

      /** The same numbers for the same bodies on any number of ranks. */
      Eigen::VectorXd random_vector() const
      {
        Eigen::VectorXd result(size());
        unsigned int k = 0;
        for (unsigned int i = 0; i < nodes.n_deformable_nodes(); ++i)
        {
          std::uint64_t seed = nodes.block_of_node(i);
          for (unsigned int d = 0; d < dim; ++d)
          {
            std::uint64_t bits;
            std::memcpy(&bits, &state.nodes[i].X[d], sizeof(bits));
            seed = 0x9e3779b97f4a7c15U * (seed ^ bits ^ (bits >> 31));
          }
          for (unsigned int d = 0; d < dim; ++d)
            result[k++] = random_number(seed + d);
        }
        const RigidBlocks &rigid = model.rigid_blocks();
        for (unsigned int b = 0; b < rigid.n_blocks(); ++b)
          for (unsigned int d = 0; d < 3; ++d)
            result[k++] = random_number(
                4 * nodes.block_of_node(rigid.block(b).begin) + d);
        return result;
      }

      /**
       * Sets @p y to this times @p x less @p factor times @p y, and returns the
       * product of @p x and @p y on this rank. Collective.
       */
      double multiply(const Eigen::VectorXd &x, const double factor,
                      Eigen::VectorXd &y)
      {
        set_velocities(x);
        nodes.exchange().update_ghosts(velocity.data());
        std::fill(force.begin(), force.end(), dealii::Tensor<1, dim>());
        // The forces of stiffness-proportional damping with unit coefficient.
        for (unsigned int tile = 0; tile < model.blocks().n_tiles(); ++tile)
          model.blocks().add_viscous_forces(tile, state.nodes.data(),
                                            velocity.data(), 1., force.data());
        if (contacts.empty())
          add_elastic_forces(model.joints(), state.nodes.data(),
                             velocity.data(), force.data());
        nodes.exchange().add_to_owners(force.data());
        if constexpr (dim == 2)
          for (unsigned int i = 0; i < nodes.n_owned() && !contacts.empty();
               ++i)
          {
            const auto [xx, yy, xy] = contacts[i];
            const double vx = velocity[i][0], vy = velocity[i][1];
            force[i][0] -= xx * vx + xy * vy;
            force[i][1] -= xy * vx + yy * vy;
          }
        take_rigid_forces(factor, y);
        double product = 0.;
        for_each_piece(n_nodal(),
                       [&](const Eigen::Index begin, const Eigen::Index n)
                       {
                         auto part = y.segment(begin, n);
                         part      = -scale.segment(begin, n).cwiseProduct(
                                         flat(force).segment(begin, n))
                                - factor * part;
                         product += x.segment(begin, n).dot(part);
                       });
        const Eigen::Index n_rigid = size() - n_nodal();
        return product + x.tail(n_rigid).dot(y.tail(n_rigid));
      }

    private:
      void set_velocities(const Eigen::VectorXd &x)
      {
        flat(velocity) = scale.head(n_nodal()).cwiseProduct(x.head(n_nodal()));
        if constexpr (dim == 2)
          for_each_rigid_node(
              [&](const unsigned int k, const unsigned int i,
                  const dealii::Tensor<1, 2> &arm)
              {
                const double spin = scale[k + 2] * x[k + 2];
                velocity[i][0]    = scale[k] * x[k] - spin * arm[1];
                velocity[i][1]    = scale[k + 1] * x[k + 1] + spin * arm[0];
              });
      }

      /** The part of rigid blocks in multiply(). */
      void take_rigid_forces(const double factor, Eigen::VectorXd &y) const
      {
        y.tail(size() - n_nodal()) *= -factor;
        if constexpr (dim == 2)
          for_each_rigid_node(
              [&](const unsigned int k, const unsigned int i,
                  const dealii::Tensor<1, 2> &arm)
              {
                y[k] -= scale[k] * force[i][0];
                y[k + 1] -= scale[k + 1] * force[i][1];
                y[k + 2] -= scale[k + 2] * cross(arm, force[i]);
              });
      }

      /** Number of degrees of freedom of deformable nodes. */
      Eigen::Index n_nodal() const
      {
        return Eigen::Index(dim) * nodes.n_deformable_nodes();
      }

      /** The components of @p vectors at deformable nodes, one after the
          other. */
      Eigen::Map<Eigen::VectorXd>
      flat(AlignedArray<dealii::Tensor<1, dim>> &vectors) const
      {
        return { reinterpret_cast<double *>(vectors.data()), n_nodal() };
      }

      /** Calls @p use (first degree of freedom, node, its arm) for the nodes of
          rigid blocks. */
      template <typename Use>
      void for_each_rigid_node(const Use &use) const
      {
        const RigidBlocks &rigid = model.rigid_blocks();
        const auto &states       = state.template get<RigidBlockStates>();
        unsigned int k           = dim * nodes.n_deformable_nodes();
        for (unsigned int b = 0; b < rigid.n_blocks(); ++b, k += 3)
        {
          const RigidBlocks::Block &block = rigid.block(b);
          for (unsigned int i = block.begin; i < block.end; ++i)
            use(k, i,
                state.nodes[i].position()
                    - (block.centre + states[b].displacement));
        }
      }

      const Model<dim> &model;
      const NodeMap<dim> &nodes;
      const State<dim> state;
      Eigen::VectorXd scale;                    /**< 1 / sqrt(mass) */
      std::vector<NodeStiffness<dim>> contacts; /**< contacts; may be empty */
      AlignedArray<dealii::Tensor<1, dim>> velocity, force;
    };
  } // namespace

  template <int dim>
  double highest_squared_frequency(const Model<dim> &model,
                                   const std::vector<double> &mass,
                                   const RigidBlockStage &rigid_stage,
                                   std::vector<KnownFrequency> &known)
  {
    using dealii::Utilities::MPI::sum;
    const MPI_Comm communicator = model.nodes().communicator();
    ScaledStiffness<dim> stiffness(model, mass, rigid_stage);
    const double n    = sum(double(stiffness.size()), communicator);
    Eigen::VectorXd v = stiffness.random_vector();
    Eigen::VectorXd w = Eigen::VectorXd::Zero(v.size()); // and the last v
    v /= std::sqrt(sum(v.squaredNorm(), communicator));
    std::vector<double> diagonal, beside;
    double beta = 0.;
    while (diagonal.size() < n_iterations)
    {
      const double alpha = sum(stiffness.multiply(v, beta, w), communicator);
      double squares     = 0.;
      for_each_piece(v.size(),
                     [&](const Eigen::Index begin, const Eigen::Index n)
                     {
                       auto part = w.segment(begin, n);
                       part -= alpha * v.segment(begin, n);
                       squares += part.squaredNorm();
                     });
      beta = std::sqrt(sum(squares, communicator));
      diagonal.push_back(alpha);
      // The start is in few eigenvectors, of which all are found.
      if (diagonal.size() >= n || beta <= 1e-8 * std::abs(diagonal[0]))
        break;
      if (beside.empty() && !known.empty())
      {
        unsigned int k = 0;
        while (k < known.size()
               && (known[k].diagonal != alpha || known[k].beside != beta))
          ++k;
        // All ranks go on or none, even if their sums differed by rounding.
        if (const unsigned int found
            = dealii::Utilities::MPI::max(k, communicator);
            found < known.size())
          return known[found].squared;
      }
      beside.push_back(beta);
      v.swap(w);
      v /= beta;
    }
    const unsigned int k = diagonal.size();
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
    solver.computeFromTridiagonal(
        Eigen::Map<const Eigen::VectorXd>(diagonal.data(), k),
        Eigen::Map<const Eigen::VectorXd>(beside.data(), k - 1),
        Eigen::EigenvaluesOnly);
    double error = 0.; // relative
    if (k == n_iterations)
    {
      const double share = std::log(n * std::pow(k - 1., 4.)) / (k - 1.);
      error              = 0.103 * share * share;
    }
    int exponent = 0;
    const double fraction
        = std::frexp(solver.eigenvalues().maxCoeff() / (1. - error), &exponent);
    const double squared = std::ldexp(std::ceil(std::ldexp(fraction, n_digits)),
                                      exponent - n_digits);
    if (!beside.empty())
      known.push_back({ diagonal[0], beside[0], squared });
    return squared;
  }

  template double highest_squared_frequency(const Model<2> &,
                                            const std::vector<double> &,
                                            const RigidBlockStage &,
                                            std::vector<KnownFrequency> &);
  template double highest_squared_frequency(const Model<3> &,
                                            const std::vector<double> &,
                                            const RigidBlockStage &,
                                            std::vector<KnownFrequency> &);
} // namespace quoin
