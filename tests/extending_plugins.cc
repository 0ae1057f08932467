// SPDX-License-Identifier: LGPL-2.1-or-later
// Samples of contrib/skeletons, each one file that scenes select by name or that adds to the
// output of every run: an obstacle's shape, material laws, VTU fields, a column of the
// statistics, and a friction law that depends on slip, slip rate and time.

#include "../contrib/skeletons/contact_field.cc"
#include "../contrib/skeletons/maxwell.cc"
#include "../contrib/skeletons/mooney_rivlin.cc"
#include "../contrib/skeletons/obstacle_shape.cc"
#include "../contrib/skeletons/step_quantity.cc"
#include "../contrib/skeletons/volume_field.cc"
#include "../contrib/skeletons/weakening.cc"
#include "extending_support.h"
#include <filesystem>
#include <fstream>

using namespace Touchstone;
using dealii::Tensor;

namespace
{
  /** The only body: a box from the origin to the corner @p size. */
  std::string
  box(const std::string &size,
      const std::string &keys,
      const std::string &material,
      const std::string &cells = "3, 3, 2")
  {
    return "subsection Body block\n" + keys +
           "\nsubsection Geometry\nset Type = box\nset Upper corner = " + size +
           "\nset Cells = " + cells + "\nend\nsubsection Material\n" + material + "\nend\nend\n";
  }

  RunSummary
  run_on(const std::string                                &text,
         const std::string                                &name,
         const std::vector<std::string>                   &overrides = {},
         const bool                                        resume    = false,
         const std::function<void(const ConvergedStep &)> &observer  = {})
  {
    std::vector<std::string> all = {"Output/Directory=" + name};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const Scene scene(text, "scene.prm", all);
    Simulation  simulation(scene, SOURCE_DIR, nullptr, MPI_COMM_WORLD, resume);
    if (observer)
      simulation.after_step(observer);
    return simulation.run();
  }



  /** The projection's gradient against central differences. */
  double
  gradient_error(const AnalyticSurface &surface)
  {
    double worst = 0.;
    for (const dealii::Point<3> &x : {dealii::Point<3>(1.1, 0.2, 0.3),
                                      dealii::Point<3>(-0.3, 0.6, -0.2),
                                      dealii::Point<3>(0.8, -1.2, 0.1)})
      {
        const Tensor<2, 3> gradient = surface.projection_gradient(x);
        for (unsigned int d = 0; d < 3; ++d)
          {
            Tensor<1, 3> step;
            step[d] = 1e-6;
            const Tensor<1, 3> change =
              (surface.project(x + step) - surface.project(x - step)) / 2e-6;
            for (unsigned int c = 0; c < 3; ++c)
              worst = std::max(worst, std::abs(change[c] - gradient[c][d]));
          }
      }
    return worst;
  }

  void
  test_obstacle()
  {
    say("obstacle");
    say("  ", bound("gradient of the projection: error", gradient_error(*Torus().surface()), 1e-8));
    const std::string text =
      "set Bodies = block\nset Obstacles = ring\nset Contact pairs = sole\n" +
      box("1.5, 1.5, 1",
          "set Symmetry = left, front\nset Boundary conditions = top\nsubsection Boundary top\n"
          "set Pressure = 1\nend",
          "set Young modulus = 100",
          "12, 12, 3") +
      "subsection Obstacle ring\nset Shape = my torus\nset Centre = 0, 0, -0.25\nend\n"
      "subsection Contact pair sole\nset Slave body = block\nset Slave boundaries = bottom\n"
      "set Obstacle = ring\nend\n";
    const RunSummary run = run_on(text, "torus", {"Output/VTU interval=0"});
    say("  ",
        run.converged ? "converged" : "not converged",
        bound(", error of the force", std::abs(run.contact.at("sole").force[2] / 2.25 - 1.), 1e-8));
    try
      {
        run_on(text, "torus", {"Obstacle ring/Tube radius=2"});
      }
    catch (const InputError &error)
      {
        say("  ", error.what());
      }
    try
      {
        run_on(text, "torus", {"Obstacle ring/Shape=my thorus"});
      }
    catch (const InputError &error)
      {
        say("  ", error.what());
      }
  }



