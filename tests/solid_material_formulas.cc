// SPDX-License-Identifier: LGPL-2.1-or-later
// Laws against their closed formulas: stretch and shear of the hyperelastic ones, bars of
// orthotropic material in each direction, relaxation of the Prony series, thermal strain, and that
// a failure of a law is that of one evaluation.

#include <touchstone/scene/scene.h>
#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/small_strain_kernel.h>

#include "mesh_common.h"
#include <functional>

using namespace Touchstone;
using namespace dealii;

namespace
{
  MaterialParameters
  material(const std::string &keys)
  {
    return Scene("set Bodies = x\nsubsection Body x\nsubsection Geometry\nset Type = box\nend\n"
                 "subsection Material\n" +
                   keys + "end\nend\n",
                 "scene.prm",
                 {})
      .bodies.front()
      .material;
  }

  std::shared_ptr<const MaterialLaw>
  law_of(const MaterialParameters &parameters)
  {
    if (parameters.finite_strain())
      return FiniteStrainKernel(1, ElementType::full, parameters).material();
    return SmallStrainKernel(1, ElementType::full, parameters).material();
  }

  Tensor<2, dim>
  diagonal(const double a, const double b, const double c)
  {
    Tensor<2, dim> result;
    result[0][0] = a;
    result[1][1] = b;
    result[2][2] = c;
    return result;
  }

  /** Stretches of volume one, in which the energy of volume has no part but a pressure.
   * @param difference Of the first two principal stresses tau_1 - tau_2, by three stretches. */
  void
  rubber(const std::string                                   &name,
         const std::string                                   &keys,
         const std::function<double(double, double, double)> &difference)
  {
    const auto law   = law_of(material("set Law = " + name + "\n" + keys));
    double     worst = 0.;
    for (const double stretch : {0.5, 0.9, 1.2, 2.})
      {
        // Uniaxial: with free sides the nominal stress is (tau_1 - tau_2) / stretch.
        const double         side = 1. / std::sqrt(stretch);
        const Tensor<2, dim> F    = diagonal(stretch, side, side);
        MaterialResponse     response;
        law->respond({F, nullptr, 0.}, Demand::stress, response, nullptr);
        const double nominal = response.stress[0][0] - response.stress[1][1] * side / stretch;
        const double exact   = difference(stretch, side, side) / stretch;
        worst                = std::max(worst, std::abs(nominal / exact - 1.));
      }
    double shear_error = 0.;
    for (const double shear : {0.1, 0.8, 1.5})
      {
        Tensor<2, dim> F = diagonal(1., 1., 1.);
        F[0][1]          = shear;
        MaterialResponse response;
        law->respond({F, nullptr, 0.}, Demand::stress, response, nullptr);
        // Principal stretches l, 1/l with l - 1/l = shear; by Rivlin's universal relation the
        // shear stress is the difference of principal stresses over l + 1/l.
        const double         l      = 0.5 * (shear + std::sqrt(shear * shear + 4.));
        const double         exact  = difference(l, 1. / l, 1.) / (l + 1. / l);
        const Tensor<2, dim> cauchy = response.stress * transpose(F);
        shear_error                 = std::max(shear_error, std::abs(cauchy[0][1] / exact - 1.));
      }
    std::cout << name << ": uniaxial stretch " << small(worst) << ", simple shear "
              << small(shear_error) << std::endl;
  }

