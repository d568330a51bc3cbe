// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/block_elements/mixed_cells.h>

#include <algorithm>

#include "cell_linearisation.h"

namespace quoin
{
  namespace
  {
    using Entries = std::array<double, 30>; // of the nodes of the tetrahedron

    /** Places of the cells' entries among those of the tetrahedron. */
    struct MixedPlaces
    {
      OfMixed<std::array<unsigned int, 12>> entry;

      /** Takes the nodes of the cells to @p result. */
      MixedPlaces(const BlockForcesData<3> &data, const std::size_t first,
                  MixedLinearisation &result)
      {
        auto end = result.nodes.begin();
        for (unsigned int k = 0; k < parts_of_mixed; ++k)
          for (unsigned int a = 0; a < 4; ++a)
          {
            const unsigned int node = data.cells[first + k][a];
            const auto place = std::find(result.nodes.begin(), end, node);
            if (place == end)
              *end++ = node;
            for (unsigned int i = 0; i < 3; ++i)
              entry[k][3 * a + i] = 3 * (place - result.nodes.begin()) + i;
          }
      }

      void add(const unsigned int k, const std::array<double, 12> &values,
               const double factor, Entries &sums) const
      {
        for (unsigned int q = 0; q < 12; ++q)
          sums[entry[k][q]] += factor * values[q];
      }
    };

    /** Derivative of the trace of a cell's strain, with its own rotation
        @p R, by the displacements of its nodes [1/m]. */
    std::array<double, 12> trace_slope(const Tetrahedron<OneLane> &geometry,
                                       const double (&R)[3][3])
    {
      const auto g = shape_gradients(geometry);
      std::array<double, 12> slope{};
      for (unsigned int a = 0; a < 4; ++a)
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            slope[3 * a + i] += R[i][c] * g[a][c];
      return slope;
    }

    void add_product(const Entries &a, const Entries &b, const double factor,
                     MixedLinearisation &result)
    {
      for (unsigned int i = 0; i < a.size(); ++i)
        for (unsigned int j = 0; j < b.size(); ++j)
          result.stiffness[i][j] += factor * a[i] * b[j];
    }

    /** Stress of a cell that changes with its displacement gradient and with
        the mean stress of the tetrahedron before flow. */
    struct FlowStress
    {
      SpaceMatrix deviatoric; /**< first Piola-Kirchhoff, on flowed gradients */
      SpaceMatrix rotation;
      double mean; /**< less the own initial one [Pa] */
    };

    FlowStress flow_stress(const BlockForcesData<3> &data,
                           const std::size_t cell,
                           const SpacePlasticPoint &before,
                           const double (&H)[3][3], const double trace_shared,
                           const double beyond_mean)
    {
      double Q[6], T[3][3];
      std::copy_n(before.inverse_stretch.begin(), 6, Q);
      SpaceStrain strain = elastic_strain(H, Q);
      add_trace(trace_shared - trace(strain.e), strain.e);
      SpacePlasticPoint after = before;
      SpaceTensor s           = data.law_of(cell)
                          ->update(after, strain, data.initial_stress_of(cell))
                          .stress;
      FlowStress result{ {}, {}, trace(s) / 3. - beyond_mean };
      add_trace(-trace(s), s);
      strain.turning_stress(s, T);
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
        {
          result.rotation[r][c] = strain.R[r][c];
          for (unsigned int i = 0; i < 3; ++i)
            result.deviatoric[r][c] += strain.R[r][i] * T[i][c];
        }
      return result;
    }

    /** (@p plus - @p minus) / @p change of deviatoric + @p mean rotation. */
    SpaceMatrix slope_of(const FlowStress &plus, const FlowStress &minus,
                         const double mean, const double change)
    {
      SpaceMatrix slope;
      for (unsigned int r = 0; r < 3; ++r)
        for (unsigned int c = 0; c < 3; ++c)
          slope[r][c] = (plus.deviatoric[r][c] - minus.deviatoric[r][c]
                         + mean * (plus.rotation[r][c] - minus.rotation[r][c]))
                        / change;
      return slope;
    }

