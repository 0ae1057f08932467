// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_contact_partition_h
#define touchstone_explicit_general_contact_partition_h

#include <touchstone/base/types.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief Space divided among the ranks by recursive coordinate bisection, so that each has about
   * as many faces of contact surfaces in its region, wherever their cells live (the second
   * decomposition of Attaway et al. 1998, Comput. Mech. 22; doc/general_contact.md, section 5).
   *
   * Each rank holds the cuts of all, which are one less than there are ranks, and no others.
   */
  class ContactPartition
  {
  public:
    explicit ContactPartition(MPI_Comm communicator);

    /** @brief Cut anew, after forget() or if a region has far more than the mean of these points,
     * which are present positions on this rank, length. Collective.
     * @return the largest over the mean. */
    double
    balance(const std::vector<dealii::Point<dim>> &points);

    /** @brief The present cuts do not matter to the next ones. */
    void
    forget()
    {
      cut_anew = true;
    }

    /** @brief The rank whose region has this point. */
    unsigned int
    owner(const dealii::Point<dim> &point) const;

    /** @brief Call @p use(rank) for each rank whose region meets the box. */
    template <class Use>
    void
    for_each_owner(const dealii::BoundingBox<dim> &box, const Use &use) const
    {
      visit(box, 0, n_ranks, 0, use);
    }

  private:
    const MPI_Comm     communicator;
    const unsigned int n_ranks;
    /** Of a group of ranks the lower half has what lies below the position. */
    struct Cut
    {
      unsigned int axis     = 0;
      double       position = 0.;
    };
    /** Of a group, then those of its lower half, then those of its upper half. */
    std::vector<Cut> cuts;
    bool             cut_anew = true;

    /** Ranks of the lower half of a group. */
    static unsigned int
    lower_half(const unsigned int n)
    {
      return n / 2;
    }

    template <class Use>
    void
    visit(const dealii::BoundingBox<dim> &box,
          const unsigned int              first,
          const unsigned int              n,
          const unsigned int              cut,
          const Use                      &use) const
    {
      if (n == 1)
        {
          use(first);
          return;
        }
      const auto &[axis, position] = cuts[cut];
      const unsigned int lower     = lower_half(n);
      if (box.lower_bound(axis) < position)
        visit(box, first, lower, cut + 1, use);
      if (!(box.upper_bound(axis) < position))
        visit(box, first + lower, n - lower, cut + lower, use);
    }

    double
    imbalance(const std::vector<dealii::Point<dim>> &points) const;
    void
    bisect(std::vector<dealii::Point<dim>> &points,
           std::size_t                      begin,
           std::size_t                      end,
           unsigned int                     n,
           unsigned int                     cut);
  };
} // namespace Touchstone

#endif
