// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/absorbing/free_field_grid.h>
#include <quoin/loads/nodal_load.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    /** Distance below which points coincide, by the smallest edge [-]. */
    constexpr double same_place_share = 1e-6;

    FreeFieldGrid::Place place_of(const dealii::Point<3> &point)
    {
      return { { point[0], point[1], point[2] } };
    }
  } // namespace

  FreeFieldGrid::FreeFieldGrid(
      const std::string &load, const std::vector<BoundaryFace<3>> &faces,
      const FreeFieldGround &ground,
      const std::map<Place, std::optional<Impedance>> &base,
      const std::string &base_name)
    : load(load)
  {
    make_triangles(faces, ground);
    const auto edges = outline(faces);
    make_foot(edges, base, base_name);

    // The ends are the first and last places along the side.
    std::array<double, 2> ends = { { std::numeric_limits<double>::max(),
                                     std::numeric_limits<double>::lowest() } };
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      ends[0] = std::min(ends[0], way(i));
      ends[1] = std::max(ends[1], way(i));
    }
    refuse_gaps(edges, ends);
    for (const unsigned int end : { 0, 1 })
    {
      std::vector<Edge> at_end;
      for (const Edge &edge : edges)
        if (std::abs(way(edge.nodes[0]) - ends[end]) < same_place_share * size
            && std::abs(way(edge.nodes[1]) - ends[end])
                   < same_place_share * size)
          at_end.push_back(edge);
      make_column(end, at_end, ground);
    }
    for (const Tie &tie : ties)
      for (unsigned int k = 0; k < tie.dashpot.damping.size(); ++k)
        dashpots[tie.node].damping[k] += tie.dashpot.damping[k];
    force.resize(places.size());
    mean_velocity.resize(places.size());
  }

  double FreeFieldGrid::way(const unsigned int node) const
  {
    return along * Vector({ places[node][0], places[node][1], 0. });
  }

  void FreeFieldGrid::refuse_gaps(const std::vector<Edge> &outline,
                                  const std::array<double, 2> &ends) const
  {
    const double near = same_place_share * size;
    for (const Edge &edge : outline)
    {
      const auto &[a, b]  = edge.nodes;
      const double length = way(b) - way(a);
      bool is_open;
      if (std::abs(length) < near) // vertical
        is_open
            = std::min(std::abs(way(a) - ends[0]), std::abs(way(a) - ends[1]))
              < near;
      else
      {
        const double share = (way(edge.opposite) - way(a)) / length;
        const double below
            = places[a][2] + share * (places[b][2] - places[a][2]);
        is_open
            = places[edge.opposite][2] < below || places[b][2] - foot <= near;
      }
      if (!is_open)
        fail_free_field(load, "Boundary",
                        "has a gap, a hole or a step in its foot at "
                            + place_text(a)
                            + ": the ground beside the model goes on there. "
                              "Make the side one piece on one foot.");
    }
  }

  std::string FreeFieldGrid::place_text(const unsigned int node) const
  {
    const auto &[x, y, z] = places[node];
    return text_of("(", x, ", ", y, ", ", z, ") m");
  }

  // -- what is constant ------------------------------------------------------

  void FreeFieldGrid::make_triangles(const std::vector<BoundaryFace<3>> &faces,
                                     const FreeFieldGround &ground)
  {
    // Numbers follow from places: those of the model differ with the ranks.
    std::map<Place, unsigned int> nodes;
    for (const BoundaryFace<3> &face : faces)
      for (const auto &p : face.points)
        nodes[place_of(p)] = 0;
    for (auto &[place, number] : nodes)
    {
      number = places.size();
      places.push_back(place);
    }
    node_mass.resize(places.size());
    const Vector normal = outward_area(faces.front().points);
    along               = Vector({ -normal[1], normal[0], 0. }) / normal.norm();
    size                = std::numeric_limits<double>::max();
    for (const BoundaryFace<3> &face : faces)
    {
      Triangle triangle;
      const auto &p        = face.points;
      const Vector outward = outward_area(p);
      triangle.area        = outward.norm();
      for (unsigned int k = 0; k < 3; ++k)
      {
        triangle.nodes[k]     = nodes.at(place_of(p[k]));
        const Vector opposite = p[(k + 2) % 3] - p[(k + 1) % 3];
        size                  = std::min(size, opposite.norm());
        triangle.gradients[k]
            = dealii::cross_product_3d(outward / triangle.area, opposite)
              / (2. * triangle.area);
      }
      check_free_field_ground(load, ground, face.group,
                              place_text(triangle.nodes[0]));
      const LinearElastic &material = ground.materials[face.group];
      triangle.density              = material.density;
      triangle.stiffness            = space_stiffness(material);
      for (const unsigned int node : triangle.nodes)
        node_mass[node] += material.density * triangle.area / 3.;
      triangles.push_back(triangle);
    }
    foot = std::numeric_limits<double>::max();
    for (const Place &place : places)
      foot = std::min(foot, place[2]);
  }

  std::vector<FreeFieldGrid::Edge>
  FreeFieldGrid::outline(const std::vector<BoundaryFace<3>> &faces) const
  {
    struct Side
    {
      unsigned int group, opposite;
    };
    std::map<std::array<unsigned int, 2>, std::vector<Side>> edges;
    for (unsigned int f = 0; f < faces.size(); ++f)
      for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int a = node_of(f, k), b = node_of(f, (k + 1) % 3);
        edges[{ { std::min(a, b), std::max(a, b) } }].push_back(
            { faces[f].group, node_of(f, (k + 2) % 3) });
      }
    std::vector<Edge> result;
    for (const auto &[nodes, sides] : edges)
      if (sides.size() == 1)
      {
        auto [a, b] = nodes;
        if (places[a][2] > places[b][2])
          std::swap(a, b);
        result.push_back({ { { a, b } }, sides[0].group, sides[0].opposite });
      }
    return result;
  }

  void FreeFieldGrid::make_foot(
      const std::vector<Edge> &outline,
      const std::map<Place, std::optional<Impedance>> &base,
      const std::string &base_name)
  {
    for (const Edge &edge : outline)
    {
      const auto &[a, b] = edge.nodes;
      if (places[b][2] - foot > same_place_share * size)
        continue;
      const double width = std::hypot(places[a][0] - places[b][0],
                                      places[a][1] - places[b][1]);
      for (const unsigned int node : edge.nodes)
      {
        const auto found = base.find(places[node]);
        if (found == base.end())
          fail_free_field(load, "Base",
                          "is '" + base_name
                              + "', which does not meet the foot of the side "
                                "at "
                              + place_text(node)
                              + ": it must be the load on the boundary "
                                "below.");
        if (!found->second)
          fail_free_field(load, "Base",
                          "is '" + base_name
                              + "', before different materials at the foot of "
                                "the side at "
                              + place_text(node)
                              + ". Name one as its 'Far field material'.");
        const Impedance &z = *found->second;
        Support &support   = supports[node];
        support.impedance  = Vector({ z.shear, z.shear, z.normal });
        support.width += 0.5 * width;
      }
    }
    if (supports.empty())
      fail_free_field(load, "Boundary",
                      "has no horizontal foot, but its lowest point at the "
                      "height "
                          + text_of(foot)
                          + " m: give it one on the load of 'Base'.");
    for (const auto &[node, support] : supports)
      for (unsigned int d = 0; d < 3; ++d)
        dashpots[node].damping[d] += support.width * support.impedance[d];
  }

  void FreeFieldGrid::make_column(const unsigned int end,
                                  std::vector<Edge> edges,
                                  const FreeFieldGround &ground)
  {
    std::sort(edges.begin(), edges.end(),
              [&](const Edge &a, const Edge &b)
              { return places[a.nodes[0]][2] < places[b.nodes[0]][2]; });
    if (edges.empty() || !supports.count(edges.front().nodes[0]))
      fail_free_field(
          load, "Boundary",
          "has an end that is no vertical edge from its foot, at the height "
              + text_of(foot)
              + " m, up: a column of ground cannot stand there.");
    FreeFieldColumn<3> column(foot);
    column.set_base(supports[edges.front().nodes[0]].impedance);
    const Vector outward = end == 0 ? -along : along;
    for (unsigned int e = 0; e < edges.size(); ++e)
    {
      const auto &[low, high] = edges[e].nodes;
      if (e > 0 && low != edges[e - 1].nodes[1])
        fail_free_field(load, "Boundary",
                        "has a gap between " + place_text(edges[e - 1].nodes[1])
                            + " and " + place_text(low)
                            + ": the column needs all of the edge.");
      const LinearElastic &material = ground.materials[edges[e].group];
      const double height           = places[high][2] - places[low][2];
      column.add_layer(
          { height, 1., material.density,
            plane_stiffness(material, PlaneAssumption::plane_strain) },
          places[high][2]);
      const Vector half = 0.5 * height * outward;
      for (const unsigned int k : { 0, 1 })
      {
        const unsigned int node = edges[e].nodes[k];
        shares.push_back({ node, end, e, half });
        ties.push_back({ node, end, e + k, {} });
        ties.back().dashpot.add(
            half, impedance_of(material, PlaneAssumption::plane_strain));
      }
    }
    columns.push_back(column);
  }

  double FreeFieldGrid::largest_eigenvalue() const
  {
    double largest = std::max(columns[0].largest_eigenvalue(),
                              columns[1].largest_eigenvalue());
    for (const Triangle &triangle : triangles)
    {
      // In the plane twice the energy is at most 2 (lambda + mu) |grad u|^2,
      // and |grad u|^2 by |u|^2 the larger eigenvalue of the sum of g g^T.
      double xx = 0., zz = 0., xz = 0.;
      for (const Vector &gradient : triangle.gradients)
      {
        const double x = gradient * along;
        xx += x * x;
        zz += gradient[2] * gradient[2];
        xz += x * gradient[2];
      }
      const double squares = 0.5 * (xx + zz) + std::hypot(0.5 * (xx - zz), xz);
      const auto &[lambda, mu] = triangle.stiffness;
      const double modulus     = 2. * (std::max(lambda, 0.) + mu);
      largest = std::max(largest, 3. * modulus * squares / triangle.density);
    }
    return largest;
  }

  // -- a step ----------------------------------------------------------------

  void FreeFieldGrid::add_stresses(const StepContext &step,
                                   const double *const u, const double *const v)
  {
    for (Triangle &triangle : triangles)
    {
      dealii::Tensor<2, 3> gradient;
      for (unsigned int k = 0; k < 3; ++k)
        gradient += outer_product(
            vector_at<3>(u, triangle.nodes[k])
                + step.stiffness_damping * vector_at<3>(v, triangle.nodes[k]),
            triangle.gradients[k]);
      const auto strain        = symmetrize(gradient);
      const auto &[lambda, mu] = triangle.stiffness;
      triangle.stress
          = 2. * mu * strain
            + lambda * trace(strain) * dealii::unit_symmetric_tensor<3>();
      for (unsigned int k = 0; k < 3; ++k)
        force[triangle.nodes[k]]
            -= triangle.area * (triangle.stress * triangle.gradients[k]);
    }
  }

  void FreeFieldGrid::advance(const StepContext &step,
                              const FreeFieldFoot<3> &driver, double *const u,
                              double *const v)
  {
    std::size_t first = 3 * places.size();
    for (FreeFieldColumn<3> &column : columns)
    {
      column.advance(step, driver, u + first, v + first);
      first += 3 * column.n_nodes();
    }
    std::fill(force.begin(), force.end(), Vector());
    add_stresses(step, u, v);
    for (const Share &share : shares)
      columns[share.column].add_force(share.layer, share.area,
                                      force[share.node]);
    for (const Tie &tie : ties)
      tie.dashpot.add_drag(columns[tie.column].velocity(tie.column_node),
                           force[tie.node]);

    for (const auto &[node, support] : supports)
      for (unsigned int d = 0; d < 3; ++d)
        force[node][d] += 2. * support.width * support.impedance[d]
                          * driver.incident(d, step);
    const double a = 0.5 * step.dt_velocity * step.mass_damping;
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      const Vector before = vector_at<3>(v, i);
      Vector after
          = ((1. - a) * before + step.dt_velocity / node_mass[i] * force[i])
            / (1. + a);
      std::array<bool, 3> prescribed{};
      if (supports.count(i))
        for (unsigned int d = 0; d < 3; ++d)
          if (driver.prescribes(d))
          {
            prescribed[d] = true;
            after[d]      = driver.velocity(d, step);
          }
      const auto held = dashpots.find(i);
      if (held != dashpots.end())
        after = velocity_with_dashpot<3>(step, node_mass[i], before,
                                         held->second.damping, force[i],
                                         prescribed, after);
      mean_velocity[i] = 0.5 * (before + after);
      set_vector<3>(v, i, after);
      for (unsigned int d = 0; d < 3; ++d)
        u[3 * i + d] += step.dt * after[d];
    }
  }

  Vector FreeFieldGrid::velocity(const unsigned int node) const
  {
    return mean_velocity[node];
  }
} // namespace quoin
