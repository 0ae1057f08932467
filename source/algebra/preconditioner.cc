// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/preconditioner.h>

namespace Touchstone
{
  Epetra_MultiVector
  near_null_space(const CondensedSystem &system, const RigidMotions &motions)
  {
    Epetra_MultiVector result(motions.columns);
    for (int v = 0; v < result.NumVectors(); ++v)
      for (int i = 0; i < result.MyLength(); ++i)
        if (system.constrained[i] || system.changed[i])
          result[v][i] = 0.;
    return result;
  }
} // namespace Touchstone
