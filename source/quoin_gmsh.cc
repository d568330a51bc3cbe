// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Reads a mesh or meshes a geometry with gmsh, for quoin, which starts this
// program where it needs one:
//
//   quoin_gmsh FILE plain|crossed|quadratic DIMENSION REFINEMENTS [COPY.msh]
//
// with the words of the entry Mesh/Triangles and 2, 3 or 0, the dimension of
// the file: three if it has tetrahedra or is a geometry with volumes; edges are
// halved REFINEMENTS times, or quoin does it if all of a plane mesh are
// straight. A GmshMesh goes to the standard output; with COPY.msh the mesh goes
// there, and of the GmshMesh only the errors are set. gmsh crashes on many
// damaged files and ends the process at some commands of a geometry: then this
// process ends and the answer is incomplete.

#include <quoin/mesh/gmsh_mesh.h>

#include <fcntl.h>
#include <gmsh.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <numeric>
#include <sstream>

using namespace quoin;

namespace
{
  constexpr int gmsh_line        = 1;
  constexpr int gmsh_triangle    = 2;
  constexpr int gmsh_quad        = 3;
  constexpr int gmsh_tetrahedron = 4;
  constexpr double plane_tolerance
      = 1e-9; // of the mesh's size: what binary and text files round to

  /** The mesh cannot be used: what is wrong with it and the cure. */
  struct Refusal
  {
    std::string what;
  };

  [[noreturn]] void refuse(const std::string &what)
  {
    throw Refusal{ what };
  }

  /** All errors that gmsh has logged, in one line; empty if there are none. */
  std::string logged_errors()
  {
    std::vector<std::string> log;
    gmsh::logger::get(log);
    std::string result;
    for (const std::string &line : log)
      if (line.rfind("Error", 0) == 0)
      {
        const std::size_t begin = line.find_first_not_of(": ", 5);
        if (begin != std::string::npos)
          result += (result.empty() ? "" : "; ") + line.substr(begin);
      }
    return result;
  }

