// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/structures/beam_fields.h>
#include <quoin/structures/beam_motion.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace quoin;
using quoin::test::TestNodes;

namespace
{
  /** A square of 1 m, the block above the liner, whose curve is "wall";
      @p x, @p y: its lower left corner [m]. */
  BlockMesh<2> block(const double x = 0., const double y = 0.)
  {
    return quoin::test::rectangle(x, y, x + 1., y + 1., { "", "wall", "other" },
                                  { 1, 1, 1, 2 });
  }

  BeamParameters section()
  {
    BeamParameters beam;
    beam.name          = "beam";
    beam.modulus       = 2e9;
    beam.area          = 0.03;
    beam.second_moment = 4e-5;
    beam.density       = 2000.;
    return beam;
  }

  struct Model
  {
    const BlockMesh<2> mesh;
    const TestNodes nodes{ mesh };
    std::vector<JointSetParameters> sets;
    State<2> state;
    std::unique_ptr<Beams> beams;
    std::unique_ptr<BeamMotion> motion;

    explicit Model(const BeamParameters &beam,
                   const JointStrength &strength    = { 1e30, 0., 1e30 },
                   const double thickness_of_blocks = 1.,
                   const BlockMesh<2> &mesh         = block())
      : mesh(mesh)
    {
      CoulombLaw law;
      law.normal_stiffness = 3e9;
      law.shear_stiffness  = 1e9;
      law.peak = law.residual = strength;
      JointSetParameters set;
      set.name = "bond";
      set.law  = law;
      sets.push_back(set);
      const NodeMap<2> &map = nodes;
      state.nodes.resize(map.n_local());
      for (unsigned int i = 0; i < map.n_local(); ++i)
        state.nodes[i] = { map.point(i), {} };
      beams = std::make_unique<Beams>(std::vector<BeamParameters>{ beam }, map,
                                      sets, 1., Thickness(thickness_of_blocks));
      beams->prepare(state);
      beams->begin_stage("first", state);
      motion = std::make_unique<BeamMotion>(*beams, map);
      motion->find_masses(0., state);
    }

    unsigned int node_of_point(const unsigned int p) const
    {
      return beams->all()[0].interface.points[p].node;
    }

    BeamState &now()
    {
      return state.get<BeamState>();
    }

    /** Stored energy with the forces at the present positions. */
    double energy(AlignedArray<dealii::Tensor<1, 2>> &force)
    {
      force.assign(state.nodes.size(), dealii::Tensor<1, 2>());
      const StepContext step{};
      beams->add_forces(step, state, { force.data(), nullptr });
      EnergyAccounts stored;
      beams->add_stored_energy(state, stored);
      return stored.strain + stored.joint;
    }
    double energy()
    {
      AlignedArray<dealii::Tensor<1, 2>> force;
      return energy(force);
    }

    /** Eigenvalues omega^2 of the beam [1/s^2], ascending, by differences of
        the energy. */
    Eigen::VectorXd eigenvalues()
    {
      const unsigned int n = 2 * now().nodes.size();
      const double h       = 1e-5;
      const auto at        = [&](const unsigned int i) -> double &
      { return now().nodes[i / 2].u[i % 2]; };
      Eigen::MatrixXd K(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
        {
          double sum = 0.;
          for (const double a : { -h, h })
            for (const double b : { -h, h })
            {
              at(i) += a;
              at(j) += b;
              sum += (a > 0.) == (b > 0.) ? energy() : -energy();
              at(i) -= a;
              at(j) -= b;
            }
          K(i, j) = K(j, i) = sum / (4. * h * h);
        }
      // Masses by the kinetic energy of unit velocities.
      Eigen::VectorXd root(n);
      for (unsigned int i = 0; i < n; ++i)
      {
        now().velocity[i / 2][i % 2] = 1.;
        root[i] = 1. / std::sqrt(2. * motion->kinetic_energy(state));
        now().velocity[i / 2][i % 2] = 0.;
      }
      for (unsigned int i = 0; i < 2; ++i) // a fixed start
        if (is_fixed)
          root[i] = 0.;
      return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
                 root.asDiagonal() * K * root.asDiagonal())
          .eigenvalues();
    }
    bool is_fixed = false;
  };
} // namespace

