// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/mesh/crossed_triangles.h>
#include <quoin/mesh/gmsh_reader.h>
#include <quoin/mesh/quadratic_triangles.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <gmsh.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <utility>

namespace quoin
{
  namespace
  {
    constexpr int gmsh_line     = 1;
    constexpr int gmsh_triangle = 2;
    constexpr int gmsh_quad     = 3;
    constexpr double plane_tolerance
        = 1e-9; // of the mesh's size: what binary and text files round to

    /** What is said if gmsh does not come back: handlers see statics only. */
    char last_words[1000];
    volatile std::sig_atomic_t is_in_gmsh = 0;

    extern "C" void say_last_words()
    {
      if (is_in_gmsh == 0)
        return;
      if (write(STDERR_FILENO, last_words, std::strlen(last_words)) < 0)
        _exit(2);
      _exit(1); // which mpirun takes as the end of all ranks
    }

    extern "C" void catch_crash(int)
    {
      say_last_words();
    }

    /**
     * gmsh crashes on many files that are damaged, and ends the process at the
     * commands Exit and Abort of a geometry. This must look like any other
     * refusal of a file.
     */
    class CrashGuard
    {
    public:
      explicit CrashGuard(const std::string &filename)
      {
        std::snprintf(
            last_words, sizeof(last_words),
            "Error: Mesh '%.500s': gmsh came to its end while it read "
            "the file, which is damaged or has a command such as "
            "Exit. Open it in gmsh and mend it there.\n",
            filename.c_str());
        static const int registered = std::atexit(say_last_words);
        static_cast<void>(registered);
        // A stack of its own, for what overflows the other one.
        stack_t other{};
        other.ss_sp   = stack.data();
        other.ss_size = stack.size();
        sigaltstack(&other, &old_stack);
        struct sigaction action = {};
        action.sa_handler       = catch_crash;
        action.sa_flags         = SA_ONSTACK;
        for (std::size_t i = 0; i < signals.size(); ++i)
          sigaction(signals[i], &action, &old_actions[i]);
        is_in_gmsh = 1;
      }
      ~CrashGuard()
      {
        is_in_gmsh = 0;
        for (std::size_t i = 0; i < signals.size(); ++i)
          sigaction(signals[i], &old_actions[i], nullptr);
        sigaltstack(&old_stack, nullptr);
      }
      CrashGuard(const CrashGuard &)            = delete;
      CrashGuard &operator=(const CrashGuard &) = delete;

    private:
      static constexpr std::array<int, 5> signals
          = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
      std::vector<char> stack = std::vector<char>(1 << 16);
      stack_t old_stack{};
      struct sigaction old_actions[signals.size()] = {};
    };

    /** The gmsh library, silent, for as long as this object lives. */
    class GmshSession
    {
    public:
      /** For work on the file @p filename. */
      explicit GmshSession(const std::string &filename) : guard(filename)
      {
        gmsh::initialize(0, nullptr, /* readConfigFiles = */ false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::logger::start();
      }
      ~GmshSession()
      {
        // The log outlives finalize(), and with it the errors of this file.
        gmsh::logger::stop();
        gmsh::finalize();
      }
      GmshSession(const GmshSession &)            = delete;
      GmshSession &operator=(const GmshSession &) = delete;

      /** All errors logged so far, in one line; empty if there are none. */
      static std::string errors()
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

    private:
      const CrashGuard guard;
    };

    void mesh_surfaces(const TriangleKind kind)
    {
      if (kind == TriangleKind::crossed)
      {
        gmsh::vectorpair surfaces;
        gmsh::model::getEntities(surfaces, 2);
        for (const auto &[dim, surface] : surfaces)
          gmsh::model::mesh::setRecombine(dim, surface);
      }
      gmsh::model::mesh::generate(2);
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

      /** Their number if there is no such tag. */
      std::size_t find(const std::size_t tag) const
      {
        if (contiguous && tag >= tags[order.front()]
            && tag <= tags[order.back()])
          return order[tag - tags[order.front()]];
        const auto place
            = std::lower_bound(order.begin(), order.end(), tag,
                               [&](const std::size_t a, const std::size_t value)
                               { return tags[a] < value; });
        return place == order.end() || tags[*place] != tag ? tags.size()
                                                           : *place;
      }

    private:
      const std::vector<std::size_t> &tags;
      std::vector<std::size_t> order;
      bool contiguous;
    };

