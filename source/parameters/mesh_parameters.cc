// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/layout/arch_layout.h>
#include <quoin/layout/block_surfaces.h>
#include <quoin/layout/space_wall.h>
#include <quoin/layout/wall_layout.h>
#include <quoin/rock/rock_box.h>
#include <quoin/rock/rock_layout.h>
#include <quoin/parameters/model_parameters.h>

#include <filesystem>
#include <utility>

namespace quoin
{
  namespace
  {
    /** A mesh with a million times as many cells as the file's is a mistake. */
    constexpr int most_refinements = 10;

    void lay_in_space(const WallParameters &wall, Parameters &parameters)
    {
      const SpaceWall layout  = lay_space_wall(wall);
      const GmshGeometry mesh = space_wall_mesh(wall, layout);
      parameters.generated
          = { "wall", mesh.text, space_wall_report(wall, layout), "", "" };
      parameters.generated.is_mesh  = true;
      parameters.split.joints_along = mesh.joint_curves;
    }

    void lay(const WallParameters &wall, Parameters &parameters)
    {
      if (!wall.segments.empty())
      {
        lay_in_space(wall, parameters);
        return;
      }
      const WallLayout layout     = lay_wall(wall);
      const GmshGeometry geometry = wall_geometry(wall, layout);
      parameters.generated
          = { "wall", geometry.text, wall_report(layout), "", "" };
      parameters.split.joints_along = geometry.joint_curves;
    }

    void lay(const RockParameters &rock, Parameters &parameters)
    {
      const RockLayout layout     = lay_rock(rock);
      const GmshGeometry geometry = rock_geometry(rock, layout);
      parameters.generated
          = { "rock", geometry.text, rock_report(rock, layout),
              rock_statistics(rock, layout),
              text_of("'Shortest edge' of section 'Rock', ", rock.shortest_edge,
                      " m now, leaves out small pieces of the "
                      "network of joints: a larger one makes "
                      "the time step longer") };
      parameters.split.joints_along = geometry.joint_curves;
    }

    void lay(const RockBoxParameters &rock, Parameters &parameters)
    {
      const RockBox box           = cut_rock_box(rock);
      const GmshGeometry geometry = rock_box_geometry(rock, box);
      parameters.generated        = {
               "rock", geometry.text, rock_box_report(rock, box),
               rock_box_statistics(rock, box),
               text_of("'Shortest edge' of section 'Rock box', ", rock.shortest_edge,
                       " m now, leaves blocks whole that a joint would cut into "
                              "small pieces: a larger one makes the time step longer")
      };
      parameters.split.joints_along = geometry.joint_curves;
    }

    void lay(const ArchParameters &arch, Parameters &parameters)
    {
      const ArchLayout layout     = lay_arch(arch);
      const GmshGeometry geometry = arch_geometry(arch, layout);
      parameters.generated
          = { "arch", geometry.text, arch_report(layout), "", "" };
      parameters.split.joints_along = geometry.joint_curves;
    }

    /** Generates the wall, arch or rock, if the file has one. */
    bool read_generated(const ParameterSection &top, Parameters &parameters)
    {
      const WallParameters wall = WallParameters::read(top);
      const ArchParameters arch
          = ArchParameters::read(ParameterSection(top, "Arch"));
      const RockParameters rock   = RockParameters::read(top);
      const RockBoxParameters box = RockBoxParameters::read(top);
      const bool has_arch         = arch.span > 0.;
      const bool has_wall         = wall.bond != WallBond::none;
      const bool has_rock         = !rock.outline.empty();
      if (has_wall && has_rock)
        ParameterSection(top, "Rock")
            .fail("Outline",
                  "does not go with a wall of section 'Wall': leave it "
                  "empty, or set 'Wall/Bond = none'.");
      if (has_arch && (has_wall || has_rock))
        ParameterSection(top, "Arch")
            .fail("Span", "does not go with a wall of section 'Wall' or rock "
                          "of section 'Rock': set it to 0, or 'Wall/Bond = "
                          "none' and 'Rock/Outline' empty.");
      if (box.is_there() && (has_wall || has_rock || has_arch))
        ParameterSection(top, "Rock box")
            .fail("Highest corner",
                  "does not go with a wall of section 'Wall', an arch of "
                  "section 'Arch' or rock of section 'Rock': make it the same "
                  "as 'Lowest corner', or take these out.");
      if (!has_wall && !has_rock && !has_arch && !box.is_there())
        return false;
      if (const ParameterSection section(top, "Mesh");
          !section.text("File").empty())
        section.fail("File",
                     "does not go with a wall of section 'Wall', an arch of "
                     "section 'Arch' or rock of section 'Rock': leave it "
                     "empty, or set 'Wall/Bond = none', 'Arch/Span = 0' and "
                     "'Rock/Outline' empty.");
      naming(top.file(),
             [&]()
             {
               if (has_wall)
                 lay(wall, parameters);
               else if (has_arch)
                 lay(arch, parameters);
               else if (box.is_there())
                 lay(box, parameters);
               else
                 lay(rock, parameters);
             });
      return true;
    }