TEST(Beams, ModesOfCantilever)
{
  BeamParameters beam = section();
  beam.points         = { { { 2., 0. } }, { { 5., 0. } } };
  beam.n_segments     = 40;
  beam.supports[0]    = { true, true, true };
  Model model(beam);
  model.is_fixed  = true;
  const auto all  = model.eigenvalues();
  const double by = std::sqrt(beam.modulus * beam.second_moment
                              / (beam.density * beam.area));
  // Two zeros are those of the fixed node.
  EXPECT_NEAR(std::sqrt(all[2]), by * std::pow(1.8751041 / 3., 2),
              0.005 * by * std::pow(1.8751041 / 3., 2));
  EXPECT_NEAR(std::sqrt(all[3]), by * std::pow(4.6940911 / 3., 2),
              0.005 * by * std::pow(4.6940911 / 3., 2));
  // The bound of the stable step is not below the largest one.
  EXPECT_GE(model.motion->largest_eigenvalue(model.state) * (1. + 1e-6),
            all[all.size() - 1]);
}

TEST(Beams, ModesWithoutSupport)
{
  BeamParameters beam = section();
  beam.points         = { { { 2., 0. } }, { { 5., 0. } } };
  beam.n_segments     = 30;
  Model model(beam);
  const auto all     = model.eigenvalues();
  const double by    = std::sqrt(beam.modulus * beam.second_moment
                                 / (beam.density * beam.area));
  const double first = by * std::pow(4.7300407 / 3., 2);
  for (unsigned int i = 0; i < 3; ++i)
    EXPECT_LT(std::abs(all[i]), 1e-4 * first * first);
  EXPECT_NEAR(std::sqrt(all[3]), first, 0.005 * first);
}

TEST(Beams, ScaledStepAddsMass)
{
  BeamParameters beam = section();
  beam.points         = { { 0., 2. }, { 1., 2. } };
  beam.n_segments     = 4;
  Model model(beam);
  BeamMasses masses = model.motion->masses(model.state);
  ASSERT_EQ(masses.size(), 1u);
  double sum = 0.;
  for (const auto &[mass, scaled] : masses[0])
  {
    EXPECT_EQ(scaled, mass);
    sum += mass;
  }
  EXPECT_NEAR(sum, 2000. * 0.03 * 1., 1e-12);

  // Whatever the step is, it becomes a stable one.
  const double step = 1e-2;
  model.motion->find_masses(step, model.state);
  masses = model.motion->masses(model.state);
  for (const auto &[mass, scaled] : masses[0])
    EXPECT_GT(scaled, mass);
  EXPECT_LE(model.motion->largest_eigenvalue(model.state),
            4. / (step * step) * (1. + 1e-12));
}

TEST(Beams, ForcesAreTheDerivativeOfTheEnergy)
{
  BeamParameters beam = section();
  beam.boundary       = "wall";
  beam.interface      = "bond";
  Model model(beam);
  ASSERT_EQ(model.now().nodes.size(), 4);
  const double shift[4][2]
      = { { 0.01, 0.02 }, { -0.03, 0.01 }, { 0.02, -0.015 }, { 0.005, 0.03 } };
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int d = 0; d < 2; ++d)
      model.now().nodes[i].u[d] = 1e-4 * shift[i][d];
  AlignedArray<dealii::Tensor<1, 2>> force;
  model.energy(force);
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int d = 0; d < 2; ++d)
    {
      double &u          = model.state.nodes[i].u[d];
      const double h     = 1e-8;
      u                  = h;
      const double above = model.energy();
      u                  = -h;
      const double below = model.energy();
      u                  = 0.;
      EXPECT_NEAR(force[i][d], -(above - below) / (2. * h), 1e-3 * 3e9 * 1e-6);
    }
}

