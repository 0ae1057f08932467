// SPDX-License-Identifier: LGPL-2.1-or-later
// Integration in time: order, numerical damping and decay of a spring with a mass, the
// energy of bodies that meet, stay together and part, and the stiffness of a step.

#include <touchstone/drive/dynamics.h>

#include <deal.II/numerics/vector_tools_interpolate.h>

#include "contact_support.h"
#include "drive_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** One cell with half of its mass on the face that moves: E A / L = 2, m = 2. */
  const std::string spring = R"(
set Bodies = spring
subsection Body spring
  set Symmetry               = left, front, back, bottom, top
  set Initial displacement x = 0.01 * x
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, 0
    set Upper corner = 1, 1, 1
    set Cells        = 1, 1, 1
  end
  subsection Material
    set Young modulus = 2
    set Poisson ratio = 0
    set Density       = 4
  end
end
subsection Time integration
  set Mass = lumped
end
subsection Newton
  set Residual tolerance = 1e-12
end
)";

  bool
  first_rank()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }



  /** Displacements of the spring's end, divided by the first, at n steps and time 0. */
  std::vector<double>
  swing(const double h, const unsigned int n, const std::vector<std::string> &overrides)
  {
    std::vector<std::string> all = overrides;
    all.push_back("Load stepping/End time=" + std::to_string(n * h));
    all.push_back("Load stepping/Steps=" + std::to_string(n));
    Run                 run(spring, all, MPI_COMM_WORLD);
    std::vector<double> result(1, 1.);
    for (unsigned int k = 1; k <= n; ++k)
      {
        run.solve(run.scene.newton, k * h);
        run.problem.commit();
        double largest = 0.;
        for (const double u : run.problem.state().displacement)
          if (std::abs(u) > std::abs(largest))
            largest = u;
        const double most  = Utilities::MPI::max(largest, MPI_COMM_WORLD),
                     least = Utilities::MPI::min(largest, MPI_COMM_WORLD);
        result.push_back((most > -least ? most : least) / 0.01);
      }
    return result;
  }



  const std::vector<std::vector<std::string>> schemes = {
    {"Time integration/Scheme=newmark"},
    {"Time integration/Scheme=hht", "Time integration/HHT alpha=0.2"},
    {"Time integration/Scheme=generalized_alpha", "Time integration/Spectral radius=0.5"},
    {"Time integration/Scheme=generalized_alpha", "Time integration/Spectral radius=1"},
    {"Time integration/Scheme=contact_stabilized"}};

  std::string
  name(const std::vector<std::string> &overrides)
  {
    std::string result;
    for (const std::string &text : overrides)
      result += (result.empty() ? "" : " ") + text.substr(text.find('=') + 1);
    return result;
  }



  void
  orders()
  {
    for (std::vector<std::string> overrides : schemes)
      for (const bool damped : {false, true})
        {
          double rate = 0., shift = 0.;
          if (damped)
            {
              overrides.push_back("Body spring/Material/Rayleigh mass=0.2");
              overrides.push_back("Body spring/Material/Rayleigh stiffness=0.1");
              // omega = 1: the decay is (a + b omega^2) / 2.
              rate = 0.15;
            }
          const double omega = std::sqrt(1. - rate * rate);
          shift              = rate / omega;
          double errors[2];
          for (const unsigned int k : {0, 1})
            {
              const unsigned int n = k == 0 ? 20 : 40;
              const double       t = 2., u = swing(t / n, n, overrides).back();
              errors[k] =
                u - std::exp(-rate * t) * (std::cos(omega * t) + shift * std::sin(omega * t));
            }
          const double order = std::log2(errors[0] / errors[1]);
          if (first_rank())
            std::cout << "error of " << name(overrides) << (damped ? " (damped)" : "")
                      << " falls with order " << std::round(10. * order) / 10.
                      << (std::abs(errors[1]) < 2e-3 ? "" : ", TOO LARGE") << std::endl;
        }
  }



  /** The polynomial z^3 + c_2 z^2 + c_1 z + c_0 of the recurrence that displacements
   * obey: its roots are what a step makes of a motion. */
  Tensor<1, 3>
  characteristic_polynomial(const double h, const std::vector<std::string> &overrides)
  {
    const std::vector<double> u = swing(h, 6, overrides);
    Tensor<2, 3>              matrix;
    Tensor<1, 3>              rhs;
    for (unsigned int i = 0; i < 3; ++i)
      {
        for (unsigned int j = 0; j < 3; ++j)
          matrix[i][j] = u[i + j + 1];
        rhs[i] = -u[i + 4];
      }
    return invert(matrix) * rhs;
  }



  void
  numerical_damping()
  {
    // Chung and Hulbert: without damping by gamma, infinitely fast motions have the
    // threefold root -rho.
    for (const double rho : {0.3, 0.8})
      {
        const Tensor<1, 3> c = characteristic_polynomial(
          1e4, {schemes[2][0], "Time integration/Spectral radius=" + std::to_string(rho)});
        const Tensor<1, 3> expected({rho * rho * rho, 3. * rho * rho, 3. * rho});
        if (first_rank())
          std::cout << "spectral radius " << rho << ": "
                    << small((c - expected).norm() / expected.norm(), 1e-5) << std::endl;
      }
    // Of hht: the double root (alpha - 1) / (alpha + 1) and alpha / (alpha - 1).
    {
      const double       alpha = 0.2, p = (1. - alpha) / (1. + alpha), q = alpha / (1. - alpha);
      const Tensor<1, 3> c = characteristic_polynomial(1e4, schemes[1]);
      const Tensor<1, 3> expected({p * p * q, p * p + 2. * p * q, 2. * p + q});
      if (first_rank())
        std::cout << "hht: " << small((c - expected).norm() / expected.norm(), 1e-5) << std::endl;
    }
    // Newmark: slow motions have the damping ratio (gamma - 1/2) omega h / 2.
    const double              gamma = 0.6, h = 0.05;
    const std::vector<double> u =
      swing(h,
            std::lround(2. * numbers::PI / h) + 20,
            {"Time integration/Scheme=newmark", "Time integration/Newmark gamma=0.6"});
    std::size_t top = u.size() - 40;
    for (std::size_t k = top; k + 1 < u.size(); ++k)
      if (u[k] > u[top])
        top = k;
    // The crest of the parabola through three points.
    const double largest =
      u[top] - std::pow(u[top + 1] - u[top - 1], 2) / 8. / (u[top + 1] - 2. * u[top] + u[top - 1]);
    const double decay = -std::log(largest), expected = numbers::PI * (gamma - 0.5) * h;
    if (first_rank())
      std::cout << "newmark, gamma 0.6: decay over a period is that of the damping ratio: "
                << small(decay / expected - 1., 0.01) << std::endl;
  }



  /** A block that falls askew on a plane: the gaps are linear in the displacement. */
  const std::string fall = R"(
