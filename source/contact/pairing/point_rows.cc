// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/point_rows.h>
#include <touchstone/contact/pairing/pointwise_row.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <cmath>
#include <map>

// Rows of material points inside slave faces (doc/theory.md 4.2). A point
// x = sum_a W_a x_a has the row that a slave node would have there, pointwise; all of it is divided
// by the weight of one of its nodes, so that it keeps the form of the rows of nodes.
namespace Touchstone
{
  using namespace dealii;

  PointRows::PointRows(const PairingInput &input, const bool with_edges)
    : input(input)
    , with_edges(with_edges)
  {
    const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      numbers[nodes[k].node] = k;
  }



  void
  PointRows::set(const std::vector<MaterialPoint> &points)
  {
    for (const OwnPoint &point : own)
      if (const MaterialPoint &p = *point.point;
          std::none_of(points.begin(), points.end(), [&](const MaterialPoint &other) {
            return coincide(other, p) && other.nodes[other.slave] == p.nodes[p.slave];
          }))
        released.push_back(point.row);
    own.clear();
    all = points;
    if (input.master && !search && !all.empty())
      search.emplace(*input.master,
                     input.search_distance > 0.
                       ? input.search_distance
                       : 4. * std::max(input.slave->largest_face(), input.master->largest_face()),
                     input.parameters->edge_tolerance,
                     input.parameters->master_normal,
                     input.solid->communicator);
    for (const MaterialPoint &point : all)
      if (const auto k = numbers.find(point.nodes[point.slave]); k != numbers.end())
        {
          const auto places = places_of(point);
          const auto tangents =
            std::make_shared<const std::array<Stencil, 2>>(input.slave->material_tangents(places));
          own.push_back({&point, places, numbers.size() + k->second, tangents});
        }
  }



  // A point on an edge belongs to none of the faces more than to the others: which of them has
  // found it must not matter. The rank that has the row knows all faces around its node.
  Surface::PointOnFaces
  PointRows::places_of(const MaterialPoint &point) const
  {
    std::map<std::uint64_t, std::pair<const Face *, std::array<double, 2>>> places;
    const Face                                                             *found = nullptr;
    for (const std::vector<Face> *const known :
         {&input.slave->owned_faces(), &input.slave->neighbour_faces()})
      for (const Face &face : *known)
        {
          if (const auto xi = coordinates_on(face, point))
            places[face.key] = {&face, *xi};
          if (face.key == point.face)
            found = &face;
        }
    // Nodes that others follow on the edge of a larger face are none of the face itself.
    if (places.empty())
      return {{found, point.xi}};
    Surface::PointOnFaces result;
    for (const auto &[key, place] : places)
      result.push_back(place);
    return result;
  }



  std::pair<Point<dim>, Tensor<1, dim>>
  PointRows::position(const OwnPoint &point) const
  {
    Point<dim>     x;
    Tensor<1, dim> normal;
    for (const auto &[face, xi] : point.places)
      {
        const FacePoint there = evaluate(*face, input.slave->exact_surface(*face), xi);
        x += there.x / double(point.places.size());
        normal += there.normal();
      }
    return {x, normal / normal.norm()};
  }



  ContactRow
  PointRows::row_there(const OwnPoint &point, const Pairing &of_nodes, const double time) const
  {
    ContactRow there;
    // No node: the derivative is that by the position of the point.
    there.slave = invalid_index;
    if (point.partner)
      set_pointwise_row(*point.partner, point.x, there);
    else if (const auto touched = of_nodes.at(point.x, time))
      {
        there.normal     = touched->normal;
        there.gap_vector = touched->gap_vector;
      }
    return there;
  }



  void
  PointRows::set_row(const OwnPoint &point, const ContactRow &there, ContactRow &row)
  {
    const MaterialPoint &p = *point.point;
    row.has_partner        = true;
    row.touches            = there.touches;
    row.share              = 1. / p.weights[p.slave];
    row.normal             = there.normal;
    row.gap_vector         = row.share * there.gap_vector;
    row.gap                = row.gap_vector * row.normal;
    row.lever              = point.x - row.position;
    row.stencil.clear();
    for (const StencilEntry &entry : there.stencil)
      row.stencil.push_back({entry.node, row.share * entry.weight});
    for (unsigned int a = 0; a < p.n; ++a)
      if (a != p.slave && std::abs(p.weights[a]) > Tolerances::negligible_weight)
        row.stencil.push_back({p.nodes[a], -row.share * p.weights[a]});
    // A point has no area, and there is no pressure.
    row.area = 0.;
    row.away = 0.;
    // Which of the nodes has the row must not matter to what turns with the surface.
    row.tangents = point.tangents;
  }



