// SPDX-License-Identifier: LGPL-2.1-or-later
// The linear system of contact against central differences of the contact forces
// and of the conditions, for each pairing, enforcement and state of friction; with
// a linearisation that keeps normals and stencils constant the differences must be
// seen. With an argument the errors themselves are printed.

#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/row_terms.h>

#include "contact_support.h"
#include <array>
#include <map>
#include <set>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string blocks = R"(
set Bodies        = lower, upper
set Contact pairs = pair
subsection Body lower
  subsection Material
    set Young modulus = 1
  end
  subsection Geometry
    set Cells = 3, 2, 1
  end
end
subsection Body upper
  subsection Material
    set Young modulus = 1
  end
  subsection Geometry
    set Lower corner = 0.12, 0.1, 1
    set Upper corner = 0.88, 0.9, 2
    set Cells        = 2, 3, 1
  end
end
subsection Contact pair pair
  set Slave body        = upper
  set Slave boundaries  = bottom
  set Master body       = lower
  set Master boundaries = top
  set Contact geometry  = faceted
end
)";

  /** The slave boundary goes over an edge of the master: rows change their areas. */
  const std::vector<std::string> over_edge = {"Body upper/Geometry/Lower corner=0.42, 0.1, 1",
                                              "Body upper/Geometry/Upper corner=1.18, 0.9, 2"};

  const std::string obstacle = R"(
set Bodies        = lower, upper
set Obstacles     = rigid
set Contact pairs = pair
subsection Body lower
  subsection Material
    set Young modulus = 1
  end
  subsection Geometry
    set Upper corner = 1, 1, 0.1
    set Cells = 1, 1, 1
  end
end
subsection Body upper
  subsection Material
    set Young modulus = 1
  end
  subsection Geometry
    set Lower corner = 0.12, 0.1, 1
    set Upper corner = 0.88, 0.9, 2
    set Cells        = 2, 3, 1
  end
end
subsection Obstacle rigid
  set Shape  = sphere
  set Point  = 0.4, 0.45, -1
  set Radius = 2
end
subsection Contact pair pair
  set Slave body       = upper
  set Slave boundaries = bottom
  set Obstacle         = rigid
