// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/lane_functions.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/blocks/rigid_blocks.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>

namespace quoin
{
  template <int dim>
  std::vector<bool>
  find_rigid_blocks(const BlockMesh<dim> &mesh,
                    const std::vector<MaterialParameters> &materials)
  {
    std::vector<bool> rigid_group;
    for (const std::string &name : mesh.group_names)
      rigid_group.push_back(
          std::any_of(materials.begin(), materials.end(),
                      [&](const MaterialParameters &material)
                      {
                        return material.rigid
                               && std::find(material.groups.begin(),
                                            material.groups.end(), name)
                                      != material.groups.end();
                      }));

    std::vector<bool> rigid;
    for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
    {
      const unsigned int first = mesh.block_first_cell[b];
      rigid.push_back(rigid_group[mesh.cell_group[first]]);
      for (unsigned int c = first; c < mesh.block_first_cell[b + 1]; ++c)
      {
        if (rigid_group[mesh.cell_group[c]] == rigid.back())
          continue;
        const auto &p    = mesh.vertices[mesh.cells[first][0]];
        const auto group = [&](const unsigned int cell)
        { return mesh.group_names[mesh.cell_group[cell]]; };
        std::ostringstream message;
        message << "section 'Materials': the block at " << point_text<dim>(p)
                << " m is made of the physical "
                << (dim == 2 ? "surfaces '" : "volumes '") << group(first)
                << "' and '" << group(c) << "', of which only '"
                << (rigid.back() ? group(first) : group(c))
                << "' is of a material with 'Law = rigid'. A block is rigid as "
                   "a whole: make both rigid or neither, or part them by "
                   "naming the line between them in 'Mesh/Joints along'.";
        throw InputError(message.str());
      }
    }
    return rigid;
  }

  template std::vector<bool>
  find_rigid_blocks(const BlockMesh<2> &,
                    const std::vector<MaterialParameters> &);
  template std::vector<bool>
  find_rigid_blocks(const BlockMesh<3> &,
                    const std::vector<MaterialParameters> &);

