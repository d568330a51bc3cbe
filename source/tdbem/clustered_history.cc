// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/eigen_core.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/plane_geometry.h>
#include <quoin/tdbem/clustered_history.h>
#include <quoin/elastodynamics/gauss_legendre.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <complex>

namespace quoin
{
  namespace
  {
    using Eigen::MatrixXd;
    using Eigen::VectorXd;

    /** Share of the tolerance for what is left out of a basis. */
    constexpr double basis_share = 0.01;

    /** Overlapping columns, each a step later than the one before. */
    using Shifted = Eigen::Map<const MatrixXd, 0, Eigen::OuterStride<>>;

    double distance(const BoundaryElement &element, const dealii::Point<2> &x)
    {
      return distance_to_segment(x, element.a, element.b);
    }

    /** Nearest and furthest points of two clusters [m]. */
    std::pair<double, double> distances(const Boundary &boundary,
                                        const ElementRange &rows,
                                        const ElementRange &columns)
    {
      double nearest = std::numeric_limits<double>::infinity(), furthest = 0.;
      for (unsigned e = rows.begin; e < rows.end; ++e)
        for (unsigned f = columns.begin; f < columns.end; ++f)
        {
          const BoundaryElement &E = boundary.elements[e];
          const BoundaryElement &F = boundary.elements[f];
          for (const auto &x : { E.a, E.b })
            for (const auto &y : { F.a, F.b })
              furthest = std::max(furthest, (x - y).norm());
          nearest = std::min({ nearest, distance(E, F.a), distance(E, F.b),
                               distance(F, E.a), distance(F, E.b) });
        }
      return { nearest, furthest };
    }

    /** Directions with more than @p share of the greatest singular value. */
    MatrixXd strongest_directions(const MatrixXd &gram, const double share)
    {
      if (gram.size() == 0)
        return gram;
      const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(gram);
      const VectorXd &values = eigen.eigenvalues(); // ascending
      const double least     = share * share * values(values.size() - 1);
      Eigen::Index n         = 0;
      while (n < values.size() && values(n) <= least)
        ++n;
      return eigen.eigenvectors().rightCols(values.size() - n);
    }
  } // namespace

  ClusteredHistory::ClusteredHistory(const InfluenceKernel &kernel,
                                     const Boundary &boundary,
                                     const Options &given,
                                     MPI_Comm communicator)
    : options(given), communicator(communicator), time_step(kernel.time_step())
  {
    // Measured: what is left out adds up to at most one and a half times the
    // tolerance of the parts.
    options.tolerance *= 0.5;
    const unsigned n = unsigned(boundary.n_elements());
    // Measured: short clusters keep fewer lags, long ones make larger products.
    if (options.cluster_size == 0)
      options.cluster_size = n < 100 ? 8 : 12;
    if (options.block_size == 0)
      options.block_size = n < 100 ? 8 : 24;

    MatrixXd G, H;
    kernel.lag(0, G, H);
    traction_scale = H.norm() / G.norm();

    make_clusters(boundary, options.cluster_size);
    share_clusters();
    make_pairs(kernel, boundary, options.share);
    make_rates(kernel);
    make_bases(kernel);
    for (Pair &pair : pairs)
      fill(kernel, pair);

    for (Cluster &cluster : clusters)
    {
      const std::size_t columns = 2 * (longest + options.block_size);
      cluster.past.assign(columns * cluster.n_values(), 0.);
      cluster.moments.assign(columns * cluster.n_moments(), 0.);
    }
    first_kept      = -long(longest);
    unsigned n_rows = 0;
    for (unsigned c = first_cluster; c < end_cluster; ++c)
      n_rows += 2 * clusters[c].elements.size();
    block.setZero(n_rows, options.block_size);
    local.setZero(n_rows);
    sum.setZero(2 * n);
  }