  /** The neo-Hookean law by its energy alone. */
  class NeoHookeanEnergy : public EnergyLaw<NeoHookeanEnergy>
  {
  public:
    explicit NeoHookeanEnergy(const MaterialParameters &material)
      : mu(material.shear_modulus())
      , kappa(material.bulk_modulus())
    {
    }

    template <class Number>
    Number
    density(const SymmetricMatrix<Number> &C) const
    {
      using std::log;
      using std::pow;
      const Number square = determinant(C);
      return 0.5 * mu * (pow(square, -1. / 3.) * trace(C) - 3.) +
             0.25 * kappa * (square - 1. - log(square));
    }

  private:
    const double mu, kappa;
  };

  void
  test_automatic_differentiation()
  {
    say("automatic differentiation");
    MaterialParameters material;
    material.young_modulus      = 2.;
    material.poisson_ratio      = 0.4;
    const auto             hand = HyperelasticRegistry::make("neo-Hookean", material);
    const NeoHookeanEnergy law(material);
    Tensor<2, dim>         F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = (i == j ? 1.3 - 0.2 * i : 0.) + 0.15 * std::sin(1. + 3. * i + 7. * j);
    const Tensor<4, dim> A = hand->tangent(F), B = law.tangent(F);
    double               error = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        error = std::max(error, (A[i][j] - B[i][j]).norm());
    say("  neo-Hookean, by hand and by its energy",
        bound(": difference of the energy", std::abs(hand->energy(F) - law.energy(F)), 1e-13),
        bound(", stress", (hand->stress(F) - law.stress(F)).norm(), 1e-13),
        bound(", tangent", error, 1e-12));
  }



  void
  test_mooney_rivlin()
  {
    say("Mooney-Rivlin");
    const double E = 6., nu = 0.45, share = 0.3, stretch = 1.5;
    // Uniaxial tension: W of the stretches a, b, b; b such that the sides are free.
    const double mu = E / (2. * (1. + nu)), kappa = E / (3. * (1. - 2. * nu));
    const auto   W = [&](const double a, const double b) {
      const double J = a * b * b, s = std::pow(J, -2. / 3.);
      return 0.5 * mu *
               ((1. - share) * (s * (a * a + 2. * b * b) - 3.) +
                share * (s * s * (2. * a * a * b * b + b * b * b * b) - 3.)) +
             0.5 * kappa * (0.5 * (J * J - 1.) - std::log(J));
    };
    const double h    = 1e-5;
    const auto   side = [&](const double b) { return W(stretch, b + h) - W(stretch, b - h); };
    double       low = 0.5, high = 1.;
    while (high - low > 1e-14)
      (side(0.5 * (low + high)) < 0. ? low : high) = 0.5 * (low + high);
    const double exact = (W(stretch + h, low) - W(stretch - h, low)) / (2. * h);

    const std::string text =
      "set Bodies = block\nsubsection Load stepping\nset Steps = 2\nend\n" +
      box("1, 1, 1",
          "set Symmetry = left, front, bottom\nset Boundary conditions = top\n"
          "subsection Boundary top\nset Displacement z = 0.5 * t\nend",
          "set Law = my Mooney-Rivlin\nset Young modulus = 6\nset Poisson ratio = 0.45\n"
          "set Second share = 0.3");
    const RunSummary run = run_on(text, "rubber", {"Output/VTU interval=0"});
    say("  ",
        run.converged ? "converged" : "not converged",
        bound(", error of the force",
              std::abs(run.reactions.at("block").at("top")[2] / exact - 1.),
              1e-7),
        run.iterations.newton <= 12 ? "" : ", more than 6 iterations a step");
    try
      {
        run_on(text, "rubber", {"Body block/Material/Second share=2"});
      }
    catch (const InputError &error)
      {
        say("  ", error.what());
      }
  }



