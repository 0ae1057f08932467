#ifndef touchstone_drive_energy_gain_h
#define touchstone_drive_energy_gain_h

#include <touchstone/algebra/non_convergence.h>

namespace Touchstone
{
  /** @brief A step has made energy from nothing: it is cut, as one that does not
   * converge. */
  class EnergyGain : public NonConvergence
  {
  public:
    using NonConvergence::NonConvergence;
  };
} // namespace Touchstone

#endif
