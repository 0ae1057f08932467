// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_interference_fit_h
#define touchstone_verification_interference_fit_h

#include <touchstone/verification/reference_solution.h>

namespace Touchstone
{
  /**
   * @brief Two tubes pressed into each other, Lamé's solution in plane strain
   * for small overlap.
   *
   * With E' = E/(1-nu^2), nu' = nu/(1-nu), the inner tube a..b_i and the outer
   * tube b_o..c move at their common surface by
   *   u_i = -p_i b_i/E' ((b_i^2+a^2)/(b_i^2-a^2) - nu'),
   *   u_o =  p_o b_o/E' ((c^2+b_o^2)/(c^2-b_o^2) + nu').
   * The surfaces meet, u_o - u_i = b_i - b_o, and the forces per angle balance,
   * p_o b_o = p_i b_i: since the linear-elastic bodies are loaded per reference
   * area, the pressure depends on the radius of the slave surface.
   */
  class InterferenceFit : public ReferenceSolution
  {
  public:
    explicit InterferenceFit(const Scene &scene);
    InterferenceFit(ReferenceValues values, unsigned int pair);

    /** @brief Nominal pressure on a surface of the given @p radius (length),
     * force per area. */
    double
    pressure(double radius) const;

    /** @brief What textbooks give, who take p_o = p_i; force per area. */
    double
    textbook_pressure() const;

    ReferenceComparison
    compare(const ReferenceInput &input) const override;

  private:
    double       slave_radius, skin_radius, bore_radius;
    bool         with_displacement;
    unsigned int pair;
    /** -u_i/(p_i b_i) and u_o/(p_o b_o), area per force. */
    double inner_compliance, outer_compliance;
  };
} // namespace Touchstone

#endif
