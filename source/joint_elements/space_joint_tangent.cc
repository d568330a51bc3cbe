// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// What SpaceJoints gives to solvers that need derivatives.

#include <quoin/joint_elements/joint_tangent.h>

#include <Sacado.hpp>

#include "joint_response.h"
#include "space_face.h"

namespace quoin
{
  namespace
  {
    constexpr unsigned int n_dofs = 18;

    /** A number with its derivatives by the displacements of the nodes of a
        face, lower[0], ..., upper[2]: entry 3 i + d is node i, component d. */
    using Active = Sacado::Fad::SFad<double, n_dofs>;

    /** A number that does not depend on them. */
    Active constant(const double value)
    {
      return Active(n_dofs, value);
    }

    /** A vector of them, which dealii::Tensor does not take. */
    struct ActiveVector
    {
      std::array<Active, 3> components{ { constant(0.), constant(0.),
                                          constant(0.) } };

      Active &operator[](const unsigned int d)
      {
        return components[d];
      }
      const Active &operator[](const unsigned int d) const
      {
        return components[d];
      }
      ActiveVector &operator+=(const ActiveVector &other)
      {
        for (unsigned int d = 0; d < 3; ++d)
          components[d] += other[d];
        return *this;
      }
      ActiveVector &operator/=(const Active &number)
      {
        for (Active &component : components)
          component /= number;
        return *this;
      }
    };

    ActiveVector operator*(const Active &number, ActiveVector a)
    {
      for (Active &component : a.components)
        component *= number;
      return a;
    }
    ActiveVector operator-(const ActiveVector &a)
    {
      return constant(-1.) * a;
    }
    ActiveVector operator+(ActiveVector a, const ActiveVector &b)
    {
      return a += b;
    }
    ActiveVector operator-(const ActiveVector &a, const ActiveVector &b)
    {
      return a + -b;
    }
    ActiveVector operator/(ActiveVector a, const Active &number)
    {
      return a /= number;
    }
    Active operator*(const ActiveVector &a, const ActiveVector &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }
    ActiveVector cross_product_3d(const ActiveVector &a, const ActiveVector &b)
    {
      return { { { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                   a[0] * b[1] - a[1] * b[0] } } };
    }

    /** Frame, gaps and forces of a face with their derivatives. */
    class ActiveFace
    {
    public:
      ActiveFace(const SpaceJointFace &face, const NodeRecord<3> *nodes)
      {
        const auto edge = [&](const unsigned int k)
        {
          ActiveVector result = active(
              0.5
              * (between(nodes[face.lower[0]], nodes[face.lower[k]])
                 + between(nodes[face.upper[0]], nodes[face.upper[k]])));
          for (unsigned int d = 0; d < 3; ++d)
            for (const unsigned int side : { 0, 3 })
            {
              result[d].fastAccessDx(3 * (side + k) + d) += 0.5;
              result[d].fastAccessDx(3 * side + d) -= 0.5;
            }
          return result;
        };
        frame = frame_of(edge(1), edge(2));
        for (unsigned int k = 0; k < 3; ++k)
        {
          gaps[k] = active(gap_vector(face, nodes, k));
          for (unsigned int d = 0; d < 3; ++d)
          {
            gaps[k][d].fastAccessDx(9 + 3 * k + d) += 1.;
            gaps[k][d].fastAccessDx(3 * k + d) -= 1.;
          }
        }
      }

      /** Opening and slips of point @p k [m]. */
      std::array<Active, 3> local_gap(const unsigned int k) const
      {
        return { { gaps[k] * frame.n, gaps[k] * frame.s, gaps[k] * frame.t } };
      }

