// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/base/point_text.h>
#include <quoin/operators/archive.h>
#include <quoin/absorbing/free_field_boundary.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/motions/prescribed_motion.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    /** Relative distance below which points coincide [-]. */
    constexpr double same_share = 1e-6;

    std::string at(const double x, const double y)
    {
      return point_text(dealii::Point<2>(x, y)) + " m";
    }

    std::string at(const dealii::Point<3> &p)
    {
      return point_text(p) + " m";
    }

    /** An edge of a side in the plane. */
    struct SideEdge
    {
      double bottom, top;
      unsigned int group;
    };

    /** The edges of @p faces, from below, which must be one vertical side. */
    std::vector<SideEdge>
    edges_of_side(const std::string &load,
                  const std::vector<BoundaryFace<2>> &faces,
                  const FreeFieldGround &ground)
    {
      // Edges point up where the cells are on the left of the side.
      const auto direction = [](const BoundaryFace<2> &face)
      { return face.points[1][1] > face.points[0][1]; };
      const double x = faces.front().points[0][0];
      std::vector<SideEdge> edges;
      for (const BoundaryFace<2> &face : faces)
      {
        const auto &a     = face.points[0];
        const auto &b     = face.points[1];
        const double near = same_share * a.distance(b);
        if (std::abs(b[0] - a[0]) > near || std::abs(a[0] - x) > near
            || direction(face) != direction(faces.front()))
          fail_free_field(
              load, "Boundary",
              "must be one vertical side of the model, but has an edge from "
                  + at(a[0], a[1]) + " to " + at(b[0], b[1])
                  + " that is not vertical, not in line with the first one or "
                    "on the other side of its block. Give each side a load of "
                    "its own.");
        check_free_field_ground(load, ground, face.group, at(a[0], a[1]));
        edges.push_back(
            { std::min(a[1], b[1]), std::max(a[1], b[1]), face.group });
      }
      std::sort(edges.begin(), edges.end(),
                [](const SideEdge &a, const SideEdge &b)
                { return a.bottom < b.bottom; });
      return edges;
    }

    FreeFieldColumn<2> column_beside(const std::string &load, const double x,
                                     const std::vector<SideEdge> &edges,
                                     const FreeFieldGround &ground)
    {
      FreeFieldColumn<2> column(edges.front().bottom);
      for (const SideEdge &edge : edges)
      {
        const double below  = column.heights().back();
        const double height = edge.top - below;
        if (std::abs(edge.bottom - below) > same_share * height)
          fail_free_field(load, "Boundary",
                          "has a gap between " + at(x, below) + " and "
                              + at(x, edge.bottom)
                              + ": the column needs all of the side.");
        const LinearElastic &material = ground.materials[edge.group];
        column.add_layer({ height, ground.thickness[edge.group],
                           material.density,
                           plane_stiffness(material, ground.plane) },
                         edge.top);
      }
      return column;
    }

    /** Impedance of the horizontal base for a column of the width 1. */
    Impedance impedance_below(const std::string &load, const double x,
                              const FreeFieldColumn<2> &column,
                              const std::vector<BoundaryFace<2>> &base_faces,
                              const FreeFieldBase &given)
    {
      const double foot = column.heights().front();
      const double near = same_share * column.layer(0).height;
      for (const BoundaryFace<2> &face : base_faces)
      {
        const auto &a = face.points[0];
        const auto &b = face.points[1];
        for (const auto &p : { a, b })
        {
          if (std::abs(p[0] - x) > near || std::abs(p[1] - foot) > near)
            continue;
          if (std::abs(a[1] - b[1]) > near)
            fail_free_field(load, "Base",
                            "is '" + given.load.name
                                + "', which is not horizontal at " + at(x, foot)
                                + ": waves would not propagate vertically from "
                                  "it.");
          return given.impedance[face.group];
        }
      }
      fail_free_field(load, "Base",
                      "is '" + given.load.name
                          + "', which does not meet the foot of the "
                            "side at "
                          + at(x, foot)
                          + ": it must be the load on the boundary below.");
    }

    /** Impedances below the nodes of the base, 0 where motion is prescribed,
        none where different ones meet; where no side can stand, on faces that
        are not horizontal, no entry. */
    std::map<FreeFieldGrid::Place, std::optional<Impedance>>
    impedances_below(const std::vector<BoundaryFace<3>> &base_faces,
                     const FreeFieldBase &given, const bool is_prescribed)
    {
      std::map<FreeFieldGrid::Place, std::optional<Impedance>> result;
      for (const BoundaryFace<3> &face : base_faces)
      {
        const auto outward = outward_area(face.points);
        if (std::hypot(outward[0], outward[1]) <= same_share * outward.norm())
          for (const auto &p : face.points)
          {
            const Impedance z = is_prescribed ? Impedance{ 0., 0. }
                                              : given.impedance[face.group];
            auto &known
                = result.try_emplace({ { p[0], p[1], p[2] } }, z).first->second;
            if (known && (known->normal != z.normal || known->shear != z.shear))
              known.reset();
          }
      }
      return result;
    }

    /** Sorts @p faces by their places, which are the same on any number of
        ranks. */
    void sort_by_place(std::vector<BoundaryFace<3>> &faces)
    {
      const auto key = [](const BoundaryFace<3> &face)
      {
        std::array<FreeFieldGrid::Place, 3> places;
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int d = 0; d < 3; ++d)
            places[k][d] = face.points[k][d];
        std::sort(places.begin(), places.end());
        return places;
      };
      std::sort(faces.begin(), faces.end(),
                [&](const BoundaryFace<3> &a, const BoundaryFace<3> &b)
                { return key(a) < key(b); });
    }

    /** The faces of each vertical plane. */
    std::vector<std::vector<BoundaryFace<3>>>
    plane_sides(const std::string &load, std::vector<BoundaryFace<3>> faces)
    {
      sort_by_place(faces);
      std::vector<std::vector<BoundaryFace<3>>> sides;
      for (const BoundaryFace<3> &face : faces)
      {
        const auto outward = outward_area(face.points);
        const double area  = outward.norm();
        if (std::abs(outward[2]) > same_share * area)
          fail_free_field(load, "Boundary",
                          "must be vertical sides of the model, but has a face "
                          "at "
                              + at(face.points[0])
                              + " that is not vertical: the ground beside it "
                                "would not stand on the base.");
        const auto is_in_line = [&](const std::vector<BoundaryFace<3>> &side)
        {
          const auto n = outward_area(side.front().points);
          return (n / n.norm() - outward / area).norm() < same_share
                 && std::abs((face.points[0] - side.front().points[0])
                             * outward)
                        < same_share * area * std::sqrt(area);
        };
        const auto found = std::find_if(sides.begin(), sides.end(), is_in_line);
        if (found == sides.end())
          sides.push_back({ face });
        else
          found->push_back(face);
      }
      return sides;
    }
  } // namespace

  template <int dim>
  FreeFieldBoundary<dim>::FreeFieldBoundary(const LoadParameters &parameters,
                                            const NodeMap<dim> &node_map,
                                            const FreeFieldGround &ground,
                                            const FreeFieldBase &given)
  {
    this->load_name            = parameters.name;
    this->own_traits.companion = given.load.name;
    const auto faces
        = faces_of_curves(node_map, parameters.boundaries, parameters.name);
    const auto base_faces
        = faces_of_curves(node_map, given.load.boundaries, given.load.name);
    this->node_list    = nodes_of_faces(node_map, faces);
    foot.is_prescribed = given.load.type == LoadType::prescribed_motion;
    foot.components    = given.load.components;
    make_sides(node_map, faces, base_faces, ground, given);

    base_dashpots.resize(this->node_list.size());
    if (!foot.is_prescribed)
      add_dashpots(node_map, base_faces, given.impedance, ground.thickness,
                   this->node_list, base_dashpots);
    pull.resize(this->node_list.size());
    for (const Dashpot<dim> &dashpot : base_dashpots)
      damping.push_back(dashpot.damping);
    for (const Side &side : side_list)
    {
      this->own_traits.largest_eigenvalue
          = std::max(this->own_traits.largest_eigenvalue,
                     side.ground.largest_eigenvalue());
      for (unsigned int i = 0; i < side.nodes.size(); ++i)
        for (unsigned int k = 0; k < side.dashpots[i].damping.size(); ++k)
          damping[side.nodes[i]][k] += side.dashpots[i].damping[k];
    }
  }

  // -- what is constant ------------------------------------------------------

  template <>
  void FreeFieldBoundary<2>::make_sides(
      const NodeMap<2> &node_map, const std::vector<BoundaryFace<2>> &faces,
      const std::vector<BoundaryFace<2>> &base_faces,
      const FreeFieldGround &ground, const FreeFieldBase &given)
  {
    const double x            = faces.front().points[0][0];
    FreeFieldColumn<2> column = column_beside(
        load_name, x, edges_of_side(load_name, faces, ground), ground);
    const Impedance z
        = impedance_below(load_name, x, column, base_faces, given);
    const double width = column.layer(0).thickness;
    column.set_base(dealii::Point<2>(width * z.shear, width * z.normal));
    tie(node_map, faces, ground, Side(std::move(column)));
  }

  template <>
  void FreeFieldBoundary<3>::make_sides(
      const NodeMap<3> &node_map, const std::vector<BoundaryFace<3>> &faces,
      const std::vector<BoundaryFace<3>> &base_faces,
      const FreeFieldGround &ground, const FreeFieldBase &given)
  {
    const auto below = impedances_below(base_faces, given, foot.is_prescribed);
    for (const auto &side : plane_sides(load_name, faces))
      tie(node_map, side, ground,
          Side(FreeFieldGrid(load_name, side, ground, below, given.load.name)));
  }

  template <int dim>
  void FreeFieldBoundary<dim>::tie(const NodeMap<dim> &node_map,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const FreeFieldGround &ground, Side side)
  {
    std::vector<unsigned int> local = nodes_of_faces(node_map, faces);
    for (const unsigned int node : local)
      side.nodes.push_back(
          std::lower_bound(this->node_list.begin(), this->node_list.end(), node)
          - this->node_list.begin());
    side.beside.resize(local.size());
    for (unsigned int f = 0; f < faces.size(); ++f)
    {
      const BoundaryFace<dim> &face = faces[f];
      unsigned int part             = f;
      auto area                     = outward_area(face.points) / dim;
      if constexpr (dim == 2)
      {
        part = side.ground.node_at(
            std::min(face.points[0][1], face.points[1][1]));
        const auto &layer = side.ground.layer(part);
        area = dealii::Point<2>(0.5 * (area[0] > 0. ? 1. : -1.) * layer.height
                                    * layer.thickness,
                                0.);
      }
      for (unsigned int k = 0; k < dim; ++k)
      {
        const unsigned int v = face.nodes[k];
        if (!node_map.exchange().owns(v))
          continue;
        const unsigned int i = std::lower_bound(local.begin(), local.end(),
                                                node_map.exchange().local(v))
                               - local.begin();
        if constexpr (dim == 2)
          side.beside[i] = side.ground.node_at(face.points[k][1]);
        else
          side.beside[i] = side.ground.node_of(f, k);
        side.shares.push_back({ side.nodes[i], part, area });
      }
    }
    std::vector<Impedance> impedance;
    for (const LinearElastic &material : ground.materials)
      impedance.push_back(impedance_of(material, ground.plane));
    side.dashpots.resize(local.size());
    add_dashpots(node_map, faces, impedance, ground.thickness, local,
                 side.dashpots);
    side_list.push_back(std::move(side));
  }

  // -- a step ----------------------------------------------------------------

  template <int dim>
  void FreeFieldBoundary<dim>::prepare(State<dim> &state) const
  {
    state.template add<FreeFieldState<dim>>(this->load_name);
  }

  template <int dim>
  void FreeFieldBoundary<dim>::begin_stage(State<dim> &state,
                                           const bool continues)
  {
    if (!continues)
      state.template get<FreeFieldState<dim>>(this->load_name) = {};
  }

  template <int dim>
  void
  FreeFieldBoundary<dim>::start(const std::vector<CapturedNode<dim>> &captured,
                                FreeFieldState<dim> &beside)
  {
    unsigned int n = 0;
    for (const Side &side : side_list)
      n += side.ground.n_nodes();
    beside.active = true;
    beside.displacement.assign(dim * n, 0.);
    beside.velocity = beside.displacement;
    for (const unsigned int c : this->captured_positions)
      append_vector<dim>(beside.held, captured[c].begun - captured[c].force);
  }

  template <int dim>
  void FreeFieldBoundary<dim>::correct(
      const StepContext &step, const std::vector<CapturedNode<dim>> &captured,
      State<dim> &state)
  {
    auto &beside = state.template get<FreeFieldState<dim>>(this->load_name);
    if (!beside.active)
      start(captured, beside);

    std::array<double, 3> incident{};
    if (!foot.is_prescribed)
      incident = component_values(foot.components, step.begin);
    for (unsigned int i = 0; i < pull.size(); ++i)
      pull[i]
          = base_dashpots[i].pull(incident) + vector_at<dim>(beside.held, i);
    std::size_t first = 0;
    for (Side &side : side_list)
    {
      side.ground.advance(step, foot, beside.displacement.data() + first,
                          beside.velocity.data() + first);
      first += dim * side.ground.n_nodes();
      for (unsigned int i = 0; i < side.nodes.size(); ++i)
        side.dashpots[i].add_drag(side.ground.velocity(side.beside[i]),
                                  pull[side.nodes[i]]);
      for (const typename Side::Share &share : side.shares)
        side.ground.add_force(share.part, share.area, pull[share.node]);
    }
    for (unsigned int i = 0; i < pull.size(); ++i)
      move_with_dashpot(step, captured[this->captured_positions[i]], damping[i],
                        pull[i], this, state);
  }

  template <int dim>
  void FreeFieldBoundary<dim>::account(
      const StepContext &step, const std::vector<CapturedNode<dim>> &captured,
      State<dim> &state)
  {
    this->last_resultant = {};
    for (unsigned int i = 0; i < pull.size(); ++i)
      account_for_dashpot(step, captured[this->captured_positions[i]],
                          damping[i], pull[i], this, this->last_resultant,
                          state);
  }

  template class FreeFieldBoundary<2>;
  template class FreeFieldBoundary<3>;
} // namespace quoin