  void ClusteredHistory::make_clusters(const Boundary &boundary,
                                       const unsigned size)
  {
    const auto &elements = boundary.elements;
    const unsigned n     = unsigned(elements.size());
    unsigned begin       = 0;
    while (begin < n)
    {
      unsigned end = begin + 1;
      while (end < n
             && (elements[end].a - elements[end - 1].b).norm()
                    < 1e-6 * elements[end].length())
        ++end;
      const unsigned pieces = (end - begin + size - 1) / size;
      for (unsigned k = 0; k < pieces; ++k)
      {
        Cluster cluster;
        cluster.elements = { begin + (end - begin) * k / pieces,
                             begin + (end - begin) * (k + 1) / pieces };
        clusters.push_back(cluster);
      }
      begin = end;
    }
  }

  void ClusteredHistory::share_clusters()
  {
    int n_ranks = 1, rank = 0;
    MPI_Comm_size(communicator, &n_ranks);
    MPI_Comm_rank(communicator, &rank);
    const unsigned n = unsigned(clusters.size());
    const auto first = [&](const int r) { return n * unsigned(r) / n_ranks; };
    first_cluster    = first(rank);
    end_cluster      = first(rank + 1);
    int offset       = 0;
    for (int r = 0; r < n_ranks; ++r)
    {
      int count = 0;
      for (unsigned c = first(r); c < first(r + 1); ++c)
        count += 2 * int(clusters[c].elements.size());
      row_counts.push_back(count);
      row_offsets.push_back(offset);
      offset += count;
    }
  }

  bool ClusteredHistory::is_mine(const Pair &pair) const
  {
    return pair.row >= first_cluster && pair.row < end_cluster;
  }

  unsigned ClusteredHistory::first_row(const Pair &pair) const
  {
    return 2
           * (clusters[pair.row].elements.begin
              - clusters[first_cluster].elements.begin);
  }

  void ClusteredHistory::make_pairs(const InfluenceKernel &kernel,
                                    const Boundary &boundary,
                                    const double share)
  {
    const unsigned n = unsigned(clusters.size());
    for (unsigned row = 0; row < n; ++row)
      for (unsigned column = 0; column < n; ++column)
      {
        const ElementRange &I          = clusters[row].elements;
        const ElementRange &J          = clusters[column].elements;
        const auto [nearest, furthest] = distances(boundary, I, J);
        Pair pair;
        pair.row                = row;
        pair.column             = column;
        const unsigned decaying = kernel.first_decaying_lag(furthest, share);
        // The exponentials of a block must be known at its start.
        pair.end = std::max(
            std::min<unsigned>(decaying, lags_wanted(options.n_steps)),
            options.block_size + 1);
        pair.begin
            = std::min(std::max(1u, kernel.first_lag(I, J, nearest)), pair.end);
        // If the run ends before, nothing is left to the exponentials.
        pair.surplus = pair.end < decaying
                           ? std::numeric_limits<double>::infinity()
                           : time_step
                                 * std::max(2., double(pair.end)
                                                    - kernel.first_decaying_lag(
                                                        furthest, 0.));
        pairs.push_back(pair);
        longest = std::max(longest, pair.end);
      }
  }

  void ClusteredHistory::make_rates(const InfluenceKernel &kernel)
  {
    // What decays by more than this until the end of the lags kept is nothing.
    const double cutoff = -std::log(0.003 * options.tolerance);
    double fastest      = 0.;
    for (const Pair &pair : pairs)
      fastest = std::max(fastest, cutoff / pair.surplus);
    const double slowest = 0.5 / (double(options.n_steps) * time_step);
    fastest = std::min(std::max(fastest, slowest), kernel.largest_rate());

    // Measured: of exp(-lambda t) in one octave of lambda, three points leave
    // 1e-5 and each further one a twelfth of that.
    const unsigned n_points = unsigned(
        std::ceil(std::max(3., -1.55 - std::log(options.tolerance) / 2.5)));
    const GaussRule &rule = gauss_legendre(std::min(n_points, 20u));
    std::vector<double> limits{ fastest };
    while (limits.back() > slowest)
      limits.push_back(0.5 * limits.back());
    limits.push_back(0.);
    for (const double jump : kernel.cut_jumps())
      if (jump < fastest)
        limits.push_back(jump);
    std::sort(limits.begin(), limits.end());
    for (std::size_t k = 0; k + 1 < limits.size(); ++k)
    {
      const double width = limits[k + 1] - limits[k];
      for (std::size_t i = 0; i < rule.points.size(); ++i)
      {
        const double lambda = limits[k] + width * rule.points[i];
        rates.push_back(
            { lambda, width * rule.weights[i], kernel.decay_factors(lambda) });
      }
    }
    for (Pair &pair : pairs)
    {
      pair.n_rates = 0;
      while (pair.n_rates < rates.size()
             && (rates[pair.n_rates].lambda < cutoff / pair.surplus
                 || pair.n_rates % rule.points.size() != 0))
        ++pair.n_rates;
    }
  }