    /** Derivatives by way of what the cells of a tetrahedron share. */
    struct SharedSlopes
    {
      Entries trace{};         /**< of the mean trace, by displacements [1/m] */
      OfMixed<Entries> mean{}; /**< of a cell's mean stress after flow, by
                                  displacements at its trace [Pa/m] */
      OfMixed<double> mean_by_trace{};   /**< of that by its trace [Pa] */
      OfMixed<Entries> force_by_trace{}; /**< at given mean stresses [N] */
    };

    /** Adds minus the derivatives of the forces of cell @p k at given traces
        and mean stress @p mean after flow, and finds its shared ones. */
    void add_flowing_cell(const BlockForcesData<3> &data,
                          const std::size_t first, const unsigned int k,
                          const MixedCells &cells,
                          const SpacePlasticPoint &point, const MixedStep &end,
                          const MixedPlaces &places, SharedSlopes &shared,
                          MixedLinearisation &result)
    {
      const double own_trace = trace(cells.strain[k].e) + end.exchanged[k];
      const double beyond    = cells.beyond_mean(k);
      const double mean      = trace(end.stress[k]) / 3.;
      double Q[6], H[3][3];
      std::copy_n(point.inverse_stretch.begin(), 6, Q);
      std::copy_n(&cells.motion[k].H[0][0], 9, &H[0][0]);
      const Tetrahedron<OneLane> &geometry = cells.motion[k].geometry;
      Tetrahedron<OneLane> flowed          = geometry;
      flowed.flow(Q);
      places.add(k, trace_slope(flowed, cells.strain[k].R), cells.share[k],
                 shared.trace);

      const auto gradients  = shape_gradients(geometry);
      constexpr double step = gradient_difference;
      const auto at         = [&](const double trace_shared)
      { return flow_stress(data, first + k, point, H, trace_shared, beyond); };
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
        {
          const double before    = H[i][j];
          H[i][j]                = before + step;
          const FlowStress plus  = at(own_trace);
          H[i][j]                = before - step;
          const FlowStress minus = at(own_trace);
          H[i][j]                = before;
          const auto change
              = nodal_forces(flowed, slope_of(plus, minus, mean, 2. * step));
          for (unsigned int a = 0; a < 4; ++a)
          {
            const unsigned int column = places.entry[k][3 * a + i];
            for (unsigned int q = 0; q < 12; ++q)
              result.stiffness[places.entry[k][q]][column]
                  -= change[q] * gradients[a][j];
            shared.mean[k][column]
                += (plus.mean - minus.mean) / (2. * step) * gradients[a][j];
          }
        }
      const FlowStress plus  = at(own_trace + step),
                       minus = at(own_trace - step);
      places.add(k, nodal_forces(flowed, slope_of(plus, minus, 0., 2. * step)),
                 1., shared.force_by_trace[k]);
      shared.mean_by_trace[k] = (plus.mean - minus.mean) / (2. * step);
    }

    /** Derivatives of the cells' traces by displacements, through all passes
        of update_mixed(). */
    OfMixed<Entries> trace_slopes(const MixedCells &cells,
                                  const SharedSlopes &shared)
    {
      OfMixed<Entries> slopes;
      slopes.fill(shared.trace);
      for (unsigned int pass = 1; pass < implicit_passes; ++pass)
      {
        OfMixed<Entries> drop;
        Entries mean_drop{};
        for (unsigned int k = 0; k < parts_of_mixed; ++k)
          for (unsigned int q = 0; q < mean_drop.size(); ++q)
          {
            drop[k][q]
                = (1. - shared.mean_by_trace[k] / cells.bulk) * slopes[k][q]
                  - shared.mean[k][q] / cells.bulk;
            mean_drop[q] += cells.share[k] * drop[k][q];
          }
        for (unsigned int k = 0; k < parts_of_mixed; ++k)
          for (unsigned int q = 0; q < mean_drop.size(); ++q)
            slopes[k][q] = shared.trace[q] + drop[k][q] - mean_drop[q];
      }
      return slopes;
    }

