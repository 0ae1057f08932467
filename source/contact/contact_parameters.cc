// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/expression.h>
#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact_parameters.h>
#include <touchstone/contact/enforcement/enforcement.h>
#include <touchstone/contact/friction/friction_law.h>
#include <touchstone/contact/pairing/pairing.h>

#include <cmath>
#include <set>

// Input of contact pairs and of enforcement: the keys with their documentation, and the checks that
// need no mesh. An error names the section, the key, the value, the reason and a remedy. What needs
// the mesh or other sections (names of boundaries, bodies) is checked where they are known.
namespace Touchstone
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;

  std::string
  ContactPairParameters::section() const
  {
    return "Contact pair " + (part_of.empty() ? name : part_of);
  }



  void
  ContactPairParameters::declare_surfaces(ParameterHandler &prm)
  {
    prm.add_parameter("Slave body",
                      slave_body,
                      "The body whose nodes must not penetrate. Required.",
                      Patterns::Anything(),
                      /*has_to_be_set=*/true);
    prm.add_parameter("Slave boundaries",
                      slave_boundaries,
                      "Its boundaries, by name or number; 'all' are those that are no planes of "
                      "symmetry. Required.",
                      Patterns::List(Patterns::Anything()),
                      /*has_to_be_set=*/true);
    prm.add_parameter("Master body",
                      master_body,
                      "The body that must not be penetrated; empty if it is an "
                      "obstacle. It may be the slave body, with 'Pairing = pointwise': "
                      "the body then meets itself, also with the same boundaries.",
                      Patterns::Anything());
    prm.add_parameter("Master boundaries", master_boundaries, "Its boundaries, by name or number.");
    prm.add_parameter("Obstacle",
                      obstacle,
                      "Name of the rigid obstacle that must not be penetrated; "
                      "empty if it is a body.",
                      Patterns::Anything());
  }



  // Order matters: the choice of pairing and friction law is read early (`values`), because their
  // own keys have to be declared before the file is parsed.
  void
  ContactPairParameters::declare(ParameterHandler &prm, const EarlyValues &values)
  {
    declare_surfaces(prm);
    pairing.declare_key(prm,
                        values,
                        "Pairing",
                        "How rows are made of surfaces: 'pointwise' projects each "
                        "slave node onto the master surface; 'averaged' averages over the "
                        "slave faces with a dual basis and passes the patch test. An "
                        "obstacle needs neither.");
    behaviour.declare_key(prm,
                          values,
                          "Behaviour",
                          "'frictionless' contact; 'tied' once and for all where the surfaces "
                          "face each other; or a friction law, whose own keys stand in the "
                          "subsection 'Friction':",
                          {"frictionless", "tied"});
    // The law exists from here on, null for the two behaviours without friction; its own keys are
    // in a subsection, so that they cannot collide with those of the pair.
    friction = behaviour.make();
    if (friction)
      {
        prm.enter_subsection("Friction");
        behaviour.declare_own_keys(prm);
        prm.leave_subsection();
      }
    initial_overlap.declare(
      prm,
      "Initial overlap",
      "An overlap of the bodies as they are placed is an 'interference' that "
      "presses them apart, or a fault of the mesh to 'adjust': gaps count from "
      "it, and it leads to no stress. 'ramp' is an interference that grows "
      "with time until 'Overlap end time'. Tied pairs are always adjusted.");
    prm.add_parameter("Overlap end time",
                      ramp_end,
                      "Of 'Initial overlap = ramp': when the overlap has its full size, which it "
                      "keeps from then on; 0: at the end of the run. [time]",
                      Patterns::Double(0.));
    prm.add_parameter("Pretension force",
                      pretension_force,
                      "Of a tied pair across a plane cut, through a bolt for example: the tension "
                      "to which the sides are drawn together, a formula in t; empty: none. [force]",
                      FormulaPattern());
    prm.add_parameter("Pretension shortening",
                      pretension_shortening,
                      "The same by the length by which they are drawn together. [length]",
                      FormulaPattern());
    prm.add_parameter(
      "Pretension until",
      pretension_until,
      "The phase of 'Load stepping/Phases' at whose end the cut is locked: it keeps "
      "its length, and its tension follows from what else acts. Empty: never.",
      Patterns::Anything());
    sliding.declare(prm,
                    "Sliding",
                    "'finite' searches the partners in each iteration, 'small' "
                    "keeps those of the reference state. Tied pairs are small; an "
                    "obstacle is always met where it is.");
    contact_geometry.declare(prm,
                             "Contact geometry",
                             "Gaps and normals come from the exact surfaces where the "
                             "geometry knows them ('manifold'), or from the faces of the "
                             "mesh ('faceted').");
    master_normal.declare(prm,
                          "Master normal",
                          "The normal of the master surface: that of the 'face' at the contact "
                          "point; interpolated from normals 'averaged' at the nodes, except "
                          "across sharp edges; or 'smoothed': gap and normal of a smooth patch "
                          "over each face of degree 1. Where the exact surface is known "
                          "'smoothed' is the same as 'averaged'.");
    prm.add_parameter("Search distance",
                      search_distance,
                      "Farthest distance at which a slave node looks for a "
                      "master face; 0 chooses it from the size of the faces. "
                      "[length]",
                      Patterns::Double(0.));
    prm.add_parameter("Edge tolerance",
                      edge_tolerance,
                      "How far beyond the edge of the master surface a slave node "
                      "is still held, as a fraction of the face. [no unit]",
                      Patterns::Double(0., 1.));
    pairing.declare_own_keys(prm);
  }



  // From missing keys to contradictions, so that the first message is the most basic one.
  void
  ContactPairParameters::check(const std::string &section) const
  {
    if (slave_boundaries.empty())
      throw InputError(section,
                       "Slave boundaries",
                       "",
                       "the list is empty",
                       "name the boundaries of '" + slave_body + "' that come into contact");
    if (master_body.empty() && obstacle.empty())
      throw InputError(section,
                       "Master body",
                       "",
                       "the pair has neither a master body nor an obstacle",
                       "set 'Master body' and 'Master boundaries', or 'Obstacle'");
    if (!master_body.empty() && !obstacle.empty())
      throw InputError(section,
                       "Obstacle",
                       obstacle,
                       "contradicts 'Master body' = '" + master_body + "'",
                       "remove one of them; a second pair can have the other");
    if (!master_body.empty() && master_boundaries.empty())
      throw InputError(section,
                       "Master boundaries",
                       "",
                       "the list is empty",
                       "name the boundaries of '" + master_body + "' that come into contact");
    behaviour.check(section + "/Friction");
    pairing.check(section);
    check_pretension(section);
    if (!obstacle.empty() && !master_boundaries.empty())
      throw InputError(section,
                       "Master boundaries",
                       master_boundaries.front(),
                       "an obstacle has no boundaries",
                       "remove 'Master boundaries' or take a master body");

    // Empty and repeated names are most likely typing errors.
    for (const auto &[key, list] : {std::make_pair("Slave boundaries", &slave_boundaries),
                                    std::make_pair("Master boundaries", &master_boundaries)})
      {
        std::set<std::string> names;
        for (const std::string &boundary : *list)
          if (boundary.empty() || !names.insert(boundary).second)
            throw InputError(section,
                             key,
                             boundary,
                             boundary.empty() ? "a name in this list is empty"
                                              : "this boundary is listed twice",
                             "name each boundary once, with commas between them");
      }
    // By name only; other names of the same boundary are found by ContactPair, which knows their
    // numbers.
    if (of_one_body())
      check_one_body(section);
    for (const std::string &slave : slave_boundaries)
      for (const std::string &master : master_boundaries)
        if (slave == master && slave_body == master_body)
          check_shared_boundary(section, master, false);
  }



  void
  ContactPairParameters::check_one_body(const std::string &section) const
  {
    // Averages over faces know nothing of which faces of its own body a face can meet.
    if (pairing.name != "pointwise")
      throw InputError(section,
                       "Pairing",
                       pairing.name,
                       "is for surfaces of different bodies, and '" + slave_body +
                         "' is slave and master",
                       "set it to 'pointwise'; parts that are not connected can also be bodies "
                       "of their own");
    // What lies within itself in the reference state cannot be told from the inside of the body.
    if (initial_overlap != Overlap::interference)
      throw InputError(section,
                       "Initial overlap",
                       initial_overlap.word(),
                       "needs two bodies that can overlap, and '" + slave_body +
                         "' is slave and master",
                       "remove the key, and let the surfaces not overlap in the mesh");
  }



  void
  ContactPairParameters::check_shared_boundary(const std::string &section,
                                               const std::string &boundary,
                                               const bool         in_cycles) const
  {
    if (tied())
      throw InputError(section,
                       "Master boundaries",
                       boundary,
                       "this boundary of '" + master_body + "' would be tied to itself",
                       "let different boundaries be slave and master");
    if (in_cycles)
      throw InputError(section,
                       "Master boundaries",
                       boundary,
                       "this boundary of '" + master_body +
                         "' is slave and master at the same time, which is the matter of general "
                         "contact in explicit dynamics",
                       "remove 'Master body' and 'Master boundaries': a pair without them is "
                       "general contact");
  }



  void
  ContactPairParameters::check_pretension(const std::string &section) const
  {
    for (const auto &[key, text] :
         {std::make_pair("Pretension force", &pretension_force),
          std::make_pair("Pretension shortening", &pretension_shortening)})
      {
        if (text->empty())
          continue;
        check_expression(section, key, *text, "t");
        if (!tied() || master_body.empty())
          throw InputError(
            section,
            key,
            *text,
            "is for tied pairs of two bodies, the parts of a bolt on both sides of a "
            "plane cut",
            "set 'Behaviour = tied' and 'Master body', or remove the key");
      }
    if (!pretension_force.empty() && !pretension_shortening.empty())
      throw InputError(section,
                       "Pretension shortening",
                       pretension_shortening,
                       "contradicts 'Pretension force': one follows from the other",
                       "remove one of them");
    if (!pretension_until.empty() && !has_pretension())
      throw InputError(section,
                       "Pretension until",
                       pretension_until,
                       "there is no pretension that could be locked",
                       "remove the key, or set 'Pretension force' or 'Pretension shortening'");
  }



  // The factors multiply automatic values that follow from material and mesh (E A / h), so that one
  // input serves all systems of units and mesh sizes (doc/theory.md 6).
  void
  ContactParameters::declare(ParameterHandler &prm, const EarlyValues &values)
  {
    enforcement.declare_key(prm,
                            values,
                            "Enforcement",
                            "How contact is enforced: 'automatic' is 'forward increment' in "
                            "explicit dynamics and 'elimination' elsewhere; "
                            "'elimination' of the slave unknowns, which "
                            "leaves a system for any linear solver; "
                            "'lagrange multipliers' as unknowns of their own, which need MUMPS; "
                            "'augmented lagrange', springs whose forces grow until the gaps close; "
                            "or 'penalty', springs that leave a penetration. Both serve explicit "
                            "dynamics, too.",
                            {"automatic"});
    prm.add_parameter("Penalty factor",
                      penalty_factor,
                      "Multiplies the automatic stiffness of the springs, which is Young's "
                      "modulus times tributary area over face size, times 100 for 'penalty' "
                      "and 20 for 'augmented lagrange'. In explicit dynamics it is 0.1 K A / V per "
                      "area for 'penalty', with the bulk modulus and the volume behind the faces, "
                      "and m / h^2 with mass and cycle, times 0.1 for 'soft penalty'. [no unit]",
                      Patterns::Double());
    augmentation.declare(prm,
                         "Augmentation",
                         "Forces of 'augmented lagrange' grow in each Newton iteration "
                         "('merged'), or each time that Newton has found a balance ('outer').");
    friction.declare(prm,
                     "Friction",
                     "Nodes that stick are held without any slip ('exact'), or slip "
                     "elastically on springs ('regularised'), as they always do with "
                     "'penalty'.");
    prm.add_parameter("Tangential factor",
                      tangential_factor,
                      "Multiplies the automatic stiffness of these springs, which is ten times "
                      "Young's modulus times tributary area over face size, or in explicit "
                      "dynamics that of the springs along the normal. [no unit]",
                      Patterns::Double());
    linearisation.declare(
      prm,
      "Linearisation",
      "Within a Newton iteration, normals, contact points and slip directions "
      "change with the bodies ('consistent', quadratic convergence), or not "
      "('frozen', symmetric but for slip). 'automatic' is consistent with friction "
      "where a direct solver takes unsymmetric systems, and for the rest of a step "
      "in which a frozen iteration has gained little.");
    prm.add_parameter(
      "Contact tolerance",
      impulse_tolerance,
      "Of 'forward increment' and 'augmented lagrange', in explicit dynamics: the sweeps of a "
      "cycle end when "
      "they change no velocity by more than this, relative to the speed at which "
      "bodies would close. [no unit]",
      Patterns::Double(0., 0.1));
    prm.add_parameter("Contact iterations",
                      most_sweeps,
                      "Of the same: the largest number of sweeps in a cycle. Momentum is "
                      "exact and no energy is gained wherever they end. [no unit]",
                      Patterns::Integer(1, 1000000));
    enforcement.declare_own_keys(prm);
  }



  // `!(x > 0)` instead of `x <= 0`: it is true for NaN as well.
  void
  ContactParameters::check(const std::string &section) const
  {
    enforcement.check(section);
    if (!(penalty_factor > 0.) || !std::isfinite(penalty_factor))
      throw InputError(section,
                       "Penalty factor",
                       std::to_string(penalty_factor),
                       "must be positive",
                       "1 is the automatic choice.");
    if (!(tangential_factor > 0.) || !std::isfinite(tangential_factor))
      throw InputError(section,
                       "Tangential factor",
                       std::to_string(tangential_factor),
                       "must be positive",
                       "1 is the automatic choice.");
  }
} // namespace Touchstone
