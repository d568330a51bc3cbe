// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_rock_box_h
#define quoin_rock_rock_box_h

#include <quoin/base/none.h>
#include <quoin/base/parameter_section.h>
#include <quoin/layout/gmsh_geometry.h>
#include <quoin/rock/block_cutter.h>
#include <quoin/rock/distribution.h>
#include <quoin/rock/random_stream.h>
#include <quoin/rock/rock_body.h>

#include <cstdint>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * Parallel or scattered planes: a subsection of 'Rock joint sets'. x is east,
   * y north and z up. Dips are below the horizontal, dip directions clockwise
   * from north [deg].
   */
  struct SpaceJointSet
  {
    std::string name;
    double dip = 0., dip_direction = 0.;
    double concentration = 0.; /**< kappa of Fisher [-]; 0: no scatter */
    Distribution spacing;
    double persistence = 1.; /**< share of the blocks that a plane cuts [-] */
    dealii::Point<3> origin; /**< on the first plane [m] */

    static void declare(dealii::ParameterHandler &prm);
    static SpaceJointSet read(const ParameterSection &section,
                              const std::string &name);
    /** Upward unit normal of the mean plane. */
    dealii::Tensor<1, 3> mean_normal() const;
  };

  /** The sections 'Rock box', 'Rock bodies' and 'Rock joint sets'. */
  struct RockBoxParameters
  {
    dealii::Point<3> low, high; /**< corners [m]; equal: there is no box */
    std::vector<std::string> sides
        = { "left", "right", "front", "back", "bottom", "top" };
    std::string group        = "rock"; /**< physical volume */
    std::uint64_t seed       = 1;
    double shortest_edge     = 0.; /**< [m] */
    double smallest_block    = 0.; /**< [m^3] */
    unsigned int most_blocks = 10000;
    double element_size      = 0.;   /**< [m] */
    std::vector<RockBody> bodies;    /**< the earlier prevails */
    std::vector<SpaceJointSet> sets; /**< in the order of cutting */

    bool is_there() const
    {
      return low != high;
    }
    /** The section 'Rock box' alone. */
    static void declare(dealii::ParameterHandler &prm);
    static RockBoxParameters read(const ParameterSection &top);
  };

  /**
   * A box of rock in blocks. The sets cut it into convex blocks, the surfaces
   * of bodies cut these into convex pieces; what belongs together of them is
   * one block.
   */
  struct RockBox
  {
    /** A body, or one of its rounds. */
    struct Part
    {
      std::string body;
      std::string group;   /**< physical volume */
      std::string surface; /**< physical surface; empty: it has no name */
      bool is_hole, has_joints;
      double size; /**< of elements at the surface [m] */
    };

    BlockCutter pieces;
    /** Planes of each set, from the lowest position along the mean normal. */
    std::vector<std::vector<JointPlane>> planes;
    unsigned int n_refused = 0;  /**< cuts left out to keep blocks whole */
    unsigned int n_moved   = 0;  /**< planes moved to leave out fewer */
    double largest_move    = 0.; /**< [m] */
    std::vector<double> refused_area = {}; /**< of them, of each set [m^2] */
    std::vector<Part> parts          = {};
    /** Part that a piece is of; none: the rock mass. */
    std::vector<unsigned int> part_of = {};

    /** Surface of the faces of a set in the pieces. */
    static unsigned int surface(const unsigned int set)
    {
      return 6 + set;
    }
    /** Surface of the faces that cuts by bodies make. */
    static constexpr unsigned int of_bodies = none;

    /** Part of a piece; null: it is rock mass, or outside of the box. */
    const Part *part(unsigned int piece) const;
    bool is_void(unsigned int piece) const;
    /** Whether there are different blocks, or a block and nothing, on both
        sides of a face of the pieces. */
    bool is_between_blocks(unsigned int face) const;
    /** Whether a face is a joint of @p set. */
    bool is_joint(unsigned int face, unsigned int set) const;
    /** The number of the block of each piece, none of voids, and of blocks.
        With @p apart the bodies are blocks of their own also where their
        surfaces are no joints. */
    std::pair<std::vector<unsigned int>, unsigned int> blocks(bool apart
                                                              = false) const;
    std::vector<double> block_volumes() const; /**< [m^3] */

    double rock_volume() const;                /**< voids are none [m^3] */
    double joint_area(unsigned int set) const; /**< [m^2] */
    /** Joints of @p set by length of a line along the unit vector
        @p direction (P10 [1/m]): the mean of all such lines in the rock. */
    double joint_frequency(unsigned int set,
                           const dealii::Tensor<1, 3> &direction) const;
    /** Crossings of the line from @p a to @p b with joints of @p set. */
    unsigned int n_crossings(unsigned int set, const dealii::Point<3> &a,
                             const dealii::Point<3> &b) const;
  };

  /** The upward unit normal of a plane; angles in degrees. */
  dealii::Tensor<1, 3> plane_normal(double dip, double dip_direction);

  /**
   * A direction of Fisher's distribution of concentration @p kappa > 0 about
   * the unit vector @p mean (@cite MardiaJupp2000).
   */
  dealii::Tensor<1, 3> draw_fisher(const dealii::Tensor<1, 3> &mean,
                                   double kappa, RandomStream &random);

  /**
   * Draws the planes of each set and cuts all blocks by them, set by set, then
   * by the surfaces of bodies. Throws InputError if there are more than 'Most
   * blocks', no joint or body cuts the rock, or a body lies outside of it.
   */
  RockBox cut_rock_box(const RockBoxParameters &rock);

  /** Lines on the blocks and on what was left out. */
  std::string rock_box_report(const RockBoxParameters &rock,
                              const RockBox &box);

  /**
   * A table (CSV) with a row for each set: mean dip and dip direction [deg],
   * area of joints per volume (P32 [1/m]) as asked and made, and joints by
   * length of a scanline along the mean normal (P10 [1/m]) as made; for each of
   * its planes: dip and dip direction; and for each block: volume [m^3].
   */
  std::string rock_box_statistics(const RockBoxParameters &rock,
                                  const RockBox &box);

  /** The blocks as a gmsh geometry; names of sets are physical surfaces. */
  GmshGeometry rock_box_geometry(const RockBoxParameters &rock,
                                 const RockBox &box);
} // namespace quoin

#endif
