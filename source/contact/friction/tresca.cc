// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/friction/friction_law.h>

namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    /** |t| <= k A: a shear strength that does not depend on the pressure; or the smaller of it and
     * mu lambda. */
    class Tresca : public FrictionLaw
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("Shear strength",
                          strength,
                          "Largest shear traction, at least zero. Required. [force per area]",
                          Patterns::Double(),
                          /*has_to_be_set=*/true);
        prm.add_parameter("Largest coefficient",
                          largest,
                          "No more than this multiple of the normal force, greater than zero; 0 "
                          "takes the strength however small the pressure. Then a node may have no "
                          "solution that opens when it is dragged by its friction and closes when "
                          "this ceases. [no unit]",
                          Patterns::Double());
      }

      void
      check(const std::string &section) const override
      {
        if (strength < 0.)
          throw InputError(section,
                           "Shear strength",
                           Patterns::Tools::to_string(strength),
                           "must not be negative",
                           "give the largest shear traction that the surfaces bear");
        if (largest < 0.)
          throw InputError(section,
                           "Largest coefficient",
                           Patterns::Tools::to_string(largest),
                           "must not be negative",
                           "give the coefficient that a small pressure has, e.g. 1, or 0");
      }

      FrictionLimit
      limit(const FrictionInput &input) const override
      {
        if (largest > 0. && largest * input.normal_force < strength * input.area)
          return {largest * input.normal_force, largest};
        // No dependence on the normal force, so that the system without consistent linearisation is
        // symmetric; the area is that covered at present, which changes as edges pass
        // (doc/theory.md 6.1).
        return {strength * input.area, 0., strength};
      }

    private:
      double strength = 0.;
      // Far beyond what surfaces have, so that it acts where contact opens and nowhere else.
      double largest = 3.;
    };

    const FrictionLawRegistry::Entry<Tresca>
      tresca_entry("tresca",
                   "the shear traction is at most a given strength, wherever there is contact.");
  } // namespace
} // namespace Touchstone
