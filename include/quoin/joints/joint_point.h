// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joints_joint_point_h
#define quoin_joints_joint_point_h

#include <quoin/joints/joint_history.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>

namespace quoin
{
  /**
   * Slip [m] or shear traction [Pa] along a joint of bodies in @p dim
   * dimensions: the dim - 1 components along its tangents. A number with a
   * sign in two dimensions, so that laws read the same in two and three: sums,
   * products with numbers and scalar products are those of either type.
   */
  template <int dim>
  using Slip = std::conditional_t<dim == 2, double, dealii::Tensor<1, dim - 1>>;

  /** Derivative of a Slip by another. */
  template <int dim>
  using SlipGradient
      = std::conditional_t<dim == 2, double, dealii::Tensor<2, dim - 1>>;

  /** Length of a slip or size of a shear traction. */
  inline double magnitude(const double slip)
  {
    return std::abs(slip);
  }
  template <int n>
  double magnitude(const dealii::Tensor<1, n> &slip)
  {
    return slip.norm();
  }

  /** Unit vector along @p slip; any if that is zero. */
  inline double direction_of(const double slip)
  {
    return slip < 0. ? -1. : 1.;
  }
  template <int n>
  dealii::Tensor<1, n> direction_of(const dealii::Tensor<1, n> &slip)
  {
    const double size = slip.norm();
    dealii::Tensor<1, n> direction;
    if (size > 0.)
      direction = slip / size;
    else
      direction[0] = 1.;
    return direction;
  }

  /**
   * Growth of the distance from the origin by a slip of unit length along
   * @p direction, in a step from the slip @p before to the slip @p after;
   * 1 where there is no slip yet. As
   * |b| - |a| = (b - a) . (a + b) / (|a| + |b|), the growths of steps of any
   * size add up to the change of distance, however the path turns.
   */
  template <typename Slip>
  double growth(const Slip &direction, const Slip &before, const Slip &after)
  {
    const double size = magnitude(before) + magnitude(after);
    return size > 0. ? direction * (before + after) / size : 1.;
  }

  /** The product a b^T. */
  inline double outer_product(const double a, const double b)
  {
    return a * b;
  }
  template <int n>
  dealii::Tensor<2, n> outer_product(const dealii::Tensor<1, n> &a,
                                     const dealii::Tensor<1, n> &b)
  {
    return dealii::outer_product(a, b);
  }

  /** @p factor times the identity. */
  template <int dim>
  SlipGradient<dim> isotropic(const double factor)
  {
    if constexpr (dim == 2)
      return factor;
    else
    {
      SlipGradient<dim> result;
      for (unsigned int d = 0; d < dim - 1; ++d)
        result[d][d] = factor;
      return result;
    }
  }

  /**
   * One joint point: what a law reads and overwrites. Laws that remember more
   * derive their own from it, which begins as its defaults say and lists what
   * it has beside these, its internal variables, in @p internal.
   */
  template <int dim>
  struct JointPoint
  {
    double normal_traction = 0.; /**< sigma [Pa], tension positive */
    Slip<dim> shear_traction{};  /**< tau [Pa] */
    Slip<dim> plastic_slip{};    /**< p [m] */
    double plastic_opening = 0.; /**< w [m] */
    JointState state       = JointState::intact;

    static constexpr std::array<double JointPoint::*, 0> internal{};
  };

  /** Derivative of a joint's tractions by opening and slip [Pa/m]. */
  template <int dim>
  struct JointTangent
  {
    double normal_opening = 0.;
    Slip<dim> normal_slip{};
    Slip<dim> shear_opening{};
    SlipGradient<dim> shear_slip{}; /**< row: of tau, column: by slip */
  };

  /** What a joint has lost in a step of an implicit solver, which takes it
      away in this order, see CoulombLaw::update_waiting(). */
  enum class JointLoss : std::uint8_t
  {
    nothing  = 0,
    peak     = 1, /**< the strength of the intact joint */
    cohesion = 2  /**< all but friction, as it has opened */
  };

  /** Energy per area that an update dissipated [J/m^2]. */
  struct JointDissipation
  {
    double friction = 0.; /**< energy dissipated in slip and dilation */
    double fracture = 0.; /**< energy dissipated in failure */
    double crushing = 0.;
  };

  /** A quantity of a joint point for results, beside tractions and gaps. */
  template <typename Point>
  struct JointField
  {
    const char *name;
    double (*value)(const Point &point);
  };

  /** A word for 'Law' in the parameter file and its description there. */
  struct LawName
  {
    const char *word, *sentence;
  };

  /** See joint_lanes.h. */
  template <typename Law, int lanes, int dim>
  class LawLanes;

  /** What a joint of a law does. */
  struct JointBehaviour
  {
    bool fails          = true;  /**< it may open or slip */
    bool dilates        = true;  /**< slip may open it */
    bool loses_strength = true;  /**< failure takes strength from it */
    bool has_bond       = false; /**< it has cohesion, which failure takes */
  };

  /** Common defaults of joint laws, which a law hides where it differs. See
      joint_law.h. */
  struct JointLawDefaults
  {
    /** Whether its tractions drop at failure. */
    static constexpr bool is_brittle = false;
    /** Whether it has update_waiting() and excess(), see CoulombLaw. */
    static constexpr bool waits = false;
    /** Whether stiffnesses grow with the pressure, from less than the bound. */
    static constexpr bool stiffens = false;
    /** Whether a joint that is open may bear tension. */
    static constexpr bool bridges = false;

    /** Reason why the law does not apply to new contacts, "which ..."; empty:
     * it does. */
    std::string no_new_contacts() const
    {
      return "";
    }
    /** Warning about the parameters, a sentence; may be empty. */
    std::string warning() const
    {
      return "";
    }
    JointBehaviour behaviour() const
    {
      return {};
    }
    /** Whether @p point, which is closed, has lost its cohesion although it
        would bear its tractions with it. */
    template <typename Point>
    bool lost_its_bond(const Point &) const
    {
      return false;
    }
    /** Whether stored_energy() of @p point depends on its opening. */
    template <typename Point>
    bool stores_by_opening(const Point &) const
    {
      return false;
    }
    /** Slip [m] that mobilises the peak strength, beside the elastic one. */
    double slip_of_peak() const
    {
      return 0.;
    }
    /** Sets the internal variables of @p point to those of a new contact: a
       joint at its residual strength. */
    template <typename Point>
    void wear_out(Point &) const
    {
    }
    /** What @p point, a closed joint that follows the law from a stage on and
        may have followed another one of the kind, remembers for it. */
    template <typename Point>
    void take_over(Point &) const
    {
    }
    /** Quantities of a point for results. */
    template <int dim>
    static std::array<JointField<JointPoint<dim>>, 0> fields()
    {
      return {};
    }
    /** Derivative of the elastic slip of @p point by its normal traction at
        constant shear traction [m/Pa]. */
    template <int dim>
    Slip<dim> slip_by_pressure(const JointPoint<dim> &) const
    {
      return {};
    }
  };
} // namespace quoin

#endif
