#include <touchstone/contact/pairing/averaged_derivative.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/partial_cover.h>
#include <touchstone/contact/search/facing_faces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <unordered_map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Of the shortest edge: nodes that move by less do not change which faces face each
     * other, but for those beside them. */
    constexpr double negligible_motion = 0.02;

    /**
     * Rows that pass the patch test: the stencil of a slave node are averages of
     * the master shapes, weighted with the dual basis of its slave faces. With
     * int psi_s N_t = delta_st int N_s the gap of the slave side is that of the
     * node alone, so a row keeps its form.
     * A face with hanging nodes takes the basis of the continuous displacements
     * instead of its shape functions, and rows go to the nodes that these follow.
     * Wohlmuth (2000), SIAM J. Numer. Anal. 38; on faces that are covered only in
     * part the basis is dual on the covered part: Popp, Seitz, Gee and Wall (2013),
     * Comput. Methods Appl. Mech. Engng 264. Nodes of which little is covered leave it to
     * others (CoverShares), whose stencils then contain them.
     */
    class AveragedPairing : public Pairing
    {
    public:
      explicit AveragedPairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 input.search_distance > 0.
                   ? input.search_distance
                   : std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 master_normal(input.parameters->master_normal),
                 input.solid->communicator)
        , facing(search,
                 negligible_motion *
                   std::min(input.slave->shortest_edge(), input.master->shortest_edge()))
        , kind(master_normal(input.parameters->master_normal))
        , tied(input.parameters->behaviour == "tied")
      {
        for (const SurfaceNode &node : input.slave->owned_nodes())
          places.emplace(node.node, static_cast<int>(places.size()));
        sums.resize(places.size());
        // Of owned and of ghost cells: with all faces around an owned node its sums are
        // complete here without another rank.
        for (const auto *list : {&input.slave->owned_faces(), &input.slave->neighbour_faces()})
          for (const Face &face : *list)
            {
              const TraceBasis *const basis = input.slave->trace(face);
              SlaveFace slave{&face, basis, {}, whole_areas(face, basis, /*reference=*/true)};
              bool      any = false;
              for (unsigned int m = 0; m < face.n_nodes(); ++m)
                {
                  const auto found =
                    places.find(slave.basis ? slave.basis->nodes[m] : face.nodes[m]);
                  slave.places[m] = found != places.end() ? found->second : -1;
                  any             = any || found != places.end();
                }
              if (any)
                faces.push_back(slave);
            }
        std::sort(faces.begin(), faces.end(), [](const SlaveFace &a, const SlaveFace &b) {
          return a.face->key < b.face->key;
        });
        slave_faces.reserve(faces.size());
        for (const SlaveFace &face : faces)
          slave_faces.push_back({*face.face, {}});
        search.commit(nullptr);
        // Both sides of the gap are smooth or none, or it would be measured from
        // facets that stray from their surface to one that does not. The normals of
        // faces of ghost cells are known to their owners only.
        if (kind == MasterNormal::smoothed)
          slave_search = std::make_unique<Search>(
            *input.slave, input.slave->largest_face(), 0., kind, input.solid->communicator);
      }

      void
      commit_positions(const Vector &u) override;

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &, double, std::vector<ContactRow> &rows) override;

      PairingMemory
      memory() const override
      {
        return {{}, facing.last_touched()};
      }

      void
      remember(const PairingMemory &memory) override
      {
        // Of all ranks; those of this one are enough.
        FacingFaces::Touched own;
        for (const CoveredFace &covered : slave_faces)
          if (const auto found = memory.of_faces.find(covered.slave.key);
              found != memory.of_faces.end())
            own.insert(*found);
        facing.remember(own);
        searched.clear();
        present.clear();
      }

      SearchWork
      search_work() const override
      {
        SearchWork work = search.work();
        if (slave_search)
          work += slave_search->work();
        return work;
      }

    private:
      /** Of a shape function over the covered part, times 1, the gap and the normal. */
      struct Integrals
      {
        double         area = 0.;
        Tensor<1, dim> gap, normal;
      };

      /** Sums over the slave faces around a node. */
      struct Sums : CoverSums
      {
        /** The area that is kept, in the reference state. */
        double reference = 0.;
        /** Integral of the slave position less that of the node. */
        Tensor<1, dim> lever;
        /** Integrals of master shapes: a dozen nodes or two, in the order in which they
         * came; areas that other slave nodes have left to this one, and it to them. */
        Stencil stencil, taken, left;

        /** Zero, with room for as many nodes. */
        void
        clear()
        {
          static_cast<CoverSums &>(*this) = CoverSums();
          reference                       = 0.;
          least = own = std::numeric_limits<double>::max();
          lever       = Tensor<1, dim>();
          for (Stencil *list : {&stencil, &taken, &left})
            list->clear();
        }

        static void
        add(Stencil &list, const Index node, const double value)
        {
          const auto found = std::find_if(list.begin(), list.end(), [node](const auto &entry) {
            return entry.node == node;
          });
          if (found != list.end())
            found->weight += value;
          else
            list.push_back({node, value});
        }
      };

      Search       search;
      FacingFaces  facing;
      MasterNormal kind;
      /** Rows of tied pairs act once and for all: there is nothing to be smooth. */
      const bool tied;
      /** Only for its exchange of faces, and only if they are smoothed. */
      std::unique_ptr<Search> slave_search;

      /** Of the last update: sums in the order of the owned nodes, and the slave faces
       * around them, in the order of `faces`. */
      std::vector<Sums>        sums;
      std::vector<CoveredFace> slave_faces;

      /** A face with nodes of this rank: its continuous basis, if it has hanging nodes, and
       * the places of the nodes to which its rows belong; negative: of another rank. */
      struct SlaveFace
      {
        const Face                      *face;
        const TraceBasis                *basis;
        std::array<int, Face::max_nodes> places;
        /** whole_areas() in the reference state. */
        std::array<double, Face::max_nodes> whole;
      };

      /** Places of the owned nodes, and the slave faces around them in the order of their
       * keys. */
      std::unordered_map<Index, int> places;
      std::vector<SlaveFace>         faces;

      /** Of the faces that the search knows, made when one is first asked for. */
      std::vector<std::optional<FaceGeometry>> geometries;

      /** Of the face at hand. */
      FullMatrix<double> to_basis, scratch, matrix;

      /** Displacements of the faces of this rank, slaves and then masters: of the last
       * update, if any, and when all facing faces were looked for last. */
      std::vector<Tensor<1, dim>> present, searched;

      const FaceGeometry &
      geometry(const Face &master);
      /** Look for facing faces anew if any node has moved so far that others may face.
       * Collective. */
      void
      watch_motion();
      /** Whether any face is not where it was at the last update: a step begins where the
       * one before has ended. Collective. */
      bool
      has_moved();
      void
      integrate();
      void
      add_face(const SlaveFace &face, CoveredFace &covered);
      /** Add what nodes leave to others. @param shares Of the face. */
      void
      add_shares(const SlaveFace &face, const Face &slave, const CoverShares &shares);
      /** The stencil of a row, and the sums as they belong to it. */
      static void
      finish_sums(Sums &sum);
    };

    const PairingRegistry::Entry<AveragedPairing> averaged_pairing_entry(
      "averaged",
      "averages over the slave faces with a dual basis; passes the patch test");



    void
    AveragedPairing::commit_positions(const Vector &u)
    {
      facing.commit(slave_faces);
      search.commit(&u);
      searched.clear();
      for (CoveredFace &covered : slave_faces)
        for (unsigned int m = 0; m < covered.slave.n_nodes(); ++m)
          for (unsigned int d = 0; d < dim; ++d)
            covered.slave.committed[m][d] = u(dim * covered.slave.nodes[m] + d);
    }



    const FaceGeometry &
    AveragedPairing::geometry(const Face &master)
    {
      auto &result = geometries[search.place(master)];
      if (!result)
        result.emplace(search.geometry(master));
      return *result;
    }



    void
    AveragedPairing::watch_motion()
    {
      const double square = facing.motion() * facing.motion();
      bool         close  = searched.size() == present.size();
      for (std::size_t i = 0; close && i < present.size(); ++i)
        close = (present[i] - searched[i]).norm_square() <= square;
      if (Utilities::MPI::min(close ? 1 : 0, input.solid->communicator) == 1)
        return;
      facing.look_anew();
      searched = present;
    }



    bool
    AveragedPairing::has_moved()
    {
      std::vector<Tensor<1, dim>> now;
      for (const Surface *surface : {input.slave, input.master})
        for (const Face &face : surface->owned_faces())
          now.insert(now.end(),
                     face.displacement.begin(),
                     face.displacement.begin() + face.n_nodes());
      const bool same = now == present;
      present.swap(now);
      return Utilities::MPI::min(same ? 1 : 0, input.solid->communicator) == 0;
    }



    void
    AveragedPairing::add_face(const SlaveFace &face, CoveredFace &covered)
    {
      const Face                    &slave   = covered.slave;
      const std::vector<FacingFace> &masters = covered.masters = facing.find(slave);
      if (masters.empty())
        return;
      const unsigned int n = slave.n_nodes();
      const FaceGeometry on_slave(slave, input.slave->exact_surface(slave), kind);

      // Integrals of the slave shapes times themselves, 1, gap, normal, and master shapes.
      using Values = std::array<double, Face::max_nodes>;
      std::array<Values, Face::max_nodes>              mass{};
      std::array<Integrals, Face::max_nodes>           integrals{};
      std::vector<std::array<Values, Face::max_nodes>> mixed(masters.size());
      double                                           least = std::numeric_limits<double>::max();
      Values                                           own;
      double                                           total = 0.;
      const Tensor<1, dim>                             plane = plane_normal(slave);
      own.fill(least);
      for (std::size_t f = 0; f < masters.size(); ++f)
        {
          const Face         &master    = *masters[f].master;
          const FaceGeometry &on_master = geometry(master);
          for (const OverlapPoint &point : masters[f].points)
            {
              const FaceShapes shapes(slave.degree, point.slave);
              const FaceShapes master_shapes(master.degree, point.master);
              const auto [x, normal] = on_master.position_and_normal(point.master, master_shapes);
              const double part =
                FacingPart(
                  facing_cosine(plane, normal, master, on_master.exact_surface(), point.master))
                  .value;
              if (part == 0.)
                continue;
              const Tensor<1, dim> gap = on_slave.position(point.slave, shapes) - x;
              least                    = std::min(least, gap * normal);
              if (point.weight == 0.)
                {
                  for (unsigned int j = 0; j < n; ++j)
                    if (is_node(shapes.value[j]))
                      own[j] = std::min(own[j], gap * normal);
                  continue;
                }
              const double weight = part * point.weight;
              total += weight;
              for (unsigned int j = 0; j < n; ++j)
                {
                  const double value = weight * shapes.value[j];
                  for (unsigned int k = 0; k < n; ++k)
                    mass[j][k] += value * shapes.value[k];
                  for (unsigned int m = 0; m < master.n_nodes(); ++m)
                    mixed[f][j][m] += value * master_shapes.value[m];
                  integrals[j].area += value;
                  integrals[j].gap += value * gap;
                  integrals[j].normal += value * normal;
                }
            }
        }

      if (total <= 0.)
        return;
      // The basis N~ of the continuous displacements is C^T N, and the dual one of the
      // covered part psi = D M~^-1 N~: the integrals with psi are these weights times
      // those with N.
      const TraceBasis *basis = face.basis;
      matrix.reinit(n, n, /*omit_default_initialization=*/true);
      Values areas{};
      for (unsigned int j = 0; j < n; ++j)
        {
          areas[j] = integrals[j].area;
          for (unsigned int k = 0; k < n; ++k)
            matrix(j, k) = mass[j][k];
        }
      if (basis)
        {
          areas = basis->apply(areas);
          to_basis.reinit(n, n);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int p = 0; p < n; ++p)
              to_basis(p, i) = basis->weights[i][p];
          scratch.reinit(n, n);
          scratch.triple_product(matrix, to_basis, to_basis, false, true);
          matrix = scratch;
        }
      const CoverShares  shares(n, areas, face.whole, /*gradual=*/!tied, /*with_derivative=*/false);
      FullMatrix<double> weights = shares.weights(matrix);
      if (basis)
        {
          scratch = weights;
          scratch.mmult(weights, to_basis);
        }
      const Values present = whole_areas(slave, basis, /*reference=*/false);

      for (unsigned int k = 0; k < n; ++k)
        {
          // Nodes of other ranks get their shares there.
          if (face.places[k] < 0)
            continue;
          Sums  &sum = sums[face.places[k]];
          Values psi{};
          for (unsigned int j = 0; j < n; ++j)
            psi[j] = weights(k, j);
          for (unsigned int j = 0; j < n; ++j)
            {
              sum.area += psi[j] * integrals[j].area;
              sum.gap += psi[j] * integrals[j].gap;
              sum.normal += psi[j] * integrals[j].normal;
            }
          for (std::size_t f = 0; f < masters.size(); ++f)
            for (unsigned int m = 0; m < masters[f].master->n_nodes(); ++m)
              {
                double value = 0.;
                for (unsigned int j = 0; j < n; ++j)
                  value += psi[j] * mixed[f][j][m];
                Sums::add(sum.stencil, masters[f].master->nodes[m], value);
              }
          const double kept = shares.share[k][k];
          sum.kept += kept;
          sum.given += areas[k] - kept;
          sum.reference += kept * face.whole[k] / present[k];
          sum.least = std::min(sum.least, least);
          sum.own   = std::min(sum.own, own[k]);
        }
      if (shares.partial)
        add_shares(face, slave, shares);
    }



    void
    AveragedPairing::add_shares(const SlaveFace &face, const Face &slave, const CoverShares &shares)
    {
      const unsigned int       n = slave.n_nodes();
      const std::vector<Index> nodes =
        face.basis ? std::vector<Index>(face.basis->nodes.begin(), face.basis->nodes.begin() + n)
                   : std::vector<Index>(slave.nodes.begin(), slave.nodes.begin() + n);
      std::array<Tensor<1, dim>, Face::max_nodes> x;
      for (unsigned int i = 0; i < n; ++i)
        x[i] = slave.reference[i] + slave.displacement[i];
      if (face.basis)
        {
          // The nodes that the face follows: x_i = sum C_ip x_p.
          FullMatrix<double> inverse(n, n);
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int p = 0; p < n; ++p)
              inverse(i, p) = face.basis->weights[i][p];
          inverse.gauss_jordan();
          const auto on_face = x;
          for (unsigned int p = 0; p < n; ++p)
            {
              x[p] = Tensor<1, dim>();
              for (unsigned int i = 0; i < n; ++i)
                x[p] += inverse(p, i) * on_face[i];
            }
        }
      for (unsigned int k = 0; k < n; ++k)
        if (face.places[k] >= 0)
          for (unsigned int i = 0; i < n; ++i)
            {
              if (i == k)
                continue;
              Sums &sum = sums[face.places[k]];
              if (const double area = shares.share[k][i]; area != 0.)
                {
                  Sums::add(sum.taken, nodes[i], area);
                  sum.lever += area * (x[i] - x[k]);
                }
              if (const double area = shares.share[i][k]; area != 0.)
                Sums::add(sum.left, nodes[i], area);
            }
    }



    void
    AveragedPairing::finish_sums(Sums &sum)
    {
      // Of two nodes that each leave something to the other on different faces, only the one
      // that takes more refers to the other: conditions must not depend on each other in a
      // cycle. It is rare: both must lie at the edge of the cover, on different sides.
      for (const StencilEntry &taken : sum.taken)
        {
          const auto back =
            std::find_if(sum.left.begin(), sum.left.end(), [&](const StencilEntry &entry) {
              return entry.node == taken.node;
            });
          if (back != sum.left.end() && std::abs(taken.weight) <= std::abs(back->weight))
            sum.kept += taken.weight;
          else
            Sums::add(sum.stencil, taken.node, -taken.weight);
        }
      std::sort(sum.stencil.begin(),
                sum.stencil.end(),
                [](const StencilEntry &a, const StencilEntry &b) { return a.node < b.node; });
    }



    void
    AveragedPairing::integrate()
    {
      for (Sums &sum : sums)
        sum.clear();

      std::vector<Point<dim>> positions;
      for (std::size_t f = 0; f < faces.size(); ++f)
        {
          const Face &now    = *faces[f].face;
          Face       &slave  = slave_faces[f].slave;
          slave.displacement = now.displacement;
          slave.normals      = now.normals;
          slave.edge_normals = now.edge_normals;
          slave.own_normals  = now.own_normals;
          for (unsigned int m = 0; m < slave.n_nodes(); ++m)
            {
              positions.push_back(slave.reference[m] + slave.displacement[m]);
              positions.push_back(slave.reference[m] + slave.committed[m]);
            }
        }
      search.update(positions);
      if (slave_search)
        {
          slave_search->update(positions);
          for (CoveredFace &covered : slave_faces)
            {
              const Face &complete       = *slave_search->face(covered.slave.key);
              covered.slave.normals      = complete.normals;
              covered.slave.edge_normals = complete.edge_normals;
              covered.slave.own_normals  = complete.own_normals;
              covered.slave.outer_edges  = complete.outer_edges;
            }
        }
      geometries.clear();
      geometries.resize(search.known_faces().size());
      watch_motion();
      for (std::size_t f = 0; f < faces.size(); ++f)
        add_face(faces[f], slave_faces[f]);
      for (Sums &sum : sums)
        finish_sums(sum);
    }



    void
    AveragedPairing::update(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      if (has_moved())
        integrate();
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow &row = rows[k];
          const Sums &sum = sums[k];
          row.stencil.clear();
          if (!sum.suffices(nodes[k].area))
            {
              row.has_partner = false;
              row.gap         = 0.;
              row.share       = 1.;
              row.lever       = Tensor<1, dim>();
              continue;
            }
          row.has_partner = true;
          for (const StencilEntry &entry : sum.stencil)
            if (std::abs(entry.weight) > 1e-14 * sum.area)
              row.stencil.push_back({entry.node, entry.weight / sum.kept});
          row.share                 = sum.area / sum.kept;
          row.lever                 = sum.lever / sum.area;
          row.normal                = sum.normal / sum.normal.norm();
          const Tensor<1, dim> mean = sum.gap / sum.area;
          const GapCorrection  correction(sum, mean * row.normal, nodes[k].size);
          row.gap_vector = row.share * (mean + correction.value * row.normal);
          row.gap        = row.gap_vector * row.normal;
          row.area       = std::min(sum.reference, nodes[k].area);
        }
    }



    void
    AveragedPairing::differentiate(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      AveragedDerivative derivative(search, slave_search.get(), /*gradual=*/!tied);
      for (const ContactRow &row : rows)
        if (row.was_active)
          derivative.add_row(row, sums[places.at(row.slave)]);
      for (const auto &[slave, masters] : slave_faces)
        if (const TraceBasis *basis = input.slave->trace(slave); derivative.wants(slave, basis))
          derivative.add_face(FaceGeometry(slave, input.slave->exact_surface(slave), kind),
                              basis,
                              masters_of(masters));
      derivative.finish();
      for (ContactRow &row : rows)
        row.derivative = row.was_active ? derivative.result(row.slave) : nullptr;
    }
  } // namespace
} // namespace Touchstone
