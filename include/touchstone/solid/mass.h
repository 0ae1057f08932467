// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_mass_h
#define touchstone_solid_mass_h

#include <touchstone/algebra/vector.h>
#include <touchstone/solid/solid.h>

#include <set>
#include <vector>

namespace Touchstone
{
  /** @brief How the mass of a cell is spread over its nodes. */
  enum class MassKind
  {
    /** Integral of products of shape functions. */
    consistent,
    /** On the diagonal. */
    lumped,
    /** Integrated such that the errors of mesh and step cancel in the speed of waves. */
    dispersion_corrected
  };

  /**
   * @brief The mass of the bodies, as the matrix of their kinetic energy.
   *
   * - consistent: int rho N_a N_b dV;
   * - lumped: int rho N_a dV at each node;
   * - dispersion corrected: the first by a rule of two points per direction, at
   *   (1 +- xi)/2 with xi^2 = 2/3 (1 - C^2) and the Courant number C of the cell in
   *   that direction, at most 1. With the trapezoidal rule the speed of plane waves along
   *   the mesh is then right to fourth order, and for C = 1 exact: mesh and step err
   *   the opposite way. For C = 0 it is the rule of Guddati and Yue (2004), Comput.
   *   Methods Appl. Mech. Engng 193.
   *
   * Nodes can be made massless, for contact that does not chatter (Khenous, Laborde
   * and Renard 2008, Eur. J. Mech. A/Solids 27): what a cell has at them goes to its
   * other nodes, and then the density of each cell is multiplied by a factor such that
   * mass and centre of mass of each body are as they were, and its moments of inertia
   * too unless the factors, which stay positive, cannot do that.
   */
  class Mass
  {
  public:
    /**
     * @param massless First unknowns of the owned nodes that shall have no mass.
     * @param step     The time step, for the Courant numbers.
     * @throws InputError if too few nodes of a body would have mass. Collective.
     */
    Mass(MassKind kind, const Solid &solid, const std::set<Index> &massless, double step);

    /** @brief y = M x; neither has ghosts. */
    void
    multiply(const Vector &x, Vector &y) const;

    /** @brief Add M, its rows multiplied by @p factors, to a matrix of the stiffness's
     * pattern. */
    void
    add_to(Matrix &sum, const Vector &factors) const;

    /** @brief Whether any node of any rank is massless. */
    bool
    moved() const
    {
      return any_massless;
    }

    /** @brief The sums of the rows: the mass of each unknown's node, mass. */
    const Vector &
    of_nodes() const
    {
      return nodal;
    }

  private:
    /** Empty if all mass is on the diagonal, in nodal. */
    Matrix matrix;
    Vector nodal;
    bool   diagonal, any_massless;

    /** Factors of the density of each cell, by its active index, that make up for the
     * moments that massless nodes would change. */
    static std::vector<double>
    density_factors(MassKind               kind,
                    const Solid           &solid,
                    const std::set<Index> &massless,
                    const Vector          &no_mass,
                    double                 step);
  };
} // namespace Touchstone

#endif
