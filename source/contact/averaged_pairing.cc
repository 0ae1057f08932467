#include <touchstone/contact/averaged_derivative.h>
#include <touchstone/contact/overlap.h>
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
      {
      }

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &, double, std::vector<ContactRow> &rows) override;

    private:
      /** Sums over the slave faces around a node. */
      struct Sums
      {
        double                  area = 0.;
        std::map<Index, double> stencil;
        Tensor<1, dim>          gap, normal;
      };

      Search search;
      /** Of the last update: sums by owned node, and the slave faces around them. */
      std::unordered_map<Index, Sums> sums;
      std::vector<const Face *>       slave_faces;

      void
      for_each_master(const Face &slave, const std::function<void(const Face &)> &visit) const;
      void
      add_face(const Face &slave);
    };

    const PairingRegistry::Entry<AveragedPairing>
      entry("averaged", "averages over the slave faces with a dual basis; passes the patch test");



    void
    AveragedPairing::for_each_master(const Face                              &slave,
                                     const std::function<void(const Face &)> &visit) const
    {
      Point<dim> lower = slave.reference[0] + slave.displacement[0], upper = lower;
      for (unsigned int m = 1; m < slave.n_nodes(); ++m)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double x = slave.reference[m][d] + slave.displacement[m][d];
            lower[d]       = std::min(lower[d], x);
            upper[d]       = std::max(upper[d], x);
          }
      search.for_each_near(BoundingBox<dim>({lower, upper}),
                           evaluate(slave, nullptr, {{0., 0.}}).normal(),
                           visit);
    }



    void
    AveragedPairing::add_face(const Face &slave)
    {
      const unsigned int                                         n = slave.n_nodes();
      std::vector<std::pair<const FaceGeometry *, OverlapPoint>> points;
      std::list<FaceGeometry>                                    geometries;
      for_each_master(slave, [&](const Face &master) {
        const auto common = overlap(slave, master);
        if (common.empty())
          return;
        geometries.push_back(search.geometry(master));
        for (const OverlapPoint &point : common)
          points.emplace_back(&geometries.back(), point);
      });
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

      const AnalyticSurface *slave_exact = input.slave->exact_surface(slave);
      for (const auto &[master, point] : points)
        {
          const auto           slave_shapes = values(point);
          const Face          &face         = master->face();
          const FaceShapes     master_shapes(face.degree, point.master);
          const Tensor<1, dim> gap =
            evaluate(slave, slave_exact, point.slave).x - master->evaluate(point.master).x;
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
            slave_faces.push_back(&face);
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              positions.push_back(face.reference[m] + face.displacement[m]);
          }
      std::sort(slave_faces.begin(), slave_faces.end(), [](const Face *a, const Face *b) {
        return a->key < b->key;
      });
      search.update(positions);
      // Nodes that are not owned here get a share, too, which is not used.
      for (const Face *face : slave_faces)
        add_face(*face);

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
      AveragedDerivative derivative(search);
      for (const ContactRow &row : rows)
        if (row.active())
          {
            const Sums &sum = sums.at(row.slave);
            derivative.add_row(row, sum.area, sum.normal);
          }
      for (const Face *face : slave_faces)
        if (derivative.wants(*face, input.slave->trace(*face)))
          {
            std::vector<const Face *> masters;
            for_each_master(*face, [&](const Face &master) { masters.push_back(&master); });
            derivative.add_face(*face,
                                input.slave->trace(*face),
                                input.slave->exact_surface(*face),
                                masters);
          }
      derivative.finish();
      for (ContactRow &row : rows)
        row.derivative = row.active() ? derivative.result(row.slave) : nullptr;
    }
  } // namespace
} // namespace Touchstone
