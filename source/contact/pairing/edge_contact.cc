// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/edge_contact.h>
#include <touchstone/contact/pairing/row_derivative.h>

#include <deal.II/base/symmetric_tensor.h>

// The row of two edges that cross: feet of their common perpendicular, weights, and the derivatives
// of both (doc/theory.md 4.2).
namespace Touchstone
{
  using namespace dealii;

  EdgeContact::Direction
  EdgeContact::direction(const EdgeOfLine &line, const double at)
  {
    Direction result;
    for (unsigned int end = 0; end < 2; ++end)
      {
        const EdgeTangent &tangent = line.tangents[end];
        const double       part    = (end == 0 ? 1. - at : at);
        result.value.value += part * tangent.value;
        result.slope += (end == 0 ? -1. : 1.) * tangent.value;
        for (const auto &[node, coefficient] : tangent.nodes)
          result.value.nodes.emplace_back(node, part * coefficient);
      }
    return result;
  }



  EdgeContact::EdgeContact(const EdgeOfLine   &slave_edge,
                           const EdgeOfLine   &master_edge,
                           const EdgeCrossing &crossing,
                           const unsigned int  end)
    : key(master_edge.edge.key)
    , slave(slave_edge.edge.nodes[end])
    , other(slave_edge.edge.nodes[1 - end])
    , master(master_edge.edge.nodes)
    , slave_line(direction(slave_edge, crossing.along_first))
    , master_line(direction(master_edge, crossing.along_second))
    , e((end == 0 ? 1. : -1.) * (slave_edge.edge.b - slave_edge.edge.a))
    , f(master_edge.edge.b - master_edge.edge.a)
    , a(end == 0 ? crossing.along_first : 1. - crossing.along_first)
    , b(crossing.along_second)
    , distance(crossing.first - crossing.second)
    , normal(cross_product_3d(slave_line.value.value, master_line.value.value))
    , orientation(end == 0 ? 1. : -1.)
  {
    normal *= (normal * crossing.normal > 0. ? 1. : -1.) / normal.norm();
  }



  void
  EdgeContact::set(ContactRow &row) const
  {
    const double share = 1. / (1. - a);
    set_point(row, share, normal, distance, a * e);
    row.stencil = {{master[0], (1. - b) * share}, {master[1], b * share}, {other, -a * share}};
  }



  // The feet x_1 + a e and y_1 + b f are where d = x_1 + a e - y_1 - b f is perpendicular to both
  // edges: d.e = 0 and d.f = 0 give da and db. The normal is the direction of s x t, with the
  // directions s and t of both lines, which are interpolated between the nodes.
  std::shared_ptr<const RowDerivative>
  EdgeContact::differentiate(const std::vector<NormalDerivative> *) const
  {
    RowDerivativeBuilder builder(3);
    RowDerivative       &result = *builder.result;
    // Of a node with unit motion: coefficients of the motion of d at fixed feet, and of e and f.
    const Index  nodes[4]   = {slave, other, master[0], master[1]};
    const double at_feet[4] = {1. - a, a, -(1. - b), -b};
    const double of_e[4] = {-1., 1., 0., 0.}, of_f[4] = {0., 0., -1., 1.};

    const double         ee = e * e, ff = f * f, ef = e * f, det = ef * ef - ee * ff;
    const double         share  = 1. / (1. - a);
    const Tensor<1, dim> across = cross_product_3d(slave_line.value.value, master_line.value.value);
    const Tensor<2, dim> turn =
      (across * normal > 0. ? 1. : -1.) * normalisation_derivative(across);
    const Tensor<2, dim> by_slave_line  = -1. * turn * cross_matrix(master_line.value.value),
                         by_master_line = turn * cross_matrix(slave_line.value.value);
    const Tensor<1, dim> by_a           = orientation * (by_slave_line * slave_line.slope),
                         by_b           = by_master_line * master_line.slope;
    const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
    for (unsigned int k = 0; k < 4; ++k)
      {
        const Tensor<1, dim> of_de = -of_e[k] * distance - at_feet[k] * e,
                             of_df = -of_f[k] * distance - at_feet[k] * f;
        const Tensor<1, dim> da    = (ef * of_df - ff * of_de) / det,
                             db    = (ee * of_df - ef * of_de) / det;
        const Tensor<2, dim> dd =
          at_feet[k] * identity + outer_product(e, da) - outer_product(f, db);
        const std::size_t i = builder.index(nodes[k]);
        result.gap_vector[i] += share * dd + share * share * outer_product(distance, da);
        result.normal[i] += outer_product(by_a, da) + outer_product(by_b, db);
        result.weights[0][i] += share * (share * (1. - b) * da - db);
        result.weights[1][i] += share * (share * b * da + db);
        result.weights[2][i] -= share * share * da;
      }
    for (const auto &[node, coefficient] : slave_line.value.nodes)
      result.normal[builder.index(node)] += coefficient * by_slave_line;
    for (const auto &[node, coefficient] : master_line.value.nodes)
      result.normal[builder.index(node)] += coefficient * by_master_line;
    return builder.result;
  }
} // namespace Touchstone