    /** Reads the blocks of another program as a geometry. */
    void read_blocks(const ParameterSection &section, Parameters &parameters)
    {
      if (parameters.element_size <= 0.)
        section.fail("Element size",
                     "must be greater than 0 for the blocks of a .obj, .stl or "
                     ".3dgrid file, whose faces say nothing of the mesh.");
      const BlockSurfaces blocks
          = naming(section.file(),
                   [&]() { return read_block_surfaces(parameters.mesh_file); });
      const GmshGeometry geometry
          = block_geometry(blocks, parameters.element_size);
      parameters.generated
          = { "blocks", geometry.text, block_report(blocks), "",
              text_of("'Element size' of section 'Mesh' is ",
                      parameters.element_size,
                      " m: a larger one makes the time step longer where no "
                      "edge of a block is shorter") };
      if (parameters.split.joints_along.empty())
      {
        parameters.split.joints_along    = geometry.joint_curves;
        parameters.split.may_lack_joints = true;
      }
      if (parameters.dimension == MeshDimension::two)
        section.fail("Dimension", "must be 3 for the blocks of a .obj, .stl or "
                                  ".3dgrid file: set 'from mesh'.");
      parameters.dimension = MeshDimension::three;
    }

    void check_mesh_file(const ParameterSection &section,
                         Parameters &parameters)
    {
      if (parameters.mesh_file.empty())
        section.fail("File", "must name a .geo or .msh file or one with "
                             "blocks, or section 'Wall' "
                             "a bond, section 'Arch' a span, or section "
                             "'Rock' an outline.");
      parameters.mesh_file = in_folder(section, parameters.mesh_file);
      std::error_code error; // a name may be too long for any file
      if (!std::filesystem::exists(parameters.mesh_file, error))
        section.fail("File",
                     "does not exist: there is no file '" + parameters.mesh_file
                         + "'. Give the path from the folder of the parameter "
                           "file.");
      const auto extension
          = std::filesystem::path(parameters.mesh_file).extension();
      if (extension != ".geo" && extension != ".msh"
          && !is_surface_file(parameters.mesh_file))
        section.fail("File", "must end in .geo or .msh or, for blocks of "
                             "another program, in .obj, .stl or .3dgrid.");
    }

    /** Makes @p wanted the dimension of the geometry that was @p made. */
    void check_dimension(const ParameterSection &section,
                         const MeshDimension made, MeshDimension &wanted)
    {
      if (made == MeshDimension::two && wanted == MeshDimension::three)
        section.fail("Dimension",
                     "is 2 for an arch of section 'Arch' or rock of section "
                     "'Rock', whose meshes are plane: set 'from mesh'.");
      if (made == MeshDimension::three && wanted == MeshDimension::two)
        section.fail("Dimension",
                     "must be 3 for rock of section 'Rock box', whose "
                     "mesh is of tetrahedra: set 'from mesh'.");
      wanted = made;
    }

