// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/packed_vectors.h>
#include <quoin/results/joint_output.h>

#include <cmath>
#include <utility>

namespace quoin
{
  namespace
  {
    unsigned int severity(const JointState state)
    {
      switch (state)
      {
      case JointState::open:
        return 3;
      case JointState::slipping:
        return 2;
      case JointState::slipped:
        return 1;
      default:
        return 0;
      }
    }
  } // namespace

  JointState worst(const JointState a, const JointState b)
  {
    return severity(a) >= severity(b) ? a : b;
  }

  JointOutput::JointOutput(const std::string &output_directory,
                           const MPI_Comm communicator, const std::string &name,
                           const FieldFormat format)
    : FieldSeries(output_directory, name, communicator, format)
  {
  }

  void JointOutput::write(const double time, const JointFields &fields)
  {
    const std::size_t n_points = fields.position.size();
    const std::size_t n_faces  = n_points / 2;

    VtuGrid grid;
    grid.time      = time;
    grid.cell_type = VtuCellType::line;
    grid.cells.resize(n_points);
    std::vector<std::uint8_t> point_state(n_points), face_state(n_faces);
    for (std::size_t i = 0; i < n_points; ++i)
    {
      append_vector(grid.points, fields.position[i] + fields.displacement[i]);
      grid.cells[i]  = static_cast<std::int32_t>(i);
      point_state[i] = static_cast<std::uint8_t>(fields.state[i]);
    }
    std::vector<double> length(n_faces);
    for (std::size_t face = 0; face < n_faces; ++face)
    {
      length[face]
          = fields.position[2 * face].distance(fields.position[2 * face + 1]);
      face_state[face] = static_cast<std::uint8_t>(
          worst(fields.state[2 * face], fields.state[2 * face + 1]));
    }

    grid.point_data = { { "displacement", 2, flat(fields.displacement) },
                        { "opening", 1, fields.opening },
                        { "slip", 1, fields.slip },
                        { "normal traction", 1, fields.normal_traction },
                        { "shear traction", 1, fields.shear_traction },
                        { "point state", 1, point_state } };
    if (!fields.earlier_displacement.empty())
      grid.point_data.push_back(
          { "earlier displacement", 2, flat(fields.earlier_displacement) });
    if (!fields.earlier_slip.empty())
      grid.point_data.push_back({ "earlier slip", 1, fields.earlier_slip });
    for (const auto &[name, values] : fields.of_laws)
      grid.point_data.push_back({ name, 1, values });
    grid.cell_data = { { "state", 1, face_state },
                       { "joint set", 1, fields.joint_set },
                       { "handed over", 1, fields.handed_over },
                       { "length", 1, length } };
    write_grid(std::move(grid));
  }

  void JointOutput::write(const double time, const SpaceJointFields &fields)
  {
    const std::size_t n_points = fields.position.size();
    VtuGrid grid;
    grid.time      = time;
    grid.dimension = 3;
    grid.cell_type = VtuCellType::triangle;
    grid.points    = flat(fields.position);
    std::vector<std::uint8_t> point_state(n_points), face_state;
    for (std::size_t i = 0; i < n_points; ++i)
    {
      add_to_vector(grid.points, i, fields.displacement[i]);
      grid.cells.push_back(static_cast<std::int32_t>(i));
      point_state[i] = static_cast<std::uint8_t>(fields.state[i]);
    }
    for (std::size_t p = 0; p < n_points; p += 3)
      face_state.push_back(static_cast<std::uint8_t>(worst(
          worst(fields.state[p], fields.state[p + 1]), fields.state[p + 2])));

    grid.point_data = { { "displacement", 3, flat(fields.displacement) },
                        { "opening", 1, fields.opening },
                        { "slip", 3, flat(fields.slip) },
                        { "normal traction", 1, fields.normal_traction },
                        { "shear traction", 3, flat(fields.shear_traction) },
                        { "point state", 1, point_state } };
    if (!fields.earlier_displacement.empty())
      grid.point_data.push_back(
          { "earlier displacement", 3, flat(fields.earlier_displacement) });
    if (!fields.earlier_slip.empty())
      grid.point_data.push_back(
          { "earlier slip", 3, flat(fields.earlier_slip) });
    for (const auto &[name, values] : fields.of_laws)
      grid.point_data.push_back({ name, 1, values });
    grid.cell_data = { { "state", 1, face_state },
                       { "joint set", 1, fields.joint_set },
                       { "normal", 3, flat(fields.normal) },
                       { "area", 1, fields.area } };
    write_grid(std::move(grid));
  }
} // namespace quoin
