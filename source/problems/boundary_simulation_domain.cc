// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/problems/boundary_simulation.h>
#include <quoin/base/exceptions.h>
#include <quoin/results/collective.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using Eigen::Vector2d;
    using Eigen::VectorXd;

    /** Points of the sampled field that are computed at a time. */
    constexpr std::size_t batch_size = 256;

    std::vector<std::array<double, 2>> pairs(const VectorXd &values)
    {
      std::vector<std::array<double, 2>> result(values.size() / 2);
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] = { { values[2 * k], values[2 * k + 1] } };
      return result;
    }
  } // namespace

  void BoundarySimulation::make_sampled_points()
  {
    const SampledFieldParameters &field = settings.sampled_field;
    if (!field.has_box)
      return;
    const Boundary &boundary = geometry.boundary;
    const unsigned int nx
        = 1 + std::floor((field.box[2] - field.box[0]) / field.spacing + 1e-9);
    const unsigned int ny
        = 1 + std::floor((field.box[3] - field.box[1]) / field.spacing + 1e-9);
    constexpr std::int32_t none = -1;
    std::vector<std::int32_t> point(nx * ny, none);
    std::vector<double> distance; // of each point to the boundary
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
      {
        const Vector2d x(field.box[0] + i * field.spacing,
                         field.box[1] + j * field.spacing);
        const NearestElement nearest = nearest_element(boundary, x);
        if (!nearest.inside_domain
            || nearest.distance
                   < 0.25 * boundary.elements[nearest.element].length())
          continue;
        point[j * nx + i] = sampled_points.size();
        sampled_points.push_back(x);
        distance.push_back(nearest.distance);
        sampled.position.push_back({ { x.x(), x.y() } });
      }
    // Triangles, unless they lie across the boundary.
    const auto add = [&](const std::array<std::int32_t, 3> &triangle)
    {
      bool near = false;
      for (const std::int32_t p : triangle)
      {
        if (p == none)
          return;
        near = near || distance[p] < 2. * field.spacing;
      }
      for (unsigned int k = 0; near && k < 3; ++k)
        for (const BoundaryElement &element : boundary.elements)
          if (segments_meet(sampled_points[triangle[k]],
                            sampled_points[triangle[(k + 1) % 3]], element.a,
                            element.b))
            return;
      sampled.triangles.push_back(triangle);
    };
    for (unsigned int j = 0; j + 1 < ny; ++j)
      for (unsigned int i = 0; i + 1 < nx; ++i)
      {
        const std::int32_t a = point[j * nx + i], b = point[j * nx + i + 1],
                           c = point[(j + 1) * nx + i + 1],
                           d = point[(j + 1) * nx + i];
        // The diagonal that leaves a triangle if one corner is missing.
        if (b == none || d == none)
          add({ { a, b == none ? c : b, d == none ? c : d } });
        else
        {
          add({ { a, b, d } });
          add({ { b, c, d } });
        }
      }
    if (sampled_points.empty())
      throw InputError("section 'Sampled field': no point of 'Box' is in the "
                       "domain, a quarter of an element from the boundary or "
                       "farther. Move it, or give a smaller 'Spacing'.");
  }

  std::vector<Vector2d> BoundarySimulation::points_in_domain() const
  {
    std::vector<Vector2d> points = histories->interior_points();
    points.insert(points.end(), sampled_points.begin(), sampled_points.end());
    return points;
  }

  // -- the domain, after the time loop --------------------------------------

  void BoundarySimulation::write_domain()
  {
    const Eigen::Index size = Eigen::Index(geometry.boundary.n_unknowns());
    BoundaryRecord all{ dt, settings.decay, {}, {} };
    all.displacement = Eigen::MatrixXd::Map(record.all_u.data(),
                                            Eigen::Index(n_steps), size);
    all.traction     = Eigen::MatrixXd::Map(record.all_p.data(),
                                            Eigen::Index(n_steps), size);
    // The next checkpoint is that of a finished run.
    record.all_u   = {};
    record.all_p   = {};
    record.history = {};
    if (!histories->interior_points().empty())
      write_histories(all);
    if (!sampled_points.empty())
      write_sampled_fields(all);
  }

  Eigen::MatrixXd BoundarySimulation::domain_displacements(
      const BoundaryRecord &all, const std::vector<Vector2d> &points,
      const std::vector<unsigned int> &steps) const
  {
    Eigen::MatrixXd u = interior_displacements(geometry.boundary, medium, all,
                                               points, steps, communicator);
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t l = 0; l < steps.size(); ++l)
        u.block<2, 1>(2 * k, l)
            += waves->displacement(points[k], steps[l] * dt);
    return u;
  }

  void BoundarySimulation::write_histories(const BoundaryRecord &all)
  {
    // A step and, for the velocity, the one before it.
    std::vector<unsigned int> steps;
    std::vector<std::array<std::size_t, 2>> columns;
    for (std::uint64_t step = 0; step <= n_steps; ++step)
      if (row_is_due(step))
      {
        std::array<std::size_t, 2> column{};
        for (const unsigned int k : { 1U, 0U })
        {
          const unsigned int wanted = static_cast<unsigned int>(
              step - std::min<std::uint64_t>(k, step));
          if (steps.empty() || steps.back() != wanted)
            steps.push_back(wanted);
          column[k] = steps.size() - 1;
        }
        columns.push_back(column);
      }
    const Eigen::MatrixXd u
        = domain_displacements(all, histories->interior_points(), steps);
    const std::size_t n_columns = histories->column_names().size();
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            record.history_table.start();
                            for (std::size_t r = 0; r < columns.size(); ++r)
                            {
                              const auto begin
                                  = record.rows.begin() + r * n_columns;
                              std::vector<double> row(begin, begin + n_columns);
                              const VectorXd now = u.col(columns[r][0]);
                              histories->set_interior(
                                  row, now, (now - u.col(columns[r][1])) / dt);
                              record.history_table.add_row(row);
                            }
                            record.history_table.flush();
                          });
    record.rows = {};
  }

  void BoundarySimulation::write_sampled_fields(const BoundaryRecord &all)
  {
    std::vector<double> times;
    std::vector<unsigned int> steps; // the one before, and the step
    for (std::uint64_t step = 0; step <= n_steps; ++step)
      if (fields_are_due(step))
      {
        times.push_back(step * dt);
        steps.push_back(static_cast<unsigned int>(step == 0 ? 0 : step - 1));
        steps.push_back(static_cast<unsigned int>(step));
      }
    ProgressFigures figures = progress_figures();
    figures.stage           = "field in the domain";
    figures.fraction        = 0.;
    progress.start(figures);
    Eigen::MatrixXd u(2 * sampled_points.size(), steps.size());
    for (std::size_t begin = 0; begin < sampled_points.size();
         begin += batch_size)
    {
      const std::size_t end
          = std::min(begin + batch_size, sampled_points.size());
      u.middleRows(2 * begin, 2 * (end - begin)) = domain_displacements(
          all, { sampled_points.begin() + begin, sampled_points.begin() + end },
          steps);
      figures.fraction = double(end) / double(sampled_points.size());
      if (progress.due())
        progress.update(figures);
    }
    progress.finish(figures);
    for (std::size_t frame = 0; frame < times.size(); ++frame)
      write_sampled_field(times[frame], u.col(2 * frame + 1),
                          (u.col(2 * frame + 1) - u.col(2 * frame)) / dt);
  }

  void BoundarySimulation::write_sampled_field(const double time,
                                               const VectorXd &displacement,
                                               const VectorXd &velocity)
  {
    all_or_none<RunError>(communicator,
                          [&]()
                          {
                            if (!is_first_rank)
                              return;
                            if (field_output.n_written() == 0)
                              field_output.start();
                            sampled.displacement = pairs(displacement);
                            sampled.velocity     = pairs(velocity);
                            field_output.write(time, sampled);
                          });
  }
} // namespace quoin