  MatrixXd ClusteredHistory::stacked(const MatrixXd &G, const MatrixXd &H) const
  {
    MatrixXd result(G.rows(), G.cols() + H.cols());
    result << traction_scale * G, -H;
    return result;
  }

  MatrixXd ClusteredHistory::cut_matrix(const InfluenceKernel &kernel,
                                        const Pair &pair,
                                        const unsigned k) const
  {
    const Rate &rate = rates[k];
    MatrixXd G, H;
    kernel.cut_blocks(clusters[pair.row].elements,
                      clusters[pair.column].elements, rate.lambda, G, H);
    const double factor
        = rate.weight * std::pow(rate.factors.ratio, double(pair.end));
    return stacked(factor * rate.factors.G * G, factor * rate.factors.H * H);
  }

  void ClusteredHistory::make_bases(const InfluenceKernel &kernel)
  {
    // Every rank makes those of all clusters in the same order, so that
    // results do not depend on their number.
    std::vector<MatrixXd> row_grams, column_grams;
    for (const Cluster &cluster : clusters)
    {
      const unsigned n = cluster.n_values();
      row_grams.push_back(MatrixXd::Zero(n / 2, n / 2));
      column_grams.push_back(MatrixXd::Zero(n, n));
    }
    for (const Pair &pair : pairs)
      for (unsigned k = 0; k < pair.n_rates; ++k)
      {
        // What a constant input would do in the long run.
        const MatrixXd matrix
            = cut_matrix(kernel, pair, k) / (1. - rates[k].factors.ratio);
        row_grams[pair.row].noalias() += matrix * matrix.transpose();
        column_grams[pair.column].noalias() += matrix.transpose() * matrix;
      }
    for (std::size_t c = 0; c < clusters.size(); ++c)
    {
      const double share       = 0.1 * options.tolerance;
      clusters[c].row_basis    = strongest_directions(row_grams[c], share);
      clusters[c].column_basis = strongest_directions(column_grams[c], share);
    }
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                               [this](const Pair &pair)
                               { return !is_mine(pair); }),
                pairs.end());
  }

  void ClusteredHistory::fill(const InfluenceKernel &kernel, Pair &pair) const
  {
    const Cluster &row = clusters[pair.row], &column = clusters[pair.column];
    MatrixXd G, H;
    kernel.blocks(row.elements, column.elements, pair.begin, pair.end, G, H);
    const unsigned width = 2 * column.elements.size();
    pair.matrices.resize(G.rows(), 2 * G.cols());
    for (unsigned n = pair.begin; n < pair.end; ++n)
    {
      const unsigned from = (n - pair.begin) * width;
      pair.matrices.middleCols(2 * width * (pair.end - 1 - n), 2 * width)
          = stacked(G.middleCols(from, width), H.middleCols(from, width));
    }

    // A column for each rate: what it does in the long run.
    const unsigned n_moments = column.n_moments();
    MatrixXd couplings(row.row_basis.cols() * n_moments, pair.n_rates);
    VectorXd lasting(pair.n_rates);
    for (unsigned k = 0; k < pair.n_rates; ++k)
    {
      lasting(k)       = 1. / (1. - rates[k].factors.ratio);
      couplings.col(k) = (lasting(k) * row.row_basis.transpose()
                          * cut_matrix(kernel, pair, k) * column.column_basis)
                             .reshaped();
    }
    const MatrixXd mixtures = strongest_directions(
        couplings.transpose() * couplings, basis_share * options.tolerance);
    pair.decaying
        = (couplings * mixtures)
              .reshaped(row.row_basis.cols(), n_moments * mixtures.cols());
    pair.mixtures = lasting.cwiseInverse().asDiagonal() * mixtures;
    pair.state.setZero(n_moments, pair.n_rates);
  }

  void ClusteredHistory::make_room()
  {
    const long keep = long(longest), capacity = 2 * (keep + options.block_size);
    if (long(step) + options.block_size <= first_kept + capacity)
      return;
    const long shift = long(step) - keep - first_kept;
    for (Cluster &cluster : clusters)
      for (auto *values : { &cluster.past, &cluster.moments })
      {
        const std::size_t stride = values->size() / std::size_t(capacity);
        std::copy(values->begin() + shift * stride, values->end(),
                  values->begin());
        std::fill(values->end() - shift * stride, values->end(), 0.);
      }
    first_kept += shift;
  }

  void ClusteredHistory::begin_block()
  {
    make_room();
    const unsigned n_columns = options.block_size;
    block.setZero();
    MatrixXd states, directions, shifted;
    for (unsigned c = first_cluster, p = 0; c < end_cluster; ++c)
    {
      const Cluster &row = clusters[c];
      directions.setZero(row.row_basis.cols(), n_columns);
      auto rows
          = block.middleRows(first_row(pairs[p]), 2 * row.elements.size());
      for (; p < pairs.size() && pairs[p].row == c; ++p)
      {
        Pair &pair            = pairs[p];
        const Cluster &column = clusters[pair.column];

        // 1. Lags that are kept; what the block will add is still zero.
        const unsigned n_values = column.n_values();
        const long first        = long(step) - long(pair.end - 1) - first_kept;
        const Shifted past(column.past.data() + first * n_values,
                           pair.matrices.cols(), n_columns,
                           Eigen::OuterStride<>(n_values));
        shifted = past; // columns that overlap are not for BLAS
        rows.noalias() += pair.matrices * shifted;

        // 2. The exponentials, step by step.
        const unsigned n_moments = column.n_moments();
        states.resize(pair.decaying.cols(), n_columns);
        for (unsigned j = 0; j < n_columns; ++j)
        {
          const long at = long(step) + long(j) - long(pair.end) - first_kept;
          const Eigen::Map<const VectorXd> moments(
              column.moments.data() + at * n_moments, n_moments);
          for (unsigned k = 0; k < pair.n_rates; ++k)
            pair.state.col(k)
                = rates[k].factors.ratio * pair.state.col(k) + moments;
          states.col(j).reshaped(n_moments, pair.mixtures.cols()).noalias()
              = pair.state * pair.mixtures;
        }
        directions.noalias() += pair.decaying * states;
      }
      rows.noalias() += row.row_basis * directions;
    }
    in_block    = 0;
    block_begun = true;
  }

  const VectorXd &ClusteredHistory::predict()
  {
    if (!block_begun)
      begin_block();
    local = block.col(in_block);
    // Lags that reach into the block.
    if (in_block > 0)
      for (const Pair &pair : pairs)
      {
        if (pair.begin > in_block)
          continue;
        const Cluster &column   = clusters[pair.column];
        const unsigned n_values = column.n_values();
        const unsigned n        = n_values * (in_block - pair.begin + 1);
        const Eigen::Map<const VectorXd> past(
            column.past.data()
                + (long(step) - long(in_block) - first_kept) * n_values,
            n);
        const unsigned from = n_values * (pair.end - 1 - in_block);
        local.segment(first_row(pair), pair.matrices.rows()).noalias()
            += pair.matrices.middleCols(from, n) * past;
      }
    MPI_Allgatherv(local.data(), int(local.size()), MPI_DOUBLE, sum.data(),
                   row_counts.data(), row_offsets.data(), MPI_DOUBLE,
                   communicator);
    return sum;
  }

  void ClusteredHistory::push(const VectorXd &u, const VectorXd &p)
  {
    if (!block_begun)
      begin_block();
    const long column = long(step) - first_kept;
    for (Cluster &cluster : clusters)
    {
      const unsigned n     = 2 * cluster.elements.size();
      const unsigned first = 2 * cluster.elements.begin;
      Eigen::Map<VectorXd> values(
          cluster.past.data() + column * cluster.n_values(), 2 * n);
      values.head(n) = p.segment(first, n) / traction_scale;
      values.tail(n) = u.segment(first, n);
      Eigen::Map<VectorXd>(cluster.moments.data()
                               + column * cluster.n_moments(),
                           cluster.n_moments())
          = cluster.column_basis.transpose() * values;
    }
    ++step;
    if (++in_block == options.block_size)
      block_begun = false;
  }

  SavedHistory ClusteredHistory::save() const
  {
    const auto add = [](std::vector<double> &saved, const auto &values)
    { saved.insert(saved.end(), values.begin(), values.end()); };
    SavedHistory result;
    result.common = { double(step), double(first_kept), double(block_begun),
                      double(in_block) };
    for (const Cluster &cluster : clusters)
    {
      add(result.common, cluster.past);
      add(result.common, cluster.moments);
    }
    // A group is what a cluster's equations need.
    result.first_group = first_cluster;
    unsigned row = 0, p = 0;
    for (unsigned c = first_cluster; c < end_cluster; ++c)
    {
      const unsigned n_rows      = 2 * clusters[c].elements.size();
      std::vector<double> &group = result.groups.emplace_back();
      add(group, block.middleRows(row, n_rows).eval().reshaped());
      row += n_rows;
      for (; p < pairs.size() && pairs[p].row == c; ++p)
        add(group, pairs[p].state.reshaped());
    }
    return result;
  }

  void ClusteredHistory::restore(const SavedHistory &saved)
  {
    const SavedHistory own = save();
    const auto fits        = [&](const std::size_t k)
    {
      const std::size_t group = first_cluster - saved.first_group + k;
      return group < saved.groups.size()
             && saved.groups[group].size() == own.groups[k].size();
    };
    bool all_fit = saved.common.size() == own.common.size()
                   && saved.first_group <= first_cluster;
    for (std::size_t k = 0; all_fit && k < own.groups.size(); ++k)
      all_fit = fits(k);
    if (!all_fit)
      throw InputError("Boundary elements: the history in the checkpoint is "
                       "that of another boundary or tolerance. Start the run "
                       "without --resume.");
    auto next       = saved.common.begin();
    const auto take = [&next](auto &&values)
    {
      for (auto &value : values)
        value = *next++;
    };
    step        = static_cast<unsigned long>(*next++);
    first_kept  = long(*next++);
    block_begun = *next++ != 0.;
    in_block    = unsigned(*next++);
    for (Cluster &cluster : clusters)
    {
      take(cluster.past);
      take(cluster.moments);
    }
    unsigned row = 0, p = 0;
    for (unsigned c = first_cluster; c < end_cluster; ++c)
    {
      const unsigned n_rows = 2 * clusters[c].elements.size();
      MatrixXd rows(n_rows, block.cols());
      next = saved.groups[c - saved.first_group].begin();
      take(rows.reshaped());
      block.middleRows(row, n_rows) = rows;
      row += n_rows;
      for (; p < pairs.size() && pairs[p].row == c; ++p)
        take(pairs[p].state.reshaped());
    }
  }

  std::size_t ClusteredHistory::memory() const
  {
    std::size_t numbers = std::size_t(block.size());
    for (const Pair &pair : pairs)
      numbers += std::size_t(pair.matrices.size() + pair.decaying.size()
                             + pair.mixtures.size() + pair.state.size());
    for (const Cluster &cluster : clusters)
      numbers += cluster.past.size() + cluster.moments.size();
    return numbers * sizeof(double);
  }

  double ClusteredHistory::decay_error(const InfluenceKernel &kernel) const
  {
    double largest[2] = { 0., 0. }; // of the difference and of the matrices
    MatrixXd G, H;
    for (const Pair &pair : pairs)
    {
      const Cluster &row = clusters[pair.row], &column = clusters[pair.column];
      kernel.blocks(row.elements, column.elements, pair.end, pair.end + 1, G,
                    H);
      const MatrixXd exact     = stacked(G, H);
      const unsigned n_moments = column.n_moments();
      MatrixXd coupling
          = MatrixXd::Zero(row.row_basis.cols(), column.column_basis.cols());
      const VectorXd factors = pair.mixtures.colwise().sum();
      for (unsigned k = 0; k < factors.size(); ++k)
        coupling
            += factors(k) * pair.decaying.middleCols(n_moments * k, n_moments);
      const MatrixXd difference
          = exact - row.row_basis * coupling * column.column_basis.transpose();
      largest[0] = std::max(largest[0], difference.cwiseAbs().maxCoeff());
      largest[1] = std::max(largest[1], exact.cwiseAbs().maxCoeff());
    }
    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, communicator);
    return largest[0] / largest[1];
  }

  ZTransform ClusteredHistory::transform(const InfluenceKernel &kernel) const
  {
    MatrixXd G0, H0;
    kernel.lag(0, G0, H0);
    return [this, G0, H0](const std::complex<double> w, Eigen::MatrixXcd &G,
                          Eigen::MatrixXcd &H)
    {
      const Eigen::Index n = G0.rows();
      G.setZero(n, n);
      H.setZero(n, n);
      for (const Pair &pair : pairs)
      {
        const Cluster &row       = clusters[pair.row];
        const Cluster &column    = clusters[pair.column];
        const Eigen::Index m     = 2 * row.elements.size(),
                           width = column.n_values(),
                           rank  = row.row_basis.cols();
        // Matrices side by side, each seen as a column: what the factors, real
        // and imaginary, make of them is one product.
        const auto combination
            = [](const MatrixXd &matrices, const Eigen::Index n_rows,
                 const Eigen::VectorXcd &factors)
        {
          MatrixXd parts(factors.size(), 2);
          parts << factors.real(), factors.imag();
          const MatrixXd sums
              = Eigen::Map<const MatrixXd>(matrices.data(),
                                           matrices.size() / factors.size(),
                                           factors.size())
                * parts;
          Eigen::MatrixXcd result(n_rows, sums.rows() / n_rows);
          result.real() = MatrixXd::Map(&sums(0, 0), n_rows, result.cols());
          result.imag() = MatrixXd::Map(&sums(0, 1), n_rows, result.cols());
          return result;
        };
        const auto add = [&](const Eigen::MatrixXcd &matrix)
        {
          const Eigen::Index i = 2 * row.elements.begin,
                             j = 2 * column.elements.begin;
          G.block(i, j, m, width / 2)
              += matrix.leftCols(width / 2) / traction_scale;
          H.block(i, j, m, width / 2) -= matrix.rightCols(width / 2);
        };
        std::complex<double> power = std::pow(w, double(pair.begin));
        if (pair.end > pair.begin)
        {
          Eigen::VectorXcd powers(pair.end - pair.begin);
          for (Eigen::Index k = powers.size(); k-- > 0; power *= w)
            powers(k) = power;
          add(combination(pair.matrices, m, powers));
        }
        if (pair.n_rates == 0 || pair.mixtures.cols() == 0 || rank == 0
            || column.n_moments() == 0)
          continue;
        Eigen::VectorXcd sums(pair.n_rates);
        for (unsigned k = 0; k < pair.n_rates; ++k)
          sums(k) = power / (1. - rates[k].factors.ratio * w);
        const Eigen::MatrixXcd coupling = combination(
            pair.decaying, rank, pair.mixtures.transpose() * sums);
        add(row.row_basis * coupling * column.column_basis.transpose());
      }
      for (Eigen::MatrixXcd *matrix : { &G, &H })
        MPI_Allreduce(MPI_IN_PLACE, matrix->data(), int(matrix->size()),
                      MPI_C_DOUBLE_COMPLEX, MPI_SUM, communicator);
      G += G0;
      H += H0;
    };
  }
} // namespace quoin
