// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_averaged_sums_h
#define touchstone_contact_pairing_averaged_sums_h

#include <touchstone/contact/pairing/averaged_face.h>
#include <touchstone/contact/pairing/cover_of_nodes.h>
#include <touchstone/contact/pairing/row_sums.h>

#include <vector>

namespace Touchstone
{
  /**
   * @brief The sums over slave faces from which the rows of averaged pairing are made: integrals
   * over what master faces cover, with the dual basis of each slave face (doc/theory.md 3, 3.1 and
   * 3.2).
   *
   * The rows are those of the owned nodes; what a face adds to rows of other ranks is summed there.
   */
  class AveragedSums
  {
  public:
    /** @param slave Must live as long. @param kind What gaps are measured to.
     * @param tied Whether the rows are those of a tied pair.
     * @param one_of_several PairingInput::one_of_several: cover() is wanted. */
    AveragedSums(const Surface &slave, MasterNormal kind, bool tied, bool one_of_several);

    /** @brief Nothing has been added. */
    void
    clear();

    /**
     * @brief Add a slave face, and set its AveragedFace::cover.
     * @param slave   The face in its present position.
     * @param masters What covers it.
     * @param on_masters The geometries of these, in their order.
     */
    void
    add(AveragedFace                            &face,
        const Face                              &slave,
        const std::vector<FacingFace>           &masters,
        const std::vector<const FaceGeometry *> &on_masters);

    /** @brief All faces have been added. */
    void
    finish();

    /** @brief Decide from what has been added which nodes keep their rows
     * (CoverOfNodes::keep_rows): it is the committed state, or the first one. */
    void
    set_keep_rows();

    /** @brief Of the row of an owned node. */
    const RowSums &
    operator[](const std::size_t row) const
    {
      return sums[row];
    }

    /** @brief What is covered; if there are other pairs. */
    const CoverOfNodes &
    cover() const
    {
      return covered_nodes;
    }

  private:
    const Surface     &slave_surface;
    const MasterNormal kind;
    const bool         tied, one_of_several;

    /** In the order of the owned nodes. */
    std::vector<RowSums> sums;
    CoverOfNodes         covered_nodes;
    /** The areas of nodes that are to leave their rows to others, on faces that cannot take them.
     */
    CoverOfNodes::Areas left_alone;

    /** @tparam n Nodes of the face. */
    template <unsigned int n>
    void
    add_covered(AveragedFace                            &face,
                const Face                              &slave,
                const std::vector<FacingFace>           &masters,
                const std::vector<const FaceGeometry *> &on_masters);
    /** Add what row @p k of the face takes of the @p parts that master faces cover. */
    template <unsigned int n>
    void
    add_row(unsigned int                                    k,
            const AveragedFace                             &face,
            const Face                                     &slave,
            const std::vector<FacingFace>                  &masters,
            const std::vector<OverlapIntegrals<n, double>> &parts,
            const DualBasis                                &dual,
            double                                          present_area);
    /** Note what nodes without rows have of a face whose other nodes cannot take it.
     * @param areas Of what is covered, by node. @param plane plane_normal() of the face. */
    void
    add_left_alone(const AveragedFace           &face,
                   const Face                   &slave,
                   const DualBasis::Values      &areas,
                   const dealii::Tensor<1, dim> &plane);
    /** Add the parts of the face that nodes give to others. @param shares Of the face. */
    void
    add_shares(const AveragedFace &face, const Face &slave, const CoverShares &shares);
  };
} // namespace Touchstone

#endif
