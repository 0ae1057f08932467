// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/drive/step_system.h>
#include <touchstone/solid/connected_parts.h>

#include <deal.II/base/mpi.h>

#include <string>
#include <vector>

// Parts of bodies that nothing holds although something holds the body.
namespace Touchstone
{
  using namespace dealii;

  // The rigid motions of a body say nothing of parts that are not connected with the rest.
  void
  StepSystem::check_parts(const std::vector<Condition> &held)
  {
    const ConnectedParts      connected(parts.solid);
    const std::vector<bool>   is_held = connected.held(held);
    std::vector<unsigned int> meets(connected.n_parts(), 0);
    for (unsigned int p = 0; p < parts.contact.n_pairs(); ++p)
      for (const Surface *const side :
           {&parts.contact.pair(p).slave(), parts.contact.pair(p).master()})
        if (side != nullptr)
          for (const SurfaceNode &node : side->owned_nodes())
            meets[connected.of_node(node.node)] = 1;
    Utilities::MPI::max(meets, parts.solid.communicator, meets);
    std::vector<unsigned int> free, alone;
    for (unsigned int k = 0; k < connected.n_parts(); ++k)
      if (!is_held[k] && connected.has_others(k))
        (meets[k] == 1 ? free : alone).push_back(k);
    if (!alone.empty())
      throw InputError("Body " + connected.body(alone.front()),
                       "Geometry",
                       "",
                       "nothing holds what is not connected with the rest: " +
                         connected.describe(alone),
                       "merge the nodes of its mesh where parts are to be connected, leave such "
                       "parts out, or add boundaries that they have to 'Fixed', 'Symmetry' or a "
                       "contact pair.");
    if (!free.empty())
      free_parts = connected.describe(free);
  }
} // namespace Touchstone
