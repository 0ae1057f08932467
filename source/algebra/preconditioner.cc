// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/preconditioner.h>

namespace Touchstone
{
  // Rigid motions over the condensed dofs (doc/theory.md, section 8). Constrained dofs have been
  // eliminated. The dof of an elongation is treated like one of them: a stiff spring hardly
  // elongates in a motion of little energy.
  Epetra_MultiVector
  near_null_space(const CondensedSystem &system, const RigidMotions &motions)
  {
    Epetra_MultiVector result(motions.position.Map(), motions.n);
    for (unsigned int k = 0; k < motions.n; ++k)
      for (int i = 0; i < result.MyLength(); ++i)
        if (!system.constrained[i] && !system.changed[i])
          result[k][i] = motions(k, i);
    return result;
  }
} // namespace Touchstone
