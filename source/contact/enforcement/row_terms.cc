// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/enforcement/row_terms.h>
#include <touchstone/contact/friction/friction.h>

#include <map>

// What a row contributes to the linear system, whatever the enforcement: its conditions on the
// displacement increment, and the terms of friction and of changing normals and stencils
// (doc/theory.md 5 and 6.3). Terms are products of rank one, l r^T, with l the forces on the nodes
// and r the motion.
namespace Touchstone
{
  using namespace dealii;

  LinearForm
  by_unknowns(const NodalForm &form)
  {
    LinearForm result;
    result.reserve(dim * form.size());
    for (const auto &[node, coefficients] : form)
      for (unsigned int d = 0; d < dim; ++d)
        if (coefficients[d] != 0.)
          result.emplace_back(dim * node + d, coefficients[d]);
    return result;
  }



  // Equation (11): dg = n.d(x_s - x_c) + (x_s - x_c).dn. The second term vanishes only where the
  // gap vector is parallel to n, which it is not if normals are averaged over nodes or faces.
  NodalForm
  gap_gradient(const ContactRow &row)
  {
    NodalForm            form;
    const RowDerivative &derivative = *row.derivative;
    for (std::size_t a = 0; a < derivative.nodes.size(); ++a)
      form.emplace_back(derivative.nodes[a],
                        row.normal * derivative.gap_vector[a] +
                          row.gap_vector * derivative.normal[a]);
    return form;
  }



  namespace
  {
    /** A component of the slip. */
    NodalForm
    slip_form(const ContactRow &row, const Tensor<1, dim> &direction)
    {
      NodalForm form;
      for (const auto &[node, matrix] : row.friction->kinematics.slip_gradient)
        form.emplace_back(node, direction * matrix);
      return form;
    }

    /** A condition of the row without direction and value. */
    Condition
    blank_condition(const ContactRow &row)
    {
      Condition condition;
      condition.node        = row.slave;
      condition.stencil     = row.stencil;
      condition.body        = row.body;
      condition.master_body = row.master_body;
      // Where the force acts and the point of the master that it faces; needed for the moments of
      // rigid-body modes. The gap vector of a row is `share` times that of the surfaces.
      condition.position        = row.position + row.lever;
      condition.master_position = condition.position - row.gap_vector / row.share;
      return condition;
    }
  } // namespace



  // Stick on springs imposes no condition and yet holds its body: the check for free rigid motions
  // has to know of it.
  std::vector<Condition>
  elastic_stick(const ContactRow &row, const RowState &state)
  {
    if (state.status == ContactStatus::stick && !state.fully_constrained() && !state.dropped())
      return along_surface(row, state);
    return {};
  }



  std::vector<Condition>
  along_surface(const ContactRow &row, const RowState &state)
  {
    std::vector<Condition> conditions;
    if (row.friction && state.active())
      for (const Tensor<1, dim> &tangent : row.friction->kinematics.tangents)
        {
          conditions.push_back(blank_condition(row));
          conditions.back().direction = tangent;
        }
    return conditions;
  }



  std::vector<Condition>
  friction_springs(const ContactRow &row, const RowState &state)
  {
    std::vector<Condition> conditions = elastic_stick(row, state);
    // In slip kappa_T of equation (17) resists a change of the slip direction like a spring. Only
    // stiff springs get their elongation as a dof: multigrid keeps such dofs out of its coarse
    // spaces, which a soft spring does not need.
    if (row.friction && state.status == ContactStatus::slip && !state.dropped() &&
        state.friction->tangent.norm() > 10. * row.stiffness)
      {
        conditions.push_back(blank_condition(row));
        conditions.back().direction = cross_product_3d(row.normal, state.friction->direction);
      }
    for (Condition &condition : conditions)
      if (!row.friction->kinematics.slip_gradient.empty())
        condition.gradient = slip_form(row, condition.direction);
    return conditions;
  }



