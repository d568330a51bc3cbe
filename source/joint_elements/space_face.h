// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_source_joint_elements_space_face_h
#define quoin_source_joint_elements_space_face_h

#include <quoin/joint_elements/joint_points.h>
#include <quoin/joint_elements/space_joints.h>

// Gaps and forces of single faces of SpaceJoints.

namespace quoin
{
  namespace
  {
    using Vector = dealii::Tensor<1, 3>;

    /** From the position of @p a to that of @p b. Differences of X and of u
        are taken apart, so that small displacements keep their digits. */
    inline Vector between(const NodeRecord<3> &a, const NodeRecord<3> &b)
    {
      Vector result;
      for (unsigned int d = 0; d < 3; ++d)
        result[d] = (b.X[d] - a.X[d]) + (b.u[d] - a.u[d]);
      return result;
    }

    inline Vector gap_vector(const SpaceJointFace &face,
                             const NodeRecord<3> *nodes, const unsigned int k)
    {
      return between(nodes[face.lower[k]], nodes[face.upper[k]]);
    }

    inline SpaceJointGap components(const SpaceJointFrame &frame,
                                    const Vector &gap)
    {
      return { { gap * frame.n, gap * frame.s, gap * frame.t } };
    }

    inline Vector traction_vector(const SpaceJointFrame &frame,
                                  const double normal, const Slip<3> &shear)
    {
      return normal * frame.n + shear[0] * frame.s + shear[1] * frame.t;
    }

    inline void add(const Vector &f, dealii::Tensor<1, 3> &node)
    {
      for (unsigned int d = 0; d < 3; ++d)
        node[d] += f[d];
    }

    /** Frame of a face with the edges @p e1 and @p e2. */
    template <typename Edge>
    auto frame_of(const Edge &e1, const Edge &e2)
    {
      using std::sqrt;
      using Number = std::decay_t<decltype(e1[0])>;
      FaceFrame<Edge, Number> frame;
      frame.length = sqrt(Number(e1 * e1));
      frame.s      = e1 / frame.length;
      frame.n      = cross_product_3d(e1, e2);
      frame.n /= Number(sqrt(Number(frame.n * frame.n)));
      frame.t     = cross_product_3d(frame.n, frame.s);
      frame.along = e2 * frame.s;
      frame.above = e2 * frame.t;
      return frame;
    }

    /**
     * What the rotation of the frame adds to the derivative of the energy by
     * the second and the third vertex of each side: @p couple [N m], the
     * derivative by the rotation, times that of the rotation by the nodes,
     * which is that of rotation_rate(). The first vertex has minus their sum.
     */
    template <typename Couple, typename Number>
    std::array<Couple, 2> couple_forces(const FaceFrame<Couple, Number> &frame,
                                        const Couple &couple)
    {
      const Number lift = couple * frame.s / frame.above;
      const Number turn = couple * frame.t + lift * frame.along;
      const Number spin = couple * frame.n;
      const Number half = 0.5 / frame.length;
      return { { half * (turn * frame.n - spin * frame.t),
                 Number(-0.5 * lift) * frame.n } };
    }

    /** Adds the forces of @p face whose points k have the force f(k, gap), on
        the lower side, and the couple of the frame. */
    template <typename Force>
    void add_face_forces(const SpaceJointFace &face,
                         const SpaceJointFrame &frame,
                         const NodeRecord<3> *nodes, const Force &f,
                         dealii::Tensor<1, 3> *force)
    {
      Vector couple;
      for (unsigned int k = 0; k < 3; ++k)
      {
        const Vector gap = gap_vector(face, nodes, k);
        const Vector own = f(k, gap);
        couple += cross_product_3d(own, gap);
        add(own, force[face.lower[k]]);
        add(-own, force[face.upper[k]]);
      }
      const auto [f1, f2] = couple_forces(frame, couple);
      for (const auto &side : { face.lower, face.upper })
      {
        add(-f1 - f2, force[side[0]]);
        add(f1, force[side[1]]);
        add(f2, force[side[2]]);
      }
    }
  } // namespace
} // namespace quoin

#endif
