// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_rigid_tool_h
#define touchstone_contact_rigid_tool_h

#include <touchstone/base/formula.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/results.h>
#include <touchstone/mesh/obstacle_parameters.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief An obstacle that forces move (doc/theory.md 4.5): the one owner of where it is. Contact
   * pairs are told by place().
   *
   * Components 0 to 2 are those of translations, 3 to 5 of turns, as of FreeMotionParameters.
   */
  class RigidTool
  {
  public:
    static constexpr unsigned int n_components = FreeMotionParameters::n_components;
    using Components                           = std::array<double, n_components>;

    /** @brief All that history has made of it. */
    struct State
    {
      /** Displacement of the reference point, the turn, and the sum of turns about each axis in
       * radians. */
      dealii::Tensor<1, dim> shift;
      dealii::Tensor<2, dim> turn = RigidMotion().turn;
      dealii::Tensor<1, dim> angle;
      /** In dynamics; turns about axes that turn with the obstacle. */
      Components velocity{}, acceleration{};
      /** From outside, and by bodies; along fixed axes. */
      Components load{}, contact{};

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &shift &turn &angle &velocity &acceleration &load &contact;
      }
    };

    /** @param contact Must live as long as this, and its obstacles, too. Collective. */
    RigidTool(const ObstacleParameters &obstacle, const Contact &contact);

    const std::string &
    name() const
    {
      return obstacle->name;
    }
    const FreeMotionParameters &
    free() const
    {
      return obstacle->free;
    }
    std::string
    section() const
    {
      return obstacle->section();
    }

    /** @brief Numbers of its contact pairs. */
    const std::vector<unsigned int> &
    pairs() const
    {
      return own_pairs;
    }

    /** @brief Distance at which a turn counts like a translation: how far slave nodes are from the
     * reference point at time 0, or the size of a face if that is more. */
    double
    length() const
    {
      return arm;
    }

    /** @brief Size of the smallest slave face, length; and Young's modulus of the softest body. */
    double
    face() const
    {
      return smallest_face;
    }
    double
    modulus() const
    {
      return softest;
    }

    /** @brief Force and moment from outside. */
    Components
    load(double time) const;

    /** @brief Force and moment of the bodies about where the reference point is at @p time. */
    Components
    force_of_bodies(const std::vector<PairResult> &results, double time) const;

    /** @brief The state after a displacement, and a turn about fixed axes by an angle in radians,
     * from another one. */
    static void
    move(State &state, const State &from, const Components &by);

    /** @brief Tell the contact pairs where the obstacle is. */
    void
    place(const State &state) const;

    /** @brief Of the state that has been found and placed, in dynamics with velocities. */
    RigidToolResult
    result(const State &state, double time, bool dynamic) const;

    /** @brief Where the reference point is, as the pairs have been told. */
    dealii::Point<dim>
    centre(double time) const;

    State present, committed;

  private:
    const ObstacleParameters                                *obstacle;
    const Contact                                           *contact;
    std::vector<unsigned int>                                own_pairs;
    Formulas                                                 formulas;
    std::array<std::shared_ptr<const Formula>, n_components> loads;
    double arm = 0., smallest_face = 0., softest = 0.;
  };

  /** @brief The obstacles of a scene that forces move and that contact pairs name. Collective. */
  std::vector<RigidTool>
  rigid_tools(const std::vector<ObstacleParameters> &obstacles, const Contact &contact);
} // namespace Touchstone

#endif