  void
  start_row(RowState &state)
  {
    // A redundant row has no condition that could be refused; counting one refusal makes it
    // `dropped()`.
    state.accepted = state.refused = 0;
    state.normal_accepted          = true;
    if (state.friction.made())
      {
        state.friction->unconstrained.clear();
        state.friction->held.clear();
      }
    if (state.active() && state.redundant)
      {
        state.refused         = 1;
        state.normal_accepted = false;
      }
  }



  std::vector<Condition>
  row_conditions(const ContactRow &row, const RowState &state, const bool keep_symmetric)
  {
    if (!state.active() || state.redundant)
      return {};
    Condition              condition = blank_condition(row);
    std::vector<Condition> conditions;
    if (row.tied)
      {
        // Constrained in fixed directions, and not along a normal that may turn: a tied row bears
        // tension and shear alike.
        for (unsigned int d = 0; d < dim; ++d)
          {
            condition.direction    = Tensor<1, dim>();
            condition.direction[d] = 1.;
            condition.value        = -row.gap_vector[d];
            conditions.push_back(condition);
          }
        return conditions;
      }

    condition.direction = row.normal;
    condition.value     = -row.gap;
    // With changing normals the force still acts along M^T n, the condition reads dg = -g: an
    // unsymmetric system.
    if (row.derivative && !keep_symmetric)
      condition.gradient = gap_gradient(row);
    // In slip the friction force follows the normal force: both act with lambda along n + L' tau,
    // equation (22).
    if (row.friction && state.friction->d_lambda.norm_square() > 0.)
      condition.force_direction = row.normal + state.friction->d_lambda;
    conditions.push_back(condition);
    // Stick: e_a.ds = -e_a.s takes back the slip that is left (doc/theory.md 6.1).
    if (state.fully_constrained())
      for (const Tensor<1, dim> &tangent : row.friction->kinematics.tangents)
        {
          condition.direction       = tangent;
          condition.force_direction = Tensor<1, dim>();
          condition.value           = -(tangent * row.friction->kinematics.slip);
          condition.gradient.clear();
          if (!row.friction->kinematics.slip_gradient.empty() && !keep_symmetric)
            condition.gradient = slip_form(row, tangent);
          conditions.push_back(condition);
        }
    return conditions;
  }



  void
  RowTerms::add_load(const ContactRow &row, const Tensor<1, dim> &force)
  {
    for (const auto &[node, part] : relative_motion(row.slave, row.stencil, force))
      for (unsigned int d = 0; d < dim; ++d)
        {
          unknowns.push_back(dim * node + d);
          loads.push_back(part[d]);
        }
  }