      /** Forces on the nodes by the @p tractions of the points in the frame,
          times @p area, which do not change: add_face_forces(). */
      std::array<Active, n_dofs>
      forces(const std::array<std::array<double, 3>, 3> &tractions,
             const double area) const
      {
        std::array<Active, n_dofs> result;
        result.fill(constant(0.));
        const auto add = [&](const unsigned int node, const ActiveVector &f)
        {
          for (unsigned int d = 0; d < 3; ++d)
            result[3 * node + d] += f[d];
        };
        ActiveVector couple;
        for (unsigned int k = 0; k < 3; ++k)
        {
          const ActiveVector own = constant(area * tractions[k][0]) * frame.n
                                   + constant(area * tractions[k][1]) * frame.s
                                   + constant(area * tractions[k][2]) * frame.t;
          couple += cross_product_3d(own, gaps[k]);
          add(k, own);
          add(3 + k, -own);
        }
        const auto [f1, f2] = couple_forces(frame, couple);
        for (const unsigned int side : { 0, 3 })
        {
          add(side, -f1 - f2);
          add(side + 1, f1);
          add(side + 2, f2);
        }
        return result;
      }

    private:
      static ActiveVector active(const Vector &vector)
      {
        ActiveVector result;
        for (unsigned int d = 0; d < 3; ++d)
          result[d] = constant(vector[d]);
        return result;
      }

      FaceFrame<ActiveVector, Active> frame;
      std::array<ActiveVector, 3> gaps;
    };

    /** Row of the derivative of the tractions by opening and slip [Pa/m]. */
    std::array<std::array<double, 3>, 3>
    matrix_of(const JointTangent<3> &tangent)
    {
      std::array<std::array<double, 3>, 3> D;
      D[0][0] = tangent.normal_opening;
      for (unsigned int a = 0; a < 2; ++a)
      {
        D[0][1 + a] = tangent.normal_slip[a];
        D[1 + a][0] = tangent.shear_opening[a];
        for (unsigned int b = 0; b < 2; ++b)
          D[1 + a][1 + b] = tangent.shear_slip[a][b];
      }
      return D;
    }

    /** An element of ForceOperator::linearise(). */
    struct FaceLinearisation
    {
      std::array<double, n_dofs> force{};              /**< [N] */
      std::array<double, n_dofs * n_dofs> stiffness{}; /**< [N/m] */
      double inelastic = 0.;                           /**< [m^3] */
      std::array<double, n_dofs> inelastic_gradient{}; /**< [m^2] */

      /** Sets the forces, and adds their derivative at constant tractions. */
      void add_forces(const std::array<Active, n_dofs> &forces)
      {
        for (unsigned int i = 0; i < n_dofs; ++i)
        {
          force[i] = forces[i].val();
          for (unsigned int j = 0; j < n_dofs; ++j)
            stiffness[n_dofs * i + j] -= forces[i].fastAccessDx(j);
        }
      }

      /** Adds what the tractions of a point change by with its gap. */
      void add_point(const JointResponse<3> &point,
                     const std::array<Active, 3> &gap, const double area)
      {
        const auto D = matrix_of(point.tangent);
        for (unsigned int j = 0; j < n_dofs; ++j)
        {
          std::array<double, 3> change{}; // of the tractions [Pa/m]
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int c = 0; c < 3; ++c)
              change[r] += D[r][c] * gap[c].fastAccessDx(j);
          for (unsigned int i = 0; i < n_dofs; ++i)
            for (unsigned int r = 0; r < 3; ++r)
              stiffness[n_dofs * i + j]
                  += area * gap[r].fastAccessDx(i) * change[r];
          double growth
              = point.opens
                * (gap[0].fastAccessDx(j) - change[0] / point.stiffness[0]);
          for (unsigned int a = 0; a < 2; ++a)
            growth += point.slips[a]
                      * (gap[1 + a].fastAccessDx(j)
                         - change[1 + a] / point.stiffness[1]
                         - point.slip_by_pressure[a] * change[0]);
          inelastic_gradient[j] += area * growth;
        }
      }
    };