  void
  PointRows::release(std::vector<ContactRow> &rows)
  {
    for (const std::size_t k : released)
      rows[k].was_active = false;
    released.clear();
  }



  void
  PointRows::update(const Pairing &of_nodes, const double time, std::vector<ContactRow> &rows)
  {
    for (std::size_t k = numbers.size(); k < rows.size(); ++k)
      {
        ContactRow &row = rows[k];
        row.motion      = of_nodes.motion(time);
        row.tangents.reset();
        if (with_edges)
          continue;
        row.has_partner = false;
        row.stencil.clear();
        row.gap   = 0.;
        row.area  = 0.;
        row.share = 1.;
        row.lever = Tensor<1, dim>();
      }
    // The same on all ranks.
    if (all.empty())
      return;
    std::vector<Point<dim>> positions;
    for (OwnPoint &point : own)
      {
        point.x = position(point).first;
        positions.push_back(point.x);
      }
    if (search)
      search->update(positions);
    for (OwnPoint &point : own)
      {
        ContactRow &row = rows[point.row];
        // An edge or a vertex may be near the node and open.
        point.present   = true;
        row.has_partner = false;
        if (search)
          {
            SlavePoint where;
            where.x = where.start = point.x;
            where.normal          = position(point).second;
            where.in_contact      = row.was_active;
            where.stays_at_end    = row.was_active;
            point.partner         = search->find(where);
            point.present         = point.partner.has_value();
          }
        if (point.present)
          set_row(point, row_there(point, of_nodes, time), row);
      }
  }



  std::shared_ptr<const RowDerivative>
  PointRows::derivative_of_row(const MaterialPoint &point, const ContactRow &there)
  {
    const RowDerivative &d     = *there.derivative;
    const double         share = 1. / point.weights[point.slave];
    std::size_t          n     = there.stencil.size();
    for (unsigned int a = 0; a < point.n; ++a)
      n += (a != point.slave && std::abs(point.weights[a]) > Tolerances::negligible_weight);
    RowDerivativeBuilder builder(n);
    const auto           add = [&](const Index node, const std::size_t k, const double weight) {
      const std::size_t i = builder.index(node);
      builder.result->normal[i] += weight * d.normal[k];
      builder.result->gap_vector[i] += share * weight * d.gap_vector[k];
      for (std::size_t m = 0; m < there.stencil.size(); ++m)
        builder.result->weights[m][i] += share * weight * d.weights[m][k];
    };
    for (std::size_t k = 0; k < d.nodes.size(); ++k)
      if (d.nodes[k] != invalid_index)
        add(d.nodes[k], k, 1.);
      else
        // The point moves with the nodes of its face, whose weights are constants.
        for (unsigned int a = 0; a < point.n; ++a)
          add(point.nodes[a], k, point.weights[a]);
    return builder.result;
  }



  void
  PointRows::differentiate(const Pairing           &of_nodes,
                           const double             time,
                           std::vector<ContactRow> &rows) const
  {
    if (!with_edges)
      for (std::size_t k = numbers.size(); k < rows.size(); ++k)
        rows[k].derivative.reset();
    if (all.empty())
      return;
    std::vector<const Face *> needed;
    for (const OwnPoint &point : own)
      if (point.present && point.partner && rows[point.row].was_active)
        add_faces(*point.partner, needed);
    const auto of_normals =
      search ? search->normal_derivatives(needed) : decltype(search->normal_derivatives(needed))();
    for (const OwnPoint &point : own)
      {
        ContactRow &row = rows[point.row];
        if (!point.present || !row.was_active)
          continue;
        ContactRow there = row_there(point, of_nodes, time);
        if (point.partner)
          differentiate_pointwise_row(*search, of_normals, *point.partner, point.x, there);
        else
          there.derivative = of_nodes.derivative_at(point.x, time, invalid_index, row.size);
        // Nodes with a weight of zero are added to the stencil for their derivatives.
        set_row(point, there, row);
        row.derivative = derivative_of_row(*point.point, there);
      }
  }
} // namespace Touchstone
