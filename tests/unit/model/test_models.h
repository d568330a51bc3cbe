// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tests_unit_model_test_models_h
#define quoin_tests_unit_model_test_models_h

#include "../mesh/test_meshes.h"
#include "../mesh/test_nodes.h"

#include <quoin/dynamics/explicit_solver.h>
#include <quoin/model/model.h>
#include <quoin/mesh/block_splitter.h>

#include <memory>
#include <random>

namespace quoin::test
{
  /**
   * Two blocks of nx x ny unit squares, "lower" and "upper", one on the other
   * with a joint on the curve "joint" between them, and the curves "bottom",
   * "top" and "sides".
   */
  inline BlockMesh<2> make_stack(const unsigned int nx, const unsigned int ny,
                                 const bool quadratic = false)
  {
    MeshData<2> data;
    for (const unsigned int i : { 0U, 1U })
    {
      const double y0 = i * ny, y1 = y0 + ny;
      add_grid(data, nx, ny, i == 0 ? "lower" : "upper", 0., y0);
      add_curve(data, i == 0 ? "bottom" : "joint", 0., y0, nx, y0);
      add_curve(data, "sides", 0., y0, 0., y1);
      add_curve(data, "sides", nx, y0, nx, y1);
      if (i == 1)
        add_curve(data, "top", 0., y1, nx, y1);
    }
    data.quadratic = quadratic;
    return split_into_blocks(data, {});
  }

  inline MaterialParameters material(const std::string &group,
                                     const double density = 2500.,
                                     const double young   = 1e10,
                                     const double poisson = 0.2)
  {
    MaterialParameters result;
    result.name    = group;
    result.groups  = { group };
    result.elastic = { density, young, poisson };
    return result;
  }

  inline JointSetParameters elastic_joint(const double normal_stiffness,
                                          const double shear_stiffness,
                                          const std::string &curve = "joint")
  {
    CoulombLaw law;
    law.normal_stiffness = normal_stiffness;
    law.shear_stiffness  = shear_stiffness;
    JointSetParameters result;
    result.name   = curve;
    result.curves = { curve };
    result.law    = law;
    return result;
  }

  /** The law of a set that has one of Coulomb. */
  inline CoulombLaw &coulomb_law(JointSetParameters &set)
  {
    return std::get<CoulombLaw>(set.law);
  }

  inline ModelParameters two_blocks(const double normal_stiffness = 2e10,
                                    const double shear_stiffness  = 1e10)
  {
    ModelParameters result;
    result.plane     = PlaneAssumption::plane_stress;
    result.thickness = 0.5;
    result.materials = { material("lower"), material("upper") };
    result.joints    = { elastic_joint(normal_stiffness, shear_stiffness) };
    return result;
  }

  /** A component of a load; "" leaves it free. */
  inline LoadComponent component(const LoadQuantity quantity,
                                 const std::string &text)
  {
    if (text.empty())
      return {};
    return { quantity, TimeFunction(text, "./") };
  }

  /** A load whose components are all the same quantity. */
  inline LoadParameters load(const std::string &name, const LoadType type,
                             const std::string &boundary,
                             const LoadQuantity quantity, const std::string &x,
                             const std::string &y,
                             const std::string &rotation = "")
  {
    LoadParameters result;
    result.name = name;
    result.type = type;
    if (!boundary.empty())
      result.boundaries = { boundary };
    result.components = { { component(quantity, x), component(quantity, y),
                            component(quantity, rotation) } };
    return result;
  }

  inline LoadParameters motion(const std::string &name,
                               const std::string &boundary,
                               const std::string &x, const std::string &y)
  {
    return load(name, LoadType::prescribed_motion, boundary,
                LoadQuantity::velocity, x, y);
  }

  inline LoadParameters traction(const std::string &name,
                                 const std::string &boundary,
                                 const std::string &x, const std::string &y)
  {
    return load(name, LoadType::traction, boundary, LoadQuantity::force, x, y);
  }

  inline LoadParameters gravity(const std::string &x, const std::string &y)
  {
    return load("gravity", LoadType::gravity, "", LoadQuantity::force, x, y);
  }

  inline LoadParameters viscous(const std::string &name,
                                const std::string &boundary)
  {
    return load(name, LoadType::viscous_boundary, boundary,
                LoadQuantity::velocity, "0", "0");
  }

  inline LoadParameters platen(const std::string &name,
                               const std::string &group, const LoadComponent &x,
                               const LoadComponent &y,
                               const LoadComponent &rotation)
  {
    LoadParameters result;
    result.name       = name;
    result.type       = LoadType::platen;
    result.groups     = { group };
    result.components = { { x, y, rotation } };
    return result;
  }

  inline StageParameters stage_with(const std::vector<std::string> &loads,
                                    const DampingType damping
                                    = DampingType::none)
  {
    StageParameters stage;
    stage.name     = "stage";
    stage.loads    = loads;
    stage.duration = 1.;
    stage.damping  = damping;
    if (damping == DampingType::local)
      stage.local_coefficient = 0.8;
    return stage;
  }

  /** A model of one rank with its solver, ready to step. */
  struct TestRun
  {
    TestNodes nodes;
    Model<2> model;
    ExplicitSolver<2> solver;
    State<2> state;

    TestRun(const BlockMesh<2> &mesh, const ModelParameters &parameters,
            const std::vector<LoadParameters> &loads)
      : nodes(mesh, parameters.materials), model(nodes, parameters),
        solver(model, loads), state(model.initial_state())
    {
    }

    /** Begins a stage with @p share of its critical step. */
    void begin(const StageParameters &stage, const double share = 0.8,
               const StageParameters *previous = nullptr)
    {
      solver.begin_stage(stage, previous, state);
      solver.set_time_step(share * solver.critical_step().length);
    }

    void step(const unsigned int n, const bool balance = false)
    {
      for (unsigned int i = 0; i < n; ++i)
        solver.step(state, { false, balance });
    }

    /** What @p n steps add to the energy residual, by the throughput. */
    double residual_of_steps(const unsigned int n)
    {
      solver.step(state, { true, false });
      // An initial velocity is energy that no account has.
      const double start = solver.energies().residual();
      double largest     = 0.;
      for (unsigned int i = 1; i < n; ++i)
      {
        solver.step(state, { true, false });
        const Energies &energies = solver.energies();
        largest = std::max(largest, std::abs(energies.residual() - start)
                                        / energies.throughput());
      }
      return largest;
    }

    double dt() const
    {
      return solver.get_time_step();
    }

    /** The nodes of a curve or, by their block, of a group. */
    std::vector<unsigned int> nodes_at_height(const double y) const
    {
      std::vector<unsigned int> found;
      for (unsigned int i = 0; i < nodes->n_local(); ++i)
        if (std::abs(nodes->point(i)[1] - y) < 1e-9)
          found.push_back(i);
      return found;
    }

    unsigned int node(const double x, const double y) const
    {
      const auto found = nodes_at(nodes, x, y);
      EXPECT_EQ(found.size(), 1U);
      return found.front();
    }

    void throw_at_random(const double speed, const unsigned int seed = 1)
    {
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> uniform(-speed, speed);
      for (dealii::Tensor<1, 2> &v : state.velocity)
        v = dealii::Point<2>(uniform(random), uniform(random));
    }
  };
} // namespace quoin::test

#endif
