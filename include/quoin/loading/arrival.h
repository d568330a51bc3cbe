// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_loading_arrival_h
#define quoin_loading_arrival_h

#include <quoin/base/node_record.h>
#include <quoin/loads/nodal_load.h>
#include <quoin/operators/force_operator.h>

#include <vector>

namespace quoin
{
  /**
   * What lets the loads on blocks that a stage places grow from zero by half a
   * cosine s(t) of load time, as gravity that begins there does: beside these
   * loads act the forces (s - 1) F(t), F being those of the loads that go on
   * from the stage before. A stage that ends before they are there leaves the
   * rest of the growth to the next one.
   */
  template <int dim>
  class Arrival : public ForceOperator<dim>
  {
  public:
    Arrival() = default;

    /** Lets @p loads, to which it keeps pointers, grow on the owned nodes
        @p placed as @p growth says; @p n_local: number of local nodes. */
    void add(const std::vector<unsigned int> &placed,
             const std::vector<const NodalLoad<dim> *> &loads,
             std::size_t n_local, const Growth &growth);

    /** How long the growth takes from the start of the stage on [s]; 0: nothing
        grows. */
    double rest() const;
    /** Whether the forces are others at two load times of the stage [s]. */
    bool differ(double one, double other) const;

    const char *kind() const override
    {
      return "loads";
    }
    void add_loads(const TimePoint &time,
                   dealii::Tensor<1, dim> *force) const override;
    double
    external_power(const TimePoint &time,
                   const dealii::Tensor<1, dim> *velocity) const override;

  private:
    /** Forces of one growth. */
    struct Part
    {
      std::vector<unsigned int> nodes; /**< of this rank */
      std::vector<const NodalLoad<dim> *> loads;
      std::size_t n_local;
      Growth growth;
      /** F of each node [N], with these amplitudes of the loads. */
      mutable std::vector<dealii::Tensor<1, dim>> forces;
      mutable std::vector<std::array<double, 5>> amplitudes;

      /** Brings them to @p time. */
      void find_forces(const TimePoint &time) const;
    };
    std::vector<Part> parts;
  };
} // namespace quoin

#endif
