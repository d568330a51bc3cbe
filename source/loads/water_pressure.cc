// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/none.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/loads/water_pressure.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace quoin
{
  namespace
  {
    /** A convex part of a face: its corners by the functions of the nodes; in
        two dimensions the two ends of an interval. */
    template <int dim>
    struct FacePart
    {
      using Corner = std::array<double, dim>;
      /** A triangle that is cut four times has seven corners. */
      std::array<Corner, 8> corners{};
      unsigned int n = 0;

      void add(const Corner &corner)
      {
        corners[n++] = corner;
      }
      static FacePart whole()
      {
        FacePart result;
        for (unsigned int k = 0; k < dim; ++k)
        {
          Corner corner{};
          corner[k] = 1.;
          result.add(corner);
        }
        return result;
      }

      /** The part where the linear function with the value @p f at corners is
          not negative. */
      template <typename F>
      FacePart cut(const F &f) const
      {
        FacePart result;
        for (unsigned int i = 0; i < n; ++i)
        {
          const double here = f(corners[i]);
          if (here >= 0.)
            result.add(corners[i]);
          if (dim == 2 && i + 1 == n)
            break;
          const Corner &next = corners[(i + 1) % n];
          const double there = f(next);
          if ((here < 0.) == (there < 0.))
            continue;
          Corner between;
          for (unsigned int k = 0; k < dim; ++k)
            between[k]
                = (there * corners[i][k] - here * next[k]) / (there - here);
          result.add(between);
        }
        return result;
      }
    };

    /** Size of a simplex with these corners by that of the face. */
    double share_of(const std::array<std::array<double, 2>, 2> &c)
    {
      return std::abs(c[0][0] * c[1][1] - c[0][1] * c[1][0]);
    }
    double share_of(const std::array<std::array<double, 3>, 3> &c)
    {
      return std::abs(c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1])
                      - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0])
                      + c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]));
    }

    /** Mean over a simplex of the product of two linear functions with the
        values @p f and @p g at its corners. */
    template <std::size_t n>
    double mean_product(const std::array<double, n> &f,
                        const std::array<double, n> &g)
    {
      double products = 0., f_sum = 0., g_sum = 0.;
      for (unsigned int c = 0; c < n; ++c)
      {
        products += f[c] * g[c];
        f_sum += f[c];
        g_sum += g[c];
      }
      return (products + f_sum * g_sum) / (n * (n + 1.));
    }

    /** Derivative of outward_area() by the place of point @p l along @p e. */
    dealii::Tensor<1, 2> outward_slope(const std::array<dealii::Point<2>, 2> &,
                                       const unsigned int l,
                                       const unsigned int e)
    {
      dealii::Tensor<1, 2> result;
      result[1 - e] = (l == 1) == (e == 1) ? 1. : -1.;
      return result;
    }
    dealii::Tensor<1, 3>
    outward_slope(const std::array<dealii::Point<3>, 3> &points,
                  const unsigned int l, const unsigned int e)
    {
      dealii::Tensor<1, 3> along;
      along[e] = 0.5;
      return dealii::cross_product_3d(along, points[(l + 1) % 3]
                                                 - points[(l + 2) % 3]);
    }
  } // namespace

  template <int dim>
  WaterPressure<dim>::WaterPressure(
      const LoadField &water, const NodeMap<dim> &node_map,
      const std::vector<BoundaryFace<dim>> &all_faces,
      const Thickness &thickness)
    : water(water), last_level(std::numeric_limits<double>::quiet_NaN()),
      last_moves(0)
  {
    const NodeExchange &local   = node_map.exchange();
    const MPI_Comm communicator = node_map.communicator();
    const auto has              = [&](const unsigned int node)
    { return local.local(node) < local.n_owned() + local.n_shared(); };

    // One of the ranks that have all nodes of a face linearises it.
    const unsigned int rank
        = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::vector<unsigned int> linearised_by;
    for (const BoundaryFace<dim> &face : all_faces)
      linearised_by.push_back(
          std::all_of(face.nodes.begin(), face.nodes.end(), has) ? rank : none);
    dealii::Utilities::MPI::min(linearised_by, communicator, linearised_by);

    std::map<unsigned int, unsigned int> slots, points;
    std::vector<unsigned int> globals, foreign;
    for (unsigned int f = 0; f < all_faces.size(); ++f)
    {
      const BoundaryFace<dim> &given = all_faces[f];
      Face face;
      face.is_linearised = linearised_by[f] == rank;
      if (!face.is_linearised
          && std::none_of(given.nodes.begin(), given.nodes.end(),
                          [&](const unsigned int node)
                          { return local.owns(node); }))
        continue;
      face.shares    = given.shares;
      face.thickness = thickness.common(given.group, given.across);
      for (unsigned int k = 0; k < dim; ++k)
      {
        const unsigned int node = given.nodes[k];
        face.nodes[k]           = face.is_linearised ? local.local(node) : none;
        face.slots[k]           = none;
        if (local.owns(node))
        {
          const auto [slot, is_new]
              = slots.emplace(local.local(node), node_list.size());
          if (is_new)
            node_list.push_back(slot->first);
          face.slots[k] = slot->second;
        }
        const auto [point, is_new] = points.emplace(node, mesh_places.size());
        if (is_new)
        {
          mesh_places.push_back(given.points[k]);
          globals.push_back(node);
          if (!local.owns(node))
            foreign.push_back(node);
        }
        face.points[k] = point->second;
      }
      faces.push_back(face);
    }
    std::sort(foreign.begin(), foreign.end());
    exchange = std::make_unique<NodeExchange>(local.with_partners(foreign));
    for (const unsigned int node : globals)
      sources.push_back(exchange->local(node));
    from_others.resize(foreign.size());
    places = mesh_places;
  }

  template <int dim>
  void WaterPressure<dim>::follow(const AlignedArray<NodeRecord<dim>> &nodes)
  {
    exchange->update_ghosts(nodes.data(), from_others.data());
    const unsigned int n_owned = exchange->n_owned();
    bool has_moved             = false;
    for (unsigned int i = 0; i < places.size(); ++i)
    {
      const dealii::Point<dim> place
          = (sources[i] < n_owned ? nodes[sources[i]]
                                  : from_others[sources[i] - n_owned])
                .position();
      has_moved = has_moved || place != places[i];
      places[i] = place;
    }
    moves += has_moved;
  }

  template <int dim>
  void WaterPressure<dim>::return_to_mesh()
  {
    places = mesh_places;
    ++moves;
  }

  template <int dim>
  double WaterPressure<dim>::level_at(const TimePoint &time) const
  {
    return water.level() ? (*water.level())(time) : 0.;
  }

  template <int dim>
  typename WaterPressure<dim>::Wet
  WaterPressure<dim>::wet_part(const Face &face, const double level,
                               const bool with_products) const
  {
    Wet wet;
    std::array<dealii::Point<dim>, dim> points;
    for (unsigned int k = 0; k < dim; ++k)
      points[k] = places[face.points[k]];
    const auto &line = water.line();
    const auto along
        = [&](const typename FacePart<dim>::Corner &at, const unsigned int d)
    {
      double result = 0.;
      for (unsigned int k = 0; k < dim; ++k)
        result += at[k] * points[k][d];
      return result;
    };
    const auto add_part =
        [&](const FacePart<dim> &part, const double slope, const auto &depth_at)
    {
      const FacePart<dim> below = part.cut(depth_at);
      for (unsigned int i = 1; i + dim <= below.n + 1; ++i)
      {
        std::array<typename FacePart<dim>::Corner, dim> corners;
        corners[0] = below.corners[0];
        for (unsigned int c = 1; c < dim; ++c)
          corners[c] = below.corners[i + c - 1];
        const double share = share_of(corners);
        std::array<double, dim> depth;
        std::array<std::array<double, dim>, dim> functions;
        for (unsigned int c = 0; c < dim; ++c)
        {
          depth[c] = std::max(0., depth_at(corners[c]));
          for (unsigned int k = 0; k < dim; ++k)
            functions[k][c] = corners[c][k];
        }
        for (unsigned int k = 0; k < dim; ++k)
        {
          wet.depth[k] += share * mean_product(functions[k], depth);
          for (unsigned int l = 0; with_products && l < dim; ++l)
          {
            const double product
                = share * mean_product(functions[k], functions[l]);
            wet.product[k][l] += product;
            wet.slope[k][l] += slope * product;
          }
        }
      }
    };
    if (line.empty())
    {
      add_part(FacePart<dim>::whole(), 0.,
               [&](const auto &at) { return level - along(at, dim - 1); });
      return wet;
    }
    double low = points[0][0], high = points[0][0];
    for (const dealii::Point<dim> &point : points)
    {
      low  = std::min(low, point[0]);
      high = std::max(high, point[0]);
    }
    // Parts between kinks; beyond the ends the level is that of the end.
    for (std::size_t i = 0; i <= line.size(); ++i)
    {
      constexpr double far = std::numeric_limits<double>::max();
      const double begin   = i == 0 ? -far : line[i - 1][0],
                   end     = i == line.size() ? far : line[i][0];
      if (end <= low || (begin >= high && begin > low))
        continue;
      const bool is_inside = i > 0 && i < line.size();
      const double slope
          = is_inside ? (line[i][1] - line[i - 1][1]) / (end - begin) : 0.;
      const auto &start  = line[i == 0 ? 0 : i - 1];
      FacePart<dim> part = FacePart<dim>::whole();
      if (begin > low)
        part = part.cut([&](const auto &at) { return along(at, 0) - begin; });
      if (end < high)
        part = part.cut([&](const auto &at) { return end - along(at, 0); });
      add_part(part, slope,
               [&](const auto &at) {
                 return start[1] + slope * (along(at, 0) - start[0])
                        - along(at, dim - 1);
               });
    }
    return wet;
  }

  template <int dim>
  std::array<double, dim>
  WaterPressure<dim>::weights_of(const Face &face,
                                 const std::array<double, dim> &depth)
  {
    double sum = 0.;
    for (const double part : depth)
      sum += part;
    std::array<double, dim> result;
    for (unsigned int k = 0; k < dim; ++k)
      result[k] = depth[k] + (face.shares[k] - 1. / dim) * sum;
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> WaterPressure<dim>::outward(const Face &face) const
  {
    std::array<dealii::Point<dim>, dim> points;
    for (unsigned int k = 0; k < dim; ++k)
      points[k] = places[face.points[k]];
    return face.thickness * outward_area(points);
  }

  template <int dim>
  const std::vector<dealii::Tensor<1, dim>> &
  WaterPressure<dim>::forces(const TimePoint &time) const
  {
    const double level = level_at(time);
    if (level == last_level && moves == last_moves)
      return last_forces;
    last_level = level;
    last_moves = moves;
    last_forces.assign(node_list.size(), dealii::Tensor<1, dim>());
    // A level that is no number must not pass for one below all faces.
    if (!std::isfinite(level))
      for (dealii::Tensor<1, dim> &force : last_forces)
        for (unsigned int d = 0; d < dim; ++d)
          force[d] = level;
    for (const Face &face : faces)
    {
      const auto weights = weights_of(face, wet_part(face, level, false).depth);
      const dealii::Tensor<1, dim> pressed = -weight_of_water * outward(face);
      for (unsigned int k = 0; k < dim; ++k)
        if (face.slots[k] != none)
          last_forces[face.slots[k]] += weights[k] * pressed;
    }
    return last_forces;
  }

  template <int dim>
  void WaterPressure<dim>::linearise(const TimePoint &time, const double share,
                                     const bool with_stiffness,
                                     const TakeElement<dim> &take) const
  {
    constexpr unsigned int n = dim * dim;
    static constexpr std::array<double, n> no_force{};
    std::array<double, n * n> stiffness{};
    const double level = level_at(time);
    for (const Face &face : faces)
    {
      if (!face.is_linearised)
        continue;
      if (with_stiffness)
      {
        const Wet wet      = wet_part(face, level, true);
        const auto weights = weights_of(face, wet.depth);
        const auto area    = outward(face);
        std::array<dealii::Point<dim>, dim> points;
        for (unsigned int k = 0; k < dim; ++k)
          points[k] = places[face.points[k]];
        for (unsigned int l = 0; l < dim; ++l)
        {
          // Derivatives of the weights by the place of node l.
          std::array<double, dim> by_height, by_x;
          for (unsigned int k = 0; k < dim; ++k)
          {
            by_height[k] = -wet.product[k][l];
            by_x[k]      = wet.slope[k][l];
          }
          by_height = weights_of(face, by_height);
          by_x      = weights_of(face, by_x);
          for (unsigned int e = 0; e < dim; ++e)
          {
            const auto turning = face.thickness * outward_slope(points, l, e);
            for (unsigned int k = 0; k < dim; ++k)
            {
              const double deeper = (e == dim - 1 ? by_height[k] : 0.)
                                    + (e == 0 ? by_x[k] : 0.);
              for (unsigned int d = 0; d < dim; ++d)
                stiffness[(dim * k + d) * n + dim * l + e]
                    = share * weight_of_water
                      * (turning[d] * weights[k] + area[d] * deeper);
            }
          }
        }
      }
      take({ face.nodes.data(), dim, no_force.data(),
             with_stiffness ? stiffness.data() : nullptr, n });
    }
  }

  template class WaterPressure<2>;
  template class WaterPressure<3>;
} // namespace quoin
