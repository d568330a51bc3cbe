// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

// Long runs of the boundary elements alone. A hole in the plane is hit by a
// short pulse of traction, or of motion, on two of its 32 elements, so that
// all modes are excited; then nothing acts any more, and everything has to
// radiate away. Writes a table to standard output that says, for each way to
// discretise, how large the response still is. With --short only some runs of
// fewer steps. Fails if a response grows where the discretisation is said to
// be stable.

#include <quoin/tdbem/time_marching.h>
#include <quoin/tdbem/formulation.h>

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace quoin;

namespace
{
  struct Case
  {
    bool circle;
    double poisson;
    double beta; /**< c_1 dt / element length */
    bool motion_given;
  };

  /** c_2 dt / element length */
  double shear_ratio(const Case &run)
  {
    return run.beta * std::sqrt((0.5 - run.poisson) / (1. - run.poisson));
  }

  Boundary boundary(const Case &run)
  {
    return run.circle ? Boundary::circle({ 0., 0. }, 1., 32, true)
                      : Boundary::polygon(
                          { { 0., 0. }, { 1., 0. }, { 1., 1. }, { 0., 1. } },
                          0.125, true);
  }

  std::string name(const Formulation formulation)
  {
    switch (formulation)
    {
    case Formulation::galerkin:
      return "Galerkin";
    case Formulation::collocation:
      return "collocation";
    case Formulation::convolution_quadrature:
      break;
    }
    return "convolution quadrature";
  }

  /** What doc and interface promise. */
  bool said_to_be_stable(const Formulation formulation, const Case &run)
  {
    switch (formulation)
    {
    case Formulation::galerkin:
      return run.motion_given || shear_ratio(run) >= 0.55;
    case Formulation::collocation:
      return false;
    case Formulation::convolution_quadrature:
      break;
    }
    return true;
  }

  struct Result
  {
    /** Greatest norms of some steps each, relative to that during the pulse. */
    std::vector<double> ratios;
    unsigned long growth_step = 0; /**< beyond a thousand times; 0: never */

    /** Down to a noise that matters to nobody. */
    bool grows() const
    {
      return growth_step > 0
             || ratios.back() > std::max(1e-9, 1.5 * ratios[ratios.size() - 2]);
    }
  };

  /** The ratios are those up to the steps @p marks. */
  Result march(const Formulation formulation, const Case &run,
               const std::vector<unsigned long> &marks, const bool direct)
  {
    const ElasticMedium medium = ElasticMedium::from_young(1., 1., run.poisson);
    const Boundary domain      = boundary(run);
    FormulationOptions options;
    options.formulation    = formulation;
    options.time_step      = run.beta * domain.elements[0].length() / medium.c1;
    options.direct_history = direct;
    options.n_steps        = marks.back();
    const auto kernel      = make_lag_kernel(domain, medium, options);
    const auto history = make_history(*kernel, domain, options, MPI_COMM_SELF);
    TimeMarching solution(
        *kernel, *history,
        std::vector<bool>(domain.n_unknowns(), !run.motion_given));

    Eigen::VectorXd shape = Eigen::VectorXd::Zero(kernel->size());
    shape.segment<4>(2) << 1., 0.3, -0.5, 0.8;
    constexpr unsigned pulse  = 16; // steps
    constexpr unsigned window = 100;

    Result result;
    double peak = 0., greatest = 0.;
    for (unsigned long step = 1; step <= marks.back(); ++step)
    {
      const double s
          = step < pulse ? std::sin(M_PI * double(step) / pulse) : 0.;
      solution.step(s * s * shape);
      const double norm
          = (run.motion_given ? solution.p() : solution.u()).norm();
      if (step <= pulse)
        peak = std::max(peak, norm);
      else if (!(norm < 1e3 * peak))
      {
        result.growth_step = step;
        break;
      }
      const unsigned long mark = marks[result.ratios.size()];
      if (step + window > mark)
        greatest = std::max(greatest, norm);
      if (step == mark)
      {
        result.ratios.push_back(greatest / peak);
        greatest = 0.;
      }
    }
    return result;
  }

  std::string text(const Result &result)
  {
    std::ostringstream text;
    text.precision(1);
    text << std::scientific;
    if (result.growth_step > 0)
      text << "**unbounded** at " << result.growth_step;
    else
    {
      for (const double &ratio : result.ratios)
        text << (&ratio == &result.ratios[0] ? "" : ", ") << ratio;
      if (result.grows())
        text << " **grows**";
    }
    return text.str();
  }
} // namespace

int
main(int argc, char *argv[])
{
  MPI_Init(&argc, &argv);
  bool short_version = false, direct = false;
  unsigned long n_steps = 100000;
  std::vector<Formulation> formulations
      = { Formulation::galerkin, Formulation::collocation,
          Formulation::convolution_quadrature };
  for (int k = 1; k < argc; ++k)
  {
    const std::string word = argv[k];
    if (word == "--short")
      short_version = true;
    else if (word == "--direct")
      direct = true;
    else if (word == "--steps" && k + 1 < argc)
      n_steps = std::strtoul(argv[++k], nullptr, 10);
    else
    {
      std::cerr << "usage: " << argv[0]
                << " [--short] [--direct] [--steps number]\n";
      return 2;
    }
  }

  std::vector<Case> runs;
  if (short_version)
  {
    n_steps = std::min(n_steps, 20000ul);
    formulations
        = { Formulation::galerkin, Formulation::convolution_quadrature };
    runs = { { true, 0.25, 0.6, true }, { false, 0.4, 1., false } };
  }
  else
    for (const bool circle : { true, false })
      for (const bool motion_given : { true, false })
        for (const double poisson : { 0., 0.25, 0.4 })
          for (const double beta : { 0.3, 0.6, 1., 1.5 })
            runs.push_back({ circle, poisson, beta, motion_given });
  std::vector<unsigned long> marks;
  for (unsigned long mark = n_steps; mark >= 500 && marks.size() < 3;
       mark /= 10)
    marks.insert(marks.begin(), mark);
  if (marks.size() < 2)
  {
    std::cerr << "There must be at least 5000 steps.\n";
    return 2;
  }

  std::cout << "Greatest norm in the 100 steps up to step ";
  for (const unsigned long mark : marks)
    std::cout << mark << (mark == marks.back() ? "" : ", ");
  std::cout << ", relative to that during the pulse.\n\n"
               "| given | hole | nu | c1 dt/L | c2 dt/L |";
  for (const Formulation formulation : formulations)
    std::cout << ' ' << name(formulation) << " |";
  std::cout << "\n|---|---|---|---|---|";
  for (std::size_t k = 0; k < formulations.size(); ++k)
    std::cout << "---|";
  std::cout << '\n';

  bool failed = false;
  for (const Case &run : runs)
  {
    std::cout << "| " << (run.motion_given ? "motion" : "traction") << " | "
              << (run.circle ? "circle" : "square") << " | " << run.poisson
              << " | " << run.beta << " | " << shear_ratio(run) << " |";
    for (const Formulation formulation : formulations)
    {
      const auto begin    = std::chrono::steady_clock::now();
      const Result result = march(formulation, run, marks, direct);
      std::cout << ' ' << text(result) << " |" << std::flush;
      if (result.grows() && said_to_be_stable(formulation, run))
        failed = true;
      const std::chrono::duration<double> seconds
          = std::chrono::steady_clock::now() - begin;
      std::cerr << name(formulation) << ": " << seconds.count() << " s\n";
    }
    std::cout << std::endl;
  }
  if (failed)
    std::cout << "\nFAILED: a response grows where it should not.\n";
  MPI_Finalize();
  return failed;
}
