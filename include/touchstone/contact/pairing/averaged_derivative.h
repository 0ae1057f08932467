// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_averaged_derivative_h
#define touchstone_contact_pairing_averaged_derivative_h

#include <touchstone/contact/pairing/averaged_row_derivative.h>
#include <touchstone/contact/search/face_exchange.h>

#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Derivatives of averaged rows (doc/theory.md 4, "Derivatives of rows").
   *
   * The integrals are differentiated point by point, where each depends on one slave and one
   * master face only (OverlapDerivative); DualBasis makes shares of rows of them
   * (SlaveFaceDerivative). What depends on averaged nodal normals is collected per face and
   * continued to the nodes around it at the end (AveragedRowDerivative).
   */
  class AveragedDerivative
  {
  public:
    /** @param exchange       Of the master surface.
     * @param slave_exchange Of the slave surface; needed where its faces are smoothed,
     *                     or null. Both must live as long.
     * @param length       Of the OverlapIntegrals. */
    AveragedDerivative(const FaceExchange &exchange,
                       const FaceExchange *slave_exchange,
                       const double        length)
      : exchange(exchange)
      , slave_exchange(slave_exchange)
      , length(length)
    {
    }

    /** @brief Request the derivative of a row.
     * @param stencil Of the row; must live as long.
     * @param sums The sums over slave faces that the row was made from.
     * @param size Size of the faces, length.
     * @param with_area Differentiate the area of the row as well. */
    void
    add_row(Index            slave,
            const Stencil   &stencil,
            const CoverSums &sums,
            double           size,
            bool             with_area);

    /** @brief Whether the face takes part in a row whose derivative was requested.
     * @param basis Of a face with hanging nodes, or null. */
    bool
    wants(const Face &slave, const TraceBasis *basis) const;

    /** @brief Add the share of a slave face.
     * @param covering Master faces that cover it. @param at_once Of CoverShares. */
    void
    add_face(const FaceGeometry              &slave,
             const TraceBasis                *basis,
             const std::vector<const Face *> &covering,
             const CoverShares::Whole        &at_once);

    /** @brief All faces have been added: the derivatives by the slave nodes of the rows.
     * Collective. */
    std::unordered_map<Index, std::shared_ptr<const RowDerivative>>
    finish();

  private:
    struct Master
    {
      FaceGeometry       geometry;
      FaceDifferentiator differentiator;

      explicit Master(const FaceGeometry &g)
        : geometry(g)
        , differentiator(geometry)
      {
      }
    };

    const FaceExchange                              &exchange;
    const FaceExchange                              *slave_exchange;
    const double                                     length;
    std::unordered_map<Index, AveragedRowDerivative> rows;
    std::unordered_map<const Face *, Master>         masters;

    template <unsigned int n>
    void
    add(const FaceGeometry              &slave,
        const TraceBasis                *basis,
        const std::vector<const Face *> &covering,
        const CoverShares::Whole        &at_once);
  };
} // namespace Touchstone

#endif