    /** Adds what the cells of a tetrahedron have of each other. */
    void add_shared(const MixedCells &cells, const SharedSlopes &shared,
                    MixedLinearisation &result)
    {
      const OfMixed<Entries> slopes = trace_slopes(cells, shared);
      Entries mean{};
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        add_product(shared.force_by_trace[k], slopes[k], -1., result);
        for (unsigned int q = 0; q < mean.size(); ++q)
          mean[q]
              += cells.share[k]
                 * (shared.mean[k][q] + shared.mean_by_trace[k] * slopes[k][q]);
      }
      // The mean stress acts on the nodes by minus V times the slope of the
      // mean trace.
      add_product(shared.trace, mean, cells.volume, result);
    }

    void linearise_flowing(const BlockForcesData<3> &data,
                           const std::size_t first, const MixedCells &cells,
                           const OfMixed<SpacePlasticPoint> &points,
                           const MixedStep &step, const MixedPlaces &places,
                           MixedLinearisation &result,
                           const bool with_stiffness)
    {
      result.dissipated = step.dissipated;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        double Q[6], T[3][3];
        std::copy_n(points[k].inverse_stretch.begin(), 6, Q);
        cells.strain[k].turning_stress(step.stress[k], T);
        SpaceMatrix P{};
        for (unsigned int r = 0; r < 3; ++r)
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int i = 0; i < 3; ++i)
              P[r][c] += cells.strain[k].R[r][i] * T[i][c];
        Tetrahedron<OneLane> flowed = cells.motion[k].geometry;
        flowed.flow(Q);
        places.add(k, nodal_forces(flowed, P), 1., result.force);
      }
      if (!with_stiffness)
        return;
      SharedSlopes shared;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
        add_flowing_cell(data, first, k, cells, points[k], step, places, shared,
                         result);
      add_shared(cells, shared, result);
    }

    void linearise_elastic_cells(const BlockForcesData<3> &data,
                                 const std::size_t first,
                                 const MixedCells &cells,
                                 const MixedPlaces &places,
                                 MixedLinearisation &result,
                                 const bool with_stiffness)
    {
      const SpaceStiffness &C = data.stiffness_of(first);
      Entries slope{};
      CellLinearisation own;
      for (unsigned int k = 0; k < parts_of_mixed; ++k)
      {
        // The rotation changes with the cell's own strain.
        const SpaceStrain strain(cells.motion[k].H);
        linearise_elastic(cells.motion[k], strain,
                          { data.initial_stress_of(first + k),
                            elastic_stress(C, cells.strain[k].e),
                            { -2. / 3. * C.mu, C.mu } },
                          own, with_stiffness);
        places.add(k, own.force, 1., result.force);
        if (!with_stiffness)
          continue;
        for (unsigned int q = 0; q < 12; ++q)
          for (unsigned int p = 0; p < 12; ++p)
            result.stiffness[places.entry[k][q]][places.entry[k][p]]
                += own.stiffness[q][p];
        places.add(k, trace_slope(cells.motion[k].geometry, strain.R),
                   cells.share[k], slope);
      }
      if (with_stiffness)
        add_product(slope, slope, cells.volume * cells.bulk, result);
    }
  } // namespace

  void linearise_mixed(const BlockForcesData<3> &data, const unsigned int first,
                       const NodeRecord<3> *nodes, PlasticHistory &history,
                       MixedLinearisation &result, const bool with_stiffness)
  {
    const MixedPlaces places(data, first, result);
    result.dissipated = 0.;
    result.force.fill(0.);
    if (with_stiffness)
      for (auto &row : result.stiffness)
        row.fill(0.);
    const auto points = mixed_points(history, first);
    const MixedCells cells(data, nodes, first, points);
    if (!data.law_of(first) || history.space_cells.empty())
    {
      linearise_elastic_cells(data, first, cells, places, result,
                              with_stiffness);
      return;
    }
    const MixedStep step
        = update_mixed(data, first, points, cells, implicit_passes);
    linearise_flowing(data, first, cells, points, step, places, result,
                      with_stiffness);
    for (unsigned int k = 0; k < parts_of_mixed; ++k)
      set_plastic_point(step.points[k], first + k, history);
  }
} // namespace quoin
