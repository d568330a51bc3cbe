// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_motions_prescribed_motion_h
#define quoin_motions_prescribed_motion_h

#include <quoin/loads/load_parameters.h>
#include <quoin/motions/motion_constraint.h>
#include <quoin/mesh/global_geometry.h>

namespace quoin
{
  /** Velocity or displacement of a boundary as a function of time. */
  template <int dim>
  class PrescribedMotion : public MotionConstraint<dim>
  {
  public:
    PrescribedMotion(const LoadParameters &parameters,
                     const NodeMap<dim> &node_map);

    void correct(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    void account(const StepContext &step,
                 const std::vector<CapturedNode<dim>> &captured,
                 State<dim> &state) override;
    const std::array<LoadComponent, 3> *parts() const override
    {
      return &components;
    }

  private:
    std::array<LoadComponent, 3> components;
  };

  /** Local owned nodes on the faces @p faces of the outer boundary. */
  template <int dim>
  std::vector<unsigned int>
  nodes_of_faces(const NodeMap<dim> &node_map,
                 const std::vector<BoundaryFace<dim>> &faces);
} // namespace quoin

#endif
