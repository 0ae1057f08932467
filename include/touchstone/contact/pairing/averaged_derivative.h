#ifndef touchstone_contact_pairing_averaged_derivative_h
#define touchstone_contact_pairing_averaged_derivative_h

#include <touchstone/contact/pairing/partial_cover.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/search/search.h>

#include <list>
#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Derivatives of averaged rows.
   *
   * With the mass matrix M, the areas a and the integrals Q_j = int N_j q over the
   * overlaps of a slave face, its share of row k is sum_i T_ki a_i (M^-1 Q)_i, for q the
   * master shapes, the gap, the normal, and one, and T of CoverShares. The integrals are
   * differentiated point by point, where each depends on one slave and one master face only;
   * d M^-1 = -M^-1 dM M^-1 makes shares of them. What depends on averaged nodal
   * normals is collected per face and continued to the nodes around it at the end.
   */
  class AveragedDerivative
  {
  public:
    /** @param search       Of the master surface.
     * @param slave_search Of the slave surface; needed where its faces are smoothed,
     *                     or null. Both must live as long.
     * @param gradual      Of the CoverShares. */
    AveragedDerivative(const Search &search, const Search *slave_search, const bool gradual)
      : search(search)
      , slave_search(slave_search)
      , gradual(gradual)
    {
    }

    /** @brief Want the derivative of a row.
     * @param sums The sums over slave faces that the row was made from; must live as long. */
    void
    add_row(const ContactRow &row, const CoverSums &sums);

    /** @brief Whether the face takes part in a row that is wanted.
     * @param basis Of a face with hanging nodes, or null. */
    bool
    wants(const Face &slave, const TraceBasis *basis) const;

    /** @brief Add the share of a slave face.
     * @param masters Master faces that cover it. */
    void
    add_face(const FaceGeometry              &slave,
             const TraceBasis                *basis,
             const std::vector<const Face *> &masters);

    /** @brief All faces have been added. Collective. */
    void
    finish();

    /** @brief The derivative of the row of a slave node that was wanted. */
    std::shared_ptr<const RowDerivative>
    result(const Index slave) const
    {
      return rows.at(slave).builder.result;
    }

  private:
    /** What depends on the averaged normals of the nodes of a master face. */
    struct ByNormals
    {
      NodeMatrices normal, gap;
    };

    /** The point with the smallest gap of some, and how that depends on positions and, in the last
     * two, on averaged normals of the nodes of its faces. */
    struct Least
    {
      double                                              gap;
      const Face                                         *master;
      std::uint64_t                                       slave;
      NodalForm                                           by_nodes;
      std::array<dealii::Tensor<1, dim>, Face::max_nodes> by_normals, by_slave_normals;
    };

    struct Row
    {
      const ContactRow    *row;
      const CoverSums     *sums;
      GapCorrection        correction;
      RowDerivativeBuilder builder;
      /** Derivatives of the areas of CoverSums and of the smallest gap. */
      std::vector<dealii::Tensor<1, dim>>         d_area, d_kept, d_given, d_least, d_own;
      std::optional<Least>                        least, own;
      std::unordered_map<const Face *, ByNormals> by_normals;
      /** The gap by those of slave faces, known by their keys. */
      std::unordered_map<std::uint64_t, NodeMatrices> by_slave_normals;
      /** Places of master nodes in the stencil. */
      std::unordered_map<Index, unsigned int> stencil;
    };

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

    const Search                            &search;
    const Search                            *slave_search;
    const bool                               gradual;
    std::unordered_map<Index, Row>           rows;
    std::unordered_map<const Face *, Master> masters;

    static void
    to_means(Row &row);
    /** How the gap of the closest point changes with the positions of the nodes of the
     * builder. @param of_master, of_slave Derivatives of nodal normals, or null. */
    static std::vector<dealii::Tensor<1, dim>>
    derivative(const Least                         &least,
               RowDerivativeBuilder                &builder,
               const std::vector<NormalDerivative> *of_master,
               const std::vector<NormalDerivative> *of_slave);

    template <unsigned int n>
    void
    add(const FaceGeometry &slave, const TraceBasis *basis, const std::vector<const Face *> &near);
  };
} // namespace Touchstone

#endif
