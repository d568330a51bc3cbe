// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_free_field_boundary_h
#define quoin_loads_free_field_boundary_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/loads/motion_constraint.h>
#include <quoin/loads/viscous_boundary.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/mesh/global_geometry.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Materials of the columns of a FreeFieldBoundary. */
  struct FreeFieldGround
  {
    std::vector<LinearElastic> materials; /**< material of each cell group */
    std::vector<bool> is_rigid;           /**< flag of each cell group */
    std::vector<bool> yields;             /**< flag of each cell group */
    PlaneAssumption plane = PlaneAssumption::plane_strain;
    Thickness thickness; /**< out-of-plane thickness of each cell group */
  };

  /** The load that drives the foot of the columns. */
  struct FreeFieldBase
  {
    LoadParameters load; /**< viscous boundary or prescribed motion */
    std::vector<Impedance> impedance; /**< impedance beyond each cell group */
  };

  /** A column beside the blocks; see FreeFieldBoundary. */
  struct FreeFieldState
  {
    bool active = false;              /**< whether it has begun */
    std::vector<double> displacement; /**< x, y of its nodes [m] */
    std::vector<double> velocity; /**< x, y of its nodes at time - dt/2 [m/s] */
    std::vector<double> held;     /**< forces on nodes of blocks [N] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active, displacement, velocity);
      visitor.own(held, 2);
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive_members(archive, *this);
    }
  };

  /**
   * A free-field boundary at a vertical side of a model whose surroundings are
   * laterally homogeneous (@cite ZienkiewiczBicanicShen1989): beside it stands
   * a column of the ground along the side, with a node at the height of each
   * node of the side, in which P and S waves travel up and down. Its top is
   * free, its foot is driven as the base of the model. The traction on the
   * side, whose outward normal n is horizontal, is
   * @f[ t = \sigma_f n + \rho c_1 (v_f - v)_x + \rho c_2 (v_f - v)_y, @f]
   * f the column: the free-field motion is not reflected, and waves from the
   * model leave through dashpots. The model does not act on the column. Joints
   * that meet the side are closed in the column.
   *
   * When it first acts the column is at rest and without stress; the unbalanced
   * forces on the side are held from then on, so that stresses of an earlier
   * stage need no other load. Each rank computes the whole column. The dashpots
   * are those of ViscousBoundary, also where the side meets a viscous base,
   * whose share at that node is included.
   */
  class FreeFieldBoundary : public MotionConstraint<2>
  {
  public:
    /**
     * Throws an InputError about a side that is not vertical or not in one
     * piece, or a base that cannot drive a column.
     */
    FreeFieldBoundary(const LoadParameters &parameters,
                      const NodeMap<2> &node_map, const FreeFieldGround &ground,
                      const FreeFieldBase &base);

    void prepare(State<2> &state) const override;
    void begin_stage(State<2> &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<2>> &captured,
                 State<2> &state) override;
    double largest_eigenvalue() const override;

    /** Heights of the column's nodes, ascending [m]. */
    const std::vector<double> &heights() const
    {
      return node_height;
    }

  private:
    /** A layer between two nodes of the column. */
    struct Layer
    {
      double height;    /**< [m] */
      double thickness; /**< [m] */
      double density;   /**< [kg/m^3] */
      PlaneStiffness stiffness;
    };

    /** Share of half an edge of the side in a node. */
    struct Share
    {
      unsigned int node; /**< index into nodes() */
      unsigned int layer;
      double area; /**< negative where n points left [m^2] */
    };

    [[noreturn]] void fail(const std::string &setting,
                           const std::string &why) const;
    void make_column(const std::vector<BoundaryFace<2>> &faces,
                     const FreeFieldGround &ground);
    void make_shares(const NodeMap<2> &node_map,
                     const std::vector<BoundaryFace<2>> &faces);
    /** Sets up the foot and returns the base's faces. */
    std::vector<BoundaryFace<2>> make_foot(const NodeMap<2> &node_map,
                                           const FreeFieldBase &given);
    unsigned int node_at(double height) const;
    void start(const std::vector<CapturedNode<2>> &captured,
               FreeFieldState &column);
    void move_foot(const StepContext &step, const double *force,
                   FreeFieldState &column) const;
    /** Advances the column from t to t + dt and finds the pull at t. */
    void advance(const StepContext &step, FreeFieldState &column);

    double x       = 0.; /**< coordinate x of the side [m] */
    double outward = 0.; /**< n_x: 1 or -1 */
    std::vector<double> node_height;
    std::vector<double> node_mass; /**< mass by width of the column [kg/m] */
    std::vector<Layer> layers;

    /** Load at the foot of the column. */
    struct Foot
    {
      std::string name; /**< name of the load */
      bool is_prescribed = false;
      std::array<LoadComponent, 3> components;
      /** Impedance for x, y per thickness [Pa s]. */
      dealii::Tensor<1, 2> impedance;
    } base;

    /** Column node of each of nodes(). */
    std::vector<unsigned int> column_node;
    std::vector<Share> shares;
    std::vector<Dashpot<2>> side_dashpots; /**< dashpot of each of nodes() */
    /** Dashpots of the edges of the base. */
    std::vector<Dashpot<2>> base_dashpots;

    std::vector<dealii::Tensor<1, 2>> traction; /**< xx, xy of layers [Pa] */
    std::vector<double> force; /**< force on the column per thickness [N/m] */
    /** Mean velocity of the column at t [m/s]. */
    std::vector<double> mean_velocity;
    /** Force on each of nodes(), as a pull [N]. */
    std::vector<dealii::Tensor<1, 2>> pull;
    /** Damping coefficients of each of nodes(). */
    std::vector<std::array<double, 3>> damping;
  };
} // namespace quoin

#endif
