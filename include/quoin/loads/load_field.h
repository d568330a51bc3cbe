// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_load_field_h
#define quoin_loads_load_field_h

#include <quoin/loads/uplift_diagram.h>
#include <quoin/signals/space_time_function.h>
#include <quoin/signals/time_function.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace quoin
{
  /** Unit weight of water [N/m^3], 1000 kg/m^3 times 9.81 m/s^2. */
  constexpr double weight_of_water = 9810.;

  /**
   * A value of a load that differs from place to place: a function of place and
   * time; or the pressure of water, its unit weight times the depth below a
   * level that is a function of time, or of place, or an UpliftDiagram, and 0
   * above it.
   */
  class LoadField
  {
  public:
    explicit LoadField(const SpaceTimeFunction &function) : function(function)
    {
    }
    /** Water up to the height @p level [m]. */
    explicit LoadField(const TimeFunction &level) : water_level(level)
    {
    }
    /** Water below the line through two @p points or more, x and height [m]
        with ascending x, level beyond its ends. */
    static LoadField
    water_below(const std::vector<std::array<double, 2>> &points)
    {
      LoadField result;
      result.water_line = points;
      return result;
    }

    explicit LoadField(const std::shared_ptr<const UpliftDiagram> &diagram)
      : uplift_diagram(diagram)
    {
    }

    /** Value at @p place in the mesh [m], where the coordinate @p up is the
        height; @p crack: length of the crack below a dam [m]. */
    double operator()(const dealii::Point<3> &place, const TimePoint &time,
                      unsigned int up, double crack = 0.) const;

    /** The height of the water [m], if it is its pressure and the same
        everywhere. */
    const std::optional<TimeFunction> &level() const
    {
      return water_level;
    }
    /** The line that is the height of the water, x and height [m]; empty: there
        is none. */
    const std::vector<std::array<double, 2>> &line() const
    {
      return water_line;
    }
    /** The uplift below a dam; null: it is none. */
    const std::shared_ptr<const UpliftDiagram> &uplift() const
    {
      return uplift_diagram;
    }
    /** Whether it is the pressure of water at rest below a level. */
    bool is_water_at_rest() const
    {
      return water_level || !water_line.empty();
    }
    /** Whether it is a function of place, which may have kinks anywhere. */
    bool is_function_of_place() const
    {
      return !water_level && !uplift_diagram;
    }
    /** Whether it is a function of z. */
    bool depends_on_z() const
    {
      return function.depends_on_z();
    }
    /** Whether it is a function that may change in time. */
    bool is_function_of_time() const
    {
      return function.depends_on_time();
    }

  private:
    LoadField() = default;

    SpaceTimeFunction function;
    std::optional<TimeFunction> water_level;
    std::vector<std::array<double, 2>> water_line;
    std::shared_ptr<const UpliftDiagram> uplift_diagram;
  };

  /**
   * A function of time that changes when @p field does at one of @p places: a
   * sum of the values there, each with a weight of its own.
   */
  TimeFunction mixture(const LoadField &field,
                       const std::vector<dealii::Point<3>> &places,
                       unsigned int up);

  /**
   * Shapes that travel along a coordinate s, one at each of the centres c(t).
   * A shape is a factor of a traction, with the mean 1 over its width b: with
   * u = |s - c| / b, 1 if it is uniform, 2 (1 - 2 u) if it is triangular, and
   * 1 + cos(2 pi u) if it is a cosine, up to u = 1/2, and 0 beyond. Whatever
   * the shape, the resultant is that of the traction over the width.
   */
  struct MovingShape
  {
    enum class Kind
    {
      none,
      uniform,
      triangular,
      cosine
    };
    Kind kind         = Kind::none;
    unsigned int axis = 0;  /**< axis of s: 0 is x */
    double width      = 0.; /**< b [m] */
    std::vector<TimeFunction> centres;

    /** Places of the centres [m]. */
    std::vector<double> at(const TimePoint &time) const;
    /** The sum of the shapes at @p s [m] with @p centres there. */
    double factor(double s, const std::vector<double> &centres) const;
    /** Adds the places [m] at which factor() has a jump or a kink, and the
        quarters of a cosine, between which it is nearly a polynomial. */
    void add_kinks(const std::vector<double> &centres,
                   std::vector<double> &places) const;
  };
} // namespace quoin

#endif
