// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <list>

// The pairing "pointwise": each slave node against the closest point of the master surface. It is
// simple, but does not pass the patch test (doc/theory.md 3). The second half of the file
// differentiates these rows for the consistent linearisation (doc/theory.md 4, equation (9)).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Node-to-surface: the stencil of a slave node are the shape functions of
     * the master face at the closest point. */
    class PointwisePairing : public Pairing
    {
    public:
      explicit PointwisePairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 // A node that has penetrated by more than the size of a face must still find
                 // the surface.
                 input.search_distance > 0.
                   ? input.search_distance
                   : 4. * std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 input.parameters->master_normal,
                 input.solid->communicator)
      {
        search.commit(nullptr);
        for (const SurfaceNode &node : input.slave->owned_nodes())
          start.push_back(node.reference);
        present_faces.resize(start.size());
        indices.resize(start.size());
      }

      void
      commit_positions(const Vector &u) override
      {
        search.commit(&u);
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          start[k] = input.slave->position(nodes[k], u);
      }

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &, double, std::vector<ContactRow> &rows) override;

      PairingMemory
      memory() const override
      {
        return {present_faces, {}};
      }

      void
      remember(const PairingMemory &memory) override
      {
        present_faces = memory.of_rows;
      }

      SearchWork
      search_work() const override
      {
        return search.work();
      }

    private:
      Search search;
      /** Of the last update, in the order of the rows. */
      std::vector<std::optional<ContactPartner>> partners;
      /** Keys of the faces that were the partners of the nodes in the last update. */
      std::vector<std::optional<std::uint64_t>> present_faces;
      /** And their indices in the search, where they are most likely found again. */
      std::vector<std::size_t> indices;
      /** Positions of the slave nodes at the start of the step. */
      std::vector<Point<dim>> start;
    };

    const PairingRegistry::Entry<PointwisePairing>
      pointwise_pairing_entry("pointwise", "node-to-surface by closest-point projection");



    /** Call @p use with all faces that a contact point belongs to. */
    template <class Use>
    void
    for_each(const ContactPartner &partner, const Use &use)
    {
      use(partner);
      for (const ContactPartner &other : partner.others)
        use(other);
    }



    /** Add the shape functions of the face at the contact point, times @p part. */
    void
    add_weights(const ContactPartner &partner, const double part, Stencil &stencil)
    {
      const FaceShapes shapes(partner.face->degree, partner.xi);
      for (unsigned int m = 0; m < partner.face->n_nodes(); ++m)
        // A node that lies on an edge or a node of the face depends on fewer master nodes.
        if (std::abs(shapes.value[m]) > Tolerances::negligible_weight)
          {
            const Index node = partner.face->nodes[m];
            const auto  entry =
              std::find_if(stencil.begin(), stencil.end(), [node](const StencilEntry &e) {
                return e.node == node;
              });
            if (entry == stencil.end())
              stencil.push_back({node, part * shapes.value[m]});
            else
              entry->weight += part * shapes.value[m];
          }
    }



    /** The row of a node at @p x. On an edge between faces it is the mean of those of all of them,
     * as normals jump there a little: with the row of one face a node that symmetry or matching
     * meshes put on the edge would have no balance on either side of it. */
    void
    set_row(const ContactPartner &partner, const Point<dim> &x, ContactRow &row)
    {
      const double part = 1. / (1. + partner.others.size());
      row.normal = row.gap_vector = Tensor<1, dim>();
      for_each(partner, [&](const ContactPartner &one) {
        add_weights(one, part, row.stencil);
        row.normal += part * one.normal;
        row.gap_vector += part * (x - one.x);
      });
      if (!partner.others.empty())
        row.normal /= row.normal.norm();
      row.gap = row.gap_vector * row.normal;
    }



    void
    PointwisePairing::update(const Vector &u, const double, std::vector<ContactRow> &rows)
    {
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      std::vector<Point<dim>>         positions;
      for (const SurfaceNode &node : nodes)
        positions.push_back(input.slave->position(node, u));
      // Master faces are needed where nodes are and where they began the step, for nodes that pass
      // through faces.
      std::vector<Point<dim>> all(positions);
      all.insert(all.end(), start.begin(), start.end());
      search.update(all);
      partners.resize(nodes.size());
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow      &row = rows[k];
          const SlavePoint point{positions[k],
                                 start[k],
                                 input.slave->normal(nodes[k].node),
                                 row.was_active,
                                 present_faces[k],
                                 indices[k]};
          const auto      &partner = partners[k] = search.find(point);
          // The face of this update is preferred in the next one, also in the next step and after a
          // restart (memory()).
          present_faces[k] =
            partner ? std::optional<std::uint64_t>(partner->face->key) : std::nullopt;
          if (partner)
            indices[k] = search.exchange().index(*partner->face);
          row.stencil.clear();
          if (!partner)
            {
              row.has_partner = false;
              row.gap         = 0.;
              row.away        = search.distance();
              continue;
            }
          row.has_partner = true;
          set_row(*partner, positions[k], row);
        }
    }



    /** Derivative of the coordinates xi of the closest point by the position (or normal) of one
     * node. */
    using CoordinateDerivative = std::array<Tensor<1, dim>, 2>;

    /**
     * The implicit derivative of the closest point: t_a . r = 0 gives
     * (t_a . t_b - r . x,ab) d xi_b = t_a . d r + r . d t_a at a fixed xi (doc/theory.md 4,
     * equation (9)). A coordinate that is held at an edge does not change.
     */
    class ClosestPointDerivative
    {
    public:
      ClosestPointDerivative(const FaceGeometry          &geometry,
                             const std::array<double, 2> &xi,
                             const FacePoint             &point,
                             const Tensor<1, dim>        &r)
      {
        // The matrix of equation (9), which is also the Hessian of the projection.
        const auto second = geometry.second_derivatives(xi);
        double     a[2][2];
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            a[i][j] = point.tangents[i] * point.tangents[j] - r * second[i + j];
        bool free[2];
        for (unsigned int i = 0; i < 2; ++i)
          {
            const double scale = point.tangents[i].norm_square();
            // Free in the interior, or at an edge if the node lies on the inner side of it.
            free[i] = std::abs(xi[i]) < 1. || xi[i] * (point.tangents[i] * r) <= 1e-12 * scale;
            // At a centre of curvature the closest point is not unique.
            free[i] = free[i] && a[i][i] > 1e-6 * scale;
          }
        const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
        if (free[0] && free[1])
          {
            // Nearly singular: xi has no usable derivative and is taken as fixed.
            if (det < 1e-6 * a[0][0] * a[1][1])
              return;
            inverse[0][0] = a[1][1] / det;
            inverse[1][1] = a[0][0] / det;
            inverse[0][1] = inverse[1][0] = -a[0][1] / det;
          }
        else
          for (unsigned int i = 0; i < 2; ++i)
            if (free[i])
              inverse[i][i] = 1. / a[i][i];
      }

      CoordinateDerivative
      operator()(const Tensor<1, dim> &right_0, const Tensor<1, dim> &right_1) const
      {
        return {{inverse[0][0] * right_0 + inverse[0][1] * right_1,
                 inverse[1][0] * right_0 + inverse[1][1] * right_1}};
      }

    private:
      double inverse[2][2] = {{0., 0.}, {0., 0.}};
    };



    /**
     * The derivative of one row: each node has a direct effect on gap vector and normal at a fixed
     * xi, and one through the coordinates xi of the closest point (doc/theory.md 4, "Derivatives of
     * rows").
     */
    class PointwiseRowDerivative
    {
    public:
      /** @param gap_vector r, length. */
      PointwiseRowDerivative(const FaceGeometry   &geometry,
                             const ContactPartner &partner,
                             const Tensor<1, dim> &gap_vector)
        : geometry(geometry)
        , partner(partner)
        , r(gap_vector)
        , master(FaceDifferentiator(geometry).at(partner.xi))
        , closest(geometry, partner.xi, master.point, r)
        , by_slave(closest(master.point.tangents[0], master.point.tangents[1]))
        , by_gap_vector(partner.wedge * normalisation_derivative(r))
      {
      }

      /** Whether the weight of node @p m of the master face changes with the slave node. */
      bool
      weight_changes(const unsigned int m) const
      {
        return (master.shapes.gradient[m][0] * by_slave[0] +
                master.shapes.gradient[m][1] * by_slave[1])
                 .norm() > 0.;
      }

      /** @param of_normals Derivatives of the nodal normals of the face, or null. */
      /** Add this derivative times @p part. */
      void
      compute(const Index                          slave,
              const Stencil                       &stencil,
              const double                         part,
              const std::vector<NormalDerivative> *of_normals,
              RowDerivativeBuilder                &builder) const;

    private:
      const FaceGeometry          &geometry;
      const ContactPartner        &partner;
      const Tensor<1, dim>         r;
      const FaceDerivative         master;
      const ClosestPointDerivative closest;
      const CoordinateDerivative   by_slave;
      /** Over an edge the normal is the direction of the gap vector; zero elsewhere. */
      const Tensor<2, dim> by_gap_vector;

      /** d xi, where the point at a fixed xi moves by @p x and its tangents by the others. */
      CoordinateDerivative
      coordinates(const Tensor<2, dim> &x,
                  const Tensor<2, dim> &t_0,
                  const Tensor<2, dim> &t_1) const
      {
        const auto &t = master.point.tangents;
        return closest(r * t_0 - t[0] * x, r * t_1 - t[1] * x);
      }

      /** Add the effect of a node: that on gap vector and normal at a fixed xi, and that on xi.
       * @param local Numbers on the face of the nodes of the stencil.
       * @param chain What the node moves, by its position; null for itself. */
      void
      add(const Index                      node,
          const Tensor<2, dim>            &gap_vector,
          const Tensor<2, dim>            &normal,
          const CoordinateDerivative      &xi,
          const Tensor<2, dim>            *chain,
          const std::vector<unsigned int> &local,
          const double                     part,
          RowDerivativeBuilder            &builder) const;
    };



    void
    PointwiseRowDerivative::add(const Index                      node,
                                const Tensor<2, dim>            &gap_vector,
                                const Tensor<2, dim>            &normal,
                                const CoordinateDerivative      &xi,
                                const Tensor<2, dim>            *chain,
                                const std::vector<unsigned int> &local,
                                const double                     part,
                                RowDerivativeBuilder            &builder) const
    {
      Tensor<2, dim> d_gap = gap_vector, d_normal = normal;
      for (unsigned int a = 0; a < 2; ++a)
        {
          // Total change: at fixed xi, plus that of the contact point along the face.
          d_gap -= outer_product(master.point.tangents[a], xi[a]);
          d_normal += outer_product(master.normal_xi[a], xi[a]);
        }
      // In the wedge n = +-r/|r|, which depends on the gap vector alone.
      if (partner.wedge != 0)
        d_normal = by_gap_vector * d_gap;
      const unsigned int i = builder.index(node);
      d_gap *= part;
      d_normal *= part;
      builder.result->gap_vector[i] += chain ? d_gap * *chain : d_gap;
      builder.result->normal[i] += chain ? d_normal * *chain : d_normal;
      for (std::size_t m = 0; m < local.size(); ++m)
        if (local[m] < geometry.face().n_nodes())
          {
            const auto          &gradient = master.shapes.gradient[local[m]];
            const Tensor<1, dim> d_weight = part * (gradient[0] * xi[0] + gradient[1] * xi[1]);
            builder.result->weights[m][i] += chain ? d_weight * *chain : d_weight;
          }
    }



    void
    PointwiseRowDerivative::compute(const Index                          slave,
                                    const Stencil                       &stencil,
                                    const double                         part,
                                    const std::vector<NormalDerivative> *of_normals,
                                    RowDerivativeBuilder                &builder) const
    {
      const Face               &face = geometry.face();
      std::vector<unsigned int> local;
      // Nodes of other faces on whose edge the slave node lies are not on this one.
      for (const StencilEntry &entry : stencil)
        local.push_back(
          std::find(face.nodes.begin(), face.nodes.begin() + face.n_nodes(), entry.node) -
          face.nodes.begin());
      const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
      // The slave node changes r directly and xi over the projection, not the normal at fixed xi.
      // Master nodes move the point and its tangents; nodes around them act over the averaged
      // normals.
      add(slave, identity, {}, by_slave, nullptr, local, part, builder);
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        add(face.nodes[m],
            -1. * master.x_position[m],
            master.normal_position[m],
            coordinates(master.x_position[m],
                        master.tangent_position[0][m],
                        master.tangent_position[1][m]),
            nullptr,
            local,
            part,
            builder);
      if (of_normals && (partner.wedge == 0 || geometry.smooth()))
        for (const NormalDerivative &d : *of_normals)
          add(d.node,
              -1. * master.x_normal[d.m],
              master.normal_normal[d.m],
              coordinates(master.x_normal[d.m],
                          master.tangent_normal[0][d.m],
                          master.tangent_normal[1][d.m]),
              &d.value,
              local,
              part,
              builder);
    }



    void
    PointwisePairing::differentiate(const Vector &u, const double, std::vector<ContactRow> &rows)
    {
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      std::vector<const Face *>       needed;
      for (std::size_t k = 0; k < rows.size(); ++k)
        if (rows[k].was_active)
          for_each(*partners[k], [&](const ContactPartner &one) { needed.push_back(one.face); });
      // Collective: also without active rows on this rank.
      const auto normal_derivatives = search.normal_derivatives(needed);

      for (std::size_t k = 0; k < rows.size(); ++k)
        {
          ContactRow &row = rows[k];
          row.derivative.reset();
          if (!row.was_active)
            continue;
          const double                      part = 1. / (1. + partners[k]->others.size());
          const Point<dim>                  x    = input.slave->position(nodes[k], u);
          Tensor<1, dim>                    mean;
          std::list<FaceGeometry>           geometries;
          std::list<PointwiseRowDerivative> derivatives;
          for_each(*partners[k], [&](const ContactPartner &one) {
            mean += part * one.normal;
            geometries.push_back(search.geometry(*one.face));
            derivatives.emplace_back(geometries.back(), one, x - one.x);
            // On an edge of the face a weight is zero but its derivative is not: the node belongs
            // to the stencil for the derivative.
            for (unsigned int m = 0; m < one.face->n_nodes(); ++m)
              if (const Index node = one.face->nodes[m];
                  derivatives.back().weight_changes(m) &&
                  std::none_of(row.stencil.begin(), row.stencil.end(), [node](const auto &entry) {
                    return entry.node == node;
                  }))
                row.stencil.push_back({node, 0.});
          });
          RowDerivativeBuilder builder(row.stencil.size());
          auto                 derivative = derivatives.begin();
          for_each(*partners[k], [&](const ContactPartner &one) {
            const auto of_normals = normal_derivatives.find(one.face);
            (derivative++)
              ->compute(row.slave,
                        row.stencil,
                        part,
                        of_normals == normal_derivatives.end() ? nullptr : &of_normals->second,
                        builder);
          });
          if (part < 1.)
            for (Tensor<2, dim> &normal : builder.result->normal)
              normal = normalisation_derivative(mean) * normal;
          row.derivative = builder.result;
        }
    }
  } // namespace
} // namespace Touchstone