  void
  RowTerms::add_stiffness(const ContactRow &row, const NodalMatrices &change)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        NodalForm form;
        for (const auto &[node, matrix] : change)
          form.emplace_back(node, matrix[d]);
        add_stiffness(row, Point<dim>::unit_vector(d), form);
      }
  }



  void
  RowTerms::add_stiffness(const ContactRow &row, const Tensor<1, dim> &force, const NodalForm &form)
  {
    RankOneTerm term{by_unknowns(relative_motion(row.slave, row.stencil, force)),
                     by_unknowns(form)};
    if (!term.left.empty() && !term.right.empty())
      system.terms.push_back(std::move(term));
  }



  // Equation (12): the change of the nodal forces M^T f at constant lambda and constant tangential
  // components. It is unsymmetric, so only systems that may be unsymmetric have it.
  void
  RowTerms::add_geometric(const ContactRow &row, const RowState &state)
  {
    // f = lambda n + t with t turning with the normal: df = lambda dn - n (t . dn).
    const RowDerivative &derivative = *row.derivative;
    const Tensor<1, dim> tangential = state.force - state.lambda * row.normal;
    const Tensor<2, dim> turn       = outer_product(row.normal, tangential) -
                                state.lambda * Tensor<2, dim>(unit_symmetric_tensor<dim>());
    NodalMatrices change;
    for (std::size_t a = 0; a < derivative.nodes.size(); ++a)
      change.emplace_back(derivative.nodes[a], turn * derivative.normal[a]);
    add_stiffness(row, change);
    // Master nodes take -w_m f.
    for (std::size_t m = 0; m < row.stencil.size(); ++m)
      {
        NodalForm weight;
        for (std::size_t a = 0; a < derivative.nodes.size(); ++a)
          weight.emplace_back(derivative.nodes[a], derivative.weights[m][a]);
        system.terms.push_back(
          {by_unknowns({{row.stencil[m].node, state.force}}), by_unknowns(weight)});
      }
  }



  void
  RowTerms::add_row(const ContactRow &row, const RowState &state)
  {
    if (row.derivative && !system.keep_symmetric)
      {
        add_geometric(row, state);
        system.symmetric = false;
      }
    if (row.friction)
      add_friction(row, state);
  }



  void
  RowTerms::add_spring(const ContactRow &row,
                       const Condition  &condition,
                       const double      force,
                       const double      stiffness)
  {
    const Tensor<1, dim> direction = condition.force();
    add_load(row, force * direction);
    add_stiffness(row, stiffness * direction, condition.motion_form());
    if (!condition.symmetric())
      system.symmetric = false;
  }



  void
  RowTerms::add_friction(const ContactRow &row, const RowState &state)
  {
    const SlipKinematics &k        = row.friction->kinematics;
    const FrictionForce  &f        = *state.friction;
    Tensor<1, dim>        constant = f.constant;
    Tensor<2, dim>        tangent  = f.tangent;
    if (state.fully_constrained())
      {
        // Refused conditions of stick are replaced by springs along their tangents, with the
        // augmented force as load; see augment_unconstrained().
        const double spring = state.spring.of(row.stiffness);
        for (const Tensor<1, dim> &direction : f.unconstrained)
          {
            constant += (f.base * direction - spring * (k.slip * direction)) * direction;
            tangent += spring * outer_product(direction, direction);
          }
        for (const Tensor<1, dim> &direction : f.held)
          constant += (f.base * direction) * direction;
      }
    add_load(row, constant);
    // A limit that falls with the slip is no spring: symmetric systems lag it.
    if (f.d_slip.norm_square() > 0. && !system.keep_symmetric)
      {
        tangent -= outer_product(f.d_slip, f.slip_direction);
        system.symmetric = false;
      }
    if (tangent.norm_square() > 0.)
      {
        NodalMatrices change;
        // Frozen: the slip changes by T_n M du, with the weights of the present contact point.
        if (k.slip_gradient.empty() || system.keep_symmetric)
          {
            change.emplace_back(row.slave, tangent);
            for (const StencilEntry &entry : row.stencil)
              change.emplace_back(entry.node, -entry.weight * tangent);
          }
        else
          for (const auto &[node, matrix] : k.slip_gradient)
            change.emplace_back(node, tangent * matrix);
        add_stiffness(row, change);
      }
    // dL/dA: a Tresca limit grows as the node gets covered.
    if (row.derivative && !row.derivative->area.empty() && !system.keep_symmetric &&
        f.d_area.norm_square() > 0.)
      {
        NodalForm area;
        for (std::size_t a = 0; a < row.derivative->nodes.size(); ++a)
          area.emplace_back(row.derivative->nodes[a], row.derivative->area[a]);
        add_stiffness(row, -f.d_area, area);
      }
    if (!k.spin_gradient.empty() && !system.keep_symmetric && f.d_spin.norm_square() > 0.)
      add_stiffness(row, f.d_spin, k.spin_gradient);
  }



  void
  RowTerms::finish()
  {
    system.rhs.add(unknowns, loads);
    system.rhs.compress(VectorOperation::add);
    unknowns.clear();
    loads.clear();
  }
} // namespace Touchstone
