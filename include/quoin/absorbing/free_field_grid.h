// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_absorbing_free_field_grid_h
#define quoin_absorbing_free_field_grid_h

#include <quoin/absorbing/free_field_column.h>

#include <map>
#include <optional>
#include <set>

namespace quoin
{
  /**
   * The ground beside a vertical plane side of a model in three dimensions,
   * which does not change along the normal of the side: triangles with the
   * nodes of the side and its properties, linear and elastic, whose
   * displacements have three components. At both vertical ends of the side it
   * is held by the stresses and dashpots of a FreeFieldColumn with the nodes
   * of that end, as the model is by the grid. The foot is driven as that of a
   * column, all else is free. Nodes of blocks at one place are one node of the
   * grid: joints are closed.
   *
   * Its motion is that of packed vectors: its own nodes, then those of the two
   * columns.
   */
  class FreeFieldGrid
  {
  public:
    using Place = std::array<double, 3>;

    /**
     * @p faces: those of the side, all in one vertical plane; @p base:
     * impedance [Pa s/m] below each place where the boundary of the base has a
     * node, none where several meet. Throws an InputError about a side that the
     * load @p load cannot continue.
     */
    FreeFieldGrid(const std::string &load,
                  const std::vector<BoundaryFace<3>> &faces,
                  const FreeFieldGround &ground,
                  const std::map<Place, std::optional<Impedance>> &base,
                  const std::string &base_name);

    /** Node of the grid at node @p k of face @p f. */
    unsigned int node_of(const unsigned int f, const unsigned int k) const
    {
      return triangles[f].nodes[k];
    }
    /** Number of nodes, with those of the columns. */
    unsigned int n_nodes() const
    {
      return node_mass.size() + columns[0].n_nodes() + columns[1].n_nodes();
    }
    /** Upper bound of omega^2 of its triangles and columns [1/s^2]. */
    double largest_eigenvalue() const;

    /** As FreeFieldColumn::advance(). */
    void advance(const StepContext &step, const FreeFieldFoot<3> &foot,
                 double *u, double *v);
    dealii::Tensor<1, 3> velocity(unsigned int node) const;
    /** Adds to @p total the force of the ground at face @p f [N] on the @p area
        with its outward normal [m^2]. */
    void add_force(const unsigned int f, const dealii::Tensor<1, 3> &area,
                   dealii::Tensor<1, 3> &total) const
    {
      total += triangles[f].stress * area;
    }

  private:
    using Vector = dealii::Tensor<1, 3>;

    struct Triangle
    {
      std::array<unsigned int, 3> nodes;
      std::array<Vector, 3> gradients; /**< of the shape functions [1/m] */
      double area;                     /**< [m^2] */
      double density;                  /**< [kg/m^3] */
      SpaceStiffness stiffness;
      dealii::SymmetricTensor<2, 3> stress; /**< at t [Pa] */
    };
    /** An edge of the grid that one triangle has. */
    struct Edge
    {
      std::array<unsigned int, 2> nodes; /**< lower one first */
      unsigned int group;
      unsigned int opposite; /**< node of the triangle */
    };
    /** Where a node hangs on a column by a dashpot. */
    struct Tie
    {
      unsigned int node, column, column_node;
      Dashpot<3> dashpot;
    };
    /** Half of an edge at a column, whose layer acts on it. */
    struct Share
    {
      unsigned int node, column, layer;
      Vector area; /**< outward, by unit thickness [m^2] */
    };
    /** A node at the foot. */
    struct Support
    {
      double width;     /**< that of the foot there, by unit thickness [m^2] */
      Vector impedance; /**< along the axes [Pa s m] */
    };

    std::string place_text(unsigned int node) const;
    void make_triangles(const std::vector<BoundaryFace<3>> &faces,
                        const FreeFieldGround &ground);
    /** Edges that one triangle has. */
    std::vector<Edge> outline(const std::vector<BoundaryFace<3>> &faces) const;
    /** How far @p node is along the side [m]. */
    double way(unsigned int node) const;
    /** Refuses edges of the outline that are neither at the ends @p ends of the
        side [m], at its foot nor below air. */
    void refuse_gaps(const std::vector<Edge> &outline,
                     const std::array<double, 2> &ends) const;
    void make_column(unsigned int end, std::vector<Edge> edges,
                     const FreeFieldGround &ground);
    void make_foot(const std::vector<Edge> &outline,
                   const std::map<Place, std::optional<Impedance>> &base,
                   const std::string &base_name);
    void add_stresses(const StepContext &step, const double *u,
                      const double *v);

    const std::string load;
    Vector along;                  /**< horizontal unit vector along the side */
    double size = 0., foot = 0.;   /**< of the smallest edge; height [m] */
    std::vector<Place> places;     /**< of nodes [m] */
    std::vector<double> node_mass; /**< by unit thickness [kg] */
    std::vector<Triangle> triangles;
    std::vector<FreeFieldColumn<3>> columns; /**< at the two ends */
    std::vector<Tie> ties;
    std::vector<Share> shares;
    std::map<unsigned int, Support> supports; /**< of nodes */
    /** Dashpots of the nodes at both ends and at the foot [N s/m]. */
    std::map<unsigned int, Dashpot<3>> dashpots;

    std::vector<Vector> force, mean_velocity; /**< of nodes at t [N], [m/s] */
  };
} // namespace quoin

#endif
