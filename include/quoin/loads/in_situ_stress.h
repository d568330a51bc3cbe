// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_in_situ_stress_h
#define quoin_loads_in_situ_stress_h

#include <deal.II/base/point.h>

#include <array>
#include <functional>
#include <vector>

namespace quoin
{
  class ParameterEntries;

  /**
   * In-situ stress by the weight of the ground (@cite JaegerCookZimmerman2007,
   * chapter 13): with the depth counted vertically below the surface h(x),
   * @f[ \sigma_{yy} = -\left(p + \int_y^{h(x)} \gamma \, dy\right), \quad
   *     \sigma_{xx} = K_0 \sigma_{yy} + \sigma_h, \quad \sigma_{xy} = 0 , @f]
   * tension positive, and out of the plane the same with a ratio of its own.
   * In three dimensions z is in the place of y, and y out of the plane. p may
   * depend on the horizontal place, the ratios and sigma_h on any. It balances
   * gravity below a horizontal surface, not below a slope, if p, K_0 and
   * sigma_h do not change with x. It is zero above the surface.
   */
  struct InSituStress
  {
    /** A layer of one unit weight, down to a height. */
    struct Layer
    {
      double unit_weight; /**< gamma [N/m^3] */
      double foot;        /**< y of its base [m]; not used for the last layer */
    };

    /** A value by the place [m]. */
    using Field = std::function<double(const dealii::Point<3> &)>;
    /** A field that has the same value everywhere. */
    static Field uniform(const double value)
    {
      return [value](const dealii::Point<3> &) { return value; };
    }

    std::vector<std::array<double, 2>> surface; /**< x (ascending), y [m] */
    Field surface_function; /**< height by the place instead; or null [m] */
    bool surface_names_y = false; /**< which is the height in the plane */
    bool names_z         = false; /**< whether an expression does */
    std::vector<Layer> layers;    /**< downwards */
    Field pressure           = uniform(0.); /**< p on the surface [Pa] */
    Field horizontal_ratio   = uniform(1.); /**< K_0 [-] */
    Field horizontal_stress  = uniform(0.); /**< sigma_h [Pa] */
    Field out_of_plane_ratio = uniform(1.); /**< sigma_zz by sigma_yy [-] */
    bool has_out_of_plane    = false;       /**< whether that was given */
    /** Added to sigma_zz [Pa]. */
    Field out_of_plane_stress = uniform(0.);

    /** Height of the surface at @p p; constant beyond the ends of the line
        [m]. */
    double surface_height(const dealii::Point<3> &p) const;

    /** Normal stress along x, along the axis @p vertical and along the third
        one [Pa]. */
    std::array<double, 3> normal_stress(const dealii::Point<3> &p,
                                        unsigned int vertical) const;

    /** Stress xx, yy, xy, zz [Pa] at (@p x, @p y) in the plane. */
    std::array<double, 4> stress(double x, double y) const
    {
      const auto s = normal_stress({ x, y, 0. }, 1);
      return { { s[0], s[1], 0., s[2] } };
    }

    /** Declares or reads the entries in the subsection of a load. */
    void enter(ParameterEntries &entries);
  };
} // namespace quoin

#endif
