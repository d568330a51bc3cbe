// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/point_text.h>
#include <quoin/farfield/interface_transfer.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {

    std::string place(const dealii::Point<2> &x)
    {
      return point_text(x) + " m";
    }

    /** Means of the linear functions of an edge over its part from @p begin to
        @p end, between 0 and 1. */
    std::array<double, 2> linear_means(const double begin, const double end)
    {
      const double middle = 0.5 * (begin + end);
      return { 1. - middle, middle };
    }

    /** Means of the quadratic functions of an edge over that part: those of the
        nodes where the edge begins, in its middle and where it ends. */
    std::array<double, 3> quadratic_means(const double begin, const double end)
    {
      const double middle = 0.5 * (begin + end);
      // Mean of the square by Simpson's rule, which is exact.
      const double square
          = (begin * begin + 4. * middle * middle + end * end) / 6.;
      return { 1. - 3. * middle + 2. * square, 4. * (middle - square),
               2. * square - middle };
    }

    /** The vertices of the quadratic edges by the node in their middle, which
        is where two of @p faces meet and has the larger share of both. */
    std::map<unsigned int, std::vector<unsigned int>>
    ends_of_quadratic_edges(const std::vector<BoundaryFace<2>> &faces)
    {
      std::map<unsigned int, std::vector<unsigned int>> ends;
      for (const BoundaryFace<2> &face : faces)
        for (unsigned int k = 0; k < 2; ++k)
          if (face.shares[k] > face.shares[1 - k])
            ends[face.nodes[k]].push_back(face.nodes[1 - k]);
      return ends;
    }

    /** Overlap of the segment @p element and the edge from @p a to @p b. */
    struct Overlap
    {
      double begin, end; /**< places on the edge, 0 to 1 */
      double distance; /**< distance of the midpoints across the element [m] */
    };

    Overlap overlap(const BoundaryElement &element, const dealii::Point<2> &a,
                    const dealii::Point<2> &b)
    {
      const dealii::Tensor<1, 2> edge = b - a;
      const auto place                = [&](const dealii::Point<2> &x)
      { return edge * (x - a) / edge.norm_square(); };
      // The domain of the elements is on the other side.
      const double from             = std::clamp(place(element.b), 0., 1.),
                   to               = std::clamp(place(element.a), 0., 1.);
      const dealii::Point<2> middle = a + 0.5 * (from + to) * edge;
      return { from, to,
               std::abs(element.normal() * (middle - element.middle())) };
    }
  } // namespace

  InterfaceTransfer::InterfaceTransfer(
      const Boundary &boundary, const std::vector<unsigned int> &elements,
      const NodeMap<2> &node_map, const std::vector<BoundaryFace<2>> &faces)
    : communicator(node_map.communicator())
  {
    std::vector<double> covered(elements.size(), 0.);
    std::map<unsigned int, std::vector<Entry>> rows; // of all nodes
    const auto quadratic_ends = ends_of_quadratic_edges(faces);
    // Integrals of the functions of the edge over a part of it that is a share
    // of its length.
    const auto add_part = [&](const BoundaryFace<2> &face, const unsigned int e,
                              const Overlap &part, const double length)
    {
      if (face.shares[0] == face.shares[1])
      {
        const auto means = linear_means(part.begin, part.end);
        for (unsigned int k = 0; k < 2; ++k)
          rows[face.nodes[k]].push_back({ e, length * means[k] });
        return;
      }
      // The face is half of the edge, from a vertex to the middle or on from
      // there.
      const bool is_second    = face.shares[0] > face.shares[1];
      const unsigned int here = face.nodes[is_second ? 1 : 0],
                         mid  = face.nodes[is_second ? 0 : 1];
      const auto &ends        = quadratic_ends.at(mid);
      const auto means
          = is_second ? quadratic_means(0.5 * (1. - part.end),
                                        0.5 * (1. - part.begin))
                      : quadratic_means(0.5 * part.begin, 0.5 * part.end);
      rows[here].push_back({ e, length * means[0] });
      rows[mid].push_back({ e, length * means[1] });
      rows[ends[0] == here ? ends[1] : ends[0]].push_back(
          { e, length * means[2] });
    };
    for (const BoundaryFace<2> &face : faces)
    {
      const auto &[a, b] = face.points;
      const double size  = (b - a).norm();
      double found       = 0.;
      for (unsigned int e = 0; e < elements.size(); ++e)
      {
        const BoundaryElement &element = boundary.elements[elements[e]];
        // Elements may be chords of several edges of a curved boundary.
        const double reach = element.length() + size;
        if ((element.middle() - 0.5 * (a + b)).norm() > 0.51 * reach
            || -(element.tangent() * (b - a)) < 0.5 * size)
          continue;
        const Overlap part = overlap(element, a, b);
        const double share = part.end - part.begin;
        if (share < 1e-6 || part.distance > 0.3 * element.length())
          continue;
        found += share;
        covered[e] += share * size;
        add_part(face, e, part, share * size);
      }
      if (std::abs(found - 1.) > 1e-3)
        throw InputError("the edge of a block at " + place(0.5 * (a + b))
                         + " lies along "
                         + (found < 1. ? "no boundary element, or not all of "
                                         "it does"
                                       : "more than one boundary element")
                         + ". Interface and load must be of the same curves, "
                           "with the domain on the other side of them.");
    }
    for (unsigned int e = 0; e < elements.size(); ++e)
    {
      const BoundaryElement &element = boundary.elements[elements[e]];
      length.push_back(element.length());
      if (covered[e] < 0.5 * element.length())
        throw InputError("the boundary element at " + place(element.middle())
                         + " lies along no edge of a block.");
    }

    row_begin = { 0 };
    for (auto &[vertex, row] : rows)
    {
      if (!node_map.exchange().owns(vertex))
        continue;
      node_list.push_back(node_map.exchange().local(vertex));
      std::sort(row.begin(), row.end(),
                [](const Entry &x, const Entry &y)
                { return x.element < y.element; });
      for (const Entry &entry : row)
      {
        const double weight = entry.weight / covered[entry.element];
        if (entries.size() > row_begin.back()
            && entries.back().element == entry.element)
          entries.back().weight += weight;
        else
          entries.push_back({ entry.element, weight });
      }
      row_begin.push_back(entries.size());
    }
  }

  Eigen::MatrixXd
  InterfaceTransfer::congruence(const std::vector<double> &diagonal) const
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n_elements(), n_elements());
    for (unsigned int k = 0; k < node_list.size(); ++k)
      for (unsigned int i = row_begin[k]; i < row_begin[k + 1]; ++i)
        for (unsigned int j = row_begin[k]; j < row_begin[k + 1]; ++j)
          result(entries[i].element, entries[j].element)
              += entries[i].weight * diagonal[k] * entries[j].weight
                 * length[entries[j].element];
    MPI_Allreduce(MPI_IN_PLACE, result.data(), int(result.size()), MPI_DOUBLE,
                  MPI_SUM, communicator);
    return result;
  }

  Eigen::MatrixXd
  InterfaceTransfer::mobility(const std::vector<double> &gain) const
  {
    const Eigen::MatrixXd matrix = congruence(gain);
    Eigen::MatrixXd result
        = Eigen::MatrixXd::Zero(2 * matrix.rows(), 2 * matrix.cols());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j)
        result(2 * i, 2 * j) = result(2 * i + 1, 2 * j + 1) = matrix(i, j);
    return result;
  }

  void InterfaceTransfer::sum(Eigen::VectorXd &values) const
  {
    MPI_Allreduce(MPI_IN_PLACE, values.data(), int(values.size()), MPI_DOUBLE,
                  MPI_SUM, communicator);
  }
} // namespace quoin
