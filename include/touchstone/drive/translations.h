// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_translations_h
#define touchstone_drive_translations_h

#include <touchstone/base/types.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Touchstone
{
  /** @brief For each body the translation that comes closest to motions in given directions. */
  class Translations
  {
  public:
    explicit Translations(unsigned int n_bodies);

    /** @brief Body number @p body is to move by @p motion, length, along the unit vector
     * @p direction. */
    void
    add(unsigned int body, const dealii::Tensor<1, dim> &direction, double motion);

    /** @brief Add up what the ranks have added. Collective. */
    void
    complete(MPI_Comm communicator);

    /** @brief The translation v of least length with d . v closest to the motions in the directions
     * d; that along directions in which none is given is zero; length. */
    dealii::Tensor<1, dim>
    closest(unsigned int body) const;

  private:
    /** Of each body: sum of d (x) d, and of d times the motion. */
    std::vector<double> sums;
  };

  /** @brief Add a translation of each body, by its number, to a displacement @p u; owned dofs,
   * length. */
  void
  translate_bodies(const Solid                               &solid,
                   const std::vector<dealii::Tensor<1, dim>> &motions,
                   Vector                                    &u);
} // namespace Touchstone

#endif
