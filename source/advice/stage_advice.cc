// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/known_names.h>
#include <quoin/base/point_text.h>
#include <quoin/advice/contact_advice.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    /** A stage, its start time as far as it is known, and its loads. */
    struct StageOfRun
    {
      StageOfRun(const Parameters &parameters, const unsigned int index)
        : parameters(parameters), index(index), stage(parameters.stages[index]),
          before(previous_stage(parameters.stages, index)),
          start(start_of_stage(parameters.stages, index))
      {
        for (const std::string &name : stage.loads)
          if (const LoadParameters *load = find_named(parameters.loads, name))
            loads.push_back(load);
      }

      bool has(const LoadType type) const
      {
        return std::any_of(loads.begin(), loads.end(),
                           [=](const LoadParameters *load)
                           { return load->type == type; });
      }

      /** A component as a function of the time since the start of the stage. */
      FunctionOfTime function(const LoadComponent &component) const
      {
        return [&component, begin = start](const double t) {
          return component.value({ t, begin + t });
        };
      }

      const Parameters &parameters;
      const unsigned int index;
      const StageParameters &stage;
      /** Previous stage that changed the state, or null. */
      const StageParameters *before;
      const double start; /**< [s] */
      std::vector<const LoadParameters *> loads;
    };

    bool brings_waves(const StageOfRun &run)
    {
      if (run.has(LoadType::boundary_elements)
          && !run.parameters.boundary.waves.empty())
        return true;
      for (const LoadParameters *load : run.loads)
        if (load->type == LoadType::viscous_boundary)
          for (const auto &given : load->given_components())
          {
            const auto values = sampled(run.function(given.component),
                                        run.stage.duration, 1025);
            if (std::any_of(values.begin(), values.end(),
                            [](const double v) { return v != 0.; }))
              return true;
          }
      return false;
    }

    /** Warns of a controlled displacement that begins with a velocity. */
    void check_control(const StageOfRun &run, Checks &checks)
    {
      if (!run.stage.pattern || run.stage.slows_loads())
        return;
      const TimeFunction &control = run.stage.pattern->control;
      const double early          = 1e-6 * run.stage.duration;
      double fastest              = 0.;
      constexpr unsigned int n    = 100;
      for (unsigned int i = 0; i < n; ++i)
      {
        const double t = run.stage.duration * i / n;
        fastest = std::max(fastest, std::abs(control({ t + early, t + early })
                                             - control({ t, t })));
      }
      const double first = std::abs(control({ early, early }));
      checks.warn_if(
          first > 0.5 * fastest && fastest > 0.,
          "'Control function' begins with a velocity of ", first / early,
          " m/s, a jump that makes the model and the load factor oscillate. "
          "Let it begin slowly, such as with v * if(t < T, t^2 / (2 * T), t - "
          "T / 2), or give a 'Kinetic energy limit'.");
    }

    /** Warns of a load pattern whose factor nothing brings to that at rest. */
    void check_pattern_damping(const StageOfRun &run, Checks &checks)
    {
      checks.warn_if(
          run.stage.pattern && run.stage.damping == DampingType::none,
          "it has a 'Load pattern' and 'Damping = none': blocks vibrate on "
          "their joints, and the load factor is not what they bear at rest, "
          "but up to twice that where they rock and two thirds where they "
          "slide. Take 'local', or 'Rayleigh' with a stiffness coefficient "
          "where blocks rock.");
    }

    /** A motion that loads prescribe. */
    struct PrescribedShaking
    {
      std::string load;         /**< empty: none */
      double acceleration = 0.; /**< largest one [m/s^2] */
    };

    /**
     * The strongest motion by which a load shakes the model. Slow motions that
     * begin and end smoothly do not, nor do those that begin at once or reverse
     * at once at a constant velocity: they load it.
     */
    PrescribedShaking find_shaking(const StageOfRun &run)
    {
      /** Acceleration and velocity of weak earthquakes [m/s^2, m/s]. */
      constexpr double least_acceleration = 1., least_velocity = 0.05;
      /** Change within an interval, by the range, that is a jump [-]. */
      constexpr double jump    = 0.3;
      constexpr unsigned int n = 1025;
      const double interval    = run.stage.duration / (n - 1);
      PrescribedShaking found;
      for (const LoadParameters *load : run.loads)
        for (const auto &given : load->given_components())
        {
          const LoadQuantity quantity = given.component.quantity;
          if ((load->type != LoadType::prescribed_motion
               && load->type != LoadType::platen)
              || given.component.field || given.name.rfind("rotation", 0) == 0
              || quantity == LoadQuantity::force)
            continue;
          auto values
              = sampled(run.function(given.component), run.stage.duration, n);
          if (quantity == LoadQuantity::displacement)
            values = derivative(values, interval);
          const auto [low, high]
              = std::minmax_element(values.begin(), values.end());
          if (std::max(-*low, *high) < least_velocity)
            continue;
          for (unsigned int i = 0; i + 1 < n; ++i)
          {
            const double change = std::abs(values[i + 1] - values[i]);
            if (change < jump * (*high - *low)
                && change > std::max(least_acceleration, found.acceleration)
                                * interval)
              found = { load->name, change / interval };
          }
        }
      return found;
    }

    /** Warns of damping for equilibria in a stage that follows motion. */
    void check_damped_motion(const StageOfRun &run, Checks &checks)
    {
      const std::string damping
          = run.stage.damping == DampingType::local ? "local" : "adaptive";
      const std::string cure
          = ", and 'Damping = " + damping
            + "', which is meant for equilibria, falsifies motion: blocks that "
              "would rock, slide or fall may stand. Take 'Rayleigh' with a "
              "stiffness coefficient, or 'none' with a 'Restitution' of "
              "joints.";
      const PrescribedShaking shaking = find_shaking(run);
      checks.warn_if(!shaking.load.empty(), "the load ", shaking.load,
                     " shakes the model with up to ", shaking.acceleration,
                     " m/s^2", cure);
      checks.warn_if(run.index == 0
                         && !run.parameters.initial_motion.velocity.empty(),
                     "the model begins with the velocities of section 'Initial "
                     "motion'",
                     cure);
    }

    /** Warns of mass-proportional damping of what stands on moving ground. */
    void check_mass_damping(const StageOfRun &run, Checks &checks)
    {
      if (run.stage.damping != DampingType::rayleigh
          || run.stage.mass_coefficient == 0.
          || run.stage.end != StageEnd::time)
        return;
      const PrescribedShaking shaking = find_shaking(run);
      checks.warn_if(
          !shaking.load.empty(), "the load ", shaking.load,
          " shakes the model, and 'Rayleigh mass coefficient' resists the "
          "velocity in space, that of the ground included: it drives what "
          "stands on it, with ",
          run.stage.mass_coefficient,
          " times the velocity of the ground as acceleration. Take 'Rayleigh "
          "stiffness coefficient' or a 'Restitution' of joints instead.");
    }

    void check_damping(const StageOfRun &run, Checks &checks)
    {
      const StageParameters &stage = run.stage;
      check_mass_damping(run, checks);
      const bool is_of_equilibria = stage.damping == DampingType::local
                                    || stage.damping == DampingType::adaptive;
      checks.warn_if(
          stage.end == StageEnd::time && is_of_equilibria && brings_waves(run),
          "waves come in, and 'Damping = local' or 'adaptive', which is meant "
          "for equilibria, takes their energy. Take 'none' or 'Rayleigh'.");
      if (stage.end == StageEnd::time && !stage.slows_loads()
          && is_of_equilibria)
        check_damped_motion(run, checks);
    }

    /** Warns of a ratio at which loads that are small beside others, such as
        water beside weight, are far from their equilibrium. */
    void check_static_ratio(const StageOfRun &run, Checks &checks)
    {
      constexpr double largest = 1e-3;
      checks.warn_if(
          run.stage.end != StageEnd::time && run.stage.static_ratio > largest,
          "'Static ratio = ", run.stage.static_ratio,
          "' ends it while forces of that share of all applied ones are out of "
          "balance: reactions and displacements may be off by more than that. "
          "Take 1e-5.");
    }

    /** Warns of stiffness-proportional damping that no mode overcomes, such as
        a damping ratio that was taken for the coefficient. @p passage: of a
        shear wave, twice along the model's diagonal [s]. */
    void check_overdamping(const StageOfRun &run, const double passage,
                           Checks &checks)
    {
      constexpr double largest = 10.;
      if (run.stage.damping != DampingType::rayleigh || passage == 0.)
        return;
      const double frequency = 0.5 / passage; // of the lowest elastic mode
      const double ratio
          = constants::pi * run.stage.stiffness_coefficient * frequency;
      checks.warn_if(ratio > largest, "'Rayleigh stiffness coefficient = ",
                     run.stage.stiffness_coefficient,
                     "' s is a damping ratio of ", ratio,
                     " at the lowest elastic frequency, about ", frequency,
                     " Hz: the model creeps to its equilibrium with that time "
                     "constant. It is no damping ratio: for a ratio D at the "
                     "frequency f give D / (pi f).");
    }

    /** Warns of shaking by gravity, which water with added mass does not feel.
     */
    void check_moving_water(const StageOfRun &run, Checks &checks)
    {
      const bool has_water = run.stage.is_dynamic()
                             && std::any_of(run.loads.begin(), run.loads.end(),
                                            [](const LoadParameters *load)
                                            { return load->has_added_mass; });
      for (const LoadParameters *load : run.loads)
        for (const auto &given : load->given_components())
        {
          if (!has_water || load->type != LoadType::gravity
              || given.name != "horizontal")
            continue;
          const auto values
              = sampled(run.function(given.component), run.stage.duration, 257);
          const auto [low, high]
              = std::minmax_element(values.begin(), values.end());
          checks.warn_if(
              *high > *low, "the gravity ", load->name,
              " shakes the model, but not the water of 'Added mass', which "
              "resists motion against the ground far away. Move the base "
              "instead, by a prescribed motion or a wave.");
        }
    }

    /** Warns of viscous and free-field boundaries with prescribed motion. */
    void check_supports(const StageOfRun &run, Checks &checks)
    {
      for (const LoadParameters *held : run.loads)
        for (const LoadParameters *open : run.loads)
        {
          if (held->type != LoadType::prescribed_motion
              || (open->type != LoadType::viscous_boundary
                  && open->type != LoadType::free_field)
              || held->given_components().size() < 2)
            continue;
          const auto shared
              = std::find_if(open->boundaries.begin(), open->boundaries.end(),
                             [&](const std::string &curve)
                             { return is_among(curve, held->boundaries); });
          if (shared != open->boundaries.end())
            checks.warn_if(true, "the load ", held->name,
                           " prescribes the motion of the curve ", *shared,
                           ", so the load ", open->name,
                           " there does nothing: no wave comes in or leaves. "
                           "Take one of them out of 'Loads'.");
        }
    }

    /**
     * Component @p d of all loads of @p stage that act where @p load does, in
     * the same way, at @p t of a stage that began at @p start [s].
     */
    double force_like(const Parameters &parameters,
                      const StageParameters &stage, const LoadParameters &load,
                      const unsigned int d, const double t, const double start)
    {
      double sum = 0.;
      for (const LoadParameters &other : parameters.loads)
        if (names_load(stage, other.name) && other.type == load.type
            && other.boundaries == load.boundaries
            && other.groups == load.groups
            && other.functions()[d].quantity == LoadQuantity::force)
          sum += other.functions()[d].value({ t, start + t });
      return sum;
    }

    /** Jump of a force; its height is 0 if it is small. */
    Jump jump_of(const StageOfRun &run, const LoadParameters &load,
                 const unsigned int d)
    {
      /** Share of the largest value that counts as a jump. */
      constexpr double smallest    = 0.2;
      const Parameters &parameters = run.parameters;
      const FunctionOfTime value   = [&](const double t)
      { return force_like(parameters, run.stage, load, d, t, run.start); };
      double largest = 0.;
      for (const double v : sampled(value, run.stage.duration, 1025))
        largest = std::max(largest, std::abs(v));
      Jump jump   = largest_jump(value, run.stage.duration);
      double last = 0.;
      if (run.before && run.before->end == StageEnd::time)
        last
            = force_like(parameters, *run.before, load, d, run.before->duration,
                         run.start - run.before->duration);
      else if (run.before)
        last = force_like(parameters, *run.before, load, d, late_time,
                          run.start);
      // At the start of the run the initial stress may balance it.
      const bool is_borne
          = run.index == 0 && !parameters.model.initial_stresses.empty();
      if (!is_borne && std::abs(value(0.) - last) > jump.height)
        jump = { 0., std::abs(value(0.) - last) };
      return jump.height > smallest * largest ? jump : Jump();
    }

    /** @p rise: rise time of a force below which it counts as a jump [s]. */
    void check_jumps(const StageOfRun &run, const double rise, Checks &checks)
    {
      if (!run.stage.is_dynamic() || run.stage.stiffness_coefficient > 0.)
        return;
      // A model that falls under its weight alone is not shaken by it.
      const bool is_held
          = std::any_of(run.loads.begin(), run.loads.end(),
                        [](const LoadParameters *load)
                        {
                          return load->type != LoadType::gravity
                                 && load->type != LoadType::traction
                                 && load->type != LoadType::initial_stress;
                        });
      for (const LoadParameters *load : run.loads)
      {
        if (load->type != LoadType::traction && load->type != LoadType::platen
            && !(load->type == LoadType::gravity && is_held))
          continue;
        // Gravity may grow by itself.
        if (load->type == LoadType::gravity && load->ramp_duration >= rise)
          continue;
        // Where a load that travels is at the start is not known here.
        if (load->shape)
          continue;
        Jump jump;
        for (unsigned int d = 0; d < 7 && jump.height == 0.; ++d)
          if (load->functions()[d].quantity == LoadQuantity::force)
            jump = jump_of(run, *load, d);
        checks.warn_if(
            jump.height > 0., "the load ", load->name, " jumps by ",
            jump.height, " at ", jump.time,
            " s of an undamped stage: that excites frequencies which no mesh "
            "resolves. Let it rise over ",
            rise,
            " s, what an S wave takes through ten edges, or more, or damp by "
            "'Rayleigh' with a stiffness coefficient.");
      }
    }

    /**
     * Warns of a force that comes and goes, as of a blast, in less than
     * @p passage [s], under damping for equilibria.
     */
    void check_pulses(const StageOfRun &run, const double passage,
                      Checks &checks)
    {
      const StageParameters &stage = run.stage;
      if (stage.end != StageEnd::time || stage.slows_loads()
          || (stage.damping != DampingType::local
              && stage.damping != DampingType::adaptive))
        return;
      /** Share of the largest force below which there is none. */
      constexpr double small   = 0.05;
      constexpr unsigned int n = 1025;
      const auto is_pulse      = [&](const LoadComponent &component)
      {
        const auto values = sampled(run.function(component), stage.duration, n);
        double largest    = 0.;
        for (const double v : values)
          largest = std::max(largest, std::abs(v));
        const auto acts
            = [&](const double v) { return std::abs(v) > small * largest; };
        const auto n_acting = std::count_if(values.begin(), values.end(), acts);
        return n_acting > 0 && !acts(values.front()) && !acts(values.back())
               && double(n_acting) / (n - 1) * stage.duration < passage;
      };
      for (const LoadParameters *load : run.loads)
      {
        if (load->type != LoadType::traction || load->shape)
          continue;
        const auto components = load->given_components();
        checks.warn_if(
            std::any_of(components.begin(), components.end(),
                        [&](const auto &given)
                        {
                          return given.component.quantity == LoadQuantity::force
                                 && !given.component.field
                                 && is_pulse(given.component);
                        }),
            "the load ", load->name,
            " comes and goes faster than an S wave crosses the model twice, "
            "and 'Damping = ",
            stage.damping == DampingType::local ? "local" : "adaptive",
            "', which is meant for equilibria, takes the energy of its waves. "
            "Take 'none' or 'Rayleigh'.");
      }
    }

    /** Size of the cells of one material, for waves. */
    template <int dim>
    struct CellSize
    {
      /** Largest edge of a cell but for its diagonals [m]: the longest of a
          triangle, which is that of a square of two cells, and the three
          longest of a tetrahedron, which are those of a cube of six. 0: there
          is no cell. */
      double edge = 0.;
      dealii::Point<dim> position; /**< position of that cell [m] */
    };

    /** Cell size of each material; blocks absent in @p state do not count, nor
        do those that platens hold as a whole. */
    template <int dim>
    std::vector<CellSize<dim>> cell_sizes(const Model<dim> &model,
                                          const State<dim> &state,
                                          const StageOfRun &run)
    {
      const NodeMap<dim> &nodes     = model.nodes();
      const std::size_t n_materials = run.parameters.model.materials.size();
      std::vector<bool> is_platen(nodes.table().group_names.size(), false);
      for (const LoadParameters *load : run.loads)
        for (unsigned int g = 0; g < is_platen.size(); ++g)
          if (load->type == LoadType::platen
              && is_among(nodes.table().group_names[g], load->groups))
            is_platen[g] = true;
      std::vector<CellSize<dim>> sizes(n_materials);
      for (unsigned int c = 0; c < model.nodes().cells().n_deformable; ++c)
      {
        if (state.is_absent(nodes.blocks().block_of_cell(c))
            || is_platen[nodes.cells().group[c]])
          continue;
        const auto &cell = nodes.cells().nodes[c];
        std::array<double, dim *(dim + 1) / 2> edges;
        unsigned int n_edges = 0;
        for (unsigned int k = 0; k <= dim; ++k)
          for (unsigned int l = 0; l < k; ++l)
            edges[n_edges++]
                = nodes.point(cell[k]).distance(nodes.point(cell[l]));
        std::sort(edges.begin(), edges.end());
        const double edge   = edges[dim == 2 ? 1 : 2];
        CellSize<dim> &size = sizes[material_of_cell(model, c)];
        if (edge > size.edge)
          size = { edge, nodes.point(cell[0]) };
      }
      // The largest of all ranks; among equals that of the lowest rank.
      for (CellSize<dim> &size : sizes)
        for (const CellSize<dim> &other :
             dealii::Utilities::MPI::all_gather(nodes.communicator(), size))
          if (other.edge > size.edge)
            size = other;
      return sizes;
    }

    double shear_wave(const Parameters &parameters, const unsigned int material)
    {
      return wave_speeds(parameters.model.materials[material].elastic,
                         parameters.model.plane)
          .s;
    }

    template <int dim>
    void check_edges(const StageOfRun &run,
                     const std::vector<CellSize<dim>> &sizes, Checks &checks)
    {
      if (!run.stage.is_dynamic())
        return;
      const Shaking shaking = fastest_load(run.parameters, run.index);
      // The material in which its waves have the fewest edges.
      unsigned int worst = 0;
      double fewest = std::numeric_limits<double>::infinity(), length = 0.;
      for (unsigned int m = 0; m < sizes.size(); ++m)
      {
        const double wave = shear_wave(run.parameters, m) / shaking.frequency;
        if (sizes[m].edge > 0. && wave / sizes[m].edge < fewest)
        {
          worst  = m;
          fewest = wave / sizes[m].edge;
          length = wave;
        }
      }
      if (!(fewest < fewest_edges))
        return;
      const CellSize<dim> &size = sizes[worst];
      checks.warn_if(true, shaking.name, " brings frequencies of up to ",
                     shaking.frequency, " Hz, whose S waves are ", length,
                     " m long in the material ",
                     run.parameters.model.materials[worst].name,
                     ". They need eight to ten edges, but edges are up to ",
                     size.edge, " m long, at ", point_text(size.position),
                     " m. Refine the mesh there to ", 0.1 * length,
                     " m, or lower the frequency.");
    }

    /** Largest speed [m/s] at which loads of the stage move something. */
    double largest_speed(const StageOfRun &run)
    {
      constexpr unsigned int n = 1025;
      double largest           = 0.;
      for (const LoadParameters *load : run.loads)
        for (const auto &given : load->given_components())
        {
          const LoadQuantity quantity = given.component.quantity;
          if (quantity == LoadQuantity::force
              || given.name.rfind("rotation", 0) == 0)
            continue;
          auto values
              = sampled(run.function(given.component), run.stage.duration, n);
          if (quantity == LoadQuantity::displacement)
            values = derivative(values, run.stage.duration / (n - 1));
          for (const double v : values)
            largest = std::max(largest, std::abs(v));
        }
      return largest;
    }

    /** Range of the displacement that the samples @p values of @p quantity
        prescribe in @p duration [m]. */
    double travel_of(const std::vector<double> &values,
                     const LoadQuantity quantity, const double duration)
    {
      double now = 0., low = 0., high = 0.;
      for (const double v : values)
      {
        now  = quantity == LoadQuantity::displacement
                   ? v
                   : now + v * duration / double(values.size() - 1);
        low  = std::min(low, now);
        high = std::max(high, now);
      }
      return high - low;
    }

    /** Warns of boundaries that move by more than @p size, that of the model
        [m], and of steps beyond number: values in mm or ms do so. */
    void check_units(const StageOfRun &run, const double size,
                     const double time_step, Checks &checks)
    {
      constexpr double most_steps = 1e8;
      if (run.stage.end != StageEnd::time)
        return;
      for (const LoadParameters *load : run.loads)
        for (const auto &given : load->given_components())
        {
          if ((load->type != LoadType::prescribed_motion
               && load->type != LoadType::platen)
              || given.component.field || given.name.rfind("rotation", 0) == 0
              || given.component.quantity == LoadQuantity::force)
            continue;
          const double travel = travel_of(
              sampled(run.function(given.component), run.stage.duration, 1025),
              given.component.quantity, run.stage.duration);
          checks.warn_if(travel > size, "the load ", load->name, " moves by ",
                         travel, " m along '", given.name,
                         "', farther than the model is long, ", size,
                         " m. If its values are in mm or mm/s, give them in m "
                         "or m/s.");
        }
      const double n = run.stage.duration / time_step;
      checks.warn_if(n > most_steps, "its 'Duration = ", run.stage.duration,
                     "' s takes ", n, " steps. If it is in ms, give ",
                     1e-3 * run.stage.duration, " s.");
    }

    /** Largest acceleration that a load of gravity has along an axis
        [m/s^2]. */
    double largest_acceleration(const StageOfRun &run)
    {
      double largest = 0.;
      for (const LoadParameters *load : run.loads)
        if (load->type == LoadType::gravity)
          for (const auto &given : load->given_components())
            for (const double a : sampled(run.function(given.component),
                                          run.stage.duration, 1025))
              largest = std::max(largest, std::abs(a));
      return largest;
    }
  } // namespace

  namespace
  {
    const std::vector<JointSegment> &faces_of(const MatchedJoints &joints)
    {
      return joints.segments();
    }
    const std::vector<SpaceJointFace> &faces_of(const SpaceJoints &joints)
    {
      return joints.faces();
    }

    /** A joint at the side of a model, by what it does to a wave. */
    template <int dim>
    struct SideJoint
    {
      /** pi f Z/k with the impedance Z: tangent of the phase by which it delays
          a wave @cite Schoenberg1980 [-]. */
      double delay     = 0.;
      unsigned int set = 0;
      dealii::Point<dim> position;
    };

    /** Warns of joints that meet free fields, whose ground has none. */
    template <int dim>
    void check_joints_at_sides(const Model<dim> &model, const StageOfRun &run,
                               Checks &checks)
    {
      constexpr double least_delay = 0.05; // 3 degrees
      if (!run.stage.is_dynamic() || !run.has(LoadType::free_field))
        return;
      const NodeMap<dim> &nodes = model.nodes();
      std::vector<unsigned int> at_side;
      for (const LoadParameters *load : run.loads)
        if (load->type == LoadType::free_field)
          for (const BoundaryFace<dim> &face :
               faces_of_curves(nodes, load->boundaries, load->name))
            at_side.insert(at_side.end(), face.nodes.begin(), face.nodes.end());
      std::sort(at_side.begin(), at_side.end());
      const double frequency
          = fastest_load(run.parameters, run.index).frequency;
      SideJoint<dim> worst;
      for (const auto &face : faces_of(model.joints()))
        for (unsigned int k = 0; k < dim; ++k)
        {
          const JointNodes<dim> &joint = nodes.faces().joints[face.face];
          const unsigned int node      = face.lower[k];
          if (!std::binary_search(at_side.begin(), at_side.end(),
                                  nodes.exchange().global(node)))
            continue;
          const LinearElastic &rock
              = run.parameters.model
                    .materials[material_of_cell(
                        model, joint.cells[joint.is_own[0] ? 0 : 1])]
                    .elastic;
          const WaveSpeeds wave = wave_speeds(rock, run.parameters.model.plane);
          const auto [kn, ks]
              = stiffness_bound(run.parameters.model.joints[face.set].law);
          const double delay = constants::pi * frequency * rock.density
                               * std::max(wave.p / kn, wave.s / ks);
          if (delay > worst.delay)
            worst = { delay, face.set, nodes.point(node) };
        }
      for (const SideJoint<dim> &other :
           dealii::Utilities::MPI::all_gather(nodes.communicator(), worst))
        if (other.delay > worst.delay)
          worst = other;
      if (worst.delay > least_delay)
        checks.warn_if(
            true, "joints of the set ",
            run.parameters.model.joints[worst.set].name,
            " meet a free field, such as at ", point_text(worst.position),
            " m, whose ground has no joints: at ", frequency,
            " Hz one of them delays a wave by ",
            std::atan(worst.delay) / constants::degree,
            " degrees in the model and not beside it. Move the sides away, or "
            "leave the joints out near them.");
    }
  } // namespace

  bool wants_hoop_stress(const Parameters &parameters)
  {
    return std::any_of(
        parameters.histories.begin(), parameters.histories.end(),
        [](const HistoryParameters &history)
        { return history.quantity == HistoryQuantity::boundary_hoop_stress; });
  }

  Shaking fastest_load(const Parameters &parameters, const unsigned int index)
  {
    const StageOfRun run(parameters, index);
    Shaking fastest;
    for (const LoadParameters *load : run.loads)
      for (const auto &given : load->given_components())
        fastest.take_faster(
            "the load " + load->name,
            velocity_frequency(
                run.function(given.component),
                load->type == LoadType::gravity ? SignalKind::acceleration
                : given.component.quantity == LoadQuantity::displacement
                    ? SignalKind::displacement
                    : SignalKind::velocity,
                run.stage.duration));
    return fastest;
  }

  template <int dim>
  Advice stage_advice(const Parameters &parameters, const unsigned int index,
                      const Model<dim> &model, const State<dim> &state,
                      const double time_step)
  {
    const StageOfRun run(parameters, index);
    Advice advice;
    Checks checks(advice, "stage " + run.stage.name + ": ");
    check_control(run, checks);
    check_pattern_damping(run, checks);
    check_damping(run, checks);
    check_supports(run, checks);
    check_moving_water(run, checks);
    check_static_ratio(run, checks);
    check_units(run, model.nodes().table().diagonal(), time_step, checks);
    const auto sizes = cell_sizes(model, state, run);
    double rise = 0., passage = 0.;
    for (unsigned int m = 0; m < sizes.size(); ++m)
      if (sizes[m].edge > 0.)
      {
        const double speed = shear_wave(parameters, m);
        rise               = std::max(rise, 10. * sizes[m].edge / speed);
        passage
            = std::max(passage, 2. * model.nodes().table().diagonal() / speed);
      }
    check_pulses(run, passage, checks);
    check_overdamping(run, passage, checks);
    if (rise > 0.) // else nothing deforms
      check_jumps(run, rise, checks);
    check_edges(run, sizes, checks);
    check_joints_at_sides(model, run, checks);
    if constexpr (dim == 2)
      if (run.stage.is_dynamic() && parameters.model.large_displacements)
        check_soft_contacts(model, state,
                            { fastest_load(parameters, index),
                              largest_speed(run), largest_acceleration(run) },
                            checks);
    checks.warn_if(index == 0 && parameters.history_interval > 0.
                       && parameters.history_interval < time_step,
                   "'Interval = ", parameters.history_interval,
                   "' in section 'Histories' is shorter than the time step, ",
                   time_step,
                   " s: rows come at every step. Take a longer one, or 0 if "
                   "that is meant.");
    return advice;
  }

  template Advice stage_advice(const Parameters &, unsigned int,
                               const Model<2> &, const State<2> &, double);
  template Advice stage_advice(const Parameters &, unsigned int,
                               const Model<3> &, const State<3> &, double);
} // namespace quoin
