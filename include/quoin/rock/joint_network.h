// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_rock_joint_network_h
#define quoin_rock_joint_network_h

#include <quoin/layout/polygon.h>

#include <cstdint>
#include <vector>

namespace quoin
{
  /**
   * Lines in the plane, cut where they meet: edges that share nothing but their
   * ends, and ends that are no nearer than a tolerance to each other and to
   * edges that they do not belong to.
   *
   * What is nearer is moved together, by less than the tolerance: an end within
   * it of an edge is joined to it, ends within it of each other become one.
   * Borders do not move: corners of theirs stay where they are, other points
   * on them stay on their line, but for those within the tolerance of a corner
   * of another border, which go there.
   */
  class JointNetwork
  {
  public:
    explicit JointNetwork(const double tolerance) : tolerance(tolerance)
    {
    }

    struct Edge
    {
      unsigned int from, to; /**< vertices */
      unsigned int line;     /**< line number given to add() */
      /** Number of the straight border it is part of. */
      unsigned int border = none;
    };
    static constexpr unsigned int none = -1;

    /**
     * Adds a straight line. @p line: any number that its parts are to carry;
     * where lines coincide the smallest prevails. Borders first.
     */
    void add(const Piece &piece, unsigned int line, bool is_border);

    /**
     * Cuts and joins until nothing is left to do. Throws InputError if that
     * does not come to an end, or if borders cross.
     */
    void cut();

    /** Drops edges for which @p goes(edge) holds. */
    template <typename Goes>
    void remove(const Goes &goes)
    {
      std::vector<Edge> kept;
      for (const Edge &edge : all_edges)
        if (!goes(edge))
          kept.push_back(edge);
      all_edges = std::move(kept);
    }

    /**
     * Lengthens every line that ends at no other one straight on to the next
     * edge, and cuts again. Returns how many were lengthened, and adds the
     * length to @p added [m].
     */
    unsigned int extend_ends(double &added);

    const std::vector<Edge> &edges() const
    {
      return all_edges;
    }
    const dealii::Point<2> &point(const unsigned int vertex) const
    {
      return vertices[vertex].position;
    }
    unsigned int n_vertices() const
    {
      return vertices.size();
    }
    dealii::Point<2> middle(const Edge &edge) const
    {
      return point(edge.from) + 0.5 * (point(edge.to) - point(edge.from));
    }
    double length(const Edge &edge) const
    {
      return point(edge.from).distance(point(edge.to));
    }

    /** Ends that were moved to others or to edges. */
    unsigned int n_joined() const
    {
      return joined;
    }

  private:
    struct Vertex
    {
      dealii::Point<2> position;
      bool is_corner = false; /**< whether the vertex is a corner of a border */
      unsigned int border = none; /**< border on which the vertex lies */

      bool is_free() const
      {
        return !is_corner && border == none;
      }
    };

    /** Crossing of two edges that share no end. */
    struct Crossing
    {
      unsigned int first, second;
      dealii::Point<2> where;
    };

    std::vector<Crossing> find_crossings() const;
    unsigned int add_vertex(const dealii::Point<2> &position, bool is_corner);
    /** Cuts edges where they cross and where ends lie on them. */
    bool cut_edges();
    void cut_at_crossings(std::vector<std::vector<unsigned int>> &cuts);
    void refuse_crossings() const;
    bool cut_at_ends(std::vector<std::vector<unsigned int>> &cuts);
    bool join_ends();
    void rebuild(const std::vector<std::vector<unsigned int>> &cuts);
    void drop_duplicates();
    bool may_join(const Vertex &moving, const Vertex &to) const;
    [[noreturn]] void fail(const dealii::Point<2> &where,
                           const std::string &what) const;

    const double tolerance; /**< [m] */
    std::vector<Vertex> vertices;
    std::vector<Edge> all_edges;
    unsigned int n_borders = 0;
    unsigned int joined    = 0;
    dealii::Point<2> last_moved; /**< an end, to where [m] */
  };
} // namespace quoin

#endif
