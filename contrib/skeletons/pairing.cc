// SPDX-License-Identifier: LGPL-2.1-or-later
// A pairing to start from: node to node. Copy to source/contact/pairing/NAME.cc and change
// what is marked TODO: 'set Pairing = NAME' selects it, and nothing else need be edited.

#include <touchstone/base/input_error.h>
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
      // TODO: keys of its own, in the section of the contact pair; leave it out if there are none.
      struct Parameters : public PluginParameters
      {
        double reach = 4.;

        void
        declare(dealii::ParameterHandler &prm) override
        {
          prm.add_parameter("Search reach",
                            reach,
                            "How far partners are looked for, in diagonals of the largest master "
                            "face, positive. [no unit]");
        }

        void
        check(const std::string &section) const override
        {
          if (!(reach > 0.))
            throw InputError(section,
                             "Search reach",
                             dealii::Patterns::Tools::to_string(reach),
                             "must be positive",
                             "4 is a good choice");
        }
      };

      NodePairing(const Parameters &own, const PairingInput &input)
        : Pairing(input)
        , search(*input.master,
                 own.reach * input.master->largest_face(),
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
