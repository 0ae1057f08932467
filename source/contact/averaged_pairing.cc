#include <touchstone/contact/averaged_derivative.h>
#include <touchstone/contact/facing_faces.h>
#include <touchstone/contact/pairing.h>

#include <deal.II/lac/full_matrix.h>

#include <list>
#include <map>
#include <unordered_map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /**
     * Rows that pass the patch test: the stencil of a slave node are averages of
     * the master shapes, weighted with the dual basis of its slave faces. With
     * int psi_s N_t = delta_st int N_s the gap of the slave side is that of the
     * node alone, so a row keeps its form.
     * A face with hanging nodes takes the basis of the continuous displacements
     * instead of its shape functions, and rows go to the nodes that these follow.
     * Wohlmuth (2000), SIAM J. Numer. Anal. 38; on faces that are covered only in
     * part the basis is dual on the covered part: Popp, Seitz, Gee and Wall (2013),
     * Comput. Methods Appl. Mech. Engng 264.
     */
    class AveragedPairing : public Pairing
    {
    public:
      explicit AveragedPairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 input.parameters->search_distance > 0.
                   ? input.parameters->search_distance
                   : std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 master_normal(input.parameters->master_normal),
                 input.solid->communicator)
        , facing(search)
        , kind(master_normal(input.parameters->master_normal))
      {
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
        for (const Covered &covered : slave_faces)
          if (const auto found = memory.of_faces.find(covered.slave.key);
              found != memory.of_faces.end())
            own.insert(*found);
        facing.remember(own);
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
      /** Sums over the slave faces around a node. */
      struct Sums
      {
        double                  area = 0.;
        std::map<Index, double> stencil;
        Tensor<1, dim>          gap, normal;
      };

      Search       search;
      FacingFaces  facing;
      MasterNormal kind;
      /** Only for its exchange of faces, and only if they are smoothed. */
      std::unique_ptr<Search> slave_search;
      /** Displacement with ghosts at the start of the step; empty: none. */
      Vector start;

      /** A slave face around an owned node, and the master faces that cover it. */
      struct Covered
      {
        Face                      slave;
        std::vector<const Face *> masters;
      };

      /** Of the last update: sums by owned node, and the slave faces around them. */
      std::unordered_map<Index, Sums> sums;
      std::vector<Covered>            slave_faces;

      void
      add_face(Covered &covered);
    };

    const PairingRegistry::Entry<AveragedPairing>
      entry("averaged", "averages over the slave faces with a dual basis; passes the patch test");



    void
    AveragedPairing::commit_positions(const Vector &u)
    {
      std::vector<const Face *> faces;
      for (const Covered &covered : slave_faces)
        faces.push_back(&covered.slave);
      facing.commit(faces);
      search.commit(&u);
      start = u;
    }



    void
    AveragedPairing::add_face(Covered &covered)
    {
      const Face                                                &slave = covered.slave;
      const unsigned int                                         n     = slave.n_nodes();
      std::vector<std::pair<const FaceGeometry *, OverlapPoint>> points;
      std::list<FaceGeometry>                                    geometries;
      for (const FacingFace &face : facing.find(slave))
        {
          covered.masters.push_back(face.master);
          geometries.push_back(search.geometry(*face.master));
          for (const OverlapPoint &point : face.points)
            points.emplace_back(&geometries.back(), point);
        }
      if (points.empty())
        return;

      const TraceBasis *basis  = input.slave->trace(slave);
      const auto        values = [&](const OverlapPoint &point) {
        const FaceShapes shapes(slave.degree, point.slave);
        return basis ? basis->apply(shapes.value) : shapes.value;
      };

      // The dual basis psi = D M^-1 N of the covered part.
      FullMatrix<double>  mass(n, n);
      std::vector<double> area(n, 0.);
      for (const auto &[master, point] : points)
        {
          const auto shapes = values(point);
          for (unsigned int i = 0; i < n; ++i)
            {
              area[i] += point.weight * shapes[i];
              for (unsigned int j = 0; j < n; ++j)
                mass(i, j) += point.weight * shapes[i] * shapes[j];
            }
        }
      // A sliver of coverage leaves the mass matrix singular to working precision:
      // a trace of the full face's matrix keeps it regular.
      double trace = 0.;
      for (unsigned int i = 0; i < n; ++i)
        trace += mass(i, i);
      for (unsigned int i = 0; i < n; ++i)
        mass(i, i) += 1e-14 * trace;
      mass.gauss_jordan();

      const FaceGeometry on_slave(slave, input.slave->exact_surface(slave), kind);
      for (const auto &[master, point] : points)
        {
          const auto           slave_shapes = values(point);
          const Face          &face         = master->face();
          const FaceShapes     master_shapes(face.degree, point.master);
          const Tensor<1, dim> gap =
            on_slave.evaluate(point.slave).x - master->evaluate(point.master).x;
          const Tensor<1, dim> normal = master->normal(point.master);
          for (unsigned int i = 0; i < n; ++i)
            {
              double psi = 0.;
              for (unsigned int j = 0; j < n; ++j)
                psi += area[i] * mass(i, j) * slave_shapes[j];
              Sums &sum = sums[basis ? basis->nodes[i] : slave.nodes[i]];
              psi *= point.weight;
              sum.area += psi;
              sum.gap += psi * gap;
              sum.normal += psi * normal;
              for (unsigned int m = 0; m < face.n_nodes(); ++m)
                sum.stencil[face.nodes[m]] += psi * master_shapes.value[m];
            }
        }
    }



    void
    AveragedPairing::update(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      sums.clear();
      for (const SurfaceNode &node : nodes)
        sums[node.node];

      // Faces of owned and of ghost cells that touch an owned node: their sums are
      // complete here without another rank.
      slave_faces.clear();
      std::vector<Point<dim>> positions;
      for (const auto *list : {&input.slave->owned_faces(), &input.slave->neighbour_faces()})
        for (const Face &face : *list)
          {
            bool              touches = false;
            const TraceBasis *basis   = input.slave->trace(face);
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              touches = touches || sums.count(basis ? basis->nodes[m] : face.nodes[m]) > 0;
            if (!touches)
              continue;
            slave_faces.push_back({face, {}});
            Face &slave = slave_faces.back().slave;
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              {
                slave.committed[m] = Tensor<1, dim>();
                if (start.size() > 0)
                  for (unsigned int d = 0; d < dim; ++d)
                    slave.committed[m][d] = start(dim * face.nodes[m] + d);
                positions.push_back(face.reference[m] + face.displacement[m]);
                positions.push_back(face.reference[m] + slave.committed[m]);
              }
          }
      std::sort(slave_faces.begin(), slave_faces.end(), [](const Covered &a, const Covered &b) {
        return a.slave.key < b.slave.key;
      });
      search.update(positions);
      if (slave_search)
        {
          slave_search->update(positions);
          for (Covered &covered : slave_faces)
            {
              const Face &complete       = *slave_search->face(covered.slave.key);
              covered.slave.normals      = complete.normals;
              covered.slave.edge_normals = complete.edge_normals;
              covered.slave.outer_edges  = complete.outer_edges;
            }
        }
      // Nodes that are not owned here get a share, too, which is not used.
      for (Covered &covered : slave_faces)
        add_face(covered);

      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow &row = rows[k];
          const Sums &sum = sums.at(nodes[k].node);
          row.stencil.clear();
          if (sum.area < 1e-6 * nodes[k].area || sum.normal.norm() == 0.)
            {
              row.status = ContactStatus::no_partner;
              row.gap    = 0.;
              continue;
            }
          if (row.status == ContactStatus::no_partner)
            row.status = ContactStatus::open;
          for (const auto &[node, value] : sum.stencil)
            if (std::abs(value) > 1e-14 * sum.area)
              row.stencil.push_back({node, value / sum.area});
          row.normal     = sum.normal / sum.normal.norm();
          row.gap_vector = sum.gap / sum.area;
          row.gap        = row.gap_vector * row.normal;
          row.area       = std::min(sum.area, nodes[k].area);
        }
    }



    void
    AveragedPairing::differentiate(const Vector &, const double, std::vector<ContactRow> &rows)
    {
      AveragedDerivative derivative(search, slave_search.get());
      for (const ContactRow &row : rows)
        if (row.active())
          {
            const Sums &sum = sums.at(row.slave);
            derivative.add_row(row, sum.area, sum.normal);
          }
      for (const auto &[slave, masters] : slave_faces)
        if (const TraceBasis *basis = input.slave->trace(slave); derivative.wants(slave, basis))
          derivative.add_face(FaceGeometry(slave, input.slave->exact_surface(slave), kind),
                              basis,
                              masters);
      derivative.finish();
      for (ContactRow &row : rows)
        row.derivative = row.active() ? derivative.result(row.slave) : nullptr;
    }
  } // namespace
} // namespace Touchstone
