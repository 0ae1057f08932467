// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/pressing_rows.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Rows whose force is more than round-off.
namespace Touchstone
{
  using namespace dealii;

  PressingRows::PressingRows(const Contact &contact, const Of of)
    : contact(contact)
    , of(of)
  {
    for (const ContactRow &row : contact.rows())
      if (const RowState &here = state(row); here.active())
        largest = std::max(largest, here.lambda);
    largest = Utilities::MPI::max(largest, contact.communicator());
  }



  const RowState &
  PressingRows::state(const ContactRow &row) const
  {
    return of == Of::present ? contact.state(row)
                             : contact.enforcement().states().of_committed(row);
  }



  bool
  PressingRows::contain(const ContactRow &row) const
  {
    const RowState &here   = state(row);
    const double    length = std::max(Tolerances::undetermined_strain * row.size,
                                   Tolerances::undetermined_position * contact_point(row).norm());
    return here.active() &&
           here.lambda > std::max(Tolerances::undetermined_force * largest, length * row.stiffness);
  }
} // namespace Touchstone
