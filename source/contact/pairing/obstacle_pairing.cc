// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>

// Contact with a rigid obstacle whose surface is given by a formula: projection, normal and their
// derivatives come from AnalyticSurface, so that no search and no communication is needed. The
// obstacle moves as a rigid body by a translation, a function of time.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A rigid body given by a formula: rows with an empty stencil. */
    class ObstaclePairing : public Pairing
    {
    public:
      explicit ObstaclePairing(const PairingInput &input)
        : Pairing(input)
      {
        const ObstacleParameters &o     = *input.obstacle;
        surface                         = o.shape.make()->surface();
        const std::string *motions[dim] = {&o.motion_x, &o.motion_y, &o.motion_z};
        for (unsigned int d = 0; d < dim; ++d)
          motion[d] = formulas.add(o.section(), "Motion " + std::string(1, "xyz"[d]), *motions[d]);
      }

      void
      update(const Vector &u, const double time, std::vector<ContactRow> &rows) override
      {
        const Tensor<1, dim>            shift = motion_at(time);
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            // In the frame of the obstacle.
            const Point<dim> x   = input.slave->position(nodes[k], u) - shift;
            ContactRow      &row = rows[k];
            row.stencil.clear();
            row.shift       = shift;
            row.normal      = surface->normal(x);
            row.gap_vector  = x - surface->project(x);
            row.gap         = row.gap_vector * row.normal;
            row.has_partner = true;
          }
      }

      void
      differentiate(const Vector &u, const double time, std::vector<ContactRow> &rows) override
      {
        const Tensor<1, dim>            shift = motion_at(time);
        const Tensor<2, dim>            identity(unit_symmetric_tensor<dim>());
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            ContactRow &row = rows[k];
            row.derivative.reset();
            // Open rows contribute neither force nor condition.
            if (!row.was_active)
              continue;
            const Point<dim>     x = input.slave->position(nodes[k], u) - shift;
            RowDerivativeBuilder builder(0);
            // The only node that the row depends on: the obstacle is rigid.
            builder.index(row.slave);
            // gap vector x - P(x).
            builder.result->gap_vector[0] = identity - surface->projection_gradient(x);
            // Central differences: normals are given by formulas that are simple, and
            // smooth over the size of a face.
            const double step = 1e-4 * row.size;
            for (unsigned int d = 0; d < dim; ++d)
              {
                Tensor<1, dim> move;
                move[d] = step;
                const Tensor<1, dim> change =
                  (surface->normal(x + move) - surface->normal(x - move)) / (2. * step);
                for (unsigned int c = 0; c < dim; ++c)
                  builder.result->normal[0][c][d] = change[c];
              }
            row.derivative = builder.result;
          }
      }

      double
      distance(const Point<dim> &x, const double time) const override
      {
        // The signed distance; negative inside.
        const Point<dim> y = x - motion_at(time);
        return (y - surface->project(y)) * surface->normal(y);
      }

      std::optional<PointContact>
      at(const Point<dim> &x, const double time) const override
      {
        const Point<dim> y = x - motion_at(time);
        return PointContact{surface->normal(y), y - surface->project(y)};
      }

      Tensor<1, dim>
      shift(const double time) const override
      {
        return motion_at(time);
      }

    private:
      Tensor<1, dim>
      motion_at(const double time) const
      {
        Tensor<1, dim> shift;
        for (unsigned int d = 0; d < dim; ++d)
          // Directions without a formula do not move.
          shift[d] = motion[d] ? motion[d]->value(Point<dim>(), time) : 0.;
        formulas.check(MPI_COMM_SELF); // the time is the same on all ranks
        return shift;
      }

      std::shared_ptr<const AnalyticSurface>          surface;
      Formulas                                        formulas;
      std::array<std::shared_ptr<const Formula>, dim> motion;
    };
  } // namespace



  std::shared_ptr<Pairing>
  make_obstacle_pairing(const PairingInput &input)
  {
    return std::make_shared<ObstaclePairing>(input);
  }
} // namespace Touchstone
