// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/pairing/sets_of_points.h>
#include <touchstone/contact/shared_faces.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Contact holds the pairs, their friction and the enforcement and calls them in the order in which
// they depend on each other: pairs make the geometry of the rows, the enforcement their status and
// forces, friction their slip. What is derived from this state is in results.cc and
// contact_checks.cc. All ranks call the same functions in the same order, since most are
// collective.
namespace Touchstone
{
  using namespace dealii;

  Contact::Contact(const std::vector<ContactPairInput> &inputs,
                   const ContactParameters             &parameters,
                   const Solid                         &solid,
                   const Mirrors                       &mirrors,
                   const Mirrors                       &supports)
    : solid(solid)
    , mirrors(mirrors)
    , supports(supports)
    , friction_rows(solid)
    , method(parameters.enforcement.make(parameters))
    , impulse_forces("impulse force")
  {
    // Rows are numbered over all pairs of this rank, so that the arrays of enforcement and friction
    // need one index only; friction has an entry for each row, also without a law.
    std::vector<FrictionRow> frictions;
    for (const ContactPairInput &input : inputs)
      {
        pairs.push_back(std::make_unique<ContactPair>(input));
        pairs.back()->number_rows(frictions.size());
        pairs.back()->set_planes_of_symmetry(mirrors);
        for (FrictionRow &row : pairs.back()->friction_rows(parameters))
          frictions.push_back(std::move(row));
      }
    friction_rows.reinit(std::move(frictions));
    // Contact faces of other bodies and of other ranks refer to dofs beyond the ghost layer of the
    // mesh; one import per update serves all surfaces.
    IndexSet seen = solid.relevant;
    // Only now, for `friction_rows` must not move its elements once rows point to them.
    for (const auto &pair : pairs)
      {
        pair->set_friction([this](const std::size_t index) { return friction_rows.row(index); });
        for (const ContactRow &row : pair->rows())
          all_rows.push_back(row);
        seen.add_indices(pair->slave().far_unknowns().begin(), pair->slave().far_unknowns().end());
      }
    for (const auto &pair : pairs)
      if (pair->master())
        seen.add_indices(pair->master()->far_unknowns().begin(),
                         pair->master()->far_unknowns().end());
    without_rows = NodesWithoutRows(pairs.size());
    without_rows_finder.emplace(pairs, this->supports, solid);
    method->reinit(all_rows);
    impulse_forces.reinit(all_rows);
    former_friction_work.assign(pairs.size(), 0.);
    cyclic.reinit(pairs, solid.communicator);
    // The order of commit, rollback and of checkpoints: first the geometry, to which the rest
    // refers.
    for (const auto &pair : pairs)
      parts.push_back(pair.get());
    for (Stateful *part : {static_cast<Stateful *>(&friction_rows),
                           static_cast<Stateful *>(method.get()),
                           static_cast<Stateful *>(&impulse_forces)})
      parts.push_back(part);
    if (pairs.empty())
      return;
    seen.compress();
    // One rank has all values: no list of them is needed.
    if (Utilities::MPI::n_mpi_processes(solid.communicator) == 1)
      ghosted.reinit(solid.zero_vector());
    else
      ghosted.reinit(solid.owned, seen, solid.communicator);
    import_ghosts.emplace(solid.zero_vector(), ghosted);
  }



  void
  Contact::move(const Vector &u)
  {
    if (import_ghosts)
      (*import_ghosts)(u, ghosted);
  }



  void
  Contact::set_points(const unsigned int p, const std::vector<MaterialPoint> &points)
  {
    // Friction belongs to a point, and to the row of a node only as long as this is its row.
    for (const ContactRow &row : pairs[p]->rows())
      if (row.friction && row.between_nodes)
        {
          const MaterialPoint *const last       = point_of(pairs[p]->committed_points(), row.slave),
                                     *const now = point_of(points, row.slave);
          if (last && now && goes_on_from(*last, *now))
            friction_rows.recall(row);
          else if (last || now)
            friction_rows.forget(row);
        }
    pairs[p]->set_points(points);
  }



  bool
  Contact::leave_edges()
  {
    bool left = false;
    for (const auto &pair : pairs)
      left |= pair->leave_edges();
    return Utilities::MPI::max(static_cast<int>(left), solid.communicator) == 1;
  }



  void
  Contact::begin_again(const Vector &u, const double time)
  {
    std::vector<std::vector<MaterialPoint>> points(pairs.size());
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p]->takes_points())
        points[p] = pairs[p]->points();
    rollback();
    if (formed)
      change_rows(*formed, u, time);
    formed.reset();
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p]->takes_points())
        set_points(p, points[p]);
    method->begin_step();
  }



  void
  Contact::update(const Vector &u, const double time)
  {
    present_time = time;
    move(u);
    for (const auto &pair : pairs)
      pair->update(u, ghosted, time, [this](const ContactRow &row) { return state(row).active(); });
    if (!started)
      leave_rows(u);
    complete_cover(u);
    // Impulses belong to the committed step alone.
    impulse_forces.reinit_present();
    // Before the slip: a row that has lost its partner has none.
    method->update_partners(all_rows, !started);
    started = true;
    friction_rows.update(all_rows, u, time);
  }



  void
  Contact::leave_rows(const Vector &u)
  {
    without_rows = without_rows_finder->find(rows_by_pair());
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (const std::set<Index> nodes = without_rows.of_pair(p); !nodes.empty())
        {
          pairs[p]->remove_rows(nodes);
          pairs[p]->update(u, ghosted, present_time, [](const ContactRow &) { return false; });
        }
  }



  void
  Contact::complete_cover(const Vector &u)
  {
    const std::vector<Vector> parts = cover_by_other_pairs(pairs, solid);
    if (parts.empty() && !shares_faces)
      return;
    shares_faces = !parts.empty();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const Vector part = shares_faces ? with_ghosts(parts[p]) : Vector();
        pairs[p]->complete_cover(u, shares_faces ? &part : nullptr, !started);
      }
  }



  void
  Contact::differentiate()
  {
    for (const auto &pair : pairs)
      pair->differentiate([this](const ContactRow &row) { return state(row).active(); });
    friction_rows.differentiate(all_rows);
  }



  void
  Contact::commit_positions()
  {
    for (const auto &pair : pairs)
      pair->commit_positions();
  }



  void
  Contact::record_friction(const ContactRow     &row,
                           const Tensor<1, dim> &force,
                           const Tensor<1, dim> &slip,
                           const double          path,
                           const double          work)
  {
    friction_rows.record(row, force, slip, path, work);
  }



  Vector
  Contact::with_ghosts(const Vector &owned) const
  {
    if (!import_ghosts)
      return solid.ghosted(owned);
    Vector result;
    result.reinit(ghosted);
    (*import_ghosts)(owned, result);
    return result;
  }



  unsigned int
  Contact::n_searches() const
  {
    unsigned int sum = 0;
    for (const auto &pair : pairs)
      sum += pair->n_searches();
    return sum;
  }
} // namespace Touchstone
