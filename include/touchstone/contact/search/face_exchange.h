// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_search_face_exchange_h
#define touchstone_contact_search_face_exchange_h

#include <touchstone/contact/geometry/surface.h>
#include <touchstone/contact/search/search_work.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Brings the master faces to the ranks whose slave nodes they are near.
   *
   * Each rank receives the faces that are within the reach of its slave nodes, and some more
   * around them (doc/theory.md 4, "Search"; near_ranks()).
   */
  class FaceExchange
  {
  public:
    using Box = dealii::BoundingBox<dim>;

    /**
     * @param reach Farthest distance from a slave node at which faces are wanted, length.
     * @param kind  What gaps are measured to.
     * @param arch  Of geometry().
     */
    FaceExchange(const Surface &surface,
                 double         reach,
                 MasterNormal   kind,
                 MPI_Comm       communicator,
                 Arch           arch = Arch::with_facet);

    /** @brief A step ends with the displacement @p u (with ghosts), null for the reference
     * state. Without any call faces do not know where they were at the start of the step. */
    void
    commit(const Vector *u);

    /** @brief Exchange the faces in their present position. Collective.
     * @param positions Of this rank's slave nodes, present ones and, if steps are
     *                  committed, those at the start of the step. */
    void
    update(const std::vector<dealii::Point<dim>> &positions);

    /** @brief Free the memory of the faces until the next update. */
    void
    forget();

    /** @brief Faces of the last update: of this rank, and near its slave nodes. */
    const std::vector<Face> &
    faces() const
    {
      return known;
    }

    /** @brief Whether steps are committed. */
    bool
    swept() const
    {
      return has_committed;
    }

    /** @brief The face with this key, null if this rank has not received it. */
    const Face *
    face(std::uint64_t key) const;

    /** @brief The same with the index that the face had in faces() at an earlier update, which it
     * still has if nothing else was received. */
    const Face *
    face(const std::uint64_t key, const std::size_t index_before) const
    {
      return index_before < known.size() && known[index_before].key == key ? &known[index_before]
                                                                           : face(key);
    }

    /** @brief The index of a face in faces(). */
    std::size_t
    index(const Face &face) const
    {
      return &face - known.data();
    }

    /** @brief What gaps to a face are measured to. */
    FaceGeometry
    geometry(const Face &face) const
    {
      return FaceGeometry(face, surface.exact_surface(face), kind, arch);
    }

    /** @brief Gaps to a face are measured to the bilinear surface of its nodes. */
    bool
    is_plane(const Face &face) const
    {
      return face.degree == 1 && kind != MasterNormal::smoothed && exact_surface(face) == nullptr;
    }

    /** @brief How far faces can have come towards a point since the start of the step, which itself
     * has moved by @p motion: no point of a face has moved by more relative to it; length. */
    double
    approach(const dealii::Tensor<1, dim> &motion) const
    {
      double square = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double most =
            std::max(std::abs(motion[d] - least_moved[d]), std::abs(most_moved[d] - motion[d]));
          square += most * most;
        }
      return std::sqrt(square);
    }

    /** @brief The same for a point at rest. */
    double
    largest_motion() const
    {
      return approach(dealii::Tensor<1, dim>());
    }

    /** @brief Gaps are measured to patches. */
    bool
    smoothed() const
    {
      return kind == MasterNormal::smoothed;
    }

    /** @brief Gaps to some face are measured to points that depend on the normals of its nodes. */
    bool
    follow_normals() const
    {
      return smoothed() || (arch == Arch::with_normals && surface.has_exact_surfaces());
    }

    /** @brief The exact surface of a face, or null: facets. */
    const AnalyticSurface *
    exact_surface(const Face &face) const
    {
      return surface.exact_surface(face);
    }

    /** @brief The box around a face, in its present position and, for the second, also where it
     * was at the start of the step and between. */
    Box
    box(const Face &face) const;
    Box
    swept_box(const Face &face) const;
    /** @brief The box around a face at the start of the step. */
    Box
    committed_box(const Face &face) const;

    /** @brief Derivatives of the averaged normals of faces(), from the ranks that own them. Empty
     * if normals come from the faces alone. Collective. */
    std::unordered_map<const Face *, std::vector<NormalDerivative>>
    normal_derivatives(const std::vector<const Face *> &needed) const;

    /** @brief Messages and faces sent since this was made. */
    const SearchWork &
    work() const
    {
      return counted;
    }

  private:
    /** Of the nodes of a face. */
    using Displacements = std::array<dealii::Tensor<1, dim>, Face::max_nodes>;

    const Surface     &surface;
    const double       reach;
    const MasterNormal kind;
    const MPI_Comm     communicator;
    const Arch         arch;
    std::vector<Face>  known;
    SearchWork         counted;
    /** Of the nodes of the known faces, the least and the most since the start of the step. */
    dealii::Tensor<1, dim> least_moved, most_moved;

    /** Displacements at the start of the step, of the nodes of this rank's faces, face by face: all
     * have as many. */
    std::vector<dealii::Tensor<1, dim>> committed;
    bool                                has_committed = false;

    /** Indices of this rank's faces that each rank has received, and where its own
     * copies of those of another rank begin. */
    std::map<unsigned int, std::vector<std::size_t>> sent;
    std::map<unsigned int, std::size_t>              received;

    /** Indices in `known` by key, filled when a face is first asked for: most updates need none. */
    mutable std::unordered_map<std::uint64_t, std::size_t> by_key;

    Box
    box(const Face &face, const Displacements &displacement) const;
    /** A face of this rank with its displacement at the start of the step. */
    Face
    own_face(std::size_t f) const;
    /** The faces that ranks need of each other. Collective. */
    void
    exchange_faces(const std::vector<dealii::Point<dim>> &positions);
    /** All faces of this rank, in their order, where it is the only one. */
    void
    keep_own_faces();
    /** Set #least_moved and #most_moved. */
    void
    measure_motion();
  };
} // namespace Touchstone

#endif
