// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_enforcement_row_terms_h
#define touchstone_contact_enforcement_row_terms_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_system.h>
#include <touchstone/contact/row_state.h>

#include <vector>

namespace Touchstone
{
  /** @brief The linear form by dofs instead of nodes, zeros left out. */
  LinearForm
  by_unknowns(const NodalForm &form);

  /** @brief d gap / d x_a of a row with a derivative: normal and stencil change. */
  NodalForm
  gap_gradient(const ContactRow &row);

  /** @brief A new linear system begins: no condition of the row has been added to the graph. A
   * redundant row counts as refused. */
  void
  start_row(RowState &state);

  /**
   * @brief The conditions that an active row puts on the displacement increment:
   * along the normal if it is free to slide, in all directions if it is fully constrained; none
   * if it is open or redundant.
   *
   * @param keep_symmetric Leave out how normals and stencils change; friction has been lagged
   *                       before, see lag_friction().
   */
  std::vector<Condition>
  row_conditions(const ContactRow &row, const RowState &state, bool keep_symmetric);

  /** @brief The displacements that a sticking node resists elastically, without being
   * constrained by conditions: they support its body, too. */
  std::vector<Condition>
  elastic_stick(const ContactRow &row, const RowState &state);

  /** @brief The displacements that friction resists, whether the row sticks or slips: along the
   * surface. As conditions without value. None of rows without friction or contact. */
  std::vector<Condition>
  along_surface(const ContactRow &row, const RowState &state);

  /** @brief The directions in which friction resists an increment like a spring: along the surface
   * where the row sticks elastically, across the slip where it slips. As conditions without
   * value, for a change of basis that makes their elongations dofs (doc/theory.md 7, equation
   * (23)). */
  std::vector<Condition>
  friction_springs(const ContactRow &row, const RowState &state);

  /** @brief Matrix terms and loads at nodes, which may belong to any rank. */
  class RowTerms
  {
  public:
    explicit RowTerms(LinearSystem &system)
      : system(system)
    {
    }

    /** @brief Add the load M^T @p force of a row. */
    void
    add_load(const ContactRow &row, const dealii::Tensor<1, dim> &force);

    /** @brief Add the stiffness -d(M^T f) where f changes by -@p change du. */
    void
    add_stiffness(const ContactRow &row, const NodalMatrices &change);

    /** @brief The same where f changes by -@p force times the form: M^T force
     * form. */
    void
    add_stiffness(const ContactRow             &row,
                  const dealii::Tensor<1, dim> &force,
                  const NodalForm              &form);

    /** @brief Add a spring along a condition of a row. @param force Its force where the increment
     * is zero. @param stiffness Force per length. */
    void
    add_spring(const ContactRow &row, const Condition &condition, double force, double stiffness);

    /** @brief Add what friction and the change of normal and stencil contribute to
     * the system, whatever the enforcement, doc/theory.md 5 and 6.3. */
    void
    add_row(const ContactRow &row, const RowState &state);

    /** @brief Add the loads to the right-hand side. Collective. */
    void
    finish();

  private:
    LinearSystem       &system;
    std::vector<Index>  unknowns;
    std::vector<double> loads;

    void
    add_geometric(const ContactRow &row, const RowState &state);
    /** The change of the friction force with slip, area and frame. */
    void
    add_friction(const ContactRow &row, const RowState &state);
  };
} // namespace Touchstone

#endif
