#ifndef touchstone_solid_mass_h
#define touchstone_solid_mass_h

#include <touchstone/algebra/vector.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>

#include <array>
#include <set>
#include <vector>

namespace Touchstone
{
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
   * other nodes, and a correction of these keeps mass, centre of mass and moments of
   * inertia of each body as they were. Where just two layers of nodes are left, the moments of
   * inertia change with the square of the cell size.
   */
  class Mass
  {
  public:
    /**
     * @param massless First unknowns of the owned nodes that shall have no mass.
     * @param step     The time step, for the Courant numbers.
     * @throws InputError if too few nodes of a body would have mass. Collective.
     */
    Mass(const Scene &scene, const Solid &solid, const std::set<Index> &massless, double step);

    /** @brief y = M x; neither has ghosts. */
    void
    multiply(const Vector &x, Vector &y) const;

    /** @brief Add M, its rows multiplied by @p factors, to a matrix of the stiffness's
     * pattern. */
    void
    add_to(Matrix &sum, const Vector &factors) const;

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
    bool   diagonal;

    /** Correct the masses of the nodes by a polynomial of degree 2 in each body,
     * so that the moments change by @p missing. */
    void
    restore_moments(const Scene                               &scene,
                    const Solid                               &solid,
                    const Vector                              &positions,
                    const std::vector<std::array<double, 10>> &missing);
  };
} // namespace Touchstone

#endif
