// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/end_of_surface.h>
#include <touchstone/contact/pairing/normal_search.h>
#include <touchstone/contact/pairing/pointwise_row.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/pairing/slave_direction.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

// The pairing "inside-outside" of Wang and Nakamachi (1997), Int. J. Numer. Methods Engng 40: each
// slave node against the point at which the line along its own averaged normal meets the master
// surface (doc/theory.md 3.4). The point is unique, and needs no iteration on bilinear faces.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What a node meets in one of its directions. */
    struct MetFace
    {
      FacingPoint    facing;
      SlaveDirection direction;
      /** Cosine of the angle between the direction and the inward normal of the master there. */
      double opposed = 0.;
    };

    class InsideOutsidePairing : public Pairing
    {
    public:
      explicit InsideOutsidePairing(const PairingInput &input)
        : Pairing(input)
        , search(input)
        , met(input.slave->owned_nodes().size())
        , closest(met.size())
        , guesses(met.size(), 0)
      {
        search.commit(nullptr);
        for (const SurfaceNode &node : input.slave->owned_nodes())
          start.push_back(node.reference);
      }

      void
      commit_positions(const Vector &u) override
      {
        search.commit(&u);
        for (std::size_t k = 0; k < start.size(); ++k)
          start[k] = input.slave->position(input.slave->owned_nodes()[k], u);
      }

      void
      rollback() override
      {
        end.rollback();
      }

      void
      update(const Vector &u, double, std::vector<ContactRow> &rows) override;

      void
      differentiate(const Vector &u, double, std::vector<ContactRow> &rows) override;

      BeyondEdge
      beyond_edge() const override
      {
        return BeyondEdge::along_slave_normal;
      }

      SearchWork
      search_work() const override
      {
        return search.faces().work();
      }

    private:
      NormalSearch search;
      EndOfSurface end;
      /** Of the last update, in the order of the rows. */
      std::vector<std::optional<MetFace>> met;
      /** For nodes that meet nothing. */
      std::vector<std::optional<ContactPartner>> closest;
      /** Faces at which the search begins, indices in those of the search. */
      std::vector<std::size_t> guesses;
      /** Positions of the slave nodes at the start of the step. */
      std::vector<Point<dim>> start;

      std::optional<MetFace>
      meet(std::size_t k, const Point<dim> &x, const ContactRow &row, bool stays_at_end);
      std::optional<ContactPartner>
      find_closest(std::size_t k, const Point<dim> &x, const ContactRow &row) const;
      void
      differentiate(const MetFace                       &one,
                    Index                                slave,
                    ContactRow                          &row,
                    const std::vector<NormalDerivative> *of_face) const;
    };

    const PairingRegistry::Entry<InsideOutsidePairing>
      inside_outside_entry("inside-outside",
                           "each slave node against the point that the line along its own averaged "
                           "normal meets, unique and without iteration on plane faces.");



    // On a sharp edge the direction is that which looks at the master most, among those that meet
    // something near.
    std::optional<MetFace>
    InsideOutsidePairing::meet(const std::size_t k,
                               const Point<dim> &x,
                               const ContactRow &row,
                               const bool        stays_at_end)
    {
      std::size_t         &guess = guesses[k];
      std::vector<MetFace> found;
      double               nearest = std::numeric_limits<double>::max();
      for (const SlaveDirection &direction : slave_directions(*input.slave, row.slave))
        if (const auto one = search.look({x, direction.n, stays_at_end, guess, start[k]}))
          {
            found.push_back({*one, direction, -1. * (direction.n * one->at.point.normal())});
            nearest = std::min(nearest, std::abs(one->at.along));
          }
      // A node that lies on the surface sees the opposite side of the body from within, where it
      // looks along a face; what is deep in a body is far from all of its surface.
      const double near      = 0.5 * row.size;
      const auto   is_behind = [near](const MetFace &one) { return one.facing.at.along < -near; };
      if (std::any_of(found.begin(), found.end(), is_behind))
        if (const auto other = find_closest(k, x, row))
          nearest = std::min(nearest, x.distance(other->x));
      std::optional<MetFace> best;
      for (const MetFace &one : found)
        if (const double distance = std::abs(one.facing.at.along); distance <= 2. * nearest + near)
          {
            const double more = best ? one.opposed - best->opposed : 1.;
            if (more > Tolerances::touching ||
                (more > -Tolerances::touching && distance < std::abs(best->facing.at.along)))
              best = one;
          }
      if (best)
        guess = search.faces().exchange().index(*best->facing.face);
      return best;
    }



    // The normal of a node on an edge tilts as its face bends, and beside the end of the master the
    // line along it may lead past the surface in front of which, or behind which, the node is.
    // Where they touch both are one point.
    std::optional<ContactPartner>
    InsideOutsidePairing::find_closest(const std::size_t k,
                                       const Point<dim> &x,
                                       const ContactRow &row) const
    {
      SlavePoint point;
      point.x            = x;
      point.start        = start[k];
      point.normal       = input.slave->normal(row.slave);
      point.in_contact   = row.was_active;
      point.stays_at_end = end.stays(k, row);
      return search.faces().find(point);
    }



    void
    InsideOutsidePairing::update(const Vector &u, const double time, std::vector<ContactRow> &rows)
    {
      end.begin(time, rows);
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      std::vector<Point<dim>>         positions;
      for (const SurfaceNode &node : nodes)
        positions.push_back(input.slave->position(node, u));
      std::vector<Point<dim>> all(positions);
      all.insert(all.end(), start.begin(), start.end());
      search.update(all);
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          ContactRow &row = rows[k];
          met[k]          = meet(k, positions[k], row, end.stays(k, row));
          row.stencil.clear();
          row.has_partner = met[k].has_value();
          row.gap         = 0.;
          row.away        = 0.;
          closest[k].reset();
          if (!met[k])
            {
              row.away = search.least_distance(positions[k]);
              if (row.away < row.size)
                closest[k] = find_closest(k, positions[k], row);
              // Over a sharp edge it is not the direction to the edge.
              if (closest[k] && closest[k]->wedge != 0)
                closest[k].reset();
              if (closest[k])
                {
                  row.has_partner = true;
                  row.away        = 0.;
                  set_pointwise_row(*closest[k], positions[k], row);
                }
              else
                end.left(k, row);
              continue;
            }
          const FacingPoint &one = met[k]->facing;
          const FaceShapes   shapes(one.face->degree, one.at.xi);
          for (unsigned int m = 0; m < one.face->n_nodes(); ++m)
            if (std::abs(shapes.value[m]) > Tolerances::negligible_weight)
              row.stencil.push_back({one.face->nodes[m], shapes.value[m]});
          row.normal     = -1. * met[k]->direction.n;
          row.gap        = one.at.along;
          row.gap_vector = row.gap * row.normal;
        }
    }



    void
    InsideOutsidePairing::differentiate(const Vector &u,
                                        const double,
                                        std::vector<ContactRow> &rows)
    {
      // Facets do not depend on normals of the master.
      std::vector<const Face *> needed;
      const bool                follow = search.faces().exchange().follow_normals();
      for (std::size_t k = 0; k < met.size(); ++k)
        if (rows[k].was_active && met[k] && follow)
          needed.push_back(met[k]->facing.face);
        else if (rows[k].was_active && closest[k])
          add_faces(*closest[k], needed);
      // Collective.
      const auto of_normals = search.faces().normal_derivatives(needed);
      for (std::size_t k = 0; k < met.size(); ++k)
        {
          rows[k].derivative.reset();
          if (rows[k].was_active && closest[k])
            differentiate_pointwise_row(search.faces(),
                                        of_normals,
                                        *closest[k],
                                        input.slave->position(input.slave->owned_nodes()[k], u),
                                        rows[k]);
          if (!rows[k].was_active || !met[k])
            continue;
          const auto of_face = of_normals.find(met[k]->facing.face);
          differentiate(*met[k],
                        rows[k].slave,
                        rows[k],
                        of_face == of_normals.end() ? nullptr : &of_face->second);
        }
    }



    // The point stays on both: t_a dxi_a - n dl = dx_s + l dn - dx_m|_xi, doc/theory.md (34). On an
    // edge of the face a weight is zero but its derivative is not, so that all nodes of the face
    // belong to the stencil.
    void
    InsideOutsidePairing::differentiate(const MetFace                       &one,
                                        const Index                          slave,
                                        ContactRow                          &row,
                                        const std::vector<NormalDerivative> *of_face) const
    {
      const Face          &face     = *one.facing.face;
      const FaceGeometry   geometry = search.faces().geometry(face);
      const FacePosition   master   = FaceDifferentiator(geometry).position(one.facing.at.xi);
      const Tensor<1, dim> n        = one.direction.n;
      const double         l        = one.facing.at.along;
      Tensor<2, dim>       columns;
      for (unsigned int d = 0; d < dim; ++d)
        {
          columns[d][0] = master.point.tangents[0][d];
          columns[d][1] = master.point.tangents[1][d];
          columns[d][2] = -n[d];
        }
      const Tensor<2, dim> inverse = invert(columns);
      row.stencil.clear();
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        row.stencil.push_back({face.nodes[m], master.shapes.value[m]});

      RowDerivativeBuilder builder(face.n_nodes());
      RowDerivative       &result = *builder.result;
      const auto           move   = [&](const Index node, const Tensor<2, dim> &right) {
        const std::size_t    i  = builder.index(node);
        const Tensor<2, dim> by = inverse * right; // rows: dxi_1, dxi_2, dl
        result.gap_vector[i] -= outer_product(n, by[2]);
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          result.weights[m][i] +=
            master.shapes.gradient[m][0] * by[0] + master.shapes.gradient[m][1] * by[1];
        return i;
      };
      move(slave, Tensor<2, dim>(unit_symmetric_tensor<dim>()));
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        move(face.nodes[m], -1. * master.x_position[m]);
      if (of_face)
        for (const NormalDerivative &d : *of_face)
          move(d.node, -1. * (master.x_normal[d.m] * d.value));
      for (const auto &[node, turn] : input.slave->normal_derivative(one.direction.shares))
        {
          const std::size_t i = move(node, l * turn);
          result.gap_vector[i] -= l * turn;
          result.normal[i] -= turn;
        }
      row.derivative = builder.result;
    }
  } // namespace
} // namespace Touchstone
