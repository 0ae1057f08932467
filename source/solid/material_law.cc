#include <touchstone/solid/hyperelastic_law.h>
#include <touchstone/solid/material_parameters.h>

namespace Touchstone
{
  std::shared_ptr<const MaterialLaw>
  make_material_law(const MaterialParameters &material)
  {
    // Without a scene, in tests, no keys have been read.
    const std::shared_ptr<MaterialLaw> law =
      material.own_law ? material.own_law : MaterialParameters::new_law(material.law);
    law->initialize(material);
    return law;
  }



  std::shared_ptr<const HyperelasticLaw>
  make_hyperelastic_law(const std::string &name, const MaterialParameters &material)
  {
    const std::shared_ptr<HyperelasticLaw> law = HyperelasticRegistry::make(name);
    law->initialize(material);
    return law;
  }



  void
  HyperelasticLaw::respond(const MaterialInput &input,
                           const Demand         demand,
                           MaterialResponse    &response,
                           double *) const
  {
    if (demand == Demand::energy)
      response.energy = response.elastic_energy = energy(input.deformation);
    else
      response.stress = stress(input.deformation);
    if (demand == Demand::tangent)
      response.tangent = tangent(input.deformation);
  }
} // namespace Touchstone