  void
  rubbers()
  {
    rubber("Mooney-Rivlin",
           "set C10 = 0.4\nset C01 = 0.1\nset Poisson ratio = 0.49\n",
           [](const double a, const double b, const double) {
             return 2. * (a * a - b * b) * 0.4 - 2. * (1. / (a * a) - 1. / (b * b)) * 0.1;
           });
    // The constants of Treloar's rubber, Ogden (1972).
    const auto ogden = [](const double a, const double b, const double) {
      double sum = 0.;
      for (const auto &[mu, alpha] :
           {std::make_pair(6.3, 1.3), std::make_pair(0.012, 5.), std::make_pair(-0.1, -2.)})
        sum += mu * (std::pow(a, alpha) - std::pow(b, alpha));
      return sum;
    };
    rubber("Ogden",
           "set Moduli = 6.3, 0.012, -0.1\nset Exponents = 1.3, 5, -2\nset Poisson ratio = 0.49\n",
           ogden);
    rubber("Gent",
           "set Shear modulus = 0.7\nset Locking stretch = 4\nset Poisson ratio = 0.49\n",
           [](const double a, const double b, const double c) {
             const double limit = 16. + 2. / 4. - 3.;
             return 0.7 * limit / (limit - (a * a + b * b + c * c - 3.)) * (a * a - b * b);
           });
    const auto gent =
      law_of(material("set Law = Gent\nset Shear modulus = 0.7\nset Locking stretch = 4\n"));
    for (const double stretch : {3.99, 4.01})
      std::cout
        << "Gent, locking stretch 4, at " << stretch << ": "
        << (gent->admits(
              {diagonal(stretch, 1. / std::sqrt(stretch), 1. / std::sqrt(stretch)), nullptr, 0.})
              ? "admitted"
              : "not admitted")
        << std::endl;
  }

  void
  orthotropic()
  {
    const double E[3] = {200., 50., 20.}, G[3] = {30., 12., 7.}, nu[3] = {0.3, 0.25, 0.4};
    // Axes of the material in the body: turned about two axes.
    const Tensor<1, dim> first({2., 2., 1.}), second({-2., 1., 2.});
    const Tensor<1, dim> axis[3] = {first / 3., second / 3., cross_product_3d(first, second) / 9.};
    const auto           law     = law_of(material(
      "set Law = orthotropic\nset Young moduli = 200, 50, 20\nset Shear moduli = 30, 12, 7\n"
                    "set Poisson ratios = 0.3, 0.25, 0.4\nset First direction = 2, 2, 1\n"
                    "set Second direction = -2, 1, 2\n"));
    MaterialResponse     response;
    double               worst = 0., shear_error = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      {
        // The strain of a bar pulled in this direction by a stress of 1.
        SymmetricTensor<2, dim> strain;
        for (unsigned int j = 0; j < dim; ++j)
          {
            const double ratio = i == j  ? 1.
                                 : i < j ? -nu[i + j - 1]
                                         : -nu[i + j - 1] * E[i] / E[j];
            strain += ratio / E[i] * symmetrize(outer_product(axis[j], axis[j]));
          }
        law->respond({Tensor<2, dim>(strain), nullptr, 0.}, Demand::tangent, response, nullptr);
        worst = std::max(worst, (response.stress - outer_product(axis[i], axis[i])).norm());
        for (unsigned int j = i + 1; j < dim; ++j)
          {
            const auto plane = symmetrize(outer_product(axis[i], axis[j]));
            law->respond({Tensor<2, dim>(plane) / G[i + j - 1], nullptr, 0.},
                         Demand::stress,
                         response,
                         nullptr);
            shear_error =
              std::max(shear_error, (response.stress - 2. * Tensor<2, dim>(plane)).norm());
          }
      }
    std::cout << "orthotropic: bars along the three directions " << small(worst)
              << ", shear in the three planes " << small(shear_error) << std::endl;
  }