    /** The forces alone, without derivatives: those of add_face_forces() with
        the force f(k, frame, gap) of point k on the lower side. */
    template <typename Force>
    std::array<double, n_dofs> face_forces(const SpaceJointFace &face,
                                           const NodeRecord<3> *nodes,
                                           const Force &f)
    {
      SpaceJointFace own = face; // with nodes of its own
      std::array<NodeRecord<3>, 6> records;
      for (unsigned int k = 0; k < 3; ++k)
      {
        records[k]     = nodes[face.lower[k]];
        records[3 + k] = nodes[face.upper[k]];
        own.lower[k]   = k;
        own.upper[k]   = 3 + k;
      }
      const SpaceJointFrame frame = joint_frame(own, records.data());
      std::array<Vector, 6> forces;
      add_face_forces(
          own, frame, records.data(),
          [&](const unsigned int k, const Vector &gap)
          { return f(k, frame, gap); },
          forces.data());
      std::array<double, n_dofs> result;
      for (unsigned int i = 0; i < n_dofs; ++i)
        result[i] = forces[i / 3][i % 3];
      return result;
    }
  } // namespace

  void SpaceJoints::linearise(State<3> &state, const bool with_stiffness,
                              const TakeElement<3> &take) const
  {
    const auto *breaking       = state.find<BreakingJoints<3>>();
    SpaceJointHistory &history = state.get<SpaceJointHistory>();
    for (unsigned int i = 0; i < all_faces.size(); ++i)
    {
      const SpaceJointFace &face = all_faces[i];
      std::array<unsigned int, 6> nodes;
      std::copy(face.lower.begin(), face.lower.end(), nodes.begin());
      std::copy(face.upper.begin(), face.upper.end(), nodes.begin() + 3);
      FaceLinearisation element;
      // Updates point k and returns its derivatives.
      const auto update = [&](const unsigned int k, const SpaceJointGap &gap)
      {
        const unsigned int p = 3 * i + k;
        Slip<3> slip;
        slip[0] = gap[1];
        slip[1] = gap[2];
        JointResponse<3> point;
        std::visit(
            [&](const auto &law)
            {
              point = respond<3>(
                  law, gap[0], slip_since_placing(history, p, slip),
                  breaking ? static_cast<JointLoss>(breaking->points[p])
                           : JointLoss::nothing,
                  face.area * face.share, history, p, state.energy);
            },
            all_laws[face.set]);
        element.inelastic += face.area * point.growth();
        return point;
      };
      const bool acts = !history.detached[i];
      if (acts && with_stiffness)
      {
        const ActiveFace active(face, state.nodes.data());
        std::array<std::array<double, 3>, 3> tractions;
        for (unsigned int k = 0; k < 3; ++k)
        {
          const auto gap = active.local_gap(k);
          element.add_point(
              update(k, { { gap[0].val(), gap[1].val(), gap[2].val() } }), gap,
              face.area);
          const unsigned int p = 3 * i + k;
          tractions[k]
              = { { history.normal_traction[p], history.shear_traction[2 * p],
                    history.shear_traction[2 * p + 1] } };
        }
        element.add_forces(active.forces(tractions, face.area));
      }
      else if (acts)
        element.force = face_forces(
            face, state.nodes.data(),
            [&](const unsigned int k, const SpaceJointFrame &frame,
                const Vector &gap)
            {
              update(k, components(frame, gap));
              const unsigned int p = 3 * i + k;
              Slip<3> shear;
              shear[0] = history.shear_traction[2 * p];
              shear[1] = history.shear_traction[2 * p + 1];
              return face.area
                     * traction_vector(frame, history.normal_traction[p],
                                       shear);
            });
      take({ nodes.data(), 6, element.force.data(), element.stiffness.data(),
             n_dofs, face.share, element.inelastic,
             element.inelastic_gradient.data(), face.set, 3. * face.area });
    }
  }

  double excess(const SpaceJoints &joints, const unsigned int p,
                const SpaceJointHistory &history)
  {
    double excess = 0.;
    if (!history.detached[p / 3])
      std::visit(
          [&](const auto &law)
          {
            if constexpr (std::decay_t<decltype(law)>::waits)
              excess = law.excess(read_point(law, history, p));
          },
          joints.laws()[joints.faces()[p / 3].set]);
    return excess;
  }
} // namespace quoin
