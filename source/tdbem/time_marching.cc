// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/tdbem/time_marching.h>

#include <quoin/base/exceptions.h>

namespace quoin
{
  TimeMarching::TimeMarching(const InfluenceKernel &kernel,
                             BoundaryHistory &history,
                             const std::vector<bool> &traction_is_given)
    : history(history), traction_is_given(traction_is_given),
      displacement(Eigen::VectorXd::Zero(kernel.size())),
      traction(Eigen::VectorXd::Zero(kernel.size()))
  {
    kernel.lag(0, G0, H0);
    traction_scale         = H0.norm() / G0.norm();
    Eigen::MatrixXd matrix = H0;
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      if (!traction_is_given[k])
        matrix.col(k) = -traction_scale * G0.col(k);
    solver.compute(matrix);
    if (!(solver.rcond() > 1e-14))
      throw InputError("section 'Boundary elements': the equations are "
                       "singular. Look for elements that coincide.");
  }

  void TimeMarching::predict()
  {
    if (!has_past)
      past = history.predict();
    has_past = true;
  }

  Eigen::VectorXd TimeMarching::solve(const Eigen::VectorXd &given)
  {
    predict();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(given.size());
    Eigen::VectorXd p = u;
    for (Eigen::Index k = 0; k < given.size(); ++k)
      (traction_is_given[k] ? p : u)[k] = given[k];
    return solver.solve(past + G0 * p - H0 * u);
  }

  void TimeMarching::step(const Eigen::VectorXd &given)
  {
    begin_step(given);
    finish_step();
  }

  void TimeMarching::begin_step(const Eigen::VectorXd &given)
  {
    const Eigen::VectorXd solution = solve(given);
    for (Eigen::Index k = 0; k < given.size(); ++k)
    {
      const bool is_traction = traction_is_given[k];
      displacement[k]        = is_traction ? solution[k] : given[k];
      traction[k] = is_traction ? given[k] : traction_scale * solution[k];
    }
  }

  void TimeMarching::finish_step(const std::vector<unsigned> &replaced,
                                 const Eigen::VectorXd &values)
  {
    traction(replaced) = values;
    history.push(displacement, traction);
    has_past = false;
  }

  Eigen::MatrixXd
  TimeMarching::condensed_matrix(const std::vector<unsigned> &interface) const
  {
    const Eigen::MatrixXd columns = H0(Eigen::all, interface);
    return -traction_scale * solver.solve(columns)(interface, Eigen::all);
  }

  Eigen::VectorXd
  TimeMarching::condensed_load(const std::vector<unsigned> &interface,
                               const Eigen::VectorXd &given)
  {
    Eigen::VectorXd rest = given;
    rest(interface) = Eigen::VectorXd::Zero(Eigen::Index(interface.size()));
    const Eigen::VectorXd solution = solve(rest);
    return traction_scale * solution(interface);
  }

  void TimeMarching::restore(const Eigen::VectorXd &u, const Eigen::VectorXd &p)
  {
    displacement = u;
    traction     = p;
    has_past     = false;
  }
} // namespace quoin
