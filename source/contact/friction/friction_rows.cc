// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/contact/friction/friction_response.h>
#include <touchstone/contact/friction/friction_rows.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

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
    present   = std::move(all_rows);
    committed = present;
    int some  = 0;
    for (const FrictionRow &row : present)
      some |= (row.law != nullptr);
    if (Utilities::MPI::max(some, solid.communicator) == 0)
      {
        present.clear();
        committed.clear();
        return;
      }
    reference_positions.reinit(solid.owned, solid.communicator);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, reference_positions);
    owned_start_positions = reference_positions;
  }



  void
  Friction::import_positions(const Vector &u)
  {
    IndexSet needed = solid.relevant;
    for (const ContactRow &row : rows)
      for (const Stencil *stencil : {&row.stencil,
                                     &row.friction->history.anchor,
                                     &row.friction->material_tangents[0],
                                     &row.friction->material_tangents[1]})
        for (const StencilEntry &entry : *stencil)
          if (!needed.is_element(dim * entry.node))
            needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    const int same = positions.present.size() > 0 && needed == positions_known;
    if (Utilities::MPI::min(same, solid.communicator) == 0)
      {
        positions.present.reinit(solid.owned, needed, solid.communicator);
        positions.start.reinit(solid.owned, needed, solid.communicator);
        positions.start = owned_start_positions;
        positions_known = needed;
      }
    owned_positions = reference_positions;
    owned_positions += u;
    positions.present = owned_positions;
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
     * The tangential displacement that an open node has yet to go until it touches, if it
     * goes on as it came in this step: no friction acts on it so far. A node that
     * comes in flatter than 45 degrees slides rather than lands, and one without a
     * past is taken to come along the normal.
     */
    std::array<double, 2>
    precontact_offset(const ContactRow &row, const bool is_active, const FrictionHistory &history)
    {
      const SlipKinematics &k       = row.friction->kinematics;
      const double          closing = history.anchor_gap - row.gap;
      if (!history.has_anchor || is_active || row.gap <= 0. || closing <= 0.)
        return {};
      const Tensor<1, dim> moved = k.slip + k.carry(history.precontact_offset);
      if (moved.norm() > closing)
        return {};
      const double steps = row.gap / closing;
      return {{steps * (moved * k.frame[0]), steps * (moved * k.frame[1])}};
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
    const SlipKinematics &k   = row.friction->kinematics;
    history.precontact_offset = precontact_offset(row, state.active(), history);
    if (state.active())
      {
        const Tensor<1, dim> force = state.force - state.lambda * row.normal;
        history.traction           = k.components(force);
        if (state.status == ContactStatus::slip)
          {
            const Tensor<1, dim> slip = irreversible_slip(*row.friction, state.friction, force);
            history.work -= force * slip;
            history.slip_length += slip.norm();
          }
      }
    set_anchor(row, k, positions, history);
  }



  void
  Friction::end_step(const ContactRows &all_rows, const RowArray<RowState> &states)
  {
    for (const ContactRow &row : all_rows)
      if (row.friction)
        end_step(row, states[row], present[row.index].history);
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
    f.history.traction    = f.kinematics.components(force);
    f.history.slip_length = slip_length;
    f.history.work        = work;
    f.kinematics.start    = force;
    f.kinematics.slip     = Tensor<1, dim>();
    set_anchor(row, f.kinematics, positions, f.history);
  }



  void
  Friction::commit()
  {
    if (!active())
      return;
    // What belongs to the linearisation is made anew in each iteration.
    for (FrictionRow &row : present)
      {
        row.kinematics.slip_gradient.clear();
        row.kinematics.spin_gradient.clear();
      }
    positions.start       = positions.present;
    owned_start_positions = owned_positions;
    committed             = present;
    committed_time        = time;
  }



  void
  Friction::rollback()
  {
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
    owned_start_positions = reference_positions;
    owned_start_positions += archive.field("displacement");
    positions_known.clear(); // ghosts are imported by the next update
    committed = present;
  }
} // namespace Touchstone
