// SPDX-License-Identifier: LGPL-2.1-or-later
// Cattaneo and Mindlin: the tractions add up to the forces, obey Coulomb's law and
// have the right limits; points that carry them show hardly any error, spread over
// ranks; and figures that are wrong on purpose do.

#include <touchstone/verification/cattaneo_mindlin.h>

#include <deal.II/base/quadrature_lib.h>

#include "mesh_common.h"
#include <algorithm>
#include <iomanip>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string common = "radius: 50, young modulus: 210000, poisson ratio: 0.3, "
                             "friction coefficient: 0.3, depth: 0.25";
  const double      mu = 0.3, P = 1800.;

  /** Integral over the contact; the roots at the @p edges are taken away by
   * x = middle + half sin(pi s / 2). */
  double
  integral(std::vector<double> edges, const std::function<double(double)> &f)
  {
    std::sort(edges.begin(), edges.end());
    const QGauss<1> quadrature(40);
    double          sum = 0.;
    for (unsigned int i = 0; i + 1 < edges.size(); ++i)
      for (unsigned int k = 0; k < quadrature.size(); ++k)
        {
          const double middle = (edges[i] + edges[i + 1]) / 2.,
                       half   = (edges[i + 1] - edges[i]) / 2.;
          const double angle  = numbers::PI * (quadrature.point(k)[0] - 0.5);
          sum += f(middle + half * std::sin(angle)) * half * std::cos(angle) * numbers::PI *
                 quadrature.weight(k);
        }
    return sum;
  }



  /** Equilibrium and Coulomb's law for Q after the peak Q*, as fractions of mu P. */
  void
  check(const CattaneoMindlin &exact, const double now, const double before)
  {
    const double Q = now * mu * P, peak = before * mu * P;
    const double a = exact.half_width(P), c = exact.stick_half_width(P, Q, peak),
                 c_peak = exact.stick_half_width(P, peak, peak);
    const auto q        = [&](const double x) { return exact.shear_traction(x, P, Q, peak); };
    const auto p        = [&](const double x) {
      return exact.peak_pressure(P) * std::sqrt(1. - x * x / (a * a));
    };
    const double sum    = integral({-a, -c, -c_peak, c_peak, c, a}, q);
    double       excess = 0., limit = 0.;
    for (double x = -0.9995 * a; x < a; x += 0.001 * a)
      {
        excess = std::max(excess, std::abs(q(x)) - mu * p(x));
        // Outside of the strip the traction is the limit, against the last motion.
        if (std::abs(x) > c)
          {
            const double sign = (now == before ? 1. : -1.) * std::copysign(1., before);
            limit             = std::max(limit, std::abs(q(x) - sign * mu * p(x)));
          }
      }
    std::cout << "Q = " << now << " mu P after " << before << " mu P: c/a = " << c / a
              << ", equilibrium " << small((sum - Q) / (mu * P), 1e-10) << ", beyond Coulomb "
              << small(std::max(excess, 0.) / (mu * exact.peak_pressure(P)), 1e-12)
              << ", slip below Coulomb " << small(limit / (mu * exact.peak_pressure(P)), 1e-12)
              << std::endl;
  }



  /** Points on a strip of the given depth that carry the exact tractions. */
  ReferenceInput
  points(const CattaneoMindlin &exact, const double Q, const double peak)
  {
    ReferenceInput     input;
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const double       a = exact.half_width(P), c = exact.stick_half_width(P, Q, peak);
    const unsigned int n = 2000;
    input.communicator   = MPI_COMM_WORLD;
    for (unsigned int i = rank; i < n; i += n_ranks)
      {
        const double x           = 1.5 * a * (2. * (i + 0.5) / n - 1.);
        ContactPoint point       = ContactPoint();
        point.pair               = 1;
        point.reference_position = {2. + x, 7., 0.};
        point.area               = 3. * a / n * 0.25;
        point.pressure =
          std::abs(x) < a ? exact.peak_pressure(P) * std::sqrt(1. - x * x / (a * a)) : 0.;
        point.traction = Tensor<1, dim>({-exact.shear_traction(x, P, Q, peak), 0., point.pressure});
        point.status   = std::abs(x) < c   ? ContactStatus::stick
                         : std::abs(x) < a ? ContactStatus::slip
                                           : ContactStatus::open;
        input.points.push_back(point);
      }
    return input;
  }



  void
  print(const std::string &title, const ReferenceComparison &comparison)
  {
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::cout << title << ':';
    for (const auto &[name, error] : comparison.errors)
      if (error < 1e-3)
        std::cout << ' ' << name << " < 1e-3";
      else
        std::cout << ' ' << name << ' ' << error;
    std::cout << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << std::setprecision(6);
  const CattaneoMindlin exact(ReferenceValues(common), 0);
  const double          a = exact.half_width(P);
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::cout << "a = " << a << ", p0 = " << exact.peak_pressure(P) << ", their P "
                << small(numbers::PI / 2. * a * exact.peak_pressure(P) - P, 1e-9) << std::endl;
      for (const auto &[now, before] : std::vector<std::pair<double, double>>{{0., 0.},
                                                                              {0.5, 0.5},
                                                                              {-0.5, -0.5},
                                                                              {0.98, 0.98},
                                                                              {1., 1.},
                                                                              {0.2, 0.5},
                                                                              {0., 0.5},
                                                                              {-0.3, 0.5},
                                                                              {-0.5, 0.5},
                                                                              {0.3, -0.9},
                                                                              {-1., 1.}})
        check(exact, now, before);
      std::cout << "beyond full slip c is "
                << (std::isnan(exact.stick_half_width(P, 1.01 * mu * P, 1.01 * mu * P))
                      ? "none"
                      : "there FAILED")
                << std::endl;
      // Fully reversed, the tractions are those of the first loading reversed.
      double worst = 0.;
      for (double x = -a; x < a; x += 0.01)
        worst = std::max(worst,
                         std::abs(exact.shear_traction(x, P, -200., 200.) +
                                  exact.shear_traction(x, P, 200., 200.)));
      std::cout << "reversed " << small(worst, 1e-9) << std::endl;
    }

  const double Q    = 0.5 * mu * P;
  const auto   with = [&](const std::string &more) {
    return CattaneoMindlin(ReferenceValues(common + ", centre x: 2" + more), 1);
  };
  print("loading", with(", tangential force: 67.5").compare(points(exact, Q, Q)));
  print("wrong force", with(", tangential force: 135").compare(points(exact, Q, Q)));
  print("the other way", with(", tangential force: -67.5").compare(points(exact, -Q, -Q)));
  print("unloaded",
        with(", tangential force: 0, peak tangential force: 67.5").compare(points(exact, 0., Q)));
  print("no peak", with(", tangential force: 0").compare(points(exact, 0.2 * Q, Q)));
  print("no points", with("").compare(ReferenceInput()));

  print("unloaded from a known peak",
        with(", peak tangential force: 67.5").compare(points(exact, 0.3 * Q, Q)));
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    print_error([&]() { with(", tangential force: 2, peak tangential force: -1"); });
  return 0;
}
