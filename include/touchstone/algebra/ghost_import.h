// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_ghost_import_h
#define touchstone_algebra_ghost_import_h

#include <touchstone/algebra/vector.h>

#include <deal.II/base/exceptions.h>

#include <Epetra_Import.h>

namespace Touchstone
{
  /** @brief Copies vectors to vectors with ghosts by a communication plan that is made once;
   * deal.II's assignment makes a new one in each call. */
  class GhostImport
  {
  public:
    /** @brief Plans the messages. @param from,to Any vectors of the two layouts. Collective. */
    GhostImport(const Vector &from, const Vector &to)
      : plan(to.trilinos_partitioner(), from.trilinos_partitioner())
    {
    }

    /** @brief Copy @p from to @p to with its ghosts. Collective.
     * @throws dealii::ExcTrilinosError */
    void
    operator()(const Vector &from, Vector &to) const
    {
      const int error = to.trilinos_vector().Import(from.trilinos_vector(), plan, Insert);
      AssertThrow(error == 0, dealii::ExcTrilinosError(error));
    }

  private:
    Epetra_Import plan;
  };
} // namespace Touchstone

#endif
