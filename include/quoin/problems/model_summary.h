// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_model_summary_h
#define quoin_problems_model_summary_h

#include <quoin/farfield/boundary_geometry.h>
#include <quoin/problems/parameters.h>
#include <quoin/mesh/mesh_report.h>
#include <quoin/mesh/node_map.h>

#include <string>
#include <vector>

namespace quoin
{
  // What a parameter file means, a line each, for --check. All ranks get the
  // same lines; what asks for nodes is collective.

  /** P and S wave speeds [m/s]. */
  struct WaveSpeeds
  {
    double p, s;
  };
  WaveSpeeds wave_speeds(const LinearElastic &material, PlaneAssumption plane);

  /**
   * @p material_of_group: index into the materials of the parameters, as
   * ModelProperties has it.
   */
  std::vector<std::string>
  material_lines(const Parameters &parameters, const NodeMap<2> &nodes,
                 const std::vector<unsigned int> &material_of_group);

  /** Names of the curves in @p report are those of the mesh. */
  std::vector<std::string> joint_lines(const Parameters &parameters,
                                       const MeshReport &report);

  std::vector<std::string> load_lines(const Parameters &parameters,
                                      const NodeMap<2> &nodes);

  /** What is given on boundary elements in @p duration [s], and waves. */
  std::vector<std::string>
  boundary_lines(const BoundaryElementParameters &parameters,
                 const BoundaryGeometry &geometry, double duration);

  /** Law, stiffness, density, wave speeds and strength. */
  std::string material_text(const MaterialParameters &material,
                            PlaneAssumption plane);

  /** Loads, end, damping and what is built, but no time step. */
  std::string stage_line(const StageParameters &stage, bool is_implicit);

  /**
   * The function of a component over the stages in which @p load acts, such
   * as "5 Pa" or "from 0 to 5 Pa".
   */
  std::string value_text(const Parameters &parameters,
                         const LoadParameters &load,
                         const LoadComponent &component,
                         const std::string &unit);

  /** Edges of the loads' curves, or blocks of their groups; empty: all. */
  std::string place_text(const LoadParameters &load,
                         const NodeMap<2> &node_map);
} // namespace quoin

#endif
