// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/contact_counts.h>
#include <touchstone/contact/results.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

// Results of contact as plain data for output: per slave node, per slave face and per pair. Rows
// whose stencil contains other slave nodes (doc/theory.md 3.1) stand for the forces on all of them;
// `share` and `lever` of the row convert its values to those of the surfaces.
namespace Touchstone
{
  using namespace dealii;

  // A row yields force, area and gap of its slave node; with neighbours in its stencil the force on
  // all slave nodes together is `share` times that, and so is the area. The pressure lambda / A
  // needs no conversion, for the share cancels.
  ContactPoint
  contact_point(const Contact &contact, const ContactRow &row, const Vector &u)
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
    // A gap of the size of round-off is reported as zero, so that results compare.
    point.gap  = std::abs(row.gap) > 1e-14 * row.size ? row.gap / row.share : 0.;
    point.area = row.area * row.share;
    // Rows between nodes touch in a point: they have a force, but no pressure.
    point.force = row.share * (state.force + extra);
    if (!row.between_nodes)
      {
        point.pressure = (state.lambda + extra * row.normal) / row.area;
        point.traction = (state.force + extra) / row.area;
        point.force    = point.area * point.traction;
      }
    point.lever  = row.lever;
    point.status = state.status;
    if (row.friction)
      {
        point.slip          = row.friction->kinematics.slip;
        point.slip_length   = row.friction->history.slip_length;
        point.friction_work = row.friction->history.work;
      }
    return point;
  }



  namespace
  {
    /** The slave nodes beside an owned one that leaves its part of all faces around it to them
     * (Face::without_row), once for each face; none for other nodes. */
    std::vector<Index>
    receivers(const Surface &surface, const Index node)
    {
      std::vector<Index> result;
      for (const auto &[face, m] : surface.faces_around(node))
        for (unsigned int k = 0; face->without_row[m] && k < face->n_nodes(); ++k)
          if (!face->without_row[k])
            result.push_back(face->nodes[k]);
      return result;
    }

    /** Nodes whose rows have been left to others of their faces (doc/theory.md 3.1, "Edges where
     * pairs meet") have the mean of their tractions, without an area: that is counted where the
     * forces are. Collective. */
    void
    fill_junctions(const Contact &contact, std::vector<ContactPoint> &points)
    {
      std::vector<std::pair<ContactPoint *, std::vector<Index>>> to_fill;
      for (ContactPoint &point : points)
        if (const Surface &surface = contact.pair(point.pair).slave();
            point.status == ContactStatus::no_partner)
          if (std::vector<Index> from = receivers(surface, point.node); !from.empty())
            to_fill.emplace_back(&point, std::move(from));
      if (Utilities::MPI::max(static_cast<int>(!to_fill.empty()), contact.communicator()) == 0)
        return;
      for (unsigned int p = 0; p < contact.n_pairs(); ++p)
        {
          Vector tractions(contact.solid_model().owned, contact.communicator()),
            pressures(tractions);
          for (const ContactPoint &point : points)
            if (point.pair == p)
              {
                for (unsigned int d = 0; d < dim; ++d)
                  tractions(dim * point.node + d) = point.traction[d];
                pressures(dim * point.node) = point.pressure;
              }
          tractions.compress(VectorOperation::insert);
          pressures.compress(VectorOperation::insert);
          const Vector all_tractions = contact.with_ghosts(tractions),
                       all_pressures = contact.with_ghosts(pressures);
          for (auto &[point, from] : to_fill)
            if (point->pair == p)
              {
                for (const Index node : from)
                  {
                    point->pressure += all_pressures(dim * node) / from.size();
                    for (unsigned int d = 0; d < dim; ++d)
                      point->traction[d] += all_tractions(dim * node + d) / from.size();
                  }
                point->area = 0.;
              }
        }
    }
  } // namespace



  std::vector<ContactPoint>
  contact_points(const Contact &contact, const Vector &u)
  {
    std::vector<ContactPoint>                                result;
    std::map<std::pair<unsigned int, Index>, Tensor<1, dim>> between;
    for (const ContactRow &row : contact.rows())
      {
        const ContactPoint point = contact_point(contact, row, u);
        if (!row.between_nodes)
          result.push_back(point);
        else if (point.status >= ContactStatus::slip)
          between[{point.pair, point.node}] += point.force;
      }
    // What touches between nodes counts as a force on the slave node of the row, which has a row of
    // its own: so the forces of the nodes add up to that of the pair.
    for (ContactPoint &point : result)
      if (const auto found = between.find({point.pair, point.node}); found != between.end())
        point.force += found->second;
    fill_junctions(contact, result);
    return result;
  }



  namespace
  {
    void
    add_faces(const Surface &surface, const unsigned int pair, std::vector<ContactFace> &result)
    {
      for (const Face &face : surface.owned_faces())
        {
          result.push_back({pair, face.degree, face.nodes});
          // A hanging node has no result: its values follow from the nodes of the larger face
          // (doc/theory.md 11, "Hanging nodes").
          if (const TraceBasis *basis = surface.trace(face))
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              {
                const Stencil follows = basis->stencil(m);
                if (follows.size() != 1 || follows[0].node != face.nodes[m])
                  result.back().hanging.push_back({face.nodes[m], face.reference[m], follows});
              }
        }
    }
  } // namespace



  std::vector<ContactFace>
  contact_faces(const Contact &contact)
  {
    std::vector<ContactFace> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      add_faces(contact.pair(p).slave(), p, result);
    return result;
  }



  std::vector<ContactFace>
  master_faces(const Contact &contact)
  {
    std::vector<ContactFace> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      if (const Surface *master = contact.pair(p).master())
        add_faces(*master, p, result);
    return result;
  }



  std::vector<PairResult>
  pair_results(const Contact &contact, const Vector &u)
  {
    // Sums without round-off, which do not depend on the partition.
    struct Sums
    {
      std::array<ExactSum, dim> force, moment;
      ExactSum                  area, friction_work;
    };
    std::vector<PairResult> all(contact.n_pairs());
    std::vector<Sums>       sums(contact.n_pairs());
    for (const ContactRow &row : contact.rows())
      {
        const ContactPoint point  = contact_point(contact, row, u);
        PairResult        &result = all[point.pair];
        Sums              &sum    = sums[point.pair];
        // Before the test for contact: work that was done stays, also when the node has opened
        // since.
        sum.friction_work.add(point.friction_work);
        if (point.status != ContactStatus::no_partner && point.status != ContactStatus::tied)
          result.max_penetration = std::max(result.max_penetration, -point.gap);
        if (point.status < ContactStatus::slip)
          continue;
        const Tensor<1, dim> &force = point.force;
        // About the origin, in the deformed state, at the point where the force acts: for rows with
        // neighbours that is not the node.
        const Tensor<1, dim> moment =
          cross_product_3d(point.reference_position + point.displacement + point.lever, force);
        for (unsigned int d = 0; d < dim; ++d)
          {
            sum.force[d].add(force[d]);
            sum.moment[d].add(moment[d]);
          }
        sum.area.add(point.area);
        result.max_pressure = std::max(result.max_pressure, point.pressure);
        ++result.active;
        ++(point.status == ContactStatus::slip ? result.slip : result.stick);
      }
    // One reduction per value: there are few pairs. All ranks have all pairs, even those of which
    // they own no row.
    const MPI_Comm communicator = contact.communicator();
    for (std::size_t p = 0; p < all.size(); ++p)
      {
        PairResult &result = all[p];
        for (unsigned int d = 0; d < dim; ++d)
          {
            result.force[d]  = sums[p].force[d].value(communicator);
            result.moment[d] = sums[p].moment[d].value(communicator);
          }
        result.mean_force      = contact.mean_force(p).value_or(result.force);
        result.area            = sums[p].area.value(communicator);
        result.max_pressure    = Utilities::MPI::max(result.max_pressure, communicator);
        result.max_penetration = Utilities::MPI::max(result.max_penetration, communicator);
        result.active          = Utilities::MPI::sum(result.active, communicator);
        result.slip            = Utilities::MPI::sum(result.slip, communicator);
        result.friction_work =
          sums[p].friction_work.value(communicator) + contact.friction_work_of_former_rows(p);
        result.stick = Utilities::MPI::sum(result.stick, communicator);
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
        for (const ContactRow &row : pair.rows())
          sum.slave_rows += !row.between_nodes;
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
