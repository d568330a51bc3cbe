// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_gmsh_process_h
#define quoin_mesh_gmsh_process_h

#include <quoin/mesh/gmsh_mesh.h>

#include <string>
#include <vector>

namespace quoin
{
  /** Throw an InputError of the mesh named @p source. */
  [[noreturn]] void fail_on_mesh(const std::string &source,
                                 const std::string &what);

  /**
   * Run the program quoin_gmsh, which lies in the folder of this program or in
   * the one above, and wait for its end. @p arguments are those of its command
   * line, @p input is what it reads from `/dev/stdin`; @p cure: what the user
   * may do if gmsh ends before it is through.
   *
   * Throws InputError if the program is not there or is killed, and if gmsh
   * crashes or ends the process, with @p source as the name of the mesh.
   */
  GmshMesh run_gmsh(const std::string &source,
                    const std::vector<std::string> &arguments,
                    const std::string &input = "",
                    const std::string &cure
                    = "The file is damaged, has a command such as Exit, or a "
                      "surface whose curves cross each other. Open it in gmsh "
                      "and repair it there.");
} // namespace quoin

#endif
