// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/drive/explicit_step.h>

#include <algorithm>
#include <cstdio>

// What is wrong with a result of explicit dynamics though the motion goes on: warnings, and contact
// that rows cannot describe (doc/explicit.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  void
  ExplicitStep::judge()
  {
    if (parameters.courant_factor > 1.)
      found.warnings.push_back("'Time integration/Courant factor' is above 1: cycles may be longer "
                               "than is stable for a cell by itself");
    const ExplicitCells::Energies of = cells.energies(now.u);
    // Hourglass modes of coarse meshes in bending are of the former size. In plastic flow modes
    // grow with it, and the springs that bring them back to the undeformed cell do not yield: with
    // 3 % Taylor's rod is a sixth too thin (doc/explicit.md, section 8).
    constexpr double much = 0.1, much_of_flow = 0.01;
    const bool       matters = of.hourglass > 1e-6 * committed.largest;
    if (matters && of.hourglass > much * (of.strain + of.plastic))
      found.warnings.push_back(
        "hourglass modes of one-point cells have more than a tenth of the "
        "energy in the bodies: take a finer mesh, distribute loads over more "
        "nodes, or take another 'Element'");
    else if (matters && of.plastic > of.strain && of.hourglass > much_of_flow * of.plastic)
      found.warnings.push_back(
        "hourglass modes of one-point cells have more than a hundredth of the plastic "
        "work: bodies that flow are too stiff; take the 'Element' 'F-bar', 'Hourglass control' "
        "'viscous', or a finer mesh");
    judge_surfaces();
  }



  void
  ExplicitStep::judge_surfaces()
  {
    if (!impulses || impulses->general_contact() == nullptr)
      return;
    // The check of motion keeps surfaces apart that are moved inwards a little less.
    constexpr double inwards = 3. * GeneralContact::inset;
    GeneralContact  &general = *impulses->general_contact();
    char             time[60];
    std::snprintf(time, sizeof(time), "at time %.6g ", now.time);
    if (crossed.empty())
      if (const std::string text = general.crossings_at(now.u, inwards, names_of_bodies());
          !text.empty())
        crossed = time + ("surfaces of the general contact cross each other, " + text) +
                  ": what follows is in doubt there; take a finer mesh, or do not cut what folds "
                  "by a plane of symmetry";
    if (mirrored.empty())
      if (const std::string text = general.passed_symmetry(now.u, inwards, names_of_bodies());
          !text.empty())
        mirrored =
          time + text +
          ", where its mirror image is: nothing keeps them apart, and what follows is wrong "
          "if that boundary is a plane of symmetry (on rollers it may go on beyond it); let "
          "an obstacle of 'Shape = plane' stand in that plane, with a contact pair of its "
          "own, or do not cut the body";
    for (const std::string *const text : {&crossed, &mirrored})
      if (!text->empty())
        found.warnings.push_back(*text);
  }



  // A corner that hits a face between its nodes gets a force in a wrong direction, but momentum and
  // energy are right, and a tumbling body goes on: other than in statics this alone is no reason to
  // end. But an impact gives no larger impulse than takes the bodies apart as fast as they came;
  // beyond a few times that sides stay pressed together, and the wrong direction decides about the
  // result.
  void
  ExplicitStep::judge_directions(const double length)
  {
    constexpr double  impacts = 4.;
    const std::size_t n_pairs = contact.n_pairs();
    oblique_now               = oblique;
    oblique_now.resize(n_pairs);
    persistent.clear();
    std::vector<BodyMomentum> bodies;
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (!has_oblique_force(contact, pair))
          {
            oblique_now[p] = ObliqueContact();
            continue;
          }
        found.warnings.push_back(
          "contact pair '" + pair.parameters().name +
          "' has had forces far from normal to the slave surface, as an edge "
          "or a vertex touches another edge or the inside of a slave face: "
          "their direction is not right; refine the slave surface, exchange "
          "slave and master, or round the edges");
        if (bodies.empty())
          bodies = momenta();
        ExactSum impulse;
        for (const ContactRow &row : pair.rows())
          impulse.add(length * contact.state(row).force.norm());
        oblique_now[p].impulse += impulse.value(solid.communicator);
        oblique_now[p].speed = std::max(oblique_now[p].speed, impulses->fastest_approach());
        const double of_impact =
          2. * std::min(bodies[pair.slave_body()].mass, bodies[pair.master_body()].mass) *
          oblique_now[p].speed;
        if (persistent.empty() && oblique_now[p].impulse > impacts * of_impact)
          {
            char text[60];
            std::snprintf(text, sizeof(text), "%.3g", oblique_now[p].impulse / of_impact);
            persistent =
              "contact pair '" + pair.parameters().name +
              "': forces far from normal to the slave surface last, with an impulse " + text +
              " times that of the hardest impact of these bodies: an edge or a vertex lies on "
              "another edge or within a slave face, and the direction of its force is not right. "
              "Rows of slave nodes cannot describe this contact: refine the slave surface, exchange "
              "slave and master, or round the edges";
          }
      }
  }



  StepFindings
  ExplicitStep::findings() const
  {
    if (impulses)
      {
        if (const std::string text = unresolved_overlap(contact); !text.empty())
          throw UnresolvedContactFailure(text);
        if (!persistent.empty())
          throw UnresolvedContactFailure(persistent);
      }
    StepFindings result = found;
    result.missed       = MissedPairs::shallow(missed_contact(contact));
    return result;
  }



  StepState
  ExplicitStep::state() const
  {
    return {displacement,
            contact,
            *this,
            solid,
            {},
            {},
            impulses ? impulses->tool_nodes().results() : std::map<std::string, RigidToolResult>(),
            [this]() { return supports.reactions(kept.support); },
            [this]() {
              Vector result(displacement);
              map.to_vector(supports.nodal_reactions(kept.support), result);
              return result;
            }};
  }



  void
  ExplicitStep::add_contact_results(std::vector<ContactFace>  &faces,
                                    std::vector<ContactPoint> &points) const
  {
    if (!impulses || impulses->general_contact() == nullptr)
      return;
    const GeneralResults &general = impulses->general_contact()->results();
    for (const ContactFace &face : general.faces(contact.n_pairs()))
      faces.push_back(face);
    for (const ContactPoint &point : general.points(now.u, contact.n_pairs()))
      points.push_back(point);
  }



  std::string
  ExplicitStep::advice() const
  {
    return "The length of the steps does not matter: see 'Courant factor' and "
           "'Step check interval'.";
  }
} // namespace Touchstone
