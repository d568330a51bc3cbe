// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/layout/arch_layout.h>
#include <quoin/mesh/block_splitter.h>
#include <quoin/mesh/gmsh_reader.h>

#include <gtest/gtest.h>

#include <cmath>
#include <map>

using namespace quoin;

namespace
{
  /** Span 4 m, rise 1 m: radius 2.5 m, half of the angle asin 0.8. */
  ArchParameters bridge()
  {
    ArchParameters arch;
    arch.span              = 4.;
    arch.rise              = 1.;
    arch.ring              = 0.4;
    arch.n_voussoirs       = 9;
    arch.abutment          = { { 0.8, 0.5 } };
    arch.backing           = 0.8;
    arch.cover             = 0.3;
    arch.named_voussoirs   = { { 2, "loaded" }, { 3, "loaded" } };
    arch.element_size      = 0.2;
    arch.fill_element_size = 0.3;
    return arch;
  }

  /** The mesh of an arch, split at all of its joints. */
  struct MeshedArch
  {
    BlockMesh<2> mesh;
    std::map<std::string, double> joint_length, outer_length, area;
    std::map<std::string, unsigned int> n_blocks;

    explicit MeshedArch(const ArchParameters &arch)
    {
      const auto geometry = arch_geometry(arch, lay_arch(arch));
      SplitOptions options;
      options.joints_along = geometry.joint_curves;
      mesh                 = split_into_blocks(
                          mesh_gmsh_geometry(geometry.text, "arch", MPI_COMM_SELF), options);
      const auto length = [&](const std::array<unsigned int, 2> &v)
      { return mesh.vertices[v[0]].distance(mesh.vertices[v[1]]); };
      for (const auto &face : mesh.joint_faces)
        joint_length[mesh.face_names[face.name]] += length(face.lower);
      for (const auto &face : mesh.boundary_faces)
        outer_length[mesh.face_names[face.name]] += length(face.vertices);
      for (unsigned int c = 0; c < mesh.n_cells(); ++c)
      {
        const auto &cell = mesh.cells[c];
        const auto a     = mesh.vertices[cell[1]] - mesh.vertices[cell[0]];
        const auto b     = mesh.vertices[cell[2]] - mesh.vertices[cell[0]];
        area[mesh.group_names[mesh.cell_group[c]]]
            += 0.5 * (a[0] * b[1] - a[1] * b[0]);
      }
      for (unsigned int b = 0; b < mesh.n_blocks(); ++b)
        ++n_blocks[mesh.group_names[mesh.cell_group[mesh.block_first_cell[b]]]];
    }
  };
} // namespace

TEST(ArchLayout, HasTheAreasOfRingAndRectangles)
{
  const ArchParameters arch = bridge();
  const ArchLayout layout   = lay_arch(arch);
  const double half = std::asin(0.8), step = 2. * half / 9.;
  // A voussoir is a piece of a ring between two chords.
  const double voussoir = 0.5 * std::sin(step) * (2.9 * 2.9 - 2.5 * 2.5);
  EXPECT_NEAR(layout.area(ArchBlock::voussoir), 9. * voussoir, 1e-12);
  const double top = 0.4 * 0.6; // of the abutments
  const double abutment
      = 0.8 * 0.5 + 0.8 * top - 0.5 * top * 0.4 * 0.8; // less the joint's
  EXPECT_NEAR(layout.area(ArchBlock::abutment), 2. * abutment, 1e-12);
  // All are a rectangle without what is below the intrados.
  const double below = 4.5 * std::sin(step) * 2.5 * 2.5 - 2. * 1.5;
  double all         = 0.;
  for (const auto kind : { ArchBlock::voussoir, ArchBlock::abutment,
                           ArchBlock::backing, ArchBlock::fill })
  {
    EXPECT_GT(layout.area(kind), 0.);
    all += layout.area(kind);
  }
  EXPECT_NEAR(all, 5.6 * 1.7 - below + 2. * 0.8 * 0.5, 1e-12);
  EXPECT_EQ(layout.blocks.size(), 9U + 2U + 2U + 1U);
  EXPECT_NE(arch_report(layout).find("arch of 9 voussoirs"), std::string::npos);
}

