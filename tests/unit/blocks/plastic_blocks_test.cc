// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Blocks that yield: the kernel, its energy, and whole runs in closed form.

#include "random_blocks.h"
#include "../model/test_models.h"

#include <quoin/blocks/cell_states.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace quoin;
using namespace quoin::test;

namespace
{
  using Forces = AlignedArray<dealii::Tensor<1, 2>>;

  constexpr double degree = 0.017453292519943295;
  constexpr LinearElastic rock{ 2500., 10e9, 0.25 };
  const MohrCoulombStrength strength{ 2e6, 35. * degree, 10. * degree, 1e6 };
  const PlaneAssumption both_assumptions[]
      = { PlaneAssumption::plane_strain, PlaneAssumption::plane_stress };

  /** Blocks of three stiffnesses, two of which yield. */
  RandomBlocks assorted_blocks(const PlaneAssumption plane)
  {
    RandomBlocks mesh(5);
    for (const unsigned int m : { 9u, 1u, 4u, 16u })
      mesh.add_block(m, 1. + 0.1 * m);
    mesh.add_triangle();
    mesh.data.thickness      = 0.4;
    const LinearElastic soft = { 1900., 5e9, 0.33 };
    const LinearElastic firm = { 2700., 30e9, 0. };
    mesh.data.stiffness
        = { plane_stiffness(rock, plane), plane_stiffness(soft, plane),
            plane_stiffness(firm, plane) };
    mesh.data.laws.resize(3);
    mesh.data.laws[0].emplace(rock, strength, plane);
    mesh.data.laws[2].emplace(firm, MohrCoulombStrength{ 5e6, 0., 0. }, plane);
    for (unsigned int k = 0; k < mesh.data.cells.size(); ++k)
      mesh.data.cell_stiffness.push_back(k % 5 == 0 ? 1 : (k % 3 == 0 ? 2 : 0));
    return mesh;
  }

  double add_forces(const BlockForces<2> &blocks, const RandomBlocks &mesh,
                    PlasticHistory &history, Forces &force,
                    const bool by_cell = false)
  {
    double dissipated = 0.;
    force.assign(mesh.nodes.size(), dealii::Tensor<1, 2>());
    for (unsigned int tile = 0; tile < blocks.n_tiles(); ++tile)
      dissipated += by_cell ? add_forces_by_cell(
                        blocks, tile, mesh.nodes.data(), history, force.data())
                            : blocks.add_forces(tile, mesh.nodes.data(),
                                                history, force.data());
    return dissipated;
  }

  void add_modest_stress(RandomBlocks &mesh, const PlaneAssumption plane)
  {
    mesh.add_initial_stress(1e6);
    if (plane == PlaneAssumption::plane_strain)
      for (auto &s : mesh.data.initial_stress)
        s[3] = 1e6 * mesh.random();
  }
} // namespace

TEST(PlasticBlocks, StripsAgreeWithSingleCells)
{
  for (const PlaneAssumption plane : both_assumptions)
    for (const unsigned int n_lanes : { 4u, 8u })
      for (const auto &[with_stress, size] :
           { std::pair(false, 1.), std::pair(true, 1.), std::pair(true, 50.) })
      {
        RandomBlocks mesh = assorted_blocks(plane);
        if (with_stress)
          add_modest_stress(mesh, plane);
        BlockForcesOptions options;
        options.n_lanes       = n_lanes;
        options.max_run_cells = 100;
        BlockForces<2> blocks = mesh.prepared(options);
        PlasticHistory a = initial_history(blocks), b = a;
        Forces force_a, force_b;
        unsigned int n_yielded = 0;
        for (unsigned int step = 0; step < 5; ++step)
        {
          mesh.deform(2e-4 * size * (1 + step), 0.5 * step);
          const double lost_a = add_forces(blocks, mesh, a, force_a);
          const double lost_b = add_forces(blocks, mesh, b, force_b, true);
          // Large jumps cross the elastic domain.
          EXPECT_TRUE(lost_b > 0. || size > 1.);
          EXPECT_NEAR(lost_a, lost_b, 1e-9 * std::abs(lost_b));
          EXPECT_LT(largest_difference(force_a, force_b),
                    1e-9 * largest(force_b));
          for (std::size_t k = 0; k < mesh.data.cells.size(); ++k)
          {
            for (unsigned int i = 0; i < 4; ++i)
            {
              EXPECT_NEAR(a.cells[k].inverse_stretch[i],
                          b.cells[k].inverse_stretch[i], 1e-12 * size);
              EXPECT_NEAR(a.cells[k].stress[i], b.cells[k].stress[i],
                          1e-1 * size);
            }
            EXPECT_NEAR(a.shear[k], b.shear[k], 1e-12 * size);
            EXPECT_EQ(a.yielding[k], b.yielding[k]);
            n_yielded += (a.yielding[k] & 3) != 0;
          }
        }
        EXPECT_GT(n_yielded, mesh.data.cells.size());
        EXPECT_LT(n_yielded, 5 * mesh.data.cells.size());
      }
}

