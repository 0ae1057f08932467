// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_square_operator_h
#define touchstone_algebra_square_operator_h

#include <Epetra_Map.h>
#include <Epetra_Operator.h>

namespace Touchstone
{
  /** @brief Default implementation of Epetra's interface for a square operator over the dofs of a
   * map, of which derived classes implement Apply() or ApplyInverse() only. */
  class SquareOperator : public Epetra_Operator
  {
  public:
    SquareOperator(const Epetra_Map &map, const char *label)
      : map(map)
      , label(label)
    {
    }

    int
    SetUseTranspose(bool) override
    {
      return -1;
    }
    int
    Apply(const Epetra_MultiVector &, Epetra_MultiVector &) const override
    {
      return -1;
    }
    int
    ApplyInverse(const Epetra_MultiVector &, Epetra_MultiVector &) const override
    {
      return -1;
    }
    double
    NormInf() const override
    {
      return 0.;
    }
    const char *
    Label() const override
    {
      return label;
    }
    bool
    UseTranspose() const override
    {
      return false;
    }
    bool
    HasNormInf() const override
    {
      return false;
    }
    const Epetra_Comm &
    Comm() const override
    {
      return map.Comm();
    }
    const Epetra_Map &
    OperatorDomainMap() const override
    {
      return map;
    }
    const Epetra_Map &
    OperatorRangeMap() const override
    {
      return map;
    }

  protected:
    const Epetra_Map map;

  private:
    const char *const label;
  };
} // namespace Touchstone

#endif
