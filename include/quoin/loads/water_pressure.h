// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_water_pressure_h
#define quoin_loads_water_pressure_h

#include <quoin/base/node_exchange.h>
#include <quoin/base/thickness.h>
#include <quoin/loads/load_field.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/force_operator.h>

#include <array>
#include <memory>
#include <vector>

namespace quoin
{
  /**
   * Water at rest that presses on faces of blocks where they are now: the
   * pressure @f$ p = \gamma_w \max(0, h - y) @f$ below the level h, y the
   * present height of the place, acts along the present normal and on the
   * present area,
   * @f[ f_k = - A n \int N_k \, p , @f]
   * with the linear functions N_k of the face's nodes; a share of the
   * resultant goes to nodes as BoundaryFace::shares says. The integrals are
   * exact: a face is cut where the level has a kink and where it meets it.
   *
   * A model that moves in the water so gains and loses what Archimedes says.
   */
  template <int dim>
  class WaterPressure
  {
  public:
    /** @p water: a pressure of water up to a level; @p faces are those of all
        ranks. Collective. */
    WaterPressure(const LoadField &water, const NodeMap<dim> &node_map,
                  const std::vector<BoundaryFace<dim>> &faces,
                  const Thickness &thickness);

    /** Takes the places of the faces from @p nodes, the local ones.
        Collective. */
    void follow(const AlignedArray<NodeRecord<dim>> &nodes);
    /** Returns the faces to their places in the mesh. */
    void return_to_mesh();

    /** The local nodes that this rank owns. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }
    /** The force on each of nodes() [N]; computed when it changes. */
    const std::vector<dealii::Tensor<1, dim>> &
    forces(const TimePoint &time) const;

    /** Passes every face that this rank takes care of to @p take, without
        forces; its stiffness is @p share of minus the derivative of forces()
        by the places of its nodes [N/m], which is not symmetric. */
    void linearise(const TimePoint &time, double share, bool with_stiffness,
                   const TakeElement<dim> &take) const;

    /** How often the faces have changed their places. */
    std::size_t n_moves() const
    {
      return moves;
    }

  private:
    struct Face
    {
      std::array<unsigned int, dim> points; /**< indices into places */
      std::array<unsigned int, dim> slots;  /**< into nodes(), or none */
      std::array<unsigned int, dim> nodes;  /**< local, if it is linearised */
      std::array<double, dim> shares;
      double thickness;
      bool is_linearised; /**< by this rank */
    };
    /** Integrals over the part of a face below water, by its area: of a node's
        function times the depth [m], and of two functions, without a factor
        and with the level's slope along x [-]. */
    struct Wet
    {
      std::array<double, dim> depth{};
      std::array<std::array<double, dim>, dim> product{}, slope{};
    };

    /** The level at @p time [m]; 0 where a line gives it. */
    double level_at(const TimePoint &time) const;
    Wet wet_part(const Face &face, double level, bool with_products) const;
    /** What nodes get of the integrals @p depth of their functions: those, and
        what BoundaryFace::shares move from one to the other. */
    static std::array<double, dim>
    weights_of(const Face &face, const std::array<double, dim> &depth);
    /** Normal out of the block, times the area [m^2]. */
    dealii::Tensor<1, dim> outward(const Face &face) const;

    LoadField water;
    /** It brings the nodes of faces that other ranks own. */
    std::unique_ptr<const NodeExchange> exchange;
    std::vector<unsigned int> node_list;
    std::vector<Face> faces;
    /** Nodes of the faces: places now and in the mesh [m], and where they are
        in the local nodes, or behind them in those of other ranks. */
    std::vector<dealii::Point<dim>> places, mesh_places;
    std::vector<unsigned int> sources;
    std::vector<NodeRecord<dim>> from_others;
    std::size_t moves = 0;
    // What forces() found last, and for which level and places.
    mutable double last_level;
    mutable std::size_t last_moves;
    mutable std::vector<dealii::Tensor<1, dim>> last_forces;
  };
} // namespace quoin

#endif
