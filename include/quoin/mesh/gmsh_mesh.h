// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_mesh_gmsh_mesh_h
#define quoin_mesh_gmsh_mesh_h

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

namespace quoin
{
  /**
   * What the program quoin_gmsh answers: a mesh, or why there is none. Both
   * programs include this header, which therefore needs the standard library
   * alone.
   */
  struct GmshMesh
  {
    std::string gmsh_errors; /**< messages of gmsh; empty: none */
    std::string refusal;     /**< error of the mesh; empty: none */

    /**
     * In two dimensions cells are triangles and quadrangles, faces lines; in
     * three, cells are tetrahedra, faces triangles. Faces are those of named
     * curves or surfaces.
     */
    unsigned int dimension = 2;
    /** How many times halve_edges() is still to halve all edges. */
    unsigned int n_halvings = 0;

    std::vector<std::array<double, 3>> vertices; /**< [m] */
    std::vector<std::array<unsigned int, 4>> tetrahedra;
    std::vector<std::array<unsigned int, 3>> triangles;
    std::vector<std::array<unsigned int, 4>> quadrangles;
    std::vector<std::array<unsigned int, 2>> lines;

    std::vector<unsigned int> cell_group;       /**< indices into group_names */
    std::vector<unsigned int> quadrangle_group; /**< indices into group_names */
    std::vector<unsigned int> face_name;        /**< indices into face_names */

    std::vector<std::string> group_names;
    std::vector<std::string> face_names{ "" }; /**< [0] is "", unnamed */

    /** Hand each member to @p channel, in the order of the stream. */
    template <typename Channel>
    void transfer(Channel &&channel)
    {
      channel(gmsh_errors);
      channel(refusal);
      channel(dimension);
      channel(n_halvings);
      channel(vertices);
      channel(tetrahedra);
      channel(triangles);
      channel(quadrangles);
      channel(lines);
      channel(cell_group);
      channel(quadrangle_group);
      channel(face_name);
      channel(group_names);
      channel(face_names);
    }
  };

  /**
   * One direction of a binary stream between two programs on one machine: each
   * container as its size and its elements.
   */
  class GmshChannel
  {
  public:
    enum class Direction
    {
      send,
      receive
    };

    GmshChannel(std::FILE *stream, const Direction direction)
      : stream(stream), direction(direction)
    {
    }

    void operator()(unsigned int &number)
    {
      bytes(&number, sizeof(number));
    }

    /** A string or a vector of what can be copied byte by byte. */
    template <typename Container>
    void operator()(Container &container)
    {
      using Value = typename Container::value_type;
      static_assert(std::is_trivially_copyable_v<Value>);
      transfer_size(container);
      bytes(container.data(), container.size() * sizeof(Value));
    }

    void operator()(std::vector<std::string> &texts)
    {
      transfer_size(texts);
      for (std::string &text : texts)
        (*this)(text);
    }

    /** Whether all has been sent or received so far. */
    bool is_complete() const
    {
      return complete;
    }

  private:
    template <typename Container>
    void transfer_size(Container &container)
    {
      std::uint64_t size = container.size();
      bytes(&size, sizeof(size));
      container.resize(complete ? size : 0);
    }

    void bytes(void *data, const std::size_t size)
    {
      const std::size_t n = direction == Direction::send
                                ? std::fwrite(data, 1, size, stream)
                                : std::fread(data, 1, size, stream);
      complete            = complete && n == size;
    }

    std::FILE *stream;
    Direction direction;
    bool complete = true;
  };
} // namespace quoin

#endif