end
)";

  struct FrictionKind
  {
    std::string   name, behaviour, kind;
    ContactStatus status;
  };

  /** A limit that falls with the slip path and with the slip rate, and depends on the area. */
  class WeakeningLaw : public FrictionLaw
  {
  public:
    void
    declare(ParameterHandler &) override
    {
    }

    void
    check(const std::string &) const override
    {
    }

    FrictionLimit
    limit(const FrictionInput &input) const override
    {
      const double path = std::exp(-input.slip_length / 0.1), rate = 1. + input.slip_rate;
      const double mu = 0.2 + 0.2 * path / rate;
      return {mu * input.normal_force + 0.01 * input.area,
              mu,
              0.01,
              -2. * path / rate * input.normal_force,
              -0.2 * path / (rate * rate) * input.normal_force};
    }
  };

  const FrictionLawRegistry::Entry<WeakeningLaw> weakening_law("weakening", "for this test.");

  const std::vector<FrictionKind> frictions = {
    {"frictionless", "frictionless", "exact", ContactStatus::slip},
    {"exact stick", "coulomb", "exact", ContactStatus::stick},
    {"exact slip", "coulomb", "exact", ContactStatus::slip},
    {"regularised stick", "coulomb", "regularised", ContactStatus::stick},
    {"regularised slip", "coulomb", "regularised", ContactStatus::slip},
    {"tresca slip", "tresca", "exact", ContactStatus::slip},
    {"regularised tresca slip", "tresca", "regularised", ContactStatus::slip},
    {"weakening slip", "weakening", "exact", ContactStatus::slip},
    {"regularised weakening slip", "weakening", "regularised", ContactStatus::slip}};

  const std::vector<std::string> enforcements = {"lagrange multipliers",
                                                 "elimination",
                                                 "augmented lagrange",
                                                 "penalty"};

  constexpr double tolerance = 1e-7;

  double
  sum(const double x)
  {
    return Utilities::MPI::sum(x, MPI_COMM_WORLD);
  }

  /** Square sums of values and of their errors. */
  struct Error
  {
    double error = 0., size = 0.;

    void
    add(const double value, const double exact)
    {
      error += (value - exact) * (value - exact);
      size += exact * exact;
    }

    void
    add(const Touchstone::Vector &value, const Touchstone::Vector &exact)
    {
      for (const Index i : value.locally_owned_elements())
        add(value(i), exact(i));
    }

    /** Collective; -1 if there is nothing to compare. */
    double
    relative() const
    {
      const double e = sum(error), s = sum(size);
      return s > 0. ? std::sqrt(e / s) : e > 0. ? 1. : -1.;
    }
  };



  /** One pair in one state, and its linear system. */
  class Case
  {
  public:
    Case(const std::string  &text,
         const std::string  &pairing,
         const std::string  &enforcement_name,
         const FrictionKind &friction,
         const bool          beyond_edge)
      : friction(friction)
      , enforcement_name(enforcement_name)
      , made(text, overrides(pairing, enforcement_name, friction, beyond_edge))
      , contact(pair_inputs(made.scene, made.forest, made.solid), made.scene.contact, made.solid)
      , u(made.solid.owned, MPI_COMM_WORLD)
    {
      const bool   body   = made.master != nullptr;
      const double deeper = enforcement_name == "penalty" ? 0.07 : 0.;
      const auto   place  = [&](const Point<dim> &x, const unsigned int number, const bool end) {
        Tensor<1, dim> y = x + smooth(x, 2 * number + end);
        if (number == 1)
          {
            y[2] -= deeper + (body ? -0.01 : 0.05);
            if (end)
              y += Tensor<1, dim>({0.04, -0.03, 0.});
          }
        return y;
      };
      // Where the step begins: with forces, for the history.
      u = made.displacement([&](const Point<dim> &x, const unsigned int number) {
        return place(x, number, false) - x;
      });
      contact.update(u, 0.);
      change_states([&](const ContactRow &row, RowState &state) {
        if (row.has_partner && row.friction)
          {
            state.status = ContactStatus::stick;
            state.lambda = 0.1 * scale(row);
            state.force  = state.lambda * row.normal + tangential(row, 3, 0.1);
          }
      });
      contact.commit();

      // Where it is: turned as a whole, too, unless the obstacle stays behind.
      const Tensor<2, dim> rotation = body ? turn() : unit_symmetric_tensor<dim>();
      u = made.displacement([&](const Point<dim> &x, const unsigned int number) {
        return rotation * place(x, number, true) - x;
      });
      contact.update(u, step);
      for (const ContactRow &row : contact.rows())
        if (row.has_partner)
          {
            ++n_rows;
            n_penetrate += row.gap < 0.;
          }
      change_states([&](const ContactRow &row, RowState &state) {
        if (row.has_partner)
          {
            state.status = friction.status;
            state.lambda = (0.1 + 0.03 * scatter(Point<dim>(row.position), 5)) * scale(row);
            begin_with(row, state, tangential(row, 4, 0.02));
          }
      });
      evaluate();
      // Exact slip is linearised about a force against the slip.
      if (exact_slip())
        change_states([&](const ContactRow &row, RowState &state) {
          if (state.active())
            {
              const Tensor<1, dim> &slip = row.friction->kinematics.slip;
              begin_with(row, state, -state.friction->limit / slip.norm() * slip);
            }
        });
      evaluate();
    }

    /** Length of the step in time. */
    static constexpr double step = 0.1;

    const FrictionKind friction;
    const std::string  enforcement_name;
    PairOfScene        made;
    Contact            contact;
    Touchstone::Vector u;
    unsigned int       n_rows = 0, n_penetrate = 0;
    /** Normal and tangential force that the springs of each row begin with. */
    std::map<std::size_t, std::pair<double, Tensor<1, dim>>> starts;

    template <class Change>
    void
    change_states(const Change &change)
    {
      RowArray<RowState> states = contact.enforcement().states();
      for (const ContactRow &row : contact.rows())
        change(row, states[row]);
      contact.enforcement().set_states(states);
    }

    /** Let the row begin with a tangential force, and augmented springs with one that makes its
     * normal force. */
    void
    begin_with(const ContactRow &row, RowState &state, const Tensor<1, dim> &tangential)
    {
      const double augmented = enforcement_name == "augmented lagrange"
                                 ? state.lambda + 20. * row.stiffness * row.gap
                                 : 0.;
      contact.enforcement().adopt(
        row, state.status, augmented * row.normal + (row.friction ? tangential : Tensor<1, dim>()));
      if (row.friction)
        state.friction->base = tangential;
      starts[row.index] = {augmented, tangential};
    }

    /** Forces are unknowns, or follow from the balance. */
    bool
    with_multipliers() const
    {
      return enforcement_name == "lagrange multipliers" || enforcement_name == "elimination";
    }

    /** Contact forces of the rows as the enforcement makes them. */
    void
    evaluate()
    {
      // With friction the normal force of a penalty is that of the linear solve: what this
      // gives where the system is linear.
      if (enforcement_name == "penalty")
        change_states([&](const ContactRow &row, RowState &state) {
          if (row.friction && state.active())
            state.lambda = -100. * made.scene.contact.penalty_factor * row.stiffness * row.gap;
        });
      // So are the forces of augmented Lagrange, of stick too.
      if (enforcement_name == "augmented lagrange")
        change_states([&](const ContactRow &row, RowState &state) {
          if (row.friction && state.active())
            {
              const auto &[normal, tangential] = starts.at(row.index);
              const double epsilon             = 20. * row.stiffness;
              state.lambda                     = normal - epsilon * row.gap;
              if (state.fully_constrained())
                state.friction->base = tangential - epsilon * row.friction->kinematics.slip;
            }
        });
      contact.enforcement().recover(contact,
                                    made.displacement([](const Point<dim> &, unsigned int) {
                                      return Tensor<1, dim>();
                                    }),
                                    ConstraintGraph());
    }

    /** Contact forces at the nodes; exact slip against the present slip. */
    Touchstone::Vector
    forces()
    {
      evaluate();
      if (exact_slip())
        change_states([&](const ContactRow &row, RowState &state) {
          if (state.active())
            {
              const Tensor<1, dim> &slip = row.friction->kinematics.slip;
              state.force = state.lambda * row.normal - state.friction->limit / slip.norm() * slip;
            }
        });
      Touchstone::Vector result(made.solid.owned, MPI_COMM_WORLD);
      contact.add_forces(result);
      return result;
    }

    /** As StepProblem does. */
    void
    linearize(const bool consistent)
    {
      system = std::make_unique<LinearSystem>();
      system->rhs.reinit(made.solid.owned, MPI_COMM_WORLD);
      system->first_extra = system->rhs.size();
      graph.clear();
      if (consistent)
        contact.differentiate();
      contact.enforcement().enforce(contact, graph, *system);
      contact.enforcement().add_friction(contact, *system);
    }

    /** Conditions of the active rows of this rank as the rows make them, in the order in which
     * they are offered: those along normals first. */
    template <class Visit>
    void
    for_each_condition(const Visit &visit)
    {
      unsigned int k = 0;
      for (const bool stick : {false, true})
        for (const ContactRow &row : contact.rows())
          {
            const auto conditions = row_conditions(row, contact.state(row), false);
            for (unsigned int i = 0; i < conditions.size(); ++i)
              if ((i > 0) == stick)
                visit(k++, row, i, conditions[i]);
          }
    }

    /** A displacement at all nodes that the system refers to. */
    Touchstone::Vector
    ghosted(const Touchstone::Vector &v)
    {
      std::set<Index> columns;
      for (const RankOneTerm &term : system->terms)
        for (const auto &[column, value] : term.right)
          if (column < v.size())
            columns.insert(column);
      for_each_condition(
        [&](unsigned int, const ContactRow &, unsigned int, const Condition &condition) {
          for (const auto &[node, coefficients] : condition.motion_form())
            for (unsigned int d = 0; d < dim; ++d)
              columns.insert(dim * node + d);
        });
      IndexSet needed = made.solid.relevant;
      needed.add_indices(columns.begin(), columns.end());
      needed.compress();
      Touchstone::Vector result(made.solid.owned, needed, MPI_COMM_WORLD);
      result = v;
      return result;
    }

    /** Change of the contact forces with displacements (with ghosts) and with
     * extra unknowns of this rank. */
    Touchstone::Vector
    change(const Touchstone::Vector &v, const std::vector<double> &extra)
    {
      Touchstone::Vector  result(made.solid.owned, MPI_COMM_WORLD);
      std::vector<Index>  unknowns;
      std::vector<double> values;
      for (const RankOneTerm &term : system->terms)
        {
          double stretch = 0.;
          for (const auto &[column, value] : term.right)
            stretch +=
              value * (column < result.size() ? v(column) : extra[column - system->first_extra]);
          for (const auto &[row, value] : term.left)
            if (row < result.size())
              {
                unknowns.push_back(row);
                values.push_back(-value * stretch);
              }
        }
      // What is eliminated still acts through its force.
      if (enforcement_name == "elimination")
        {
          const auto &conditions = graph.accepted();
          for (unsigned int k = 0; k < conditions.size(); ++k)
            {
              const Condition     &c         = conditions[k];
              const Tensor<1, dim> direction = c.force();
              for (unsigned int d = 0; d < dim; ++d)
                {
                  unknowns.push_back(dim * c.node + d);
                  values.push_back(-extra[k] * direction[d]);
                  for (const StencilEntry &entry : c.stencil)
                    {
                      unknowns.push_back(dim * entry.node + d);
                      values.push_back(extra[k] * entry.weight * direction[d]);
                    }
                }
            }
        }
      result.add(unknowns, values);
      result.compress(VectorOperation::add);
      return result;
    }

    /** The extra unknowns for given forces of the conditions. */
    double
    extra(const ContactRow &row, const double force) const
    {
      return enforcement_name == "elimination" ? -force : -force / row.stiffness;
    }

    std::unique_ptr<LinearSystem> system;
    ConstraintGraph               graph;

  private:
    static std::vector<std::string>
    overrides(const std::string  &pairing,
              const std::string  &enforcement,
              const FrictionKind &friction,
              const bool          beyond_edge)
    {
      std::vector<std::string> result = {"Contact/Enforcement=" + enforcement,
                                         "Contact pair pair/Behaviour=" + friction.behaviour};
      if (beyond_edge)
        result.insert(result.end(), over_edge.begin(), over_edge.end());
      if (pairing != "obstacle")
        result.push_back("Contact pair pair/Pairing=" + pairing);
      // Soft enough that the cone is not too large for slip.
      if (enforcement == "penalty")
        result.push_back("Contact/Penalty factor=0.03");
      if (friction.behaviour == "coulomb")
        result.push_back("Contact pair pair/Friction/Coefficient=0.3");
      if (friction.behaviour == "tresca")
        result.push_back("Contact pair pair/Friction/Shear strength=0.02");
      if (friction.behaviour != "frictionless")
        result.push_back("Contact/Friction=" + friction.kind);
      return result;
    }

    bool
    exact_slip() const
    {
      return friction.behaviour != "frictionless" && friction.kind == "exact" &&
             friction.status == ContactStatus::slip && enforcement_name != "penalty";
    }

    /** A force, for the scale. */
    static double
    scale(const ContactRow &row)
    {
      return row.stiffness * row.size;
    }

    static Tensor<1, dim>
    tangential(const ContactRow &row, const unsigned int seed, const double size)
    {
      const Tensor<1, dim> t = scattered(Point<dim>(row.position), seed);
      return size * scale(row) * (t - (t * row.normal) * row.normal);
    }

    static Tensor<1, dim>
    smooth(const Point<dim> &x, const unsigned int seed)
    {
      Tensor<1, dim> w;
      for (unsigned int d = 0; d < dim; ++d)
        w[d] = 0.02 * std::sin(4.3 * x[0] + 1.7 * seed + 2.1 * d) *
                 std::sin(3.7 * x[1] - 1.1 * seed + 0.9 * d) +
               0.01 * std::cos(3.1 * x[2] + x[0] - 2. * x[1] + seed - d);
      return w;
    }

    static Tensor<2, dim>
    turn()
    {
      const double   a = 0.5, b = 0.3;
      Tensor<2, dim> first, second;
      first[0][0] = first[2][2] = std::cos(a);
      first[0][2]               = std::sin(a);
      first[2][0]               = -std::sin(a);
      first[1][1] = second[2][2] = 1.;
      second[0][0] = second[1][1] = std::cos(b);
      second[0][1]                = -std::sin(b);
      second[1][0]                = std::sin(b);
      return second * first;
    }
  };



  /** What conditions are compared with, by the index of rows. */
  struct GapsAndSlips
  {
    explicit GapsAndSlips(const Contact &contact)
    {
      for (const ContactRow &row : contact.rows())
        {
          gaps.push_back(row.gap);
          slips.push_back(row.friction ? row.friction->kinematics.slip : Tensor<1, dim>());
        }
    }

    std::vector<double>         gaps;
    std::vector<Tensor<1, dim>> slips;
  };



  /** Relative errors: of the conditions along the normal and across, the rows of
   * the multipliers, the force itself, its change, the force per multiplier. */
  constexpr unsigned int n_errors = 6;
  const char *const      names[n_errors] =
    {"gap", "slip", "multiplier rows", "force", "stiffness", "column"};

  /** Step of the differences. */
  constexpr double h = 1e-6;

  using Errors = std::array<Error, n_errors>;

  /** All nodes move: what conditions, rows of multipliers and forces make of it.
   * @param base The state of the rows in which the system was made. */
  void
  add_errors_of_motion(Case                     &c,
                       const bool                consistent,
                       const RowArray<RowState> &base,
                       const std::size_t         n_conditions,
                       const unsigned int        seed,
                       Errors                   &errors)
  {
    const Touchstone::Vector direction =
      c.made.displacement([&](const Point<dim> &x, unsigned int) { return scattered(x, seed); });
    const Touchstone::Vector v = c.ghosted(direction);
    Touchstone::Vector       plus(c.u), minus(c.u);
    plus.add(h, direction);
    minus.add(-h, direction);
    c.contact.update(plus, Case::step);
    Touchstone::Vector difference = c.forces();
    const GapsAndSlips rows_plus(c.contact);
    c.contact.enforcement().set_states(base);
    c.contact.update(minus, Case::step);
    difference -= c.forces();
    difference /= 2. * h;
    const GapsAndSlips rows_minus(c.contact);
    c.contact.update(c.u, Case::step);
    c.contact.enforcement().set_states(base);
    if (consistent)
      c.contact.differentiate();
    errors[4].add(c.change(v, std::vector<double>(n_conditions, 0.)), difference);

    std::vector<double> rows_of_system(c.system->n_extra, 0.);
    for (const RankOneTerm &term : c.system->terms)
      for (const auto &[row, left] : term.left)
        if (row >= v.size())
          for (const auto &[column, right] : term.right)
            rows_of_system[row - c.system->first_extra] += left * right * v(column);
    c.for_each_condition([&](const unsigned int k,
                             const ContactRow  &row,
                             const unsigned int i,
                             const Condition   &condition) {
      const std::size_t r     = row.index;
      double            value = 0.;
      for (const auto &[node, coefficients] : condition.motion_form())
        for (unsigned int d = 0; d < dim; ++d)
          value += coefficients[d] * v(dim * node + d);
      const double exact =
        i == 0 ? (rows_plus.gaps[r] - rows_minus.gaps[r]) / (2. * h)
               : condition.direction * (rows_plus.slips[r] - rows_minus.slips[r]) / (2. * h);
      errors[i > 0].add(value, exact);
      if (c.system->n_extra > 0)
        errors[2].add(rows_of_system[k] / row.stiffness, exact);
    });
  }



  /** Forces of the conditions change, nothing moves. */
  void
  add_errors_of_forces(Case                     &c,
                       const RowArray<RowState> &base,
                       const unsigned int        seed,
                       Errors                   &errors)
  {
    std::vector<double> force_changes, extra_changes;
    c.for_each_condition(
      [&](unsigned int, const ContactRow &row, const unsigned int i, const Condition &) {
        force_changes.push_back(row.stiffness * scatter(Point<dim>(row.position), seed + i));
        extra_changes.push_back(c.extra(row, force_changes.back()));
      });
    const auto forces_at = [&](const double step) {
      RowArray<RowState> states = base;
      c.for_each_condition([&](const unsigned int k,
                               const ContactRow  &row,
                               const unsigned int i,
                               const Condition   &condition) {
        if (i == 0)
          states[row].lambda += step * force_changes[k];
        else
          states[row].friction->base += step * force_changes[k] * condition.direction;
      });
      c.contact.enforcement().set_states(states);
      const Touchstone::Vector result = c.forces();
      c.contact.enforcement().set_states(base);
      return result;
    };
    Touchstone::Vector difference = forces_at(h);
    difference -= forces_at(-h);
    difference /= 2. * h;
    const Touchstone::Vector no_motion(c.made.solid.owned, MPI_COMM_WORLD);
    errors[5].add(c.change(c.ghosted(no_motion), extra_changes), difference);
  }



  Errors
  errors_of(Case &c, const bool consistent)
  {
    // Twice, so that exact slip refers to a last iteration.
    c.linearize(consistent);
    c.evaluate();
    c.linearize(consistent);
    Errors errors;

    // The force itself: what the system adds at no increment.
    const RowArray<RowState> base = c.contact.enforcement().states();
    std::vector<double>      extra;
    c.for_each_condition(
      [&](unsigned int, const ContactRow &row, const unsigned int i, const Condition &condition) {
        const RowState &state = c.contact.state(row);
        extra.push_back(
          c.extra(row, i == 0 ? state.lambda : state.friction->base * condition.direction));
      });
    const Touchstone::Vector no_motion(c.made.solid.owned, MPI_COMM_WORLD);
    {
      Touchstone::Vector force = c.change(c.ghosted(no_motion), extra);
      force += c.system->rhs;
      errors[3].add(force, c.forces());
      c.contact.enforcement().set_states(base);
    }

    for (const unsigned int seed : {1, 2})
      {
        add_errors_of_motion(c, consistent, base, extra.size(), seed, errors);
        if (c.with_multipliers())
          add_errors_of_forces(c, base, seed, errors);
      }
    return errors;
  }



  /** Elimination leaves to the slave node what it takes from neighbours. */
  bool
  lagged_rightly(Case &c)
  {
    bool good = true;
    c.for_each_condition(
      [&](const unsigned int k, const ContactRow &, unsigned int, const Condition &condition) {
        Tensor<1, dim> own, used;
        for (const auto &[node, coefficients] : condition.motion_form())
          own += coefficients;
        for (const auto &[node, coefficients] : c.graph.accepted()[k].motion_form())
          used += coefficients;
        good = good && (own - used).norm() < 1e-12;
      });
    return good;
  }



  void
  check(const std::string  &text,
        const std::string  &pairing,
        const std::string  &enforcement,
        const FrictionKind &friction,
        const bool          with_numbers,
        const bool          beyond_edge = false)
  {
    Case       c(text, pairing, enforcement, friction, beyond_edge);
    const auto frozen     = errors_of(c, false);
    const auto consistent = errors_of(c, true);

    std::ostringstream out;
    double             seen    = 0.;
    unsigned int       refused = 0, inside = 0;
    for (const ContactRow &row : c.contact.rows())
      {
        const RowState &state = c.contact.state(row);
        refused += state.refused;
        inside +=
          (row.friction && state.status == ContactStatus::slip && state.friction->excess <= 0.);
      }
    const unsigned int count = Utilities::MPI::sum(c.n_rows, MPI_COMM_WORLD);
    out << pairing << ", " << enforcement << ", " << friction.name
        << (beyond_edge ? ", over an edge" : "") << " (" << count << " rows, "
        << Utilities::MPI::sum(c.n_penetrate, MPI_COMM_WORLD) << " penetrate):";
    for (unsigned int i = 0; i < n_errors; ++i)
      {
        const double error = consistent[i].relative(), before = frozen[i].relative();
        seen = std::max(seen, before);
        if (error < 0.)
          continue;
        out << ' ' << names[i] << ' ';
        if (with_numbers)
          out << error << " (" << before << ")";
        else if (error <= tolerance)
          out << "ok";
        else
          out << error << " FAILED";
        out << ',';
      }
    out << (seen > 1000. * tolerance ? " seen if frozen" : " not seen if frozen FAILED");
    if (sum(inside) > 0.)
      out << ", slip within the cone: another state is needed FAILED";
    if (sum(refused) > 0.)
      out << ", conditions refused FAILED";
    if (sum(enforcement == "elimination" && !lagged_rightly(c)) > 0.)
      out << ", lagged terms lost FAILED";
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << out.str() << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string pairing : {"pointwise", "averaged", "obstacle"})
    for (const std::string &enforcement : enforcements)
      for (const FrictionKind &friction : frictions)
        // Penalty knows no exact friction.
        if (enforcement != "penalty" || friction.kind == "regularised" ||
            friction.behaviour == "frictionless")
          check(
            pairing == "obstacle" ? obstacle : blocks, pairing, enforcement, friction, argc > 1);
  // Cones that depend on the area.
  for (const FrictionKind &friction : frictions)
    if (friction.behaviour == "tresca" || friction.behaviour == "weakening")
      check(blocks, "averaged", "lagrange multipliers", friction, argc > 1, true);
  return 0;
}
