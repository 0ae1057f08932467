// SPDX-License-Identifier: LGPL-2.1-or-later
// A field of the VTU files of contact surfaces to start from. Copy to source/output/NAME.cc
// and change what is marked TODO: nothing else need be edited.

#include <touchstone/output/contact_field.h>

namespace Touchstone
{
  namespace
  {
    /** TODO: what the field shows: here the work done against friction per area. */
    class FrictionWorkDensity : public ContactField
    {
    public:
      void
      evaluate(const ContactPoint &point, double *values) const override
      {
        values[0] = point.area > 0. ? point.friction_work / point.area : 0.;
      }
    };

    // TODO: the name in the files, and what it is, with its unit.
    const ContactFieldRegistry::Entry<FrictionWorkDensity>
      friction_work_density("friction_work_density",
                            "Work done against friction per area; energy per area.");
  } // namespace
} // namespace Touchstone
