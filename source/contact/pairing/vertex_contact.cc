// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/pointwise_row_derivative.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/pairing/vertex_contact.h>

// The row of a vertex of the master in a slave face: that of a node on a face with the roles
// exchanged, divided by the weight of one node of the face (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  VertexContact::VertexContact(const Index                  vertex,
                               const std::uint64_t          key,
                               const Point<dim>            &x,
                               const FaceGeometry          &geometry,
                               const std::array<double, 2> &xi,
                               const unsigned int           local)
    : vertex(vertex)
    , key(key)
    , geometry(geometry)
    , xi(xi)
    , local(local)
    , shapes(geometry.face().degree, xi)
  {
    const FacePoint point = geometry.evaluate(xi);
    foot                  = point.x;
    distance              = x - foot;
    normal                = geometry.normal(shapes, point);
  }



  void
  VertexContact::set(ContactRow &row) const
  {
    const Face  &face  = geometry.face();
    const double share = 1. / shapes.value[local];
    set_point(row, share, -1. * normal, -1. * distance, foot - face.position(local));
    row.stencil = {{vertex, share}};
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      if (m != local)
        row.stencil.push_back({face.nodes[m], -share * shapes.value[m]});
  }



  std::shared_ptr<const RowDerivative>
  VertexContact::differentiate(const std::vector<NormalDerivative> *of_normals) const
  {
    const Face    &face = geometry.face();
    ContactPartner partner;
    partner.face   = &face;
    partner.xi     = xi;
    partner.x      = foot;
    partner.normal = normal;
    Stencil of_face;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      of_face.push_back({face.nodes[m], shapes.value[m]});
    RowDerivativeBuilder builder(of_face.size());
    PointwiseRowDerivative(geometry, partner, FaceDifferentiator(geometry).at(xi), distance)
      .compute(vertex, of_face, 1., of_normals, builder);
    const auto &exchanged = builder.result;

    auto         result = std::make_shared<RowDerivative>(*exchanged);
    const double share  = 1. / shapes.value[local];
    result->weights.clear();
    result->weights.resize(face.n_nodes());
    for (std::size_t a = 0; a < result->nodes.size(); ++a)
      {
        // d (1 / N_s), by which all is multiplied.
        const Tensor<1, dim> d_share = -share * share * exchanged->weights[local][a];
        result->normal[a] *= -1.;
        result->gap_vector[a] =
          -share * exchanged->gap_vector[a] - outer_product(distance, d_share);
        result->weights[0].push_back(d_share);
        unsigned int entry = 0;
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          if (m != local)
            result->weights[++entry].push_back(-share * exchanged->weights[m][a] -
                                               shapes.value[m] * d_share);
      }
    return result;
  }
} // namespace Touchstone
