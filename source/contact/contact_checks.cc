// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_checks.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/contact/overlapping_bodies.h>
#include <touchstone/contact/pressing_rows.h>
#include <touchstone/contact/results.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/contact/unresolved_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

// Reports and checks that read the state of contact and change nothing: the gaps with which the run
// starts, and after each converged step the search for contact that no row can describe
// (doc/theory.md 4.1).
namespace Touchstone
{
  using namespace dealii;

  Vector
  normal_forces(const Contact &contact, const ContactPair &pair)
  {
    const Solid        &solid = contact.solid_model();
    Vector              owned(solid.zero_vector());
    std::vector<Index>  dofs;
    std::vector<double> values;
    const PressingRows  pressing(contact);
    for (const ContactRow &row : pair.rows())
      // Only compression: the cone of normals has no meaning for a small force in tension, which
      // the tolerance of the active set admits.
      if (pressing.contain(row))
        for (unsigned int d = 0; d < dim; ++d)
          {
            dofs.push_back(dim * row.slave + d);
            values.push_back(contact.state(row).lambda * row.normal[d]);
            // A force between nodes is shared by those around it.
            for (const StencilEntry &entry : row.stencil)
              if (row.between_nodes && entry.weight < 0.)
                {
                  dofs.push_back(dim * entry.node + d);
                  values.push_back(-entry.weight * contact.state(row).lambda * row.normal[d]);
                }
          }
    owned.add(dofs, values);
    owned.compress(VectorOperation::add);
    return contact.with_ghosts(owned);
  }



  namespace
  {
    UnresolvedContact
    check_of(const ContactPair &pair, const Contact &contact, const Vector &forces)
    {
      return {contact.solid_model(),
              pair.parameters(),
              pair.slave(),
              *pair.master(),
              pair.slave_body(),
              pair.master_body(),
              contact.ghosted_displacement(),
              forces,
              pair.planes_of_symmetry()};
    }



    /** The deepest overlap of a pair with its master, empty without one. */
    std::string
    overlap_of_pair(const Contact &contact, const ContactPair &pair, const Vector &forces)
    {
      // An initial overlap that is adjusted or grows with time is no sign of unresolved contact:
      // overlaps are looked for only where they count from the start. Obstacles have no edges that
      // could cross those of a body. With small sliding the surfaces are not moved, so that their
      // overlap means nothing. Edges and nodes of a body that meets itself are beside each other
      // without touching. MissedContact looks at all of these for points within slave faces.
      if (pair.parameters().initial_overlap != ContactPairParameters::Overlap::interference ||
          !pair.master() || pair.small_sliding() || pair.parameters().of_one_body())
        return "";
      return check_of(pair, contact, forces).overlap();
    }



    /** An oblique force in a pair, empty without one. */
    std::string
    oblique_force_of_pair(const Contact &contact, const ContactPair &pair, const Vector &forces)
    {
      return pair.master() ? check_of(pair, contact, forces).oblique_force() : "";
    }



    /** What is found first in any pair, with the pair and the remedy. */
    template <class Find>
    std::string
    first_finding(const Contact &contact, const Find &find)
    {
      // Tied pairs may be in tension and along any direction, so forces prove nothing there.
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        if (const ContactPair &pair = contact.pair(p); !pair.tied())
          if (const std::string text = find(pair, normal_forces(contact, pair)); !text.empty())
            return "contact pair '" + pair.parameters().name + "': " + text +
                   ". Rows of slave nodes cannot describe this contact: refine the slave surface" +
                   (pair.master() ? ", exchange slave and master, or round the edges" : "");
      return "";
    }
  } // namespace



  std::string
  unresolved_contact(const Contact &contact)
  {
    return first_finding(contact, [&](const ContactPair &pair, const Vector &forces) {
      const std::string text = overlap_of_pair(contact, pair, forces);
      return text.empty() ? oblique_force_of_pair(contact, pair, forces) : text;
    });
  }



  std::string
  unresolved_overlap(const Contact &contact)
  {
    return first_finding(contact, [&](const ContactPair &pair, const Vector &forces) {
      return overlap_of_pair(contact, pair, forces);
    });
  }



