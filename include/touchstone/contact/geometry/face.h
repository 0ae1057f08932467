// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_geometry_face_h
#define touchstone_contact_geometry_face_h

#include <touchstone/base/types.h>
#include <touchstone/mesh/analytic_surface.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace Touchstone
{
  /**
   * @brief A face of a contact surface with all that is needed to evaluate it
   * on any rank: bilinear (degree 1, 4 nodes) or biquadratic (degree 2, 9 nodes).
   *
   * Nodes are numbered lexicographically over the face coordinates xi in
   * [-1,1]^2, and xi is oriented such that dx/dxi_1 x dx/dxi_2 points outward.
   * Plain data: it is sent between ranks as it is.
   */
  struct Face
  {
    static constexpr unsigned int max_nodes = 9;
    /** From this number on cell_node() is on the opposite face of the cell. */
    static constexpr unsigned int behind = 4;
    /** At least as many as it has nodes and edges. */
    static constexpr unsigned int parts = 16;

    /** Order of faces that does not depend on the partition. */
    std::uint64_t key    = 0;
    unsigned int  degree = 1;
    /** Boundary id, which leads to the exact surface if there is one. */
    dealii::types::boundary_id boundary = 0;
    unsigned int               body     = 0;
    /** Bit 0: the edge xi_1 = -1 is an edge of the whole surface, bit 1:
     * xi_1 = 1, bit 2: xi_2 = -1, bit 3: xi_2 = 1. */
    unsigned int outer_edges = 0;
    /** Those of them, in the same bits, beyond which the other half of the body goes on: they lie
     * on planes of symmetry, see Surface::set_planes_of_symmetry(). */
    unsigned int mirrored_edges = 0;

    std::array<Index, max_nodes> nodes{};
    /** Those at the corners of the opposite face of the cell, in the order of the corners. */
    std::array<Index, behind> nodes_behind{};
    /** Least distance of a corner from that opposite to it, in the reference state: the body is
     * nowhere thinner behind the face. Length; zero where it is not known. */
    double depth_of_cell = 0.;
    /** Nodes that leave their part of the face to the others, for no row is theirs: those of
     * Surface::set_without_rows(), in the order of the continuous basis, see TraceBasis. */
    std::array<bool, max_nodes>                   without_row{};
    std::array<dealii::Point<dim>, max_nodes>     reference;
    std::array<dealii::Tensor<1, dim>, max_nodes> displacement;
    /** Displacement at the start of the step. */
    std::array<dealii::Tensor<1, dim>, max_nodes> committed;
    /** Unit normals averaged over the faces that meet at the node, but for those
     * beyond a sharp edge; over all of them; and those of the face alone. */
    std::array<dealii::Tensor<1, dim>, max_nodes> normals, edge_normals, own_normals;
    /** What `normals` are in the reference state. */
    std::array<dealii::Tensor<1, dim>, max_nodes> made_normals;

    unsigned int
    n_nodes() const
    {
      return (degree + 1) * (degree + 1);
    }

    /** @brief The edges, in the bits of outer_edges, where the surface of the whole body ends. */
    unsigned int
    ends() const
    {
      return outer_edges & ~mirrored_edges;
    }

    /** @brief The node at a corner of the cell: of the face, and from Face::behind on those
     * opposite to them, in the same order. */
    Index
    cell_node(const unsigned int i) const
    {
      return i < behind ? nodes[i % 2 * degree + i / 2 * degree * (degree + 1)]
                        : nodes_behind[i - behind];
    }

    /** @brief Present position of the node @p m. */
    dealii::Point<dim>
    position(const unsigned int m) const
    {
      return reference[m] + displacement[m];
    }

    /** @brief Numbers of the node @p m and of the edge @p e, in the bits of outer_edges: in the
     * order of the faces, and the same in any partition. Among the faces around a node, or beside
     * an edge, the least one identifies it, on meshes of up to 2^23 coarse cells. */
    std::uint64_t
    node_key(const unsigned int m) const
    {
      return key * parts + m;
    }
    std::uint64_t
    edge_key(const unsigned int e) const
    {
      return key * parts + max_nodes + e;
    }

    /** @brief The number of a node on the face; n_nodes() if it is not one of its nodes. */
    unsigned int
    number_of(const Index node) const
    {
      return std::find(nodes.begin(), nodes.begin() + n_nodes(), node) - nodes.begin();
    }
  };

  /** @brief Face coordinates of the node @p m. */
  std::array<double, 2>
  node_coordinates(const Face &face, unsigned int m);

  /** @brief Outward area vector at a corner of a face of degree 1 in the reference state: the cross
   * product of the two edges there. */
  dealii::Tensor<1, dim>
  reference_area_vector(const Face &face, unsigned int m);

  /** @brief Whether a node of a face lies where the surface ends: an edge of the body, in most
   * cases. */
  bool
  at_end(const Face &face, unsigned int m);

  /** @brief Values and derivatives of the shape functions of a face. */
  struct FaceShapes
  {
    /** Of the nodes of the face; the rest is left as it is. */
    std::array<double, Face::max_nodes>                value;
    std::array<std::array<double, 2>, Face::max_nodes> gradient;

    FaceShapes(unsigned int degree, const std::array<double, 2> &xi);
  };

  /** @brief Second derivatives of the shape functions of a face: 11, 12, 22. */
  std::array<std::array<double, 3>, Face::max_nodes>
  shape_hessians(unsigned int degree, const std::array<double, 2> &xi);

  /** @brief A point of a deformed face with its tangents. */
  struct FacePoint
  {
    dealii::Point<dim>                    x;
    std::array<dealii::Tensor<1, dim>, 2> tangents;

    /** @brief Unit outward normal. */
    dealii::Tensor<1, dim>
    normal() const;
  };

  /**
   * @brief Evaluate a face at @p xi in its current position.
   *
   * With an exact surface P (closest-point map) the position is R P(sum N_m X_m) +
   * sum N_m (x_m - R X_m), R the facet_rotation(): the shape is exact, turns with the facet, and
   * only what nodes have moved apart from that is interpolated. Over edges between faces it jumps;
   * that of a FaceGeometry with Arch::with_normals does not. Without, it is sum N_m x_m.
   */
  FacePoint
  evaluate(const Face &face, const AnalyticSurface *exact, const std::array<double, 2> &xi);

  /** @brief The same with the shape functions there. */
  FacePoint
  evaluate(const Face &face, const AnalyticSurface *exact, const FaceShapes &shapes);

  /** @brief The face in the position in which the step began. */
  Face
  at_start_of_step(const Face &face);

  /** @brief Of the face as it is before any displacement, length. */
  double
  reference_diagonal(const Face &face);
} // namespace Touchstone

#endif
