// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_solid_rigid_body_modes_h
#define touchstone_solid_rigid_body_modes_h

#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/algebra/linear_solver.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <set>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The rigid motions that given conditions do not resist. */
  struct FreeMotion
  {
    /** Dimension of the space of free rigid motions. */
    unsigned int n_modes = 0;
    /** Orthonormal basis, 6 rows per body (translations, rotations). */
    dealii::FullMatrix<double> basis;
    /** Bodies that take part. */
    std::set<unsigned int> bodies;
    /** "body 'punch' can move in direction z; ..." */
    std::string description;
  };

  /**
   * @brief The six rigid motions of each body: near-null space of multigrid, and
   * test for missing supports.
   */
  class RigidBodyModes
  {
  public:
    explicit RigidBodyModes(const Solid &solid);

    const RigidMotions &
    motions() const
    {
      return *rigid;
    }

    /**
     * @brief Rigid motions that violate none of the conditions.
     *
     * The stiffness lets all rigid motions of all bodies go free, so the null
     * space of the constrained system is that of the Gram matrix R^T B^T B R of
     * the conditions B on the rigid motions R, a matrix of 6 rows per body.
     * @param resisted Part of the resistance to the best-resisted motion that counts as none.
     */
    FreeMotion
    free_motion(const std::vector<Condition> &conditions, double resisted = unresisted) const;

    /** @brief Part of the best-resisted motion's resistance that does not count as any. */
    static constexpr double unresisted = 1e-8;

    /** @brief Conditions that leave a body no rigid motion. */
    std::vector<Condition>
    all_motions(unsigned int body) const;

    /**
     * @brief Diagonal terms that keep free motions finite: a fraction of the
     * diagonal of the stiffness, times the square of each dof's share of the motion.
     *
     * Added to the tangent but not to the residual, they slow the convergence to equilibrium and do
     * not change it (a proximal point step). The fraction is such that the free motion under @p
     * unbalanced is about @p distance, and at least @p smallest.
     */
    Vector
    stabilisation(const FreeMotion &motion,
                  const Vector     &unbalanced,
                  double            distance,
                  double            smallest) const;

  private:
    const Solid                  &solid;
    std::unique_ptr<RigidMotions> rigid;
    std::vector<RigidFrame>       frames;

    std::vector<double>
    gram_matrix(const std::vector<Condition> &conditions) const;
    /** @brief Names the bodies and motions of @p motion. */
    void
    describe(FreeMotion &motion) const;
  };
} // namespace Touchstone

#endif
