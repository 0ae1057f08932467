// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/ball_depth.h>
#include <touchstone/solid/node_positions.h>

#include <array>

// The depth of balls in their cells (doc/theory.md 3.5). The nodes behind the faces are not sent
// with these: few of them are needed, and by this pairing alone.
namespace Touchstone
{
  using namespace dealii;

  BallDepth::BallDepth(const Solid &solid, const BallsInCell &balls)
    : solid(solid)
    , balls(balls)
    , coordinates(node_positions(solid))
  {
  }



  void
  BallDepth::update(const Vector &u, const std::vector<const Face *> &faces)
  {
    IndexSet needed = solid.relevant;
    for (const Face *const face : faces)
      for (unsigned int i = 0; i < BallsInCell::n_nodes; ++i)
        {
          const Index first = dim * face->cell_node(i);
          needed.add_range(first, first + dim);
        }
    needed.compress();
    // On one rank always the same.
    if (known_displacement.size() == 0 || Utilities::MPI::n_mpi_processes(solid.communicator) > 1)
      {
        known_displacement.reinit(solid.owned, needed, solid.communicator);
        known_coordinates.reinit(known_displacement);
        known_coordinates = coordinates;
      }
    Vector owned(solid.zero_vector());
    owned              = u;
    known_displacement = owned;
  }



  // The centre is at sum W_i x_i, the point of the face above it at sum N_m x_m: the difference is
  // that of the nodes and those behind them, with the weights of the latter. It counts along the
  // normal of the facet.
  double
  BallDepth::depth(const Face &face, const unsigned int ball, const bool present) const
  {
    std::array<Tensor<1, dim>, BallsInCell::n_nodes> x;
    for (unsigned int i = 0; i < x.size(); ++i)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const Index dof = dim * face.cell_node(i) + d;
          x[i][d]         = known_coordinates(dof) + (present ? known_displacement(dof) : 0.);
        }
    const FaceShapes shapes(1, balls.above(ball));
    Tensor<1, dim>   tangents[2], from_centre;
    for (unsigned int m = 0; m < Face::behind; ++m)
      {
        for (unsigned int a = 0; a < 2; ++a)
          tangents[a] += shapes.gradient[m][a] * x[m];
        from_centre += balls.weight(ball, Face::behind + m) * (x[m] - x[Face::behind + m]);
      }
    const Tensor<1, dim> normal = cross_product_3d(tangents[0], tangents[1]);
    return from_centre * normal / normal.norm();
  }
} // namespace Touchstone