  /** Shear and dilatation that jump and stay, against the series; a ramp in steps of any size. */
  void
  prony()
  {
    const double   g[2] = {0.3, 0.4}, k[2] = {0.1, 0.2}, tau[2] = {0.5, 20.};
    const auto     law = law_of(material("set Law = viscoelastic\nset Young modulus = 9\n"
                                         "set Poisson ratio = 0.25\nset Relaxation times = 0.5, 20\n"
                                         "set Shear ratios = 0.3, 0.4\nset Bulk ratios = 0.1, 0.2\n"));
    const double   mu = 3.6, kappa = 6.;
    Tensor<2, dim> strain = diagonal(0.02, 0.01, 0.);
    strain[0][1] = strain[1][0] = 0.005;
    const auto exact            = [&](const double t) {
      double G = mu, K = kappa;
      for (unsigned int i = 0; i < 2; ++i)
        {
          G += g[i] * mu * std::expm1(-t / tau[i]);
          K += k[i] * kappa * std::expm1(-t / tau[i]);
        }
      const SymmetricTensor<2, dim> e = symmetrize(strain);
      return Tensor<2, dim>(2. * G * deviator(e) + K * trace(e) * unit_symmetric_tensor<dim>());
    };
    std::vector<double> before(law->n_state()), after(law->n_state());
    law->start(before.data());
    MaterialResponse response;
    double           t = 0., worst = 0.;
    for (const double step : {0., 0.1, 0.4, 2., 0.001, 30.})
      {
        law->respond({strain, before.data(), step}, Demand::stress, response, after.data());
        before = after;
        t += step;
        worst = std::max(worst, (response.stress - exact(t)).norm() / exact(t).norm());
      }
    // What the jump has brought in is stored or dissipated.
    const double given   = 0.5 * scalar_product(exact(0.), strain);
    const double balance = (response.elastic_energy + law->dissipation(before.data())) / given - 1.;
    std::cout << "Prony series: relaxation " << small(worst) << ", energy stored and dissipated "
              << small(balance) << std::endl;

    // The same ramp in one step and in a thousand: stress, energy, dissipation.
    double results[2][3];
    for (unsigned int run = 0; run < 2; ++run)
      {
        const unsigned int n = run == 0 ? 1 : 1000;
        law->start(before.data());
        for (unsigned int i = 1; i <= n; ++i)
          {
            law->respond({strain * (double(i) / n), before.data(), 3. / n},
                         Demand::stress,
                         response,
                         after.data());
            before = after;
          }
        results[run][0] = response.stress.norm();
        results[run][1] = response.elastic_energy;
        results[run][2] = law->dissipation(before.data());
      }
    worst = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      worst = std::max(worst, std::abs(results[1][i] / results[0][i] - 1.));
    std::cout << "Prony series: ramp in one step and in a thousand " << small(worst, 1e-10)
              << std::endl;
  }

