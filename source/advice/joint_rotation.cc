// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/advice/joint_rotation.h>
#include <quoin/base/eigen_core.h>
#include <quoin/loads/nodal_load.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace quoin
{
  namespace
  {
    /** Name and blocks, the lower number first. */
    using Key = std::array<unsigned int, 3>;
    template <int n>
    using Sums = std::map<Key, std::array<double, n>>;

    /** The sums of all ranks. */
    template <int n>
    Sums<n> sum(const Sums<n> &own, const MPI_Comm communicator)
    {
      std::vector<double> packed;
      for (const auto &[key, values] : own)
      {
        packed.insert(packed.end(), key.begin(), key.end());
        packed.insert(packed.end(), values.begin(), values.end());
      }
      Sums<n> result;
      for (const auto &part :
           dealii::Utilities::MPI::all_gather(communicator, packed))
        for (std::size_t i = 0; i < part.size(); i += 3 + n)
        {
          const Key key{ { unsigned(part[i]), unsigned(part[i + 1]),
                           unsigned(part[i + 2]) } };
          for (unsigned int k = 0; k < n; ++k)
            result[key][k] += part[i + 3 + k];
        }
      return result;
    }

    /** Motions of a rigid body. */
    template <int dim>
    constexpr int n_motions = dim == 2 ? 3 : 6;
    template <int dim>
    using Stiffness = Eigen::Matrix<double, n_motions<dim>, n_motions<dim>>;
    template <int dim>
    using Motions = Eigen::Matrix<double, n_motions<dim>, 1>;

    /** The opening at @p arm, in lengths of the joint, by the motions of a
        block: @p n is the normal. */
    Motions<2> opening(const dealii::Tensor<1, 2> &n,
                       const dealii::Tensor<1, 2> &arm)
    {
      return { n[0], n[1], arm[0] * n[1] - arm[1] * n[0] };
    }
    Motions<3> opening(const dealii::Tensor<1, 3> &n,
                       const dealii::Tensor<1, 3> &arm)
    {
      const auto turn = cross_product_3d(arm, n);
      Motions<3> result;
      result << n[0], n[1], n[2], turn[0], turn[1], turn[2];
      return result;
    }

    /** The largest share by which @p nodal is above @p exact for any motion
        that @p exact resists. */
    template <int dim>
    double largest_excess(const Stiffness<dim> &nodal,
                          const Stiffness<dim> &exact)
    {
      /** Stiffness, by the largest one, that is rounding. */
      constexpr double rounding = 1e-9;
      const Eigen::SelfAdjointEigenSolver<Stiffness<dim>> modes(exact);
      Stiffness<dim> scaled = Stiffness<dim>::Zero();
      for (int i = 0; i < n_motions<dim>; ++i)
        if (modes.eigenvalues()[i]
            > rounding * modes.eigenvalues()[n_motions<dim> - 1])
          scaled.col(i)
              = modes.eigenvectors().col(i) / std::sqrt(modes.eigenvalues()[i]);
      const Stiffness<dim> ratios = scaled.transpose() * nodal * scaled;
      return Eigen::SelfAdjointEigenSolver<Stiffness<dim>>(
                 ratios, Eigen::EigenvaluesOnly)
                 .eigenvalues()[n_motions<dim> - 1]
             - 1.;
    }
  } // namespace

  template <int dim>
  std::vector<BlockJoint> block_joints(const NodeMap<dim> &nodes,
                                       const std::vector<bool> &is_rigid,
                                       const bool only_rigid)
  {
    using Points = std::array<dealii::Point<dim>, dim>;
    // Each face counts on the rank of its lower side.
    std::vector<std::pair<Key, Points>> faces;
    for (const JointNodes<dim> &face : nodes.faces().joints)
    {
      const auto &[one, other] = face.blocks;
      if (!face.is_own[0] || one == other
          || (only_rigid && !(is_rigid[one] && is_rigid[other])))
        continue;
      Points points;
      for (unsigned int k = 0; k < dim; ++k)
        points[k] = nodes.point(face.lower[k]);
      faces.push_back(
          { { { face.name, std::min(one, other), std::max(one, other) } },
            points });
    }

    // Number of faces, area, and its moment.
    Sums<2 + dim> sizes;
    for (const auto &[key, points] : faces)
    {
      auto &size        = sizes[key];
      const double area = outward_area(points).norm();
      size[0] += 1.;
      size[1] += area;
      for (const auto &point : points)
        for (unsigned int d = 0; d < dim; ++d)
          size[2 + d] += area * point[d] / dim;
    }
    sizes = sum<2 + dim>(sizes, nodes.communicator());

    constexpr int n = n_motions<dim>;
    Sums<2 * n * n> stiffnesses; // nodal, then exact ones
    for (const auto &[key, points] : faces)
    {
      const auto &size    = sizes.at(key);
      const double length = dim == 2 ? size[1] : std::sqrt(size[1]);
      dealii::Tensor<1, dim> middle;
      for (unsigned int d = 0; d < dim; ++d)
        middle[d] = size[2 + d] / size[1];
      const dealii::Tensor<1, dim> outward = outward_area(points);
      const double area                    = outward.norm();
      Stiffness<dim> squares               = Stiffness<dim>::Zero();
      Motions<dim> all                     = Motions<dim>::Zero();
      for (const auto &point : points)
      {
        const Motions<dim> g
            = opening(outward / area, (point - middle) / length);
        squares += g * g.transpose();
        all += g;
      }
      auto &result = stiffnesses[key];
      Eigen::Map<Stiffness<dim>> nodal(result.data()),
          exact(result.data() + n * n);
      nodal += area / size[1] / dim * squares;
      // The square of what is linear across a line or triangle.
      exact += area / size[1] / (dim * (dim + 1.))
               * (squares + all * all.transpose());
    }
    stiffnesses = sum<2 * n * n>(stiffnesses, nodes.communicator());

    std::vector<BlockJoint> joints;
    for (const auto &[key, values] : stiffnesses)
      joints.push_back(
          { key[0],
            { key[1], key[2] },
            unsigned(sizes.at(key)[0]),
            largest_excess<dim>(
                Eigen::Map<const Stiffness<dim>>(values.data()),
                Eigen::Map<const Stiffness<dim>>(values.data() + n * n)) });
    return joints;
  }

  template std::vector<BlockJoint>
  block_joints(const NodeMap<2> &, const std::vector<bool> &, bool);
  template std::vector<BlockJoint>
  block_joints(const NodeMap<3> &, const std::vector<bool> &, bool);
} // namespace quoin