  bool
  has_oblique_force(const Contact &contact, const ContactPair &pair)
  {
    return !pair.tied() &&
           !oblique_force_of_pair(contact, pair, normal_forces(contact, pair)).empty();
  }



  namespace
  {
    /** Bodies that meet themselves must not overlap with themselves in the mesh: what lies within
     * the body there is taken for the other side of a wall, and would not be kept apart.
     * @throws InputError. Collective. */
    void
    check_own_overlaps(const Contact &contact)
    {
      const Solid                         &solid = contact.solid_model();
      std::map<unsigned int, unsigned int> pairs;
      std::set<unsigned int>               bodies;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        if (contact.pair(p).parameters().of_one_body() &&
            bodies.insert(contact.pair(p).slave_body()).second)
          pairs.emplace(contact.pair(p).slave_body(), p);
      if (bodies.empty())
        return;
      const Vector zero = contact.with_ghosts(solid.zero_vector());
      for (const BodyOverlap &overlap :
           overlapping_bodies(contact, zero, bodies, Tolerances::deep_edge))
        if (overlap.body == overlap.other)
          throw InputError(contact.pair(pairs.at(overlap.body)).parameters().section(),
                           "Master body",
                           solid.bodies[overlap.body].name,
                           overlap.place(solid) + " in the mesh",
                           "make a mesh in which the surfaces that meet do not overlap");
    }



    /** The deepest overlap of a pair as its bodies are placed, before there are contact forces.
     * Collective. */
    MissedContact::Place
    overlap_between_nodes(const Contact &contact, const ContactPair &pair)
    {
      // Surfaces that will be tied are not to be kept apart.
      if (pair.tied() || !pair.master() || pair.parameters().of_one_body())
        return {};
      return MissedContact(contact,
                           pair,
                           normal_forces(contact, pair),
                           MissedContact::Overlaps::as_placed)
        .deepest();
    }
  } // namespace



