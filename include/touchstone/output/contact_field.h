// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_contact_field_h
#define touchstone_output_contact_field_h

#include <touchstone/base/registry.h>
#include <touchstone/contact/results.h>

#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief A field in the VTU files of the contact surfaces (contact.pvd). It has the name
   * under which it is registered; the documentation there states its unit.
   */
  class ContactField
  {
  public:
    virtual ~ContactField() = default;

    /** @brief 1, or 3 for a vector. */
    virtual unsigned int
    n_components() const
    {
      return 1;
    }

    /** @brief Write n_components() numbers. Called by the rank that owns the node. */
    virtual void
    evaluate(const ContactPoint &point, double *values) const = 0;

    /** @brief Whether a hanging node has the interpolated value, or that of the node that it
     * depends on most (for what only has some values, as the status does). */
    virtual bool
    interpolated() const
    {
      return true;
    }

    /** @brief Whether values of nodes add up to that of the surface, as forces do: a hanging node
     * has none. */
    virtual bool
    summed() const
    {
      return false;
    }

    /** @brief Fields are sorted by this number, then by their names. */
    virtual unsigned int
    order() const
    {
      return 1000;
    }
  };

  using ContactFieldRegistry = Registry<ContactField>;

  /** @brief All registered fields, and where their numbers are among those of a node. */
  class ContactFieldList
  {
  public:
    ContactFieldList();

    struct Entry
    {
      std::string                   name;
      std::shared_ptr<ContactField> field;
      /** The first of its numbers. */
      unsigned int first;
    };

    const std::vector<Entry> &
    entries() const
    {
      return all;
    }

    /** @brief Numbers of a node. */
    unsigned int
    n_values() const
    {
      return size;
    }

    /** @brief Where the numbers of the field @p name begin. @throws dealii::ExcMessage */
    unsigned int
    position(const std::string &name) const;

    std::vector<double>
    values_at(const ContactPoint &point) const;

  private:
    std::vector<Entry> all;
    unsigned int       size = 0;
  };
} // namespace Touchstone

#endif
