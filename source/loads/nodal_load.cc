// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/lanes.h>
#include <quoin/base/nearest_name.h>
#include <quoin/loads/joint_crack.h>
#include <quoin/loads/load_field.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/signals/time_function.h>
#include <quoin/loads/traction_field.h>
#include <quoin/loads/water_pressure.h>
#include <quoin/mesh/kind_text.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {
    /** Error of the length of a crack in equilibrium, by that of its joint. */
    constexpr double crack_tolerance = 1e-6;
    /** Bounds of its relaxation. */
    constexpr double least_relaxation = 0.05, most_relaxation = 4.;

    /** Throws an InputError if one of @p values that a distribution has given
        is no finite number on any rank. */
    void check_distribution(const std::string &load,
                            const std::vector<double> &values,
                            const MPI_Comm communicator)
    {
      const bool is_wrong
          = std::any_of(values.begin(), values.end(),
                        [](const double f) { return !std::isfinite(f); });
      if (dealii::Utilities::MPI::max(unsigned(is_wrong), communicator) > 0)
        throw InputError("section 'Loads/" + load
                         + "': 'Distribution' is no finite number somewhere "
                           "where the load acts. Give an expression that has a "
                           "value everywhere.");
    }

    /** Sum of velocities times weights; x and y at once, as compilers make many
        shuffles of what they vectorise by themselves. */
    template <int dim>
    struct WeightedVelocities
    {

      Two xy{};
      double z = 0.;

      void add(const double weight, const dealii::Tensor<1, dim> &velocity)
      {
        xy += weight * reinterpret_cast<const Two &>(velocity);
        if constexpr (dim == 3)
          z += weight * velocity[2];
      }
      dealii::Tensor<1, dim> sum() const
      {
        dealii::Tensor<1, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = d < 2 ? xy[d] : z;
        return result;
      }
    };

    unsigned int position(const std::vector<std::string> &names,
                          const std::string &name, const std::string &load,
                          const std::string &parameter, const std::string &kind)
    {
      const auto found = std::find(names.begin(), names.end(), name);
      if (name.empty() || found == names.end())
        throw InputError("section 'Loads/" + load + "': '" + parameter + " = "
                         + name + "', but the mesh has no " + kind
                         + " of that name. It has: "
                         + known_names_like(name, names) + ".");
      return found - names.begin();
    }
  } // namespace

  dealii::Tensor<1, 2>
  outward_area(const std::array<dealii::Point<2>, 2> &points)
  {
    // The block is on the left of an edge.
    const auto edge = points[1] - points[0];
    return dealii::Tensor<1, 2>({ edge[1], -edge[0] });
  }

  dealii::Tensor<1, 3>
  outward_area(const std::array<dealii::Point<3>, 3> &points)
  {
    return 0.5
           * dealii::cross_product_3d(points[1] - points[0],
                                      points[2] - points[0]);
  }

  template <int dim>
  std::vector<BoundaryFace<dim>>
  faces_of_curves(const NodeMap<dim> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load, const bool with_joints)
  {
    const auto &face_names = node_map.table().face_names;
    std::vector<BoundaryFace<dim>> faces;
    for (const auto &name : names)
    {
      if (std::count(names.begin(), names.end(), name) > 1)
        throw InputError("section 'Loads/" + load + "': 'Boundary' names '"
                         + name
                         + "' twice, and the load would act on it twice. Name "
                           "it once.");
      if (name == "unnamed" && !is_among(name, face_names))
        throw InputError(std::string("section 'Loads/") + load
                         + "': 'Boundary = unnamed', but a load needs a "
                         + boundary_kind<dim>
                         + " with a name, in joints as well. Give one to these "
                           "joints in the mesh, and name it here and among the "
                           "'Curves' of their set in section 'Joints'.");
      const unsigned int line
          = position(face_names, name, load, "Boundary", boundary_kind<dim>);
      std::vector<bool> wanted(face_names.size(), false);
      wanted[line]     = true;
      const auto found = gather_faces(node_map, wanted, with_joints);
      faces.insert(faces.end(), found.begin(), found.end());
      if (found.empty())
        throw InputError("section 'Loads/" + load + "': 'Boundary = " + name
                         + (dim == 2 ? "' has no edge" : "' has no face")
                         + " on the outer boundary of a block. Name a boundary "
                         + (dim == 2 ? "curve" : "surface")
                         + ". A joint may be named by a load of the type "
                           "'traction' that has a 'Pressure' alone, which then "
                           "acts on both of its faces.");
    }
    return faces;
  }

  template <int dim>
  std::vector<unsigned int>
  groups_of_names(const NodeMap<dim> &node_map,
                  const std::vector<std::string> &names,
                  const std::string &load)
  {
    std::vector<unsigned int> groups;
    for (const auto &name : names)
      groups.push_back(position(node_map.table().group_names, name, load,
                                "Group", group_kind<dim>));
    return groups;
  }

  namespace
  {
    /** The nodes of @p groups, of all if there are none. Collective. */
    template <int dim>
    std::vector<unsigned int>
    nodes_of_groups(const NodeMap<dim> &node_map,
                    const std::vector<unsigned int> &groups,
                    const std::string &load)
    {
      // How many cells each node has in these groups, and how many others.
      std::vector<dealii::Tensor<1, dim>> count(node_map.n_local());
      const LocalCells<dim> &cells = node_map.cells();
      for (unsigned int c = 0; c < cells.size(); ++c)
      {
        const bool is_in
            = groups.empty()
              || std::count(groups.begin(), groups.end(), cells.group[c]) > 0;
        for (const unsigned int node : cells.nodes[c])
          count[node][is_in ? 0 : 1] += 1.;
      }
      node_map.exchange().add_to_owners(count.data());
      std::vector<unsigned int> nodes;
      bool is_shared = false;
      for (unsigned int i = 0; i < node_map.n_owned(); ++i)
        if (count[i][0] > 0.)
        {
          is_shared = is_shared || count[i][1] > 0.;
          nodes.push_back(i);
        }
      if (dealii::Utilities::MPI::max(unsigned(is_shared),
                                      node_map.communicator())
          > 0)
        throw InputError("section 'Loads/" + load
                         + "': a block lies only in part within 'Groups'. "
                           "Name all of its groups, or part them by a joint.");
      return nodes;
    }
  } // namespace

  template <int dim>
  NodalLoad<dim>::NodalLoad(const LoadParameters &parameters,
                            const NodeMap<dim> &node_map,
                            const std::vector<double> &mass,
                            const Thickness &thickness)
    : load_name(parameters.name), own_traits{ parameters.type
                                                  == LoadType::gravity,
                                              parameters.type
                                                      == LoadType::gravity
                                                  && parameters.groups.empty()
                                                  && !parameters.distribution },
      components(parameters.components), pressure(parameters.pressure),
      given_ramp(own_traits.is_gravity ? parameters.ramp_duration : -1.)
  {
    if (own_traits.is_gravity)
    {
      nodes = nodes_of_groups(
          node_map, groups_of_names(node_map, parameters.groups, load_name),
          load_name);
      weights.resize(nodes.size());
      find_factors(parameters, node_map);
      set_mass(mass);
      return;
    }
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, parameters.name,
                          parameters.is_pressure_alone());
    if (parameters.is_pressure_alone())
      own_joints = PressedJoints(node_map, parameters.boundaries, thickness);
    LoadParameters others = parameters;
    if (parameters.is_water_that_follows())
    {
      water = std::make_shared<WaterPressure<dim>>(*pressure.field, node_map,
                                                   faces, thickness);
      pressure.value  = mixture(*pressure.field, sample_places(faces), dim - 1);
      others.pressure = {};
    }
    if (!parameters.is_pressure_alone() || !water)
      find_areas(others, node_map, faces, thickness);
  }

  template <int dim>
  void NodalLoad<dim>::find_areas(const LoadParameters &parameters,
                                  const NodeMap<dim> &node_map,
                                  const std::vector<BoundaryFace<dim>> &faces,
                                  const Thickness &thickness)
  {
    if (parameters.differs_by_place())
      return make_field(parameters, node_map, faces, thickness);
    if (parameters.distribution)
      return find_distributed_areas(parameters, node_map, faces, thickness);
    std::map<unsigned int, double> area;
    std::map<unsigned int, dealii::Tensor<1, dim>> inward_area;
    for (const BoundaryFace<dim> &face : faces)
    {
      const dealii::Tensor<1, dim> outward
          = thickness.common(face.group, face.across)
            * outward_area(face.points);
      for (unsigned int k = 0; k < dim; ++k)
        if (node_map.exchange().owns(face.nodes[k]))
        {
          const unsigned int node = node_map.exchange().local(face.nodes[k]);
          const double share      = face.shares[k];
          area[node] += share * outward.norm();
          for (unsigned int d = 0; d < dim; ++d)
            inward_area[node][d] -= share * outward[d];
        }
    }
    for (const auto &[node, weight] : area)
    {
      nodes.push_back(node);
      weights.push_back(weight);
      if (parameters.pressure.quantity != LoadQuantity::free)
        inward.push_back(inward_area[node]);
    }
  }

  template <int dim>
  void NodalLoad<dim>::make_field(const LoadParameters &parameters,
                                  const NodeMap<dim> &node_map,
                                  const std::vector<BoundaryFace<dim>> &faces,
                                  const Thickness &thickness)
  {
    shape                  = parameters.shape;
    const auto places      = sample_places(faces);
    LoadParameters sampled = parameters;
    for (LoadComponent *part : { &sampled.components[0], &sampled.components[1],
                                 &sampled.components[2], &sampled.pressure })
      if (part->field)
        part->value = mixture(*part->field, places, dim - 1);
    components = sampled.components;
    if (!water)
      pressure = sampled.pressure;
    field = std::make_shared<TractionField<dim>>(sampled, node_map, faces,
                                                 thickness);
    nodes = field->nodes();
  }

  template <int dim>
  void NodalLoad<dim>::follow(const State<dim> &state, const double released)
  {
    if (water)
      water->follow(state.nodes);
    if constexpr (dim == 2)
      if (crack)
      {
        crack_share = begins_here ? released : 1.;
        field->set_crack(crack->length(state));
        relaxation   = 1.;
        crack_excess = 0.;
      }
  }

  template <int dim>
  void NodalLoad<dim>::return_to_mesh()
  {
    if (water)
      water->return_to_mesh();
  }

  template <int dim>
  void NodalLoad<dim>::linearise(State<dim> &state, const bool with_stiffness,
                                 const TakeElement<dim> &take) const
  {
    if (!water)
      return;
    water->follow(state.nodes);
    water->linearise({ state.load_time, state.load_start() + state.load_time },
                     own_growth.share(state.load_time), with_stiffness, take);
  }

  template <int dim>
  bool NodalLoad<dim>::follow_crack(const State<dim> &state)
  {
    if constexpr (dim == 2)
      if (crack)
      {
        const double before = crack_excess, used = field->crack();
        crack_excess = crack->length(state) - used;
        if (std::abs(crack_excess)
            <= crack_tolerance * pressure.field->uplift()->length())
          return true;
        // Aitken's relaxation.
        if (before != 0. && before != crack_excess)
          relaxation = std::clamp(relaxation * before / (before - crack_excess),
                                  least_relaxation, most_relaxation);
        field->set_crack(std::max(0., used + relaxation * crack_excess));
        return false;
      }
    return true;
  }

  template <int dim>
  void NodalLoad<dim>::find_distributed_areas(
      const LoadParameters &parameters, const NodeMap<dim> &node_map,
      const std::vector<BoundaryFace<dim>> &faces, const Thickness &thickness)
  {
    const LoadComponent one{ LoadQuantity::force, TimeFunction("1", "./") };
    LoadParameters unit = parameters;
    unit.components     = { one, LoadComponent(), LoadComponent() };
    unit.pressure       = LoadComponent();
    const TractionField<dim> along_x(unit, node_map, faces, thickness);
    nodes = along_x.nodes();
    for (const dealii::Tensor<1, dim> &force : along_x.forces({ 0., 0. }))
      weights.push_back(force[0]);
    if (pressure.quantity != LoadQuantity::free)
    {
      unit.components = {};
      unit.pressure   = one;
      inward          = TractionField<dim>(unit, node_map, faces, thickness)
                   .forces({ 0., 0. });
    }
    check_distribution(load_name, weights, node_map.communicator());
  }

  template <int dim>
  void NodalLoad<dim>::find_factors(const LoadParameters &parameters,
                                    const NodeMap<dim> &node_map)
  {
    if (!parameters.distribution)
      return;
    const auto value = [&](const dealii::Point<dim> &point)
    {
      dealii::Point<3> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = point[d];
      return (*parameters.distribution)(place, 0.);
    };
    const LocalCells<dim> &cells = node_map.cells();
    if (cells.is_quadratic)
      // The rule that has its points in the middle of the edges is exact.
      for (const unsigned int node : nodes)
        node_factors.push_back(value(node_map.point(node)));
    else
    {
      // The mean of the function with the linear one of each node as weight.
      std::vector<dealii::Tensor<1, 2>> sums(node_map.n_local());
      const dealii::QGaussSimplex<dim> rule(2);
      for (const auto &vertices : cells.nodes)
      {
        const dealii::Point<dim> &first = node_map.point(vertices[0]);
        dealii::Tensor<2, dim> edges;
        for (unsigned int k = 0; k < dim; ++k)
          edges[k] = node_map.point(vertices[k + 1]) - first;
        const double volume = dealii::determinant(edges);
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          dealii::Point<dim> point = first;
          std::array<double, dim + 1> coordinates;
          coordinates[0] = 1.;
          for (unsigned int k = 0; k < dim; ++k)
          {
            coordinates[k + 1] = rule.point(q)[k];
            coordinates[0] -= coordinates[k + 1];
            point += coordinates[k + 1] * edges[k];
          }
          const double f = value(point);
          for (unsigned int k = 0; k <= dim; ++k)
          {
            const double weight = coordinates[k] * rule.weight(q) * volume;
            sums[vertices[k]] += dealii::Tensor<1, 2>({ weight, weight * f });
          }
        }
      }
      node_map.exchange().add_to_owners(sums.data());
      for (const unsigned int node : nodes)
        node_factors.push_back(sums[node][1] / sums[node][0]);
    }
    check_distribution(load_name, node_factors, node_map.communicator());
  }

  template <int dim>
  void NodalLoad<dim>::set_mass(const std::vector<double> &mass)
  {
    if (!own_traits.is_gravity)
      return;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      weights[i]
          = mass[nodes[i]] * (node_factors.empty() ? 1. : node_factors[i]);
  }

  template <int dim>
  std::array<double, 5> NodalLoad<dim>::amplitude(const TimePoint &time) const
  {
    double place = water ? double(water->n_moves()) : 0.;
    if (shape)
      for (const double centre : shape->at(time))
        place = 0.5 * place + centre;
    const auto [x, y, z] = component_values(components, time);
    const double share   = own_growth.share(time.stage);
    return { share * x, share * y, share * z,
             pressure.quantity == LoadQuantity::free
                 ? 0.
                 : share * pressure.value(time),
             place };
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  NodalLoad<dim>::forces_of_share(const TimePoint &time) const
  {
    std::vector<dealii::Tensor<1, dim>> forces = field->forces(time);
    const double used                          = field->crack();
    field->set_crack(0.);
    const auto &closed = field->forces(time);
    for (unsigned int i = 0; i < forces.size(); ++i)
      forces[i] = closed[i] + crack_share * (forces[i] - closed[i]);
    field->set_crack(used);
    return forces;
  }

  template <int dim>
  template <typename Loop>
  auto NodalLoad<dim>::by_nodes(const Loop &loop) const
  {
    // Nodes of gravity ascend.
    if (own_traits.is_gravity && !nodes.empty()
        && nodes.back() - nodes.front() + 1 == nodes.size())
      return loop([first = std::size_t(nodes.front())](const std::size_t i)
                  { return first + i; });
    return loop([this](const std::size_t i) { return nodes[i]; });
  }

  template <int dim>
  void NodalLoad<dim>::add_loads(const TimePoint &time,
                                 dealii::Tensor<1, dim> *force) const
  {
    if (water)
    {
      const auto &forces = water->forces(time);
      const double share = own_growth.share(time.stage);
      for (unsigned int i = 0; i < forces.size(); ++i)
        force[water->nodes()[i]] += share * forces[i];
    }
    if (field)
    {
      std::vector<dealii::Tensor<1, dim>> part;
      const auto *forces = &field->forces(time);
      if (crack_share != 1.)
      {
        part   = forces_of_share(time);
        forces = &part;
      }
      const double share = own_growth.share(time.stage);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          force[nodes[i]][d] += share * (*forces)[i][d];
      return;
    }
    const auto values = amplitude(time);
    by_nodes(
        [&](const auto &node)
        {
          for (std::size_t i = 0; i < weights.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              force[node(i)][d] += values[d] * weights[i];
        });
    for (unsigned int i = 0; i < inward.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        force[nodes[i]][d] += values[3] * inward[i][d];
  }

  template <int dim>
  double
  NodalLoad<dim>::external_power(const TimePoint &time,
                                 const dealii::Tensor<1, dim> *velocity) const
  {
    double of_water = 0.;
    if (water)
    {
      const auto &forces = water->forces(time);
      for (unsigned int i = 0; i < forces.size(); ++i)
        of_water += forces[i] * velocity[water->nodes()[i]];
      of_water *= own_growth.share(time.stage);
    }
    if (field)
    {
      double power       = 0.;
      const auto &forces = field->forces(time);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          power += forces[i][d] * velocity[nodes[i]][d];
      return own_growth.share(time.stage) * power + of_water;
    }
    const dealii::Tensor<1, dim> sum = by_nodes(
        [&](const auto &node)
        {
          // Several sums, none of which waits for the others.
          constexpr std::size_t n_sums = 4;
          WeightedVelocities<dim> sums[n_sums];
          std::size_t i = 0;
          for (; i + n_sums <= weights.size(); i += n_sums)
            for (std::size_t s = 0; s < n_sums; ++s)
              sums[s].add(weights[i + s], velocity[node(i + s)]);
          for (; i < weights.size(); ++i)
            sums[0].add(weights[i], velocity[node(i)]);
          return (sums[0].sum() + sums[1].sum())
                 + (sums[2].sum() + sums[3].sum());
        });
    double inflow = 0.;
    for (unsigned int i = 0; i < inward.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        inflow += inward[i][d] * velocity[nodes[i]][d];
    const auto values = amplitude(time);
    double power      = values[3] * inflow + of_water;
    for (unsigned int d = 0; d < dim; ++d)
      power += values[d] * sum[d];
    return power;
  }

  template <int dim>
  bool NodalLoad<dim>::has_same_power(const TimePoint &one,
                                      const TimePoint &other) const
  {
    return !field && !water
           && std::min(one.stage, other.stage) >= own_growth.rest()
           && pressure.value.is_constant()
           && std::all_of(components.begin(), components.end(),
                          [](const LoadComponent &component)
                          { return component.value.is_constant(); });
  }

  template class NodalLoad<2>;
  template std::vector<BoundaryFace<2>>
  faces_of_curves(const NodeMap<2> &, const std::vector<std::string> &,
                  const std::string &, bool);
  template std::vector<unsigned int>
  groups_of_names(const NodeMap<2> &, const std::vector<std::string> &,
                  const std::string &);

  template class NodalLoad<3>;
  template std::vector<BoundaryFace<3>>
  faces_of_curves(const NodeMap<3> &, const std::vector<std::string> &,
                  const std::string &, bool);
  template std::vector<unsigned int>
  groups_of_names(const NodeMap<3> &, const std::vector<std::string> &,
                  const std::string &);
} // namespace quoin
