// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/boundary_faces.h>
#include <touchstone/drive/refinement.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// Master faces follow the slave faces that they meet, since finer slave faces have pressures that
// oscillate (doc/theory.md 11, "Marking").
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Mean side length of a face, length: the square root of its area. */
    template <class Cell>
    double
    size(const Cell &cell, const unsigned int f)
    {
      return std::sqrt(cell->face(f)->measure());
    }

    /** Side length that the face will have after the marked refinement or coarsening. */
    template <class Cell>
    double
    size_to_come(const Cell &cell, const unsigned int f)
    {
      const double factor = cell->refine_flag_set() ? 0.5 : cell->coarsen_flag_set() ? 2. : 1.;
      return factor * size(cell, f);
    }

    /**
     * Exponent of a p-norm that stands for a maximum: the smallest face size at a node is obtained
     * as (sum 1/h^16)^(-1/16), since vectors are summed and not maximised over ranks. Ten equal
     * faces make an error of 15 per cent, while the sizes of refined meshes differ by factors of
     * two.
     */
    constexpr double sharpness = 16.;
  } // namespace



  Vector
  Refinement::faces_at_masters(const Step           &problem,
                               const unsigned int    pair,
                               const PairBoundaries &boundaries,
                               const double          length,
                               const bool            refined_only) const
  {
    Vector at_slaves(solid.zero_vector()), at_masters(at_slaves);
    for_each_face(solid,
                  boundaries.slave_body,
                  boundaries.slave,
                  [&](const auto &cell, const unsigned int f) {
                    if (refined_only && !cell->refine_flag_set())
                      return;
                    // length is at least the size of any face to come, so that the ratios are at
                    // least one and their 16th power neither over- nor underflows.
                    const double finer = length / size_to_come(cell, f);
                    for (const Index node : face_nodes(solid, cell, f))
                      at_slaves(node) += std::pow(finer, sharpness);
                  });
    at_slaves.compress(VectorOperation::add);
    // Hanging nodes have no row: their part goes to the nodes that they follow.
    solid.condense(at_slaves);
    // Each active row passes the face size at its slave node on to the master nodes in its stencil.
    // Negative weights occur (dual basis) and are left out, as they would spoil the root.
    for (const ContactRow &row : problem.state().contact.pair(pair).rows())
      if (problem.state().contact.state(row).active())
        if (const double value = at_slaves(dim * row.slave); value > 0.)
          for (const StencilEntry &entry : row.at_surface ? *row.at_surface : row.stencil)
            if (entry.weight > 0.)
              at_masters(dim * entry.node) += entry.weight * value;
    at_masters.compress(VectorOperation::add);
    return solid.ghosted(at_masters);
  }



  bool
  Refinement::follow_slaves(const Step &problem)
  {
    int        changes = 0;
    const auto pairs   = pair_boundaries(problem.state().contact);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        // An obstacle has no mesh.
        if (pairs[p].master.empty())
          continue;
        double length = 0.;
        for_each_face(solid,
                      pairs[p].slave_body,
                      pairs[p].slave,
                      [&](const auto &cell, const unsigned int f) {
                        // Twice the largest slave face, since coarsening doubles sizes.
                        length = std::max(length, 2. * size(cell, f));
                      });
        length = Utilities::MPI::max(length, solid.communicator);
        // Two fields: refinement of master faces follows the refined slave faces only, for the
        // initial mesh is the user's choice; but no master face is coarsened beyond any slave face
        // it meets.
        const Vector refined = faces_at_masters(problem, p, pairs[p], length, true),
                     all     = faces_at_masters(problem, p, pairs[p], length, false);
        for_each_face(solid,
                      pairs[p].master_body,
                      pairs[p].master,
                      [&](const auto &cell, const unsigned int f) {
                        const auto coarse = [&](const Vector &slaves) {
                          double finest_slave = 0.;
                          for (const Index node : face_nodes(solid, cell, f))
                            finest_slave = std::max(finest_slave, slaves(node));
                          return finest_slave > 0. &&
                                 size_to_come(cell, f) >
                                   // The factor 1.4, about the square root of two, lies halfway
                                   // between equal size and one level coarser.
                                   1.4 * length * std::pow(finest_slave, -1. / sharpness);
                        };
                        if (cell->coarsen_flag_set() && coarse(all))
                          {
                            cell->clear_coarsen_flag();
                            changes = 1;
                          }
                        if (!cell->refine_flag_set() && cell->level() < finest_level() &&
                            coarse(refined))
                          {
                            cell->clear_coarsen_flag();
                            cell->set_refine_flag();
                            changes = 1;
                          }
                      });
      }
    return Utilities::MPI::max(changes, solid.communicator) == 1;
  }
} // namespace Touchstone
