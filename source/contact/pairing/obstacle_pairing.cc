// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/formula.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/mesh/obstacle_shape.h>
#include <touchstone/mesh/rotation.h>
#include <touchstone/mesh/sharp_tip.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <vector>

// Contact with a rigid obstacle whose surface is given by a formula: projection, normal and their
// derivatives come from AnalyticSurface, so that no search and no communication is needed. The
// obstacle moves as a rigid body by a rotation and a translation, functions of time, and by what
// forces add to it.
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
        surface                         = input.parameters->part_of.empty()
                                            ? o.shape.make()->surface()
                                            : o.shape.make()->walls()[input.parameters->wall];
        tip                             = dynamic_cast<const SharpTip *>(surface.get());
        const std::string *motions[dim] = {&o.motion_x, &o.motion_y, &o.motion_z};
        for (unsigned int d = 0; d < dim; ++d)
          translation[d] =
            formulas.add(o.section(), "Motion " + std::string(1, "xyz"[d]), *motions[d]);
        turns = o.rotate_angle != "0";
        axis  = o.rotate_axis / o.rotate_axis.norm();
        fixed = Point<dim>(o.rotate_point);
        if (turns)
          angle = formulas.add(o.section(), "Rotate angle", o.rotate_angle);
        free.point = Point<dim>(o.free.reference_point);
        free.turns = o.free.turns();
      }

      void
      update(const Vector &u, const double time, std::vector<ContactRow> &rows) override
      {
        const RigidMotion               now   = motion(time);
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            const Point<dim>   at = input.slave->position(nodes[k], u);
            const PointContact there =
              before_tip(k, now) ? contact_of_tip(at, now) : contact(at, now);
            ContactRow &row = rows[k];
            row.stencil.clear();
            row.motion      = now;
            row.normal      = there.normal;
            row.gap_vector  = there.gap_vector;
            row.gap         = row.gap_vector * row.normal;
            row.has_partner = surface->can_be_touched(now.back(at));
          }
      }

      void
      differentiate(const Vector &u, const double time, std::vector<ContactRow> &rows) override
      {
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            rows[k].derivative.reset();
            // Open rows contribute neither force nor condition.
            if (!rows[k].was_active || !rows[k].has_partner)
              continue;
            if (before_tip(k, motion(time)))
              rows[k].derivative = derivative_at_tip(rows[k].slave);
            else
              rows[k].derivative = derivative_at(input.slave->position(nodes[k], u),
                                                 time,
                                                 rows[k].slave,
                                                 rows[k].size);
          }
      }

      void
      commit_positions(const Vector &u) override
      {
        committed.clear();
        if (tip != nullptr)
          for (const SurfaceNode &node : input.slave->owned_nodes())
            committed.push_back(input.slave->position(node, u));
      }

      std::shared_ptr<const RowDerivative>
      derivative_at(const Point<dim> &at,
                    const double      time,
                    const Index       node,
                    const double      size) const override
      {
        const RigidMotion    now = motion(time);
        const Tensor<2, dim> identity(unit_symmetric_tensor<dim>());
        // In the frame of the obstacle.
        const Point<dim>     x = now.back(at);
        RowDerivativeBuilder builder(0);
        // The only node that the row depends on: the obstacle is rigid.
        builder.index(node);
        // gap vector x - P(x).
        builder.result->gap_vector[0] = identity - surface->projection_gradient(x);
        // Central differences: normals are given by formulas that are simple, and smooth over the
        // size of a face.
        const double step = 1e-4 * size;
        for (unsigned int d = 0; d < dim; ++d)
          {
            Tensor<1, dim> move;
            move[d] = step;
            const Tensor<1, dim> change =
              (surface->normal(x + move) - surface->normal(x - move)) / (2. * step);
            for (unsigned int c = 0; c < dim; ++c)
              builder.result->normal[0][c][d] = change[c];
          }
        if (now.turned)
          for (Tensor<2, dim> *of_obstacle :
               {builder.result->gap_vector.data(), builder.result->normal.data()})
            *of_obstacle = now.turn * *of_obstacle * transpose(now.turn);
        return builder.result;
      }

      double
      distance(const Point<dim> &x, const double time) const override
      {
        // The signed distance; negative inside.
        const PointContact there = contact(x, motion(time));
        return there.gap_vector * there.normal;
      }

      std::optional<PointContact>
      at(const Point<dim> &x, const double time) const override
      {
        return contact(x, motion(time));
      }

      // Explicit cycles ask for the motion at their two ends once for each node.
      RigidMotion
      motion(const double time) const override
      {
        for (const Prescribed &one : latest)
          if (one.known && one.time == time)
            return free.after(one.motion);
        latest[1] = latest[0];
        latest[0] = {true, time, prescribed_motion(time)};
        return free.after(latest[0].motion);
      }

      Tensor<1, dim>
      driven_turn(const double from, const double to) const override
      {
        if (!angle)
          return {};
        return (angle->value(Point<dim>(), to) - angle->value(Point<dim>(), from)) * axis;
      }

      void
      set_free_motion(const ToolMotion &of_forces) override
      {
        free = of_forces;
      }

    private:
      /** By formulas of the time alone. */
      RigidMotion
      prescribed_motion(const double time) const
      {
        RigidMotion result;
        for (unsigned int d = 0; d < dim; ++d)
          // Directions without a formula do not move.
          result.shift[d] = translation[d] ? translation[d]->value(Point<dim>(), time) : 0.;
        if (turns)
          {
            result.turned = true;
            result.turn   = rotation(axis, angle ? angle->value(Point<dim>(), time) : 0.);
            result.shift += fixed - result.turn * fixed;
          }
        formulas.check(MPI_COMM_SELF); // the time is the same on all ranks
        return result;
      }

      /** Normal and gap vector of a point. */
      PointContact
      contact(const Point<dim> &x, const RigidMotion &now) const
      {
        const Point<dim> y = now.back(x);
        // A wall that cannot be touched there is as far away as nothing ever is.
        if (const double far = 1e6 * input.slave->largest_face(); !surface->can_be_touched(y))
          return {now.direction(surface->normal(y)), far * now.direction(surface->normal(y))};
        return {now.direction(surface->normal(y)), now.direction(y - surface->project(y))};
      }

      /** Whether node @p k was on the axis of a sharp tip when the step began, but for round-off.
       * Iterates do not decide: they slip off the tip to a side that round-off chooses. */
      bool
      before_tip(const std::size_t k, const RigidMotion &now) const
      {
        constexpr double   round_off = 1e-6;
        const SurfaceNode &node      = input.slave->owned_nodes()[k];
        return tip != nullptr &&
               tip->is_before_tip(now.back(committed.empty() ? node.reference : committed[k]),
                                  round_off * node.size);
      }

      /** Of a point that the tip pushes along its axis. */
      PointContact
      contact_of_tip(const Point<dim> &x, const RigidMotion &now) const
      {
        return {now.direction(tip->normal_at_tip()), now.direction(now.back(x) - tip->tip())};
      }

      static std::shared_ptr<const RowDerivative>
      derivative_at_tip(const Index node)
      {
        RowDerivativeBuilder builder(0);
        builder.index(node);
        builder.result->gap_vector[0] = unit_symmetric_tensor<dim>();
        return builder.result;
      }

      std::shared_ptr<const AnalyticSurface> surface;
      /** The same, if it has a tip; else null. */
      const SharpTip *tip = nullptr;
      /** Of the slave nodes when the step began; empty in the reference state. */
      std::vector<Point<dim>>                         committed;
      Formulas                                        formulas;
      std::array<std::shared_ptr<const Formula>, dim> translation;
      bool                                            turns = false;
      std::shared_ptr<const Formula>                  angle;
      /** Of the rotation: a unit vector, and a point of it at time 0. */
      Tensor<1, dim> axis;
      Point<dim>     fixed;
      ToolMotion     free;
      /** The last two motions that were asked for. */
      struct Prescribed
      {
        bool        known = false;
        double      time  = 0.;
        RigidMotion motion;
      };
      mutable std::array<Prescribed, 2> latest;
    };
  } // namespace



  std::shared_ptr<Pairing>
  make_obstacle_pairing(const PairingInput &input)
  {
    return std::make_shared<ObstaclePairing>(input);
  }
} // namespace Touchstone
