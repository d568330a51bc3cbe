// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_absorbing_free_field_column_h
#define quoin_absorbing_free_field_column_h

#include <quoin/base/thickness.h>
#include <quoin/loads/load_parameters.h>
#include <quoin/absorbing/viscous_boundary.h>
#include <quoin/materials/linear_elastic.h>
#include <quoin/mesh/global_geometry.h>
#include <quoin/operators/step_context.h>

#include <array>
#include <string>
#include <vector>

namespace quoin
{
  /** Materials of the ground beside a FreeFieldBoundary. */
  struct FreeFieldGround
  {
    std::vector<LinearElastic> materials; /**< material of each cell group */
    std::vector<bool> is_rigid;           /**< flag of each cell group */
    std::vector<bool> yields;             /**< flag of each cell group */
    PlaneAssumption plane = PlaneAssumption::plane_strain;
    Thickness thickness; /**< out-of-plane thickness of each cell group */
  };

  /** Throws an InputError about @p setting of the free field @p load. */
  [[noreturn]] void fail_free_field(const std::string &load,
                                    const std::string &setting,
                                    const std::string &why);

  /** Throws an InputError if the ground in @p group, which the free field @p
      load meets at @p place, is rigid or yields. */
  void check_free_field_ground(const std::string &load,
                               const FreeFieldGround &ground,
                               unsigned int group, const std::string &place);

  /** The load that drives the foot of the ground beside a model; its vertical
      axis is the last one. */
  template <int dim>
  struct FreeFieldFoot
  {
    std::string name; /**< name of the load */
    bool is_prescribed = false;
    std::array<LoadComponent, 3> components;

    /** Whether the motion along axis @p d is prescribed. */
    bool prescribes(const unsigned int d) const
    {
      return is_prescribed && components[d].quantity != LoadQuantity::free;
    }
    /** The prescribed velocity [m/s]. */
    double velocity(unsigned int d, const StepContext &step) const;
    /** Velocity along axis @p d of the wave that rises from below [m/s]. */
    double incident(unsigned int d, const StepContext &step) const;
  };

  /**
   * A column of ground in which P and S waves travel up and down, with a node
   * at each end of its layers. Its motion is that of packed vectors, its
   * nodes ascending. The top is free, the foot driven by a FreeFieldFoot.
   */
  template <int dim>
  class FreeFieldColumn
  {
  public:
    /** A layer between two nodes. */
    struct Layer
    {
      double height;    /**< [m] */
      double thickness; /**< in the plane, or width of the column [m] */
      double density;   /**< [kg/m^3] */
      PlaneStiffness stiffness;
    };

    explicit FreeFieldColumn(const double foot) : node_height(1, foot)
    {
      node_mass.push_back(0.);
    }

    /** Puts a layer on top, which reaches up to @p top [m]. */
    void add_layer(const Layer &layer, double top);
    /** Stands it on ground of @p impedance along the axes, unless the motion is
        prescribed there [Pa s m]. */
    void set_base(const dealii::Tensor<1, dim> &impedance);

    /** Heights of its nodes, ascending [m]. */
    const std::vector<double> &heights() const
    {
      return node_height;
    }
    unsigned int n_nodes() const
    {
      return node_height.size();
    }
    const Layer &layer(const unsigned int e) const
    {
      return layers[e];
    }
    /** The node nearest to @p height [m]. */
    unsigned int node_at(double height) const;
    /** Largest omega^2 of a layer with half of its mass at either end
        [1/s^2]. */
    double largest_eigenvalue() const;

    /**
     * Advances the displacements @p u at t and the velocities @p v at t - dt/2
     * of its nodes by a step. The functions below then give values at t.
     */
    void advance(const StepContext &step, const FreeFieldFoot<dim> &foot,
                 double *u, double *v);
    dealii::Tensor<1, dim> velocity(unsigned int node) const;
    /** Adds to @p total the force of layer @p e [N] on the vertical @p area
        with its outward normal [m^2]. */
    void add_force(unsigned int e, const dealii::Tensor<1, dim> &area,
                   dealii::Tensor<1, dim> &total) const;

  private:
    void move_foot(const StepContext &step, const FreeFieldFoot<dim> &foot,
                   double *v) const;

    std::vector<double> node_height;
    std::vector<double> node_mass; /**< mass by width of the column [kg/m] */
    std::vector<Layer> layers;
    dealii::Tensor<1, dim> base_impedance;

    /** Stress of layers: lateral, and on horizontal planes [Pa]. */
    std::vector<double> lateral;
    std::vector<dealii::Tensor<1, dim>> stress;
    std::vector<double> force;         /**< on nodes by width [N/m] */
    std::vector<double> mean_velocity; /**< at t [m/s] */
  };
} // namespace quoin

#endif
