// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/nodal_value.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/results.h>
#include <touchstone/contact/spread_to_master.h>

// Results of contact on the master side. A row acts with -w_m f on the node m of its stencil
// (doc/theory.md 3): in the same way its area, its normal force and its gap are spread over these
// nodes, so that pressure times area adds up to the force on this side as well.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** What the rows of a pair have to spread. */
    struct Shares
    {
      std::vector<RowShare> forces;
      /** Area; area times pressure; area times gap. */
      std::vector<RowShare> means;
      /** Area times traction. */
      std::vector<RowShare> tractions;
    };



    Shares
    shares_of(const Contact &contact, const unsigned int pair, const Vector &u)
    {
      Shares result;
      for (const ContactRow &row : contact.pair(pair).rows())
        {
          if (!row.has_partner)
            continue;
          const ContactPoint point = contact_point(contact, row, u);
          // What carries an offset acts behind the surface as well, and its sum is zero.
          const Stencil *const stencil = row.at_surface ? row.at_surface.get() : &row.stencil;
          const bool           touches = point.status >= ContactStatus::slip;
          // Of a row with other slave nodes in its stencil the weights of master nodes add up to
          // its share.
          if (touches)
            result.forces.push_back({stencil, row.share, -point.force / row.share});
          if (row.between_nodes)
            continue;
          result.means.push_back(
            {stencil,
             row.share,
             Tensor<1, dim>({row.area, row.area * point.pressure, row.area * point.gap})});
          if (touches)
            result.tractions.push_back({stencil, row.share, -row.area * point.traction});
        }
      return result;
    }
  } // namespace



  std::vector<double>
  areas_on_master(const Contact &contact, const unsigned int pair)
  {
    const Shares        shares = shares_of(contact, pair, contact.ghosted_displacement());
    const Vector        means  = spread(contact.solid_model(), shares.means);
    std::vector<double> result;
    for (const SurfaceNode &node : contact.pair(pair).master()->owned_nodes())
      result.push_back(means(dim * node.node));
    return result;
  }



  std::vector<ContactPoint>
  master_points(const Contact &contact, const Vector &u)
  {
    const Solid              &solid = contact.solid_model();
    std::vector<ContactPoint> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const Surface *master = contact.pair(p).master())
        {
          const Shares         shares = shares_of(contact, p, u);
          const PositiveSpread spread_means(solid, *master, shares.means);
          const Vector         forces = spread(solid, shares.forces),
                       all_means      = spread_means(shares.means),
                       tractions      = spread_means(shares.tractions);
          for (const SurfaceNode &node : master->owned_nodes())
            {
              ContactPoint point{};
              point.pair                 = p;
              point.node                 = node.node;
              point.reference_position   = node.reference;
              point.displacement         = nodal_value(u, node.node);
              point.normal               = master->normal(node.node);
              point.force                = nodal_value(forces, node.node);
              point.status               = ContactStatus::no_partner;
              const Tensor<1, dim> means = nodal_value(all_means, node.node);
              // No row, or round-off of those that leave nothing.
              if (means[0] > 1e-9 * node.area)
                {
                  point.area     = means[0];
                  point.pressure = means[1] / means[0];
                  point.traction = nodal_value(tractions, node.node) / means[0];
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
