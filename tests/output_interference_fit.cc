// SPDX-License-Identifier: LGPL-2.1-or-later
// Lamé's interference fit: the pressure against known figures, and bad values.

#include <touchstone/verification/interference_fit.h>

#include <iomanip>
#include <iostream>

using namespace Touchstone;

namespace
{
  const std::string radii = "inner radius: 0.5, inner skin radius: 1.001, outer bore radius: 1.0, "
                            "outer radius: 1.5, ";
  const std::string material = "young modulus: 210000, poisson ratio: 0.3, ";

  void
  attempt(const std::string &values)
  {
    try
      {
        InterferenceFit fit(ReferenceValues(values), 0);
        std::cout << "accepted" << std::endl;
      }
    catch (const std::exception &error)
      {
        std::cout << error.what() << std::endl;
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  const InterferenceFit fit(ReferenceValues(radii + material +
                                            "slave radius: 1.0, compare displacement: 1"),
                            0);
  std::cout << std::setprecision(8) << "outer bore " << fit.pressure(1.) << "\ninner skin "
            << fit.pressure(1.001) << "\ntextbook   " << fit.textbook_pressure() << std::endl;

  // Three nodes: exact, 1 % high, and one of another pair that does not count.
  ReferenceInput input;
  ContactPoint   point;
  point.pair         = 0;
  point.normal       = dealii::Tensor<1, dim>({1., 0., 0.});
  point.area         = 1.;
  point.status       = ContactStatus::slip;
  point.pressure     = fit.pressure(1.);
  point.displacement = 7.1013e-4 * point.normal;
  input.points.push_back(point);
  point.pressure *= 1.01;
  input.points.push_back(point);
  point.pair     = 1;
  point.pressure = 1e6;
  input.points.push_back(point);
  for (const std::string &line : fit.compare(input).lines)
    std::cout << line << '\n';

  attempt(radii + material);
  attempt(radii + material + "slave radius: 2");
  attempt(radii + material + "slave radius: 1.001, slave raduis: 1.001");
  attempt(radii + material + "slave radius: 1.001, slave radius: 1.001");
  attempt(radii + material + "slave radius: one");
  attempt(radii + material + "slave radius");
  attempt(radii + "slave radius: 1, young modulus: -1, poisson ratio: 0.3");
  attempt(radii + "slave radius: 1, young modulus: 1, poisson ratio: 0.5");
  return 0;
}
