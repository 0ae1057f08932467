#include <touchstone/contact/contact.h>

#include <cmath>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    Tensor<2, dim>
    tangential_part(const Tensor<1, dim> &normal)
    {
      return Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(normal, normal);
    }
  } // namespace



  Tensor<1, dim>
  Contact::position(const Index node) const
  {
    Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = positions(dim * node + d);
    return x;
  }



  void
  Contact::update_slip(const Vector &u)
  {
    // Positions of all nodes that stencils, anchors and tangents speak of.
    IndexSet needed = solid.relevant;
    for (const auto &pair_rows : rows)
      for (const ContactRow &row : pair_rows)
        if (row.friction)
          for (const Stencil *stencil : {&row.stencil, &row.friction->anchor})
            for (const StencilEntry &entry : *stencil)
              if (!needed.is_element(dim * entry.node))
                needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    const int same = positions.size() > 0 && needed == positions_known;
    if (Utilities::MPI::min(same, solid.communicator) == 0)
      {
        positions.reinit(solid.owned, needed, solid.communicator);
        positions_known = needed;
      }
    Vector owned(reference_positions);
    owned += u;
    positions = owned;

    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (std::size_t k = 0; k < rows[p].size(); ++k)
        {
          ContactRow &row = rows[p][k];
          if (!row.friction || row.status == ContactStatus::no_partner)
            continue;
          FrictionState &f = *row.friction;
          if (!f.has_anchor)
            set_anchor(row);

          // The way of the contact point over the master surface, seen on the
          // surface as it is now: no rotation of both bodies changes it.
          const Tensor<2, dim> tangential = tangential_part(row.normal);
          f.slip                          = tangential * (contact_place(row) - f.anchor_offset);
          if (!pairs[p].small)
            for (const StencilEntry &entry : row.stencil)
              f.slip += entry.weight * (tangential * position(entry.node));
          for (const StencilEntry &entry : f.anchor)
            f.slip -= entry.weight * (tangential * position(entry.node));

          Tensor<1, dim> direction;
          for (const StencilEntry &entry : pairs[p].tangents[k])
            direction += entry.weight * position(entry.node);
          direction  = tangential * direction;
          f.frame[0] = direction / direction.norm();
          f.frame[1] = cross_product_3d(row.normal, f.frame[0]);
          f.start    = f.stored[0] * f.frame[0] + f.stored[1] * f.frame[1];
          f.slip_gradient.clear();
          f.spin_gradient.clear();
        }
  }



  Tensor<1, dim>
  Contact::contact_place(const ContactRow &row) const
  {
    // Small sliding: the path is that of the gap vector. Obstacle: the point in
    // the frame that moves with it. Master body: its stencil says all, except how
    // far the node hangs over the edge at which the closest point stops.
    if (pairs[row.pair].small)
      return row.gap_vector;
    if (row.stencil.empty())
      return row.position - row.gap_vector - row.shift;
    return row.gap_vector - row.gap * row.normal;
  }



  void
  Contact::set_anchor(ContactRow &row) const
  {
    FrictionState &f = *row.friction;
    f.has_anchor     = true;
    f.anchor         = pairs[row.pair].small ? Stencil() : row.stencil;
    f.anchor_offset  = contact_place(row);
  }



  void
  Contact::commit_friction(ContactRow &row) const
  {
    FrictionState &f = *row.friction;
    f.stored         = {};
    if (row.status == ContactStatus::no_partner)
      {
        f.has_anchor = false;
        return;
      }
    if (row.active())
      {
        const Tensor<1, dim> force = row.force - row.lambda * row.normal;
        f.stored                   = {{force * f.frame[0], force * f.frame[1]}};
        f.work -= force * f.slip;
        if (row.status == ContactStatus::slip)
          f.slip_length += f.slip.norm();
      }
    set_anchor(row);
  }



  void
  Contact::set_slip_gradient(ContactRow &row, const Stencil &tangent) const
  {
    FrictionState                      &f = *row.friction;
    const RowDerivative                &d = *row.derivative;
    std::map<Index, FrictionState::Mat> slip;
    std::map<Index, FrictionState::Vec> spin;
    const Tensor<2, dim>                tangential = tangential_part(row.normal);

    // s = T (y - y_anchor); of the change of T only the tangential part counts.
    Tensor<1, dim> way = contact_place(row) - f.anchor_offset;
    for (const StencilEntry &entry : row.stencil)
      {
        slip[entry.node] += entry.weight * tangential;
        way += entry.weight * position(entry.node);
      }
    for (const StencilEntry &entry : f.anchor)
      {
        slip[entry.node] -= entry.weight * tangential;
        way -= entry.weight * position(entry.node);
      }
    if (row.stencil.empty())
      slip[row.slave] += tangential;
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      {
        Tensor<2, dim> &entry = slip[d.nodes[a]];
        if (row.stencil.empty())
          entry -= tangential * d.gap_vector[a];
        else
          entry += tangential * (d.gap_vector[a] - row.gap * d.normal[a]);
        for (std::size_t m = 0; m < row.stencil.size(); ++m)
          entry += outer_product(tangential * position(row.stencil[m].node), d.weights[m][a]);
        entry -= (row.normal * way) * (tangential * d.normal[a]);
      }
    f.slip_gradient.assign(slip.begin(), slip.end());

    // The frame turns with the tangent q: omega = e_2 . dq / |T q|.
    Tensor<1, dim> q;
    for (const StencilEntry &entry : tangent)
      {
        q += entry.weight * position(entry.node);
        spin[entry.node] += entry.weight * f.frame[1];
      }
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      spin[d.nodes[a]] -= (row.normal * q) * (f.frame[1] * d.normal[a]);
    const double length = (tangential * q).norm();
    for (auto &entry : spin)
      entry.second /= length;
    f.spin_gradient.assign(spin.begin(), spin.end());
  }



  void
  Contact::differentiate()
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        if (pairs[p].small)
          continue; // normals and stencils do not change
        pairs[p].pairing->differentiate(ghosted, time, rows[p]);
        for (std::size_t k = 0; k < rows[p].size(); ++k)
          if (rows[p][k].friction && rows[p][k].derivative)
            set_slip_gradient(rows[p][k], pairs[p].tangents[k]);
      }
  }
} // namespace Touchstone
