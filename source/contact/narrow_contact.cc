// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/narrow_contact.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>

// Contact that is narrower than the slave faces, beside slave nodes that carry a force.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Where rows are those of nodes alone, such forces from which on they carry tens of per cent
     * too little: 21 to 39 % with ratios of 2.4 (doc/theory.md 4.1), 3 to 10 % with one half. */
    constexpr double coarse_for_nodes = 1.5;

    /** By the size of the slave face: where a body reaches so deep into the other one between nodes
     * that carry, it is where contact would not let it be, and solvers find it in different places.
     * The arc of a surface with a radius of the size of the face is 0.125 high. */
    constexpr double too_deep = 0.2;



    /** Young's modulus of the softer body, and the normal force of all rows of a pair. Collective.
     */
    std::pair<double, double>
    modulus_and_force(const Contact &contact, const ContactPair &pair)
    {
      double                          modulus = 0., force = 0.;
      const std::vector<SurfaceNode> &nodes = pair.slave().owned_nodes();
      for (std::size_t k = 0; k < nodes.size(); ++k)
        modulus = std::max(modulus, pair.rows()[k].stiffness * nodes[k].size / nodes[k].area);
      for (const ContactRow &row : pair.rows())
        if (const RowState &state = contact.state(row); state.active())
          force += std::max(0., state.lambda);
      return {Utilities::MPI::max(modulus, contact.communicator()),
              Utilities::MPI::sum(force, contact.communicator())};
    }



    /** What lies between the nodes of a pair that carry a force. */
    struct Narrowness
    {
      MissedContact::Place deepest;
      /** The first place that is too deep for its face. */
      std::optional<MissedContact::Place> sunk;
      /** Forces that would take the overlaps away, over those that the rows carry. */
      double ratio = 0.;
    };



    /** Zero for pairs to which this does not apply. @param springs What springs have left.
     * Collective.
     */
    Narrowness
    narrowness(const Contact                                &contact,
               const ContactPair                            &pair,
               const std::map<std::string, LeftPenetration> &springs)
    {
      Narrowness result;
      // Points inside faces have a warning of their own in the step in which they carry. An
      // obstacle is not paired in the reference state.
      if (pair.tied() || (pair.small_sliding() && !pair.master()) ||
          (pair.takes_points() && !pair.points().empty()))
        return result;
      const Vector forces = normal_forces(contact, pair);
      // With small sliding the surfaces may be anywhere: what rows have paired is looked at.
      const auto places = MissedContact(contact,
                                        pair,
                                        forces,
                                        pair.small_sliding() ? MissedContact::Overlaps::as_paired
                                                             : MissedContact::Overlaps::that_count)
                            .beside_nodes();
      if (places.empty())
        return result;
      const auto [modulus, force] = modulus_and_force(contact, pair);
      // Springs leave as much everywhere.
      const auto   of_pair = springs.find(pair.parameters().name);
      const double left    = of_pair == springs.end() ? 0. : of_pair->second.length;
      double       needed  = 0.;
      for (const MissedContact::Place &place : places)
        {
          const double depth = std::max(0., place.depth - left);
          needed += modulus * place.area / place.size * depth;
          if (!result.sunk && depth > too_deep * place.size)
            result.sunk = place;
        }
      result.deepest = places.front();
      result.ratio   = force > 0. ? needed / force : 0.;
      return result;
    }



    const char *const where_no_contact_lets_it_be =
      "more than a fifth of a slave face, so that the bodies are where contact would not let them be";



    /** @param meaning What the overlap says of the result. */
    std::string
    in_words(const ContactPairParameters &pair,
             const MissedContact::Place  &place,
             const std::string           &meaning)
    {
      char text[120];
      std::snprintf(text,
                    sizeof(text),
                    "by up to %.3g at (%.3g, %.3g, %.3g)",
                    place.depth,
                    place.x[0],
                    place.x[1],
                    place.x[2]);
      const bool of_nodes = pair.pairing.name == "pointwise" && pair.obstacle.empty();
      return "contact pair '" + pair.name +
             "': what touches is narrower than the slave faces. Between slave nodes that carry the "
             "force the surfaces overlap, " +
             text + ", " + meaning + ": " + pair.finer_slave() +
             (of_nodes ? ", or average over faces ('Pairing = averaged')" : "");
    }
  } // namespace



  EndFindings
  narrow_contact(const Contact &contact)
  {
    EndFindings result;
    const auto  springs = left_penetration(contact);
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair     = contact.pair(p);
        const Narrowness   here     = narrowness(contact, pair, springs);
        const bool         of_nodes = pair.parameters().pairing.name == "pointwise",
                   narrow           = here.ratio > Tolerances::narrow_contact;
        if (!narrow && !(of_nodes && here.ratio > coarse_for_nodes))
          continue;
        if (narrow && here.sunk)
          result.failure = in_words(pair.parameters(), *here.sunk, where_no_contact_lets_it_be);
        else
          result.warnings.push_back(in_words(pair.parameters(),
                                             here.deepest,
                                             std::string("so that the force may be too small by ") +
                                               (narrow ? "a factor" : "tens of per cent")));
      }
    return result;
  }



  std::string
  sunk_in(const Contact &contact, const std::set<unsigned int> &bodies)
  {
    if (bodies.empty())
      return "";
    const auto springs = left_penetration(contact);
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (bodies.count(pair.slave_body()) == 0 && bodies.count(pair.master_body()) == 0)
          continue;
        if (const Narrowness here = narrowness(contact, pair, springs);
            here.sunk && here.ratio > coarse_for_nodes)
          return in_words(pair.parameters(), *here.sunk, where_no_contact_lets_it_be);
      }
    return "";
  }
} // namespace Touchstone
