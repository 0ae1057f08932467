// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/explicit/impulse_contact.h>

// The levers of rows, which keep the moment of momentum (doc/explicit.md, section 9.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A lever shorter than this, relative to the size of the faces, is round-off. */
    constexpr double no_lever = 1e-13;
  } // namespace



  // The forces of a row on its nodes, f and -w_m f, have the moment d x f about any point, with d
  // from the contact point to the slave node: none if f acts along d. Forces c (y x J^-1 (d x f))
  // on the n nodes around the slave node, at y from their mean, with c = 1/n and J = sum c (|y|^2 I
  // - y y), take it up. Zywicz and Puso (1999), Int. J. Numer. Methods Engng 44, have a moment arm
  // for the same purpose.
  // With small sliding partners stay as they were in the reference state, and the line from the
  // contact point to the slave node grows with the sliding: such a lever would turn the rate of the
  // gap into something else. These pairs keep linear momentum alone, as in implicit runs.
  void
  ImpulseContact::set_lever(ImpulseRow &row, const ContactRow &of)
  {
    row.levered = false;
    if (contact.pair(of).small_sliding() && !row.tied)
      return;
    Tensor<1, dim> d;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t  s    = solver.slot(row, i);
        const unsigned int node = solver.nodes.node(s);
        d += solver.weights[s] * (reference[node] + u_nodes[node]);
      }
    // Along the normal it has no moment with a normal force.
    const double across = (d - (d * of.normal) * of.normal).norm();
    row.levered         = (row.friction || row.tied ? d.norm() : across) > no_lever * of.size;
    if (!row.levered)
      return;
    const std::size_t first = row.first + row.n_nodes, last = first + row.n_lever;
    const double      c = 1. / row.n_lever;
    Tensor<1, dim>    mean;
    const auto        position = [&](const std::size_t s) {
      return reference[solver.nodes.node(s)] + u_nodes[solver.nodes.node(s)];
    };
    for (std::size_t s = first; s < last; ++s)
      mean += c * position(s);
    Tensor<2, dim> inertia;
    for (std::size_t s = first; s < last; ++s)
      {
        const Tensor<1, dim> y = position(s) - mean;
        inertia += c * (y.norm_square() * Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
                        outer_product(y, y));
      }
    const Tensor<2, dim> turn = invert(inertia) * cross_matrix(d);
    for (std::size_t s = first; s < last; ++s)
      solver.levers[s] = c * cross_matrix(position(s) - mean) * turn;
  }
} // namespace Touchstone
