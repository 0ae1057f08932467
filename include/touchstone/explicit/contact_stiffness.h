// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_contact_stiffness_h
#define touchstone_explicit_contact_stiffness_h

#include <touchstone/contact/contact.h>
#include <touchstone/explicit/node_map.h>
#include <touchstone/solid/body_parameters.h>

#include <vector>

namespace Touchstone
{
  /** @brief K A / V of the cells behind the contact faces around each owned node, with the bulk
   * modulus K, the area A of the faces and the volume V of the cells in the reference state: force
   * per volume; zero elsewhere. The same bits on any number of ranks (doc/explicit.md, section
   * 9.3). */
  std::vector<double>
  contact_stiffness(const Contact                     &contact,
                    const NodeMap                     &map,
                    const std::vector<BodyParameters> &bodies);

  /** @brief A contact spring of explicit dynamics: what the next cycle needs to know of a row. */
  struct ImpulseSpring
  {
    /** Force per length; the same as long as the row is closed. */
    double stiffness = 0.;
    /** At the end of the last cycle, length; of springs that are pressed. */
    double gap = 0.;
    /** Tangential force that the elastic slip leads to, before it is limited. */
    dealii::Tensor<1, dim> traction;

    /** @brief The one list of what checkpoints hold. */
    template <class Spring, class Visitor>
    static void
    visit_state(Spring &spring, Visitor &&visit)
    {
      visit(spring.stiffness);
      visit(spring.gap);
      visit(spring.traction);
    }
  };
} // namespace Touchstone

#endif