TEST(ArchGeometry, NamesBlocksJointsAndBoundaries)
{
  const ArchParameters arch = bridge();
  MeshedArch meshed(arch);
  const ArchLayout layout = lay_arch(arch);
  EXPECT_EQ(meshed.n_blocks["voussoir"], 7U);
  EXPECT_EQ(meshed.n_blocks["voussoir_loaded"], 2U);
  EXPECT_EQ(meshed.n_blocks["abutment"], 2U);
  EXPECT_EQ(meshed.n_blocks["backing"], 2U);
  EXPECT_EQ(meshed.n_blocks["fill"], 1U);
  EXPECT_NEAR(meshed.area["fill"], layout.area(ArchBlock::fill), 1e-12);
  EXPECT_NEAR(meshed.area["backing"], layout.area(ArchBlock::backing), 1e-12);

  const double chord = 2. * std::sin(std::asin(0.8) / 9.);
  EXPECT_NEAR(meshed.joint_length["ring_joint"], 10. * 0.4, 1e-12);
  // The extrados, the tops of abutments and of backing are joints.
  // Each backing lies on its abutment and on the extrados up to y = 0.8.
  const double angle = std::asin(0.8) * (1. - 2. * 2. / 9.); // of a joint
  const double x = 2.9 * std::sin(angle), y = -1.5 + 2.9 * std::cos(angle);
  const double next = std::asin(0.8) * (1. - 2. * 1. / 9.);
  const double slope
      = (2.9 * std::cos(angle) - 2.9 * std::cos(next)) / (2.9 * chord);
  const double cut    = 2. * 2.9 * chord - (y - 0.8) / slope;
  const double ledge  = 2.8 - 2.9 * 0.8;
  const double middle = x + (y - 0.8) * std::sqrt(1. / slope / slope - 1.);
  EXPECT_NEAR(meshed.joint_length["backing_joint"], 2. * (cut + ledge), 1e-12);
  EXPECT_NEAR(meshed.joint_length["fill_joint"],
              9. * 2.9 * chord - 2. * cut + 2. * (2.8 - middle), 1e-12);
  auto &outer = meshed.outer_length;
  EXPECT_NEAR(outer["intrados"], 7. * 2.5 * chord, 1e-12);
  EXPECT_NEAR(outer["intrados_loaded"], 2. * 2.5 * chord, 1e-12);
  EXPECT_NEAR(outer["road"], 5.6, 1e-12);
  EXPECT_NEAR(outer["base"], 1.6, 1e-12);
  EXPECT_NEAR(outer["abutment_left"], 0.5 + 0.24, 1e-12);
  EXPECT_NEAR(outer["backing_right"], 0.8 - 0.24, 1e-12);
  EXPECT_NEAR(outer["fill_left"], 1.7 - 0.8, 1e-12);
  EXPECT_EQ(outer.count("extrados"), 0U);
}

TEST(ArchGeometry, ARingAloneHasAnExtrados)
{
  ArchParameters arch = bridge();
  arch.rise           = 2.; // a semicircle, on abutments as wide as the joint
  arch.abutment       = { { 0.4, 1. } };
  arch.n_voussoirs    = 8;
  arch.backing = arch.cover = 0.;
  MeshedArch meshed(arch);
  EXPECT_EQ(meshed.mesh.n_blocks(), 10U);
  const double chord = 2. * std::sin(M_PI / 16.);
  EXPECT_NEAR(meshed.outer_length["extrados"], 6. * 2.4 * chord, 1e-12);
  EXPECT_NEAR(meshed.outer_length["extrados_loaded"], 2. * 2.4 * chord, 1e-12);
  EXPECT_NEAR(meshed.joint_length["ring_joint"], 9. * 0.4, 1e-12);
  EXPECT_EQ(meshed.joint_length.size(), 1U);
  EXPECT_NEAR(meshed.area["voussoir"],
              6. * 0.5 * std::sin(M_PI / 8.) * (2.4 * 2.4 - 4.), 1e-12);
}

TEST(ArchGeometry, TheBackingEndsAtAJointThatIsNear)
{
  ArchParameters arch = bridge();
  arch.n_voussoirs    = 10;
  arch.cover          = 0.;
  // the extrados at the third joint from the left
  const double level
      = -1.5 + 2.9 * std::cos(std::asin(0.8) * (1. - 2. * 2. / 10.));
  arch.backing            = level + 0.001;
  const ArchLayout layout = lay_arch(arch);
  // no voussoir is cut, and the top is level
  for (unsigned int k = 0; k < 10; ++k)
    EXPECT_EQ(layout.blocks[k].corners.size(), 4U);
  MeshedArch meshed(arch);
  const double chord = 2. * std::sin(std::asin(0.8) / 10.);
  EXPECT_NEAR(meshed.joint_length["backing_joint"],
              2. * 2. * 2.9 * chord + 2. * (2.8 - 2.9 * 0.8), 1e-12);
  EXPECT_NEAR(meshed.outer_length["backing_left"], level - 0.24, 1e-12);
}
