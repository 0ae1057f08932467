// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/body_mesh.h>
#include <touchstone/mesh/contact_work.h>
#include <touchstone/mesh/partition.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

// Partition of meshes that never change by recursive bisection of the coordinates: parts are
// compact, which keeps the surfaces between ranks small, and balanced by the work of cells and
// contact faces. The result depends on the mesh alone. If there are enough coarse cells, only
// these are distributed and each rank refines its own part, so that no rank ever holds the
// refined mesh.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** With fewer coarse cells than this on each rank the refined ones are counted. */
    constexpr unsigned int enough = 64;

    struct Item
    {
      Point<dim>   center;
      double       work;
      unsigned int number;
      /** Items of different kinds are done one kind after the other; explicit runs compute all
       * cells in one pass. */
      unsigned int kind;
      /** Along the axis that is cut, rounded. */
      double place = 0.;
    };

    /** What the ranks of a lower half compute of the upper one, all cells that share a vertex with
     * theirs: the vertices of each cell by number, and the part of the work of such a cell. Without
     * vertices it is nothing. */
    struct Ghosts
    {
      std::vector<std::array<unsigned int, GeometryInfo<dim>::vertices_per_cell>> vertices;
      double                                                                      part = 1.;

      /** Work beyond a cut before each of these items, by their places. */
      std::vector<double>
      beyond(const std::vector<Item>::iterator begin, const std::vector<Item>::iterator end) const
      {
        std::vector<double> change(end - begin + 1, 0.);
        if (vertices.empty())
          return change;
        std::unordered_map<unsigned int, std::ptrdiff_t> first;
        for (auto item = begin; item != end; ++item)
          for (const unsigned int v : vertices[item->number])
            first.emplace(v, item - begin);
        // An item lies beyond the cuts after the first one with a vertex of its own, up to itself.
        for (auto item = begin; item != end; ++item)
          {
            std::ptrdiff_t least = item - begin;
            for (const unsigned int v : vertices[item->number])
              least = std::min(least, first.at(v));
            change[least + 1] += part * item->work;
            change[item - begin + 1] -= part * item->work;
          }
        std::partial_sum(change.begin(), change.end(), change.begin());
        return change;
      }
    };



    /** Ranks of items, as far as this rank needs them: of its own and of those that it asks for
     * once it knows these. */
    struct Ranks
    {
      unsigned int here;
      /** By item; those that are not needed have none. */
      std::vector<unsigned int> of_item;
      /** Which items are needed, by number, from those of this rank, which are marked. */
      std::function<void(std::vector<char> &)> add_needed;
      std::vector<char>                        needed;

      /** Whether this rank is one of @p n_ranks from @p first on. */
      bool
      among(const unsigned int first, const unsigned int n_ranks) const
      {
        return here >= first && here < first + n_ranks;
      }

      /** Give items to rank @p first; of several ranks only if there are none to be given. */
      void
      give(const std::vector<Item>::iterator begin,
           const std::vector<Item>::iterator end,
           const unsigned int                first,
           const unsigned int                n_ranks)
      {
        for (auto item = begin; item != end; ++item)
          of_item[item->number] = first;
        if (!among(first, n_ranks))
          return;
        for (auto item = begin; item != end; ++item)
          needed[item->number] = 1;
        add_needed(needed);
      }

      bool
      any_needed(const std::vector<Item>::iterator begin,
                 const std::vector<Item>::iterator end) const
      {
        return std::any_of(begin, end, [this](const Item &item) { return needed[item.number]; });
      }
    };



    /** Give the items from @p begin to @p end to @p n_ranks ranks from @p first on: cut across
     * the longest side of what they fill, and go on with the halves, first with that of this rank,
     * and with the other only if something in it is needed. */
    void
    bisect(const std::vector<Item>::iterator begin,
           const std::vector<Item>::iterator end,
           const unsigned int                first,
           const unsigned int                n_ranks,
           const Ghosts                     &ghosts,
           Ranks                            &ranks)
    {
      if (n_ranks == 1 || begin == end)
        {
          ranks.give(begin, end, first, n_ranks);
          return;
        }
      std::vector<Point<dim>> centers;
      for (auto item = begin; item != end; ++item)
        centers.push_back(item->center);
      const BoundingBox<dim> box(centers);
      // A tolerance decides between equal sides for the first axis, where round-off would decide
      // at random.
      unsigned int axis = 0;
      for (unsigned int d = 1; d < dim; ++d)
        if (box.side_length(d) > (1. + 1e-6) * box.side_length(axis))
          axis = d;
      // Positions are rounded, so that round-off does not decide the order within a layer of cells
      // and all layers but one stay in one part.
      const double unit = std::max(1e-6 * box.side_length(axis), 1e-300);
      for (auto item = begin; item != end; ++item)
        item->place = std::round((item->center[axis] - box.lower_bound(axis)) / unit);
      std::sort(begin, end, [](const Item &a, const Item &b) {
        return std::tie(a.place, a.number) < std::tie(b.place, b.number);
      });
      double total = 0.;
      for (auto item = begin; item != end; ++item)
        total += item->work;
      // The cut is where the sum of work is nearest to the share of the lower ranks: a cell goes
      // to the lower half if its middle lies below the target. Ranks need not be a power of two.
      // What the lower half computes beyond counts for each of its ranks.
      const unsigned int        n_lower = n_ranks / 2;
      const std::vector<double> beyond  = ghosts.beyond(begin, end);
      const double              share   = double(n_ranks - n_lower) / n_ranks;
      double                    sum     = 0.;
      auto                      middle  = begin;
      while (middle != end &&
             sum + 0.5 * middle->work + share * beyond[middle - begin] < total * n_lower / n_ranks)
        sum += (middle++)->work;
      // Each rank gets at least one cell if there are enough, however uneven the work.
      if (const std::ptrdiff_t n_items = end - begin; n_items >= n_ranks)
        middle = begin +
                 std::clamp<std::ptrdiff_t>(middle - begin, n_lower, n_items - (n_ranks - n_lower));
      const bool here = ranks.among(first, n_ranks), upper = ranks.here >= first + n_lower;
      const auto follow = [&](const bool of_upper) {
        if (of_upper)
          bisect(middle, end, first + n_lower, n_ranks - n_lower, ghosts, ranks);
        else
          bisect(begin, middle, first, n_lower, ghosts, ranks);
      };
      if (here)
        follow(upper);
      for (const bool other : {false, true})
        if (!(here && other == upper) &&
            (other ? ranks.any_needed(middle, end) : ranks.any_needed(begin, middle)))
          follow(other);
    }



    /** Give the items of each kind to the ranks for themselves: all ranks integrate the cells that
     * change before any of them goes on to the solution, to which all cells count alike. */
    void
    bisect_kinds(std::vector<Item> &items,
                 const unsigned int n_ranks,
                 const Ghosts      &ghosts,
                 Ranks             &ranks)
    {
      std::stable_sort(items.begin(), items.end(), [](const Item &a, const Item &b) {
        return a.kind < b.kind;
      });
      // Neighbours of another kind may have been cut before: then all are needed until all are cut.
      const bool several = !items.empty() && items.front().kind != items.back().kind;
      ranks.needed.assign(items.size(), several);
      for (auto begin = items.begin(); begin != items.end();)
        {
          const auto end = std::find_if(begin, items.end(), [&](const Item &item) {
            return item.kind != begin->kind;
          });
          bisect(begin, end, 0, n_ranks, ghosts, ranks);
          begin = end;
        }
      if (!several)
        return;
      for (std::size_t i = 0; i < items.size(); ++i)
        ranks.needed[i] = ranks.of_item[i] == ranks.here;
      ranks.add_needed(ranks.needed);
    }



    /** The cells of a mesh with their work, that of @p contact_weight for each part of a contact
     * face.
     * @param ghosts If ranks compute their ghosts, gets the vertices that tell them; else null. */
    std::vector<Item>
    items_of(const Triangulation<dim> &mesh,
             const CellWork           &cell_work,
             const CellWork           &contact_work,
             const double              contact_weight,
             Ghosts *const             ghosts)
    {
      std::vector<Item> items;
      for (const auto &cell : mesh.active_cell_iterators())
        {
          items.push_back(
            {cell->center(),
             cell_work(cell) + contact_weight * contact_work(cell) / ContactWork::slave_face,
             cell->active_cell_index(),
             ghosts ? 0 : cell_work(cell)});
          if (ghosts)
            {
              ghosts->vertices.emplace_back();
              for (const unsigned int v : cell->vertex_indices())
                ghosts->vertices.back()[v] = cell->vertex_index(v);
            }
        }
      return items;
    }



    /** Which of the coarse cells share a vertex with those that are marked, or are marked. */
    void
    add_neighbours(const BodyMesh &mesh, std::vector<char> &marked)
    {
      std::vector<char> vertices(mesh.vertices.size());
      for (unsigned int c = 0; c < marked.size(); ++c)
        if (marked[c])
          for (const unsigned int v : mesh.cells[c].vertices)
            vertices[v] = 1;
      for (unsigned int c = 0; c < marked.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          if (vertices[v])
            marked[c] = 1;
    }



    /** The part of a mesh that consists of @p cells. A boundary face of the whole mesh is kept with
     * its id if one of the cells has it; faces are compared by their sorted vertices. Faces towards
     * cells that were left out have no entry, and become boundary faces without an id. */
    BodyMesh
    part_of(const BodyMesh &mesh, const std::vector<unsigned int> &cells)
    {
      using Face = std::array<unsigned int, 4>;
      BodyMesh                  part;
      std::vector<unsigned int> number(mesh.vertices.size(), numbers::invalid_unsigned_int);
      std::set<Face>            faces;
      for (const unsigned int c : cells)
        {
          const dealii::CellData<dim> &cell = mesh.cells[c];
          for (const unsigned int f : GeometryInfo<dim>::face_indices())
            {
              Face face;
              for (unsigned int v = 0; v < face.size(); ++v)
                face[v] = cell.vertices[GeometryInfo<dim>::face_to_cell_vertices(f, v)];
              std::sort(face.begin(), face.end());
              faces.insert(face);
            }
          part.cells.push_back(cell);
          for (unsigned int &v : part.cells.back().vertices)
            {
              if (number[v] == numbers::invalid_unsigned_int)
                {
                  number[v] = part.vertices.size();
                  part.vertices.push_back(mesh.vertices[v]);
                }
              v = number[v];
            }
        }
      for (const dealii::CellData<2> &quad : mesh.subcells.boundary_quads)
        {
          Face face;
          std::copy(quad.vertices.begin(), quad.vertices.end(), face.begin());
          std::sort(face.begin(), face.end());
          if (faces.count(face) == 0)
            continue;
          part.subcells.boundary_quads.push_back(quad);
          for (unsigned int &v : part.subcells.boundary_quads.back().vertices)
            v = number[v];
        }
      part.manifolds = mesh.manifolds;
      return part;
    }



    /** A mesh whose coarse cells are on their ranks already: each refines those it has. The
     * class of deal.II takes refined cells one by one with all that is known of each. */
    class DistributedMesh : public parallel::fullydistributed::Triangulation<dim>
    {
    public:
      using parallel::fullydistributed::Triangulation<dim>::Triangulation;

      void
      refine_alike(const unsigned int n_times)
      {
        for (unsigned int n = 0; n < n_times; ++n)
          {
            // Uniform refinement needs no agreement between ranks, hence the function of the
            // serial class.
            set_all_refine_flags();
            dealii::Triangulation<dim>::execute_coarsening_and_refinement();
          }
        local_cell_relations.clear(); // of coarse cells

        // Of the coarse neighbours' cells only those that touch own ones are needed.
        std::vector<char> own(n_vertices());
        for (const auto &cell : active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              own[cell->vertex_index(v)] = 1;
        for (const auto &cell : active_cell_iterators())
          {
            bool any = false;
            for (const unsigned int v : cell->vertex_indices())
              any = any || own[cell->vertex_index(v)];
            if (!any)
              cell->set_subdomain_id(numbers::artificial_subdomain_id);
          }
        // The function of the base class takes those of this rank for all.
        const auto n_coarse_cells = number_cache.number_of_global_coarse_cells;
        parallel::TriangulationBase<dim>::update_number_cache();
        number_cache.number_of_global_coarse_cells = n_coarse_cells;
      }

      bool
      prepare_coarsening_and_refinement() override
      {
        return dealii::Triangulation<dim>::prepare_coarsening_and_refinement();
      }
    };
  } // namespace



  std::unique_ptr<parallel::TriangulationBase<dim>>
  partition_by_coordinates(const BodyMesh    &mesh,
                           const unsigned int refinements,
                           const CellWork    &cell_work,
                           const CellWork    &contact_work,
                           const double       contact_weight,
                           const bool         computes_ghosts,
                           const MPI_Comm     communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator),
                       here    = Utilities::MPI::this_mpi_process(communicator);
    constexpr auto smoothing   = Triangulation<dim>::limit_level_difference_at_vertices;
    // Each rank finds the ranks of its own items and of those around, without a message: it cuts
    // what its own are in, and sorts twice as many items as there are instead of all at each cut.
    Triangulation<dim> whole(smoothing);
    create_triangulation(mesh, whole);
    const bool coarse_cells = whole.n_active_cells() >= enough * n_ranks;
    if (!coarse_cells)
      whole.refine_global(refinements);
    // If a coarse cell stands for 8^r refined ones, each of its faces stands for 4^r: per unit of
    // cell work a contact face counts by 4^r / 8^r = 2^-r.
    const double faces_of_cell = coarse_cells ? std::pow(0.5, refinements) : 1.;
    Ghosts       ghosts;
    ghosts.part             = faces_of_cell; // one of 2^r layers of refined cells
    std::vector<Item> items = items_of(whole,
                                       cell_work,
                                       contact_work,
                                       faces_of_cell * contact_weight,
                                       computes_ghosts ? &ghosts : nullptr);
    // Of coarse cells a second layer of neighbours is needed for the first one to know which of its
    // faces are at the boundary of the body; a refined mesh is described as a whole.
    Ranks ranks{here,
                std::vector<unsigned int>(items.size(), numbers::invalid_unsigned_int),
                [&](std::vector<char> &needed) {
                  if (!coarse_cells)
                    needed.assign(needed.size(), 1);
                  else
                    for (unsigned int layer = 0; layer < 2; ++layer)
                      add_neighbours(mesh, needed);
                },
                std::vector<char>(items.size(), 0)};
    bisect_kinds(items, n_ranks, ghosts, ranks);

    TriangulationDescription::Description<dim, dim> description;
    const auto describe = [&](Triangulation<dim> &triangulation, const auto &rank_of) {
      for (const auto &cell : triangulation.active_cell_iterators())
        cell->set_subdomain_id(rank_of(cell));
      description = TriangulationDescription::Utilities::create_description_from_triangulation(
        triangulation, communicator, TriangulationDescription::Settings::default_setting, here);
    };
    if (!coarse_cells)
      describe(whole, [&](const auto &cell) { return ranks.of_item[cell->active_cell_index()]; });
    else
      {
        std::vector<unsigned int> cells;
        for (unsigned int c = 0; c < ranks.needed.size(); ++c)
          if (ranks.needed[c])
            cells.push_back(c);
        Triangulation<dim> part(smoothing);
        create_triangulation(part_of(mesh, cells), part);
        describe(part, [&](const auto &cell) { return ranks.of_item[cells[cell->index()]]; });
        // Coarse cells by their numbers in the whole mesh.
        for (auto &id : description.coarse_cell_index_to_coarse_cell_id)
          id = cells[id];
        for (auto &cell : description.cell_infos.front())
          cell.id =
            CellId(cells[CellId(cell.id).get_coarse_cell_id()], 0, nullptr).to_binary<dim>();
      }
    auto triangulation = std::make_unique<DistributedMesh>(communicator);
    for (const auto &[id, manifold] : mesh.manifolds)
      triangulation->set_manifold(id, *manifold);
    triangulation->create_triangulation(description);
    if (coarse_cells)
      triangulation->refine_alike(refinements);
    return triangulation;
  }
} // namespace Touchstone
