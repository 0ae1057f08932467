// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/solid/resultant_load.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <limits>

// How forces and moments on boundaries change with the displacement (doc/theory.md 2.3). The mean
// position and the inertia depend on all nodes of the boundary; as if it moved linearly in space,
// they follow a few of them, so that no node is coupled to all others.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The matrix of the cross product with a vector from the left. */
    Tensor<2, dim>
    cross(const Tensor<1, dim> &a)
    {
      Tensor<2, dim> result;
      for (unsigned int j = 0; j < dim; ++j)
        {
          const Tensor<1, dim> column = cross_product_3d(a, Point<dim>::unit_vector(j));
          for (unsigned int i = 0; i < dim; ++i)
            result[i][j] = column[i];
        }
      return result;
    }

    Tensor<2, dim>
    multiple_of_identity(const double factor)
    {
      return Tensor<2, dim>(factor * unit_symmetric_tensor<dim>());
    }
  } // namespace



  void
  ResultantLoad::choose_outermost()
  {
    // Of this rank, then of all: the farthest along each axis, of equal ones the last in the order
    // of coordinates.
    std::vector<OutermostNode> nodes;
    std::vector<Index>         dofs(solid.fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              cell->get_dof_indices(dofs);
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (solid.fe.system_to_component_index(i).first == 0 &&
                    solid.fe.has_support_on_face(i, f) && !solid.hanging.is_constrained(dofs[i]))
                  nodes.push_back(
                    {dofs[i],
                     solid.mapping.transform_unit_to_real_cell(cell,
                                                               solid.fe.unit_support_point(i))});
            }
    const auto keep_outermost = [](const std::vector<OutermostNode> &all) {
      std::vector<OutermostNode> result;
      for (unsigned int k = 0; k < 2 * dim && !all.empty(); ++k)
        {
          const double sign = k % 2 == 0 ? 1. : -1.;
          const auto   last = std::max_element(
            all.begin(), all.end(), [&](const OutermostNode &a, const OutermostNode &b) {
              const double x = sign * a.position[k / 2], y = sign * b.position[k / 2];
              return x != y ? x < y
                              : std::lexicographical_compare(&a.position[0],
                                                           &a.position[0] + dim,
                                                           &b.position[0],
                                                           &b.position[0] + dim);
            });
          if (std::none_of(result.begin(), result.end(), [&](const OutermostNode &node) {
                return node.dof == last->dof;
              }))
            result.push_back(*last);
        }
      return result;
    };
    outermost = keep_outermost(gather_all(keep_outermost(nodes), solid.communicator));
  }



  std::vector<ResultantLoad::Follower>
  ResultantLoad::followers(const Vector &u, const Place &place) const
  {
    const std::size_t   n = outermost.size();
    std::vector<double> shifts(dim * n);
    for (std::size_t k = 0; k < n; ++k)
      if (solid.owned.is_element(outermost[k].dof))
        for (unsigned int d = 0; d < dim; ++d)
          shifts[dim * k + d] = u(outermost[k].dof + d);
    Utilities::MPI::sum(shifts, solid.communicator, shifts);
    std::vector<Tensor<1, dim>> r(n);
    Tensor<1, dim>              mean;
    for (std::size_t k = 0; k < n; ++k)
      {
        r[k] = outermost[k].position - place.mean;
        for (unsigned int d = 0; d < dim; ++d)
          r[k][d] += shifts[dim * k + d];
        mean += r[k] / static_cast<double>(n);
      }
    Tensor<2, dim> q;
    for (const Tensor<1, dim> &x : r)
      q += outer_product(x - mean, x - mean);
    // Across a plane boundary there is nothing to divide.
    constexpr double      singular = 1e-9;
    const Tensor<2, dim>  inverse  = invert(q + multiple_of_identity(singular * trace(q)));
    std::vector<Follower> result(n);
    for (std::size_t k = 0; k < n; ++k)
      {
        result[k].gradient = inverse * (r[k] - mean);
        result[k].weight   = 1. / static_cast<double>(n) - result[k].gradient * mean;
      }
    return result;
  }



  void
  ResultantLoad::add_stiffness(const double              t,
                               const Vector             &u,
                               const bool                symmetric,
                               std::vector<RankOneTerm> &terms) const
  {
    const Vector   ghosted = solid.ghosted(u);
    const Place    at      = place(ghosted);
    Tensor<1, dim> force, moment;
    for (unsigned int k = 0; k < 2 * dim; ++k)
      if (values[k])
        (k < dim ? force : moment)[k % dim] = values[k]->value(Point<dim>(), t);
    const Tensor<1, dim> arm   = at.point - at.mean,
                         spin  = at.inverse_inertia * (moment + cross_product_3d(arm, force)),
                         along = at.second * spin;
    // How c and J^{-1} M_c follow each of the outermost nodes.
    const std::vector<Follower> follow = followers(u, at);
    std::vector<Tensor<2, dim>> of_spin;
    for (const Follower &node : follow)
      {
        const Tensor<1, dim> g      = at.second * node.gradient;
        Tensor<2, dim>       change = multiple_of_identity(node.gradient * along) +
                                outer_product(g, spin) - 2. * outer_product(spin, g);
        // A point on an arm turns with the boundary.
        if (arm.norm() > 0.)
          change += (outer_product(arm, force) - multiple_of_identity(force * arm)) *
                    invert(multiple_of_identity(trace(at.stretch)) - at.stretch) *
                    cross(at.stretch * node.gradient);
        of_spin.push_back(at.inverse_inertia * change);
      }

    const FEValuesExtractors::Vector displacement(0);
    FEFaceValues<dim>                face(solid.mapping,
                           solid.fe,
                           QGauss<dim - 1>(solid.fe.degree + 2),
                           update_values | update_JxW_values | update_quadrature_points);
    std::vector<Tensor<1, dim>>      moved(face.n_quadrature_points);
    std::vector<Index>               dofs(solid.fe.n_dofs_per_cell());
    const Tensor<2, dim>             turn = cross(spin);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              face.reinit(cell, f);
              cell->get_dof_indices(dofs);
              face[displacement].get_function_values(ghosted, moved);
              for (unsigned int q = 0; q < face.n_quadrature_points; ++q)
                {
                  const Tensor<1, dim> r = face.quadrature_point(q) + moved[q] - at.mean;
                  // A term for each direction of the force: -N_i dt/du.
                  std::array<RankOneTerm, dim> of_point;
                  for (unsigned int j = 0; j < dofs.size(); ++j)
                    if (const double shape = face.shape_value(j, q); shape != 0.)
                      {
                        const unsigned int component = solid.fe.system_to_component_index(j).first;
                        of_point[component].left.emplace_back(dofs[j], shape * face.JxW(q));
                        for (unsigned int c = 0; c < dim; ++c)
                          of_point[c].right.emplace_back(dofs[j], -shape * turn[c][component]);
                      }
                  for (std::size_t k = 0; k < follow.size(); ++k)
                    {
                      const Tensor<2, dim> change = follow[k].weight * turn + cross(r) * of_spin[k];
                      for (unsigned int c = 0; c < dim; ++c)
                        for (unsigned int d = 0; d < dim; ++d)
                          of_point[c].right.emplace_back(outermost[k].dof + d, change[c][d]);
                    }
                  for (RankOneTerm &term : of_point)
                    {
                      if (symmetric)
                        {
                          for (auto &entry : term.right)
                            entry.second *= 0.5;
                          terms.push_back({term.right, term.left});
                        }
                      terms.push_back(std::move(term));
                    }
                }
            }
  }
} // namespace Touchstone
