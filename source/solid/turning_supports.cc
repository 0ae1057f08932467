// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/bodies.h>
#include <touchstone/solid/turning_supports.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

// Rotations of bodies whose displacements a formula prescribes.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_intervals = 16;

    /** A node whose displacement is prescribed, along the axes that have a condition. */
    struct Node
    {
      Point<dim>                                              position;
      std::array<const BoundaryConditions::Prescribed *, dim> along{};

      /** What turns the node, if anything does: a displacement that is the same everywhere does
       * not, nor does one that stays as it is. */
      const BoundaryConditions::Prescribed *
      turned_by() const
      {
        if (std::count(along.begin(), along.end(), nullptr) < 2)
          for (const BoundaryConditions::Prescribed *entry : along)
            if (entry && entry->value && entry->value->depends_on_position() &&
                entry->value->depends_on_time())
              return entry;
        return nullptr;
      }
      Tensor<1, dim>
      at(const double t) const
      {
        Tensor<1, dim> result(position);
        for (unsigned int d = 0; d < dim; ++d)
          if (along[d])
            result[d] += along[d]->displacement(t);
        return result;
      }
    };

    std::vector<Node>
    turned_nodes(const BoundaryConditions &conditions)
    {
      std::map<Index, Node> all;
      for (const BoundaryConditions::Prescribed &entry : conditions.prescribed_directions())
        for (unsigned int d = 0; d < dim; ++d)
          if (entry.direction == Tensor<1, dim>(Point<dim>::unit_vector(d)))
            {
              Node &node    = all[entry.node];
              node.position = entry.position;
              // The first condition is the one that holds.
              if (!node.along[d])
                node.along[d] = &entry;
            }
      std::vector<Node> result;
      for (const auto &[index, node] : all)
        if (node.turned_by())
          result.push_back(node);
      return result;
    }

    /** |r|^2 1 - r r^T. */
    Tensor<2, dim>
    inertia_of(const Tensor<1, dim> &r)
    {
      return r.norm_square() * Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(r, r);
    }

    /** Sums over the nodes of a boundary that move from one place to another, with r the mean of
     * their distances from a centre at both and m the motion. */
    struct Sums
    {
      double         n = 0.;
      Tensor<1, dim> r, m, moment; // moment: r x m
      Tensor<2, dim> inertia;

      void
      add(const Tensor<1, dim> &before, const Tensor<1, dim> &after)
      {
        const Tensor<1, dim> middle = 0.5 * (before + after), motion = after - before;
        n += 1.;
        r += middle;
        m += motion;
        moment += cross_product_3d(middle, motion);
        inertia += inertia_of(middle);
      }

      /** Collective. */
      Sums
      over_all_ranks(const MPI_Comm communicator) const
      {
        using Utilities::MPI::sum;
        return {sum(n, communicator),
                sum(r, communicator),
                sum(m, communicator),
                sum(moment, communicator),
                sum(inertia, communicator)};
      }

      /** The rotation about the centre of the nodes that fits best; degrees. */
      Tensor<1, dim>
      rotation() const
      {
        if (n == 0.)
          return {};
        const Tensor<2, dim> of = inertia - inertia_of(r) / n;
        // Nodes on a line do not tell how it turns about itself.
        if (determinant(of) <= 1e-10 * std::pow(trace(of), 3))
          return {};
        const Tensor<1, dim> w    = invert(of) * (moment - cross_product_3d(r, m) / n);
        const double         size = w.norm();
        // A rotation by theta moves each node by 2 tan(theta / 2) times its mean distance.
        return size == 0. ? w : w * (2. * std::atan(0.5 * size) / size * 180. / numbers::PI);
      }
    };
  } // namespace



  std::vector<Tensor<1, dim>>
  turns_of_supports(const Solid              &solid,
                    const BoundaryConditions &conditions,
                    const double              from,
                    const double              to)
  {
    std::vector<Tensor<1, dim>> result(solid.bodies.size());
    const std::vector<Node>     nodes = turned_nodes(conditions);
    if (Utilities::MPI::max(static_cast<unsigned int>(nodes.size()), solid.communicator) == 0)
      return result;

    const std::vector<RigidFrame>              frames   = rigid_frames(solid);
    const std::vector<Reaction>               &supports = conditions.reaction_names();
    std::vector<std::array<Sums, n_intervals>> of_supports(supports.size());
    for (const Node &node : nodes)
      {
        const BoundaryConditions::Prescribed &entry  = *node.turned_by();
        const Point<dim>                     &centre = frames[entry.body].centre;
        Tensor<1, dim>                        before = node.at(from) - centre;
        for (unsigned int i = 0; i < n_intervals; ++i)
          {
            const Tensor<1, dim> after =
              node.at(from + (i + 1.) / n_intervals * (to - from)) - centre;
            of_supports[entry.support][i].add(before, after);
            before = after;
          }
      }
    conditions.all_formulas().check(solid.communicator);

    // Of several boundaries of a body the one that turns most.
    for (std::size_t s = 0; s < supports.size(); ++s)
      {
        Tensor<1, dim> turn;
        for (const Sums &sums : of_supports[s])
          turn += sums.over_all_ranks(solid.communicator).rotation();
        for (std::size_t b = 0; b < solid.bodies.size(); ++b)
          if (solid.bodies[b].name == supports[s].body && turn.norm() > result[b].norm())
            result[b] = turn;
      }
    return result;
  }
} // namespace Touchstone
