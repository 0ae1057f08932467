// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/dynamics.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <vector>

// Momenta of the bodies, and what a change of the mesh takes of them: a rigid motion of each body
// gives it back.
namespace Touchstone
{
  using namespace dealii;

  void
  Dynamics::adopt(const std::vector<Vector>       &rates,
                  const StepForces                &forces,
                  const std::vector<BodyMomentum> &before)
  {
    // The order of rates(): velocity, acceleration.
    v   = rates.front();
    a   = rates.back();
    old = forces;

    // Interpolation on coarsened cells does not conserve momentum. The missing linear and angular
    // momentum of each body without supports is given back by a rigid motion: its six amplitudes
    // solve a 6 x 6 system whose matrix holds the momenta (linear and angular about the origin) of
    // the six unit rigid motions.
    const unsigned int n       = 2 * dim;
    const auto         numbers = [](const BodyMomentum &momentum) {
      dealii::Vector<double> result(n);
      for (unsigned int d = 0; d < dim; ++d)
        {
          result(d)       = momentum.linear[d];
          result(dim + d) = momentum.angular[d];
        }
      return result;
    };
    std::vector<Vector>             motions;
    std::vector<FullMatrix<double>> inertia(before.size(), FullMatrix<double>(n));
    for (unsigned int k = 0; k < n; ++k)
      {
        // Column k of each body's matrix are the momenta of the unit rigid motion k; all bodies
        // move at once, so that six products with M serve any number of bodies.
        motions.push_back(rigid_motion(k));
        const auto momenta = momenta_of(motions.back());
        for (unsigned int b = 0; b < before.size(); ++b)
          for (unsigned int i = 0; i < n; ++i)
            inertia[b](i, k) = numbers(momenta[b])(i);
      }
    const auto now = momenta_of(v);
    for (unsigned int b = 0; b < before.size(); ++b)
      // A supported body exchanges momentum with its supports: it need not keep its own.
      if (!solid.bodies[b].supported())
        {
          dealii::Vector<double> missing = numbers(before[b]), part(n);
          missing -= numbers(now[b]);
          inertia[b].gauss_jordan();
          inertia[b].vmult(part, missing);
          for (std::size_t i = 0; i < body.size(); ++i)
            if (body[i] == b)
              for (unsigned int k = 0; k < n; ++k)
                v.begin()[i] += part(k) * motions[k].begin()[i];
        }
    // No step has found what the supports of this mesh add.
    Vector others(old.external);
    others -= old.internal;
    others += old.normal;
    others += old.tangential;
    old.support = support_force(others, forces.remove_support);
  }



  Vector
  Dynamics::rigid_motion(const unsigned int k) const
  {
    Vector result(v);
    // Reference positions of the nodes, as a vector over the dofs.
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, result);
    // The rotation is about the origin at the present positions: omega x (X + u).
    result += committed_u;
    const Tensor<1, dim> axis = Point<dim>::unit_vector(k % dim);
    for (std::size_t i = 0; i < result.locally_owned_size(); i += dim)
      {
        Tensor<1, dim> velocity(axis);
        if (k >= dim)
          velocity = cross_product_3d(
            axis, Point<dim>(result.begin()[i], result.begin()[i + 1], result.begin()[i + 2]));
        for (unsigned int d = 0; d < dim; ++d)
          result.begin()[i + d] = velocity[d];
      }
    return result;
  }



  std::vector<BodyMomentum>
  Dynamics::momenta_of(const Vector &velocity) const
  {
    Vector momentum(v), position(v);
    mass.multiply(velocity, momentum);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, position);
    position += committed_u;
    std::vector<BodyMomentum> result(solid.bodies.size());
    for (std::size_t i = 0; i < body.size(); i += dim)
      {
        Tensor<1, dim> p, x;
        for (unsigned int d = 0; d < dim; ++d)
          {
            p[d] = momentum.begin()[i + d];
            x[d] = position.begin()[i + d];
          }
        // Sum_i p_i and Sum_i x_i x p_i of the nodal momenta p = M v: exact for any mass matrix
        // that represents rigid motions.
        result[body[i]].mass += mass.of_nodes().begin()[i];
        result[body[i]].linear += p;
        result[body[i]].angular += cross_product_3d(x, p);
      }
    // A body is distributed over all ranks; a rank without a part of it adds zero.
    for (BodyMomentum &sum : result)
      {
        sum.mass    = Utilities::MPI::sum(sum.mass, solid.communicator);
        sum.linear  = Utilities::MPI::sum(sum.linear, solid.communicator);
        sum.angular = Utilities::MPI::sum(sum.angular, solid.communicator);
      }
    return result;
  }
} // namespace Touchstone