    /** Starts every message with the file, or what it was made from. */
    class Reader
    {
    public:
      Reader(const std::string &filename, const TriangleKind kind,
             const std::string &maker = "")
        : filename(filename), is_generated(!maker.empty()), kind(kind)
      {
        mesh.source = is_generated ? maker : filename;
      }

      MeshData read();

    private:
      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("Mesh '" + mesh.source + "': " + what);
      }

      void check_file() const;
      void open_and_mesh() const;
      [[noreturn]] void refuse_elements(int type,
                                        const std::string &where) const;
      std::vector<int> physical_groups(const int dim, const int entity) const;
      std::string physical_name(const int dim, const int group) const;
      void read_triangles();
      void read_lines();
      void read_vertices();

      const std::string filename;
      const bool is_generated;
      const TriangleKind kind;
      MeshData mesh;
      Quadrangles quadrangles;

      /** Node tags of gmsh, until read_vertices() turns them to indices. */
      std::vector<std::array<std::size_t, 3>> triangle_tags;
      std::vector<std::array<std::size_t, 2>> line_tags;
      std::vector<std::array<std::size_t, 4>> quad_tags;
    };

    void Reader::check_file() const
    {
      namespace fs = std::filesystem;
      std::error_code ignored;
      if (!fs::exists(filename, ignored))
        fail("there is no such file. Check Mesh/File, which is relative to "
             "the parameter file.");
      if (fs::is_directory(filename, ignored)
          || !std::ifstream(filename).good())
        fail("this cannot be read as a file. Check Mesh/File and the file's "
             "permissions.");
      const std::string extension = fs::path(filename).extension();
      if (extension != ".geo" && extension != ".msh")
        fail("the name ends in '" + extension
             + "'. Give a gmsh geometry (.geo) or mesh (.msh).");
      if (fs::file_size(filename, ignored) == 0)
        fail("the file is empty. Save it again from gmsh.");
    }

    void Reader::open_and_mesh() const
    {
      std::string thrown;
      try
      {
        gmsh::open(filename);
        if (GmshSession::errors().empty())
        {
          std::vector<std::size_t> nodes;
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> elements, element_nodes;
          gmsh::model::mesh::getElements(types, elements, element_nodes, 2);
          if (types.empty())
            mesh_surfaces(kind);
        }
      }
      catch (const std::exception &exception)
      {
        thrown = exception.what();
      }
      catch (const std::string &message)
      {
        thrown = message;
      }
      catch (...)
      {
        thrown = "unknown error";
      }
      const std::string logged = GmshSession::errors();
      if (!logged.empty() || !thrown.empty())
        fail("gmsh could not make a mesh of it: "
             + (logged.empty() ? thrown : logged)
             + (is_generated ? ". Change the parameters of that section."
                             : ". Open the file in gmsh and mend it there."));
    }

    std::vector<int> Reader::physical_groups(const int dim,
                                             const int entity) const
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

