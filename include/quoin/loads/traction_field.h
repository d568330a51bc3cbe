// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loads_traction_field_h
#define quoin_loads_traction_field_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/mesh/global_geometry.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace quoin
{
  /**
   * Nodal forces of tractions and pressures that differ from place to place,
   * f_i = integral of phi_i t over the faces. The functions phi_i are linear on
   * a face, have the sum 1, and the shares of BoundaryFace are their means, so
   * that the resultant of forces is that of the tractions, and with triangles
   * or tetrahedra of degree 1 that of moments, too.
   *
   * A face in two dimensions is divided where a moving shape has a jump or a
   * kink and at the level of water, and halved, up to ten times over, where a
   * function of place is not nearly quadratic, as at its kinks and jumps; each
   * part has a Gauss rule of three points, which is exact for a traction of
   * degree 4. In three dimensions a face has a rule of three points, exact for
   * a linear traction. It is divided into four, up to four times over, in all
   * of these cases.
   */
  template <int dim>
  class TractionField
  {
  public:
    /** @p faces are those of all ranks. */
    TractionField(const LoadParameters &parameters,
                  const NodeMap<dim> &node_map,
                  const std::vector<BoundaryFace<dim>> &faces,
                  const Thickness &thickness);

    /** The local nodes that this rank owns. */
    const std::vector<unsigned int> &nodes() const
    {
      return node_list;
    }
    /** The force on each of nodes() [N]; computed when it changes. */
    const std::vector<dealii::Tensor<1, dim>> &
    forces(const TimePoint &time) const;

    /** Length of the crack that the water of an UpliftDiagram is in [m]. */
    double crack() const
    {
      return crack_length;
    }
    void set_crack(const double length)
    {
      crack_length = length;
    }

  private:
    struct Face
    {
      std::array<dealii::Point<3>, dim> points;
      std::array<unsigned int, dim> slots; /**< indices into nodes(), or none */
      std::array<double, dim> shares;
      dealii::Tensor<1, dim> outward; /**< normal times area [m^2] */
    };
    struct QuadraturePoint
    {
      std::array<double, dim> coordinates; /**< barycentric */
      double weight;                       /**< sum 1 */
    };
    /** Where the traction has jumps and kinks: a plane. */
    struct Cut
    {
      dealii::Tensor<1, 3> normal;
      double place; /**< along the normal [m] */
    };

    /** All that the forces depend on at @p time but for the place. */
    std::vector<double> data_at(const TimePoint &time) const;
    std::vector<Cut> cuts_at(const TimePoint &time) const;
    /** @p q: the traction [Pa] at a place of @p face. */
    void find_points(
        const Face &face, const std::vector<Cut> &cuts,
        const std::function<dealii::Tensor<1, dim>(const dealii::Point<3> &)>
            &q,
        std::vector<QuadraturePoint> &points) const;
    /** Force on the block by the area [Pa] at a place of a face with this unit
        normal. */
    dealii::Tensor<1, dim> traction(const dealii::Point<3> &place,
                                    const TimePoint &time,
                                    const std::vector<double> &centres,
                                    const dealii::Tensor<1, dim> &normal) const;

    std::array<LoadComponent, 3> components;
    LoadComponent pressure;
    std::optional<SpaceTimeFunction> distribution;
    std::shared_ptr<const MovingShape> shape;
    bool is_function_of_place; /**< which may have kinks anywhere */
    double crack_length = 0.;
    std::vector<unsigned int> node_list;
    std::vector<Face> faces;
    // What forces() found last, and the data that it was found for.
    mutable std::vector<double> last_data;
    mutable std::vector<dealii::Tensor<1, dim>> last_forces;
  };

  /** At most 16 places on @p faces, spread evenly over their list; the same on
      all ranks. */
  template <int dim>
  std::vector<dealii::Point<3>>
  sample_places(const std::vector<BoundaryFace<dim>> &faces);
} // namespace quoin

#endif
