// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_non_convergence_h
#define touchstone_base_non_convergence_h

#include <optional>
#include <stdexcept>
#include <string>

namespace Touchstone
{
  /**
   * @brief A step could not be solved: the load step is cut and tried again, or
   * the run ends with this as its reason.
   */
  class NonConvergence : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;

    /** @brief Whether a shorter step can do better. */
    virtual bool
    shorter_step_may_help() const
    {
      return true;
    }

    /** @brief Whether the text says what is wrong, so that the last Newton iteration tells nothing
     * more. */
    virtual bool
    names_its_cause() const
    {
      return !shorter_step_may_help();
    }

    /** @brief How bad the failure is, beside what the last Newton iteration says, so that attempts
     * can be told apart; no unit. None if nothing but the last iteration tells. */
    virtual std::optional<double>
    measure() const
    {
      return {};
    }
  };

  /** @brief Newton ran out of iterations, or its residual grew without bound. */
  class NewtonFailure : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief Nodes are in balance, but what is balanced around Newton's method does not come to it:
   * an obstacle that forces move, or the tension of a bolt. */
  class NotBalanced : public NonConvergence
  {
  public:
    /** @param missing Force that is missing, in one unit for all attempts. */
    NotBalanced(const std::string &what, const double missing)
      : NonConvergence(what)
      , missing(missing)
    {
    }

    std::optional<double>
    measure() const override
    {
      return missing;
    }

  private:
    double missing;
  };

  /** @brief Nodes are in balance, but bodies are in a place that the step cannot have led them to.
   */
  class WrongPlace : public NonConvergence
  {
  public:
    /** @param step Length of the step in time: nothing else tells attempts apart. */
    WrongPlace(const std::string &what, const double step)
      : NonConvergence(what)
      , step(step)
    {
    }

    bool
    names_its_cause() const override
    {
      return true;
    }

    std::optional<double>
    measure() const override
    {
      return step;
    }

  private:
    double step;
  };

  /** @brief The active set came back to one it had before, again and again. */
  class ActiveSetCycle : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief The linear solver broke down or its true residual is too large. */
  class LinearSolverFailure : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief No part of a Newton increment leaves the cells with det F > 0. */
  class InvertedCells : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief The local equations of a material law have no solution that could be found. */
  class MaterialFailure : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief A body can move without resistance. */
  class SingularSystem : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief An obstacle that forces move has nothing that holds it against its load. */
  class NothingResists : public NonConvergence
  {
  public:
    using NonConvergence::NonConvergence;

    bool
    names_its_cause() const override
    {
      return true;
    }

    /** Nothing is left of the stiffness: an attempt with half the step that finds this as well
     * tells that the step is not the cause. */
    std::optional<double>
    measure() const override
    {
      return 0.;
    }
  };

  /** @brief An obstacle that forces move slides on its whole contact, although friction could hold
   * it: the bodies move it too far in one step. */
  class ToolSlides : public NonConvergence
  {
  public:
    /** @param step Length of the step in time. Slip is saturated in each attempt, so that nothing
     * else tells them apart. */
    ToolSlides(const std::string &what, const double step)
      : NonConvergence(what)
      , step(step)
    {
    }

    std::optional<double>
    measure() const override
    {
      return step;
    }

  private:
    double step;
  };

  /** @brief A Newton increment is far larger than all bodies together. */
  class ExcessiveIncrement : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief A body that nothing but contact holds was thrown off what it touched. */
  class LostContact : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief Iterates have taken a body that nothing but contact holds farther than anything has
   * pushed it. */
  class StrayedBody : public NonConvergence
  {
    using NonConvergence::NonConvergence;
  };

  /** @brief The bodies touch in a way that contact rows cannot describe. */
  class UnresolvedContactFailure : public NonConvergence
  {
  public:
    using NonConvergence::NonConvergence;

    bool
    shorter_step_may_help() const override
    {
      return false;
    }
  };

  /** @brief Explicit dynamics cannot go on: a cell is inverted, a value is not finite, the stable
   * step collapses, or energy comes from nowhere. The length of output intervals does not matter to
   * it. */
  class ExplicitFailure : public NonConvergence
  {
  public:
    using NonConvergence::NonConvergence;

    bool
    shorter_step_may_help() const override
    {
      return false;
    }
  };

  /** @brief A step has gained energy that no load explains. It has no measure: a body that yields
   * within a step may gain as much in the next halves of it, and less in shorter ones. */
  class EnergyGain : public NonConvergence
  {
  public:
    using NonConvergence::NonConvergence;
  };
} // namespace Touchstone

#endif
