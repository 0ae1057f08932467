// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_edge_contact_h
#define touchstone_contact_pairing_edge_contact_h

#include <touchstone/contact/geometry/edge_crossing.h>
#include <touchstone/contact/pairing/contact_between_nodes.h>

#include <array>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief The direction of a line of edges at one of its nodes: a combination of node positions,
   * not a unit vector. */
  struct EdgeTangent
  {
    dealii::Tensor<1, dim>                value;
    std::vector<std::pair<Index, double>> nodes;
  };

  /** @brief An edge with the directions of the line of edges that it belongs to, at both ends. */
  struct EdgeOfLine
  {
    SharpEdge                  edge;
    std::array<EdgeTangent, 2> tangents;
  };

  /**
   * @brief A slave edge that crosses a master edge: the gap vector lies between the feet of their
   * common perpendicular (doc/theory.md 4.2, equation (30)).
   *
   * The normal is perpendicular to both lines of edges, whose directions are interpolated between
   * the nodes. That of the two edges alone would jump at each node:
   * edges that are pressed against each other bend there, and the point of contact would have no
   * place to rest.
   */
  class EdgeContact : public ContactBetweenNodes
  {
  public:
    /** @param crossing Of the slave edge, the first, with the master edge.
     * @param end      Of the slave edge: its node is the slave node of the row. */
    EdgeContact(const EdgeOfLine   &slave,
                const EdgeOfLine   &master,
                const EdgeCrossing &crossing,
                unsigned int        end);

    double
    gap() const override
    {
      return distance * normal;
    }

    std::uint64_t
    master_key() const override
    {
      return key;
    }

    void
    set(ContactRow &row) const override;

    std::shared_ptr<const RowDerivative>
    differentiate(const std::vector<NormalDerivative> *of_normals) const override;

  private:
    std::uint64_t key;
    /** The slave node of the row, the other one of the slave edge, and those of the master edge. */
    Index                slave, other;
    std::array<Index, 2> master;
    /** A direction that turns along an edge. */
    struct Direction
    {
      EdgeTangent value;
      /** Its derivative by the fraction of the edge. */
      dealii::Tensor<1, dim> slope;
    };
    /** At a fraction of an edge. */
    static Direction
    direction(const EdgeOfLine &line, double at);

    /** Of both lines at the feet. The fraction of the slave edge counts from its node a on. */
    Direction slave_line, master_line;
    /** Of the slave edge from the slave node on, and of the master edge. */
    dealii::Tensor<1, dim> e, f;
    /** Of the feet of the perpendicular, as fractions. */
    double a, b;
    /** From the foot on the master to that on the slave. */
    dealii::Tensor<1, dim> distance;
    dealii::Tensor<1, dim> normal;
    /** 1 if the slave node is node a of its edge, else -1. */
    double orientation;
  };
} // namespace Touchstone

#endif
