// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_plugin_parameters_h
#define touchstone_base_plugin_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Touchstone
{
  /**
   * @brief Keys of its own that a registered class has in a scene file.
   *
   * Either the class is one of these, if it is made without arguments (a geometry, a
   * friction law), or it has a member type `Parameters` that is one, and takes that as the
   * first argument of its constructor:
   * @code
   * class MooneyRivlin : public HyperelasticLaw
   * {
   * public:
   *   struct Parameters : public PluginParameters
   *   {
   *     double c10 = 0., c01 = 0.;
   *
   *     void declare(dealii::ParameterHandler &prm) override;
   *     void check(const std::string &section) const override;
   *   };
   *
   *   MooneyRivlin(const Parameters &own, const MaterialParameters &material);
   * };
   * @endcode
   * The keys stand where the key is that names the class, those of a friction law in the
   * subsection "Friction", and exist in a scene only where that class is chosen.
   */
  class PluginParameters
  {
  public:
    virtual ~PluginParameters() = default;

    /** @brief Bind keys to members, whose values are the defaults. */
    virtual void
    declare(dealii::ParameterHandler & /*prm*/)
    {
    }

    /** @brief Look at the values once all are read.
     * @param section Where the keys stand, for messages. @throws InputError */
    virtual void
    check(const std::string & /*section*/) const
    {
    }
  };
} // namespace Touchstone

#endif