    void enter_mesh(ParameterEntries &entries, Parameters &parameters)
    {
      entries.text("File", parameters.mesh_file,
                   "gmsh geometry (.geo) or mesh (.msh) with coordinates in "
                   "[m], given relative to the folder of this file; or "
                   "polyhedral blocks as closed surfaces: Wavefront OBJ "
                   "(.obj), STL (.stl) or the text grid of 3DEC (.3dgrid), "
                   "which are joined where they touch and meshed; empty if "
                   "section 'Wall', 'Arch', 'Rock' or 'Rock box' generates the "
                   "geometry.");
      entries.nonnegative("Element size", parameters.element_size,
                          "Length of the edges of the tetrahedra of blocks of "
                          "a .obj, .stl or .3dgrid file [m]");
      entries.choice("Dimension", parameters.dimension,
                     { { "from mesh", MeshDimension::from_mesh },
                       { "2", MeshDimension::two },
                       { "3", MeshDimension::three } },
                     "Dimension of the model. from mesh: three if the file has "
                     "tetrahedra or a geometry has volumes, otherwise two; 2: "
                     "the triangles in the plane z = 0; 3: the tetrahedra, "
                     "which a wall of section 'Wall' then has, too.");
      entries.choice(
          "Triangles", parameters.cells.kind,
          { { "plain", TriangleKind::plain },
            { "crossed", TriangleKind::crossed },
            { "quadratic", TriangleKind::quadratic } },
          "Type of the triangles. plain: linear triangles of the file or of "
          "gmsh; crossed: quadrangles, each cut into four triangles by its "
          "diagonals, which do not lock in plastic flow; quadratic: triangles "
          "of 'plain' with nodes at the midpoints of their edges, for the "
          "implicit solver.");
      entries.choice(
          "Tetrahedra", parameters.cells.mixed_tetrahedra,
          { { "plain", false }, { "mixed", true } },
          "Type of the tetrahedra, in three dimensions. plain: those of the "
          "file or of gmsh; mixed: each is cut into eight that share their "
          "change of volume, which do not lock in plastic flow or with "
          "Poisson's ratios near 0.5. Edges are half as long then: take a "
          "mesh twice as coarse.");
      entries.integer(
          "Refinements", parameters.cells.refinements, 0,
          "Number of uniform refinements of the mesh, each of which divides "
          "triangles and quadrangles into four and tetrahedra into eight [-]",
          most_refinements);
      SplitOptions &split = parameters.split;
      entries.list("Joints along", split.joints_along,
                   "Physical curves along which the mesh is split into blocks; "
                   "if empty and section 'Wall', 'Arch' or 'Rock' generates "
                   "the geometry, the mesh is split along all of its joints.");
      entries.pairs("Joints between", split.joints_between,
                    "must be 'all' or pairs such as rock:concrete.",
                    "Pairs a:b of physical surfaces between which the mesh is "
                    "split into blocks; 'all' stands for all pairs.",
                    &split.between_all);
      entries.choice("Joint ends inside blocks", split.joint_ends,
                     { { "keep", SplitOptions::keep },
                       { "refuse", SplitOptions::refuse } },
                     "Treatment of joints that end inside a block. keep: they "
                     "become cracks; refuse: the run stops with an error.");
    }
  } // namespace

  void declare_mesh(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_mesh);
  }

  void read_mesh(const ParameterSection &top, Parameters &parameters)
  {
    const bool generated      = read_generated(top, parameters);
    const bool has_tetrahedra = parameters.generated.is_mesh
                                || RockBoxParameters::read(top).is_there();
    const auto joints_of_layout
        = std::exchange(parameters.split.joints_along, {});
    parameters.generated.joint_curves = joints_of_layout;
    const ParameterSection section(top, "Mesh");
    ParameterEntries entries(section);
    enter_mesh(entries, parameters);
    if (!generated)
    {
      check_mesh_file(section, parameters);
      const bool is_surface = is_surface_file(parameters.mesh_file);
      if (!is_surface && parameters.element_size > 0.)
        section.fail("Element size",
                     "is for blocks of a .obj, .stl or .3dgrid file; a "
                     "geometry or a mesh of gmsh has its own. Set it to 0.");
      if (is_surface)
        read_blocks(section, parameters);
    }
    else if (parameters.split.joints_along.empty())
      parameters.split.joints_along = joints_of_layout;
    if (generated)
      check_dimension(
          section, has_tetrahedra ? MeshDimension::three : MeshDimension::two,
          parameters.dimension);
    if (parameters.cells.kind == TriangleKind::quadratic
        && !parameters.is_implicit)
      section.fail("Triangles",
                   "needs 'Solver = implicit': explicit steps divide forces by "
                   "masses of nodes, and the corners of quadratic triangles "
                   "have none. Take 'plain' or 'crossed'.");
  }
} // namespace quoin