  void RigidBlocks::prepare(const NodeMap<2> &nodes,
                            const std::vector<double> &density,
                            const Thickness &thickness)
  {
    const LocalCells<2> &cells = nodes.cells();
    const LocalBlocks &local   = nodes.blocks();

    node_begin = nodes.n_deformable_nodes();
    blocks.clear();
    arms.clear();
    for (unsigned int b = local.n_deformable; b < local.parts.size(); ++b)
    {
      const auto [first_cell, last_cell] = local.parts[b].cells;
      const auto [first_node, last_node] = local.parts[b].nodes;
      const unsigned int n_nodes         = last_node - first_node;

      // Positions are taken from a node, to keep digits far from the origin.
      const auto origin = nodes.point(first_node);
      std::vector<double> cell_mass, node_mass(n_nodes, 0.);
      dealii::Point<2> centre;
      double mass = 0.;
      for (unsigned int c = first_cell; c < last_cell; ++c)
      {
        const auto &[i, j, k] = cells.nodes[c];
        const auto e1         = nodes.point(j) - nodes.point(i);
        const auto e2         = nodes.point(k) - nodes.point(i);
        cell_mass.push_back(0.5 * std::abs(cross(e1, e2))
                            * thickness[cells.group[c]]
                            * density[cells.group[c]]);
        mass += cell_mass.back();
        for (const unsigned int node : cells.nodes[c])
          centre += cell_mass.back() / 3. * (nodes.point(node) - origin);
        for (const unsigned int node : cells.mass_nodes(c))
          node_mass[node - first_node] += cell_mass.back() / 3.;
      }
      centre /= mass;

      double inertia = 0.;
      for (unsigned int c = first_cell; c < last_cell; ++c)
      {
        double own = 0.;
        dealii::Tensor<1, 2> mean;
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto &p = nodes.point(cells.nodes[c][k]);
          own += p.distance_square(nodes.point(cells.nodes[c][(k + 1) % 3]));
          mean += (p - origin - centre) / 3.;
        }
        inertia += cell_mass[c - first_cell] * (own / 36. + mean.norm_square());
      }

      const unsigned int begin = node_begin + arms.size();
      double lumped            = 0.;
      for (unsigned int v = 0; v < n_nodes; ++v)
      {
        const auto arm = nodes.point(first_node + v) - origin - centre;
        arms.push_back({ arm[0], arm[1], node_mass[v] / mass });
        lumped += node_mass[v] * arm.norm_square();
      }
      blocks.push_back(
          { begin, begin + n_nodes, mass, inertia, lumped, origin + centre });
    }
  }

  double RigidBlocks::largest_eigenvalue(
      const unsigned int b,
      const std::vector<std::array<double, 3>> &bound) const
  {
    const Block &block = blocks[b];
    const Arm *arm     = arms_of(block);
    dealii::SymmetricTensor<2, 3> sum;
    for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
    {
      const auto &[xx, yy, xy] = bound[i];
      const double x = arm->x, y = arm->y;
      sum[0][0] += xx;
      sum[1][1] += yy;
      sum[0][1] += xy;
      sum[0][2] += xy * x - xx * y;
      sum[1][2] += yy * x - xy * y;
      sum[2][2] += yy * x * x - 2. * xy * x * y + xx * y * y;
    }
    const double metric[3] = { block.mass, block.mass, block.inertia };
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        sum[i][j] /= std::sqrt(metric[i] * metric[j]);
    return std::max(0., dealii::eigenvalues(sum)[0]);
  }

  inline RigidBlocks::Direction::Direction(const double angle)
    : c(std::cos(angle)), s(std::sin(angle))
  {
  }

  namespace
  {
    /** x and y of a node at once, which compilers do not find by themselves. */
    const Two &two(const double &first)
    {
      return *reinterpret_cast<const Two *>(&first);
    }
    Two &two(double &first)
    {
      return *reinterpret_cast<Two *>(&first);
    }
    Two swap(const Two &a)
    {
      return __builtin_shufflevector(a, a, 1, 0);
    }
  } // namespace

  inline DEAL_II_ALWAYS_INLINE void
  RigidBlocks::place_nodes(const Block &block, const RigidBlockState &rigid,
                           const Direction &before, const Direction &after,
                           State<2> &state) const
  {
    // 1 - cos without cancellation.
    const double versine
        = after.c > 0. ? after.s * after.s / (1. + after.c) : 1. - after.c;
    // Velocities follow from the mean of the arms before and after.
    const double half = 0.5 * rigid.velocity[2];
    const double c    = half * (before.c + after.c);
    const double s    = half * (before.s + after.s);
    const Two way     = two(rigid.displacement[0]);
    const Two speed   = two(rigid.velocity[0]);
    const Two sine = { -after.s, after.s }, cosine = { -c, c };
    const Arm *arm = arms_of(block);
    for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
    {
      const Two r = two(arm->x), across = swap(r);
      two(state.nodes[i].u[0])  = way - versine * r + sine * across;
      two(state.velocity[i][0]) = speed - s * r + cosine * across;
    }
  }

  inline DEAL_II_ALWAYS_INLINE std::array<double, 3>
  RigidBlocks::resultant(const Block &block, const Direction &now,
                         const dealii::Tensor<1, 2> *force) const
  {
    Two sum{}, along{}, across{};
    const Arm *arm = arms_of(block);
    for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
    {
      const Two f = two(force[i][0]), r = two(arm->x);
      sum += f;
      along += r * f;
      across += r * swap(f);
    }
    return { sum[0], sum[1],
             now.c * (across[0] - across[1]) - now.s * (along[0] + along[1]) };
  }

  static_assert(offsetof(RigidBlockState, velocity)
                    == offsetof(RigidBlockState, rotation) + sizeof(double),
                "rotation and velocity are loaded as one row");

  /** Some blocks, one in each lane. Rows of four numbers are transposed, as
      single numbers that are stored one by one have to reach the cache before
      they can be loaded as a vector. */
  struct RigidBlocks::Pack
  {
    static constexpr unsigned int lanes = native_lanes;
    using L                             = Lanes<lanes>;
    using F                             = LaneFunctions<lanes>;
    using Value                         = F::Value;
    using Row                           = Lanes<4>::Value;

    /** A row of each block has its force, moment and mass, or its viscous force
        and moment and its moment of inertia. */
    alignas(64) double force[lanes][4], viscous[lanes][4];
    Value rotation, velocity[3];

    /** Loads the motion of blocks; lanes of held blocks, and those beyond the
        last one, are at rest and have mass. */
    Pack(RigidBlockState *blocks, const unsigned int n,
         const RigidBlockStage &stage, const unsigned int first)
    {
      for (unsigned int l = 0; l < lanes; ++l)
      {
        is_free[l] = l < n && !stage.held[first + l];
        rows[l]    = is_free[l] ? &blocks[l].rotation : rest;
        if (is_free[l])
          continue;
        Lanes<4>::set_four(force[l], Row{ 0., 0., 0., 1. });
        Lanes<4>::set_four(viscous[l], Row{ 0., 0., 0., 1. });
      }
      Value row[4];
      L::load_four([&](const int l) { return rows[l]; }, row);
      rotation = row[0];
      std::copy_n(row + 1, 3, velocity);
    }
    bool moves(const unsigned int l) const
    {
      return is_free[l];
    }

    struct Sums
    {
      Value before{}, after{}, mass_power{}, kinetic_change{}, unbalanced{};
    };
    /** As advance_nodes_damped() for a node's two degrees of freedom. */
    void move(const StepContext &step, Sums &sums)
    {
      const double a            = 0.5 * step.dt_velocity * step.mass_damping;
      const double decay        = (1. - a) / (1. + a);
      const double push         = step.dt_velocity / (1. + a);
      const double inverse_push = 1. / push;
      Value f[4], drags[4];
      L::load_four([&](const int l) { return force[l]; }, f);
      L::load_four([&](const int l) { return viscous[l]; }, drags);
      const Value m[3] = { f[3], f[3], drags[3] };
      for (unsigned int d = 0; d < 3; ++d)
      {
        const Value fv   = drags[d];
        const Value v0   = velocity[d];
        const Value gain = push / m[d];
        const Value w    = decay * v0 + gain * (f[d] + fv);
        const Value v1
            = w
              - local_damping_velocity<lanes>(
                  step.local_damping * gain * F::absolute(f[d]), v0, w);
        const Value drag = fv
                           + m[d]
                                 * (inverse_push * (v1 - w)
                                    - 0.5 * step.mass_damping * (v0 + v1));
        sums.before -= drag * v0;
        sums.after -= drag * v1;
        sums.mass_power += 0.25 * m[d] * (v0 + v1) * (v0 + v1);
        sums.kinetic_change += 0.5 * m[d] * (v1 - v0) * (v1 + v0);
        velocity[d] = v1;
      }
      sums.unbalanced += F::square_root(f[0] * f[0] + f[1] * f[1])
                         + F::absolute(f[2]) * F::square_root(m[0] / m[2]);
      rotation = rotation + step.dt * velocity[2];
      L::store_four([&](const int l) { return rows[l]; },
                    { rotation, velocity[0], velocity[1], velocity[2] });
    }

  private:
    double rest[4]{};
    double *rows[lanes]; /**< rotation and velocity */
    bool is_free[lanes];
  };

  RigidBlockWork RigidBlocks::advance(const StepContext &step,
                                      const RigidBlockStage &stage,
                                      dealii::Tensor<1, 2> *force,
                                      dealii::Tensor<1, 2> *viscous,
                                      State<2> &state) const
  {
    constexpr unsigned int lanes = Pack::lanes;
    using F                      = Pack::F;
    RigidBlockStates &rigid      = state.get<RigidBlockStates>();
    Pack::Sums sums;
    for (unsigned int first = 0; first < blocks.size(); first += lanes)
    {
      const unsigned int n
          = std::min<unsigned int>(lanes, blocks.size() - first);
      Pack pack(&rigid[first], n, stage, first);
      alignas(64) double sine[2][lanes], cosine[2][lanes];
      const auto turn = [&](const unsigned int when)
      {
        F::Value s, c;
        F::sine_cosine(pack.rotation, s, c);
        F::store(sine[when], s);
        F::store(cosine[when], c);
      };
      turn(0);
      for (unsigned int l = 0; l < n; ++l)
      {
        const Block &block = blocks[first + l];
        if (pack.moves(l))
        {
          const Direction now(cosine[0][l], sine[0][l]);
          const auto mass = inertia(stage, first + l);
          const auto f    = resultant(block, now, force);
          const auto fv   = viscous ? resultant(block, now, viscous)
                                    : std::array<double, 3>{};
          Lanes<4>::set_four(pack.force[l],
                             Pack::Row{ f[0], f[1], f[2], mass[0] });
          Lanes<4>::set_four(pack.viscous[l],
                             Pack::Row{ fv[0], fv[1], fv[2], mass[2] });
        }
        std::fill(force + block.begin, force + block.end,
                  dealii::Tensor<1, 2>());
        if (viscous)
          std::fill(viscous + block.begin, viscous + block.end,
                    dealii::Tensor<1, 2>());
      }
      pack.move(step, sums);
      turn(1);
      for (unsigned int l = 0; l < n; ++l)
      {
        if (!pack.moves(l))
          continue;
        RigidBlockState &block = rigid[first + l];
        two(block.displacement[0]) += step.dt * two(block.velocity[0]);
        place_nodes(blocks[first + l], block, { cosine[0][l], sine[0][l] },
                    { cosine[1][l], sine[1][l] }, state);
      }
    }
    RigidBlockWork work;
    work.damping    = { 0.5 * step.dt_before * F::sum(sums.before),
                        0.5 * step.dt * F::sum(sums.after),
                        F::sum(sums.mass_power), F::sum(sums.kinetic_change) };
    work.unbalanced = F::sum(sums.unbalanced);
    return work;
  }

  double RigidBlocks::mobility(const RigidBlockStage &stage,
                               const dealii::Tensor<1, 2> *force,
                               const double dt, const State<2> &state) const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      if (stage.held[b])
        continue;
      const RigidBlockState &rigid = state.get<RigidBlockStates>()[b];
      const Direction before(rigid.rotation - dt * rigid.velocity[2]);
      const auto f    = resultant(blocks[b], before, force);
      const auto mass = inertia(stage, b);
      for (unsigned int d = 0; d < 3; ++d)
        sum += f[d] * f[d] / mass[d];
    }
    return sum;
  }

  void RigidBlocks::push(const RigidBlockStage &stage,
                         const dealii::Tensor<1, 2> *force,
                         const double duration, const double dt,
                         State<2> &state) const
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      if (stage.held[b])
        continue;
      RigidBlockState &rigid = state.get<RigidBlockStates>()[b];
      const Direction before(rigid.rotation - dt * rigid.velocity[2]);
      const auto f    = resultant(blocks[b], before, force);
      const auto mass = inertia(stage, b);
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double change = duration * f[d] / mass[d];
        rigid.velocity[d] += change;
        (d == 2 ? rigid.rotation : rigid.displacement[d]) += dt * change;
      }
      place_nodes(blocks[b], rigid, before, Direction(rigid.rotation), state);
    }
  }

  void RigidBlocks::follow_nodes(const RigidBlockStage &stage,
                                 State<2> &state) const
  {
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      if (!stage.held[b])
        continue;
      const Block &block     = blocks[b];
      RigidBlockState &rigid = state.get<RigidBlockStates>()[b];
      const double before    = rigid.rotation;

      // The centre of the lumped masses is the centroid of the block.
      dealii::Tensor<1, 2> d, v;
      const Arm *arm = arms_of(block);
      for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
      {
        d += arm->share * state.nodes[i].u;
        v += arm->share * state.velocity[i];
      }

      // (R - 1) r is the displacement of nodes relative to the centroid.
      double sine = 0., versine = 0., second = 0.;
      arm = arms_of(block);
      for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
      {
        const double x = state.nodes[i].u[0] - d[0];
        const double y = state.nodes[i].u[1] - d[1];
        sine += arm->share * (arm->x * y - arm->y * x);
        versine -= arm->share * (arm->x * x + arm->y * y);
        second += arm->share * (arm->x * arm->x + arm->y * arm->y);
      }
      rigid.rotation
          = before
            + std::remainder(std::atan2(sine, second - versine) - before,
                             2. * dealii::numbers::PI);

      const Direction first(before), last(rigid.rotation);
      const double c = 0.5 * (first.c + last.c), s = 0.5 * (first.s + last.s);
      double moment = 0.;
      arm           = arms_of(block);
      for (unsigned int i = block.begin; i < block.end; ++i, ++arm)
      {
        const double x = c * arm->x - s * arm->y, y = s * arm->x + c * arm->y;
        moment += arm->share
                  * (x * (state.velocity[i][1] - v[1])
                     - y * (state.velocity[i][0] - v[0]));
      }
      rigid.displacement = d;
      set_vector(rigid.velocity, 0, v);
      rigid.velocity[2] = moment / ((c * c + s * s) * second);
    }
  }

  double RigidBlocks::kinetic_energy(const RigidBlockStage &stage,
                                     const std::vector<RigidBlockState> &before,
                                     const std::vector<RigidBlockState> &after,
                                     const double share) const
  {
    double energy = 0.;
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const auto mass = inertia(stage, b);
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double v0 = before[b].velocity[d];
        energy
            += 0.5 * mass[d] * v0 * (v0 + share * (after[b].velocity[d] - v0));
      }
    }
    return energy;
  }

  double
  RigidBlocks::squared_change(const RigidBlockStage &stage,
                              const std::vector<RigidBlockState> &before,
                              const std::vector<RigidBlockState> &after) const
  {
    double sum = 0.;
    for (unsigned int b = 0; b < blocks.size(); ++b)
    {
      const auto mass = inertia(stage, b);
      for (unsigned int d = 0; d < 3; ++d)
      {
        const double change = after[b].velocity[d] - before[b].velocity[d];
        sum += mass[d] * change * change;
      }
    }
    return sum;
  }
} // namespace quoin
