// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_contact_between_nodes_h
#define touchstone_contact_pairing_contact_between_nodes_h

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/row.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A point of the slave surface between nodes that faces a point of the master: the
   * geometry of a row between nodes (doc/theory.md 4.2).
   *
   * With the weights W_a of the slave nodes at the point, all of the row is divided by the weight
   * of its own slave node: the stencil has -W_a / W_s for the others, gap and gap vector are
   * those of the surfaces times ContactRow::share = 1 / W_s.
   */
  class ContactBetweenNodes
  {
  public:
    virtual ~ContactBetweenNodes() = default;

    /** @brief Of the surfaces, negative where they have passed through each other; length. */
    virtual double
    gap() const = 0;

    /** @brief A number of the edge or vertex of the master that means the same in any partition. */
    virtual std::uint64_t
    master_key() const = 0;

    /** @brief Set stencil, normal, gap, gap vector, share, lever and area. */
    virtual void
    set(ContactRow &row) const = 0;

    /** @brief The slave face whose averaged normals the row depends on, or null. */
    virtual const Face *
    face() const
    {
      return nullptr;
    }

    /** @brief The derivative of what set() has set. @param of_normals Of the face(), or null. */
    virtual std::shared_ptr<const RowDerivative>
    differentiate(const std::vector<NormalDerivative> *of_normals) const = 0;

  protected:
    /** @brief What all kinds set in the same way. @param gap_vector Of the surfaces, length.
     * @param lever From the slave node to the point, length. */
    static void
    set_point(ContactRow                   &row,
              const double                  share,
              const dealii::Tensor<1, dim> &normal,
              const dealii::Tensor<1, dim> &gap_vector,
              const dealii::Tensor<1, dim> &lever)
    {
      row.has_partner = true;
      row.share       = share;
      row.normal      = normal;
      row.gap_vector  = share * gap_vector;
      row.gap         = row.gap_vector * normal;
      row.lever       = lever;
      // A point has no area, and there is no pressure.
      row.area = 0.;
      row.away = 0.;
    }
  };
} // namespace Touchstone

#endif