TEST(PlasticBlocks, BelowTheirStrengthTheyAreElastic)
{
  for (const PlaneAssumption plane : both_assumptions)
  {
    RandomBlocks mesh = assorted_blocks(plane);
    mesh.deform(1e-6, 1.3);
    BlockForces<2> blocks, elastic;
    blocks.prepare(mesh.data);
    mesh.data.laws.clear();
    elastic.prepare(mesh.data);
    PlasticHistory history = initial_history(blocks), none;
    Forces force, wanted;
    EXPECT_EQ(add_forces(blocks, mesh, history, force), 0.);
    add_forces(elastic, mesh, none, wanted);
    EXPECT_LT(largest_difference(force, wanted), 1e-9 * largest(wanted));
    // Cells one by one and strips each lose to the rotation what the digits of
    // a strain of 1e-6 are worth.
    EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), history),
                strain_energy(elastic, mesh.nodes.data(), none),
                1e-10 * strain_energy(elastic, mesh.nodes.data(), none));
    EXPECT_TRUE(std::all_of(history.yielding.begin(), history.yielding.end(),
                            [](const auto s) { return s == 0; }));
    EXPECT_TRUE(initial_history(elastic).cells.empty());
  }
}

TEST(PlasticBlocks, WorkIsStoredOrDissipated)
{
  for (const PlaneAssumption plane : both_assumptions)
  {
    RandomBlocks mesh = assorted_blocks(plane);
    add_modest_stress(mesh, plane);
    BlockForces<2> blocks  = mesh.prepared();
    PlasticHistory history = initial_history(blocks);

    RandomBlocks aim = mesh;
    aim.deform(1e-3, 0.02);
    Forces before, after;
    double lost          = add_forces(blocks, mesh, history, before);
    const double at_0    = strain_energy(blocks, mesh.nodes.data(), history);
    double work          = 0.;
    const unsigned int n = 4000;
    for (unsigned int step = 1; step <= n; ++step)
    {
      // there and back again
      const double share = std::sin(3. * step / n);
      const auto old     = mesh.nodes;
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
          mesh.nodes[i].u[d] = share * aim.nodes[i].u[d];
      lost += add_forces(blocks, mesh, history, after);
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        for (unsigned int d = 0; d < 2; ++d)
        {
          const double w = -0.5 * (before[i][d] + after[i][d])
                           * (mesh.nodes[i].u[d] - old[i].u[d]);
          work += w;
        }
      before = after;
    }
    const double stored
        = strain_energy(blocks, mesh.nodes.data(), history) - at_0;
    // What the first call dissipated belongs to the initial stress.
    PlasticHistory start = initial_history(blocks);
    for (NodeRecord<2> &node : mesh.nodes)
      node.u[0] = node.u[1] = 0.;
    lost -= blocks.update(mesh.nodes.data(), start);
    EXPECT_GT(lost, 0.5 * work);
    EXPECT_NEAR(work, stored + lost, 1e-4 * lost);
  }
}

TEST(PlasticBlocks, TurnWithoutYielding)
{
  RandomBlocks mesh      = assorted_blocks(PlaneAssumption::plane_strain);
  BlockForces<2> blocks  = mesh.prepared();
  PlasticHistory history = initial_history(blocks);
  Forces force;
  mesh.deform(1e-3, 0.);
  add_forces(blocks, mesh, history, force);
  const auto flowed   = history.shear;
  const double energy = strain_energy(blocks, mesh.nodes.data(), history);
  // The same shape turned: x -> R x
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (NodeRecord<2> &node : mesh.nodes)
  {
    const double x = node.X[0] + node.u[0], y = node.X[1] + node.u[1];
    node.u[0] = c * x - s * y - node.X[0];
    node.u[1] = s * x + c * y - node.X[1];
  }
  Forces turned;
  const double lost = add_forces(blocks, mesh, history, turned);
  EXPECT_NEAR(lost, 0., 1e-9 * energy);
  EXPECT_NEAR(strain_energy(blocks, mesh.nodes.data(), history), energy,
              1e-9 * energy);
  for (std::size_t k = 0; k < flowed.size(); ++k)
    EXPECT_NEAR(history.shear[k], flowed[k], 1e-12);
  for (std::size_t i = 0; i < force.size(); ++i)
  {
    EXPECT_NEAR(turned[i][0], c * force[i][0] - s * force[i][1],
                1e-9 * largest(force));
    EXPECT_NEAR(turned[i][1], s * force[i][0] + c * force[i][1],
                1e-9 * largest(force));
  }
}

