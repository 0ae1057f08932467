// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_energies_h
#define touchstone_solid_energies_h

#include <algorithm>
#include <boost/serialization/version.hpp>

namespace Touchstone
{
  /**
   * @brief The energy balance of a scene since time 0; force times length.
   *
   * Present and dissipated energy are equal to initial energy and external work, up to
   * balance_error(): kinetic + strain + plastic + contact + friction + damping + hourglass +
   * viscous = initial + external.
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
    /** Of explicit dynamics: stored in or dissipated by the control of hourglass modes, and
     * dissipated by bulk viscosity. */
    double hourglass = 0., viscous = 0.;
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
    serialize(Archive &archive, const unsigned int version)
    {
      auto &[k, s, p, c, f, d, h, v, e, first, most] = *this;
      archive &k &s &p &c &f &d &e &first &most;
      if (version > 0) // not in checkpoints of earlier versions
        archive &h &v;
    }

    /** @brief Kinetic and strain energy of the bodies. */
    double
    present() const
    {
      return kinetic + strain;
    }

    /** @brief Error of the balance: positive if energy was generated numerically, negative if it is
     * missing, as by numerical damping. */
    double
    balance_error() const
    {
      return present() + plastic + contact + friction + damping + hourglass + viscous - initial -
             external;
    }

    /** @brief Energy without a physical source: generated numerically, or released by contact
     * beyond what its springs have stored. */
    double
    gain() const
    {
      return std::max(0., balance_error()) + std::max(0., -contact);
    }

    /** @brief Update the largest energy. */
    void
    update_largest()
    {
      largest = std::max({largest, present(), external, plastic + friction});
    }
  };
} // namespace Touchstone

BOOST_CLASS_VERSION(Touchstone::Energies, 1)

#endif
