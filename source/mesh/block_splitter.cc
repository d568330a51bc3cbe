// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/disjoint_sets.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/nearest_name.h>
#include <quoin/base/none.h>
#include <quoin/base/point_text.h>
#include <quoin/mesh/block_numbering.h>
#include <quoin/mesh/block_splitter.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace quoin
{
  namespace
  {
    /** Vertices of each side of a simplex: its normal, to the right of the edge
        in two dimensions and by the right hand in three, points outwards. */
    template <int dim>
    constexpr std::array<std::array<unsigned int, dim>, dim + 1>
        side_vertices{};
    template <>
    constexpr std::array<std::array<unsigned int, 2>, 3> side_vertices<2>{
      { { { 0, 1 } }, { { 1, 2 } }, { { 2, 0 } } }
    };
    template <>
    constexpr std::array<std::array<unsigned int, 3>, 4> side_vertices<3>{
      { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 1, 2, 3 } }, { { 2, 0, 3 } } }
    };

    /** How two sides with the same vertices turn. */
    enum class Turn
    {
      apart, /**< they have other vertices */
      same,
      opposite
    };

    /**
     * Cuts one mesh. Side (dim + 1) c + k of cell c is an edge or a face of
     * it; see side_vertices. Its corners are numbered likewise.
     */
    template <int dim>
    class Splitter
    {
    public:
      Splitter(const MeshData<dim> &data, const SplitOptions &options,
               BlockMesh<dim> &mesh)
        : data(data), options(options), mesh(mesh),
          n_sides((dim + 1) * data.cells.size())
      {
      }

      void run();

    private:
      using Point = dealii::Point<dim>;

      static unsigned int cell_of(const unsigned int s)
      {
        return s / (dim + 1);
      }
      /** Vertex @p k of side @p s as a corner of its cell. */
      static unsigned int corner(const unsigned int s, const unsigned int k)
      {
        return s - s % (dim + 1) + side_vertices<dim>[s % (dim + 1)][k];
      }
      /** Vertex @p k of side @p s in the mesh. */
      unsigned int vertex(const unsigned int s, const unsigned int k) const
      {
        return data.cells[cell_of(s)][side_vertices<dim>[s % (dim + 1)][k]];
      }
      const Point &point(const unsigned int s, const unsigned int k) const
      {
        return data.vertices[vertex(s, k)];
      }
      unsigned int lowest_vertex(const unsigned int s) const
      {
        unsigned int v = vertex(s, 0);
        for (unsigned int k = 1; k < dim; ++k)
          v = std::min(v, vertex(s, k));
        return v;
      }
      template <std::size_t n>
      Point middle(const std::array<unsigned int, n> &vertices) const
      {
        dealii::Tensor<1, dim> sum;
        for (const unsigned int v : vertices)
          sum += data.vertices[v];
        return Point(sum / double(n));
      }
      Point middle(const unsigned int s) const
      {
        return middle(vertices_of(s));
      }
      std::array<unsigned int, dim> vertices_of(const unsigned int s) const
      {
        std::array<unsigned int, dim> result;
        for (unsigned int k = 0; k < dim; ++k)
          result[k] = vertex(s, k);
        return result;
      }
      /** Outward normal, as long as the side or twice its area. */
      dealii::Tensor<1, dim> normal(const unsigned int s) const
      {
        const auto a = point(s, 1) - point(s, 0);
        if constexpr (dim == 2)
          return dealii::Tensor<1, 2>({ a[1], -a[0] });
        else
          return dealii::cross_product_3d(a, point(s, 2) - point(s, 0));
      }

      /** How sides @p s and @p t turn where @p same says which vertices are. */
      template <typename Same>
      Turn compare(const unsigned int s, const unsigned int t,
                   const Same &same) const;
      /** The vertex of @p t on which vertex @p k of its opposite @p s lies. */
      unsigned int vertex_below(const unsigned int s, const unsigned int k,
                                const unsigned int t) const;

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("Mesh '" + data.source + "': " + what);
      }
      static std::string at(const Point &p)
      {
        return " at " + point_text(p);
      }
      static constexpr const char *cells_word
          = dim == 2 ? "triangles" : "tetrahedra";
      static constexpr const char *side_word  = dim == 2 ? "edge" : "face";
      static constexpr const char *face_word  = dim == 2 ? "curve" : "surface";
      static constexpr const char *group_word = dim == 2 ? "surface" : "volume";
      /** What is named @p name. */
      std::string named(const unsigned int name) const
      {
        if (name == 0)
          return std::string("a joint between ") + group_word + "s";
        return std::string(face_word) + " '" + data.face_names[name] + "'";
      }

      unsigned int index_of(const std::string &name,
                            const std::vector<std::string> &names,
                            const std::string &parameter,
                            const std::string &kind) const;
      void resolve_names();
      void find_neighbours();
      void name_sides();
      void mark_joints();
      void unite_corners();
      void check_joint_ends() const;
      void match_outer_sides();
      void check_names_on_boundary() const;
      void fill_faces();
      void draw_together();

      const MeshData<dim> &data;
      const SplitOptions &options;
      BlockMesh<dim> &mesh;
      const unsigned int n_sides;

      /** By face name: does options.joints_along hold it? */
      std::vector<bool> is_joint_name;
      /** By pair of groups: do options split there? */
      std::vector<bool> is_joint_pair;

      /** Sides by the lowest of their vertices. */
      std::vector<unsigned int> bucket_begin, bucket;

      /** Neighbour across the side in the other cell. */
      std::vector<unsigned int> neighbour;
      std::vector<unsigned int> name; /**< index of the named face on a side */
      std::vector<bool> is_joint;     /**< whether the side has a neighbour */
      std::vector<unsigned int> partner; /**< across a joint of any kind */
      std::vector<unsigned int> vertex_of_corner, block_of_cell;
      unsigned int n_blocks = 0;
    };

    template <int dim>
    template <typename Same>
    Turn Splitter<dim>::compare(const unsigned int s, const unsigned int t,
                                const Same &same) const
    {
      const auto a = vertices_of(s), b = vertices_of(t);
      // Two vertices have one order and its reverse, three have three turns.
      constexpr unsigned int n_turns = dim == 2 ? 1 : dim;
      for (unsigned int turn = 0; turn < n_turns; ++turn)
      {
        bool is_same = true, is_opposite = true;
        for (unsigned int k = 0; k < dim; ++k)
        {
          is_same = is_same && same(a[k], b[(turn + k) % dim]);
          is_opposite
              = is_opposite && same(a[k], b[(turn + dim - 1 - k) % dim]);
        }
        if (is_same || is_opposite)
          return is_same ? Turn::same : Turn::opposite;
      }
      return Turn::apart;
    }

    template <int dim>
    unsigned int Splitter<dim>::vertex_below(const unsigned int s,
                                             const unsigned int k,
                                             const unsigned int t) const
    {
      if constexpr (dim == 2)
        return 1 - k;
      unsigned int nearest = 0;
      for (unsigned int j = 1; j < dim; ++j)
        if (point(t, j).distance_square(point(s, k))
            < point(t, nearest).distance_square(point(s, k)))
          nearest = j;
      return nearest;
    }

    template <int dim>
    unsigned int Splitter<dim>::index_of(const std::string &wanted,
                                         const std::vector<std::string> &names,
                                         const std::string &parameter,
                                         const std::string &kind) const
    {
      const auto place = std::find(names.begin(), names.end(), wanted);
      if (!wanted.empty() && place != names.end())
        return place - names.begin();

      fail("there is no physical " + kind + " '" + wanted + "', which Mesh/"
           + parameter + " names. The mesh has "
           + known_names_like(wanted, names) + ".");
    }

    template <int dim>
    void Splitter<dim>::resolve_names()
    {
      is_joint_name.assign(data.face_names.size(), false);
      for (const std::string &n : options.joints_along)
        if (!options.may_lack_joints
            || std::find(data.face_names.begin(), data.face_names.end(), n)
                   != data.face_names.end())
          is_joint_name[index_of(n, data.face_names, "Joints along", face_word)]
              = true;

      const std::size_t n_groups = data.group_names.size();
      is_joint_pair.assign(n_groups * n_groups, options.between_all);
      for (std::size_t g = 0; g < n_groups; ++g)
        is_joint_pair[g * n_groups + g] = false;
      for (const auto &[a, b] : options.joints_between)
      {
        const unsigned int i
            = index_of(a, data.group_names, "Joints between", group_word);
        const unsigned int j
            = index_of(b, data.group_names, "Joints between", group_word);
        if (i == j)
          fail(std::string("Mesh/Joints between pairs ") + group_word + " '" + a
               + "' with itself. Name two different " + group_word
               + "s; for joints inside a " + group_word + ", draw a "
               + face_word + " and use Joints along.");
        is_joint_pair[i * n_groups + j] = is_joint_pair[j * n_groups + i]
            = true;
      }
    }

    template <int dim>
    void Splitter<dim>::find_neighbours()
    {
      // 1. Sides by the lowest of their vertices: counting sort.
      bucket_begin.assign(data.vertices.size() + 1, 0);
      for (unsigned int s = 0; s < n_sides; ++s)
        ++bucket_begin[lowest_vertex(s) + 1];
      std::partial_sum(bucket_begin.begin(), bucket_begin.end(),
                       bucket_begin.begin());
      bucket.resize(n_sides);
      std::vector<unsigned int> end(bucket_begin.begin(),
                                    bucket_begin.end() - 1);
      for (unsigned int s = 0; s < n_sides; ++s)
        bucket[end[lowest_vertex(s)]++] = s;

      // 2. Pairs that turn oppositely within the few of each vertex.
      neighbour.assign(n_sides, none);
      for (unsigned int v = 0; v < data.vertices.size(); ++v)
        for (unsigned int i = bucket_begin[v]; i < bucket_begin[v + 1]; ++i)
          for (unsigned int j = bucket_begin[v]; j < i; ++j)
          {
            const unsigned int a = bucket[i], b = bucket[j];
            const Turn turn = compare(a, b, std::equal_to<>());
            if (turn == Turn::same
                || (turn == Turn::opposite
                    && (neighbour[a] != none || neighbour[b] != none)))
              fail(std::string(cells_word) + " overlap at the " + side_word
                   + at(middle(a))
                   + ": it has more than one of them on a side. Remove the "
                   + group_word + " that is there twice.");
            if (turn == Turn::opposite)
            {
              neighbour[a] = b;
              neighbour[b] = a;
            }
          }
    }

    template <int dim>
    void Splitter<dim>::name_sides()
    {
      name.assign(n_sides, 0);
      std::vector<bool> has_faces(data.face_names.size(), false);
      for (std::size_t f = 0; f < data.faces.size(); ++f)
      {
        auto sorted                  = data.faces[f];
        const unsigned int face_name = data.face_name[f];
        has_faces[face_name]         = true;
        bool found                   = false;
        std::sort(sorted.begin(), sorted.end());
        const unsigned int v = sorted[0];
        for (unsigned int i = bucket_begin[v]; i < bucket_begin[v + 1]; ++i)
        {
          const unsigned int s = bucket[i];
          auto vertices        = vertices_of(s);
          std::sort(vertices.begin(), vertices.end());
          if (vertices != sorted)
            continue;
          if (name[s] != 0 && name[s] != face_name)
            fail(std::string("the ") + face_word + "s '"
                 + data.face_names[name[s]] + "' and '"
                 + data.face_names[face_name] + "' lie on each other"
                 + at(middle(s)) + ". Leave one of them there.");
          name[s] = face_name;
          found   = true;
        }
        if (!found && is_joint_name[face_name])
          fail(named(face_name) + " is no " + side_word + " of the mesh"
               + at(middle(sorted)) + ". Let it bound the " + group_word
               + "s there, or embed it: "
               + (dim == 2 ? "Curve{...} In Surface{...};"
                           : "Surface{...} In Volume{...};"));
      }
      for (unsigned int n = 1; n < data.face_names.size(); ++n)
        if (is_joint_name[n] && !has_faces[n])
          fail(named(n) + " has no "
               + (dim == 2 ? "line elements" : "triangles")
               + ", so that there is no joint along it. Save the mesh with its "
               + face_word + "s.");
    }

    template <int dim>
    void Splitter<dim>::mark_joints()
    {
      const std::size_t n_groups = data.group_names.size();
      is_joint.assign(n_sides, false);
      partner.assign(n_sides, none);
      for (unsigned int s = 0; s < n_sides; ++s)
        if (neighbour[s] != none
            && (is_joint_name[name[s]]
                || is_joint_pair[data.cell_group[cell_of(s)] * n_groups
                                 + data.cell_group[cell_of(neighbour[s])]]))
        {
          is_joint[s] = true;
          partner[s]  = neighbour[s];
        }
    }

    template <int dim>
    void Splitter<dim>::unite_corners()
    {
      DisjointSets corners(n_sides);
      DisjointSets cells(data.cells.size());
      for (unsigned int s = 0; s < n_sides; ++s)
      {
        const unsigned int t = neighbour[s];
        if (t == none || t < s || is_joint[s])
          continue;
        for (unsigned int k = 0; k < dim; ++k)
          corners.unite(corner(s, k), corner(t, vertex_below(s, k, t)));
        cells.unite(cell_of(s), cell_of(t));
      }
      unsigned int n_vertices                = 0;
      std::tie(vertex_of_corner, n_vertices) = corners.numbers();
      std::tie(block_of_cell, n_blocks)      = cells.numbers();

      mesh.vertices.resize(n_vertices);
      mesh.cells.resize(data.cells.size());
      for (unsigned int c = 0; c < data.cells.size(); ++c)
        for (unsigned int k = 0; k <= dim; ++k)
        {
          const unsigned int v = vertex_of_corner[(dim + 1) * c + k];
          mesh.vertices[v]     = data.vertices[data.cells[c][k]];
          mesh.cells[c][k]     = v;
        }
      mesh.cell_group = data.cell_group;

      mesh.quadratic = data.quadratic;
      mesh.mixed     = data.mixed;
    }

    template <int dim>
    void Splitter<dim>::check_joint_ends() const
    {
      if (options.joint_ends == SplitOptions::keep)
        return;
      for (unsigned int s = 0; s < n_sides; ++s)
        for (unsigned int k = 0; is_joint[s] && k < dim; ++k)
          if (vertex_of_corner[corner(s, k)]
              == vertex_of_corner[corner(partner[s],
                                         vertex_below(s, k, partner[s]))])
            fail(named(name[s]) + " ends inside a block" + at(point(s, k))
                 + ". Lead the joint on to another one or to the boundary, or "
                   "set Mesh/Joint ends inside blocks = keep.");
    }

    /**
     * Blocks that are apart already: the outer sides whose vertices coincide,
     * found by their middles in a grid of the size of the shortest edge.
     */
    template <int dim>
    void Splitter<dim>::match_outer_sides()
    {
      std::vector<unsigned int> outer;
      double shortest = std::numeric_limits<double>::max();
      Point origin    = point(0, 0);
      for (unsigned int s = 0; s < n_sides; ++s)
      {
        for (unsigned int k = 0; k < (dim == 2 ? 1 : dim); ++k)
        {
          const Point &p = point(s, k);
          shortest = std::min(shortest, p.distance(point(s, (k + 1) % dim)));
          for (unsigned int d = 0; d < dim; ++d)
            origin[d] = std::min(origin[d], p[d]);
        }
        if (neighbour[s] == none)
          outer.push_back(s);
      }
      const double tolerance = options.coincidence_tolerance * shortest;
      const double width     = std::max(shortest, 4. * tolerance);

      using Box         = std::array<std::int64_t, dim>;
      const auto box_of = [&](const Point &p, const double shift)
      {
        Box box;
        for (unsigned int d = 0; d < dim; ++d)
          box[d] = static_cast<std::int64_t>(
              std::floor((p[d] + shift - origin[d]) / width));
        return box;
      };
      std::vector<std::pair<Box, unsigned int>> grid;
      grid.reserve(outer.size());
      for (const unsigned int s : outer)
        grid.push_back({ box_of(middle(s), 0.), s });
      std::sort(grid.begin(), grid.end());

      const auto close = [&](const unsigned int v, const unsigned int w)
      { return data.vertices[v].distance(data.vertices[w]) <= tolerance; };
      const auto match = [&](const unsigned int s, const unsigned int t)
      {
        const Turn turn = compare(s, t, close);
        if (turn == Turn::same
            || (turn == Turn::opposite
                && (partner[s] != none || partner[t] != none)))
          fail(std::string("blocks overlap at the ") + side_word + at(middle(s))
               + ": more than one of them is on a side of it. "
                 "Remove the one that is there twice.");
        if (turn == Turn::opposite)
        {
          partner[s] = t;
          partner[t] = s;
        }
      };
      for (const unsigned int s : outer)
      {
        const Box low  = box_of(middle(s), -tolerance);
        const Box high = box_of(middle(s), tolerance);
        for (Box box = low; box[0] <= high[0];)
        {
          for (auto it = std::lower_bound(grid.begin(), grid.end(),
                                          std::make_pair(box, 0U));
               it != grid.end() && it->first == box; ++it)
            if (it->second > s)
              match(s, it->second);
          // The next box, the last direction first.
          unsigned int d = dim - 1;
          for (++box[d]; d > 0 && box[d] > high[d]; ++box[--d])
            box[d] = low[d];
        }
      }
    }

    template <int dim>
    void Splitter<dim>::check_names_on_boundary() const
    {
      for (unsigned int s = 0; s < n_sides; ++s)
        if (is_joint_name[name[s]] && partner[s] == none)
          fail(named(name[s]) + " dangles" + at(middle(s))
               + ": it lies on the outer boundary, with no block on the other "
                 "side. Take this part out of the physical "
               + face_word + ", or the " + face_word
               + " out of Mesh/Joints along.");
    }

    template <int dim>
    void Splitter<dim>::fill_faces()
    {
      // A component of the normal this small is none.
      constexpr double share = 1e-6;

      mesh.boundary_faces.clear();
      mesh.joint_faces.clear();
      for (unsigned int s = 0; s < n_sides; ++s)
      {
        const unsigned int t = partner[s];
        std::array<unsigned int, dim> vertices;
        for (unsigned int k = 0; k < dim; ++k)
          vertices[k] = vertex_of_corner[corner(s, k)];
        if (t == none)
        {
          if (neighbour[s] == none)
            mesh.boundary_faces.push_back({ vertices, cell_of(s), name[s] });
          continue;
        }

        // Each joint comes by twice; it is taken from its lower side.
        // Coincident sides differ within the tolerance: the normal is that of
        // both.
        const auto n   = normal(s) - normal(t);
        unsigned int d = dim - 1;
        while (d > 0 && !(std::abs(n[d]) > share * n.norm()))
          --d;
        if (!(n[d] > 0.))
          continue;
        unsigned int joint_name = name[s];
        if (joint_name == 0
            || (is_joint_name[name[t]] && !is_joint_name[name[s]]))
          joint_name = name[t];
        JointFace<dim> face{ vertices,
                             {},
                             { { cell_of(s), cell_of(t) } },
                             joint_name,
                             { { data.cell_group[cell_of(s)],
                                 data.cell_group[cell_of(t)] } } };
        for (unsigned int k = 0; k < dim; ++k)
          face.upper[k] = vertex_of_corner[corner(t, vertex_below(s, k, t))];
        mesh.joint_faces.push_back(face);
      }
    }

    /** What is left of a distance between the sides of a joint would count as
        opening and slip. */
    template <int dim>
    void Splitter<dim>::draw_together()
    {
      DisjointSets places(mesh.n_vertices());
      for (const JointFace<dim> &face : mesh.joint_faces)
        for (unsigned int k = 0; k < dim; ++k)
          places.unite(face.lower[k], face.upper[k]);
      const auto [place, n_places] = places.numbers();
      std::vector<Point> first(n_places);
      std::vector<dealii::Tensor<1, dim>> sum(n_places);
      std::vector<unsigned int> n(n_places, 0);
      std::vector<bool> is_one(n_places, true);
      for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
      {
        const unsigned int p = place[v];
        if (n[p]++ == 0)
          first[p] = mesh.vertices[v];
        is_one[p] = is_one[p] && mesh.vertices[v] == first[p];
        sum[p] += mesh.vertices[v] - first[p];
      }
      for (unsigned int v = 0; v < mesh.n_vertices(); ++v)
        if (const unsigned int p = place[v]; !is_one[p])
        {
          const Point middle = first[p] + sum[p] / double(n[p]);
          mesh.largest_shift
              = std::max(mesh.largest_shift, middle.distance(mesh.vertices[v]));
          mesh.vertices[v] = middle;
        }
    }

    template <int dim>
    void Splitter<dim>::run()
    {
      if (data.cells.empty())
        fail(std::string("there are no ") + cells_word + " in it.");
      mesh.group_names        = data.group_names;
      mesh.face_names         = data.face_names;
      mesh.n_reoriented_cells = data.n_reoriented;
      mesh.largest_shift      = 0.;

      resolve_names();
      find_neighbours();
      name_sides();
      mark_joints();
      unite_corners();
      check_joint_ends();
      match_outer_sides();
      check_names_on_boundary();
      fill_faces();
      draw_together();
      number_blocks(mesh, block_of_cell, n_blocks);
    }
  } // namespace

  template <int dim>
  BlockMesh<dim> split_into_blocks(const MeshData<dim> &data,
                                   const SplitOptions &options,
                                   const std::vector<unsigned int> *block_order)
  {
    BlockMesh<dim> mesh;
    Splitter<dim>(data, options, mesh).run();
    if (block_order != nullptr)
      renumber_blocks(mesh, *block_order);
    return mesh;
  }

  template BlockMesh<2> split_into_blocks(const MeshData<2> &,
                                          const SplitOptions &,
                                          const std::vector<unsigned int> *);
  template BlockMesh<3> split_into_blocks(const MeshData<3> &,
                                          const SplitOptions &,
                                          const std::vector<unsigned int> *);
} // namespace quoin
