// SPDX-License-Identifier: LGPL-2.1-or-later
// Impulses of contact rows on loose masses, against exact answers: one row, walls, redundant rows,
// friction, the energy and momentum of random rows after any number of sweeps, and the same bits on
// any number of ranks.

#include <touchstone/explicit/impulse_solver.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

using namespace Touchstone;
using namespace dealii;

namespace
{
  unsigned int
  rank()
  {
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  void
  print(const std::string &text, const bool good)
  {
    if (rank() == 0)
      std::cout << text << (good ? ": as it must" : ": WRONG") << std::endl;
  }

  /** Loose masses, dealt to the ranks in turn, and rows on them. */
  struct Masses
  {
    std::vector<double>         mass;
    std::vector<Tensor<1, dim>> velocity;
    struct Row
    {
      std::vector<std::pair<unsigned int, double>> entries;
      Tensor<1, dim>                               normal;
      double                                       allowed = 0.;
      bool                                         tied    = false;
      Tensor<1, dim>                               drive   = Tensor<1, dim>();
    };
    std::vector<Row> rows;
    FrictionRow      friction;
    bool             with_friction = false;
    /** Masses whose velocity is prescribed. */
    std::vector<bool> fixed;

    ImpulseCounts               counts;
    std::vector<Tensor<1, dim>> result, impulses;

    explicit Masses(const std::vector<double> &mass)
      : mass(mass)
      , velocity(mass.size())
      , fixed(mass.size(), false)
    {
    }

    void
    add_friction(const double coefficient)
    {
      static std::vector<std::shared_ptr<FrictionLaw>> laws;
      const auto                                       law = FrictionLawRegistry::make("coulomb");
      ParameterHandler                                 prm;
      law->declare(prm);
      prm.set("Coefficient", coefficient);
      laws.push_back(law);
      friction.law  = law.get();
      with_friction = true;
    }

    void
    solve(const ImpulseControl &control, const MPI_Comm communicator = MPI_COMM_WORLD)
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator), n = mass.size();
      const unsigned int here = Utilities::MPI::this_mpi_process(communicator);
      // Blocks of nodes, as in a partition: dofs of a rank follow one another.
      const auto owner = [&](const unsigned int node) { return node * n_ranks / n; };
      IndexSet   owned(dim * n);
      for (unsigned int node = 0; node < n; ++node)
        if (owner(node) == here)
          owned.add_range(dim * node, dim * node + dim);
      owned.compress();
      ImpulseSolver                         solver(communicator);
      std::vector<std::pair<Index, RowKey>> slots;
      std::vector<unsigned int>             mine;
      for (unsigned int k = 0; k < rows.size(); ++k)
        if (owner(rows[k].entries[0].first) == here)
          {
            mine.push_back(k);
            ImpulseRow row;
            row.key     = {0, k};
            row.first   = slots.size();
            row.n_nodes = rows[k].entries.size();
            row.normal  = rows[k].normal;
            row.tied    = rows[k].tied;
            row.allowed = rows[k].allowed * row.normal;
            row.drive   = rows[k].drive;
            if (with_friction)
              {
                row.friction   = &friction;
                row.tangential = tangential_projector(row.normal);
              }
            solver.rows.push_back(row);
            for (const auto &entry : rows[k].entries)
              slots.emplace_back(dim * entry.first, row.key);
          }
      solver.nodes.reinit(owned, slots);
      solver.resize();
      for (std::size_t i = 0, s = 0; i < mine.size(); ++i)
        for (const auto &entry : rows[mine[i]].entries)
          solver.weights[s++] = entry.second;
      std::vector<std::uint64_t> keys(solver.nodes.n());
      for (unsigned int i = 0; i < solver.nodes.n(); ++i)
        {
          const unsigned int node = solver.nodes.dof(i) / dim;
          keys[i]                 = node;
          if (i >= solver.nodes.n_owned())
            continue;
          solver.mobility[i] = (fixed[node] ? 0. : 1. / mass[node]) * unit_symmetric_tensor<dim>();
          solver.velocity[i] = velocity[node];
        }
      solver.nodes.forward(solver.mobility);
      solver.nodes.forward(solver.velocity);
      solver.sort_slots(keys);
      counts = solver.solve(control);
      result.assign(n, Tensor<1, dim>());
      impulses.assign(rows.size(), Tensor<1, dim>());
      std::vector<double> values(dim * (n + rows.size()), 0.);
      for (unsigned int node = 0; node < n; ++node)
        if (owner(node) == here)
          for (unsigned int d = 0; d < dim; ++d)
            values[dim * node + d] = velocity[node][d];
      for (unsigned int i = 0; i < solver.nodes.n_owned(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          values[solver.nodes.dof(i) + d] = solver.velocity[i][d];
      for (std::size_t i = 0; i < mine.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          values[dim * (n + mine[i]) + d] = solver.rows[i].impulse[d];
      std::vector<double> all(values.size());
      Utilities::MPI::sum(values, communicator, all); // all but one of the terms are zero
      for (unsigned int d = 0; d < dim; ++d)
        {
          for (unsigned int node = 0; node < n; ++node)
            result[node][d] = all[dim * node + d];
          for (std::size_t k = 0; k < rows.size(); ++k)
            impulses[k][d] = all[dim * (n + k) + d];
        }
    }

    double
    energy(const std::vector<Tensor<1, dim>> &v) const
    {
      double sum = 0.;
      for (std::size_t i = 0; i < mass.size(); ++i)
        sum += 0.5 * mass[i] * v[i].norm_square();
      return sum;
    }

    Tensor<1, dim>
    momentum(const std::vector<Tensor<1, dim>> &v) const
    {
      Tensor<1, dim> sum;
      for (std::size_t i = 0; i < mass.size(); ++i)
        sum += mass[i] * v[i];
      return sum;
    }

    Tensor<1, dim>
    relative(const Row &row) const
    {
      Tensor<1, dim> w = -row.drive;
      for (const auto &[node, weight] : row.entries)
        w += weight * result[node];
      return w;
    }
  };

  const Tensor<1, dim> x({1., 0., 0.}), y({0., 1., 0.}), z({0., 0., 1.});

  bool
  close(const Tensor<1, dim> &a, const Tensor<1, dim> &b, const double tolerance = 1e-12)
  {
    return (a - b).norm() <= tolerance;
  }

  /** Masses 1 and 3 that meet at speed 2 part at the speed of their centre. */
  void
  two_masses()
  {
    Masses two({1., 3.});
    two.velocity[0] = -2. * z + 0.5 * x;
    two.rows        = {{{{0, 1.}, {1, -1.}}, z}};
    two.solve({});
    print("two masses", close(two.result[0], -0.5 * z + 0.5 * x) && close(two.result[1], -0.5 * z));
    // A gap that closes within the cycle leaves that much velocity.
    two.rows[0].allowed = 0.4;
    two.solve({});
    print("with a gap", std::abs(z * two.relative(two.rows[0]) + 0.4) < 1e-12);
    two.rows[0].allowed = 2.5;
    two.solve({});
    print("that does not close", close(two.result[0], two.velocity[0]) && two.counts.sweeps == 0);
    two.rows[0].allowed = 0.;
    two.rows[0].tied    = true;
    two.solve({});
    print("tied", two.relative(two.rows[0]).norm() < 1e-12);
    // One sweep is exact where no node is shared: defence node.
    two.rows[0].tied = false;
    ImpulseControl once;
    once.one_sweep = true;
    once.sweeps    = 1;
    two.solve(once);
    print("one sweep", close(two.result[0], -0.5 * z + 0.5 * x));
  }

  /** A mass in a corner of three walls, each of them twice. */
  void
  corner()
  {
    Masses one({2.});
    one.velocity[0] = -1. * x - 2. * y + 3. * z;
    for (unsigned int i = 0; i < 2; ++i)
      for (const auto &normal : {x, y, z})
        one.rows.push_back({{{0, 1.}}, normal});
    one.solve({});
    print("corner with redundant walls", close(one.result[0], 3. * z, 1e-10));
    // A wall that moves pushes.
    one.rows[0].drive = 0.5 * x;
    one.rows[3].drive = 0.5 * x;
    one.solve({});
    print("moving wall", close(one.result[0], 0.5 * x + 3. * z, 1e-10));
  }

  void
  coulomb()
  {
    for (const double mu : {0.2, 1., 5.})
      {
        Masses one({2.});
        one.add_friction(mu);
        one.velocity[0] = -1. * z + 3. * x + 4. * y;
        one.rows        = {{{{0, 1.}}, z}};
        one.solve({});
        const Tensor<1, dim> slip = (std::max(0., 5. - mu) / 5.) * (3. * x + 4. * y);
        print("friction " + std::to_string(mu), close(one.result[0], slip, 1e-10));
      }
    // Four feet of one plate: friction is on the cone of each, against its slip.
    Masses feet({1., 1., 2., 2., 1.});
    feet.add_friction(0.3);
    for (unsigned int i = 0; i < 4; ++i)
      {
        feet.velocity[i] = -1. * z + (1. + i) * x - i * y;
        feet.rows.push_back({{{i, 1.}, {4, -1.}}, z});
      }
    feet.solve({});
    bool good = feet.counts.converged;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const Tensor<1, dim> p = feet.impulses[i], w = feet.relative(feet.rows[i]);
        const double         p_n = p * z;
        const Tensor<1, dim> p_t = p - p_n * z, w_t = w - (w * z) * z;
        good = good && std::abs(w * z) < 1e-8 && p_t * w_t <= 1e-8 &&
               (w_t.norm() < 1e-8 || (std::abs(p_t.norm() - 0.3 * p_n) < 1e-8 * p_n &&
                                      cross_product_3d(p_t, w_t).norm() < 1e-8));
      }
    print("cone and direction of feet that share a plate", good);
  }

  /** Random masses and rows. */
  Masses
  random_rows(const unsigned int seed, const bool with_friction)
  {
    std::mt19937                           random(seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    Masses                                 all(std::vector<double>(60));
    for (double &mass : all.mass)
      mass = std::exp(3. * number(random));
    for (Tensor<1, dim> &v : all.velocity)
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = number(random);
    for (unsigned int k = 0; k < 80; ++k)
      {
        Masses::Row row;
        row.entries.emplace_back(random() % 30, 1.);
        double rest = 1.;
        for (unsigned int m = 0; m < 3; ++m)
          {
            const double part = m < 2 ? rest * 0.5 * (1. + number(random)) : rest;
            row.entries.emplace_back(30 + (7 * k + 11 * m) % 30, -part);
            rest -= part;
          }
        for (unsigned int d = 0; d < dim; ++d)
          row.normal[d] = number(random) + (d == 2 ? 2. : 0.);
        row.normal /= row.normal.norm();
        row.allowed = k % 3 == 0 ? 0. : 0.3 * (1. + number(random));
        all.rows.push_back(row);
      }
    if (with_friction)
      all.add_friction(0.4);
    return all;
  }

  void
  any_sweeps()
  {
    double gain = 0., drift = 0.;
    for (const bool with_friction : {false, true})
      for (unsigned int seed = 0; seed < 10; ++seed)
        for (const unsigned int sweeps : {1, 2, 3, 5, 10, 40})
          {
            Masses         all = random_rows(seed, with_friction);
            ImpulseControl control;
            control.sweeps = sweeps;
            all.solve(control);
            const double before = all.energy(all.velocity);
            gain                = std::max(gain, all.energy(all.result) / before - 1.);
            drift               = std::max(drift,
                             (all.momentum(all.result) - all.momentum(all.velocity)).norm() /
                               std::sqrt(before));
          }
    print("no energy is gained, wherever sweeps end", gain <= 1e-14);
    print("momentum is kept, wherever sweeps end", drift <= 1e-13);
  }

  void
  optimal()
  {
    double       worst = 0.;
    unsigned int most  = 0;
    for (unsigned int seed = 0; seed < 10; ++seed)
      {
        Masses         all = random_rows(seed, false);
        ImpulseControl control;
        control.sweeps = 100000;
        all.solve(control);
        most = std::max(most, all.counts.sweeps);
        // Each row open or pressed, and the impulses are what changes the velocities.
        for (std::size_t k = 0; k < all.rows.size(); ++k)
          {
            const Masses::Row &row = all.rows[k];
            const double       gap = all.relative(row) * row.normal + row.allowed,
                         p         = all.impulses[k] * row.normal;
            worst                  = std::max({worst, -gap, -p, std::min(gap, p)});
          }
      }
    print("complementarity of random rows", worst <= 1e-8);
    print("fewer than 20000 sweeps", most < 20000);
  }

  /** Each rank solves alone what all solve together. */
  void
  bits()
  {
    bool same = true;
    for (const bool with_friction : {false, true})
      for (unsigned int seed = 0; seed < 5; ++seed)
        {
          Masses together = random_rows(seed, with_friction), alone = together;
          together.solve({});
          alone.solve({}, MPI_COMM_SELF);
          for (std::size_t i = 0; i < together.result.size(); ++i)
            for (unsigned int d = 0; d < dim; ++d)
              same = same && together.result[i][d] == alone.result[i][d];
        }
    print("same bits on any number of ranks",
          Utilities::MPI::min(same ? 1 : 0, MPI_COMM_WORLD) == 1);
  }



  void
  driven_into_each_other()
  {
    Masses two({1., 1.});
    two.fixed       = {true, true};
    two.velocity[0] = -1. * z;
    two.rows        = {{{{0, 1.}, {1, -1.}}, z}};
    two.solve({});
    print("prescribed on both sides: no impulse", two.impulses[0].norm() == 0.);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  two_masses();
  corner();
  coulomb();
  any_sweeps();
  optimal();
  driven_into_each_other();
  bits();
  return 0;
}
