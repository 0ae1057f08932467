// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertz: points that carry exactly Hertz's pressure show hardly any error, also
// when they are spread over the ranks; no contact gives no error at all.

#include <touchstone/verification/hertz.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace Touchstone;

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const MPI_Comm                           communicator = MPI_COMM_WORLD;
  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
  const unsigned int size = dealii::Utilities::MPI::n_mpi_processes(communicator);

  const Hertz  hertz(ReferenceValues("radius: 10, young modulus: 210000, poisson ratio: 0.3, "
                                     "second young modulus: 210000, second poisson ratio: 0.3, "
                                     "centre y: 3, symmetry factor: 4"),
                    1);
  const double force = 1000., a = hertz.contact_radius(force), peak = hertz.peak_pressure(force);
  if (rank == 0)
    std::cout << std::setprecision(8) << "a = " << a << ", p0 = " << peak << std::endl;

  // Rings of a quarter disc around (0, 3, 0), up to 1.5 a, with midpoint rule.
  ReferenceInput     input;
  const unsigned int n_rings = 600, n_angles = 4;
  input.communicator = communicator;
  for (unsigned int i = 0; i < n_rings; ++i)
    for (unsigned int j = 0; j < n_angles; ++j)
      if ((i + j) % size == rank)
        {
          const double dr = 1.5 * a / n_rings, r = (i + 0.5) * dr;
          const double angle = (j + 0.5) * dealii::numbers::PI_2 / n_angles;
          ContactPoint point;
          point.pair               = 1;
          point.reference_position = {r * std::cos(angle), 3. + r * std::sin(angle), 0.1 * r};
          point.area               = r * dr * dealii::numbers::PI_2 / n_angles;
          point.pressure           = r < a ? peak * std::sqrt(1. - r * r / (a * a)) : 0.;
          point.normal             = dealii::Tensor<1, dim>({0., 0., 1.});
          point.traction           = point.pressure * point.normal;
          point.status             = r < a ? ContactStatus::slip : ContactStatus::open;
          input.points.push_back(point);
        }
  // Another pair that does not count.
  input.points.push_back(input.points.back());
  input.points.back().pair     = 0;
  input.points.back().pressure = 1e9;
  input.points.back().traction = dealii::Tensor<1, dim>({1e9, 0., 0.});

  const ReferenceComparison comparison = hertz.compare(input);
  for (const auto &[name, error] : comparison.errors)
    if (rank == 0)
      std::cout << name << (error < 1e-4 ? " < 1e-4" : " is wrong") << std::endl;

  input.points.clear();
  for (const std::string &line : hertz.compare(input).lines)
    if (rank == 0)
      std::cout << line << std::endl;

  const Hertz rigid(ReferenceValues("radius: 10, young modulus: 210000, poisson ratio: 0.3"), 0);
  if (rank == 0)
    std::cout << "rigid: a = " << rigid.contact_radius(force)
              << ", p0 = " << rigid.peak_pressure(force) << std::endl;
  return 0;
}
