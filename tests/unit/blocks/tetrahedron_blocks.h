// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_tetrahedron_blocks_h
#define quoin_tests_tetrahedron_blocks_h

#include <quoin/base/eigen_core.h>
#include <quoin/block_elements/tetrahedron.h>
#include <quoin/blocks/cell_states.h>
#include <quoin/blocks/node_update.h>
#include <quoin/blocks/stable_time_step.h>

#include <deal.II/base/array_view.h>

#include <Eigen/Dense>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace quoin::test
{
  using Eigen::Matrix3d;
  using Eigen::Vector3d;
  using Forces3 = AlignedArray<dealii::Tensor<1, 3>>;

  inline Vector3d vector(const dealii::Tensor<1, 3> &a)
  {
    return { a[0], a[1], a[2] };
  }

  inline Matrix3d rotation(const double angle, const Vector3d &axis)
  {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  }

  inline SpaceTensor components(const Matrix3d &s)
  {
    return { s(0, 0), s(1, 1), s(2, 2), s(0, 1), s(0, 2), s(1, 2) };
  }

  inline Matrix3d matrix(const SpaceTensor &s)
  {
    Matrix3d m;
    m << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return m;
  }

  /** Boxes cut into tetrahedra, six of each small box. */
  struct TetrahedronBlocks
  {
    BlockForcesData<3> data;
    AlignedArray<NodeRecord<3>> nodes;
    std::mt19937 random{ 5 };

    TetrahedronBlocks()
    {
      data.block_first_cell = { 0 };
      data.block_first_node = { 0 };
    }

    double uniform(const double a)
    {
      return std::uniform_real_distribution<double>(-a, a)(random);
    }

    /** A block of n[0] n[1] n[2] small boxes. Nodes inside it are moved by up
        to @p jitter of these. */
    void add_box(const std::array<unsigned int, 3> &n, const Vector3d &size,
                 const Vector3d &origin = Vector3d::Zero(),
                 const double jitter    = 0.)
    {
      const unsigned int first = nodes.size();
      const auto node =
          [&](const unsigned int i, const unsigned int j, const unsigned int k)
      { return first + (k * (n[1] + 1) + j) * (n[0] + 1) + i; };
      std::array<unsigned int, 3> at;
      for (at[2] = 0; at[2] <= n[2]; ++at[2])
        for (at[1] = 0; at[1] <= n[1]; ++at[1])
          for (at[0] = 0; at[0] <= n[0]; ++at[0])
          {
            NodeRecord<3> record{};
            for (unsigned int d = 0; d < 3; ++d)
            {
              const bool inside = at[d] > 0 && at[d] < n[d];
              record.X[d]       = origin[d]
                            + size[d]
                                  * (at[d] + (inside ? uniform(jitter) : 0.))
                                  / n[d];
            }
            nodes.push_back(record);
          }
      for (unsigned int k = 0; k < n[2]; ++k)
        for (unsigned int j = 0; j < n[1]; ++j)
          for (unsigned int i = 0; i < n[0]; ++i)
          {
            // From corner to corner, along the axes in any order.
            std::array<unsigned int, 3> axis{ 0, 1, 2 };
            do
            {
              std::array<unsigned int, 3> c{ i, j, k };
              std::array<unsigned int, 4> cell;
              cell[0] = node(c[0], c[1], c[2]);
              for (unsigned int s = 0; s < 3; ++s)
              {
                ++c[axis[s]];
                cell[s + 1] = node(c[0], c[1], c[2]);
              }
              if (axis[1] != (axis[0] + 1) % 3)
                std::swap(cell[1], cell[2]);
              data.cells.push_back(cell);
            } while (std::next_permutation(axis.begin(), axis.end()));
          }
      data.block_first_cell.push_back(data.cells.size());
      data.block_first_node.push_back(nodes.size());
    }

    Tetrahedron<OneLane> geometry(const unsigned int cell) const
    {
      const auto &n = data.cells[cell];
      double e[3][3];
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = 0; i < 3; ++i)
          e[k][i] = nodes[n[k + 1]].X[i] - nodes[n[0]].X[i];
      Tetrahedron<OneLane> result;
      result.set_edges(e);
      return result;
    }

    std::vector<double> mass(const double density) const
    {
      std::vector<double> result(nodes.size(), 0.);
      for (unsigned int k = 0; k < data.cells.size(); ++k)
        for (const unsigned int node : data.cells[k])
          result[node] += density * geometry(k).det / 24.;
      return result;
    }

    /** u = F X - X + @p shift. */
    void displace(const Matrix3d &F, const Vector3d &shift = Vector3d::Zero())
    {
      for (NodeRecord<3> &node : nodes)
      {
        const Vector3d u = (F - Matrix3d::Identity()) * vector(node.X) + shift;
        std::copy(u.data(), u.data() + 3, node.u.begin_raw());
      }
    }

    /** Random displacements beside those there are. */
    void disturb(const double size)
    {
      for (NodeRecord<3> &node : nodes)
        for (double &u : dealii::make_array_view(node.u))
          u += uniform(size);
    }

    void add_initial_stress(const double size)
    {
      for (unsigned int k = 0; k < data.cells.size(); ++k)
      {
        SpaceTensor s;
        for (double &component : s)
          component = uniform(size);
        data.initial_stress.push_back(s);
      }
    }

    BlockForces<3> prepared(const BlockForcesOptions &options
                            = BlockForcesOptions()) const
    {
      BlockForces<3> blocks;
      blocks.prepare(data, options);
      return blocks;
    }

    Forces3 zero() const
    {
      return Forces3(nodes.size(), dealii::Tensor<1, 3>());
    }

    Forces3 forces(const BlockForces<3> &blocks,
                   const bool by_cell = false) const
    {
      Forces3 force = zero();
      PlasticHistory none;
      for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
        if (by_cell)
          add_forces_by_cell(blocks, tile, nodes.data(), none, force.data());
        else
          blocks.add_forces(tile, nodes.data(), none, force.data());
      return force;
    }
  };

  inline double largest(const Forces3 &a)
  {
    double max = 0.;
    for (const dealii::Tensor<1, 3> &f : a)
      for (const double component : dealii::make_array_view(f))
        max = std::max(max, std::abs(component));
    return max;
  }

  inline double largest_difference(Forces3 a, const Forces3 &b)
  {
    for (unsigned int i = 0; i < a.size(); ++i)
      for (unsigned int d = 0; d < 3; ++d)
        a[i][d] -= b[i][d];
    return largest(a);
  }

  /** Central differences of free blocks. */
  struct FreeBlocks
  {
    TetrahedronBlocks &mesh;
    BlockForces<3> blocks;
    std::vector<double> mass, inverse_mass;
    Forces3 velocity, force;
    double dt;

    FreeBlocks(TetrahedronBlocks &mesh, const LinearElastic &material,
               const double share_of_critical)
      : mesh(mesh), mass(mesh.mass(material.density)), velocity(mesh.zero()),
        force(mesh.zero())
    {
      mesh.data.stiffness = { space_stiffness(material) };
      blocks.prepare(mesh.data);
      for (const double m : mass)
        inverse_mass.push_back(1. / m);
      std::vector<StableTimeStep<3>::Bound> bound(mass.size(),
                                                  StableTimeStep<3>::Bound{});
      for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      {
        const auto geometry = mesh.geometry(k);
        const double share
            = largest_eigenvalue_squared_frequency(
                  geometry, mesh.data.stiffness[0], material.density)
              * material.density * geometry.det / 24.;
        for (const unsigned int node : mesh.data.cells[k])
          for (unsigned int d = 0; d < 3; ++d)
            bound[node][d] += share;
      }
      dt = share_of_critical
           * StableTimeStep<3>::critical(
               StableTimeStep<3>(bound).largest_eigenvalue(mass), 0.);
    }

    /** @p load adds to the forces, which need not be zero before. */
    template <typename Load>
    void step(const Load &load)
    {
      PlasticHistory none;
      load();
      for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      {
        const NodeRange range = blocks.tile_nodes(tile);
        blocks.add_forces(tile, mesh.nodes.data(), none, force.data());
        advance_nodes(range.begin, range.end, mesh.nodes.data(),
                      velocity.data(), force.data(), inverse_mass.data(), dt,
                      dt);
      }
    }
  };

  /** Expects that the energy of lanes is that of cells one by one. Of strains
      of size @p strain a rotation leaves so many digits less. */
  inline void expect_energy_of_cells(const BlockForces<3> &blocks,
                                     const TetrahedronBlocks &mesh,
                                     const double strain)
  {
    double sum = 0., size = 0.;
    for (std::size_t k = 0; k < mesh.data.cells.size();
         k += mesh.data.n_joined_cells())
    {
      const double energy = cell_energy(mesh.data, mesh.nodes.data(), {}, k);
      sum += energy;
      size += std::abs(energy);
    }
    EXPECT_GT(size, 0.);
    EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), {}), sum,
                std::max(1e-13, 1e-16 / strain) * size);
  }
} // namespace quoin::test

#endif
