// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/contact/friction/friction_response.h>
#include <touchstone/contact/friction/friction_rows.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>

// The history of friction and the slip of all rows of this rank (doc/theory.md 6.2).
// Friction::update() makes the slip of each Newton iterate from the history and the positions
// alone; only end_step(), called once when a step has converged, writes the history, so that a step
// that is cut leaves no trace.
namespace Touchstone
{
  using namespace dealii;

  Friction::Friction(const Solid &solid)
    : solid(solid)
  {
  }



  void
  Friction::reinit(std::vector<FrictionRow> all_rows)
  {
    // The decision must be the same on all ranks, because the import of positions is collective.
    // Without friction nothing is kept: a vector that is cleared keeps its memory.
    int some = 0;
    for (const FrictionRow &row : all_rows)
      some |= (row.law != nullptr);
    if (Utilities::MPI::max(some, solid.communicator) == 0)
      return;
    present   = std::move(all_rows);
    committed = present;
    reference_positions.reinit(solid.zero_vector());
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, reference_positions);
    owned_displacement.reinit(reference_positions);
    owned_start_displacement = owned_displacement;
  }



  void
  Friction::import_positions(const Vector &u)
  {
    // Stencils and anchors can refer to any node of the master surface, also far beyond the ghost
    // layer of the mesh. They change while bodies slide, so the set is made anew in each iteration;
    // the vectors are only if it has changed on some rank.
    IndexSet needed = solid.relevant;
    for (const ContactRow &row : rows)
      for (const Stencil *stencil : {&row.stencil,
                                     &row.friction->history.anchor,
                                     &material_tangents(row)[0],
                                     &material_tangents(row)[1]})
        for (const StencilEntry &entry : *stencil)
          if (!needed.is_element(dim * entry.node))
            needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    const int same = positions.present.size() > 0 && needed == positions_known;
    if (Utilities::MPI::min(same, solid.communicator) == 0)
      {
        positions.present.reinit(solid.owned, needed, solid.communicator);
        positions.start.reinit(solid.owned, needed, solid.communicator);
        positions.reference.reinit(solid.owned, needed, solid.communicator);
        positions.start     = owned_start_displacement;
        positions.reference = reference_positions;
        positions_known     = needed;
      }
    owned_displacement = u;
    positions.present  = owned_displacement;
  }



  void
  Friction::update(const ContactRows &all_rows, const Vector &u, const double t)
  {
    if (!active())
      return;
    time = t;
    rows.clear();
    for (const ContactRow &row : all_rows)
      if (row.friction)
        rows.push_back(row);
    import_positions(u);
    for (const ContactRow &row : rows)
      if (row.has_partner)
        present[row.index].kinematics =
          slip_kinematics(row, positions, time, time - committed_time);
  }



  void
  Friction::differentiate(const ContactRows &all_rows)
  {
    for (const ContactRow &row : all_rows)
      if (row.friction && row.derivative)
        differentiate_slip(row, positions, present[row.index].kinematics);
  }



  namespace
  {
    /**
     * The tangential displacement that an open node is predicted to make until it touches, if it
     * continues in the direction of this step, doc/theory.md 6.2, equation (19): without contact
     * there is no friction, so this displacement is no slip. Zero for a node that approaches at
     * less than 45 degrees to the surface, which will slide, and for one without a step of
     * approach, which is taken to come along the normal. A step in which next to nothing moves is
     * none: its approach is what an iteration has left, in a direction that round-off chooses. What
     * was predicted before counts then. In components of the frame.
     */
    std::array<double, 2>
    precontact_offset(const ContactRow &row, const bool is_active, const FrictionHistory &history)
    {
      // Nothing to predict without a committed gap, or in contact.
      if (!history.has_anchor || is_active || row.gap <= 0.)
        return {};
      const SlipKinematics &k       = row.friction->kinematics;
      const double          closing = history.anchor_gap - row.gap;
      // The slip does not contain the offset that the last step predicted; the displacement along
      // the surface does.
      const Tensor<1, dim> moved = k.slip + k.carry(history.precontact_offset);
      // How much a motion tells that is small beside the gap: all of it, or nothing.
      constexpr double much = 0.2, little = 0.1;
      const double     motion = std::max(std::abs(closing), moved.norm()) / row.gap;
      const double     known  = std::clamp((motion - little) / (much - little), 0., 1.);
      // With dg = closing, equation (19) extrapolates by the factor g / dg.
      const bool            lands = closing > 0. && moved.norm() <= closing;
      const double          steps = lands ? row.gap / closing : 0.;
      std::array<double, 2> result;
      for (unsigned int a = 0; a < 2; ++a)
        result[a] =
          known * steps * (moved * k.frame[a]) + (1. - known) * history.precontact_offset[a];
      return result;
    }
  } // namespace



  void
  Friction::end_step(const ContactRow &row, const RowState &state, FrictionHistory &history) const
  {
    history.traction = {};
    if (!row.has_partner)
      {
        history.has_anchor        = false;
        history.precontact_offset = {};
        history.anchor.clear();
        history.anchor_displacement = {};
        return;
      }
    const SlipKinematics &k = row.friction->kinematics;
    // Uses the anchor of the step that ends, and hence has to precede set_anchor().
    history.precontact_offset = precontact_offset(row, state.active(), history);
    if (state.active())
      {
        const Tensor<1, dim> force = state.force - state.lambda * row.normal;
        // Kept in components of the frame, so that the force turns with the surface. Of a point
        // inside a face it is that of the point: in the next step its row can have another share.
        history.traction = k.components(share_of_point(row) * force);
        if (state.status == ContactStatus::slip)
          {
            // Friction opposes the slip, so the dissipated work -t.s_p is positive. An open node or
            // one that sticks dissipates nothing.
            const Tensor<1, dim> slip = irreversible_slip(*row.friction, *state.friction, force);
            history.work -= force * slip;
            history.slip_length += slip.norm();
          }
      }
    set_anchor(row, k, positions, history);
    // Which of the nodes of an edge or face has the row is a choice, for equal weights by an order
    // that mirror images do not have, and another step may make another one. So nothing but the
    // displacements of the step counts, which any of the nodes knows (equation (20)); the two
    // points are together already, and there is no way to the contact left to predict.
    if (row.between_nodes && state.active())
      history.has_anchor = false;
  }



  void
  Friction::end_step(const ContactRows &all_rows, const RowArray<RowState> &states)
  {
    for (const ContactRow &row : all_rows)
      if (row.friction)
        end_step(row, states[row], present[row.index].history);
  }



  void
  Friction::record(const ContactRow     &row,
                   const Tensor<1, dim> &force,
                   const Tensor<1, dim> &slip,
                   const double          path,
                   const double          work)
  {
    FrictionRow &f        = present[row.index];
    f.kinematics.slip     = slip;
    f.history.traction    = f.kinematics.components(force);
    f.history.slip_length = f.history.slip_length + path;
    f.history.work        = f.history.work + work;
  }



  void
  Friction::adopt(const ContactRow     &row,
                  const Tensor<1, dim> &force,
                  const double          slip_length,
                  const double          work)
  {
    FrictionRow &f = present[row.index];
    if (!row.has_partner)
      {
        f.history.has_anchor = false;
        return;
      }
    // The new mesh has other slave nodes: each begins with the interpolated traction and counts its
    // slip from where it is now (doc/theory.md 11, "History").
    f.history.traction    = f.kinematics.components(force);
    f.history.slip_length = slip_length;
    f.history.work        = work;
    f.kinematics.start    = force;
    f.kinematics.slip     = Tensor<1, dim>();
    set_anchor(row, f.kinematics, positions, f.history);
  }



  void
  Friction::forget(const ContactRow &row)
  {
    FrictionHistory &history  = present[row.index].history;
    history.has_anchor        = false;
    history.precontact_offset = {};
    history.traction          = {};
  }



  void
  Friction::recall(const ContactRow &row)
  {
    present[row.index].history = committed[row.index].history;
  }



  void
  Friction::commit()
  {
    if (!active())
      return;
    // Gradients are made anew in each iteration and need not be copied with the history.
    for (FrictionRow &row : present)
      {
        row.kinematics.slip_gradient.clear();
        row.kinematics.spin_gradient.clear();
      }
    positions.start          = positions.present;
    owned_start_displacement = owned_displacement;
    committed                = present;
    committed_time           = time;
  }



  void
  Friction::rollback()
  {
    // Element by element: the contact rows hold pointers to the elements of this vector.
    std::copy(committed.begin(), committed.end(), present.begin());
  }



  void
  Friction::save(ArchiveWriter &archive) const
  {
    save_rows(archive, "friction", rows, [this](const ContactRow &row, RowPacker &pack) {
      FrictionRow::visit_state(committed[row.index], pack);
    });
  }



  void
  Friction::load(const ArchiveReader &archive)
  {
    if (!active())
      return;
    load_rows(archive, "friction", rows, [this](const ContactRow &row, RowUnpacker &unpack) {
      FrictionRow::visit_state(present[row.index], unpack);
    });
    time = committed_time = archive.get<double>("committed time");
    // The slip of the next step counts from the committed displacement of the checkpoint, whereas
    // the update that made the rows was in the reference state.
    owned_start_displacement = archive.field("displacement");
    positions_known.clear(); // ghosts are imported by the next update
    committed = present;
  }
} // namespace Touchstone