// Where a map has them coordinates have no digits for the gaps of a liner.
TEST(Beams, LinersFarFromTheOrigin)
{
  BeamParameters beam = section();
  beam.boundary       = "wall";
  beam.interface      = "bond";
  AlignedArray<dealii::Tensor<1, 2>> force[2];
  for (const bool is_far : { false, true })
  {
    Model model(beam, { 1e30, 0., 1e30 }, 1.,
                is_far ? block(3.5e6, 4.5e6) : block());
    for (unsigned int i = 0; i < 4; ++i)
      model.state.nodes[i].u = dealii::Point<2>(1e-8 * i, 1.7e-8 * i * i);
    model.energy(force[is_far]);
  }
  for (unsigned int i = 0; i < 4; ++i)
    for (unsigned int d = 0; d < 2; ++d)
      EXPECT_NEAR(force[1][i][d], force[0][i][d], 1e-6);
  EXPECT_GT(force[0][3].norm(), 10.);
}

TEST(Beams, CondensedStiffnessIsThatOfTheForces)
{
  BeamParameters beam = section();
  beam.boundary       = "wall";
  beam.interface      = "bond";
  for (const bool slips : { false, true })
  {
    Model model(beam, slips ? JointStrength{ 2e4, 0.5, 1e30 }
                            : JointStrength{ 1e30, 0., 1e30 });
    const State<2> start = model.state;
    const auto settled
        = [&](State<2> &now, std::vector<Eigen::MatrixXd> *stiffness)
    {
      AlignedArray<dealii::Tensor<1, 2>> force(4, dealii::Tensor<1, 2>());
      EXPECT_EQ(
          model.beams->settle({ 0., 0. }, start, now, force.data(), stiffness),
          "");
      return force;
    };
    State<2> now      = start;
    now.nodes[1].u[0] = 2e-4;
    std::vector<Eigen::MatrixXd> stiffness;
    State<2> moved = now;
    settled(moved, &stiffness);
    const auto &states = moved.get<BeamState>().interface.state;
    EXPECT_EQ(std::count(states.begin(), states.end(), JointState::slipping)
                  > 0,
              slips);
    for (unsigned int q = 0; q < 4; ++q)
      for (unsigned int e = 0; e < 2; ++e)
      {
        const double h = 1e-7;
        State<2> a = now, b = now;
        a.nodes[model.node_of_point(q)].u[e] += h;
        b.nodes[model.node_of_point(q)].u[e] -= h;
        const auto above = settled(a, nullptr), below = settled(b, nullptr);
        for (unsigned int p = 0; p < 4; ++p)
          for (unsigned int d = 0; d < 2; ++d)
          {
            const unsigned int node = model.node_of_point(p);
            EXPECT_NEAR(stiffness[0](2 * p + d, 2 * q + e),
                        -(above[node][d] - below[node][d]) / (2. * h), 1e4);
          }
      }
  }
}

TEST(Beams, HingeKeepsItsMoment)
{
  BeamParameters beam = section();
  beam.points         = { { { 2., 0. } }, { { 4., 0. } } };
  beam.n_segments     = 2;
  beam.hinge_moment   = 100.;
  Model model(beam);
  model.now().nodes[1].u[1] = -0.01;
  const double stored       = model.energy();
  const BeamFields fields   = beam_fields(model.beams->all()[0], model.state);
  EXPECT_NEAR(fields.moment[1], 100., 1e-9);
  const double k = beam.modulus * beam.second_moment / 1.;
  EXPECT_NEAR(fields.plastic[1], 2. * std::atan(0.01) - 100. / k, 1e-12);
  // By the trapezoidal rule from no moment.
  EXPECT_NEAR(model.state.energy.plastic, 50. * fields.plastic[1], 1e-9);
  EXPECT_GT(stored, 0.5 * 100. * 100. / k);
}

