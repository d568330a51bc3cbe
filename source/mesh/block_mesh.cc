// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/mesh/block_mesh.h>

namespace quoin
{
  void build_triangulation(BlockMesh<2> &mesh)
  {
    std::vector<dealii::CellData<2>> cells(mesh.n_cells(),
                                           dealii::CellData<2>(3));
    for (unsigned int c = 0; c < mesh.n_cells(); ++c)
    {
      cells[c].vertices.assign(mesh.cells[c].begin(), mesh.cells[c].end());
      cells[c].material_id = mesh.cell_group[c];
    }
    mesh.triangulation.clear();
    mesh.triangulation.create_triangulation(mesh.vertices, cells,
                                            dealii::SubCellData());

    // Face f of a deal.II triangle runs from its vertex f to the next one.
    const auto set_name
        = [&mesh](const unsigned int c, const unsigned int first_vertex,
                  const unsigned int name)
    {
      const dealii::TriaIterator<dealii::CellAccessor<2>> cell(
          &mesh.triangulation, 0, c);
      for (const unsigned int f : cell->face_indices())
        if (mesh.cells[c][f] == first_vertex && cell->at_boundary(f))
          cell->face(f)->set_boundary_id(name);
    };
    for (const BlockFace &face : mesh.boundary_faces)
      set_name(face.cell, face.vertices[0], face.name);
    for (const JointFace &face : mesh.joint_faces)
    {
      set_name(face.cells[0], face.lower[0], face.name);
      set_name(face.cells[1], face.upper[1], face.name);
    }
  }
} // namespace quoin
