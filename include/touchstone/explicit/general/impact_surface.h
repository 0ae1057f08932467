// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_impact_surface_h
#define touchstone_explicit_general_impact_surface_h

#include <touchstone/explicit/node_map.h>
#include <touchstone/mesh/forest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Which faces take part in general contact. */
  struct ImpactSurfaceInput
  {
    /** By body: whether all faces without a cell behind them take part but those of #ids, or only
     * those of #ids. */
    struct Boundaries
    {
      bool        all_but = false;
      BoundaryIds ids;
      /** Those of each entry of 'Symmetry', if the body takes part. */
      std::vector<BoundaryIds> symmetry;
    };
    std::vector<Boundaries> bodies;
    /** Boundaries that a declared pair brings together: for general contact they do not exist for
     * each other. */
    std::vector<std::pair<BoundaryIds, BoundaryIds>> declared;
  };

  /** @brief A face of the surface, as ranks send it to each other. */
  struct ImpactFace
  {
    /** The same on any number of ranks: of the face, and of the nodes of its cell, those of the
     * face first, in the order that turns about the outward normal. */
    std::uint64_t                key;
    std::array<std::uint64_t, 8> nodes;
    /** First dofs of the nodes of the face. */
    std::array<Index, 4>       dofs;
    unsigned int               body;
    dealii::types::boundary_id boundary;

    /** @brief Whether its cell has the node of this key. */
    bool
    of_cell(std::uint64_t node) const;
    /** @brief Whether the faces have a node in common. */
    bool
    shares_node(const ImpactFace &other) const;
  };

  /**
   * @brief The surface of bodies that general contact looks at: the faces of this rank, and the
   * outward normals of its nodes (doc/general_contact.md, section 2).
   */
  class ImpactSurface
  {
  public:
    /** @param nodes Must live as long. */
    ImpactSurface(const ImpactSurfaceInput &input, const Solid &solid, const NodeMap &nodes);

    /** @brief Faces of the cells that this rank owns. */
    const std::vector<ImpactFace> &
    faces() const
    {
      return own;
    }

    /** @brief Number of faces on all ranks. */
    std::uint64_t
    n_faces() const
    {
      return n_global;
    }

    /** @brief How a node of the surface is moved inwards. */
    struct Inset
    {
      /** The mean of the outward normals of the faces around it by their areas, of length 1, or
       * zero where they cancel. */
      dealii::Tensor<1, dim> normal;
      /** Length of which it is moved by a part: size(), but no more than #slender times that of the
       * smallest of these faces as it is, so that nothing of a sharp tip gets lost. */
      double depth = 0.;
    };
    static constexpr double slender = 2.8;
    /** @brief That of an owned node in the positions @p u. */
    Inset
    inset(unsigned int node, const NodeField &u) const;
    /** @brief Areas times normals of faces, length squared, and the number of the positions that
     * they are of. */
    struct FaceAreas
    {
      std::vector<dealii::Tensor<1, dim>> areas;
      std::vector<std::uint64_t>          positions;
    };
    /** @brief The same as that, with areas of faces that are known from other nodes.
     * @param positions Number of @p u, not zero. */
    Inset
    inset(unsigned int node, const NodeField &u, FaceAreas &known, std::uint64_t positions) const;

    /** @brief Size of the faces around an owned node of the surface as the bodies were placed,
     * length. */
    double
    size(const unsigned int node) const
    {
      return sizes[place[node]];
    }

    /** @brief A quarter of these faces together, length squared. */
    double
    area(const unsigned int node) const
    {
      return 0.25 * sizes[place[node]] * sizes[place[node]] * around[place[node]].size();
    }

    /** @brief The owned nodes of the surface, local numbers. */
    const std::vector<unsigned int> &
    owned_nodes() const
    {
      return surface_nodes;
    }

    /** @brief Whether faces of these boundaries may meet in general contact. */
    bool
    may_meet(dealii::types::boundary_id one, dealii::types::boundary_id other) const;

    /** @brief Present position of a local node, length. */
    dealii::Point<dim>
    position(const unsigned int node, const NodeField &u) const
    {
      return dealii::Point<dim>(nodes.positions()[node] + u[node]);
    }

  private:
    const NodeMap                                   &nodes;
    std::vector<std::pair<BoundaryIds, BoundaryIds>> declared;
    std::vector<ImpactFace>                          own;
    std::uint64_t                                    n_global = 0;
    /** By local node: where it stands among those of the surface. */
    std::vector<unsigned int> place, surface_nodes;
    std::vector<double>       sizes;
    /** Local nodes of the faces at owned nodes, in the order of their keys; and by place the
     * numbers of those around the node. */
    std::vector<std::array<unsigned int, 4>> corners;
    std::vector<std::vector<unsigned int>>   around;

    template <class Area>
    Inset
    inset_of(unsigned int node, const Area &area) const;
  };
} // namespace Touchstone

#endif
