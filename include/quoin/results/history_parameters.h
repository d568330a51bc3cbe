// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_results_history_parameters_h
#define quoin_results_history_parameters_h

#include <quoin/base/parameter_section.h>

#include <array>
#include <string>

namespace quoin
{
  enum class HistoryQuantity
  {
    displacement,
    velocity,
    relative_displacement, /**< relative displacement of two points */
    tilt,
    distance_change,
    stress,
    principal_stress,
    yielding,
    rotation,
    joint,
    joint_force, /**< of all joints on a surface, in three dimensions */
    reaction,
    platen_displacement,
    platen_force,
    unbalanced_ratio,
    kinetic_share,
    load_time,
    loading_rate,
    load_factor,
    controlled_displacement,
    contacts,
    blocks_outside,
    open_joints,
    block_displacement, /**< motion of a named block: x, y, rotation */
    block_velocity,
    block_force, /**< force between a block and others: x, y, moment */
    cable,       /**< of a bar: see CableQuantity */
    beam,        /**< of a beam: see BeamHistory */
    water,       /**< flow into joints, or out of them */
    boundary_displacement,
    boundary_traction,
    boundary_velocity,
    boundary_hoop_stress,
    boundary_force
  };

  /** One column of histories.csv: a subsection of 'Histories'. */
  struct HistoryParameters
  {
    std::string name;
    HistoryQuantity quantity = HistoryQuantity::displacement;
    unsigned int component   = 0; /**< index of x, y, z, or as kinds() says */
    std::string word;           /**< name of the quantity in parameter files */
    unsigned int dimension = 0; /**< dimension of models that have it; 0: any */
    std::string unit;
    std::array<double, 3> point{}; /**< [m]; z in three dimensions */
    bool point_has_z = false;      /**< z was given */
    /** Second point of quantities of two points [m]. */
    std::array<double, 3> other_point{};
    std::string load;
    std::string curve;
    std::string block, other_block; /**< named ones; the second may be empty */
    std::string cable;              /**< one of section 'Reinforcement' */
    std::string beam;
    std::string water; /**< one of section 'Water boundaries', or empty */

    /** Whether it is on boundary elements, alone or beyond blocks. */
    bool is_of_boundary() const
    {
      return quantity >= HistoryQuantity::boundary_displacement;
    }
    /** Whether it is in blocks or in the domain of boundary elements. */
    bool is_of_interior() const
    {
      return quantity == HistoryQuantity::displacement
             || quantity == HistoryQuantity::velocity;
    }

    /** Whether it is one of a named block. */
    bool is_of_block() const
    {
      return quantity == HistoryQuantity::block_displacement
             || quantity == HistoryQuantity::block_velocity
             || quantity == HistoryQuantity::block_force;
    }

    /** Whether it is one of the water that flows in a joint. */
    bool is_of_joint_water() const
    {
      return quantity == HistoryQuantity::joint && dimension == 2
             && component >= 7;
    }

    /** Name of the field of results of the laws of joints that it is; empty:
        all laws have it. */
    std::string law_field() const
    {
      return quantity != HistoryQuantity::joint ? ""
             : component == 5                   ? "damage"
             : component == 6                   ? "crushing"
                                                : "";
    }

    /** Whether it compares the displacements of two points. */
    bool is_of_two_points() const
    {
      return quantity == HistoryQuantity::relative_displacement
             || quantity == HistoryQuantity::tilt
             || quantity == HistoryQuantity::distance_change;
    }

    /** Whether it is a displacement of blocks, or an angle or distance by
        which they have moved. */
    bool is_displacement() const
    {
      return is_of_two_points() || quantity == HistoryQuantity::displacement
             || quantity == HistoryQuantity::rotation
             || quantity == HistoryQuantity::platen_displacement
             || quantity == HistoryQuantity::block_displacement;
    }

    /** Throws an InputError if a model of blocks in @p dim dimensions has no
        such quantity or point. */
    template <int dim>
    void check_dimension() const;

    /** Whether models of blocks in @p dimensions have @p quantity, or it is
        none. */
    static bool exists_in(const std::string &quantity, unsigned int dimensions);

    /** Whether @p quantity, as in a parameter file, is one of models in two
        dimensions alone. */
    static bool is_of_plane(const std::string &quantity);

    static void declare(dealii::ParameterHandler &prm);
    static HistoryParameters read(const ParameterSection &section,
                                  const std::string &name);
  };
} // namespace quoin

#endif
