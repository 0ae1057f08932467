// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/near_ranks.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

// Which ranks have boxes near others, without a list of all ranks (doc/scaling.md).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Box = BoundingBox<dim>;

    bool
    meet(const Point<dim> &lower, const Point<dim> &upper, const Box &box)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!(lower[d] <= box.upper_bound(d) && box.lower_bound(d) <= upper[d]))
          return false;
      return true;
    }

    /** The cells of a grid over all boxes, numbered along the axes. */
    class Grid
    {
    public:
      /** Collective. */
      Grid(const std::vector<Box> &boxes,
           const std::vector<Box> &wanted,
           const MPI_Comm          communicator)
      {
        // Least coordinates with the other sign, largest ones, the largest side of a box.
        std::array<double, 2 * dim + 1> most;
        most.fill(std::numeric_limits<double>::lowest());
        for (const Box &box : boxes)
          for (unsigned int d = 0; d < dim; ++d)
            {
              most[d]       = std::max(most[d], -box.lower_bound(d));
              most[dim + d] = std::max(most[dim + d], box.upper_bound(d));
            }
        for (const std::vector<Box> *const list : {&boxes, &wanted})
          for (const Box &box : *list)
            for (unsigned int d = 0; d < dim; ++d)
              most[2 * dim] = std::max(most[2 * dim], box.side_length(d));
        Utilities::MPI::max(ArrayView<const double>(most.data(), most.size()),
                            communicator,
                            ArrayView<double>(most.data(), most.size()));
        double side = 0.;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = -most[d];
            upper[d] = most[dim + d];
            side     = std::max(side, upper[d] - lower[d]);
          }
        // Of a surface that is spread over P ranks each has a piece of the size L / sqrt(P). A box
        // that is no larger than a cell is in eight at most.
        const double n_ranks = Utilities::MPI::n_mpi_processes(communicator);
        size                 = std::max(most[2 * dim], side / std::ceil(2. * std::sqrt(n_ranks)));
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double along = (upper[d] - lower[d]) / size;
            n[d] = along > 1. ? static_cast<std::uint64_t>(std::min(std::ceil(along), 1e6)) : 1;
          }
      }

      /** Calls @p what with each cell that a box reaches into. */
      template <class What>
      void
      for_each_cell(const Box &box, const What &what) const
      {
        if (!meet(lower, upper, box))
          return;
        std::array<std::uint64_t, dim> first, last;
        for (unsigned int d = 0; d < dim; ++d)
          {
            first[d] = index(box.lower_bound(d), d);
            last[d]  = index(box.upper_bound(d), d);
          }
        for (std::uint64_t i = first[0]; i <= last[0]; ++i)
          for (std::uint64_t j = first[1]; j <= last[1]; ++j)
            for (std::uint64_t k = first[2]; k <= last[2]; ++k)
              what((i * n[1] + j) * n[2] + k);
      }

    private:
      Point<dim>                     lower, upper;
      double                         size = 0.;
      std::array<std::uint64_t, dim> n{};

      /** Grows with the coordinate, so that boxes which meet have a cell in common. */
      std::uint64_t
      index(const double x, const unsigned int d) const
      {
        const double along = (x - lower[d]) / size;
        return along > 0. ? std::min(static_cast<std::uint64_t>(std::min(along, 1e6)), n[d] - 1)
                          : 0;
      }
    };

    /** What a rank tells the keeper of a cell, and what this tells those who ask: the box around
     * those of a rank that reach into the cell; without a box a question. */
    struct InCell
    {
      std::uint64_t cell;
      unsigned int  rank;
      bool          asks;
      Point<dim>    lower, upper;
    };
    using Messages = std::map<unsigned int, std::vector<InCell>>;

    /** What the keepers of cells get: boxes of this rank, and where it asks. */
    Messages
    to_keepers(const Grid             &grid,
               const std::vector<Box> &boxes,
               const std::vector<Box> &wanted,
               const MPI_Comm          communicator)
    {
      const unsigned int me      = Utilities::MPI::this_mpi_process(communicator),
                         n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      std::map<std::uint64_t, InCell> mine, asked;
      for (const Box &box : boxes)
        grid.for_each_cell(box, [&](const std::uint64_t cell) {
          const auto &[lower, upper] = box.get_boundary_points();
          const auto [there, is_new] =
            mine.try_emplace(cell, InCell{cell, me, false, lower, upper});
          for (unsigned int d = 0; d < dim && !is_new; ++d)
            {
              there->second.lower[d] = std::min(there->second.lower[d], lower[d]);
              there->second.upper[d] = std::max(there->second.upper[d], upper[d]);
            }
        });
      for (const Box &box : wanted)
        grid.for_each_cell(box, [&](const std::uint64_t cell) {
          asked.try_emplace(cell, InCell{cell, me, true, {}, {}});
        });
      Messages messages;
      for (const auto *const list : {&mine, &asked})
        for (const auto &[cell, record] : *list)
          messages[cell % n_ranks].push_back(record);
      return messages;
    }

    /** The keeper of cells tells those who ask. */
    Messages
    answers(const Messages &received)
    {
      std::map<std::uint64_t, std::vector<InCell>> kept;
      for (const auto &[rank, records] : received)
        for (const InCell &record : records)
          if (!record.asks)
            kept[record.cell].push_back(record);
      Messages result;
      for (const auto &[rank, records] : received)
        for (const InCell &record : records)
          if (const auto found = kept.find(record.cell); record.asks && found != kept.end())
            result[rank].insert(result[rank].end(), found->second.begin(), found->second.end());
      return result;
    }
  } // namespace



  std::vector<std::vector<unsigned int>>
  near_ranks(const std::vector<Box> &boxes,
             const std::vector<Box> &wanted,
             const MPI_Comm          communicator)
  {
    const Grid                                   grid(boxes, wanted, communicator);
    std::map<std::uint64_t, std::vector<InCell>> in_cells;
    for (const auto &[keeper, records] : exchange_records(
           answers(exchange_records(to_keepers(grid, boxes, wanted, communicator), communicator)),
           communicator))
      for (const InCell &record : records)
        in_cells[record.cell].push_back(record);
    std::vector<std::vector<unsigned int>> result(wanted.size());
    for (std::size_t k = 0; k < wanted.size(); ++k)
      {
        std::vector<unsigned int> &ranks = result[k];
        grid.for_each_cell(wanted[k], [&](const std::uint64_t cell) {
          if (const auto found = in_cells.find(cell); found != in_cells.end())
            for (const InCell &record : found->second)
              if (meet(record.lower, record.upper, wanted[k]))
                ranks.push_back(record.rank);
        });
        std::sort(ranks.begin(), ranks.end());
        ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
      }
    return result;
  }
} // namespace Touchstone