    std::string Reader::physical_name(const int dim, const int group) const
    {
      std::string name;
      gmsh::model::getPhysicalName(dim, group, name);
      if (name.empty())
      {
        const std::string kind = (dim == 1 ? "Curve" : "Surface");
        fail("physical " + std::string(dim == 1 ? "curve " : "surface ")
             + std::to_string(group) + " has no name. Give it one: Physical "
             + kind
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

    void Reader::refuse_elements(const int type, const std::string &where) const
    {
      std::string name;
      int element_dim, order, n_nodes, n_primary;
      std::vector<double> coordinates;
      gmsh::model::mesh::getElementProperties(type, name, element_dim, order,
                                              n_nodes, coordinates, n_primary);
      fail(where + " has elements of the kind '" + name
           + "'. Only three-node triangles can be used: remove Recombine, or "
             "set 'Triangles = crossed' in section 'Mesh', which cuts "
             "quadrangles, and keep Mesh.ElementOrder = 1.");
    }

    void Reader::read_triangles()
    {
      gmsh::vectorpair surfaces;
      gmsh::model::getEntities(surfaces, 2);
      std::vector<int> without_group;
      for (const auto &[dim, surface] : surfaces)
      {
        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim, surface);
        if (types.empty())
          continue;
        const std::string where = "surface " + std::to_string(surface);

        const std::vector<int> groups = physical_groups(dim, surface);
        if (groups.empty())
        {
          without_group.push_back(surface);
          continue;
        }
        if (groups.size() > 1)
          fail(where + " is in several physical surfaces (" + list(groups)
               + "). Put each surface in exactly one.");
        const unsigned int group
            = index_of(physical_name(dim, groups[0]), mesh.group_names);

        for (std::size_t t = 0; t < types.size(); ++t)
        {
          if (types[t] == gmsh_quad && kind == TriangleKind::crossed)
            for (std::size_t i = 0; i < nodes[t].size(); i += 4)
              quad_tags.push_back({ { nodes[t][i], nodes[t][i + 1],
                                      nodes[t][i + 2], nodes[t][i + 3] } });
          else if (types[t] == gmsh_triangle)
            for (std::size_t i = 0; i < nodes[t].size(); i += 3)
              triangle_tags.push_back(
                  { { nodes[t][i], nodes[t][i + 1], nodes[t][i + 2] } });
          else
            refuse_elements(types[t], where);
        }
        mesh.triangle_group.resize(triangle_tags.size(), group);
        quadrangles.group.resize(quad_tags.size(), group);
      }
      if (!without_group.empty())
        fail("no physical group holds the surface"
             + std::string(without_group.size() > 1 ? "s " : " ")
             + list(without_group)
             + ". Name every surface: Physical Surface(\"rock\") = {...};");
      if (kind == TriangleKind::crossed && quad_tags.empty())
        fail("there are no quadrangles in it, which 'Triangles = crossed' in "
             "section 'Mesh' needs. Give the geometry (.geo), save the mesh "
             "recombined, or set 'Triangles = plain'.");
      if (triangle_tags.empty() && quad_tags.empty())
        fail("there are no triangles in it. Save the mesh in two dimensions "
             "(gmsh -2) with its physical surfaces.");
    }

    void Reader::read_lines()
    {
      gmsh::vectorpair curves;
      gmsh::model::getEntities(curves, 1);
      for (const auto &[dim, curve] : curves)
      {
        const std::vector<int> groups = physical_groups(dim, curve);
        if (groups.empty())
          continue;
        if (groups.size() > 1)
          fail("curve " + std::to_string(curve)
               + " is in several physical curves (" + list(groups)
               + "). Put each curve in one at most.");
        const unsigned int name
            = index_of(physical_name(dim, groups[0]), mesh.line_names);

        std::vector<int> types;
        std::vector<std::vector<std::size_t>> elements, nodes;
        gmsh::model::mesh::getElements(types, elements, nodes, dim, curve);
        for (std::size_t t = 0; t < types.size(); ++t)
        {
          if (types[t] != gmsh_line)
            fail("curve " + std::to_string(curve)
                 + " has curved elements. Keep Mesh.ElementOrder = 1.");
          for (std::size_t i = 0; i < nodes[t].size(); i += 2)
            line_tags.push_back({ { nodes[t][i], nodes[t][i + 1] } });
        }
        mesh.line_name.resize(line_tags.size(), name);
      }
    }

    /** Keep the nodes in use, in the order of the file. */
    void Reader::read_vertices()
    {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
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
              fail("an element refers to node " + std::to_string(tag)
                   + ", which the file does not define. Save it again from "
                     "gmsh.");
            tag          = node;
            vertex[node] = 1;
          }
      };
      mark(triangle_tags);
      mark(quad_tags);
      mark(line_tags);

      // 2. Number the nodes in use and copy their coordinates.
      const double size = [&]()
      {
        double largest = 0.;
        for (const double x : coordinates)
          largest = std::max(largest, std::abs(x));
        return largest;
      }();
      for (std::size_t i = 0; i < tags.size(); ++i)
        if (vertex[i] == 1)
        {
          const double *x = &coordinates[3 * i];
          // Not a number is off the plane, too.
          if (!(std::abs(x[2]) <= plane_tolerance * size))
          {
            std::ostringstream message;
            message << "node " << tags[i] << " at (" << x[0] << ", " << x[1]
                    << ", " << x[2]
                    << ") is off the plane z = 0. Draw the geometry in the "
                       "x-y plane.";
            fail(message.str());
          }
          vertex[i] = mesh.vertices.size();
          mesh.vertices.emplace_back(x[0], x[1]);
        }

      // 3. Elements.
      mesh.triangles.reserve(triangle_tags.size());
      for (const auto &t : triangle_tags)
        mesh.triangles.push_back(
            { { vertex[t[0]], vertex[t[1]], vertex[t[2]] } });
      for (const auto &q : quad_tags)
        quadrangles.nodes.push_back(
            { { vertex[q[0]], vertex[q[1]], vertex[q[2]], vertex[q[3]] } });
      add_crossed_triangles(quadrangles, mesh);
      mesh.lines.reserve(line_tags.size());
      for (const auto &l : line_tags)
        mesh.lines.push_back({ { vertex[l[0]], vertex[l[1]] } });
    }

