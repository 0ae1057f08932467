// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_energies_h
#define touchstone_solid_energies_h

#include <algorithm>

namespace Touchstone
{
  /**
   * @brief Where the energy of a scene is, and where it went since time 0; force times
   * length.
   *
   * What the bodies have and what they lost is what they began with and what was put
   * in, up to balance_error(): kinetic + strain + plastic + contact + friction +
   * damping = initial + external.
   */
  struct Energies
  {
    double kinetic = 0., strain = 0.;
    /** Dissipated by materials, by plastic flow for example. */
    double plastic = 0.;
    /** Work against the normal contact forces: taken by impacts, or stored in
     * springs of a penalty. */
    double contact = 0.;
    /** Work against the tangential contact forces. */
    double friction = 0.;
    /** Dissipated by Rayleigh damping. */
    double damping = 0.;
    /** Work of loads and supports. */
    double external = 0.;
    /** Of the state at time 0. */
    double initial = 0.;
    /** The largest energy so far, to compare with. */
    double largest = 0.;

    /** @brief For checkpoints. All members are named, so that this does not compile if one is
     * forgotten. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      auto &[k, s, p, c, f, d, e, first, most] = *this;
      archive &k &s &p &c &f &d &e &first &most;
    }

    /** @brief What the bodies have. */
    double
    present() const
    {
      return kinetic + strain;
    }

    /** @brief Energy that came from nowhere, negative if it is missing: numerical
     * damping takes energy. */
    double
    balance_error() const
    {
      return present() + plastic + contact + friction + damping - initial - external;
    }

    /** @brief Energy that nothing explains: it came from nowhere, or from contact, which
     * cannot have any but what its springs have stored. */
    double
    gain() const
    {
      return std::max(0., balance_error()) + std::max(0., -contact);
    }

    /** @brief Take note of the size of the energies. */
    void
    update_largest()
    {
      largest = std::max({largest, present(), external, plastic + friction});
    }
  };
} // namespace Touchstone

#endif
