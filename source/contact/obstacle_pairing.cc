#include <touchstone/contact/pairing.h>

#include <deal.II/base/function_parser.h>

#include <array>
#include <memory>

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
        const ObstacleParameters &o       = *input.obstacle;
        const bool                outside = (o.side == "outside");
        if (o.shape == "plane")
          surface = make_plane(Point<dim>(o.point), o.direction / o.direction.norm());
        else if (o.shape == "sphere")
          surface = make_sphere(Point<dim>(o.point), o.radius, outside);
        else
          surface =
            make_cone(Point<dim>(o.point), o.direction / o.direction.norm(), o.radius, 0., outside);
        const std::string *motions[dim] = {&o.motion_x, &o.motion_y, &o.motion_z};
        for (unsigned int d = 0; d < dim; ++d)
          {
            motion[d] = std::make_unique<FunctionParser<1>>(1);
            motion[d]->initialize("t", *motions[d], {{"pi", numbers::PI}}, false);
          }
      }

      void
      update(const Vector &u, const double time, std::vector<ContactRow> &rows) override
      {
        Tensor<1, dim> shift;
        for (unsigned int d = 0; d < dim; ++d)
          shift[d] = motion[d]->value(Point<1>(time));
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            const Point<dim> x   = input.slave->position(nodes[k], u) - shift;
            ContactRow      &row = rows[k];
            row.stencil.clear();
            row.shift      = shift;
            row.normal     = surface->normal(x);
            row.gap_vector = x - surface->project(x);
            row.gap        = row.gap_vector * row.normal;
            if (row.status == ContactStatus::no_partner)
              row.status = ContactStatus::open;
          }
      }

    private:
      std::shared_ptr<const AnalyticSurface>              surface;
      std::array<std::unique_ptr<FunctionParser<1>>, dim> motion;
    };

    const PairingRegistry::Entry<ObstaclePairing>
      entry("obstacle", "rigid surface given by a formula; chosen by the key 'Obstacle'");
  } // namespace
} // namespace Touchstone
