// A pairing to start from: node to node. Copy to source/contact/pairing/NAME.cc and fill
// in what is marked TODO: scenes can name it.

#include <touchstone/contact/pairing/pairing.h>

#include <algorithm>

namespace Touchstone
{
  namespace
  {
    /** The stencil of a slave node is the nearest node of the nearest face. */
    class NodePairing : public Pairing
    {
    public:
      explicit NodePairing(const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 4. * input.master->largest_face(),
                 input.parameters->edge_tolerance,
                 input.parameters->master_normal,
                 input.solid->communicator)
      {
      }

      void
      update(const Vector &u, const double, std::vector<ContactRow> &rows) override
      {
        const std::vector<SurfaceNode> &nodes = input.slave->owned_nodes();
        std::vector<dealii::Point<dim>> positions;
        for (const SurfaceNode &node : nodes)
          positions.push_back(input.slave->position(node, u));
        search.update(positions); // collective: all ranks call it
        for (std::size_t k = 0; k < nodes.size(); ++k)
          {
            ContactRow &row = rows[k];
            // The start of the step would let it find what lies on the way from there.
            const auto partner = search.find(
              {positions[k], positions[k], input.slave->normal(nodes[k].node), row.was_active, {}});
            row.stencil.clear();
            if (!partner)
              {
                row.has_partner = false;
                row.gap         = 0.;
                continue;
              }
            row.has_partner = true;
            // TODO: master nodes with weights that sum to one, the unit normal of the
            // master surface, and the vector from the contact point to the slave node.
            const Face        &face = *partner->face;
            const FaceShapes   shapes(face.degree, partner->xi);
            const unsigned int m =
              std::max_element(shapes.value.begin(), shapes.value.begin() + face.n_nodes()) -
              shapes.value.begin();
            row.stencil    = {{face.nodes[m], 1.}};
            row.normal     = partner->normal;
            row.gap_vector = positions[k] - (face.reference[m] + face.displacement[m]);
            row.gap        = row.gap_vector * row.normal;
          }
      }

      // TODO: differentiate(), for quadratic convergence on curved surfaces: how
      // normal, gap vector and weights change with the nodes that they depend on.
      // Without it they are constant within a Newton iteration.

    private:
      Search search;
    };

    const PairingRegistry::Entry<NodePairing> node_to_node("node to node",
                                                           "the nearest master node");
  } // namespace
} // namespace Touchstone
