// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/conflicting_supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// Prescribed displacements that earlier conditions of the same node imply are dropped where the
// system is set up (ConstraintGraph). Here is seen that nothing is lost by it.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Prescribed = BoundaryConditions::Prescribed;

    /** As in ConstraintGraph: shorter than this without the directions of others, a direction is
     * implied by them. */
    constexpr double dependent = 1e-3;
    /** Beside the largest displacement that is prescribed: round-off of formulas and of the normals
     * of planes is far less, a contradiction that somebody has in mind far more. */
    constexpr double same = 1e-6;
    /** More times than this tell no more of a formula. */
    constexpr unsigned int most_times = 100;

    /** A direction that is free of those before it, and its displacement. */
    struct Kept
    {
      Tensor<1, dim> direction;
      double         value;
      unsigned int   support;
    };

    /** A condition and what earlier ones of its node say instead. */
    struct Conflict
    {
      const Prescribed *condition = nullptr;
      double            asked = 0., implied = 0.;
      unsigned int      other = 0;

      double
      size() const
      {
        return condition == nullptr ? 0. : std::abs(asked - implied);
      }
    };

    /** The worst conflict of a node, whose conditions are in the order of precedence. */
    Conflict
    conflict_of(const std::vector<const Prescribed *> &conditions, const double t)
    {
      Conflict          worst;
      std::vector<Kept> kept;
      for (const Prescribed *p : conditions)
        {
          Kept   rest{p->direction, p->displacement(t), p->support};
          double largest = 0.;
          auto   other   = p->support;
          for (const Kept &k : kept)
            {
              const double part = p->direction * k.direction;
              rest.direction -= part * k.direction;
              rest.value -= part * k.value;
              if (std::abs(part) > largest)
                {
                  largest = std::abs(part);
                  other   = k.support;
                }
            }
          const double length = rest.direction.norm();
          if (length >= dependent)
            kept.push_back({rest.direction / length, rest.value / length, p->support});
          // What is not finite is told by the formula itself.
          else if (std::abs(rest.value) > worst.size())
            {
              const double asked = p->displacement(t);
              worst              = {p, asked, asked - rest.value, other};
            }
        }
      return worst;
    }

    std::string
    number(const double value)
    {
      std::ostringstream out;
      out.imbue(std::locale::classic());
      out << value;
      return out.str();
    }

    /** Section, key and text of the formula, and what is wrong with it. */
    std::vector<std::string>
    described(const BoundaryConditions &conditions, const Conflict &conflict, const double t)
    {
      const Point<dim>        &x      = conflict.condition->position;
      std::vector<std::string> result = conflict.condition->value->entry();
      result.push_back("at x = " + number(x[0]) + ", y = " + number(x[1]) + ", z = " +
                       number(x[2]) + " and t = " + number(t) + " it is " + number(conflict.asked) +
                       ", but boundary '" + conditions.reaction_names()[conflict.other].boundary +
                       "', which meets this one there, prescribes " + number(conflict.implied));
      return result;
    }

    /** On all ranks, for the first position of those that ranks name; some name none. Collective.
     */
    [[noreturn]] void
    refuse(const BoundaryConditions &conditions,
           const Conflict           &conflict,
           const double              t,
           const MPI_Comm            communicator)
    {
      std::vector<double>      place;
      std::vector<std::string> text;
      if (conflict.condition != nullptr)
        {
          const Point<dim> &x = conflict.condition->position;
          place.assign(x.begin_raw(), x.end_raw());
          text = described(conditions, conflict, t);
        }
      const auto   places = Utilities::MPI::all_gather(communicator, place);
      unsigned int first  = 0;
      for (unsigned int rank = 0; rank < places.size(); ++rank)
        if (!places[rank].empty() && (places[first].empty() || places[rank] < places[first]))
          first = rank;
      text = Utilities::MPI::broadcast(communicator, text, first);
      throw InputError(text[0],
                       text[1],
                       text[2],
                       text[3],
                       "prescribe displacements that agree where boundaries meet, or only one of "
                       "them");
    }
  } // namespace



  void
  check_supports(const BoundaryConditions  &conditions,
                 const std::vector<double> &times,
                 const MPI_Comm             communicator)
  {
    const std::vector<Prescribed>                   &all = conditions.prescribed_directions();
    std::map<Index, std::vector<const Prescribed *>> nodes;
    for (const Prescribed &p : all)
      nodes[p.node].push_back(&p);
    std::vector<double> some = {0.};
    const std::size_t   n    = std::min<std::size_t>(times.size(), most_times);
    for (std::size_t k = 1; k <= n; ++k)
      some.push_back(times[k * times.size() / n - 1]);

    for (const double t : some)
      {
        // The same one on any number of ranks: the largest, of equal ones the first by position.
        Conflict   worst;
        const auto before = [](const Conflict &a, const Conflict &b) {
          const Point<dim> &x = a.condition->position, &y = b.condition->position;
          return std::lexicographical_compare(x.begin_raw(),
                                              x.end_raw(),
                                              y.begin_raw(),
                                              y.end_raw());
        };
        for (const auto &[node, list] : nodes)
          if (list.size() > 1)
            if (const Conflict found = conflict_of(list, t);
                found.size() > worst.size() ||
                (found.size() > 0. && found.size() == worst.size() && before(found, worst)))
              worst = found;
        const double largest = Utilities::MPI::max(worst.size(), communicator);
        if (largest == 0.)
          continue;
        double scale = 0.;
        for (const Prescribed &p : all)
          if (p.value)
            scale = std::max(scale, std::abs(p.displacement(t)));
        conditions.all_formulas().check(communicator);
        if (largest <= same * Utilities::MPI::max(scale, communicator))
          continue;
        refuse(conditions, worst.size() == largest ? worst : Conflict(), t, communicator);
      }
    conditions.all_formulas().check(communicator);
  }
} // namespace Touchstone
