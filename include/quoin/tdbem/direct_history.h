// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_tdbem_direct_history_h
#define quoin_tdbem_direct_history_h

#include <quoin/tdbem/boundary_history.h>
#include <quoin/elastodynamics/influence_kernel.h>

namespace quoin
{
  /**
   * The history summed as it is written: step M costs M products with lag
   * matrices, all of which are kept. The reference for faster ways.
   */
  class DirectHistory : public BoundaryHistory
  {
  public:
    /** The kernel must outlive this object. */
    explicit DirectHistory(const InfluenceKernel &kernel);

    const Eigen::VectorXd &predict() override;
    void push(const Eigen::VectorXd &u, const Eigen::VectorXd &p) override;

    unsigned long n_steps() const override
    {
      return us.size();
    }

    SavedHistory save() const override;
    void restore(const SavedHistory &saved) override;

  private:
    const InfluenceKernel &kernel;
    std::vector<Eigen::MatrixXd> G, H; /**< matrices of lag n in entry n - 1 */
    std::vector<Eigen::VectorXd> us, ps;
    Eigen::VectorXd sum;
  };
} // namespace quoin

#endif
