// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_explicit_nodal_loads_h
#define touchstone_explicit_nodal_loads_h

#include <touchstone/explicit/node_map.h>
#include <touchstone/solid/boundary_conditions.h>

#include <array>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Tractions, pressures and body forces at the owned nodes, for evaluation in each cycle.
   *
   * Loads that are constant are integrated once. Of loads whose formula names the time alone the
   * formula is evaluated once in a cycle and multiplies nodal forces that are integrated once. Only
   * formulas of both, pressures that follow the surface, and moments on bodies at finite strain are
   * integrated in each cycle.
   */
  class NodalLoads
  {
  public:
    NodalLoads(const BoundaryConditions &conditions, const Solid &solid, const NodeMap &map);

    /** @brief Whether there is no load at all on this rank. */
    bool
    empty() const
    {
      return loads.empty() && pressures.empty() && springs.empty() && resultants.empty();
    }

    /** @brief Set the forces on the owned nodes at time @p t in the displacement @p u. Collective
     * unless empty(), which is the same on all ranks where it matters. */
    void
    evaluate(double t, const NodeField &u, NodeField &force) const;

    /** @brief A bound of the squared frequency that springs add to that of the cells. Collective.
     */
    double
    square_frequency(const std::vector<double> &masses) const;

  private:
    using Function = BoundaryConditions::Function;

    /** A quadrature point: what the value of the formula is multiplied with at each node. */
    struct LoadPoint
    {
      dealii::Point<dim>          position;
      unsigned int                n_nodes;
      std::array<unsigned int, 8> nodes;
      std::array<double, 8>       shapes;
      /** Direction of the force times the integration weight. */
      dealii::Tensor<1, dim> direction;
    };

    struct Load
    {
      Function function;
      /** Empty if the nodal forces are kept. */
      std::vector<LoadPoint> points;
      /** Nodal forces for the value 1, or of a constant load. */
      std::vector<std::pair<unsigned int, dealii::Tensor<1, dim>>> nodal;
      bool                                                         constant;
    };

    /** A quadrature point of a pressure that follows the surface: the tangents of the surface are
     * sums over its nodes. */
    struct PressurePoint
    {
      dealii::Point<dim>                         position;
      std::array<unsigned int, 4>                nodes;
      std::array<double, 4>                      shapes;
      std::array<std::array<double, 4>, dim - 1> derivatives;
      double                                     sign;
      /** Of a cell that this rank owns: sums over ranks count each point once. */
      bool owned;
    };

    struct Pressure
    {
      Function                   function;
      std::vector<PressurePoint> points;
    };

    /** Force and moment on a boundary of a body at finite strain, on all ranks. */
    struct Resultant
    {
      std::shared_ptr<const ResultantLoad> load;
      std::vector<PressurePoint>           points;
      /** Undeformed areas of the points. */
      std::vector<double> areas;
    };

    /** A quadrature point of springs to the ground: stiffnesses times the weight. */
    struct Spring
    {
      std::array<unsigned int, 4> nodes;
      std::array<double, 4>       shapes;
      dealii::Tensor<1, dim>      normal;
      double                      across, along;
    };

    const NodeMap         &map;
    std::vector<Load>      loads;
    std::vector<Pressure>  pressures;
    std::vector<Resultant> resultants;
    std::vector<Spring>    springs;

    void
    add(const Function &function, std::vector<LoadPoint> &&points);
    void
    add_body_forces(const BoundaryConditions &conditions);
    void
    add_surface_loads(const BoundaryConditions &conditions, const Solid &solid);
    /** Present forces of resultants. Collective. */
    void
    add_resultants(double t, const NodeField &u, NodeField &force) const;
    /** Tractions, a pressure that keeps its direction, and a resultant. */
    void
    add_tractions(const BoundaryConditions::Load &load, const std::vector<PressurePoint> &points);
    void
    add_springs(const GroundSprings::Spring &spring, const std::vector<PressurePoint> &points);
    /** Outward normal times weight on the undeformed surface, area. */
    dealii::Tensor<1, dim>
    normal(const PressurePoint &point) const;
  };
} // namespace Touchstone

#endif
