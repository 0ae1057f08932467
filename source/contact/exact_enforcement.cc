#include <touchstone/contact/exact_enforcement.h>
#include <touchstone/contact/row_terms.h>

#include <algorithm>
#include <set>

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
    const auto offer = [&](ContactRow &row, Condition &condition) {
      adjust(row, condition);
      if (row.take(condition, graph.accept(condition, treatment())))
        accepted.push_back({&row, condition, graph.accepted().size() - 1});
    };
    // Nothing may penetrate: what closes gaps precedes what holds nodes along surfaces.
    std::vector<std::pair<ContactRow *, std::vector<Condition>>> stick;
    for (auto &pair_rows : contact.rows)
      for (ContactRow &row : pair_rows)
        {
          std::vector<Condition> conditions = start_row(row, system.keep_symmetric);
          const std::size_t      n          = row.tied ? conditions.size() : 1;
          for (std::size_t k = 0; k < std::min(n, conditions.size()); ++k)
            offer(row, conditions[k]);
          if (conditions.size() > n)
            stick.emplace_back(&row, std::vector<Condition>(conditions.begin() + n,
                                                            conditions.end()));
        }
    for (auto &[row, conditions] : stick)
      for (Condition &condition : conditions)
        offer(*row, condition);
    add_to_system(accepted, system);
  }



  void
  ExactEnforcement::update(Contact &)
  {
    for (const Accepted &entry : accepted)
      entry.row->force = Tensor<1, dim>();
    for (std::size_t k = 0; k < accepted.size(); ++k)
      accepted[k].row->force += forces[k] * accepted[k].condition.direction;
    std::set<ContactRow *> found;
    for (const Accepted &entry : accepted)
      {
        ContactRow &row = *entry.row;
        if (!found.insert(&row).second)
          continue;
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
