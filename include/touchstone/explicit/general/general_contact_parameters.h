// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_general_general_contact_parameters_h
#define touchstone_explicit_general_general_contact_parameters_h

#include <touchstone/base/choice.h>
#include <touchstone/base/keyword.h>
#include <touchstone/collision/broad_phase.h>
#include <touchstone/contact/friction/friction_law.h>

#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Section "Contact pair NAME" without master body and obstacle: everything that it names
   * may touch everything else of it, and itself. */
  struct GeneralContactParameters
  {
    std::string name;
    /** Bodies, or "all". */
    std::vector<std::string> bodies{"all"};
    /** Boundaries of each of them, or "all". */
    std::vector<std::string> boundaries{"all"};
    /** "frictionless" or the name of a friction law, whose keys are in the subsection "Friction".
     */
    Choice<Registry<FrictionLaw>> behaviour{"frictionless"};
    std::shared_ptr<FrictionLaw>  friction;
    /** How candidates are found, and how far nodes may move before they are found anew: a length,
     * or "automatic". */
    Choice<Registry<BroadPhase>> search{"automatic"};
    std::string                  margin = "automatic";
    /** What becomes of surfaces that cross each other as the bodies are placed. */
    enum class Overlap
    {
      refuse,
      adjust
    };
    Keyword<Overlap> initial_overlap{Overlap::refuse,
                                     {{"refuse", Overlap::refuse}, {"adjust", Overlap::adjust}}};

    /** @brief "Contact pair NAME". */
    std::string
    section() const;
    /** @brief The length that #margin says; 0: automatic. */
    double
    margin_length() const;

    bool
    all_bodies() const;
    bool
    all_boundaries() const;

    /** @param values Of this section: the behaviour decides on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
