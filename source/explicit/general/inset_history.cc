// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/inset_history.h>

// Surfaces that are moved inwards from one cycle to the next (doc/general_contact.md, section 3).
namespace Touchstone
{
  using namespace dealii;

  InsetHistory::InsetHistory(const ImpactSurface &surface, const NodeMap &nodes)
    : surface(surface)
    , nodes(nodes)
    , insets(nodes.n_local())
    , insets_of(nodes.n_local(), 0)
  {
  }



  void
  InsetHistory::begin_cycle(const NodeField &u, const NodeField &v_before, const double step_before)
  {
    bool same = begun;
    for (const unsigned int node : surface.owned_nodes())
      same = same && u[node] == begun_at[node];
    // A cycle that is halved begins where it has begun.
    if (Utilities::MPI::min(int(same), nodes.communicator()) == 1)
      return;
    // What belongs to an earlier interval is not that of the cycle before.
    present += begun ? 1 : 2;
    if (begun)
      begun_before.swap(begun_at);
    else
      {
        begun_before = u;
        if (step_before > 0.)
          for (unsigned int node = 0; node < nodes.n_local(); ++node)
            begun_before[node] -= step_before * v_before[node];
      }
    begun_at = u;
    begun    = true;
  }



  const InsetHistory::Insets &
  InsetHistory::at(const unsigned int node)
  {
    Insets &of = insets[node];
    if (insets_of[node] != present)
      {
        of.before = insets_of[node] + 1 == present ? of.now : surface.inset(node, begun_before);
        of.now    = surface.inset(node, begun_at, face_areas, present);
        insets_of[node] = present;
      }
    return of;
  }
} // namespace Touchstone
