// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/explicit/row_geometry.h>

#include <algorithm>

// What rows of all kinds have in common: the gap that they may end a cycle with, and levers, which
// keep the moment of momentum (doc/explicit.md, section 9.1).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A lever shorter than this, relative to the size of the faces, is round-off. */
    constexpr double no_lever = 1e-13;

    /** Nodes on a line, or close to it, take up no moment about it: the least inertia relative to
     * the others. */
    constexpr double on_a_line = 1e-9;

    /** An overlap that contact has not caused, of bodies as they are placed or after a change of
     * partners, is undone by at most this part of a face in a cycle: the wave that this sends has
     * a strain of as much. */
    constexpr double undone = 1e-3;

    /** And no more than this part of it: what a change of weights or normals makes of a gap that
     * was closed is undone over many cycles, so that the work is no matter of one of them. */
    constexpr double undone_of_overlap = 0.05;
  } // namespace



  // Zero, or what is left of an overlap. As far as the sides were closing undoing it takes no work:
  // an impulse does work on the mean of the velocities before and after. So a node that slides in a
  // hollow comes back to its surface for nothing.
  // Where sides move apart by more than the gap has grown, as its normal has turned, the gap may
  // end as far within as takes no work, and comes back in this way.
  double
  allowed_gap(const double gap, const double closing, const double size)
  {
    if (gap >= 0.)
      return std::min(0., gap + std::min(0., closing));
    const double pressed = std::min(undone * size, -undone_of_overlap * gap);
    return std::min(0., gap + std::max(pressed, closing));
  }



  // The forces of a row on its nodes, f and -w_m f, have the moment d x f about any point, with d
  // from the contact point to the slave node: none if f acts along d. Forces c (y x J^-1 (d x f))
  // on the n nodes around the slave node, at y from their mean, with c = 1/n and J = sum c (|y|^2 I
  // - y y), take it up. Zywicz and Puso (1999), Int. J. Numer. Methods Engng 44, have a moment arm
  // for the same purpose.
  void
  set_lever(ImpulseSolver                     &solver,
            ImpulseRow                        &row,
            const std::vector<Tensor<1, dim>> &x,
            const Tensor<1, dim>              &normal,
            const double                       size)
  {
    row.levered = false;
    Tensor<1, dim> d;
    for (unsigned int i = 0; i < row.n_nodes; ++i)
      {
        const std::size_t  s    = solver.slot(row, i);
        const unsigned int node = solver.nodes.node(s);
        d += solver.weights[s] * x[node];
      }
    // Along the normal it has no moment with a normal force.
    const double across = (d - (d * normal) * normal).norm();
    row.levered         = (row.friction || row.tied ? d.norm() : across) > no_lever * size;
    if (!row.levered)
      return;
    const std::size_t first = row.first + row.n_nodes, last = first + row.n_lever;
    const double      c = 1. / row.n_lever;
    Tensor<1, dim>    mean;
    const auto        position = [&](const std::size_t s) { return x[solver.nodes.node(s)]; };
    for (std::size_t s = first; s < last; ++s)
      mean += c * position(s);
    SymmetricTensor<2, dim> moments;
    for (std::size_t s = first; s < last; ++s)
      {
        const Tensor<1, dim> y = position(s) - mean;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            moments[i][j] += c * (y[i] * y[j]);
      }
    const Tensor<2, dim> inertia = trace(moments) * unit_symmetric_tensor<dim>() - moments;
    const double         scale   = trace(inertia);
    row.levered                  = determinant(inertia) > on_a_line * scale * scale * scale;
    if (!row.levered)
      return;
    const Tensor<2, dim> inverse = invert(inertia);
    if (row.along_normal)
      {
        const Tensor<1, dim> turn = c * (inverse * cross_product_3d(d, normal));
        for (std::size_t s = first; s < last; ++s)
          solver.on_normals[s] = cross_product_3d(position(s) - mean, turn);
        return;
      }
    const Tensor<2, dim> turn = inverse * cross_matrix(d);
    for (std::size_t s = first; s < last; ++s)
      solver.levers[s] = c * cross_matrix(position(s) - mean) * turn;
  }
} // namespace Touchstone
