// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_vertex_contact_h
#define touchstone_contact_pairing_vertex_contact_h

#include <touchstone/contact/geometry/face_geometry.h>
#include <touchstone/contact/pairing/contact_between_nodes.h>

namespace Touchstone
{
  /** @brief A vertex of the master that faces the inside of a slave face: the gap is measured to
   * its closest point there, along the normal of the slave surface, averaged at its nodes
   * (doc/theory.md 4.2, equation (31)). */
  class VertexContact : public ContactBetweenNodes
  {
  public:
    /** @param vertex, key Node of the master, and a number of it for any partition.
     * @param x        Its position.
     * @param geometry The slave face, which must live as long.
     * @param xi       The closest point on it.
     * @param local    Number on the face of the slave node of the row. */
    VertexContact(Index                        vertex,
                  std::uint64_t                key,
                  const dealii::Point<dim>    &x,
                  const FaceGeometry          &geometry,
                  const std::array<double, 2> &xi,
                  unsigned int                 local);

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

    const Face *
    face() const override
    {
      return &geometry.face();
    }

    std::shared_ptr<const RowDerivative>
    differentiate(const std::vector<NormalDerivative> *of_normals) const override;

  private:
    Index                 vertex;
    std::uint64_t         key;
    FaceGeometry          geometry;
    std::array<double, 2> xi;
    unsigned int          local;
    FaceShapes            shapes;
    dealii::Point<dim>    foot;
    /** From the foot on the face to the vertex, and outward from the face. */
    dealii::Tensor<1, dim> distance, normal;
  };
} // namespace Touchstone

#endif
