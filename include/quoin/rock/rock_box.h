// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_rock_box_h
#define quoin_rock_rock_box_h

#include <quoin/base/parameter_section.h>
#include <quoin/layout/gmsh_geometry.h>
#include <quoin/rock/block_cutter.h>
#include <quoin/rock/distribution.h>
#include <quoin/rock/random_stream.h>

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

  /** The sections 'Rock box' and 'Rock joint sets'. */
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
    std::vector<SpaceJointSet> sets; /**< in the order of cutting */

    bool is_there() const
    {
      return low != high;
    }
    /** The section 'Rock box' alone. */
    static void declare(dealii::ParameterHandler &prm);
    static RockBoxParameters read(const ParameterSection &top);
  };

  /** A box of rock in blocks. */
  struct RockBox
  {
    BlockCutter blocks;
    /** Planes of each set, from the lowest position along the mean normal. */
    std::vector<std::vector<JointPlane>> planes;
    unsigned int n_refused = 0; /**< cuts left out to keep blocks whole */
    std::vector<double> refused_area = {}; /**< of them, of each set [m^2] */

    /** Surface of the faces of a set in the blocks. */
    static unsigned int surface(const unsigned int set)
    {
      return 6 + set;
    }
    double box_volume() const;                 /**< [m^3] */
    double joint_area(unsigned int set) const; /**< [m^2] */
    /** Joints of @p set by length of a line along the unit vector
        @p direction (P10 [1/m]): the mean of all such lines in the box. */
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
   * Draws the planes of each set and cuts all blocks by them, set by set.
   * Throws InputError if there are more than 'Most blocks'.
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
