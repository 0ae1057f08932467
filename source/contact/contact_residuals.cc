// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_residuals.h>
#include <touchstone/contact/pairing/pointwise_row.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <optional>

// Consistency of contact between the slave nodes, for the estimate of contact forces
// (doc/theory.md 11).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Fields over the slave nodes of a pair, on the first component of each node. */
    struct NodalFields
    {
      Vector pressure, pressure_z, active, overlap;
    };

    /** What a point of a slave face meets: the row that a slave node would have there. */
    struct PointOfFace
    {
      const Face               *face;
      std::array<double, 2>     xi;
      FacePoint                 point;
      double                    area;
      std::optional<ContactRow> there{};
    };

    /** What is left of a vector at a node that planes of symmetry hold in some directions. */
    Tensor<1, dim>
    free_part(Tensor<1, dim> v, const std::vector<Tensor<1, dim>> *mirrors)
    {
      if (mirrors)
        for (const Tensor<1, dim> &normal : *mirrors)
          v -= (v * normal) * normal;
      return v;
    }

    NodalFields
    nodal_fields(const Contact &contact, const unsigned int p, const Vector &force)
    {
      const Solid       &solid = contact.solid_model();
      const Vector       zero(solid.zero_vector());
      Vector             pressure(zero), pressure_z(zero), active(zero), overlap(zero);
      const ContactPair &pair   = contact.pair(p);
      const double       part   = pair.part_of_overlap(contact.time());
      const auto        &planes = contact.planes_of_symmetry();
      for (std::size_t k = 0; k < pair.rows().size(); ++k)
        {
          const ContactRow &row   = pair.rows()[k];
          const RowState   &state = contact.state(row);
          if (row.between_nodes)
            continue;
          const Index first = dim * row.slave;
          overlap(first)    = part * pair.overlap(k);
          if (!state.active() || state.dropped() || row.area <= 0.)
            continue;
          const auto                         found = planes.find(row.slave);
          const std::vector<Tensor<1, dim>> *mirrors =
            found != planes.end() ? &found->second : nullptr;
          Tensor<1, dim> f;
          for (unsigned int d = 0; d < dim; ++d)
            f[d] = force(first + d);
          const Tensor<1, dim> n = free_part(row.normal, mirrors);
          active(first)          = 1.;
          pressure(first)        = state.lambda / row.area;
          if (n.norm_square() > 0.)
            pressure_z(first) = free_part(f, mirrors) * n / n.norm_square() / row.area;
        }
      NodalFields   result;
      Vector *const fields[]  = {&pressure, &pressure_z, &active, &overlap};
      Vector *const ghosted[] = {&result.pressure,
                                 &result.pressure_z,
                                 &result.active,
                                 &result.overlap};
      for (unsigned int i = 0; i < 4; ++i)
        {
          fields[i]->compress(VectorOperation::insert);
          solid.hanging.distribute(*fields[i]);
          *ghosted[i] = contact.with_ghosts(*fields[i]);
        }
      return result;
    }

    std::vector<PointOfFace>
    points_in_contact(const Surface &surface, const Vector &active, const unsigned int n)
    {
      const QGauss<2>          quadrature(n);
      std::vector<PointOfFace> result;
      for (const Face &face : surface.owned_faces())
        {
          double least = 1.;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            least = std::min(least, double(active(dim * face.nodes[m])));
          if (least < 1. - 1e-9)
            continue;
          for (unsigned int q = 0; q < quadrature.size(); ++q)
            {
              const std::array<double, 2> xi = {
                {2. * quadrature.point(q)[0] - 1., 2. * quadrature.point(q)[1] - 1.}};
              const FacePoint point = evaluate(face, surface.exact_surface(face), xi);
              result.push_back({&face,
                                xi,
                                point,
                                4. * quadrature.weight(q) *
                                  cross_product_3d(point.tangents[0], point.tangents[1]).norm()});
            }
        }
      return result;
    }

    /** Find what the points meet; surfaces of small sliding are in the reference state. Collective.
     */
    void
    find_partners(const Contact &contact, const unsigned int p, std::vector<PointOfFace> &points)
    {
      const ContactPair    &pair = contact.pair(p);
      std::optional<Search> search;
      if (pair.master())
        {
          search.emplace(*pair.master(),
                         4. * std::max(pair.slave().largest_face(), pair.master()->largest_face()),
                         pair.parameters().edge_tolerance,
                         pair.parameters().master_normal,
                         contact.communicator());
          std::vector<Point<dim>> positions;
          for (const PointOfFace &at : points)
            positions.push_back(at.point.x);
          search->update(positions);
        }
      for (PointOfFace &at : points)
        if (search)
          {
            SlavePoint where;
            where.x = where.start = at.point.x;
            where.normal          = at.point.normal();
            where.in_contact      = true;
            where.stays_at_end    = true;
            if (const auto partner = search->find(where))
              set_pointwise_row(*partner, at.point.x, at.there.emplace());
          }
        else if (const auto touched = pair.pairing().at(at.point.x, contact.time()))
          {
            at.there.emplace();
            at.there->normal     = touched->normal;
            at.there->gap_vector = touched->gap_vector;
          }
    }

    /** A displacement with values at all nodes that the points refer to. Collective. */
    Vector
    seen_by_points(const Contact &contact, const std::vector<PointOfFace> &points, const Vector &u)
    {
      const Solid &solid  = contact.solid_model();
      IndexSet     needed = solid.relevant;
      for (const PointOfFace &at : points)
        if (at.there)
          {
            for (unsigned int m = 0; m < at.face->n_nodes(); ++m)
              needed.add_range(dim * at.face->nodes[m], dim * at.face->nodes[m] + dim);
            for (const StencilEntry &entry : at.there->stencil)
              needed.add_range(dim * entry.node, dim * entry.node + dim);
          }
      needed.compress();
      Vector owned(u), result;
      solid.hanging.distribute(owned);
      result.reinit(solid.owned, needed, solid.communicator);
      result = owned;
      return result;
    }

    double
    interpolated(const PointOfFace &at, const FaceShapes &shapes, const Vector &field)
    {
      double result = 0.;
      for (unsigned int m = 0; m < at.face->n_nodes(); ++m)
        result += shapes.value[m] * field(dim * at.face->nodes[m]);
      return result;
    }

    /** Motion of the slave relative to the master along the normal. */
    double
    opening(const PointOfFace &at, const FaceShapes &shapes, const Vector &motion)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int m = 0; m < at.face->n_nodes(); ++m)
            result[d] += shapes.value[m] * motion(dim * at.face->nodes[m] + d);
          for (const StencilEntry &entry : at.there->stencil)
            result[d] -= entry.weight * motion(dim * entry.node + d);
        }
      return at.there->normal * result;
    }

    double
    residual_of_pair(const Contact     &contact,
                     const unsigned int p,
                     const Vector      &u,
                     const Vector      &z,
                     const Vector      &force)
    {
      const ContactPair       &pair   = contact.pair(p);
      const NodalFields        fields = nodal_fields(contact, p, force);
      std::vector<PointOfFace> points =
        points_in_contact(pair.slave(), fields.active, contact.solid_model().fe.degree + 2);
      find_partners(contact, p, points);
      const Vector all_u = seen_by_points(contact, points, u),
                   all_z = seen_by_points(contact, points, z);
      double sum         = 0.;
      for (const PointOfFace &at : points)
        if (at.there)
          {
            const FaceShapes shapes(at.face->degree, at.xi);
            double           gap =
              at.there->normal * at.there->gap_vector - interpolated(at, shapes, fields.overlap);
            if (pair.small_sliding())
              gap += opening(at, shapes, all_u);
            sum +=
              at.area * (interpolated(at, shapes, fields.pressure) * opening(at, shapes, all_z) +
                         interpolated(at, shapes, fields.pressure_z) * gap);
          }
      return sum;
    }
  } // namespace



  double
  contact_residuals(const Contact &contact, const Vector &u, const Vector &z)
  {
    const Solid &solid = contact.solid_model();
    Vector       force(z);
    solid.internal_force(z, force);
    solid.condense(force);
    double sum = 0.;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const ContactPair &pair = contact.pair(p);
          !pair.tied() && !pair.parameters().of_one_body())
        sum += residual_of_pair(contact, p, u, z, force);
    return Utilities::MPI::sum(sum, solid.communicator);
  }
} // namespace Touchstone