  std::vector<std::string>
  start_report(const Contact &contact)
  {
    const MPI_Comm           communicator = contact.communicator();
    std::vector<std::string> lines;
    check_own_overlaps(contact);
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair   = contact.pair(p);
        double             lowest = std::numeric_limits<double>::max(), size = 0.;
        unsigned int       points = 0, partner = 0, overlapping = 0;
        const bool         at_nodes = pair.pairing().keeps_nodes_out();
        const char *const  what     = at_nodes ? "slave nodes" : "points of slave faces";
        for (std::size_t k = 0; k < pair.rows().size(); ++k)
          {
            const ContactRow &row = pair.rows()[k];
            // Of pairings that keep points between nodes out of the master these are counted.
            if (row.between_nodes == at_nodes || (!at_nodes && row.area == 0.))
              continue;
            ++points;
            if (!row.has_partner)
              continue;
            // The gap as the bodies are placed: before the treatment of initial overlaps, and of
            // the surfaces themselves, see ContactRow::share.
            const double gap = (row.gap + pair.overlap(k)) / row.share;
            ++partner;
            lowest = std::min(lowest, gap);
            size   = std::max(size, row.size);
            overlapping += (gap < -Tolerances::touches_at_start * row.size);
          }
        // Each node is the row of exactly one rank, so sums over ranks count no node twice.
        const unsigned int total = Utilities::MPI::sum(points, communicator);
        lowest                   = Utilities::MPI::min(lowest, communicator);
        size                     = Utilities::MPI::max(size, communicator);
        partner                  = Utilities::MPI::sum(partner, communicator);
        overlapping              = Utilities::MPI::sum(overlapping, communicator);
        const ContactPairParameters::Overlap treatment = pair.parameters().initial_overlap;
        const std::string                    overlap =
          std::string(": an initial overlap") + (lowest < -size ? " larger than a face" : "") +
          ", " +
          (treatment == ContactPairParameters::Overlap::adjust ? "adjusted to no gap"
           : treatment == ContactPairParameters::Overlap::ramp
             ? "an interference that grows with time"
             : "taken as interference");
        std::string place;
        char        text[300];
        if (overlapping == 0)
          if (const MissedContact::Place between = overlap_between_nodes(contact, pair);
              between.depth > 0.)
            {
              lowest = -between.depth;
              std::snprintf(text,
                            sizeof(text),
                            ", between them, at (%.4g, %.4g, %.4g)",
                            between.x[0] + 0.,
                            between.x[1] + 0.,
                            between.x[2] + 0.);
              place = text + overlap;
            }
        if (partner == 0 && place.empty())
          // Without a partner no row has a gap to report.
          std::snprintf(
            text, sizeof(text), "no master face within reach of any of %u %s", total, what);
        else
          std::snprintf(text,
                        sizeof(text),
                        "%u %s, %u face the master surface, smallest gap %.4g%s",
                        total,
                        what,
                        partner,
                        lowest,
                        overlapping == 0 ? place.c_str() : overlap.c_str());
        lines.push_back("contact pair " + pair.parameters().name + ": " + text);
      }
    return lines;
  }



  namespace
  {
    /** Nodes at which a surface ends, of the faces that this rank knows. */
    std::set<Index>
    end_nodes(const Surface &surface)
    {
      std::set<Index> result;
      for (const std::vector<Face> *const faces :
           {&surface.owned_faces(), &surface.neighbour_faces()})
        for (const Face &face : *faces)
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            if (at_end(face, m))
              result.insert(face.nodes[m]);
      return result;
    }
  } // namespace



  namespace
  {
    /** Tied pairs farther apart than the cells are deep whose strain is extrapolated: the weight
     * that is added to the nodes of the surface. Collective. */
    void
    add_wide_ties(const Contact &contact, std::vector<std::string> &result)
    {
      const auto sum_of_sizes = [](const Stencil &stencil) {
        double sum = 0.;
        for (const StencilEntry &entry : stencil)
          sum += std::abs(entry.weight);
        return sum;
      };
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        {
          double most = 0.;
          for (const ContactRow &row : contact.pair(p).rows())
            if (row.has_partner && row.at_surface)
              most = std::max(most,
                              0.5 * (sum_of_sizes(row.stencil) - sum_of_sizes(*row.at_surface)) /
                                row.share);
          most = Utilities::MPI::max(most, contact.communicator());
          if (most <= 1.)
            continue;
          char text[300];
          std::snprintf(
            text,
            sizeof(text),
            "': its surfaces are placed up to %.3g times as far apart as the cells "
            "behind the master surface are deep, whose strain is extrapolated over this "
            "distance: the joint is softer than their material. Larger cells there, or "
            "surfaces that are closer, make it stiffer",
            most);
          result.push_back("tied pair '" + contact.pair(p).parameters().name + text);
        }
    }
  } // namespace



  std::vector<std::string>
  doubtful_ties(const Contact &contact)
  {
    // Rows of averages give each node what a pressure over its area gives, but for the areas of
    // facets over curved surfaces. Of pointwise rows, meshes whose faces are of about the same size
    // differ by 10 % and more somewhere, slaves that are nested in the master's faces by nothing.
    constexpr double         even         = 1.05;
    const MPI_Comm           communicator = contact.communicator();
    std::vector<std::string> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const Surface *const master = contact.pair(p).master())
        {
          // At its ends the master may have less than the slave, whatever the rows.
          const std::set<Index> ends  = end_nodes(*master);
          const auto            areas = areas_on_master(contact, p);
          double                most  = 0.;
          auto                  area  = areas.begin();
          for (const SurfaceNode &node : master->owned_nodes())
            {
              if (ends.count(node.node) == 0 && node.area > 0.)
                most = std::max(most, *area / node.area);
              ++area;
            }
          most = Utilities::MPI::max(most, communicator);
          if (!contact.pair(p).tied() || most <= even)
            continue;
          char text[300];
          std::snprintf(text,
                        sizeof(text),
                        "': the meshes do not match, and rows of its pairing hand a uniform "
                        "traction on to the master unevenly, to some node %.3g times what its area "
                        "asks for. Displacements of such joints can be off by many per cent, most "
                        "where a body hangs on few faces: 'Pairing = averaged' is exact there",
                        most);
          result.push_back("contact pair '" + contact.pair(p).parameters().name + text);
        }
    add_wide_ties(contact, result);
    return result;
  }
} // namespace Touchstone