namespace
{
  /** Two triangles, a square of 1 m, on rollers below and at the left: so
      few that no stress can be locked in on the way. */
  struct Specimen
  {
    BlockMesh<2> mesh;
    std::unique_ptr<TestRun> run;

    Specimen(const MohrCoulombStrength &strength, const PlaneAssumption plane,
             const bool large_displacements, const double stretch)
    {
      MeshData<2> data = grid(1, 1, "rock", 0., 0.);
      add_curve(data, "bottom", 0., 0., 1., 0.);
      add_curve(data, "left", 0., 0., 0., 1.);
      add_curve(data, "top", 0., 1., 1., 1.);
      mesh = split_into_blocks(data, {});
      ModelParameters parameters;
      parameters.plane = plane;
      parameters.materials
          = { material("rock", rock.density, rock.young, rock.poisson) };
      parameters.materials[0].strength = strength;
      parameters.large_displacements   = large_displacements;
      if (large_displacements)
      {
        parameters.joints = { elastic_joint(1e10, 1e10, "") };
        parameters.joints[0].curves.clear();
        parameters.joints[0].all_new_contacts = true;
      }
      // Ever slower, so that it ends at rest on the yield surface.
      const double time      = 10.;
      const std::string rate = std::to_string(1e3 * stretch * 4. / time)
                               + "e-3 * max(0, 1 - t / 10)^3";
      run = std::make_unique<TestRun>(
          mesh, parameters,
          std::vector<LoadParameters>{ motion("bottom", "bottom", "", "0"),
                                       motion("left", "left", "0", ""),
                                       motion("top", "top", "", rate) });
      run->begin(stage_with({ "bottom", "left", "top" }, DampingType::local));
      run->step(1.1 * time / run->dt());
    }

    /** Largest deviation from @p wanted among the cells [Pa]. */
    double stress_error(const std::array<double, 4> &wanted) const
    {
      double error = 0.;
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto s = cell_stress(run->model.blocks(), run->state.nodes.data(),
                                   run->state.get<PlasticHistory>(), c);
        for (unsigned int i = 0; i < 4; ++i)
          error = std::max(error, std::abs(s[i] - wanted[i]));
      }
      return error;
    }

    double side() const
    {
      return run->state.nodes[run->node(1., 1.)].u[0];
    }
  };

  const bool small_and_large[] = { false, true };
} // namespace

// Stretched in plane stress: the stress stays at the tensile strength, and the
// sides where that alone has brought them.
TEST(PlasticBlocks, TensionInPlaneStress)
{
  const MohrCoulombStrength weak{ 2e6, 30. * degree, 30. * degree, 1e6 };
  for (const bool large : small_and_large)
  {
    const Specimen specimen(weak, PlaneAssumption::plane_stress, large, 1e-3);
    // Biot's stress for the strength by the present area, elastic strains
    // -nu S / E to both sides.
    double stress = weak.tension;
    for (unsigned int round = 0; round < 20; ++round)
    {
      const double side = 1. - rock.poisson * stress / rock.young;
      stress            = weak.tension * side * side * (1. + 1e-3)
               / (1. + stress / rock.young);
    }
    const double pulled_in = rock.poisson * stress / rock.young;
    EXPECT_LT(specimen.stress_error({ 0., weak.tension, 0., 0. }),
              1e-6 * weak.tension);
    EXPECT_NEAR(specimen.side(), -pulled_in, 1e-6 * pulled_in);
    EXPECT_EQ(specimen.run->state.get<PlasticHistory>().yielding[1]
                  & yielding::shear_past,
              0);
  }
}

namespace
{
  /** A block of 1 m that is given one strain after the other. */
  struct Strained
  {
    RandomBlocks mesh{ 3 };
    BlockForces<2> blocks;
    PlasticHistory history;
    double lost = 0.; /**< dissipated so far [J] */

    explicit Strained(const MohrCoulombStrength &strength,
                      const LinearElastic &material = rock)
    {
      constexpr auto plane = PlaneAssumption::plane_strain;
      mesh.add_block(4, 1.);
      mesh.data.stiffness = { plane_stiffness(material, plane) };
      mesh.data.laws.resize(1);
      mesh.data.laws[0].emplace(material, strength, plane);
      blocks.prepare(mesh.data);
      history = initial_history(blocks);
    }

    void strain(const double xx, const double yy, const double shear)
    {
      mesh.displace(
          [=](const double x, const double y, dealii::Tensor<1, 2> &u)
          {
            u[0] = xx * x + shear * y;
            u[1] = yy * y;
          });
      Forces force;
      lost += add_forces(blocks, mesh, history, force);
    }

    std::array<double, 4> stress(const unsigned int cell) const
    {
      return cell_stress(blocks, mesh.nodes.data(), history, cell);
    }
  };
} // namespace

