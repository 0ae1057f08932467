// SPDX-License-Identifier: LGPL-2.1-or-later
// The rows of real pairings in explicit cycles, on bodies of loose masses that fly at each other:
// momentum and its moment, energy, gaps after rows have been kept, and the same bits on any number
// of ranks, for pointwise and averaged rows, over edges, on curved surfaces, with friction. Nothing
// holds the faces of such bodies plane: when rows are made anew, gaps that were linear jump by what
// the faces have warped, and closing them takes a little work.

#include <touchstone/explicit/impulse_contact.h>

#include "contact_support.h"
#include <iostream>
#include <map>

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string explicit_keys = R"(
subsection Time integration
  set Scheme = central_differences
end
subsection Contact
  set Enforcement = forward increment
end
)";

  const std::string flat = two_bodies("lower",
                                      "set Cells = 3, 4, 1",
                                      "upper",
                                      "set Lower corner = 0.13, 0.11, 1.002\n"
                                      "set Upper corner = 0.83, 0.85, 1.502\n"
                                      "set Cells        = 4, 3, 1",
                                      slave_and_master("upper", "bottom", "lower", "top"));

  const std::string curved = two_bodies("lower",
                                        "set Cells = 3, 3, 1",
                                        "upper",
                                        "set Type = cap\n"
                                        "set Apex = 0.5, 0.5, 1.002\n"
                                        "set Radius = 2\n"
                                        "set Contact side = bottom\n"
                                        "set Part = whole\n"
                                        "set Width = 0.6\n"
                                        "set Height = 0.3",
                                        slave_and_master("upper", "contact", "lower", "top"));

  struct Outcome
  {
    double   drift = 0., turn = 0., gain = 0., penetration = 0.;
    unsigned renewals = 0, cycles = 0;
    /** Displacements by key of the node. */
    std::map<std::uint64_t, Tensor<1, dim>> displacement;
    bool                                    pressed = false;
  };

  Outcome
  fly(const std::string &text, std::vector<std::string> overrides, const MPI_Comm comm)
  {
    for (const std::string body : {"lower", "upper"})
      overrides.push_back("Body " + body + "/Material/Density=1");
    const Scene         scene(text + explicit_keys, "scene.prm", overrides);
    const Forest        forest(scene.forest_input(), "", comm);
    const Solid         solid(scene.bodies, 1, forest, comm);
    Contact             contact(pair_inputs(scene, forest, solid), scene.contact, solid);
    const NodeMap       map(solid);
    ImpulseContact      impulses(contact, scene.contact, map, scene.bodies, scene.obstacles);
    const unsigned int  n = map.n_owned();
    std::vector<double> mass(n);
    NodeField           u(map.n_local()), v(map.n_local()), before;
    std::vector<SymmetricTensor<2, dim>> mobility(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        const Point<dim> x(map.positions()[i]);
        mass[i]     = std::exp(scatter(x, 0));
        mobility[i] = 1. / mass[i] * unit_symmetric_tensor<dim>();
        // The upper body falls and spins.
        if (map.body(i) == 1)
          v[i] = Tensor<1, dim>({0.3, 0.2, -0.5}) +
                 cross_product_3d(Tensor<1, dim>({0.4, -0.3, 1.}), x - Point<dim>(0.5, 0.5, 1.2));
        for (unsigned int d = 0; d < dim; ++d)
          v[i][d] += 0.02 * scatter(x, 1 + d);
      }
    const auto total = [&](const auto &term) {
      std::array<ExactSum, dim> sums;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int d = 0; d < dim; ++d)
          sums[d].add(term(i)[d]);
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = sums[d].value(comm);
      return result;
    };
    const auto energy = [&]() {
      return total([&](const unsigned int i) {
        return Tensor<1, dim>({0.5 * mass[i] * v[i].norm_square(), 0., 0.});
      })[0];
    };
    impulses.set_mobility(mobility);
    impulses.begin_interval();
    Outcome      out;
    const double step = 2e-4;
    for (out.cycles = 0; out.cycles < 120; ++out.cycles)
      {
        map.update_ghosts(u);
        map.update_ghosts(v);
        before         = v;
        const double e = energy();
        impulses.project(u, before, v, out.cycles * step, step);
        const Tensor<1, dim> p =
          total([&](const unsigned int i) { return mass[i] * (v[i] - before[i]); });
        const Tensor<1, dim> l = total([&](const unsigned int i) {
          return mass[i] * cross_product_3d(map.positions()[i] + u[i], v[i] - before[i]);
        });
        out.drift              = std::max(out.drift, p.norm());
        out.turn               = std::max(out.turn, l.norm());
        out.gain               = std::max(out.gain, energy() / e - 1.);
        for (unsigned int i = 0; i < n; ++i)
          u[i] += step * v[i];
      }
    impulses.end_interval(u, out.cycles * step);
    int pressed = 0;
    for (const ContactRow &row : contact.rows())
      {
        pressed |= contact.state(row).active();
        if (row.has_partner)
          out.penetration = std::max(out.penetration, -row.gap / row.size);
      }
    out.pressed     = Utilities::MPI::max(pressed, comm) > 0;
    out.penetration = Utilities::MPI::max(out.penetration, comm);
    out.renewals    = impulses.work().renewals;
    for (unsigned int i = 0; i < n; ++i)
      out.displacement[map.key(i)] = u[i];
    return out;
  }

  void
  show(const std::string              &name,
       const std::string              &text,
       const std::vector<std::string> &overrides,
       const double                    penetration)
  {
    const Outcome all = fly(text, overrides, MPI_COMM_WORLD),
                  one = fly(text, overrides, MPI_COMM_SELF);
    bool same         = true;
    for (const auto &[key, u] : all.displacement)
      for (unsigned int d = 0; d < dim; ++d)
        same = same && u[d] == one.displacement.at(key)[d];
    same = Utilities::MPI::min(same ? 1 : 0, MPI_COMM_WORLD) == 1;
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << "\n  contact          " << (all.pressed ? "yes" : "no FAILED")
                << "\n  momentum         " << small(all.drift, 1e-14) << "\n  moment           "
                << small(all.turn, 1e-13) << "\n  gain of energy   " << small(all.gain, 1e-6)
                << "\n  penetration      " << small(all.penetration, penetration)
                << "\n  rows kept        "
                << (all.renewals < all.cycles && all.renewals > 1 ? "yes" : "no FAILED")
                << "\n  same bits        " << (same ? "yes" : "no FAILED") << std::endl;
    if (std::getenv("SHOW"))
      std::cout << all.renewals << " renewals, " << all.drift << ' ' << all.turn << ' ' << all.gain
                << ' ' << all.penetration << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                pointwise = "Contact pair pair/Pairing=pointwise",
                    coulomb                  = "Contact pair pair/Behaviour=coulomb",
                    mu                       = "Contact pair pair/Friction/Coefficient=0.3";
  show("pointwise, flat", flat, {pointwise}, 1e-3);
  show("averaged, flat", flat, {}, 1e-3);
  show("pointwise, friction", flat, {pointwise, coulomb, mu}, 1e-3);
  show("averaged, friction", flat, {coulomb, mu}, 1e-3);
  show("averaged, over edges", overhang, {coulomb, mu}, 1e-3);
  show("pointwise, curved", curved, {pointwise, coulomb, mu}, 1e-3);
  show("averaged, curved", curved, {coulomb, mu}, 1e-3);
  return 0;
}