  /** Largest deviation of the tangent, and of the stress from the potential, from central
   * differences, after a step with other strain. */
  void
  tangents(const std::string &name, const std::string &keys)
  {
    const MaterialParameters parameters = material("set Law = " + name + "\n" + keys);
    const auto               law        = law_of(parameters);
    const double             start      = parameters.finite_strain() ? 1. : 0.;
    std::vector<double>      before(law->n_state() + 1), after(law->n_state() + 1);
    law->start(before.data());
    const Point<dim> x(0.1, 0.2, 0.3);
    Tensor<2, dim>   F = diagonal(start + 0.03, start, start - 0.02);
    MaterialResponse response;
    law->respond({F, before.data(), 0.3, x, 0.3}, Demand::stress, response, after.data());
    before = after;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] += 0.05 * std::sin(1. + 3. * i + 7. * j);
    law->respond({F, before.data(), 0.5, x, 0.8}, Demand::tangent, response, after.data());
    const double h = 1e-5, scale = response.tangent[0][0][0][0];
    double       stress = 0., tangent = 0.;
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int l = 0; l < dim; ++l)
        {
          MaterialResponse plus, minus;
          Tensor<2, dim>   up = F, down = F;
          up[k][l] += h;
          down[k][l] -= h;
          law->respond({up, before.data(), 0.5, x, 0.8}, Demand::stress, plus, after.data());
          law->respond({down, before.data(), 0.5, x, 0.8}, Demand::stress, minus, after.data());
          MaterialResponse plus_energy, minus_energy;
          law->respond({up, before.data(), 0.5, x, 0.8}, Demand::energy, plus_energy, after.data());
          law->respond({down, before.data(), 0.5, x, 0.8},
                       Demand::energy,
                       minus_energy,
                       after.data());
          stress = std::max(stress,
                            std::abs((plus_energy.energy - minus_energy.energy) / (2. * h) -
                                     response.stress[k][l]) /
                              scale);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              tangent = std::max(tangent,
                                 std::abs((plus.stress[i][j] - minus.stress[i][j]) / (2. * h) -
                                          response.tangent[i][j][k][l]) /
                                   scale);
        }
    std::cout << name << ": stress from energy " << small(stress, 1e-8) << ", tangent "
              << small(tangent, 1e-8) << std::endl;
  }

  /** A point that expands freely has no stress; one that cannot has that of the formula. */
  void
  thermal(const std::string &name, const std::string &keys)
  {
    const std::string expansion =
      "subsection Thermal expansion\nset Coefficient = 0.01\nset Temperature = 10*x + 5*t\nend\n";
    const MaterialParameters parameters = material("set Law = " + name + "\n" + keys + expansion);
    const auto               law        = law_of(parameters);
    const double             start      = parameters.finite_strain() ? 1. : 0.;
    const Point<dim>         x(0.5, 7., 8.);
    std::vector<double>      before(law->n_state() + 1), after(law->n_state() + 1);
    law->start(before.data());
    const double         free = start + 0.01 * (10. * 0.5 + 5. * 2.);
    const Tensor<2, dim> F    = diagonal(free, free, free);
    MaterialResponse     response;
    law->respond({F, before.data(), 1., x, 2.}, Demand::stress, response, after.data());
    std::cout << name << ": stress of free thermal expansion "
              << small(response.stress.norm() / parameters.young_modulus, 1e-14) << std::endl;
    tangents(name, keys + expansion);
  }



  /** The temperature is impossible at time 1, of which a formula that depends on the place is not
   * asked before the run: a cell fails then, and never after. */
  void
  fails_once(const std::string &name, CellKernel &&kernel)
  {
    std::vector<double> positions, rest(kernel.n_dofs(), 0.);
    std::vector<double> committed(kernel.n_state());
    const FE_Q<dim>     nodes(1);
    for (const Point<dim> &x : nodes.get_unit_support_points())
      positions.insert(positions.end(), {x[0], x[1], x[2]});
    kernel.start(committed.data());
    std::cout << name << ": fails at times";
    for (const double time : {0., 1., 0.5, 0.25})
      {
        kernel.set_time(time);
        kernel.reinit(positions.data(), rest.data(), committed.data());
        kernel.force();
        if (!kernel.solved())
          std::cout << " " << time;
      }
    std::cout << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  const Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  rubbers();
  orthotropic();
  prony();
  const std::string elastic = "set Young modulus = 3\nset Poisson ratio = 0.3\n";
  const std::string prony = elastic + "set Relaxation times = 0.2, 2\nset Shear ratios = 0.2, 0.3\n"
                                      "set Bulk ratios = 0.1, 0.4\n";
  const std::string plastic = elastic +
                              "subsection Plasticity\nset Hardening = linear\n"
                              "set Yield stress = 0.05\nset Hardening modulus = 0.1\nend\n";
  const std::string wood = "set Young moduli = 3, 2, 1\nset Shear moduli = 1, 0.9, 0.5\n"
                           "set Poisson ratios = 0.2, 0.3, 0.1\n";
  tangents("viscoelastic", prony);
  tangents("orthotropic", wood);
  thermal("linear elastic", elastic);
  thermal("viscoelastic", prony);
  thermal("orthotropic", wood);
  thermal("small-strain von Mises", plastic);
  thermal("finite-strain von Mises", plastic);
  thermal("neo-Hookean", elastic);
  thermal("Gent", "set Shear modulus = 1\nset Locking stretch = 2\n");
  const std::string cold =
    elastic +
    "subsection Thermal expansion\nset Coefficient = 1\nset Temperature = -1.5*t + 0*x\nend\n";
  fails_once("linear elastic",
             SmallStrainKernel(1,
                               ElementType::full,
                               material("set Law = linear elastic\n" + cold)));
  fails_once("neo-Hookean",
             FiniteStrainKernel(1, ElementType::full, material("set Law = neo-Hookean\n" + cold)));
  return 0;
}
