// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/friction/slip_kinematics.h>

#include <map>

// Slip of a row since the step began and the frame that moves with the slave surface (doc/theory.md
// 6.2, equations (18) to (20)), with their derivatives for the consistent linearisation. All of it
// is a function of the history and of the present positions, and of no earlier Newton iterate.
namespace Touchstone
{
  using namespace dealii;

  Tensor<1, dim>
  NodePositions::at(const Index node) const
  {
    Tensor<1, dim> x;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = reference(dim * node + d) + present(dim * node + d);
    return x;
  }



  Tensor<1, dim>
  NodePositions::displacement(const Index node) const
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = present(dim * node + d) - start(dim * node + d);
    return result;
  }



  Tensor<1, dim>
  NodePositions::between(const Index other, const Index node) const
  {
    // The difference of neighbouring reference positions has no round-off, but for that of the
    // mesh.
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const Index i = dim * node + d, j = dim * other + d;
        result[d] = (reference(i) - reference(j)) + (present(i) - present(j));
      }
    return result;
  }



  const std::array<Stencil, 2> &
  material_tangents(const ContactRow &row)
  {
    return row.tangents ? *row.tangents : row.friction->material_tangents;
  }



  namespace
  {
    double
    sum_of_weights(const Stencil &stencil)
    {
      double sum = 0.;
      for (const StencilEntry &entry : stencil)
        sum += entry.weight;
      return sum;
    }
  } // namespace



  // v of equation (18). With small sliding the stencil never changes, so the change of the gap
  // vector is the same displacement; the motion of an obstacle is taken out.
  Tensor<1, dim>
  displacement_since_anchor(const ContactRow      &row,
                            const FrictionHistory &history,
                            const NodePositions   &positions)
  {
    // The anchor on an obstacle is a point of the obstacle, which has the weight that other nodes
    // leave: of a row between nodes these are of the slave face.
    double of_obstacle = 1.;
    if (!history.anchor.empty())
      of_obstacle = row.on_obstacle() ? 1. - sum_of_weights(history.anchor) : 0.;
    if (row.friction->small)
      return row.gap_vector - history.anchor_offset;
    // The weights of the anchor and of the obstacle add up to one.
    Tensor<1, dim> result;
    if (of_obstacle != 0.)
      result =
        of_obstacle * (row.motion.turned
                         ? row.position - row.motion.place(Point<dim>(history.anchor_offset))
                         : row.position - Point<dim>(history.anchor_offset) - row.motion.shift);
    for (const StencilEntry &entry : history.anchor)
      result -= entry.weight * positions.between(row.slave, entry.node);
    return result;
  }



  namespace
  {
    /** Displacement since the step began, of the slave node relative to the material points of
     * the master that it faces now: only of rows that had no partner then, which of those on
     * obstacles are points inside slave faces. */
    Tensor<1, dim>
    relative_displacement(const ContactRow &row, const NodePositions &positions)
    {
      Tensor<1, dim> result = positions.displacement(row.slave);
      for (const StencilEntry &entry : row.stencil)
        result -= entry.weight * positions.displacement(entry.node);
      return row.on_obstacle() ? result - row.share * row.moved : result;
    }



    /** Set the directions that friction can act along, from the frame. */
    void
    find_tangents(const std::vector<Tensor<1, dim>> &mirrors,
                  const Tensor<1, dim>              &normal,
                  SlipKinematics                    &k)
    {
      // On a plane of symmetry the mirrored half of the body cancels the friction across the plane
      // (doc/theory.md 6). The direction across it is taken from the projector and from the
      // tangents; at a corner of two planes none is left.
      k.tangential = tangential_projector(normal);
      k.tangents.assign(k.frame.begin(), k.frame.end());
      for (const Tensor<1, dim> &mirror : mirrors)
        {
          // Tangential part of the normal of the symmetry plane, orthogonal to the directions that
          // earlier planes have removed.
          Tensor<1, dim> out    = k.tangential * mirror;
          const double   length = out.norm();
          if (length < 1e-3)
            continue;
          out /= length;
          k.tangential -= outer_product(out, out);
          k.tangents.resize(k.tangents.size() - 1);
          if (k.tangents.size() == 1)
            k.tangents[0] = cross_product_3d(normal, out);
        }
    }



    /** A direction in the plane of the row's normal that turns with the surface of the slave
     * body, whichever directions its mesh has. */
    Tensor<1, dim>
    in_plane_rotation(const ContactRow &row, const NodePositions &positions)
    {
      Tensor<1, dim> q[2];
      for (unsigned int a = 0; a < 2; ++a)
        for (const StencilEntry &entry : material_tangents(row)[a])
          q[a] += entry.weight * positions.at(entry.node);
      // The rotation in the polar decomposition of the surface's deformation in the plane of the
      // normal, doc/theory.md, section 6.2. A surface that faces away from the master surface has
      // none; such rows carry no force.
      const Tensor<1, dim> along     = tangential_projector(row.normal) * q[0];
      const Tensor<1, dim> direction = along + cross_product_3d(q[1], row.normal);
      return direction.norm() > 1e-3 * q[0].norm() ? direction : along;
    }
  } // namespace



  SlipKinematics
  slip_kinematics(const ContactRow    &row,
                  const NodePositions &positions,
                  const double         time,
                  const double         step)
  {
    const FrictionHistory &history = row.friction->history;
    SlipKinematics         k;
    const Tensor<1, dim>   direction = in_plane_rotation(row, positions);
    k.frame[0]                       = direction / direction.norm();
    k.frame[1]                       = cross_product_3d(row.normal, k.frame[0]);
    find_tangents(row.friction->mirrors, row.normal, k);
    // t_b of regularised friction: the force at the end of the last step, turned with the surface.
    k.start = k.tangential * k.carry(history.traction) / share_of_point(row);
    k.area  = row.area;
    k.time  = time;
    k.step  = step;
    // Equation (18) with an anchor, and (20) where the node had no partner when the step began.
    k.slip =
      k.tangential * (history.has_anchor ? displacement_since_anchor(row, history, positions) -
                                             k.carry(history.anchor_displacement)
                                         : relative_displacement(row, positions));
    return k;
  }



  void
  set_anchor(const ContactRow     &row,
             const SlipKinematics &kinematics,
             const NodePositions  &positions,
             FrictionHistory      &history)
  {
    // From now on slip is the displacement of the node relative to the material point that it faces
    // now, in components of a frame that turns with the surface, so that a common rotation of both
    // bodies is no slip (doc/theory.md 6.2). With small sliding it is the change of the gap vector;
    // on an obstacle the anchor is a point that moves with it. The displacement that an open node
    // is predicted to make until it touches, equation (19), is added and thereby no slip either.
    history.has_anchor = true;
    history.anchor.clear();
    history.anchor_offset = Tensor<1, dim>();
    if (row.friction->small)
      history.anchor_offset = row.gap_vector;
    else
      {
        history.anchor = row.stencil;
        if (row.on_obstacle())
          history.anchor_offset = row.motion.back(contact_point(row));
      }
    history.anchor_gap                = row.gap;
    const Tensor<1, dim> displacement = displacement_since_anchor(row, history, positions);
    for (unsigned int i = 0; i < 2; ++i)
      history.anchor_displacement[i] =
        displacement * kinematics.frame[i] + history.precontact_offset[i];
  }



  void
  differentiate_slip(const ContactRow &row, const NodePositions &positions, SlipKinematics &k)
  {
    using Vec                         = Tensor<1, dim>;
    using Mat                         = Tensor<2, dim>;
    const FrictionHistory &history    = row.friction->history;
    const RowDerivative   &d          = *row.derivative;
    const Mat             &tangential = k.tangential;
    std::map<Index, Mat>   slip;
    std::map<Index, Vec>   spin;

    // The frame turns with the direction q = T q_1 + q_2 x n: omega = e_2 . dq / |q|.
    Vec q[2];
    for (unsigned int a = 0; a < 2; ++a)
      for (const StencilEntry &entry : material_tangents(row)[a])
        {
          q[a] += entry.weight * positions.at(entry.node);
          spin[entry.node] += (a == 0 ? entry.weight * k.frame[1] : -entry.weight * k.frame[0]);
        }
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      // The normal changes too: -(n.q_1) e_2.dn from the projector, and e_2.(q_2 x dn) = (n.q_2)
      // e_1.dn since dn is perpendicular to n.
      spin[d.nodes[a]] += (row.normal * q[1]) * (k.frame[0] * d.normal[a]) -
                          (row.normal * q[0]) * (k.frame[1] * d.normal[a]);
    const double length = in_plane_rotation(row, positions).norm();
    for (auto &entry : spin)
      entry.second /= length;

    // s = T v - (what v was at the anchor, turned); of the changes of T and of the
    // frame only the tangential part counts.
    const Vec v      = history.has_anchor ? displacement_since_anchor(row, history, positions)
                                          : relative_displacement(row, positions);
    const Vec turned = cross_product_3d(row.normal, k.carry(history.anchor_displacement));
    slip[row.slave] += tangential;
    for (const StencilEntry &entry : history.has_anchor ? history.anchor : row.stencil)
      slip[entry.node] -= entry.weight * tangential;
    if (!history.has_anchor)
      // Without an anchor the stencil is the present one, whose weights change with the contact
      // point.
      for (std::size_t m = 0; m < row.stencil.size(); ++m)
        {
          const Vec moved = tangential * positions.displacement(row.stencil[m].node);
          for (std::size_t a = 0; a < d.nodes.size(); ++a)
            slip[d.nodes[a]] -= outer_product(moved, d.weights[m][a]);
        }
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      // dT v = -dn (n.v) - n (dn.v); the second is along n and no slip.
      slip[d.nodes[a]] -= (row.normal * v) * (tangential * d.normal[a]);
    // The displacement at the anchor is carried by the frame and changes by omega n x (...). Below
    // the bound it is round-off and would only widen the stencil.
    if (history.has_anchor && turned.norm() > 1e-12 * row.size)
      for (const auto &[node, rate] : spin)
        slip[node] -= outer_product(tangential * turned, rate);

    k.slip_gradient.assign(slip.begin(), slip.end());
    k.spin_gradient.assign(spin.begin(), spin.end());
  }
} // namespace Touchstone
