// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/broad_phase.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/friction/friction_law.h>
#include <touchstone/contact/pairing/pairing.h>
#include <touchstone/explicit/general/general_contact_parameters.h>
#include <touchstone/mesh/geometry.h>
#include <touchstone/mesh/obstacle_shape.h>
#include <touchstone/scene/own_keys.h>
#include <touchstone/solid/hardening_law.h>
#include <touchstone/solid/hyperelastic_law.h>
#include <touchstone/solid/material_law.h>
#include <touchstone/verification/reference_parameters.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <ostream>
#include <string>

namespace Touchstone
{
  namespace
  {
    /** The keys that @p declare declares, as those of a section. */
    void
    print_section(std::ostream                                          &out,
                  const std::string                                     &section,
                  const std::function<void(dealii::ParameterHandler &)> &declare)
    {
      dealii::ParameterHandler prm;
      prm.enter_subsection(section);
      declare(prm);
      prm.leave_subsection();
      prm.print_parameters(out,
                           dealii::ParameterHandler::PRM |
                             dealii::ParameterHandler::KeepDeclarationOrder);
    }



    /** The keys of the classes of a registry, each class under @p section and its name. */
    template <class RegistryOf>
    void
    print(std::ostream &out, const std::string &section)
    {
      for (const auto &[name, record] : RegistryOf::records())
        {
          // Keys are bound to members of the object.
          const auto own = record.make_parameters();
          print_section(out, section + name, [&](auto &prm) { own->declare(prm); });
        }
    }
  } // namespace



  void
  print_own_keys(std::ostream &out)
  {
    print<GeometryRegistry>(out, "Body NAME/Geometry with Type = ");
    print<SmallStrainRegistry>(out, "Body NAME/Material with Law = ");
    print<HyperelasticRegistry>(out, "Body NAME/Material with Law = ");
    print<FiniteStrainRegistry>(out, "Body NAME/Material with Law = ");
    print<HardeningLawRegistry>(out, "Body NAME/Material/Plasticity with Hardening = ");
    print<ObstacleShapeRegistry>(out, "Obstacle ");
    print<PairingRegistry>(out, "Contact pair NAME with Pairing = ");
    print<FrictionLawRegistry>(out, "Contact pair NAME/Friction with Behaviour = ");
    GeneralContactParameters general;
    print_section(out, "Contact pair NAME without master and obstacle", [&](auto &prm) {
      general.declare(prm, {});
    });
    print<BroadPhaseRegistry>(out, "Contact pair NAME with Search = ");
    print<EnforcementRegistry>(out, "Contact with Enforcement = ");
    print<Registry<ReferenceSolution, const Scene &>>(out, "Reference solution with Type = ");
  }
} // namespace Touchstone
