// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/archive/archive.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/spring_enforcement.h>
#include <touchstone/contact/friction/friction_response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

// What penalty method and augmented Lagrangian share (doc/theory.md 6): each accepted condition of
// an active row is a spring of stiffness epsilon = factor E A / h; the system stays definite and
// needs no multipliers. How springs enter the linear system is in spring_conditions.cc.
namespace Touchstone
{
  using namespace dealii;

  void
  SpringEnforcement::commit()
  {
    Enforcement::commit();
    committed_growth = growth;
  }



  void
  SpringEnforcement::rollback()
  {
    Enforcement::rollback();
    growth = committed_growth;
  }



  void
  SpringEnforcement::save(ArchiveWriter &archive) const
  {
    Enforcement::save(archive);
    archive.put("spring growth", committed_growth);
  }



  void
  SpringEnforcement::load(const ArchiveReader &archive)
  {
    Enforcement::load(archive);
    growth = committed_growth = archive.get<double>("spring growth");
  }



  void
  SpringEnforcement::take(const LinearSolution &solution)
  {
    // Force after the solve: lambda_k - epsilon (g + dg), with dg from the increment. It
    // differs from -epsilon g of the next state by what the linearisation leaves out.
    std::vector<LinearForm> forms;
    for (const Spring &spring : springs)
      forms.push_back(by_unknowns(spring.condition.motion_form()));
    const std::vector<double> elongations = evaluate_forms(forms, solution.increment);
    for (std::size_t k = 0; k < springs.size(); ++k)
      springs[k].force -= springs[k].epsilon * elongations[k];
  }



  double
  SpringEnforcement::round_off_squared(const ContactRows &rows, const double length) const
  {
    // Positions of magnitude `length` are known up to machine precision; a gap is the
    // difference of a few of them, and the spring turns its error into a force.
    double sum = 0.;
    for (const ContactRow &row : rows)
      if (row_states[row].active() && by_gap(row))
        sum +=
          std::pow(4. * std::numeric_limits<double>::epsilon() * length * factor * row.stiffness,
                   2);
    return sum;
  }



  void
  SpringEnforcement::evaluate(const Contact &contact, const Vector &, const ConstraintGraph &)
  {
    for (const ContactRow &row : contact.rows())
      {
        RowState &state = row_states[row];
        if (!state.active() || state.dropped())
          continue;
        if (solved && row.friction && state.fully_constrained())
          augment_unconstrained(row, state);
        if (solved)
          judge_springs(row, state);
        if (solved && !row.friction && !by_gap(row))
          evaluate_force(row, state); // the force of the linear solve
        else
          evaluate_row(row, state);
        admit_gap(row, solved);
      }
    if (solved && stiffens())
      stiffen(contact.communicator());
    solved = false;
  }



  void
  SpringEnforcement::set_forces(const Contact &)
  {
    for (const Spring &spring : springs)
      row_states[*spring.row].force = Tensor<1, dim>();
    for (const Spring &spring : springs)
      row_states[*spring.row].force += spring.force * spring.condition.direction;
    std::set<const ContactRow *> found;
    for (const Spring &spring : springs)
      // After the sum over all springs of a row, which can be three.
      if (found.insert(spring.row).second)
        {
          const ContactRow &row   = *spring.row;
          RowState         &state = row_states[row];
          state.lambda            = state.force * spring.normal;
          if (row.friction && state.fully_constrained())
            set_stick(state, spring.normal);
        }
    solved = true;
    ++n_solves;
  }



  void
  SpringEnforcement::augment(const ContactRow &row)
  {
    const RowState &state    = row_states[row];
    augmentation[row].rest   = row.tied ? state.force : state.force - state.lambda * row.normal;
    augmentation[row].lambda = state.lambda;
  }



  double
  SpringEnforcement::violation(const Spring &spring)
  {
    const ContactRow     &row       = *spring.row;
    const Tensor<1, dim> &direction = spring.condition.direction;
    if (row.tied)
      return row.gap_vector * direction;
    // Tangents are perpendicular to the normal of the linear system.
    const bool normal = direction * spring.normal > 0.5;
    return normal ? row.gap : row.friction->kinematics.slip * direction;
  }



  void
  SpringEnforcement::stiffen(const MPI_Comm communicator)
  {
    constexpr double closes = 0.25, by = 10., stiffest = 1e3;
    double           before = 0., after = 0.;
    for (const Spring &spring : springs)
      if (row_states[*spring.row].active())
        {
          const double size = spring.row->size;
          before            = std::max(before, std::abs(spring.condition.value) / size);
          after             = std::max(after, std::abs(violation(spring)) / size);
        }
    before = Utilities::MPI::max(before, communicator);
    after  = Utilities::MPI::max(after, communicator);
    if (n_solves > 1 && after > closes * before)
      growth = std::min(by * growth, stiffest);
  }



  double
  SpringEnforcement::normal_force(const ContactRow &row) const
  {
    return !row.friction || by_gap(row) ? augmentation[row].lambda - epsilon(row) * row.gap
                                        : row_states[row].lambda;
  }



  void
  SpringEnforcement::evaluate_row(const ContactRow &row, RowState &state)
  {
    if (row.tied)
      {
        state.force = augmentation[row].rest - epsilon(row) * row.gap_vector;
        // No spring where a support or another row decides: the linear system has none either.
        for (unsigned int d = 0; d < dim; ++d)
          if (state.refuses(d))
            state.force[d] = 0.;
        state.lambda = state.force * row.normal;
        return;
      }
    state.lambda = normal_force(row);
    if (row.friction)
      choose_formulation(row, state, epsilon(row));
    evaluate_force(row, state);
  }
} // namespace Touchstone
