// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_step_quantity_h
#define touchstone_output_step_quantity_h

#include <touchstone/base/registry.h>
#include <touchstone/output/converged_step.h>

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/string.hpp>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief A value of a step with its name. */
  struct StepValue
  {
    enum Kind : unsigned int
    {
      count,
      number,
      vector
    };

    /** Name of a contact pair; empty for what belongs to the whole scene. */
    std::string           pair;
    std::string           name;
    unsigned int          kind = number;
    std::array<double, 3> components{};

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &pair &name &kind &components;
    }
  };

  /** @brief The values of a step in the order in which they were added. */
  class StepValues
  {
  public:
    /** @brief Add a number of things, a number, or a vector of the whole scene: the
     * column @p name (a vector has the columns "NAME x", "NAME y", "NAME z"). */
    void
    add(const std::string &name, const unsigned int value)
    {
      entries.push_back({"", name, StepValue::count, {{double(value), 0., 0.}}});
    }
    void
    add(const std::string &name, const double value)
    {
      entries.push_back({"", name, StepValue::number, {{value, 0., 0.}}});
    }
    void
    add(const std::string &name, const dealii::Tensor<1, dim> &value)
    {
      entries.push_back({"", name, StepValue::vector, {{value[0], value[1], value[2]}}});
    }

    /** @brief The same for a contact pair: the column "PAIR: NAME". */
    template <class Value>
    void
    add(const std::string &pair, const std::string &name, const Value &value)
    {
      add(name, value);
      entries.back().pair = pair;
    }

    std::vector<StepValue> entries;
  };

  /**
   * @brief A result of each converged step: one or more columns of the table `statistics`, and
   * members of "results" in summary.json, there with the values of the last step.
   *
   * There is one object of each registered class in a run. State that it keeps from step to step
   * must be returned by memory(), which checkpoints save.
   */
  class StepQuantity
  {
  public:
    virtual ~StepQuantity() = default;

    /** @brief Values at the end of @p step. Called on all ranks once for each step that is
     * kept, and must give the same on all of them. */
    virtual void
    evaluate(const ConvergedStep &step, StepValues &values) = 0;

    /** @brief Whether summary.json has the values of the last step. */
    virtual bool
    in_summary() const
    {
      return true;
    }

    /** @brief Whether it also has values of the state that the run starts from, which evaluate()
     * is then called for once more, with number, time and length zero. */
    virtual bool
    at_start() const
    {
      return false;
    }

    /** @brief Columns are sorted by this number, then by the names of the classes. */
    virtual unsigned int
    order() const
    {
      return 1000;
    }

    /** Numbers by any names, the same on all ranks. */
    using Memory = std::map<std::string, double>;

    /** @brief State needed to continue after a step, for example sums over the steps so far. */
    virtual Memory
    memory() const
    {
      return {};
    }

    /** @brief Continue from what memory() returned. */
    virtual void
    restore(const Memory & /*memory*/)
    {
    }
  };

  using StepQuantityRegistry = Registry<StepQuantity>;
} // namespace Touchstone

#endif
