// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/kept_factors.h>

namespace Touchstone
{
  KeptFactors::KeptFactors(const CondensedSystem &system)
    : SquareOperator(system.rows(), "kept factors")
    // No low-rank compression: near incompressibility what it leaves out is as large as the
    // stiffness against a change of shape, and 1e-6 of the blocks cost 126 iterations.
    , factors(0., false)
  {
    factors.factorise(*system.matrix(),
                      system.symmetric ? MumpsFactors::Kind::definite
                                       : MumpsFactors::Kind::unsymmetric,
                      system.n_displacements());
    // The copy of the matrix serves to recognise an unchanged one; these factors are never
    // renewed.
    factors.release_matrix();
  }



  int
  KeptFactors::ApplyInverse(const Epetra_MultiVector &rhs, Epetra_MultiVector &result) const
  {
    for (int v = 0; v < rhs.NumVectors(); ++v)
      factors.solve(*rhs(v), *result(v));
    return 0;
  }
} // namespace Touchstone
