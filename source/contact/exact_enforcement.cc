#include <touchstone/contact/exact_enforcement.h>
#include <touchstone/contact/row_terms.h>

namespace Touchstone
{
  using namespace dealii;

  void
  ExactEnforcement::recover(Contact &contact, const Vector &, const ConstraintGraph &)
  {
    for (auto &pair_rows : contact.rows)
      for (ContactRow &row : pair_rows)
        {
          // Of open rows, too: they may close before the next linear system.
          if (row.friction)
            choose_friction(row);
          if (!row.active() || row.tied)
            continue;
          if (solved && row.held())
            row.friction->augment_unheld(row.stiffness);
          respond(row);
        }
    solved = false;
  }



  void
  ExactEnforcement::enforce(Contact &contact, ConstraintGraph &graph, LinearSystem &system)
  {
    accepted.clear();
    prepare(contact, system);
    for (auto &pair_rows : contact.rows)
      for (ContactRow &row : pair_rows)
        for (Condition &condition : start_row(row, system.keep_symmetric))
          {
            adjust(row, condition);
            if (row.take(condition, graph.accept(condition, treatment())))
              accepted.push_back({&row, condition, graph.accepted().size() - 1});
          }
    add_to_system(accepted, system);
  }



  void
  ExactEnforcement::update(Contact &)
  {
    for (const Accepted &entry : accepted)
      entry.row->force = Tensor<1, dim>();
    for (std::size_t k = 0; k < accepted.size(); ++k)
      accepted[k].row->force += forces[k] * accepted[k].condition.direction;
    const ContactRow *last = nullptr;
    for (const Accepted &entry : accepted)
      {
        // The conditions of a row follow each other.
        ContactRow &row = *entry.row;
        if (&row == last)
          continue;
        last       = &row;
        row.lambda = row.force * row.normal;
        if (!row.friction || !row.held())
          continue;
        for (const Tensor<1, dim> &tangent : row.friction->unheld)
          row.force += (row.friction->base * tangent) * tangent;
        row.friction->base = row.force - row.lambda * row.normal;
      }
    solved = true;
  }
} // namespace Touchstone
