// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/results/history_parameters.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace quoin
{
  namespace
  {
    struct Kind
    {
      HistoryQuantity quantity;
      unsigned int component;
      const char *unit;
      /** Dimension of the models of blocks that have it; 0: any. */
      unsigned int dimension = 2;
    };

    const std::map<std::string, Kind> &kinds()
    {
      using Q                                        = HistoryQuantity;
      static const std::map<std::string, Kind> table = {
        { "displacement x", { Q::displacement, 0, "m", 0 } },
        { "displacement y", { Q::displacement, 1, "m", 0 } },
        { "displacement z", { Q::displacement, 2, "m", 3 } },
        { "velocity x", { Q::velocity, 0, "m/s", 0 } },
        { "velocity y", { Q::velocity, 1, "m/s", 0 } },
        { "velocity z", { Q::velocity, 2, "m/s", 3 } },
        { "relative displacement x", { Q::relative_displacement, 0, "m", 0 } },
        { "relative displacement y", { Q::relative_displacement, 1, "m", 0 } },
        { "relative displacement z", { Q::relative_displacement, 2, "m", 3 } },
        { "tilt", { Q::tilt, 0, "deg" } },
        { "distance change", { Q::distance_change, 0, "m", 0 } },
        { "stress xx", { Q::stress, 0, "Pa", 0 } },
        { "stress yy", { Q::stress, 1, "Pa", 0 } },
        { "stress xy", { Q::stress, 2, "Pa", 0 } },
        { "stress zz", { Q::stress, 3, "Pa", 0 } },
        { "stress xz", { Q::stress, 4, "Pa", 3 } },
        { "stress yz", { Q::stress, 5, "Pa", 3 } },
        { "stress 1", { Q::principal_stress, 0, "Pa", 0 } },
        { "stress 2", { Q::principal_stress, 1, "Pa", 0 } },
        { "stress 3", { Q::principal_stress, 2, "Pa", 3 } },
        { "yielding", { Q::yielding, 0, "-", 0 } },
        { "plastic shear strain", { Q::yielding, 1, "-", 0 } },
        { "rotation", { Q::rotation, 0, "deg" } },
        { "joint opening", { Q::joint, 0, "m", 0 } },
        { "joint slip", { Q::joint, 1, "m", 0 } },
        { "joint normal traction", { Q::joint, 2, "Pa", 0 } },
        { "joint shear traction", { Q::joint, 3, "Pa", 0 } },
        { "joint state", { Q::joint, 4, "-", 0 } },
        { "joint damage", { Q::joint, 5, "-", 0 } },
        { "joint crushing", { Q::joint, 6, "m", 0 } },
        { "joint slip x", { Q::joint, 7, "m", 3 } },
        { "joint slip y", { Q::joint, 8, "m", 3 } },
        { "joint slip z", { Q::joint, 9, "m", 3 } },
        { "joint force x", { Q::joint_force, 0, "N", 3 } },
        { "joint force y", { Q::joint_force, 1, "N", 3 } },
        { "joint force z", { Q::joint_force, 2, "N", 3 } },
        { "joint water pressure", { Q::joint, 7, "Pa" } },
        { "joint hydraulic aperture", { Q::joint, 8, "m" } },
        { "joint flow", { Q::joint, 9, "m^3/s" } },
        { "joint flow velocity", { Q::joint, 10, "m/s" } },
        { "joint saturation", { Q::joint, 11, "-" } },
        { "water inflow", { Q::water, 0, "m^3/s" } },
        { "water outflow", { Q::water, 1, "m^3/s" } },
        { "reaction x", { Q::reaction, 0, "N", 0 } },
        { "reaction y", { Q::reaction, 1, "N", 0 } },
        { "reaction z", { Q::reaction, 2, "N", 3 } },
        { "reaction moment", { Q::reaction, 2, "N m" } },
        { "reaction moment x", { Q::reaction, 3, "N m", 3 } },
        { "reaction moment y", { Q::reaction, 4, "N m", 3 } },
        { "reaction moment z", { Q::reaction, 5, "N m", 3 } },
        { "platen displacement x", { Q::platen_displacement, 0, "m", 0 } },
        { "platen displacement y", { Q::platen_displacement, 1, "m", 0 } },
        { "platen displacement z", { Q::platen_displacement, 2, "m", 3 } },
        { "platen rotation x", { Q::platen_displacement, 3, "deg", 3 } },
        { "platen rotation y", { Q::platen_displacement, 4, "deg", 3 } },
        { "platen rotation z", { Q::platen_displacement, 5, "deg", 3 } },
        { "platen displacement rotation",
          { Q::platen_displacement, 2, "deg" } },
        { "platen force x", { Q::platen_force, 0, "N", 0 } },
        { "platen force y", { Q::platen_force, 1, "N", 0 } },
        { "platen force z", { Q::platen_force, 2, "N", 3 } },
        { "platen moment x", { Q::platen_force, 3, "N m", 3 } },
        { "platen moment y", { Q::platen_force, 4, "N m", 3 } },
        { "platen moment z", { Q::platen_force, 5, "N m", 3 } },
        { "platen force moment", { Q::platen_force, 2, "N m" } },
        { "unbalanced ratio", { Q::unbalanced_ratio, 0, "-", 0 } },
        { "kinetic energy share", { Q::kinetic_share, 0, "-", 0 } },
        { "load time", { Q::load_time, 0, "s", 0 } },
        { "loading rate", { Q::loading_rate, 0, "-", 0 } },
        { "load factor", { Q::load_factor, 0, "-", 0 } },
        { "controlled displacement",
          { Q::controlled_displacement, 0, "m", 0 } },
        { "contacts", { Q::contacts, 0, "-" } },
        { "blocks outside", { Q::blocks_outside, 0, "-" } },
        { "open joints", { Q::open_joints, 0, "m" } },
        { "block displacement x", { Q::block_displacement, 0, "m" } },
        { "block displacement y", { Q::block_displacement, 1, "m" } },
        { "block rotation", { Q::block_displacement, 2, "deg" } },
        { "block velocity x", { Q::block_velocity, 0, "m/s" } },
        { "block velocity y", { Q::block_velocity, 1, "m/s" } },
        { "block spin", { Q::block_velocity, 2, "deg/s" } },
        { "block force x", { Q::block_force, 0, "N" } },
        { "block force y", { Q::block_force, 1, "N" } },
        { "block force moment", { Q::block_force, 2, "N m" } },
        { "cable axial force", { Q::cable, 0, "N" } },
        { "cable largest force", { Q::cable, 1, "N" } },
        { "cable head force", { Q::cable, 2, "N" } },
        { "cable bond slip", { Q::cable, 3, "m" } },
        { "cable shear force", { Q::cable, 4, "N" } },
        { "cable shear displacement", { Q::cable, 5, "m" } },
        { "cable breaks", { Q::cable, 6, "-" } },
        { "cable yields", { Q::cable, 7, "-" } },
        { "cable slipped length", { Q::cable, 8, "m" } },
        { "cable slipped share", { Q::cable, 9, "-" } },
        { "cable largest tension", { Q::cable, 10, "N" } },
        { "cable largest compression", { Q::cable, 11, "N" } },
        { "beam displacement x", { Q::beam, 0, "m" } },
        { "beam displacement y", { Q::beam, 1, "m" } },
        { "beam axial force", { Q::beam, 2, "N" } },
        { "beam shear force", { Q::beam, 3, "N" } },
        { "beam moment", { Q::beam, 4, "N m" } },
        { "beam largest displacement", { Q::beam, 5, "m" } },
        { "beam largest axial force", { Q::beam, 6, "N" } },
        { "beam largest shear force", { Q::beam, 7, "N" } },
        { "beam largest moment", { Q::beam, 8, "N m" } },
        { "beam utilisation", { Q::beam, 9, "-" } },
        { "beam largest utilisation", { Q::beam, 10, "-" } },
        { "boundary displacement x", { Q::boundary_displacement, 0, "m" } },
        { "boundary displacement y", { Q::boundary_displacement, 1, "m" } },
        { "boundary velocity x", { Q::boundary_velocity, 0, "m/s" } },
        { "boundary velocity y", { Q::boundary_velocity, 1, "m/s" } },
        { "boundary traction x", { Q::boundary_traction, 0, "Pa" } },
        { "boundary traction y", { Q::boundary_traction, 1, "Pa" } },
        { "boundary hoop stress", { Q::boundary_hoop_stress, 0, "Pa" } },
        { "boundary force x", { Q::boundary_force, 0, "N" } },
        { "boundary force y", { Q::boundary_force, 1, "N" } },
        { "boundary moment", { Q::boundary_force, 2, "N m" } }
      };
      return table;
    }

    void enter(ParameterEntries &entries, HistoryParameters &history)
    {
      std::vector<std::pair<std::string, std::string>> words;
      for (const auto &[name, kind] : kinds())
        words.emplace_back(name, name);
      std::string quantity = "displacement x";
      entries.choice(
          "Quantity", quantity, words,
          "Quantity of the column, in SI units. 'stress 1' and 'stress 2' are "
          "the larger and the smaller principal stress in the plane, in three "
          "dimensions the largest and the intermediate one. 'yielding' is 0 in "
          "a cell that has never yielded, otherwise a sum of 1 for shear and 2 "
          "for tension in the last step, 4 and 8 for shear and tension in "
          "earlier steps; 'plastic shear strain' is accumulated. 'kinetic "
          "energy share' is the kinetic energy divided by the energy "
          "throughput. 'joint damage' is the fraction of tensile strength and "
          "cohesion that a composite law has lost, 'joint crushing' the "
          "plastic displacement on its cap. Slip, opening and tractions of a "
          "joint have the directions of the face to which the nearest point "
          "belongs, also at a bend between two faces. In three dimensions "
          "'joint slip' and 'joint shear traction' are magnitudes, 'joint slip "
          "x' and the like "
          "components of the slip of the upper side, and 'joint force x' and "
          "the like the force on the upper sides of all joints on 'Curve'. "
          "'joint flow' is the flow of water "
          "along the face of a joint, positive to the right, or upwards in a "
          "vertical one, 'joint flow velocity' its mean over the aperture. "
          "'water inflow' is the flow into the joints at 'Water boundary', or "
          "where they end on or cross 'Curve', 'water outflow' that out of "
          "them; without either, all that comes in or goes out anywhere. "
          "'contacts' is the number of "
          "contact points in compression, without matched joints; 'open "
          "joints' is the length of matched joints that have failed in tension "
          "or are open. 'load factor' is the factor of a stage's 'Load "
          "pattern', and 'controlled displacement' its controlled displacement "
          "from the start of the stage on; both are 'nan' in stages without a "
          "pattern. 'blocks outside' is the number of blocks that have left "
          "the 'Box' of section 'Contact', including deleted ones. 'relative "
          "displacement x' is the displacement of 'Second point' minus that of "
          "'Point', 'distance change' the change of their distance since the "
          "start, 'tilt' the angle by which the line from 'Point' to 'Second "
          "point' has turned, from -180 to 180, anticlockwise. 'block "
          "displacement x', 'block velocity x' and the like belong to the "
          "centroid of 'Block', 'block rotation' (full turns counted, "
          "anticlockwise) and 'block spin' to the block as a whole; 'block "
          "force x' and 'block force y' are the force on 'Block' by 'Second "
          "block', or by all others, over joints and contacts, 'block force "
          "moment' its moment about the current centroid of 'Block'. "
          "'beam moment' and the like belong to 'Beam', at its node nearest to "
          "'Point', and are 0 before it is placed; its 'largest' values are "
          "the largest magnitudes along it; 'beam utilisation' is the larger "
          "one of both stresses of the outer fibres by its strength. "
          "'rotation' is that of the nearest rigid block, full turns counted, "
          "or of the nearest cell, from -180 to 180, anticlockwise. The stress "
          "of rigid blocks is written as 0. In a block that has been deleted "
          "all quantities are 'nan', in one that is excavated or not placed "
          "yet 0, and so are those of two points of which one is in such a "
          "block. 'cable axial force' and the like are of one bolt of 'Cable': "
          "at the element, head, node or dowel nearest to 'Point', 'cable "
          "largest force' the largest by magnitude of all of its elements, "
          "negative if that is a compression, 'cable largest tension' and "
          "'cable largest compression' each by itself, both positive, 'cable "
          "breaks' the number of "
          "elements that have broken, 'cable yields' of those that have "
          "yielded or broken, 'cable slipped length' the length of bond that "
          "slips or has slipped, of all bars of 'Cable', 'cable slipped share' "
          "the same by the length of all their bond. Quantities of a "
          "'boundary' belong to "
          "boundary elements: "
          "velocities and tractions are the means over their last completed "
          "step, and 0 before the first stage with 'End = time' in which they "
          "act. With 'Model = boundary elements', displacements and velocities "
          "are those in the domain, velocities the means over the step before "
          "the row, half a step late. 'boundary hoop stress' is the normal "
          "stress along the boundary, 'boundary force' the force on the "
          "domain.");
      const Kind &kind  = kinds().at(quantity);
      history.quantity  = kind.quantity;
      history.component = kind.component;
      history.unit      = kind.unit;
      history.word      = quantity;
      history.dimension = kind.dimension;
      const auto read_point
          = [&](const ParameterSection &from, const std::string &name,
                std::array<double, 3> &point)
      {
        const bool has_z = from.list(name).size() == 3;
        if (has_z)
          point = from.numbers<3>(name);
        else
          std::copy_n(from.numbers<2>(name).begin(), 2, point.begin());
        return has_z;
      };
      entries.other(
          "Point", "0, 0",
          "Point x, y and, in three dimensions, z. Displacement and velocity "
          "are interpolated there; outside of all blocks they are those of the "
          "nearest node, as the screen then says. Other quantities are those "
          "of the nearest cell, joint point or boundary element; with boundary "
          "elements alone it is the point in the domain, or the reference "
          "point of moments. Where blocks meet, the block that contains the "
          "point is taken, or else, of those and of joints that end there, "
          "that which is there in more of the stages, on the wall of an "
          "excavation that of the rock, or else the lower or left one [m]",
          [&](const ParameterSection &from)
          { history.point_has_z = read_point(from, "Point", history.point); });
      if (entries.reads_if(history.is_of_two_points()))
        entries.other(
            "Second point", "",
            "Second point of quantities between two points, with as many "
            "coordinates as 'Point' [m]",
            [&](const ParameterSection &from)
            {
              if (from.text("Second point").empty())
                from.fail("Second point", "must be given: the quantity is one "
                                          "of two points.");
              if (read_point(from, "Second point", history.other_point)
                  != history.point_has_z)
                from.fail("Second point",
                          "must have as many coordinates as 'Point'.");
              if (history.other_point == history.point)
                from.fail("Second point", "is 'Point' itself. Give another "
                                          "point.");
            });
      const bool of_load
          = kind.quantity == HistoryQuantity::reaction
            || kind.quantity == HistoryQuantity::platen_displacement
            || kind.quantity == HistoryQuantity::platen_force;
      if (entries.reads_if(of_load))
        entries.text("Load", history.load,
                     "Load whose reaction or platen is recorded.");
      if (entries.reads_if(kind.quantity == HistoryQuantity::joint
                           || kind.quantity == HistoryQuantity::joint_force
                           || kind.quantity == HistoryQuantity::water
                           || kind.quantity == HistoryQuantity::boundary_force))
        entries.text(
            "Curve", history.curve,
            "Physical curve on which the nearest joint point of joint "
            "quantities is searched, or over which joint forces are summed, "
            "with 'unnamed' for joints on no named curve and empty for all; "
            "where the flow of water is summed; a physical surface in three "
            "dimensions; or the name of the boundary in 'Boundary elements' of "
            "boundary forces and moments.");
      if (entries.reads_if(history.is_of_block()))
        entries.text("Block", history.block,
                     "Block whose quantities are recorded, one of the 'Names' "
                     "of section 'Blocks'.");
      if (entries.reads_if(history.quantity == HistoryQuantity::block_force))
        entries.text("Second block", history.other_block,
                     "Named block whose force on 'Block' is recorded; empty: "
                     "the force of all other blocks together.");
      if (entries.reads_if(history.quantity == HistoryQuantity::cable))
        entries.text("Cable", history.cable,
                     "Bolts whose quantities are recorded, one of the 'Names' "
                     "of section 'Reinforcement'.");
      if (entries.reads_if(history.quantity == HistoryQuantity::beam))
        entries.text("Beam", history.beam,
                     "Beam whose quantities are recorded, one of the 'Names' "
                     "of section 'Beams'.");
      if (entries.reads_if(history.quantity == HistoryQuantity::water))
        entries.text(
            "Water boundary", history.water,
            "Place whose flow of water is recorded, one of the "
            "'Names' of section 'Water boundaries'; empty: 'Curve', or "
            "all places.");
      const ParameterSection *section = entries.read_section();
      if (!section)
        return;
      if (!history.water.empty() && !history.curve.empty())
        section->fail("Water boundary", "and 'Curve': give one of them.");
      if (of_load && history.load.empty())
        section->fail("Load", "must name the load to be recorded.");
      if (kind.quantity == HistoryQuantity::boundary_force
          && history.curve.empty())
        section->fail("Curve", "must name the boundary on which the force "
                               "acts.");
    }
  } // namespace

  template <int dim>
  void HistoryParameters::check_dimension() const
  {
    const std::string where = "section 'Histories/" + name + "': ";
    if (dimension != 0 && dimension != dim)
    {
      std::vector<std::string> known;
      for (const auto &[name, kind] : kinds())
        if (kind.dimension == 0 || kind.dimension == dim)
          known.push_back(name);
      throw InputError(where + "'Quantity = " + word + "' is one of models in "
                       + (dim == 2 ? "three dimensions, and this one has two"
                                   : "two dimensions, and this one has three")
                       + ". Name another quantity, of: "
                       + known_names_like(word, known) + ".");
    }
    const bool has_point = quantity == HistoryQuantity::displacement
                           || quantity == HistoryQuantity::velocity
                           || is_of_two_points()
                           || quantity == HistoryQuantity::stress
                           || quantity == HistoryQuantity::joint
                           || quantity == HistoryQuantity::yielding
                           || quantity == HistoryQuantity::principal_stress;
    if (point_has_z != (dim == 3) && (has_point || point_has_z))
      throw InputError(where + "'Point' must have "
                       + (dim == 2 ? "two coordinates, x and y"
                                   : "three coordinates, x, y and z")
                       + ", in metres.");
  }

  template void HistoryParameters::check_dimension<2>() const;
  template void HistoryParameters::check_dimension<3>() const;

  bool HistoryParameters::exists_in(const std::string &quantity,
                                    const unsigned int dimensions)
  {
    const auto found = kinds().find(quantity);
    return found == kinds().end() || found->second.dimension == 0
           || found->second.dimension == dimensions;
  }

  bool HistoryParameters::is_of_plane(const std::string &quantity)
  {
    const auto found = kinds().find(quantity);
    return found != kinds().end() && found->second.dimension == 2;
  }

  void HistoryParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter);
  }

  HistoryParameters HistoryParameters::read(const ParameterSection &section,
                                            const std::string &name)
  {
    HistoryParameters history = read_entries(section, enter);
    history.name              = name;
    return history;
  }
} // namespace quoin