TEST(Beams, AxialForceBeyondTheSection)
{
  BeamParameters beam       = section();
  beam.points               = { { { 2., 0. } }, { { 4., 0. } } };
  beam.n_segments           = 2;
  beam.hinge_moment         = BeamParameters::by_section;
  beam.compressive_strength = 0.004 * beam.modulus;
  beam.tensile_strength     = 0.0004 * beam.modulus;
  const auto text           = [&](const double shortening)
  {
    Model model(beam);
    model.now().nodes[2].u[0] = -shortening;
    const Beam &only          = model.beams->all()[0];
    return overstress_text(only.line, beam_fields(only, model.state));
  };
  EXPECT_EQ(text(0.003), "");
  EXPECT_NE(text(0.005).find("beyond its 'Compressive strength'"),
            std::string::npos)
      << text(0.005);
  EXPECT_EQ(text(-0.0003), "");
  EXPECT_NE(text(-0.0005).find("beyond its 'Tensile strength'"),
            std::string::npos)
      << text(-0.0005);
  beam.hinge_moment = 100.;
  EXPECT_EQ(text(0.005), "");
}

// Blocks of half the thickness of the model are lined by half as much: 3 m of
// them, and beams 2 m apart.
TEST(Beams, LinersAreAsThickAsTheBlocksThatTheyLine)
{
  BeamParameters beam = section();
  beam.boundary       = "wall";
  beam.interface      = "bond";
  beam.spacing        = 2.;
  const Model model(beam, { 1e30, 0., 1e30 }, 0.5);
  const auto &[line, interface] = model.beams->all()[0];
  EXPECT_DOUBLE_EQ(line.share, 0.25);
  EXPECT_DOUBLE_EQ(line.axial_stiffness, 0.25 * beam.modulus * beam.area);
  double area = 0.;
  for (const InterfacePoint &point : interface.points)
    area += point.area;
  EXPECT_DOUBLE_EQ(area, 3. * 0.5);
  // A beam without blocks is in the model.
  beam        = section();
  beam.points = { { { 2., 0. } }, { { 4., 0. } } };
  EXPECT_DOUBLE_EQ(
      Model(beam, { 1e30, 0., 1e30 }, 0.5).beams->all()[0].line.share, 1.);
}

// A ring of 72 segments under the axial force -1e6 N, whose corners are at
// every n-th node. With three segments a chord of a circle of 2.5 m its sagitta
// is 2.5 (1 - cos(pi/24)) = 0.0214 m.
TEST(Beams, LinersOnChordsOfACircle)
{
  BeamParameters beam = section();
  beam.boundary       = "wall";
  const auto text     = [&](const unsigned int segments, const double moment)
  {
    const unsigned int n = 72, corners = n / segments;
    const auto corner = [&](const unsigned int k)
    {
      const double angle = 2. * dealii::numbers::PI * k / corners;
      return dealii::Point<2>(2.5 * std::cos(angle), 2.5 * std::sin(angle));
    };
    std::vector<dealii::Point<2>> places;
    BeamState now;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double part = double(i % segments) / segments;
      const auto a = corner(i / segments), b = corner(i / segments + 1);
      places.push_back(a + part * (b - a));
      now.nodes.push_back({ places.back(), {} });
    }
    BeamLine line(beam, 1., 0, places, true);
    line.find_rest(now);
    BeamFields fields;
    fields.axial.assign(n, -1e6);
    fields.moment.assign(n, moment);
    return chord_text(line, fields);
  };
  EXPECT_NE(text(3, 2e4).find("up to 0.0213"), std::string::npos)
      << text(3, 2e4);
  EXPECT_NE(text(3, 2e4).find("some 1.42"), std::string::npos);
  EXPECT_NE(text(2, 2e4), "");
  EXPECT_EQ(text(3, 2e5), "");  // which the chords change by 7 %
  EXPECT_EQ(text(1, 1e3), "");  // a corner at each node
  EXPECT_EQ(text(12, 1e3), ""); // a hexagon is meant as one
  beam.boundary.clear();
  EXPECT_EQ(text(3, 2e4), "");
}
