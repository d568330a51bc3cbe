// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_absorbing_free_field_boundary_h
#define quoin_absorbing_free_field_boundary_h

#include <quoin/absorbing/free_field_grid.h>
#include <quoin/motions/motion_constraint.h>

#include <array>
#include <string>
#include <type_traits>
#include <vector>

namespace quoin
{
  /** The load that drives the foot of the ground beside a model. */
  struct FreeFieldBase
  {
    LoadParameters load; /**< viscous boundary or prescribed motion */
    std::vector<Impedance> impedance; /**< impedance beyond each cell group */
  };

  /** The ground beside the blocks; see FreeFieldBoundary. */
  template <int dim>
  struct FreeFieldState
  {
    bool active = false;              /**< whether it has begun */
    std::vector<double> displacement; /**< of its nodes [m] */
    std::vector<double> velocity;     /**< at time - dt/2 [m/s] */
    std::vector<double> held;         /**< forces on nodes of blocks [N] */

    template <typename Visitor>
    void visit(Visitor &visitor)
    {
      visitor.same(active, displacement, velocity);
      visitor.own(held, dim);
    }
  };

  /**
   * A free-field boundary at a vertical side of a model whose surroundings do
   * not change along the normal of the side (@cite ZienkiewiczBicanicShen1989):
   * beside it stands the ground along the side, in two dimensions a
   * FreeFieldColumn with a node at the height of each node of the side, in
   * three a FreeFieldGrid beside each plane side. Its top is free, its foot is
   * driven as the base of the model. The traction on the side, whose outward
   * normal n is horizontal, is
   * @f[ t = \sigma_f n + \rho c_1 n n^T (v_f - v)
   *         + \rho c_2 (I - n n^T) (v_f - v), @f]
   * f the ground beside: the free-field motion is not reflected, and waves from
   * the model leave through dashpots. The model does not act on the ground
   * beside. Joints that meet the side are closed there.
   *
   * When it first acts the ground beside is at rest and without stress; the
   * unbalanced forces on the side are held from then on, so that stresses of an
   * earlier stage need no other load. Each rank computes all of it. The
   * dashpots are those of ViscousBoundary, also where the side meets a viscous
   * base, whose share at that node is included.
   */
  template <int dim>
  class FreeFieldBoundary : public MotionConstraint<dim>
  {
  public:
    using Ground
        = std::conditional_t<dim == 2, FreeFieldColumn<2>, FreeFieldGrid>;

    /** A plane side and what is beside it. */
    struct Side
    {
      /** Force of face or layer @p part on a node of the side. */
      struct Share
      {
        unsigned int node; /**< index into nodes() */
        unsigned int part;
        dealii::Tensor<1, dim> area; /**< outward [m^2] */
      };

      explicit Side(Ground made) : ground(std::move(made))
      {
      }

      Ground ground;
      std::vector<unsigned int> nodes;    /**< indices into nodes() */
      std::vector<unsigned int> beside;   /**< node of the ground for each */
      std::vector<Dashpot<dim>> dashpots; /**< of each */
      std::vector<Share> shares;
    };

    /**
     * Throws an InputError about a side that is not vertical or not in one
     * piece, or a base that cannot drive the ground beside it.
     */
    FreeFieldBoundary(const LoadParameters &parameters,
                      const NodeMap<dim> &node_map,
                      const FreeFieldGround &ground, const FreeFieldBase &base);

    void prepare(State<dim> &state) const override;
    void begin_stage(State<dim> &state, bool continues) override;
    void correct(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;

    const std::vector<Side> &sides() const
    {
      return side_list;
    }

  private:
    /** Makes the sides of @p faces on a base with @p base_faces. */
    void make_sides(const NodeMap<dim> &node_map,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const std::vector<BoundaryFace<dim>> &base_faces,
                    const FreeFieldGround &ground, const FreeFieldBase &given);
    /** Ties the nodes of @p faces to @p side. */
    void tie(const NodeMap<dim> &node_map,
             const std::vector<BoundaryFace<dim>> &faces,
             const FreeFieldGround &ground, Side side);
    void start(const std::vector<CapturedNode<dim>> &captured,
               FreeFieldState<dim> &beside);

    FreeFieldFoot<dim> foot;
    std::vector<Side> side_list;
    /** Dashpots of the faces of the base, of each of nodes(). */
    std::vector<Dashpot<dim>> base_dashpots;

    /** Force on each of nodes(), as a pull [N]. */
    std::vector<dealii::Tensor<1, dim>> pull;
    /** Damping coefficients of each of nodes(). */
    std::vector<typename Dashpot<dim>::Damping> damping;
  };

  template <>
  void FreeFieldBoundary<2>::make_sides(
      const NodeMap<2> &node_map, const std::vector<BoundaryFace<2>> &faces,
      const std::vector<BoundaryFace<2>> &base_faces,
      const FreeFieldGround &ground, const FreeFieldBase &given);
  template <>
  void FreeFieldBoundary<3>::make_sides(
      const NodeMap<3> &node_map, const std::vector<BoundaryFace<3>> &faces,
      const std::vector<BoundaryFace<3>> &base_faces,
      const FreeFieldGround &ground, const FreeFieldBase &given);
} // namespace quoin

#endif
