// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/step_problem.h>
#include <touchstone/solid/bodies.h>
#include <touchstone/solid/hyperelastic_law.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <tuple>
#include <vector>

// Where a body with a nonlinear law is compressed most, how bodies move that only contact holds,
// for the messages of a step that fails.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A value at a quadrature point of a body, and where that is in the reference state. */
    struct ExtremePoint
    {
      double     value = std::numeric_limits<double>::max();
      Point<dim> position;
      double     body = 0.;

      /** By position where values are equal, so that the order does not depend on the partition. */
      bool
      operator<(const ExtremePoint &other) const
      {
        return std::tie(value, position[0], position[1], position[2]) <
               std::tie(other.value, other.position[0], other.position[1], other.position[2]);
      }

      /** Body and position in words. */
      std::string
      place(const Scene &scene) const
      {
        return "body '" + scene.bodies[static_cast<unsigned int>(body)].name + "' at " +
               StepProblem::readable(position);
      }
    };



    /** The point of bodies with a nonlinear law where a function of body and deformation gradient
     * is smallest. Collective. */
    ExtremePoint
    smallest(const Scene                                                       &scene,
             const Solid                                                       &solid,
             const Vector                                                      &u,
             const std::function<double(unsigned int, const Tensor<2, dim> &)> &function)
    {
      const Vector                ghosted = solid.ghosted(u);
      const QGauss<dim>           quadrature(solid.fe.degree + 1);
      FEValues<dim>               values(solid.mapping,
                           solid.fe,
                           quadrature,
                           update_gradients | update_quadrature_points);
      std::vector<Tensor<2, dim>> gradients(quadrature.size());
      ExtremePoint                found;
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned() && !scene.bodies[cell->material_id()].material.linear())
          {
            values.reinit(cell);
            values[FEValuesExtractors::Vector(0)].get_function_gradients(ghosted, gradients);
            for (const unsigned int q : values.quadrature_point_indices())
              {
                const Tensor<2, dim> F = gradients[q] + unit_symmetric_tensor<dim>();
                found                  = std::min(found,
                                 {function(cell->material_id(), F),
                                                   values.quadrature_point(q),
                                                   static_cast<double>(cell->material_id())});
              }
          }
      const std::vector<double> mine{
        found.value, found.position[0], found.position[1], found.position[2], found.body};
      for (const auto &of : Utilities::MPI::all_gather(solid.communicator, mine))
        found = std::min(found, {of[0], Point<dim>(of[1], of[2], of[3]), of[4]});
      return found;
    }
  } // namespace



  std::string
  StepProblem::inverted_place(const Vector &trial) const
  {
    return smallest(scene,
                    solid,
                    trial,
                    [](const unsigned int, const Tensor<2, dim> &F) { return determinant(F); })
      .place(scene);
  }



  // n_i N_J A_iJkL n_k N_L < 0 with the direction N of the largest compression and n = F N / |F N|.
  // Laws for small strains do so (doc/theory.md 2.2), and then no step size helps.
  std::string
  StepProblem::unstable_place() const
  {
    std::vector<std::shared_ptr<HyperelasticLaw>> laws;
    for (const BodyParameters &body : scene.bodies)
      laws.push_back(HyperelasticRegistry::knows(body.material.law.name)
                       ? body.material.law.make<HyperelasticRegistry>(body.material)
                       : nullptr);
    const auto resistance = [&](const unsigned int body, const Tensor<2, dim> &F) {
      if (!laws[body] || !(determinant(F) > 0.))
        return std::numeric_limits<double>::max();
      // In descending order.
      const auto           eigen = eigenvectors(symmetrize(transpose(F) * F));
      const Tensor<1, dim> N     = eigen[dim - 1].second;
      const Tensor<1, dim> n     = F * N / (F * N).norm();
      const Tensor<2, dim> nN    = outer_product(n, N);
      return scalar_product(nN, double_contract<2, 0, 3, 1>(laws[body]->tangent(F), nN));
    };
    const ExtremePoint found = smallest(scene, solid, u, resistance);
    return found.value < 0. ? found.place(scene) : "";
  }



  std::string
  StepProblem::motion_of_loose_bodies() const
  {
    // What the conditions of one iterate leave free need not be how the body moves in the step:
    // rows that stick in it may slide in the next.
    const std::vector<unsigned int> body = bodies_of_unknowns(solid);
    const std::size_t               n    = scene.bodies.size();
    std::vector<double>             sums(n * (dim + 1), 0.);
    for (std::size_t i = 0; i < body.size(); ++i)
      {
        double *const of_body = &sums[body[i] * (dim + 1)];
        of_body[solid.owned.nth_index_in_set(i) % dim] += u.begin()[i] - committed_u.begin()[i];
        of_body[dim] += 1. / dim;
      }
    Utilities::MPI::sum(sums, solid.communicator, sums);
    std::string text;
    for (const unsigned int b : system->loose_bodies())
      {
        const double *const of_body = &sums[b * (dim + 1)];
        const auto *const   most =
          std::max_element(of_body, of_body + dim, [](const double x, const double y) {
            return std::abs(x) < std::abs(y);
          });
        char one[120];
        std::snprintf(one,
                      sizeof(one),
                      "' has moved by %.2g in %c on average in this step",
                      *most / of_body[dim],
                      "xyz"[most - of_body]);
        text += "; body '" + scene.bodies[b].name + one;
      }
    return text;
  }
} // namespace Touchstone
