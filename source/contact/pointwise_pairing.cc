#include <touchstone/contact/pairing.h>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Node-to-surface: the stencil of a slave node are the shape functions of
     * the master face at the closest point. */
    class PointwisePairing : public Pairing
    {
    public:
      explicit PointwisePairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 // A node that has gone deeper than its neighbours are apart must
                 // still find its way out.
                 input.parameters->search_distance > 0.
                   ? input.parameters->search_distance
                   : 4. * std::max(input.slave->largest_face(), input.master->largest_face()),
                 input.parameters->edge_tolerance,
                 input.solid->communicator)
      {
      }

      void
      update(const Vector &u, const double, std::vector<ContactRow> &rows) override
      {
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        std::vector<Point<dim>>         positions;
        for (const SurfaceNode &node : nodes)
          positions.push_back(input.slave->position(node, u));
        search.update(positions);
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            ContactRow &row = rows[k];
            const auto  partner =
              search.find(positions[k], input.slave->normal(nodes[k].node), row.active());
            row.stencil.clear();
            if (!partner)
              {
                row.status = ContactStatus::no_partner;
                row.gap    = 0.;
                continue;
              }
            if (row.status == ContactStatus::no_partner)
              row.status = ContactStatus::open;
            const FaceShapes shapes(partner->face->degree, partner->xi);
            for (unsigned int m = 0; m < partner->face->n_nodes(); ++m)
              if (std::abs(shapes.value[m]) > 1e-14)
                row.stencil.push_back({partner->face->nodes[m], shapes.value[m]});
            row.normal     = partner->normal;
            row.gap_vector = positions[k] - partner->x;
            row.gap        = row.gap_vector * row.normal;
          }
      }

    private:
      Search search;
    };

    const PairingRegistry::Entry<PointwisePairing>
      entry("pointwise", "node-to-surface by closest-point projection");
  } // namespace
} // namespace Touchstone