    MeshData Reader::read()
    {
      check_file();
      const GmshSession session(filename);
      open_and_mesh();
      read_triangles();
      read_lines();
      read_vertices();
      orient_triangles(mesh);
      if (kind == TriangleKind::quadratic)
        cut_into_quadratic_triangles(mesh);
      return std::move(mesh);
    }
  } // namespace

  MeshData read_gmsh(const std::string &filename, const TriangleKind kind)
  {
    return Reader(filename, kind).read();
  }

  namespace
  {
    /** What @p read gives on the first rank, on all of them. */
    template <typename Read>
    MeshData read_and_send(const MPI_Comm &communicator, const Read &read)
    {
      // The others must hear of an error, too, or they wait forever.
      std::pair<MeshData, std::string> mesh_and_error;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        try
        {
          mesh_and_error.first = read();
        }
        catch (const std::exception &error)
        {
          mesh_and_error.second = error.what();
        }
        catch (const std::string &message) // gmsh throws these, too
        {
          mesh_and_error.second = "gmsh could not read the mesh: " + message;
        }
        catch (...)
        {
          mesh_and_error.second = "gmsh could not read the mesh.";
        }
      mesh_and_error
          = dealii::Utilities::MPI::broadcast(communicator, mesh_and_error);
      if (!mesh_and_error.second.empty())
        throw InputError(mesh_and_error.second);
      return std::move(mesh_and_error.first);
    }

    /** A file of the system's folder for such, gone with this object. */
    class TemporaryGeometry
    {
    public:
      TemporaryGeometry(const std::string &text, const std::string &maker)
      {
        std::error_code ignored;
        name = std::filesystem::temp_directory_path(ignored)
               / "quoin-XXXXXX.geo";
        const int file = mkstemps(name.data(), 4);
        if (file >= 0)
          close(file);
        std::ofstream stream(name);
        stream << text;
        stream.close();
        if (file >= 0 && stream)
          return;
        remove();
        throw InputError("Mesh '" + maker + "': its geometry cannot be written "
                         + "to '" + name
                         + "'. Give a folder with space in the environment "
                           "variable TMPDIR.");
      }
      ~TemporaryGeometry()
      {
        remove();
      }
      TemporaryGeometry(const TemporaryGeometry &)            = delete;
      TemporaryGeometry &operator=(const TemporaryGeometry &) = delete;

      std::string name;

    private:
      void remove() const
      {
        std::error_code ignored;
        std::filesystem::remove(name, ignored);
      }
    };
  } // namespace

  MeshData read_gmsh(const std::string &filename, const MPI_Comm &communicator,
                     const TriangleKind kind)
  {
    return read_and_send(communicator,
                         [&]() { return read_gmsh(filename, kind); });
  }

  MeshData mesh_gmsh_geometry(const std::string &geometry,
                              const std::string &maker,
                              const MPI_Comm &communicator,
                              const TriangleKind kind)
  {
    return read_and_send(communicator,
                         [&]()
                         {
                           const TemporaryGeometry file(geometry, maker);
                           return Reader(file.name, kind, maker).read();
                         });
  }

  void write_gmsh_mesh(const std::string &geo_file, const std::string &msh_file,
                       const TriangleKind kind)
  {
    const GmshSession session(geo_file);
    try
    {
      gmsh::open(geo_file);
      mesh_surfaces(kind);
      gmsh::write(msh_file);
    }
    catch (...)
    {
      throw RunError("gmsh cannot write the mesh '" + msh_file
                     + "'. Is the disk full?");
    }
  }
} // namespace quoin
