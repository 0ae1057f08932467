#include <touchstone/contact/contact.h>

#include <cmath>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  Tensor<1, dim>
  Contact::position(const Index node) const
  {
    Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = positions(dim * node + d);
    return x;
  }



  Tensor<1, dim>
  Contact::in_plane_rotation(const ContactRow &row, const std::array<Stencil, 2> &tangents) const
  {
    Tensor<1, dim> q[2];
    for (unsigned int a = 0; a < 2; ++a)
      for (const StencilEntry &entry : tangents[a])
        q[a] += entry.weight * position(entry.node);
    // The rotation in the polar decomposition of the surface's deformation in the plane of the
    // normal, doc/theory.md, section 6.2. A surface that faces away from the master surface has
    // none; such rows carry no force.
    const Tensor<1, dim> along     = tangential_projector(row.normal) * q[0];
    const Tensor<1, dim> direction = along + cross_product_3d(q[1], row.normal);
    return direction.norm() > 1e-3 * q[0].norm() ? direction : along;
  }



  void
  Contact::update_slip(const Vector &u)
  {
    // Positions of all nodes that stencils, anchors and tangents speak of.
    IndexSet   needed = solid.relevant;
    const auto need   = [&needed](const Stencil &stencil) {
      for (const StencilEntry &entry : stencil)
        if (!needed.is_element(dim * entry.node))
          needed.add_range(dim * entry.node, dim * entry.node + dim);
    };
    for (const auto &pair_rows : rows)
      for (const ContactRow &row : pair_rows)
        if (row.friction)
          {
            need(row.stencil);
            need(row.friction->anchor);
          }
    for (const Pair &pair : pairs)
      for (const auto &tangents : pair.tangents)
        for (const Stencil &tangent : tangents)
          need(tangent);
    needed.compress();
    const int same = positions.size() > 0 && needed == positions_known;
    if (Utilities::MPI::min(same, solid.communicator) == 0)
      {
        positions.reinit(solid.owned, needed, solid.communicator);
        start_positions.reinit(solid.owned, needed, solid.communicator);
        start_positions = owned_start_positions;
        positions_known = needed;
      }
    owned_positions = reference_positions;
    owned_positions += u;
    positions = owned_positions;

    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (std::size_t k = 0; k < rows[p].size(); ++k)
        {
          ContactRow &row = rows[p][k];
          if (!row.friction || row.status == ContactStatus::no_partner)
            continue;
          FrictionState       &f         = *row.friction;
          const Tensor<1, dim> direction = in_plane_rotation(row, pairs[p].tangents[k]);
          f.frame[0]                     = direction / direction.norm();
          f.frame[1]                     = cross_product_3d(row.normal, f.frame[0]);
          f.find_tangents(row.normal);
          f.start = f.tangential * f.carry(f.stored);
          f.slip_gradient.clear();
          f.spin_gradient.clear();

          f.area = row.area;
          f.time = time;
          f.step = time - committed_time;
          f.slip = f.tangential * (f.has_anchor ? way_from_anchor(row) - f.carry(f.anchor_way)
                                                : relative_displacement(row));
        }
  }



  void
  Contact::start_step()
  {
    start_positions       = positions;
    owned_start_positions = owned_positions;
  }



  Tensor<1, dim>
  Contact::displacement_of_step(const Index node) const
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = positions(dim * node + d) - start_positions(dim * node + d);
    return result;
  }



  Tensor<1, dim>
  Contact::relative_displacement(const ContactRow &row) const
  {
    // Only of rows that had no partner when the step began, and so of no obstacle.
    Tensor<1, dim> result = displacement_of_step(row.slave);
    for (const StencilEntry &entry : row.stencil)
      result -= entry.weight * displacement_of_step(entry.node);
    return result;
  }



  Tensor<1, dim>
  Contact::way_from_anchor(const ContactRow &row) const
  {
    const FrictionState &f = *row.friction;
    Tensor<1, dim>       way =
      (pairs[row.pair].small ? row.gap_vector : row.position - row.shift) - f.anchor_offset;
    for (const StencilEntry &entry : f.anchor)
      way -= entry.weight * position(entry.node);
    return way;
  }



  void
  Contact::set_anchor(ContactRow &row) const
  {
    // Slip is the way of the node from the material point that it faces now, seen
    // in a frame that turns with the surface: no rotation of both bodies changes
    // it. Small sliding: the way of the gap vector. Obstacle: the point of its
    // surface moves with it. What an open node has yet to go is no slip.
    FrictionState &f = *row.friction;
    f.has_anchor     = true;
    f.anchor.clear();
    f.anchor_offset = Tensor<1, dim>();
    if (pairs[row.pair].small)
      f.anchor_offset = row.gap_vector;
    else if (row.stencil.empty())
      f.anchor_offset = row.position - row.gap_vector - row.shift;
    else
      f.anchor = row.stencil;
    f.anchor_gap             = row.gap;
    const Tensor<1, dim> way = way_from_anchor(row);
    for (unsigned int i = 0; i < 2; ++i)
      f.anchor_way[i] = way * f.frame[i] + f.way_to_touch[i];
  }



  namespace
  {
    /**
     * The tangential way that an open node has yet to go until it touches, if it
     * goes on as it came in this step: no friction acts on it so far. A node that
     * comes in flatter than 45 degrees slides rather than lands, and one without a
     * past is taken to come along the normal.
     */
    std::array<double, 2>
    way_to_touch(const ContactRow &row)
    {
      const FrictionState &f       = *row.friction;
      const double         closing = f.anchor_gap - row.gap;
      if (!f.has_anchor || row.active() || row.gap <= 0. || closing <= 0.)
        return {};
      const Tensor<1, dim> way = f.slip + f.carry(f.way_to_touch);
      if (way.norm() > closing)
        return {};
      const double steps = row.gap / closing;
      return {{steps * (way * f.frame[0]), steps * (way * f.frame[1])}};
    }
  } // namespace



  void
  Contact::commit_friction(ContactRow &row) const
  {
    FrictionState &f = *row.friction;
    f.stored         = {};
    if (row.status == ContactStatus::no_partner)
      {
        f.has_anchor   = false;
        f.way_to_touch = {};
        f.anchor.clear();
        f.anchor_way = {};
        return;
      }
    f.way_to_touch = way_to_touch(row);
    if (row.active())
      {
        const Tensor<1, dim> force = row.force - row.lambda * row.normal;
        f.stored                   = {{force * f.frame[0], force * f.frame[1]}};
        if (row.status == ContactStatus::slip)
          {
            const Tensor<1, dim> slip = f.irreversible_slip(force);
            f.work -= force * slip;
            f.slip_length += slip.norm();
          }
      }
    set_anchor(row);
  }



  void
  Contact::set_slip_gradient(ContactRow &row, const std::array<Stencil, 2> &tangents) const
  {
    FrictionState                      &f          = *row.friction;
    const RowDerivative                &d          = *row.derivative;
    const Tensor<2, dim>               &tangential = f.tangential;
    std::map<Index, FrictionState::Mat> slip;
    std::map<Index, FrictionState::Vec> spin;

    // The frame turns with the direction q = T q_1 + q_2 x n: omega = e_2 . dq / |q|.
    Tensor<1, dim> q[2];
    for (unsigned int a = 0; a < 2; ++a)
      for (const StencilEntry &entry : tangents[a])
        {
          q[a] += entry.weight * position(entry.node);
          spin[entry.node] += (a == 0 ? entry.weight * f.frame[1] : -entry.weight * f.frame[0]);
        }
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      spin[d.nodes[a]] += (row.normal * q[1]) * (f.frame[0] * d.normal[a]) -
                          (row.normal * q[0]) * (f.frame[1] * d.normal[a]);
    const double length = in_plane_rotation(row, tangents).norm();
    for (auto &entry : spin)
      entry.second /= length;

    // s = T v - (what v was at the anchor, turned); of the changes of T and of the
    // frame only the tangential part counts.
    const Tensor<1, dim> way    = f.has_anchor ? way_from_anchor(row) : relative_displacement(row);
    const Tensor<1, dim> turned = cross_product_3d(row.normal, f.carry(f.anchor_way));
    slip[row.slave] += tangential;
    for (const StencilEntry &entry : f.has_anchor ? f.anchor : row.stencil)
      slip[entry.node] -= entry.weight * tangential;
    if (!f.has_anchor)
      for (std::size_t m = 0; m < row.stencil.size(); ++m)
        {
          const Tensor<1, dim> moved = tangential * displacement_of_step(row.stencil[m].node);
          for (std::size_t a = 0; a < d.nodes.size(); ++a)
            slip[d.nodes[a]] -= outer_product(moved, d.weights[m][a]);
        }
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      slip[d.nodes[a]] -= (row.normal * way) * (tangential * d.normal[a]);
    if (f.has_anchor && turned.norm() > 1e-12 * row.size)
      for (const auto &[node, rate] : spin)
        slip[node] -= outer_product(tangential * turned, rate);

    f.slip_gradient.assign(slip.begin(), slip.end());
    f.spin_gradient.assign(spin.begin(), spin.end());
  }



  namespace
  {
    /** Whether a row changes so fast that its derivative says nothing of a Newton
     * increment: the normal over a sharp edge with hardly a gap, averages over a
     * sliver of coverage. Such a row is better frozen. */
    bool
    changes_steeply(const ContactRow &row)
    {
      constexpr double     turns = 30., weights_change = 300.; // over a face
      const RowDerivative &d = *row.derivative;
      for (const Tensor<2, dim> &normal : d.normal)
        if (!(normal.norm() * row.size < turns))
          return true;
      for (const auto &weight : d.weights)
        for (const Tensor<1, dim> &change : weight)
          if (!(change.norm() * row.size < weights_change))
            return true;
      return false;
    }
  } // namespace



  void
  Contact::differentiate()
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (pairs[p].small)
          continue; // normals and stencils do not change
        pairs[p].pairing->differentiate(ghosted, time, rows[p]);
        for (std::size_t k = 0; k < rows[p].size(); ++k)
          {
            ContactRow &row = rows[p][k];
            if (row.derivative && changes_steeply(row))
              row.derivative.reset();
            if (row.friction && row.derivative)
              set_slip_gradient(row, pairs[p].tangents[k]);
          }
      }
  }
} // namespace Touchstone
