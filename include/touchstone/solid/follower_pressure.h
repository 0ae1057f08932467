// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_follower_pressure_h
#define touchstone_solid_follower_pressure_h

#include <touchstone/algebra/linear_system.h>
#include <touchstone/base/formula.h>
#include <touchstone/solid/solid.h>

#include <deal.II/fe/fe_values.h>

#include <functional>
#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Pressure that follows the deformed surface.
   *
   * The nodal forces are f_i = -int N_i p n da = -int N_i p cof(F) N dA, with
   * cof(F) N = (F t_1) x (F t_2) for an orthonormal frame t_1, t_2, N of the reference
   * surface (Nanson). The stiffness -df/du follows from dF t_a = (grad N_j . t_a) du_j; it
   * is unsymmetric but where the surface is closed or its edges are held. Bonet and Wood
   * (2008), Nonlinear Continuum Mechanics for Finite Element Analysis, section 8.4.2.
   */
  class FollowerPressure
  {
  public:
    /** @brief A pressure on a boundary. */
    struct Load
    {
      BoundaryIds                    boundary;
      std::shared_ptr<const Formula> pressure;
    };

    explicit FollowerPressure(const Solid &solid)
      : solid(solid)
    {
    }

    /** @param pressure Of the reference position and time, force per deformed area. */
    void
    add(const BoundaryIds &boundary, const std::shared_ptr<const Formula> &pressure)
    {
      loads.push_back({boundary, pressure});
    }

    bool
    empty() const
    {
      return loads.empty();
    }

    const std::vector<Load> &
    all_loads() const
    {
      return loads;
    }

    /** @brief Add the nodal forces in the displacement @p u (without ghosts).
     * Collective. */
    void
    add_force(double t, const Vector &u, Vector &force) const;

    /** @brief Add the stiffness -df/du, or its symmetric part, of the cells of this
     * rank. Collective. */
    void
    add_stiffness(double t, const Vector &u, bool symmetric, std::vector<RankOneTerm> &terms) const;

  private:
    /** The deformed surface at a quadrature point of a loaded face. */
    struct SurfacePoint
    {
      double pressure;
      /** Reference tangents, and where the deformation takes them. */
      dealii::Tensor<1, dim> t[2], moved[2];
    };

    const Solid      &solid;
    std::vector<Load> loads;

    /** Visit the quadrature points of all loaded faces of cells that are owned, or also
     * of ghost cells. */
    void
    for_each_point(double                                           t,
                   const Vector                                    &u,
                   bool                                             with_ghosts,
                   const std::function<void(const dealii::FEFaceValues<dim> &,
                                            unsigned int              q,
                                            const std::vector<Index> &dofs,
                                            const SurfacePoint &)> &visit) const;
  };
} // namespace Touchstone

#endif
