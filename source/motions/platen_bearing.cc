// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/loads/nodal_load.h>
#include <quoin/motions/platen_bearing.h>

#include <algorithm>

namespace quoin
{
  namespace
  {
    bool is_moved(const LoadComponent &component)
    {
      return component.quantity != LoadQuantity::free
             && !(component.value.is_constant()
                  && component.value(TimePoint{}) == 0.);
    }
  } // namespace

  bool bears_boundary(const LoadParameters &parameters)
  {
    const auto &shifts = parameters.components;
    const auto &turns  = parameters.rotations;
    return parameters.groups.empty()
           && (std::any_of(shifts.begin(), shifts.end(), is_moved)
               || std::any_of(turns.begin(), turns.end(), is_moved));
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  platen_normals(const LoadParameters &parameters, const NodeMap<dim> &node_map,
                 const std::vector<unsigned int> &nodes,
                 const Thickness &thickness)
  {
    if (!bears_boundary(parameters))
      return {};
    const auto &exchange = node_map.exchange();
    std::vector<dealii::Tensor<1, dim>> areas(node_map.n_owned()), result;
    for (const BoundaryFace<dim> &face :
         faces_of_curves(node_map, parameters.boundaries, parameters.name))
      for (unsigned int k = 0; k < dim; ++k)
        if (exchange.owns(face.nodes[k]))
          areas[exchange.local(face.nodes[k])] += face.shares[k]
                                                  * thickness[face.group]
                                                  * outward_area(face.points);
    for (const unsigned int node : nodes)
      result.push_back(areas[node]);
    return result;
  }

  template <int dim>
  PlatenBearing<dim>
  platen_bearing(const std::vector<dealii::Tensor<1, dim>> &normals,
                 const std::vector<dealii::Tensor<1, dim>> &forces,
                 const std::vector<dealii::Point<dim>> &places,
                 const MPI_Comm communicator)
  {
    PlatenBearing<dim> result;
    double sums[2]{};
    for (unsigned int i = 0; i < normals.size(); ++i)
    {
      const double area = normals[i].norm();
      if (area == 0.)
        continue;
      const double pull = forces[i] * normals[i] / area;
      sums[pull > 0.] += std::abs(pull);
      if (pull / area <= result.tension)
        continue;
      result.tension = pull / area;
      result.place   = places[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, communicator);
    result.pressed = sums[0];
    result.pulled  = sums[1];
    // All ranks take the largest pull, of equal ones that of the first rank.
    struct
    {
      double value;
      int rank;
    } largest{ result.tension, 0 };
    MPI_Comm_rank(communicator, &largest.rank);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC,
                  communicator);
    result.tension = largest.value;
    MPI_Bcast(&result.place[0], dim, MPI_DOUBLE, largest.rank, communicator);
    return result;
  }

  template std::vector<dealii::Tensor<1, 2>>
  platen_normals(const LoadParameters &, const NodeMap<2> &,
                 const std::vector<unsigned int> &, const Thickness &);
  template std::vector<dealii::Tensor<1, 3>>
  platen_normals(const LoadParameters &, const NodeMap<3> &,
                 const std::vector<unsigned int> &, const Thickness &);
  template PlatenBearing<2>
  platen_bearing(const std::vector<dealii::Tensor<1, 2>> &,
                 const std::vector<dealii::Tensor<1, 2>> &,
                 const std::vector<dealii::Point<2>> &, MPI_Comm);
  template PlatenBearing<3>
  platen_bearing(const std::vector<dealii::Tensor<1, 3>> &,
                 const std::vector<dealii::Tensor<1, 3>> &,
                 const std::vector<dealii::Point<3>> &, MPI_Comm);
} // namespace quoin
