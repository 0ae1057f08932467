#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/contact/contact.h>

#include <algorithm>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  void
  Contact::find_shared_nodes(const ConstraintGraph &supports)
  {
    // Rows that may close belong to them: the formulation of friction must not change with the
    // active set, or each of the two states could ask for the other.
    std::map<Index, unsigned int> n_near;
    for (const auto &pair_rows : rows)
      for (const ContactRow &row : pair_rows)
        n_near[row.slave] += (row.status != ContactStatus::no_partner && row.gap < row.size);

    // Up to round-off a tangent of unit length keeps its length if it is free.
    constexpr double free_length = 1. - 1e-6;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (ContactRow &row : rows[p])
        if (row.friction)
          {
            const std::vector<Tensor<1, dim>> &tangents = row.friction->tangents;
            row.friction->shared =
              !pairs[p].master &&
              (n_near[row.slave] > 1 ||
               std::any_of(tangents.begin(), tangents.end(), [&](const Tensor<1, dim> &tangent) {
                 return supports.free_part(row.slave, tangent).norm() < free_length;
               }));
          }
  }
} // namespace Touchstone