  void
  test_maxwell()
  {
    say("history that is not plasticity");
    // Uniaxial strain 0.01 from the first step on: the deviator relaxes.
    const double      E = 1000., nu = 0.25, tau = 0.5, share = 0.6, strain = 0.01;
    const double      mu = E / (2. * (1. + nu)), kappa = E / (3. * (1. - 2. * nu));
    const std::string text =
      "set Bodies = block\nsubsection Checkpoints\nset Steps between = 1\nend\n" +
      box("1, 1, 1",
          "set Symmetry = left, right, front, back, bottom\nset Boundary conditions = top\n"
          "subsection Boundary top\nset Displacement z = 0.01\nend",
          "set Law = Maxwell\nset Young modulus = 1000\nset Poisson ratio = 0.25\n"
          "set Relaxation time = 0.5\nset Relaxing share = 0.6");
    const auto force = [&](const double relaxed) {
      return strain * (kappa + 4. / 3. * mu * (1. - share + share * relaxed));
    };
    double previous = 0.;
    for (const unsigned int steps : {10u, 20u})
      {
        const std::string count = std::to_string(steps);
        const std::string name  = "relaxation_" + count;
        double            work = 0., last = 0.;
        const RunSummary  run   = run_on(text,
                                      name,
                                      {"Output/VTU interval=0", "Load stepping/Steps=" + count},
                                      false,
                                      [&](const ConvergedStep &step) {
                                        last = step.energies.at("material dissipation");
                                        work = last + step.energies.at("strain");
                                      });
        const double      x     = 1. / steps / tau;
        const double      found = run.reactions.at("block").at("top")[2];
        const double      exact = force(std::exp(-1. / tau));
        const double      error = std::abs(found / exact - 1.);
        say("  ",
            steps,
            " steps",
            bound(": difference from backward Euler",
                  std::abs(found / force(std::pow(1. + x, -double(steps))) - 1.),
                  1e-10),
            previous == 0. || std::abs(previous / error - 2.) < 0.15
              ? ""
              : ", not of first order in time",
            last > 0. && work > 0.5 * strain * found ? "" : ", wrong energies",
            run.plastic_strain.empty() ? "" : ", reports plastic strain");
        previous = error;

        // Half of it, and resumed.
        run_on(text,
               "half",
               {"Output/VTU interval=0",
                "Load stepping/End time=0.5",
                "Load stepping/Steps=" + std::to_string(steps / 2)});
        const RunSummary resumed =
          run_on(text, "half", {"Output/VTU interval=0", "Load stepping/Steps=" + count}, true);
        say("  resumed",
            bound(": difference",
                  std::abs(resumed.reactions.at("block").at("top")[2] / found - 1.),
                  1e-13));
      }
  }



  /** The last line of the table, from the column of the impulse on. */
  std::string
  last_row(const std::string &folder)
  {
    std::ifstream in(folder + "/statistics");
    std::string   line, last;
    while (std::getline(in, line))
      last = line;
    return last;
  }

