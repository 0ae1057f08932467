// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/cell_mass.h>
#include <touchstone/solid/mass.h>

#include <deal.II/base/mpi.h>

// The mass matrix: consistent, lumped, or integrated with points that depend on the Courant
// number (cell_mass.cc). Contact nodes can be made massless, so that their contact forces do not
// oscillate in time; their mass goes to the other nodes of the cell, and factors on the densities
// (density_factors.cc) restore what each body loses by that.
namespace Touchstone
{
  using namespace dealii;

  Mass::Mass(const MassKind         kind,
             const Solid           &solid,
             const std::set<Index> &massless,
             const double           step)
    : nodal(solid.zero_vector())
    , diagonal(kind == MassKind::lumped)
    , any_massless(Utilities::MPI::max(massless.size(), solid.communicator) > 0)
  {
    Vector flag(solid.zero_vector());
    for (const Index node : massless)
      flag(node) = 1.;
    flag.compress(VectorOperation::insert);
    // Cells need the flags of their ghost nodes as well.
    const Vector              no_mass = solid.ghosted(flag);
    const std::vector<double> factors = density_factors(kind, solid, massless, no_mass, step);
    if (!diagonal)
      matrix.reinit(solid.stiffness());
    CellMass                  mass(kind, solid, no_mass, step);
    const unsigned int        n = mass.nodes.size();
    std::vector<int>          rows(n);
    std::vector<unsigned int> nodes(n);
    // Ghost cells are integrated by each rank that has rows of them, as for the stiffness;
    // densities of ghost cells were exchanged, so that ranks agree.
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        mass.reinit(cell);
        mass.moved *= factors[cell->active_cell_index()];
        bool any = false;
        for (unsigned int a = 0; a < n; ++a)
          {
            rows[a] = solid.stiffness().row(mass.nodes[a]);
            any     = any || rows[a] >= 0;
            if (diagonal && rows[a] >= 0)
              for (unsigned int d = 0; d < dim; ++d)
                nodal.begin()[rows[a] + d] += mass.moved(a, a);
          }
        if (diagonal || !any)
          continue;
        for (unsigned int a = 0; a < n; ++a)
          nodes[a] = matrix.node(mass.nodes[a]);
        matrix.add(n, rows.data(), nodes.data(), [&](const unsigned int i, const unsigned int j) {
          return i % dim == j % dim ? mass.moved(i / dim, j / dim) : 0.;
        });
      }
    if (!diagonal)
      {
        // Row sums by a product with ones: the mass of each node, which the sums over the cells
        // of other ranks include.
        Vector ones(nodal);
        ones = 1.;
        matrix.vmult(nodal, ones);
      }
  }



  void
  Mass::multiply(const Vector &x, Vector &y) const
  {
    if (diagonal)
      {
        y = x;
        y.scale(nodal);
      }
    else
      matrix.vmult(y, x);
  }



  void
  Mass::add_to(Matrix &sum, const Vector &factors) const
  {
    if (diagonal)
      {
        Vector entries(nodal);
        entries.scale(factors);
        sum.add_to_diagonal(entries);
        return;
      }
    sum.add(factors, matrix);
  }
} // namespace Touchstone