set Bodies        = block
set Obstacles     = ground
set Contact pairs = contact
subsection Body block
  set Initial velocity x = 0.1
  set Initial velocity z = -1 + 0.2 * x
  subsection Geometry
    set Type         = box
    set Lower corner = -0.6, -0.6, 0.012
    set Upper corner = 0.6, 0.6, 1.012
    set Cells        = 3, 3, 4
  end
  subsection Material
    set Young modulus = 500
    set Poisson ratio = 0.3
    set Density       = 1
  end
end
subsection Obstacle ground
  set Shape     = plane
  set Point     = 0, 0, 0
  set Direction = 0, 0, 1
end
subsection Contact pair contact
  set Slave body       = block
  set Slave boundaries = bottom
  set Obstacle         = ground
end
subsection Load stepping
  set End time = 0.3
  set Steps    = 60
end
subsection Newton
  set Residual tolerance = 1e-12
end
)";

  void
  energy(const std::vector<std::string> &overrides)
  {
    Run          run(fall, overrides, MPI_COMM_WORLD);
    const auto  &integration = run.problem.state().time_integration;
    const double h           = run.scene.load_stepping.end_time / run.scene.load_stepping.steps;
    double       error = 0., gain = 0., kept = 0., loss = 0.;
    unsigned int closing = 0, opening = 0, staying = 0, before = 0;
    for (unsigned int step = 1; step <= run.scene.load_stepping.steps; ++step)
      {
        const double old = integration.committed_energies().contact,
                     had = integration.committed_energies().present();
        run.solve(run.scene.newton, step * h);
        run.problem.commit();
        const Energies &now = integration.committed_energies();
        error               = std::max(error, std::abs(now.balance_error()) / now.largest);
        const double taken  = (now.contact - old) / now.largest;
        gain                = std::max({gain, -taken, (now.present() - had) / now.largest});
        loss += taken;
        const unsigned int active =
          pair_results(run.problem.state().contact, run.problem.state().ghosted_displacement())[0]
            .active;
        closing += active > before;
        opening += active < before;
        // The same nodes all the time: nothing is lost.
        if (active == before && active == 16)
          {
            ++staying;
            kept = std::max(kept, std::abs(taken));
          }
        before = active;
      }
    if (first_rank())
      {
        std::cout << name(overrides) << ": balance error " << small(error, 1e-12)
                  << ", gain in a step " << small(gain, 1e-12) << ", loss in persistent contact "
                  << small(kept, 1e-12) << ", closes, " << (staying > 0 ? "stays, " : "")
                  << "opens: " << (closing > 0 && opening > 0 && before == 0 ? "yes" : "NO")
                  << ", lost " << (loss > 1e-3 && loss < 0.3 ? "some" : "WRONG") << std::endl;
        if (std::getenv("DYNAMICS_VERBOSE"))
          std::cout << "   " << error << ' ' << gain << ' ' << kept << ' ' << loss << ' ' << closing
                    << ' ' << staying << ' ' << opening << ' ' << before << std::endl;
      }
  }



  const char *const ball_under_pressure = R"(
