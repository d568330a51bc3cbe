// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_face_groups_h
#define quoin_joint_elements_face_groups_h

#include <quoin/base/native_lanes.h>
#include <quoin/base/node_record.h>
#include <quoin/operators/energy_accounts.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * Faces of matched joints that are computed together, one in each SIMD lane:
   * segments in two dimensions, triangles in three, with dim points each. Lanes
   * without a face repeat the nodes of the last one and have no area.
   */
  template <int dim, int lanes>
  struct FaceGroup
  {
    /** Offsets in arrays of dealii::Tensor<1, dim> [B] of the lower vertices,
        then the upper ones; in those of NodeRecord they are twice as large. */
    std::uint32_t nodes[2 * dim][lanes];
    /** Area of each point, in the order of the history [m^2]. */
    double area[dim * lanes];
    /** Area times the share of the energy that this rank counts [m^2]. */
    double weight[dim * lanes];
    std::uint32_t first; /**< index of the first face */
    std::uint32_t size;  /**< number of faces */
  };

  /** The faces of the joint sets in groups of native_lanes. */
  template <int dim>
  class FaceGroups
  {
  public:
    /** Groups @p faces, which are sorted by the @p n_sets sets. */
    template <typename Face>
    void prepare(const std::vector<Face> &faces, unsigned int n_sets);

    /**
     * Updates the internal variables of the points of @p set in @p history for
     * the positions in @p nodes, adds their forces to @p force and what they
     * dissipate to @p energy. @p gone: nonzero for faces that are no joints
     * any more.
     */
    template <typename Law, typename History>
    void add_forces(unsigned int set, const Law &law,
                    const NodeRecord<dim> *nodes, History &history,
                    const std::uint8_t *gone, EnergyAccounts &energy,
                    dealii::Tensor<1, dim> *force) const;

    /** Adds the stiffness-proportional damping forces of points of @p set that
        neither slip nor are open: beta kn, beta ks times the rates [Pa]. */
    template <typename Law, typename History>
    void add_viscous_forces(unsigned int set, const Law &law,
                            const NodeRecord<dim> *nodes,
                            const History &history, const std::uint8_t *gone,
                            const dealii::Tensor<1, dim> *velocity, double beta,
                            dealii::Tensor<1, dim> *force) const;

  private:
    AlignedArray<FaceGroup<dim, native_lanes>> groups;
    std::vector<unsigned int> set_begin; /**< first group of each set */
  };
} // namespace quoin

#endif
