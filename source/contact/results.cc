// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_counts.h>
#include <touchstone/contact/results.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Touchstone
{
  using namespace dealii;

  std::vector<ContactPoint>
  contact_points(const Contact &contact, const Vector &u)
  {
    std::vector<ContactPoint> result;
    for (const ContactRow &row : contact.rows())
      {
        const RowState       &state = contact.state(row);
        const Tensor<1, dim> &extra = contact.impulse_force(row);
        ContactPoint          point;
        point.pair               = row.pair;
        point.node               = row.slave;
        point.reference_position = row.reference;
        for (unsigned int d = 0; d < dim; ++d)
          point.displacement[d] = u(dim * row.slave + d);
        point.normal = row.normal;
        // What round-off leaves of positions is none.
        point.gap      = std::abs(row.gap) > 1e-14 * row.size ? row.gap / row.share : 0.;
        point.area     = row.area * row.share;
        point.pressure = (state.lambda + extra * row.normal) / row.area;
        point.traction = (state.force + extra) / row.area;
        point.lever    = row.lever;
        point.status   = state.status;
        if (row.friction)
          {
            point.slip          = row.friction->kinematics.slip;
            point.slip_length   = row.friction->history.slip_length;
            point.friction_work = row.friction->history.work;
          }
        result.push_back(point);
      }
    return result;
  }



  std::vector<ContactFace>
  contact_faces(const Contact &contact)
  {
    std::vector<ContactFace> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const Surface &slave = contact.pair(p).slave();
        for (const Face &face : slave.owned_faces())
          {
            result.push_back({p, face.degree, face.nodes});
            if (const TraceBasis *basis = slave.trace(face))
              for (unsigned int m = 0; m < face.n_nodes(); ++m)
                {
                  const Stencil follows = basis->stencil(m);
                  if (follows.size() != 1 || follows[0].node != face.nodes[m])
                    result.back().hanging.push_back({face.nodes[m], face.reference[m], follows});
                }
          }
      }
    return result;
  }



  std::vector<PairResult>
  pair_results(const Contact &contact, const Vector &u)
  {
    std::vector<PairResult> all(contact.n_pairs());
    for (const ContactPoint &point : contact_points(contact, u))
      {
        PairResult &result = all[point.pair];
        result.friction_work += point.friction_work;
        if (point.status != ContactStatus::no_partner && point.status != ContactStatus::tied)
          result.max_penetration = std::max(result.max_penetration, -point.gap);
        if (point.status < ContactStatus::slip)
          continue;
        const Tensor<1, dim> force = point.area * point.traction;
        result.force += force;
        result.moment +=
          cross_product_3d(point.reference_position + point.displacement + point.lever, force);
        result.area += point.area;
        result.max_pressure = std::max(result.max_pressure, point.pressure);
        ++result.active;
        ++(point.status == ContactStatus::slip ? result.slip : result.stick);
      }
    const MPI_Comm communicator = contact.communicator();
    for (PairResult &result : all)
      {
        result.force           = Utilities::MPI::sum(result.force, communicator);
        result.moment          = Utilities::MPI::sum(result.moment, communicator);
        result.area            = Utilities::MPI::sum(result.area, communicator);
        result.max_pressure    = Utilities::MPI::max(result.max_pressure, communicator);
        result.max_penetration = Utilities::MPI::max(result.max_penetration, communicator);
        result.active          = Utilities::MPI::sum(result.active, communicator);
        result.slip            = Utilities::MPI::sum(result.slip, communicator);
        result.friction_work   = Utilities::MPI::sum(result.friction_work, communicator);
        result.stick           = Utilities::MPI::sum(result.stick, communicator);
      }
    return all;
  }



  ContactCounts
  contact_counts(const Contact &contact)
  {
    ContactCounts sum;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        sum.slave_rows += pair.rows().size();
        if (pair.master())
          sum.master_faces += pair.master()->owned_faces().size();
        sum.search += pair.pairing().search_work();
      }
    return sum;
  }



  std::vector<PairBoundaries>
  pair_boundaries(const Contact &contact)
  {
    std::vector<PairBoundaries> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        result.push_back(
          {pair.slave_body(),
           pair.master_body(),
           pair.slave().boundaries(),
           pair.master() ? pair.master()->boundaries() : std::set<types::boundary_id>()});
      }
    return result;
  }
} // namespace Touchstone
