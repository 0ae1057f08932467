// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_boundary_conditions_h
#define touchstone_solid_boundary_conditions_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/base/formula.h>
#include <touchstone/solid/follower_pressure.h>
#include <touchstone/solid/ground_springs.h>
#include <touchstone/solid/mass.h>
#include <touchstone/solid/node_sets.h>
#include <touchstone/solid/resultant_load.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief Reaction force on one boundary of one body. */
  struct Reaction
  {
    std::string            body, boundary;
    dealii::Tensor<1, dim> force;
  };

  /** @brief One component of the displacement of one node, as the scene prescribes it. */
  struct PrescribedDisplacement
  {
    Index node;
    /** Unit vector along which the displacement has the value (length). */
    dealii::Tensor<1, dim> direction;
    double                 value;
    /** "BODY/BOUNDARY". */
    std::string support;
  };

  /**
   * @brief What the scene prescribes on the boundaries of the bodies: loads as
   * nodal forces, displacements and symmetry as conditions.
   */
  class BoundaryConditions
  {
  public:
    using Function = std::shared_ptr<const Formula>;

    /** One direction prescribed at one owned node. */
    struct Prescribed
    {
      Index                  node;
      dealii::Tensor<1, dim> direction;
      /** Null for zero. */
      Function           value;
      dealii::Point<dim> position;
      unsigned int       body;
      /** Which reaction it belongs to. */
      unsigned int support;

      /** The displacement along the direction at time @p t, length. */
      double
      displacement(double t) const;
    };

    /** Tractions, dead pressure, and force and moment of a boundary; null for none. */
    struct Load
    {
      BoundaryIds                          boundary;
      std::array<Function, dim>            traction;
      Function                             pressure;
      std::shared_ptr<const ResultantLoad> resultant;
    };

    /** @throws InputError for boundaries that do not exist, and for a symmetry
     * boundary that is not plane. */
    BoundaryConditions(const Forest &forest, const Solid &solid);

    /** @brief Nodal forces of tractions, pressures and body forces at time @p t in the displacement
     * @p u, which matters to pressures that follow the surface, to springs, and to moments on
     * bodies at finite strain. Collective.
     * @throws InputError if a formula is not finite. */
    void
    external_force(double t, const Vector &u, Vector &force) const;

    /** @brief From now on body forces act where @p of_nodes, kept by reference, has the mass, and
     * not at nodes whose mass has gone to others. */
    void
    act_on_mass(const Mass &of_nodes)
    {
      mass = &of_nodes;
    }

    /** @name The conditions themselves, for explicit dynamics, which evaluates them in each cycle
     */
    /** @{ */
    /** @brief Of owned nodes, in the order of precedence. */
    const std::vector<Prescribed> &
    prescribed_directions() const
    {
      return prescribed;
    }
    /** @brief Boundaries that reaction forces are summed for, with zero forces. */
    const std::vector<Reaction> &
    reaction_names() const
    {
      return supports;
    }
    const std::vector<Load> &
    surface_loads() const
    {
      return loads;
    }
    const std::vector<NodeSetLoad> &
    node_set_loads() const
    {
      return set_loads;
    }
    /** @brief By body; empty if there are none at all. */
    const std::vector<std::array<Function, dim>> &
    volume_loads() const
    {
      return body_forces;
    }
    /** @brief All formulas, for Formulas::check(). */
    const Formulas &
    all_formulas() const
    {
      return formulas;
    }
    /** @} */

    /** @brief Pressures whose forces depend on the displacement. */
    const FollowerPressure &
    follower_pressure() const
    {
      return following;
    }

    /** @brief Springs to the ground. */
    const GroundSprings &
    ground_springs() const
    {
      return springs;
    }

    /** @brief Whether forces of external_force() depend on the displacement. */
    bool
    depends_on_displacement() const
    {
      return !following.empty() || !springs.empty() ||
             std::any_of(loads.begin(), loads.end(), [](const Load &load) {
               return load.resultant && load.resultant->follows();
             });
    }

    /**
     * @brief Add the prescribed displacements at time @p t, as increments from
     * @p u, to the constraint graph.
     * @return the largest amount by which @p u misses them, length. Collective.
     * @throws InputError if a formula is not finite.
     */
    double
    prescribe(double t, const Vector &u, ConstraintGraph &graph) const;

    /** @brief The prescribed displacements of owned nodes at time @p t. A node on
     * several boundaries has several, which may depend on each other. Collective.
     * @throws InputError if a formula is not finite. */
    std::vector<PrescribedDisplacement>
    displacements(double t) const;

    /** @brief Normals of the planes of symmetry that nodes of owned cells lie on, hanging ones as
     * well, by node; of further nodes of ghost cells some of them. */
    const std::map<Index, std::vector<dealii::Tensor<1, dim>>> &
    mirrors() const
    {
      return mirror_normals;
    }

    /** @brief The directions in which displacements of owned nodes are prescribed, by node. */
    std::map<Index, std::vector<dealii::Tensor<1, dim>>>
    supported_directions() const
    {
      std::map<Index, std::vector<dealii::Tensor<1, dim>>> result;
      for (const Prescribed &entry : prescribed)
        result[entry.node].push_back(entry.direction);
      return result;
    }

    /**
     * @brief Forces that the supports exert on the bodies.
     * @param unbalanced Internal minus external minus contact forces at each
     *                   unknown (no ghosts).
     */
    std::vector<Reaction>
    reactions(const Vector &unbalanced) const;

    /** @brief The same forces at the nodes, without ghosts. Collective. */
    Vector
    nodal_reactions(const Vector &unbalanced) const;

  private:
    /** Visit the shares of the unbalanced forces that each prescribed direction takes. */
    void
    for_each_share(
      const Vector                                                                  &unbalanced,
      const std::function<void(const Prescribed &, const dealii::Tensor<1, dim> &)> &visit) const;
    const Solid            &solid;
    Formulas                formulas;
    std::vector<Prescribed> prescribed;
    /** Of nodes of owned and ghost cells. */
    std::map<Index, std::vector<dealii::Tensor<1, dim>>> mirror_normals;
    std::vector<Load>                                    loads;
    std::vector<NodeSetLoad>                             set_loads;
    /** Force per reference volume, by body; empty if there is none at all. */
    std::vector<std::array<Function, dim>> body_forces;
    /** Of the nodes if some have none, else null. */
    const Mass           *mass = nullptr;
    FollowerPressure      following;
    GroundSprings         springs;
    std::vector<Reaction> supports;

    /** Boundaries of a body that are fixed, and those of symmetry with their normals. */
    struct Supported
    {
      std::vector<BoundaryIds>                      fixed;
      std::map<BoundaryIds, dealii::Tensor<1, dim>> planes;

      bool
      is_fixed(const BoundaryIds &boundary) const
      {
        return std::count(fixed.begin(), fixed.end(), boundary) > 0;
      }
    };

    /** @throws InputError if the boundary is fixed or not plane. */
    void
    add_symmetry(unsigned int       body,
                 const BoundaryIds &boundary,
                 const std::string &name,
                 Supported         &supported);
    /** Null if there is neither force nor moment. Collective. */
    std::shared_ptr<const ResultantLoad>
    make_resultant(unsigned int              body,
                   const BoundaryIds        &boundary,
                   const BoundaryParameters &condition,
                   const std::string        &section);
    /** Displacements and loads of a boundary.
     * @throws InputError if it cannot move in the direction of a condition. */
    void
    add_condition(unsigned int       body,
                  const BoundaryIds &boundary,
                  const std::string &name,
                  const Supported   &supported);
    /** Displacements and a force on a set of nodes. */
    void
    add_set_condition(const Forest &forest, unsigned int body, const std::string &name);
    void
    add_set_forces(double t, Vector &force) const;
    void
    add_body_forces(double t, Vector &force) const;
    /** The same as products of masses and accelerations. */
    void
    add_forces_on_mass(double t, Vector &force) const;
    void
    add_tractions(double t, const Vector &u, Vector &force) const;
    template <typename Visit>
    void
    for_each_node_on(const BoundaryIds &boundary, const Visit &visit) const;
    void
    prescribe_on(const BoundaryIds            &boundary,
                 const dealii::Tensor<1, dim> &direction,
                 const Function               &value,
                 unsigned int                  body,
                 unsigned int                  support);

    /** Outward normal of a plane boundary, the same on all ranks. */
    dealii::Tensor<1, dim>
    plane_normal(const BoundaryIds &boundary,
                 const std::string &section,
                 const std::string &name) const;
  };
} // namespace Touchstone

#endif
