// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/base/exact_sum.h>
#include <touchstone/contact/contact.h>

// History of contact: pairs, friction and enforcement are Stateful and listed once, in `parts`.
// What goes over to another mesh are fields at the nodes.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    const std::string former_work = "friction work of former rows";
  }



  void
  Contact::commit()
  {
    // The history needs the forces and the geometry of the step that ends, so it is made before
    // anything is committed. Explicit steps follow it through their cycles: record_friction().
    if (!in_cycles)
      friction_rows.end_step(all_rows, method->states());
    for (Stateful *part : parts)
      part->commit();
  }



  void
  Contact::rollback()
  {
    for (Stateful *part : parts)
      part->rollback();
  }



  void
  Contact::save(ArchiveWriter &archive) const
  {
    save_nodes_without_rows(archive);
    archive.put(former_work, former_friction_work);
    for (const Stateful *part : parts)
      part->save(archive);
  }



  void
  Contact::load(const ArchiveReader &archive)
  {
    // The update that made the rows was in the reference state: surfaces have to be moved to the
    // committed displacement before the parts are loaded.
    present_time = archive.get<double>("committed time");
    load_nodes_without_rows(archive);
    // Checkpoints of earlier versions have none.
    if (archive.has(former_work))
      former_friction_work = archive.get<std::vector<double>>(former_work);
    move(archive.field("displacement"));
    for (const auto &pair : pairs)
      pair->set_displacement(ghosted, present_time);
    for (Stateful *part : parts)
      part->load(archive);
  }



  std::vector<Vector>
  Contact::fields(const bool of_committed) const
  {
    std::vector<Vector> result(n_fields * pairs.size(), solid.zero_vector());
    for (const ContactRow &present : all_rows)
      {
        // Those between nodes have no area and hence no density: they are found anew.
        if (present.between_nodes)
          continue;
        const ContactRow &row = of_committed ? committed(present) : present;
        const RowState   &now = of_committed ? method->states().of_committed(row) : state(row);
        // Densities over the area: nodal forces cannot be interpolated between meshes
        // (doc/theory.md 11, "History"). Status flags become numbers between 0 and 1 by
        // interpolation.
        Vector *const field = &result[n_fields * row.pair];
        if (now.active() && row.area > 0.)
          for (unsigned int d = 0; d < dim; ++d)
            field[0](dim * row.slave + d) = now.force[d] / row.area;
        field[1](dim * row.slave)     = now.active();
        field[1](dim * row.slave + 1) = (now.status == ContactStatus::stick);
        if (row.friction && row.area > 0.)
          {
            const FrictionHistory &history =
              of_committed ? friction_rows.committed_history(row) : row.friction->history;
            field[2](dim * row.slave)     = history.slip_length;
            field[2](dim * row.slave + 1) = history.work / row.area;
          }
      }
    for (Vector &field : result)
      field.compress(VectorOperation::insert);
    return result;
  }



  std::vector<double>
  Contact::friction_work() const
  {
    // Sums without round-off, which do not depend on the partition.
    std::vector<ExactSum> sums(pairs.size());
    for (const ContactRow &row : all_rows)
      if (row.friction)
        sums[row.pair].add(friction_rows.committed_history(row).work);
    std::vector<double> result(former_friction_work);
    for (std::size_t p = 0; p < result.size(); ++p)
      result[p] += sums[p].value(solid.communicator);
    return result;
  }



  void
  Contact::keep_friction_work(const std::vector<double> &of_pairs)
  {
    const std::vector<double> taken_over = friction_work();
    for (std::size_t p = 0; p < of_pairs.size(); ++p)
      former_friction_work[p] += of_pairs[p] - taken_over[p];
  }



  void
  Contact::adopt(const ContactRow &row, const std::vector<Vector> &fields, const bool history)
  {
    if (row.between_nodes)
      return;
    const Vector *const field = &fields[n_fields * row.pair];
    Tensor<1, dim>      force;
    for (unsigned int d = 0; d < dim; ++d)
      force[d] = row.area * field[0](dim * row.slave + d);
    // More than half of the neighbourhood decides about the status of a new node.
    const ContactStatus status = field[1](dim * row.slave) < 0.5 ? ContactStatus::open
                                 : row.friction && field[1](dim * row.slave + 1) >= 0.5
                                   ? ContactStatus::stick
                                   : ContactStatus::slip;
    method->adopt(row, status, force);
    if (row.friction && history)
      friction_rows.adopt(row,
                          state(row).force - state(row).lambda * row.normal,
                          field[2](dim * row.slave),
                          row.area * field[2](dim * row.slave + 1));
  }



  void
  Contact::adopt(const std::vector<Vector> &fields, const bool history)
  {
    for (const ContactRow &row : all_rows)
      adopt(row, fields, history);
    // The fields are the committed state: the step on the new mesh begins with it, and a rollback
    // leads here.
    if (history)
      for (Stateful *part : parts)
        part->commit();
  }
} // namespace Touchstone
