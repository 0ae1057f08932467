// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/pairing/ball_depth.h>
#include <touchstone/contact/pairing/normal_search.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

// The pairings "pinball" of Belytschko and Neal (1991), Int. J. Numer. Methods Engng 31, and
// "splitting pinball" of Belytschko and Yeh (1993), Comput. Methods Appl. Mech. Engng 105: balls in
// the cells along the surfaces instead of nodes and faces (doc/theory.md 3.5). For explicit
// dynamics: the rows of neighbouring balls share nodes, so that none could be eliminated.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    class PinballPairing : public Pairing
    {
    public:
      explicit PinballPairing(const PairingInput &input)
        : PinballPairing(input, 0)
      {
      }

      /** @param splittings How often the ball of a cell is split. */
      PinballPairing(const PairingInput &input, unsigned int splittings);

      unsigned int
      rows_between_nodes() const override
      {
        return most_at_a_node;
      }

      bool
      keeps_nodes_out() const override
      {
        return false;
      }

      void
      update(const Vector &u, double time, std::vector<ContactRow> &rows) override;

      SearchWork
      search_work() const override
      {
        return search.faces().work();
      }

    private:
      /** A ball in a cell behind a slave face, whose row belongs to a node of the face. */
      struct SlaveBall
      {
        const Face  *face;
        unsigned int ball;
        /** Number of the node on the face, and among the owned nodes. */
        unsigned int m;
        std::size_t  node;
        /** Of the row, in those of the pair. */
        std::size_t row;
        /** Part of the face, in the reference state. */
        double area;
        /** Where its search begins. */
        std::size_t guess = std::numeric_limits<std::size_t>::max();
        /** Of the present update. */
        LookingPoint               point{};
        std::optional<FacingPoint> facing{};
      };

      const BallsInCell      balls;
      NormalSearch           search;
      BallDepth              depth;
      std::vector<SlaveBall> slaves;
      unsigned int           most_at_a_node = 0;

      void
      set_row(const SlaveBall &slave, ContactRow &row) const;
    };

    class SplittingPinballPairing : public PinballPairing
    {
    public:
      struct Parameters : public PluginParameters
      {
        unsigned int splittings = 1;

        void
        declare(ParameterHandler &prm) override
        {
          prm.add_parameter("Splittings",
                            splittings,
                            "Of 'splitting pinball': how often the ball of a cell is split into "
                            "eight, of which the four at the surface remain; 1 or 2. [no unit]",
                            Patterns::Integer(1, 2));
        }
      };

      SplittingPinballPairing(const Parameters &own, const PairingInput &input)
        : PinballPairing(input, own.splittings)
      {
      }
    };

    const PairingRegistry::Entry<PinballPairing>
      pinball_entry("pinball", "a ball in each cell at the surface, in explicit dynamics.");
    const PairingRegistry::Entry<SplittingPinballPairing>
      splitting_pinball_entry("splitting pinball",
                              "the same with balls that are split as often as its key Splittings "
                              "says, 1 (default) or 2.");



    // Rows live with a node of the face on which they depend: the one closest to the ball, of a
    // ball in the middle the first, so that it is the same on any number of ranks.
    PinballPairing::PinballPairing(const PairingInput &input, const unsigned int splittings)
      : Pairing(input)
      , balls(splittings)
      , search(input)
      , depth(*input.solid, balls)
    {
      const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        {
          unsigned int number = 0;
          for (const auto &[face, m] : input.slave->faces_around(nodes[k].node))
            {
              const auto   areas = whole_areas(*face, nullptr, /*reference=*/true);
              const double area  = std::accumulate(areas.begin(), areas.begin() + 4, 0.);
              for (unsigned int b = 0; b < balls.size(); ++b)
                if (balls.closest_node(b) == m)
                  slaves.push_back(
                    {face, b, m, k, nodes.size() * ++number + k, area / balls.size()});
            }
          most_at_a_node = std::max(most_at_a_node, number);
        }
      most_at_a_node = Utilities::MPI::max(most_at_a_node, input.solid->communicator);
    }



    void
    PinballPairing::update(const Vector &u, const double, std::vector<ContactRow> &rows)
    {
      // Nodes, and numbers that no ball has: nothing will ever meet them.
      for (ContactRow &row : rows)
        {
          row.has_partner = false;
          row.stencil.clear();
          row.gap  = 0.;
          row.away = std::numeric_limits<double>::infinity();
          if (row.between_nodes)
            row.area = 0.;
        }
      std::vector<Point<dim>> positions;
      for (SlaveBall &slave : slaves)
        {
          // Of faces of ghost cells not all nodal normals are complete here.
          const FaceGeometry geometry(*slave.face,
                                      input.slave->exact_surface(*slave.face),
                                      MasterNormal::face);
          const auto         xi = balls.above(slave.ball);
          slave.point           = {geometry.evaluate(xi).x,
                                   geometry.normal(xi),
                                   rows[slave.row].was_active,
                                   slave.guess};
          positions.push_back(slave.point.x);
        }
      search.update(positions);
      std::vector<const Face *> met;
      for (SlaveBall &slave : slaves)
        {
          slave.facing = search.look(slave.point);
          if (slave.facing)
            met.push_back(slave.facing->face);
        }
      depth.update(u, met);
      for (SlaveBall &slave : slaves)
        {
          ContactRow &row = rows[slave.row];
          row.area        = slave.area * balls.weight(slave.ball, slave.m);
          if (slave.facing)
            {
              slave.guess = search.faces().exchange().index(*slave.facing->face);
              set_row(slave, row);
            }
          else
            row.away = search.least_distance(slave.point.x);
        }
    }



    // The gap is the distance of the surfaces as they would be if no cell were pressed flat: balls
    // touch as soon as surfaces do, and keep their size. The row is divided by the weight of its
    // own node in the ball (ContactRow::share).
    void
    PinballPairing::set_row(const SlaveBall &slave, ContactRow &row) const
    {
      const FacingPoint &facing   = *slave.facing;
      const FaceGeometry master   = search.faces().geometry(*facing.face);
      const unsigned int opposite = balls.below(facing.at.xi);
      const double       share    = 1. / balls.weight(slave.ball, slave.m);
      Tensor<1, dim>     n        = master.normal(facing.at.xi) - slave.point.n;
      n /= n.norm();
      const double distance = -facing.at.along * (slave.point.n * n);
      row.has_partner       = true;
      row.away              = 0.;
      row.share             = share;
      row.normal            = n;
      row.gap               = share * (distance + depth.change(*slave.face, slave.ball) +
                         depth.change(*facing.face, opposite));
      row.gap_vector        = row.gap * n;
      row.lever             = slave.point.x - slave.face->position(slave.m);
      for (unsigned int i = 0; i < BallsInCell::n_nodes; ++i)
        row.stencil.push_back({facing.face->cell_node(i), share * balls.weight(opposite, i)});
      for (unsigned int i = 0; i < BallsInCell::n_nodes; ++i)
        if (i != slave.m)
          row.stencil.push_back({slave.face->cell_node(i), -share * balls.weight(slave.ball, i)});
    }
  } // namespace
} // namespace Touchstone
