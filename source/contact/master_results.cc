// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/results.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Results of contact on the master side. A row acts with -w_m f on the node m of its stencil
// (doc/theory.md 3): in the same way its area, its normal force and its gap are spread over these
// nodes, so that pressure times area adds up to the force on this side as well.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What rows of a pair leave at the nodes of their stencils, in vectors over the dofs. */
    struct Spread
    {
      /** Contact force. */
      Vector force;
      /** Area; area times pressure; area times gap. */
      Vector means;
    };



    /** Three numbers at a node. */
    using Triple = Tensor<1, dim>;

    void
    add(const ContactRow    &row,
        const double         factor,
        const Triple        &values,
        std::vector<Index>  &dofs,
        std::vector<double> &entries)
    {
      // What carries an offset acts behind the surface as well, and its sum is zero.
      for (const StencilEntry &entry : row.at_surface ? *row.at_surface : row.stencil)
        for (unsigned int d = 0; d < dim; ++d)
          {
            dofs.push_back(dim * entry.node + d);
            entries.push_back(factor * entry.weight * values[d]);
          }
    }



    /** Collective, for nodes of a stencil may belong to any rank. */
    Spread
    spread(const Contact &contact, const unsigned int pair, const Vector &u)
    {
      const Solid &solid = contact.solid_model();
      Spread       result{solid.zero_vector(), solid.zero_vector()};

      std::vector<Index>  force_dofs, mean_dofs;
      std::vector<double> forces, means;
      for (const ContactRow &row : contact.pair(pair).rows())
        {
          if (!row.has_partner)
            continue;
          const ContactPoint point = contact_point(contact, row, u);
          // Of a row with other slave nodes in its stencil the weights of master nodes add up to
          // its share.
          if (point.status >= ContactStatus::slip)
            add(row, -1. / row.share, point.force, force_dofs, forces);
          if (!row.between_nodes)
            add(row, row.area, Triple({1., point.pressure, point.gap}), mean_dofs, means);
        }
      result.force.add(force_dofs, forces);
      result.force.compress(VectorOperation::add);
      result.means.add(mean_dofs, means);
      result.means.compress(VectorOperation::add);
      // Hanging nodes give what they have to those that they follow.
      solid.condense(result.force);
      solid.condense(result.means);
      return result;
    }
  } // namespace



  std::vector<ContactPoint>
  master_points(const Contact &contact, const Vector &u)
  {
    std::vector<ContactPoint> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const Surface *master = contact.pair(p).master())
        {
          const Spread sums = spread(contact, p, u);
          for (const SurfaceNode &node : master->owned_nodes())
            {
              ContactPoint point{};
              point.pair               = p;
              point.node               = node.node;
              point.reference_position = node.reference;
              point.displacement       = nodal_value(u, node.node);
              point.normal             = master->normal(node.node);
              point.force              = nodal_value(sums.force, node.node);
              point.status             = ContactStatus::no_partner;
              const Triple means       = nodal_value(sums.means, node.node);
              // No row, or, with weights of either sign, rows that leave nothing.
              if (means[0] > 1e-6 * node.area)
                {
                  point.area     = means[0];
                  point.pressure = means[1] / means[0];
                  point.traction = point.force / means[0];
                  point.gap      = means[2] / means[0];
                  point.status   = contact.pair(p).tied()           ? ContactStatus::tied
                                   : point.force.norm_square() > 0. ? ContactStatus::slip
                                                                    : ContactStatus::open;
                }
              result.push_back(point);
            }
        }
    return result;
  }
} // namespace Touchstone