  void make_elements(const int dimension, const bool quadrangles)
  {
    if (quadrangles)
    {
      gmsh::vectorpair surfaces;
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &[dim, surface] : surfaces)
        gmsh::model::mesh::setRecombine(dim, surface);
    }
    gmsh::model::mesh::generate(dimension);
  }

  bool has_elements(const int dimension)
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types, dimension);
    return !types.empty();
  }

  /** Where tags are in their list. */
  class TagIndex
  {
  public:
    explicit TagIndex(const std::vector<std::size_t> &tags)
      : tags(tags), order(tags.size())
    {
      std::iota(order.begin(), order.end(), std::size_t(0));
      if (!std::is_sorted(tags.begin(), tags.end()))
        std::sort(order.begin(), order.end(),
                  [&](const std::size_t a, const std::size_t b)
                  { return tags[a] < tags[b]; });
      // Tags may have gaps of any size, but hardly ever do.
      contiguous
          = !tags.empty()
            && tags[order.back()] - tags[order.front()] + 1 == tags.size();
    }

    /** Index of the node with @p tag; the number of nodes if there is none. */
    std::size_t find(const std::size_t tag) const
    {
      if (contiguous && tag >= tags[order.front()] && tag <= tags[order.back()])
        return order[tag - tags[order.front()]];
      const auto place
          = std::lower_bound(order.begin(), order.end(), tag,
                             [&](const std::size_t a, const std::size_t value)
                             { return tags[a] < value; });
      return place == order.end() || tags[*place] != tag ? tags.size() : *place;
    }

  private:
    const std::vector<std::size_t> &tags;
    std::vector<std::size_t> order;
    bool contiguous;
  };

  std::vector<int> physical_groups(const int dim, const int entity)
  {
    // A minus sign only says that the group sees the entity reversed.
    std::vector<int> groups;
    gmsh::model::getPhysicalGroupsForEntity(dim, entity, groups);
    for (int &group : groups)
      group = std::abs(group);
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    return groups;
  }

  /** What an entity of dimension @p dim is called. */
  std::string word(const int dim)
  {
    return dim == 1 ? "curve" : dim == 2 ? "surface" : "volume";
  }

  std::string physical_name(const int dim, const int group)
  {
    std::string name;
    gmsh::model::getPhysicalName(dim, group, name);
    if (name.empty())
    {
      const std::string kind = dim == 1   ? "Curve"
                               : dim == 2 ? "Surface"
                                          : "Volume";
      refuse("physical " + word(dim) + " " + std::to_string(group)
             + " has no name. Give it one: Physical " + kind
             + "(\"name\") = {...}; in the geometry, or a line in "
               "$PhysicalNames.");
    }
    return name;
  }

  /** The index of @p name in @p names, where it is added if it is new. */
  unsigned int index_of(const std::string &name,
                        std::vector<std::string> &names)
  {
    const unsigned int place
        = std::find(names.begin(), names.end(), name) - names.begin();
    if (place == names.size())
      names.push_back(name);
    return place;
  }

  std::string list(const std::vector<int> &numbers)
  {
    constexpr std::size_t most = 10;
    std::string result;
    for (std::size_t i = 0; i < std::min(numbers.size(), most); ++i)
      result += (i > 0 ? ", " : "") + std::to_string(numbers[i]);
    if (numbers.size() > most)
      result += " and " + std::to_string(numbers.size() - most) + " others";
    return result;
  }

  /** Turns the mesh that gmsh holds into a GmshMesh. */
  class Reader
  {
  public:
    Reader(const int dimension, const bool accepts_quadrangles)
      : dimension(dimension), accepts_quadrangles(accepts_quadrangles)
    {
      mesh.dimension = dimension;
      gmsh::model::mesh::getNodes(tags, coordinates, parametric, -1, -1, false,
                                  false);
    }

    GmshMesh read()
    {
      read_cells();
      read_faces();
      read_vertices();
      return std::move(mesh);
    }

  private:
    [[noreturn]] void refuse_elements(int type, const std::string &where) const;
    void refuse_lack_of_cells() const;
    void read_cells();
    void read_faces();
    void read_vertices();

    const int dimension;
    const bool accepts_quadrangles;
    GmshMesh mesh;

    /** All nodes as gmsh returns them. */
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, parametric;

    /** Node tags of gmsh, until read_vertices() turns them to indices. */
    std::vector<std::array<std::size_t, 3>> triangle_tags;
    std::vector<std::array<std::size_t, 2>> line_tags;
    std::vector<std::array<std::size_t, 4>> quadrangle_tags, tetrahedron_tags;
  };

  void Reader::refuse_elements(const int type, const std::string &where) const
  {
    std::string name;
    int element_dim, order, n_nodes, n_primary;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, element_dim, order,
                                            n_nodes, local, n_primary);
    refuse(where + " has elements of the kind '" + name
           + (dimension == 2
                  ? "'. Only three-node triangles can be used: remove "
                    "Recombine, or set 'Triangles = crossed' in section "
                    "'Mesh', which cuts quadrangles, and keep "
                    "Mesh.ElementOrder = 1."
                  : "'. Only four-node tetrahedra with three-node triangles "
                    "on their faces can be used: remove Recombine, of "
                    "surfaces and of extrusions, and keep "
                    "Mesh.ElementOrder = 1."));
  }

  /** Append the elements of @p flat, node after node. */
  template <std::size_t n>
  void append(const std::vector<std::size_t> &flat,
              std::vector<std::array<std::size_t, n>> &elements)
  {
    for (std::size_t i = 0; i + n <= flat.size(); i += n)
      std::copy_n(&flat[i], n, elements.emplace_back().begin());
  }

  void Reader::refuse_lack_of_cells() const
  {
    if (dimension == 3)
      refuse("there are no tetrahedra in it, which 'Dimension = 3' in section "
             "'Mesh' asks for. Save the mesh in three dimensions (gmsh -3) "
             "with its physical volumes, or set 'Dimension = from mesh'.");
    if (accepts_quadrangles)
      refuse("there are no quadrangles in it, which 'Triangles = crossed' in "
             "section 'Mesh' needs. Give the geometry (.geo), save the mesh "
             "recombined, or set 'Triangles = plain'.");
    refuse("there are no triangles in it. Save the mesh in two dimensions "
           "(gmsh -2) with its physical surfaces.");
  }

  void Reader::read_cells()
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension);
    std::vector<int> without_group;
    for (const auto &[dim, entity] : entities)
    {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, dim, entity);
      if (types.empty())
        continue;
      const std::string where = word(dim) + " " + std::to_string(entity);

      const std::vector<int> groups = physical_groups(dim, entity);
      if (groups.empty())
      {
        without_group.push_back(entity);
        continue;
      }
      if (groups.size() > 1)
        refuse(where + " is in several physical " + word(dim) + "s ("
               + list(groups) + "). Put each " + word(dim)
               + " in exactly one.");
      const unsigned int group
          = index_of(physical_name(dim, groups[0]), mesh.group_names);

      for (std::size_t t = 0; t < types.size(); ++t)
      {
        if (types[t] == gmsh_tetrahedron)
          append(nodes[t], tetrahedron_tags);
        else if (types[t] == gmsh_quad && accepts_quadrangles)
          append(nodes[t], quadrangle_tags);
        else if (types[t] == gmsh_triangle)
          append(nodes[t], triangle_tags);
        else
          refuse_elements(types[t], where);
      }
      mesh.cell_group.resize(
          dim == 3 ? tetrahedron_tags.size() : triangle_tags.size(), group);
      mesh.quadrangle_group.resize(quadrangle_tags.size(), group);
    }
    if (!without_group.empty())
      refuse("no physical group holds the " + word(dimension)
             + (without_group.size() > 1 ? "s " : " ") + list(without_group)
             + ". Name every " + word(dimension) + ": Physical "
             + (dimension == 2 ? "Surface" : "Volume") + "(\"rock\") = {...};");
    if (quadrangle_tags.empty()
        && (accepts_quadrangles || mesh.cell_group.empty()))
      refuse_lack_of_cells();
  }

  void Reader::read_faces()
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension - 1);
    for (const auto &[dim, entity] : entities)
    {
      const std::vector<int> groups = physical_groups(dim, entity);
      if (groups.empty())
        continue;
      const std::string where = word(dim) + " " + std::to_string(entity);
      if (groups.size() > 1)
        refuse(where + " is in several physical " + word(dim) + "s ("
               + list(groups) + "). Put each " + word(dim)
               + " in one at most.");
      const unsigned int name
          = index_of(physical_name(dim, groups[0]), mesh.face_names);

      std::vector<int> types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, dim, entity);
      for (std::size_t t = 0; t < types.size(); ++t)
      {
        if (dim == 1 && types[t] == gmsh_line)
          append(nodes[t], line_tags);
        else if (dim == 2 && types[t] == gmsh_triangle)
          append(nodes[t], triangle_tags);
        else if (dim == 2)
          refuse_elements(types[t], where);
        else
          refuse(where + " has curved elements. Keep Mesh.ElementOrder = 1.");
      }
      mesh.face_name.resize(dim == 2 ? triangle_tags.size() : line_tags.size(),
                            name);
    }
  }

  /** Keep the nodes in use, in the order of the file. */
  void Reader::read_vertices()
  {
    const TagIndex nodes(tags);

    // 1. Tags of elements to node numbers, and mark those in use.
    std::vector<unsigned int> vertex(tags.size(), 0);
    const auto mark = [&](auto &element_tags)
    {
      for (auto &element : element_tags)
        for (std::size_t &tag : element)
        {
          const std::size_t node = nodes.find(tag);
          if (node == tags.size())
            refuse("an element refers to node " + std::to_string(tag)
                   + ", which the file does not define. Save it again from "
                     "gmsh.");
          tag          = node;
          vertex[node] = 1;
        }
    };
    mark(tetrahedron_tags);
    mark(triangle_tags);
    mark(quadrangle_tags);
    mark(line_tags);

    // 2. Number the nodes in use and copy their coordinates.
    double size = 0.;
    for (const double x : coordinates)
      size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < tags.size(); ++i)
      if (vertex[i] == 1)
      {
        const double *x = &coordinates[3 * i];
        // Not a number is off the plane, too.
        if (dimension == 2 && !(std::abs(x[2]) <= plane_tolerance * size))
        {
          std::ostringstream message;
          message.precision(12);
          message << "node " << tags[i] << " at (" << x[0] << ", " << x[1]
                  << ", " << x[2]
                  << ") is off the plane z = 0. Draw the geometry in the "
                     "x-y plane, or with volumes.";
          refuse(message.str());
        }
        vertex[i] = mesh.vertices.size();
        mesh.vertices.push_back({ { x[0], x[1], x[2] } });
      }

    // 3. Elements.
    const auto number = [&](const auto &element_tags, auto &elements)
    {
      elements.reserve(element_tags.size());
      for (const auto &element : element_tags)
        std::transform(element.begin(), element.end(),
                       elements.emplace_back().begin(),
                       [&](const std::size_t node) { return vertex[node]; });
    };
    number(tetrahedron_tags, mesh.tetrahedra);
    number(triangle_tags, mesh.triangles);
    number(quadrangle_tags, mesh.quadrangles);
    number(line_tags, mesh.lines);
  }

  /** Dimension of what gmsh holds, of a geometry or @p is_mesh. */
  int dimension_of(const bool is_mesh)
  {
    gmsh::vectorpair volumes;
    gmsh::model::getEntities(volumes, 3);
    return has_elements(3) || (!is_mesh && !volumes.empty()) ? 3 : 2;
  }

  /** Whether quoin may halve the edges: gmsh puts new nodes on the curves, and
      in the middle of edges of a mesh file. Elements of second order are left
      to gmsh, which makes them ones of the first as it refines them. */
  bool has_straight_curves()
  {
    std::vector<int> types;
    gmsh::model::mesh::getElementTypes(types);
    for (const int type : types)
    {
      std::string name;
      int dimension = 0, order = 0, n_nodes = 0, n_primary = 0;
      std::vector<double> places;
      gmsh::model::mesh::getElementProperties(type, name, dimension, order,
                                              n_nodes, places, n_primary);
      if (order > 1)
        return false;
    }
    gmsh::vectorpair curves;
    gmsh::model::getEntities(curves, 1);
    return std::all_of(curves.begin(), curves.end(),
                       [](const auto &curve)
                       {
                         std::string type;
                         gmsh::model::getType(curve.first, curve.second, type);
                         return type == "Line" || type == "Discrete curve";
                       });
  }

  /** Open and mesh @p file, then read it or write it to @p copy if given. */
  GmshMesh answer(const std::string &file, const std::string &kind,
                  const int wanted, const int refinements,
                  const std::string &copy)
  {
    const bool quadrangles = kind == "crossed";
    GmshMesh mesh;
    try
    {
      gmsh::open(file);
      const bool is_mesh
          = file.size() > 4 && file.substr(file.size() - 4) == ".msh";
      const int dimension = wanted != 0 ? wanted : dimension_of(is_mesh);
      mesh.gmsh_errors    = logged_errors();
      if (!mesh.gmsh_errors.empty())
        return mesh;
      if (dimension == 3 && kind != "plain")
        refuse("it is three-dimensional, and 'Triangles = " + kind
               + "' in section 'Mesh' is for the plane. Set 'Triangles = "
                 "plain'.");
      if (!has_elements(dimension) && (dimension == 2 || !is_mesh))
        make_elements(dimension, quadrangles);
      const bool quoin_halves
          = dimension == 2 && copy.empty() && has_straight_curves();
      for (int i = 0; i < refinements && !quoin_halves; ++i)
        gmsh::model::mesh::refine();
      mesh.gmsh_errors = logged_errors();
      if (!mesh.gmsh_errors.empty())
        return mesh;
      if (copy.empty())
      {
        mesh            = Reader(dimension, quadrangles).read();
        mesh.n_halvings = quoin_halves ? refinements : 0;
        return mesh;
      }
      gmsh::write(copy);
    }
    catch (const Refusal &refusal)
    {
      mesh.refusal = refusal.what;
      return mesh;
    }
    catch (const std::exception &exception)
    {
      mesh.gmsh_errors = exception.what();
    }
    catch (const std::string &message)
    {
      mesh.gmsh_errors = message;
    }
    catch (...)
    {
      mesh.gmsh_errors = "unknown error";
    }
    const std::string logged = logged_errors();
    if (!logged.empty())
      mesh.gmsh_errors = logged;
    return mesh;
  }

  /**
   * What becomes of this process once it runs: it ends with the one that
   * started it, and leaves neither words of gmsh on the screen nor a dump of
   * its memory. Returns where the answer goes, which commands of a geometry do
   * not inherit.
   */
  int leave_screen()
  {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    // That one may have ended already: then nobody reads the answer.
    pollfd answer{ STDOUT_FILENO, 0, 0 };
    if (poll(&answer, 1, 0) > 0 && (answer.revents & POLLERR) != 0)
      _exit(1);
    const rlimit none{ 0, 0 };
    setrlimit(RLIMIT_CORE, &none);
    const int output  = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    const int nowhere = open("/dev/null", O_WRONLY);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    return output;
  }
} // namespace

int
main(int argc, char **argv)
{
  if (argc != 5 && argc != 6)
  {
    std::fputs("Use: quoin_gmsh FILE plain|crossed|quadratic 0|2|3 "
               "REFINEMENTS [COPY.msh]\n",
               stderr);
    return 1;
  }
  std::FILE *output = fdopen(leave_screen(), "wb");
  gmsh::initialize(0, nullptr, /* readConfigFiles = */ false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::logger::start();
  GmshMesh mesh = answer(argv[1], argv[2], std::atoi(argv[3]),
                         std::atoi(argv[4]), argc == 6 ? argv[5] : "");
  GmshChannel channel(output, GmshChannel::Direction::send);
  mesh.transfer(channel);
  // The memory of gmsh needs no tidying.
  _exit(std::fflush(output) == 0 && channel.is_complete() ? 0 : 1);
}
