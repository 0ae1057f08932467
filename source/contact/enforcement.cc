#include <touchstone/contact/enforcement.h>

namespace Touchstone
{
  std::vector<Condition>
  start_row(ContactRow &row)
  {
    row.accepted = row.refused = 0;
    if (!row.active())
      return {};
    Condition condition;
    condition.node            = row.slave;
    condition.stencil         = row.stencil;
    condition.body            = row.body;
    condition.master_body     = row.master_body;
    condition.position        = row.position;
    condition.master_position = row.position - row.gap_vector;
    std::vector<Condition> conditions;
    if (row.status == ContactStatus::slip)
      {
        condition.direction = row.normal;
        condition.value     = -row.gap;
        conditions.push_back(condition);
      }
    else
      for (unsigned int d = 0; d < dim; ++d)
        {
          condition.direction    = dealii::Tensor<1, dim>();
          condition.direction[d] = 1.;
          condition.value        = -row.gap_vector[d];
          conditions.push_back(condition);
        }
    return conditions;
  }
} // namespace Touchstone
