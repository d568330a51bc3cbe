// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_water_joint_channels_h
#define quoin_water_joint_channels_h

#include <quoin/base/thickness.h>
#include <quoin/joint_elements/matched_joints.h>
#include <quoin/water/flow_network.h>
#include <quoin/water/water_parameters.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace quoin
{
  /** A channel's place in the mesh. */
  struct JointChannel
  {
    std::array<unsigned int, 2> lower, upper; /**< global nodes */
    std::array<dealii::Point<2>, 2> points;
    std::array<unsigned int, 2> blocks;
    std::array<double, 2> areas; /**< of the points [m^2] */
    unsigned int number = 0;     /**< of the joint face on all ranks */
    unsigned int set    = 0;
    double thickness    = 1.;

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &lower &upper &points &blocks &areas &number &set &thickness;
    }
  };

  /**
   * The network of flow in the matched joints of all ranks and where it lies in
   * the mesh. Nodes of the mesh that lie on each other are one node of the
   * network, also across joints without water.
   */
  class JointChannels
  {
  public:
    /**
     * Keeps a reference to @p nodes; @p sets: of joints. Throws an InputError
     * about names that the model does not have and about places with two
     * boundary values. Collective.
     */
    JointChannels(const WaterParameters &given, const NodeMap<2> &nodes,
                  const MatchedJoints &joints,
                  const std::vector<JointSetParameters> &sets,
                  const Thickness &thickness);

    static constexpr unsigned int no_channel = -1;

    /** A face of a dry joint at which channels end, such as that along which
        rock is excavated. */
    struct DryFace
    {
      std::array<unsigned int, 2> blocks;
      unsigned int node; /**< of the network */
    };

    FlowNetwork network;             /**< of closed joints */
    std::vector<JointChannel> faces; /**< of each channel */
    std::vector<DryFace> dry_faces;
    /** Channel of each local segment of the joints, or no_channel. */
    std::vector<unsigned int> of_segment;
    /** Aperture of each set of joints; null: no water. */
    std::vector<const HydraulicAperture *> aperture_of_set;
    std::vector<double> compliance_of_set; /**< of joints [m/Pa] */
    std::vector<double> elevation;         /**< of nodes [m] */
    /** Nodes of the network at each boundary of the parameters. */
    std::vector<std::vector<unsigned int>> boundary_nodes;

    /** Nodes of the network on @p curves, given by the entry @p entry. Throws
        an InputError that begins with @p where if there are none.
        Collective. */
    std::vector<unsigned int> nodes_on(const std::vector<std::string> &curves,
                                       const std::string &where,
                                       const std::string &entry) const;

  private:
    void make_network(const WaterParameters &given, const MatchedJoints &joints,
                      const std::vector<JointSetParameters> &sets,
                      const Thickness &thickness);
    void find_boundaries(const std::vector<WaterBoundary> &boundaries);

    const NodeMap<2> &node_map;
    /** Global nodes of the mesh and their node of the network. */
    std::vector<std::pair<unsigned int, unsigned int>> node_of_mesh;
  };
} // namespace quoin

#endif
