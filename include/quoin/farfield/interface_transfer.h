// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_farfield_interface_transfer_h
#define quoin_farfield_interface_transfer_h

#include <quoin/base/eigen_core.h>
#include <quoin/base/packed_vectors.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/elastodynamics/boundary.h>

#include <array>
#include <vector>

namespace quoin
{
  /**
   * Between the nodes of blocks and the boundary elements along them.
   *
   * The motion of an element is the mean over the edges of blocks that it
   * spans, sum_i w_ei v_i with weights that sum to one; the force of its
   * traction p_e on node i is T L_e w_ei p_e, T the thickness. So the work is
   * the same on both sides, and the element's resultant is kept. The weights
   * are the means of the linear or quadratic functions of the edges.
   */
  class InterfaceTransfer
  {
  public:
    /**
     * @p elements of @p boundary lie along @p faces of all ranks, on the other
     * side of them. Throws an InputError if
     * an edge lies along no element, or an element along no edge.
     */
    InterfaceTransfer(const Boundary &boundary,
                      const std::vector<unsigned int> &elements,
                      const NodeMap<2> &node_map,
                      const std::vector<BoundaryFace<2>> &faces);

    /** Local nodes that this rank owns, ascending. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }

    unsigned int n_elements() const
    {
      return length.size();
    }

    /**
     * Means over the elements of the vector @p value(k) of the k-th of nodes():
     * entry 2 e + d; summed over the ranks.
     */
    template <typename Value>
    void gather(const Value &value, Eigen::VectorXd &means) const
    {
      means.setZero(2 * n_elements());
      for (unsigned int k = 0; k < node_list.size(); ++k)
      {
        const dealii::Tensor<1, 2> v = value(k);
        for (unsigned int j = row_begin[k]; j < row_begin[k + 1]; ++j)
          add_to_vector(means, entries[j].element, entries[j].weight * v);
      }
      sum(means);
    }

    /** Force by thickness on the k-th of nodes(): sum_e L_e w_ek p_e [N/m]. */
    dealii::Tensor<1, 2> force(const unsigned int k,
                               const Eigen::VectorXd &traction) const
    {
      dealii::Tensor<1, 2> result;
      for (unsigned int j = row_begin[k]; j < row_begin[k + 1]; ++j)
        result += entries[j].weight * length[entries[j].element]
                  * vector_at(traction, entries[j].element);
      return result;
    }

    /**
     * The matrix w S L, n_elements() square, with S a diagonal matrix of the
     * nodes, entry k for the k-th of nodes(); summed over the ranks.
     */
    Eigen::MatrixXd congruence(const std::vector<double> &diagonal) const;

    /**
     * congruence() of both components, twice as large: by thickness, the motion
     * of elements by their tractions if @p gain is motion by force of nodes.
     */
    Eigen::MatrixXd mobility(const std::vector<double> &gain) const;

    /** w_ek of the k-th of nodes(), a row for each, a column per element. */
    Eigen::MatrixXd weights() const
    {
      Eigen::MatrixXd result
          = Eigen::MatrixXd::Zero(node_list.size(), n_elements());
      for (unsigned int k = 0; k < node_list.size(); ++k)
        for (unsigned int j = row_begin[k]; j < row_begin[k + 1]; ++j)
          result(k, entries[j].element) += entries[j].weight;
      return result;
    }

    /** Lengths of the elements [m]. */
    const std::vector<double> &lengths() const
    {
      return length;
    }

  private:
    struct Entry
    {
      unsigned int element;
      double weight;
    };

    void sum(Eigen::VectorXd &values) const;

    MPI_Comm communicator;
    std::vector<double> length;
    std::vector<unsigned int> node_list;
    std::vector<unsigned int> row_begin; /**< first entry of each node */
    std::vector<Entry> entries;
  };
} // namespace quoin

#endif
