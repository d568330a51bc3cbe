// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_hydrodynamic_mass_h
#define quoin_loads_hydrodynamic_mass_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/step_context.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** A symmetric mass matrix of a node [kg], which is not the same in all
      directions. */
  template <int dim>
  struct NodeMass
  {
    unsigned int node; /**< local, owned */
    dealii::Tensor<2, dim> mass;
  };

  /**
   * The water before a face that an earthquake shakes, as a mass that moves
   * with it along its normal (@cite Westergaard1933, for inclined faces
   * @cite Kuo1982): 7/8 rho sqrt(H z) by the area, where z is the depth and
   * H that of the reservoir. A node has the integral of phi_i times this times
   * n n^T over its faces, with the functions phi_i of TractionField; it is
   * exact for straight faces. Normals are those of the mesh.
   */
  class HydrodynamicMass
  {
  public:
    /** @p load: with 'Added mass'. Collective; throws an InputError about a
        face that is too flat or belongs to a rigid block. */
    HydrodynamicMass(const LoadParameters &load, const NodeMap<2> &nodes,
                     const Thickness &thickness);

    const std::string &name() const
    {
      return load_name;
    }

    /** Masses of the owned nodes, ascending, with the level at @p start of a
        stage [s]. */
    std::vector<NodeMass<2>> masses(double start) const;
    /** Whether the level changes in the @p duration of a stage [s]. */
    bool changes(double start, double duration) const;

  private:
    struct Face
    {
      std::array<dealii::Point<2>, 2> points;
      std::array<unsigned int, 2> nodes; /**< local, or none */
      std::array<double, 2> shares;
      dealii::Tensor<1, 2> outward; /**< normal times area [m^2] */
    };

    std::string load_name;
    TimeFunction level; /**< of the water [m] */
    double floor;       /**< of the reservoir [m] */
    std::vector<Face> faces;
  };

  /** @p a and @p b, both ascending, in one list. */
  std::vector<NodeMass<2>> merged(const std::vector<NodeMass<2>> &a,
                                  const std::vector<NodeMass<2>> &b);
} // namespace quoin

#endif