// Shortened along y and widened as a free side would be, so little that strains
// are linear: in plane strain sigma_zz is the middle stress and the plastic
// strain stays in the plane, N_psi of it outwards for 1 along y.
TEST(PlasticBlocks, CompressionInPlaneStrain)
{
  const double phi = 30. * degree, psi = 10. * degree;
  const double q     = 2. * 2e6 * std::sqrt(3.);
  const double n_psi = (1. + std::sin(psi)) / (1. - std::sin(psi));
  const double nu    = rock.poisson;
  constexpr LinearElastic stiff{ rock.density, 1e6 * rock.young, rock.poisson };
  constexpr double pressed = 2e-9;
  const double limit       = q * (1. - nu * nu) / stiff.young;
  Strained block({ 2e6, phi, psi }, stiff);
  const unsigned int n = 4000;
  for (unsigned int step = 1; step <= n; ++step)
  {
    const double shortening = pressed * step / n;
    const double elastic    = std::min(shortening, limit);
    block.strain(nu / (1. - nu) * elastic + n_psi * (shortening - elastic),
                 -shortening, 0.);
  }
  for (unsigned int k = 0; k < block.mesh.data.cells.size(); ++k)
  {
    const auto s                       = block.stress(k);
    const std::array<double, 4> wanted = { 0., -q, 0., -nu * q };
    for (unsigned int i = 0; i < 4; ++i)
      EXPECT_NEAR(s[i], wanted[i], 1e-6 * q);
    EXPECT_EQ(block.history.yielding[k],
              yielding::shear_now | yielding::shear_past);
  }
  EXPECT_NEAR(block.lost, q * (pressed - limit), 1e-4 * q * pressed);
}

// u_x = g y: the Mohr circle's radius stays at c if phi = 0.
TEST(PlasticBlocks, SimpleShear)
{
  Strained block({ 1e6, 0., 0. });
  for (unsigned int step = 1; step <= 1000; ++step)
    block.strain(0., 0., 1e-6 * step);
  const double modulus = rock.young / (2. * (1. + rock.poisson));
  for (unsigned int k = 0; k < block.mesh.data.cells.size(); ++k)
  {
    const auto s = block.stress(k);
    EXPECT_NEAR(std::hypot(0.5 * (s[0] - s[1]), s[2]), 1e6, 1.);
    EXPECT_EQ(block.history.yielding[k],
              yielding::shear_now | yielding::shear_past);
    EXPECT_NEAR(2. * block.history.shear[k], 1e-3 - 1e6 / modulus, 1e-6 * 1e-3);
  }
  EXPECT_NEAR(block.lost, 1e6 * (1e-3 - 1e6 / modulus), 1e-5 * 1e3);
}

// The same to 100 %: c on the top, whose area stays; the work per volume.
TEST(PlasticBlocks, SimpleShearToOne)
{
  constexpr double c = 1e6;
  Strained block({ c, 0., 0. });
  for (unsigned int step = 1; step <= 4000; ++step)
    block.strain(0., 0., step / 4000.);
  const double modulus = rock.young / (2. * (1. + rock.poisson));
  for (unsigned int k = 0; k < block.mesh.data.cells.size(); ++k)
  {
    const auto s = block.stress(k);
    EXPECT_NEAR(std::hypot(0.5 * (s[0] - s[1]), s[2]), c, 1e-10 * c);
    EXPECT_NEAR(s[2], c, 1e-5 * c);
  }
  EXPECT_NEAR(block.lost, c * (1. - c / modulus), 1e-5 * c);
}

// What the initial stress has beyond the strength is gone after one step, in
// which nothing moves, and booked.
TEST(PlasticBlocks, InitialStressBeyondTheStrength)
{
  BlockMesh<2> mesh          = make_stack(2, 2);
  ModelParameters parameters = two_blocks();
  for (auto &material : parameters.materials)
    material.strength = MohrCoulombStrength{ 1e6, 0., 0. };
  LoadParameters stress;
  stress.name                 = "insitu";
  stress.type                 = LoadType::initial_stress;
  stress.stress               = { { -4e6, 0., 0. } };
  parameters.initial_stresses = { stress };
  TestRun run(mesh, parameters,
              { motion("bottom", "bottom", "0", "0"), stress });
  run.begin(stage_with({ "bottom" }));
  run.solver.step(run.state, { true, false });
  EXPECT_LT(run.solver.energies().strain, 0.);
  EXPECT_NEAR(run.solver.energies().residual(), 0.,
              1e-9 * run.state.energy.plastic);
  for (unsigned int i = 0; i < 200; ++i)
    run.solver.step(run.state, { true, false });
  EXPECT_NEAR(run.solver.energies().residual(), 0.,
              1e-6 * run.state.energy.plastic);
}
