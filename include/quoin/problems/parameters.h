// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_problems_parameters_h
#define quoin_problems_parameters_h

#include <quoin/base/time_control.h>
#include <quoin/farfield/boundary_parameters.h>
#include <quoin/results/history_parameters.h>
#include <quoin/loads/initial_motion.h>
#include <quoin/dynamics/model.h>
#include <quoin/dynamics/stage_parameters.h>
#include <quoin/implicit/implicit_parameters.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <string>
#include <vector>

namespace quoin
{
  /** Blocks that the program lays itself. */
  struct GeneratedGeometry
  {
    std::string name;       /**< of its files: wall, rock */
    std::string geometry;   /**< text of a .geo file; empty: there is none */
    std::string report;     /**< what was laid, in lines */
    std::string statistics; /**< a table (CSV), or empty */
  };

  /** All that a parameter file says. */
  struct Parameters
  {
    std::string file; /**< the parameter file */
    std::string title;
    std::string output_directory; /**< relative to the working directory */

    /** A run of boundary elements alone; if not, one of blocks. */
    bool is_boundary_model = false;
    BoundaryElementParameters boundary;

    std::string mesh_file;       /**< relative to the working directory */
    GeneratedGeometry generated; /**< instead of the file, or empty */
    TriangleKind triangles = TriangleKind::plain;
    SplitOptions split;

    ModelParameters model;
    std::vector<LoadParameters> loads; /**< initial stresses included */
    std::vector<StageParameters> stages;
    InitialMotion initial_motion;

    /** Equilibrium by Newton's method instead of motion. */
    bool is_implicit = false;
    ImplicitParameters implicit;

    double share_of_critical_step = 0.8;
    double time_step              = 0.; /**< [s]; 0: automatic */

    std::vector<HistoryParameters> histories;
    double history_interval    = 0.;  /**< [s] */
    double field_interval      = 0.;  /**< [s] */
    double checkpoint_interval = 60.; /**< [s] */
    bool measure_bandwidth     = false;

    /** When rows of histories.csv are due, and when fields are. */
    TimeControl row_times() const
    {
      return TimeControl(history_interval);
    }
    TimeControl field_times() const
    {
      return TimeControl(field_interval > 0. ? field_interval : -1.);
    }

    /** All values; paths stay relative to the parameter file. */
    std::string effective;
    /** Of tables and records, relative to the working directory. */
    std::vector<std::string> time_files;
  };

  /**
   * Reads the parameter file @p file, with @p overrides of the form
   * "Section/Name=value" applied. Throws an InputError that names file,
   * section, value and cure.
   */
  Parameters read_parameters(const std::string &file,
                             const std::vector<std::string> &overrides);

  /** Every parameter there is, with defaults and meaning, as a prm file. */
  std::string describe_parameters();
} // namespace quoin

#endif
