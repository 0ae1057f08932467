// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/contact_field.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <type_traits>

/**
 * @file
 * The fields of the VTU output of contact surfaces, one class for each, registered by name. A field
 * of your own is one more class with an entry in the registry; nothing here has to change
 * (doc/extending.md).
 */

namespace Touchstone
{
  namespace
  {
    /**
     * A field that is a member of ContactPoint: scalars, vectors, or integers such as the status.
     * Integers are not interpolated at hanging nodes, since the mean of two statuses is none.
     */
    template <unsigned int number, class Member, Member ContactPoint::*member>
    class ContactMember : public ContactField
    {
    public:
      unsigned int
      n_components() const override
      {
        return std::is_base_of<dealii::Tensor<1, dim>, Member>::value ? dim : 1;
      }

      void
      evaluate(const ContactPoint &point, double *values) const override
      {
        if constexpr (std::is_base_of<dealii::Tensor<1, dim>, Member>::value)
          for (unsigned int d = 0; d < dim; ++d)
            values[d] = (point.*member)[d];
        else
          values[0] = static_cast<double>(static_cast<int>(point.*member));
      }

      bool
      interpolated() const override
      {
        return !std::is_enum<Member>::value && !std::is_integral<Member>::value;
      }

      unsigned int
      order() const override
      {
        return number;
      }
    };



    template <unsigned int number, double ContactPoint::*member>
    class ContactNumber : public ContactMember<number, double, member>
    {
    public:
      void
      evaluate(const ContactPoint &point, double *values) const override
      {
        // Without the conversion to int that enumerations need.
        values[0] = point.*member;
      }
    };

    using StatusField     = ContactMember<0, ContactStatus, &ContactPoint::status>;
    using GapField        = ContactNumber<1, &ContactPoint::gap>;
    using PressureField   = ContactNumber<2, &ContactPoint::pressure>;
    using PairField       = ContactMember<3, unsigned int, &ContactPoint::pair>;
    using SlipLengthField = ContactNumber<4, &ContactPoint::slip_length>;
    using NormalField     = ContactMember<5, dealii::Tensor<1, dim>, &ContactPoint::normal>;
    using TractionField   = ContactMember<6, dealii::Tensor<1, dim>, &ContactPoint::traction>;
    using SlipField       = ContactMember<7, dealii::Tensor<1, dim>, &ContactPoint::slip>;
    using ContactDisplacementField =
      ContactMember<8, dealii::Tensor<1, dim>, &ContactPoint::displacement>;

    /** A share of the surface at a node. */
    template <class Field>
    class Summed : public Field
    {
    public:
      bool
      summed() const override
      {
        return true;
      }
    };

    using AreaField  = Summed<ContactNumber<9, &ContactPoint::area>>;
    using ForceField = Summed<ContactMember<10, dealii::Tensor<1, dim>, &ContactPoint::force>>;

    const ContactFieldRegistry::Entry<StatusField>
      status_field("status", "Number of the ContactStatus; no unit.");
    const ContactFieldRegistry::Entry<GapField> gap_field("gap", "Gap; length.");
    const ContactFieldRegistry::Entry<PressureField>
      pressure_field("pressure", "Normal force per area; force per area.");
    const ContactFieldRegistry::Entry<PairField> pair_field("pair", "Number of the pair; no unit.");
    const ContactFieldRegistry::Entry<SlipLengthField>
      slip_length_field("slip_length", "Length of the slip path; length.");
    const ContactFieldRegistry::Entry<NormalField>
      normal_field("normal", "Normal of the master surface; no unit.");
    const ContactFieldRegistry::Entry<TractionField>
      traction_field("traction", "Contact force per area; force per area.");
    const ContactFieldRegistry::Entry<SlipField>
      slip_field("slip", "Tangential slip of the last step; length.");
    const ContactFieldRegistry::Entry<ContactDisplacementField>
      contact_displacement_field("displacement", "Displacement; length.");
    const ContactFieldRegistry::Entry<AreaField>
      area_field("area", "Covered area that belongs to the node; length squared.");
    const ContactFieldRegistry::Entry<ForceField> force_field("force",
                                                              "Contact force on the node; force.");
  } // namespace



  ContactFieldList::ContactFieldList()
  {
    // Names come sorted from the registry; order() restores the order of the built-in fields, and
    // stable sorting keeps others by name after them.
    for (const std::string &name : ContactFieldRegistry::names())
      all.push_back({name, ContactFieldRegistry::make(name), 0});
    std::stable_sort(all.begin(), all.end(), [](const Entry &a, const Entry &b) {
      return a.field->order() < b.field->order();
    });
    for (Entry &entry : all)
      {
        // Fields are stored one after the other in the values of a node.
        entry.first = size;
        size += entry.field->n_components();
      }
  }



  unsigned int
  ContactFieldList::position(const std::string &name) const
  {
    const auto entry =
      std::find_if(all.begin(), all.end(), [&name](const Entry &e) { return e.name == name; });
    AssertThrow(entry != all.end(), dealii::ExcMessage("There is no contact field " + name));
    return entry->first;
  }



  std::vector<double>
  ContactFieldList::values_at(const ContactPoint &point) const
  {
    std::vector<double> values(size);
    for (const Entry &entry : all)
      entry.field->evaluate(point, values.data() + entry.first);
    return values;
  }
} // namespace Touchstone
