// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_drive_support_h
#define touchstone_tests_drive_support_h

#include <touchstone/contact/results.h>
#include <touchstone/drive/step_problem.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace Touchstone
{
  /** A block that is pressed on another and drawn over it, with friction: it sticks
   * in one place and slips in another. */
  inline const std::string blocks = R"(
set Bodies        = base, block
set Contact pairs = contact
subsection Body base
  set Fixed = bottom
  subsection Geometry
    set Type         = box
    set Lower corner = 0, 0, 0
    set Upper corner = 2, 1.5, 0.5
    set Cells        = 5, 3, 1
  end
  subsection Material
    set Young modulus = 1000
    set Poisson ratio = 0.3
  end
end
subsection Body block
  set Boundary conditions = top
  subsection Geometry
    set Type         = box
    set Lower corner = 0.3, 0.2, 0.501
    set Upper corner = 1.1, 1.2, 1.001
    set Cells        = 3, 3, 2
  end
  subsection Material
    set Young modulus = 500
    set Poisson ratio = 0.3
  end
  subsection Boundary top
    set Displacement x = 0.05 * max(t - 0.5, 0) * (1 + y)
    set Displacement y = 0.02 * t
    set Displacement z = -0.03 * min(t, 1) - 0.01 * x
  end
end
subsection Contact pair contact
  set Slave body        = block
  set Slave boundaries  = bottom
  set Master body       = base
  set Master boundaries = top
  set Behaviour         = coulomb
  subsection Friction
    set Coefficient = 0.3
  end
end
)";



  /** A scene with all that its steps need. */
  struct Run
  {
    const Scene         scene;
    const Forest        forest;
    Solid               solid;
    dealii::TimerOutput timer;
    StepProblem         problem;

    Run(const std::string              &text,
        const std::vector<std::string> &overrides,
        const MPI_Comm                  communicator)
      : scene(text, "scene.prm", overrides)
      , forest(scene.forest_input(), "", communicator)
      , solid(scene.bodies, scene.discretisation.degree, forest, communicator)
      , timer(std::cout, dealii::TimerOutput::never, dealii::TimerOutput::wall_times)
      , problem(scene, forest, solid, timer)
    {
      problem.start();
    }

    /** Go to @p time, without keeping it. @throws NonConvergence */
    void
    solve(const NewtonParameters &parameters, const double time)
    {
      problem.solve(time, parameters, [](unsigned int, const NewtonState &, int) {});
    }

    /** Solve all steps of the scene, which end at time one, and keep them. @return
     * the residuals of each step. */
    std::vector<std::vector<double>>
    solve_steps()
    {
      std::vector<std::vector<double>> residuals;
      for (unsigned int step = 1; step <= scene.load_stepping.steps; ++step)
        {
          residuals.emplace_back();
          problem.solve(double(step) / scene.load_stepping.steps,
                        scene.newton,
                        [&](unsigned int, const NewtonState &state, int) {
                          residuals.back().push_back(state.residual);
                        });
          problem.commit();
        }
      return residuals;
    }
  };



  /** Say whether results agree, and if not, how far they are apart. */
  inline void
  print_agreement(const double difference, const double bound)
  {
    std::cout << ", same result: " << (difference < bound ? "yes" : "NO");
    if (difference >= bound)
      std::cout << ", difference " << difference;
    std::cout << std::endl;
  }
} // namespace Touchstone

#endif
