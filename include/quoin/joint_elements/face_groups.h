// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_elements_face_groups_h
#define quoin_joint_elements_face_groups_h

#include <quoin/base/native_lanes.h>
#include <quoin/base/node_record.h>
#include <quoin/mesh/node_map.h>
#include <quoin/operators/energy_accounts.h>

#include <deal.II/base/point.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace quoin
{
  /** The vertices of faces that are computed together, by their nodes. */
  template <int dim, int lanes>
  struct GroupVertices
  {
    /** Offsets in arrays of dealii::Tensor<1, 2> [B] of the lower vertices,
        then the upper ones; in those of NodeRecord they are twice as large. */
    std::uint32_t nodes[4][lanes];
  };

  /** The vertices of triangles, by their pairs of nodes in the chunk. */
  template <int lanes>
  struct GroupVertices<3, lanes>
  {
    std::uint16_t pairs[3][lanes]; /**< offsets in rows of FaceNodes [B] */
  };

  /**
   * Faces of matched joints that are computed together, one in each SIMD lane:
   * segments in two dimensions, triangles in three, with dim points each. Lanes
   * without a face repeat the nodes of the last one and have no area.
   */
  template <int dim, int lanes>
  struct FaceGroup : GroupVertices<dim, lanes>
  {
    std::uint32_t first; /**< index of the first face */
    std::uint32_t size;  /**< number of faces */
    /** Areas of the points; those of a triangle are the same [m^2]. */
    double area[dim == 2 ? 2 : 1][lanes];
    double share[lanes]; /**< fraction of the energy that this rank counts */

    const double *area_of(const unsigned int point) const
    {
      return area[dim == 2 ? point : 0];
    }
  };

  /** A lower and an upper node that are at the same place in the mesh: their
      offsets in arrays of dealii::Tensor<1, 3> [B]. */
  struct NodePair
  {
    std::uint32_t lower, upper;
  };

  /** Groups of one set that follow each other, in three dimensions those whose
      pairs of nodes are loaded together. */
  struct FaceChunk
  {
    /** So that pairs stay in the cache beside the history of their faces. */
    static constexpr unsigned int most_pairs = 128;

    unsigned int first_group, n_groups;
    unsigned int first_pair, n_pairs;
  };

  /** The faces of the joint sets in groups of native_lanes. */
  template <int dim>
  class FaceGroups
  {
  public:
    /** Groups @p faces of @p nodes, which are sorted by the @p n_sets sets.
        Collective. */
    template <typename Face>
    void prepare(const std::vector<Face> &faces, unsigned int n_sets,
                 const NodeMap<dim> &nodes);

    /** Group @p index, or the last one. */
    const FaceGroup<dim, native_lanes> &group_at(const std::size_t index) const
    {
      return groups[std::min<std::size_t>(index, groups.size() - 1)];
    }
    const std::vector<NodePair> &node_pairs() const
    {
      return pairs;
    }
    /** Whether nodes are prefetched, as they do not fit the cache of a core. */
    bool prefetches_nodes() const
    {
      return prefetches;
    }
    /** A point near the joints, the same on all ranks, so that both ranks of a
        face compute the same numbers [m]. */
    const dealii::Point<dim> &origin() const
    {
      return least;
    }

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
    std::vector<FaceChunk> chunks;
    std::vector<unsigned int> set_begin; /**< first chunk of each set */
    std::vector<NodePair> pairs;         /**< of the chunks, in 3D */
    bool prefetches = false;
    dealii::Point<dim> least;
  };
} // namespace quoin

#endif