  void
  test_output()
  {
    say("output");
    const std::string text =
      "set Bodies = block\nset Obstacles = floor\nset Contact pairs = sole\n"
      "subsection Checkpoints\nset Steps between = 1\nend\n" +
      box("1, 1, 1",
          "set Symmetry = left, front\nset Boundary conditions = top\nsubsection Boundary top\n"
          "set Pressure = 4 * t\nend",
          "set Young modulus = 1000\nset Poisson ratio = 0") +
      "subsection Obstacle floor\nend\n"
      "subsection Contact pair sole\nset Slave body = block\nset Slave boundaries = bottom\n"
      "set Obstacle = floor\nset Behaviour = coulomb\nsubsection Friction\nset Coefficient = 0.3\n"
      "end\nend\n";
    const RunSummary whole = run_on(text, "whole", {"Load stepping/Steps=4"});
    run_on(text, "parts", {"Load stepping/End time=0.5", "Load stepping/Steps=2"});
    const RunSummary parts = run_on(text, "parts", {"Load stepping/Steps=4"}, true);
    // The sum of 4 t over the ends of four steps of length 1/4.
    for (const auto &[name, run] :
         {std::make_pair("whole", &whole), std::make_pair("parts", &parts)})
      {
        const std::string json = run->to_json().print();
        say("  ",
            name,
            run->quantities.size() == 1 && run->quantities[0].pair == "sole" &&
                run->quantities[0].name == "impulse"
              ? bound(": error of the impulse",
                      std::abs(run->quantities[0].components[0] / 2.5 - 1.),
                      1e-9)
              : ": no impulse",
            json.find("\"impulse\": 2.") != std::string::npos ? "" : ", not in summary.json");
      }
    MPI_Barrier(MPI_COMM_WORLD);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) > 0)
      return;
    say("  statistics of both: ", last_row("whole") == last_row("parts") ? "equal" : "differ");
    std::ifstream in("whole/statistics");
    std::string   line;
    while (std::getline(in, line))
      if (line.find("impulse") != std::string::npos)
        say("  ", line.substr(line.find(':') + 2));
    for (const auto &[file, field] : {std::make_pair("solution_0004", "largest_principal_stress"),
                                      std::make_pair("contact_0004", "friction_work_density")})
      {
        std::string stem = std::string("whole/") + file;
        stem += std::filesystem::exists(stem + ".pvtu") ? ".pvtu" : ".vtu";
        const std::string content = read_scene_file(stem);
        say("  ", field, content.find(field) != std::string::npos ? ": written" : ": missing");
      }
  }



  void
  test_weakening()
  {
    say("friction with slip, slip rate and time");
    // Nearly rigid, pressed by 10 and then pushed by 0.5 at the rate 0.5.
    const std::string text =
      "set Bodies = block\nset Obstacles = floor\nset Contact pairs = sole\n" +
      box("4, 1, 1",
          "set Symmetry = front, back\nset Boundary conditions = top\nsubsection Boundary top\n"
          "set Pressure = 10 * min(t, 1)\nset Displacement x = 0.5 * max(t - 1, 0)\nend",
          "set Young modulus = 1e6\nset Poisson ratio = 0") +
      "subsection Obstacle floor\nend\n"
      "subsection Load stepping\nset End time = 2\nend\n"
      "subsection Contact pair sole\nset Slave body = block\nset Slave boundaries = bottom\n"
      "set Obstacle = floor\nset Behaviour = weakening\nsubsection Friction\n"
      "set Slip distance = 0.3\nset Slip rate = 2\nset Ageing = 0.1\nend\nend\n";
    double first = 0.;
    for (const std::string steps : {"20", "40", "160"})
      {
        double           expected = 0.;
        const RunSummary run =
          run_on(text,
                 "weakening",
                 {"Output/VTU interval=0", "Load stepping/Steps=" + steps},
                 false,
                 [&](const ConvergedStep &step) {
                   expected = 0.;
                   for (const ContactPoint &point : step.points)
                     {
                       const double rate = point.slip.norm() / step.step_size;
                       expected += point.area * point.pressure *
                                   (0.2 + (0.6 * (1. + 0.1 * std::log1p(step.time)) - 0.2) *
                                            std::exp(-point.slip_length / 0.3) / (1. + rate / 2.));
                     }
                   expected = dealii::Utilities::MPI::sum(expected, MPI_COMM_WORLD);
                 });
        const double force = -run.contact.at("sole").force[0];
        if (first == 0.)
          first = force;
        // s = 0.5 but for the elastic shear, v = 0.5, t = 2.
        const double rigid = 40. * (0.2 + (0.6 * (1. + 0.1 * std::log(3.)) - 0.2) *
                                            std::exp(-0.5 / 0.3) / (1. + 0.25));
        say("  ",
            steps,
            " steps: ",
            run.converged ? "converged" : "not converged",
            bound(", difference from the law at the present slip",
                  std::abs(force / expected - 1.),
                  1e-8),
            bound(", from a rigid block", std::abs(force / rigid - 1.), 1e-3),
            bound(", from 20 steps", std::abs(force / first - 1.), 1e-6));
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_obstacle();
  test_automatic_differentiation();
  test_mooney_rivlin();
  test_maxwell();
  test_output();
  test_weakening();
  return 0;
}
