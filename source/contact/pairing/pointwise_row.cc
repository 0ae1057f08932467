// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/edge_normal.h>
#include <touchstone/contact/pairing/pointwise_row.h>
#include <touchstone/contact/pairing/pointwise_row_derivative.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/tolerances.h>

#include <algorithm>
#include <list>

// The row of a point that faces the closest point of the master surface: of a slave node
// (pointwise_pairing.cc) or of a point inside a slave face (point_rows.cc).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
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
  } // namespace



  // On an edge between faces it is the mean of the rows of all of them, as normals jump there a
  // little: with the row of one face a node that symmetry or matching meshes put on the edge would
  // have no balance on either side of it.
  void
  set_pointwise_row(const ContactPartner &partner, const Point<dim> &x, ContactRow &row)
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
    row.gap     = row.gap_vector * row.normal;
    row.touches = partner.face->key;
  }



  void
  add_faces(const ContactPartner &partner, std::vector<const Face *> &faces)
  {
    for_each(partner, [&](const ContactPartner &one) { faces.push_back(one.face); });
  }



  void
  differentiate_pointwise_row(
    const Search                                                          &search,
    const std::unordered_map<const Face *, std::vector<NormalDerivative>> &of_normals,
    const ContactPartner                                                  &partner,
    const Point<dim>                                                      &x,
    ContactRow                                                            &row)
  {
    const double                      part = 1. / (1. + partner.others.size());
    Tensor<1, dim>                    mean;
    std::list<FaceGeometry>           geometries;
    std::list<PointwiseRowDerivative> derivatives;
    for_each(partner, [&](const ContactPartner &one) {
      mean += part * one.normal;
      geometries.push_back(search.geometry(*one.face));
      derivatives.emplace_back(geometries.back(),
                               one,
                               differentiate_over_edges(geometries.back(), one.xi),
                               x - one.x);
      // On an edge of the face a weight is zero but its derivative is not: the node belongs to the
      // stencil for the derivative.
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
    for_each(partner, [&](const ContactPartner &one) {
      const auto found = of_normals.find(one.face);
      (derivative++)
        ->compute(row.slave,
                  row.stencil,
                  part,
                  found == of_normals.end() ? nullptr : &found->second,
                  builder);
    });
    if (part < 1.)
      for (Tensor<2, dim> &normal : builder.result->normal)
        normal = normalisation_derivative(mean) * normal;
    row.derivative = builder.result;
  }
} // namespace Touchstone
