// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_friction_friction_rows_h
#define touchstone_contact_friction_friction_rows_h

#include <touchstone/contact/friction/slip_kinematics.h>
#include <touchstone/contact/row_array.h>
#include <touchstone/contact/row_state.h>
#include <touchstone/solid/solid.h>

#include <deal.II/base/index_set.h>

#include <vector>

namespace Touchstone
{
  /** @brief Friction of all rows of this rank: owns their histories and slip kinematics. */
  class Friction : public Stateful
  {
  public:
    explicit Friction(const Solid &solid);

    /** @brief Take the constants of all rows of this rank, in the order of their index; nothing
     * where no pair has friction. Collective. */
    void
    reinit(std::vector<FrictionRow> rows);

    /** @brief There is friction, on any rank. */
    bool
    active() const
    {
      return reference_positions.size() > 0;
    }

    /** @brief Null for rows without friction. */
    const FrictionRow *
    row(const std::size_t index) const
    {
      return index < present.size() && present[index].law != nullptr ? &present[index] : nullptr;
    }

    /** @brief As of the last committed state. */
    const FrictionHistory &
    committed_history(const ContactRow &row) const
    {
      return committed[row.index].history;
    }

    /** @brief Find the slip of @p rows in the displacement @p u (owned) at time @p t.
     * Collective. */
    void
    update(const ContactRows &rows, const Vector &u, double t);

    /** @brief Set the gradients of the rows that have a derivative. */
    void
    differentiate(const ContactRows &rows);

    /** @brief The step ends with these contact forces: make their history. */
    void
    end_step(const ContactRows &rows, const RowArray<RowState> &states);

    /** @brief The step ends with this force and slip in a row, where its friction was followed
     * through the step by impulses: no slip is measured from a contact point.
     * @param path Length of the slip path of the step. @param work Force times length. */
    void
    record(const ContactRow             &row,
           const dealii::Tensor<1, dim> &force,
           const dealii::Tensor<1, dim> &slip,
           double                        path,
           double                        work);

    /** @brief A step begins with @p force in a row, after a change of the mesh.
     * @param work Force times length. */
    void
    adopt(const ContactRow             &row,
          const dealii::Tensor<1, dim> &force,
          double                        slip_length,
          double                        work);

    /** @brief A row between nodes describes another point from now on, which has no history but
     * the path and work of its node. */
    void
    forget(const ContactRow &row);

    /** @brief The row goes on with its committed history. */
    void
    recall(const ContactRow &row);

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

  private:
    const Solid             &solid;
    std::vector<FrictionRow> present, committed;
    /** Those of the last update() that have friction. */
    ContactRows rows;
    /** Of owned nodes: positions in the reference state, displacements now and when the step began;
     * and those of all nodes that rows refer to. */
    Vector           reference_positions, owned_displacement, owned_start_displacement;
    NodePositions    positions;
    dealii::IndexSet positions_known;
    double           time = 0., committed_time = 0.;

    /** Positions of all nodes that stencils, anchors and tangents refer to. Collective. */
    void
    import_positions(const Vector &u);
    void
    end_step(const ContactRow &row, const RowState &state, FrictionHistory &history) const;
  };
} // namespace Touchstone

#endif
