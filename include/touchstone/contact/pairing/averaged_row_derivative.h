// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_averaged_row_derivative_h
#define touchstone_contact_pairing_averaged_row_derivative_h

#include <touchstone/contact/pairing/averaged_row.h>
#include <touchstone/contact/pairing/row_derivative.h>
#include <touchstone/contact/pairing/slave_face_derivative.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /** @brief Collects the derivative of one averaged row from the slave faces around its node. */
  class AveragedRowDerivative
  {
  public:
    /**
     * @param stencil   Of the row; must live as long.
     * @param sums      The sums that the row was made from.
     * @param size      Size of the faces, length.
     * @param with_area Differentiate the area of the row as well.
     */
    AveragedRowDerivative(const Stencil   &stencil,
                          const CoverSums &sums,
                          double           size,
                          bool             with_area);

    /** @brief Add what row @p k of the nodes of a slave face takes of it. */
    template <unsigned int n>
    void
    add_face(unsigned int k, const SlaveFaceDerivative<n> &face);

    /** @brief Keys of the slave faces whose normal_derivatives() finish() needs. */
    std::vector<std::uint64_t>
    slave_faces() const;

    /** The derivatives of the nodal normals of a master face, or null where normals do not depend
     * on those of the nodes; and of a slave face of slave_faces(). */
    using OfMaster = std::function<const std::vector<NormalDerivative> *(const Face *)>;
    using OfSlave  = std::function<const std::vector<NormalDerivative> *(std::uint64_t key)>;

    /** @brief All faces have been added. */
    std::shared_ptr<const RowDerivative>
    finish(const OfMaster &of_master, const OfSlave &of_slave);

  private:
    /** What depends on the averaged normals of the nodes of a master face: the integrals of the
     * normal and, if the face is a smooth patch, of the gap. */
    struct ByNormals
    {
      NodeMatrices normal, gap;
      bool         smooth;
    };

    /** The point with the smallest gap, and the derivatives of that gap by positions and, in the
     * last two, by the averaged normals at the nodes of its two faces. */
    struct ClosestPoint
    {
      double        gap;
      const Face   *master;
      std::uint64_t slave;
      NodalForm     by_nodes;
      /** Of the displacement there, which does not depend on normals. */
      std::vector<std::pair<Index, dealii::Tensor<2, dim>>> moved_by_nodes;
      std::array<dealii::Tensor<1, dim>, Face::max_nodes>   by_master_normals, by_slave_normals;
    };

    const Stencil       &stencil;
    const AveragedRow    row;
    const bool           with_area;
    bool                 area_changes = false;
    RowDerivativeBuilder builder;
    /** By the index of the node in the builder. */
    std::vector<CoverSumsDerivative> sums;
    std::optional<ClosestPoint>      least, own, beside;
    /** Of GapCorrection::face. */
    std::optional<ClosestPoint> face_own, face_beside, face_least;
    /** The integral of the arch by normals of slave faces. */
    std::unordered_map<std::uint64_t, std::array<dealii::Tensor<1, dim>, Face::max_nodes>>
      arch_by_slave_normals;
    /** Its integrals of the gap with psi'_k and DualBasis::positive() by the normals of its nodes.
     */
    NodeMatrices face_gap_by_slave{}, face_shape_gap_by_slave{};
    /** The same by the normals of master patches. */
    std::unordered_map<const Face *, std::array<NodeMatrices, 2>> face_by_master;

    std::unordered_map<const Face *, ByNormals> by_master_normals;
    /** The integral of the gap by normals of slave faces, known by their keys. */
    std::unordered_map<std::uint64_t, NodeMatrices> by_slave_normals;
    /** Indices of nodes in the stencil. */
    std::unordered_map<Index, unsigned int> in_stencil;

    /** Index of a node in the builder, with an entry in `sums`. */
    std::size_t
    index(Index node);
    template <unsigned int n>
    void
    add_positions(unsigned int k, const SlaveFaceDerivative<n> &face);
    template <unsigned int n>
    void
    add_normals(unsigned int k, const SlaveFaceDerivative<n> &face);
    /** @brief Add what the deciding face contributes besides. */
    template <unsigned int n>
    void
    add_deciding(unsigned int k, const SlaveFaceDerivative<n> &face);
    /** @brief Continue derivatives of the deciding face by normals to the nodes. */
    void
    finish_deciding(const OfMaster &of_master, const OfSlave &of_slave);
    template <unsigned int n>
    static void
    offer(std::optional<ClosestPoint>                    &closest,
          const PositionFad<n>                           &gap,
          const typename OverlapDerivative<n>::ByNormals &by_normals,
          const SlaveFaceDerivative<n>                   &face,
          const Face                                     &master,
          const Vector3<PositionFad<n>>                  *moved = nullptr);
    void
    continue_closest(const ClosestPoint                                                   &point,
                     const std::function<dealii::Tensor<1, dim> &(CoverSumsDerivative &)> &of_point,
                     const OfMaster &of_master,
                     const OfSlave  &of_slave);
  };
} // namespace Touchstone

#endif
