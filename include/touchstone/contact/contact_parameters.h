// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_contact_parameters_h
#define touchstone_contact_contact_parameters_h

#include <touchstone/base/choice.h>
#include <touchstone/base/keyword.h>
#include <touchstone/contact/geometry/master_normal.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace Touchstone
{
  class Enforcement;
  class FrictionLaw;
  class Pairing;
  struct ContactParameters;
  struct PairingInput;

  /** @brief Section "Contact pair NAME". */
  struct ContactPairParameters
  {
    std::string              name;
    std::string              slave_body;
    std::vector<std::string> slave_boundaries;
    /** Master body and its boundaries, or the name of an obstacle. */
    std::string              master_body;
    std::vector<std::string> master_boundaries;
    std::string              obstacle;
    /** How rows are made; its own keys are in the same section. */
    Choice<Registry<Pairing, const PairingInput &>> pairing{"averaged"};
    /** "frictionless", "tied", or the name of a friction law. */
    Choice<Registry<FrictionLaw>> behaviour{"frictionless"};
    /** The friction law with its own parameters read, subsection "Friction"; null
     * without friction. */
    std::shared_ptr<FrictionLaw> friction;
    /** Treatment of an overlap of the bodies as they are placed. */
    enum class Overlap
    {
      /** It presses the bodies apart. */
      interference,
      /** Gaps count from it: no overlap. */
      adjust,
      /** An interference that grows with time, until #ramp_end. */
      ramp
    };
    Keyword<Overlap> initial_overlap{Overlap::interference,
                                     {{"interference", Overlap::interference},
                                      {"adjust", Overlap::adjust},
                                      {"ramp", Overlap::ramp}}};
    /** When a ramp has its full size; 0: at the end of the run. */
    double ramp_end = 0.;
    /** Of a tied pair across a plane cut: the tension that it is tightened to, force, or by how
     * much its sides are drawn together, length; expressions in t. And the phase after which it is
     * locked, empty for none. */
    std::string pretension_force, pretension_shortening, pretension_until;
    bool
    has_pretension() const
    {
      return !(pretension_force + pretension_shortening).empty();
    }
    /** finite: search in each iteration; small: reference pairing. Tied pairs are always
     * small. */
    enum class Sliding
    {
      finite,
      small
    };
    Keyword<Sliding> sliding{Sliding::finite,
                             {{"finite", Sliding::finite}, {"small", Sliding::small}}};
    /** Where gaps and normals come from: the exact surfaces where the geometry knows them, or
     * the faces of the mesh. */
    enum class Shape
    {
      manifold,
      faceted
    };
    Keyword<Shape>        contact_geometry{Shape::manifold,
                                    {{"manifold", Shape::manifold}, {"faceted", Shape::faceted}}};
    Keyword<MasterNormal> master_normal{MasterNormal::averaged,
                                        {{"face", MasterNormal::face},
                                         {"averaged", MasterNormal::averaged},
                                         {"smoothed", MasterNormal::smoothed}}};
    /** Farthest distance at which a slave node looks for a master face,
     * length; 0 chooses it from the size of the faces. */
    double search_distance = 0.;
    /** How far beyond the edge of the master surface a slave node still has a row, as a fraction
     * of the face. */
    double edge_tolerance = 0.01;

    /** The name in the scene of the pair that this one is a part of, for one of the walls of its
     * obstacle (ObstacleShape::walls()), and the number of the wall; else empty. */
    std::string  part_of;
    unsigned int wall = 0;

    /** @brief "Contact pair NAME", with the name in the scene. */
    std::string
    section() const;

    /** @brief The same, with a name that no other pair has: walls of an obstacle share a section.
     */
    std::string
    unique_name() const
    {
      return "Contact pair " + name;
    }

    /** @brief Whether the bodies are joined where they face each other. */
    bool
    tied() const
    {
      return behaviour.name == "tied";
    }

    /** @brief Whether a body meets itself: slave and master are parts of one body, and are not
     * joined. */
    bool
    of_one_body() const
    {
      return !tied() && obstacle.empty() && slave_body == master_body;
    }

    /** @brief The remedy where slave faces are too large for what touches them. */
    std::string
    finer_slave() const
    {
      const bool can_be_exchanged = obstacle.empty() && !of_one_body();
      return std::string("refine the slave surface") +
             (can_be_exchanged ? ", or exchange slave and master" : "");
    }

    /** @param values Of this section: pairing and behaviour decide on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;

    /** @brief Check what a pair needs of which a boundary is slave and master.
     * @throws InputError */
    void
    check_shared_boundary(const std::string &section,
                          const std::string &boundary,
                          bool               in_cycles) const;

  private:
    void
    check_pretension(const std::string &section) const;
    /** What only pairs of different bodies can have. */
    void
    check_one_body(const std::string &section) const;
    /** Which surfaces meet. */
    void
    declare_surfaces(dealii::ParameterHandler &prm);
  };

  /** @brief Section "Contact": how all pairs of the scene are enforced. */
  struct ContactParameters
  {
    /** "elimination", "lagrange multipliers", ...; its own keys are in the same section. The scene
     * replaces "automatic" by default_enforcement(). */
    Choice<Registry<Enforcement, const ContactParameters &>> enforcement{"automatic"};
    /** Multiplies the automatic penalty (Young's modulus times tributary area over
     * face size, times 100 for penalty and 20 for augmented Lagrange); no unit. */
    double penalty_factor = 1.;
    /** Of augmented Lagrange: merged with Newton's iterations, or in an outer loop around
     * them (Uzawa). */
    enum class Augmentation
    {
      merged,
      outer
    };
    Keyword<Augmentation> augmentation{Augmentation::merged,
                                       {{"merged", Augmentation::merged},
                                        {"outer", Augmentation::outer}}};
    /** Stick: exact without any slip, or regularised by elastic slip. */
    enum class Stick
    {
      exact,
      regularised
    };
    Keyword<Stick> friction{Stick::exact,
                            {{"exact", Stick::exact}, {"regularised", Stick::regularised}}};
    /** Multiplies the automatic stiffness of regularised stick; no unit. */
    double tangential_factor = 1.;
    /** consistent: with the change of normals, stencils and slip directions; frozen: without;
     * automatic: consistent with friction, if the linear solver allows it. */
    enum class Linearisation
    {
      automatic,
      consistent,
      frozen
    };
    Keyword<Linearisation> linearisation{Linearisation::automatic,
                                         {{"automatic", Linearisation::automatic},
                                          {"consistent", Linearisation::consistent},
                                          {"frozen", Linearisation::frozen}}};
    /** Of impulses: change of a velocity in the last sweep, relative to the closing speed; and the
     * largest number of sweeps in a cycle. */
    double       impulse_tolerance = 1e-10;
    unsigned int most_sweeps       = 200;

    /** @brief What "automatic" stands for.
     * @param by_impulses In explicit dynamics. */
    static const char *
    default_enforcement(const bool by_impulses)
    {
      return by_impulses ? "forward increment" : "elimination";
    }

    /** @param values Of this section: the enforcement decides on other keys. */
    void
    declare(dealii::ParameterHandler &prm, const EarlyValues &values);
    void
    check(const std::string &section) const;
  };
} // namespace Touchstone

#endif
