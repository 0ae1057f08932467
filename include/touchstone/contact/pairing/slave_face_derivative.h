// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_slave_face_derivative_h
#define touchstone_contact_pairing_slave_face_derivative_h

#include <touchstone/algebra/stencil.h>
#include <touchstone/contact/pairing/dual_basis.h>
#include <touchstone/contact/pairing/overlap_derivative.h>

#include <list>
#include <vector>

namespace Touchstone
{
  /**
   * @brief The integrals over all that is covered of a slave face, with derivatives, and what the
   * rows of its nodes take of them.
   *
   * Variables are the positions of the n slave nodes and then of all master nodes, each once:
   * component e of node i is variable dim i + e. Columns are those of OverlapColumns, with all
   * master nodes.
   */
  template <unsigned int n>
  class SlaveFaceDerivative
  {
  public:
    /** What the master faces cover; one element for each. */
    using Parts = std::list<OverlapDerivative<n>>;

    /**
     * @param slave The face, and @p basis its TraceBasis or null; must live as long.
     * @param parts Must live as long; their areas must not all be zero.
     * @param at_once Of CoverShares.
     */
    SlaveFaceDerivative(const FaceGeometry       &slave,
                        const TraceBasis         *basis,
                        const Parts              &parts,
                        const CoverShares::Whole &at_once);

    const FaceGeometry &slave;
    const Parts        &parts;

    /** The nodes to which the rows belong, and the master nodes in ascending order. */
    std::vector<Index> own, masters;

    const DualBasis dual;

    /** @brief Number of nodes that the integrals depend on. */
    unsigned int
    n_nodes() const
    {
      return n + masters.size();
    }

    /** @brief Index of a master node among all nodes. */
    unsigned int
    index_of_master(Index node) const;

    /** @brief The nodes that determine the position of node @p i, with weights. A hanging node
     * moves with those that it follows: if a row referred to it, constraints would depend on each
     * other in a cycle. */
    Stencil
    carriers(unsigned int i) const;

    /** @brief Derivative by one coordinate of the contributions of the face to a row. */
    struct Change
    {
      /** Of S_ki, of a~_k, and of the kept area in the reference state; length. */
      DualBasis::Values share;
      double            area, reference;
      /** Of the integrals with psi'_k, by columns. */
      std::vector<double> integrals;
      /** Of the integrals of gap, 1, arch and OverlapSample::inclined with DualBasis::positive().
       */
      dealii::Tensor<1, dim> shape_gap;
      double                 shape_area, arch, inclined;
    };

    /** @brief Evaluate it for component @p e of node @p i. */
    void
    differentiate(unsigned int k, unsigned int i, unsigned int e, Change &change) const;

    /** @brief Whether less than the whole of what belongs to row @p k is covered, so that its
     * area changes. */
    bool
    covered_in_part(unsigned int k) const;

  private:
    const TraceBasis *basis;
    /** [variable][j][k] and [variable][j][column]: dM and dQ. */
    dealii::Table<3, double> d_mass, d_q;
    DualBasis::Solution      solution;
    /** Areas of the whole face in the reference and in the present state, and the derivatives
     * of the latter. */
    DualBasis::Values                                               whole, present;
    std::array<std::array<DualBasis::Values, dim>, Face::max_nodes> d_present;

    /** Sum up the parts. @return Q. */
    dealii::FullMatrix<double>
    assemble();
  };
} // namespace Touchstone

#endif