set Bodies = ball
subsection Body ball
  set Boundary conditions = surface
  set Initial velocity x  = 0.3 * y
  subsection Geometry
    set Type   = ball
    set Radius = 1
  end
  subsection Material
    set Young modulus      = 200
    set Poisson ratio      = 0.3
    set Density            = 2
    set Rayleigh mass      = 0.7
    set Rayleigh stiffness = 0.02
  end
  subsection Boundary surface
    set Pressure = 3 * t
  end
end
)";



  /** Balance of a step and its stiffness, for a ball under pressure. */
  void
  derivative(const std::vector<std::string> &overrides)
  {
    const Scene  scene(ball_under_pressure, "scene.prm", overrides);
    const Forest forest(scene.forest_input(), "", MPI_COMM_WORLD);
    Solid        solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD);
    solid.assemble();
    const BoundaryConditions conditions(forest, solid);
    Touchstone::Vector       committed(solid.owned, solid.communicator), position(committed);
    const auto               integration =
      TimeIntegration::make(scene.time_integration,
                            scene.load_stepping.end_time / scene.load_stepping.steps,
                            solid,
                            {},
                            committed);
    VectorTools::get_position_vector(solid.mapping, solid.dof_handler, position);
    const auto scatter = [&](const double size, const unsigned int seed) {
      Touchstone::Vector result(committed);
      for (std::size_t k = 0; k < position.locally_owned_size(); k += dim)
        {
          const Point<dim> x(position.begin()[k], position.begin()[k + 1], position.begin()[k + 2]);
          for (unsigned int d = 0; d < dim; ++d)
            result.begin()[k + d] = size * scattered(x, seed)[d];
        }
      return result;
    };
    Touchstone::Vector external(committed), internal(committed);
    const auto         balance = [&](const Touchstone::Vector &u) {
      Touchstone::Vector sum(committed);
      conditions.external_force(1., u, external);
      solid.internal_force(u, internal);
      integration->balance(u, external, internal, sum);
      return sum;
    };
    conditions.external_force(0., committed, external);
    solid.internal_force(committed, internal);
    const auto nothing = [](Touchstone::Vector &) {};
    integration->start(external, internal, {nothing, nothing, nothing});
    Touchstone::Vector u(committed);
    integration->begin_step(0.05, u);
    u += scatter(0.03, 1);
    const Touchstone::Vector w = scatter(1., 2);
    solid.assemble(u);
    Touchstone::Vector product(committed);
    integration->stiffness().vmult(product, w);
    std::vector<RankOneTerm> terms;
    if (!conditions.follower_pressure().empty())
      conditions.follower_pressure().add_stiffness(1., u, false, terms);
    const Touchstone::Vector ghosted = solid.ghosted(w);
    for (const RankOneTerm &term : terms)
      {
        double change = 0.;
        for (const auto &[column, value] : term.right)
          change += value * ghosted(column);
        for (const auto &[row, value] : term.left)
          product(row) += integration->weight() * value * change;
      }
    product.compress(VectorOperation::add);
    const double       step = 1e-5;
    Touchstone::Vector moved(u);
    moved.add(step, w);
    Touchstone::Vector by_differences = balance(moved);
    moved.add(-2. * step, w);
    by_differences -= balance(moved);
    by_differences /= -2. * step;
    by_differences -= product;
    const double error = by_differences.l2_norm() / product.l2_norm();
    if (first_rank())
      std::cout << "stiffness of " << name(overrides) << ": " << small(error, 1e-7) << std::endl;
    if (std::getenv("DYNAMICS_VERBOSE"))
      std::cout << "   " << error << std::endl;
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  orders();
  numerical_damping();
  const std::string conserving = "Time integration/Scheme=generalized_alpha";
  energy({conserving, "Time integration/Spectral radius=1"});
  energy({conserving,
          "Time integration/Spectral radius=1",
          "Time integration/Mass=lumped",
          "Contact/Enforcement=lagrange multipliers"});
  energy({conserving,
          "Time integration/Spectral radius=1",
          "Time integration/Mass=dispersion corrected"});
  for (const std::string mass : {"consistent", "lumped"})
    energy({conserving,
            "Time integration/Spectral radius=1",
            "Time integration/Impact=plastic",
            "Time integration/Mass=" + mass});
  energy({"Time integration/Scheme=contact_stabilized"});
  energy({"Time integration/Scheme=contact_stabilized", "Time integration/Mass=lumped"});
  for (const std::string law : {"linear elastic", "neo-Hookean"})
    for (const std::string mass : {"consistent", "lumped"})
      derivative({"Time integration/Scheme=generalized_alpha",
                  "Time integration/Mass=" + mass,
                  "Body ball/Material/Law=" + law});
  return 0;
}
