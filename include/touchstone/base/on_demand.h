// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_on_demand_h
#define touchstone_base_on_demand_h

#include <memory>

namespace Touchstone
{
  /** @brief A value that few of many objects need: it is that of the default constructor, and takes
   * no memory, until it is first asked for through an object that is not const. Copies are
   * independent. */
  template <class T>
  class OnDemand
  {
  public:
    OnDemand() = default;
    OnDemand(const OnDemand &other)
      : value(other.value ? std::make_unique<T>(*other.value) : nullptr)
    {
    }
    OnDemand(OnDemand &&) = default;

    OnDemand &
    operator=(const OnDemand &other)
    {
      if (value && other.value)
        *value = *other.value;
      else
        value = other.value ? std::make_unique<T>(*other.value) : nullptr;
      return *this;
    }
    OnDemand &
    operator=(OnDemand &&) = default;

    /** @brief Whether it has been asked for. */
    bool
    made() const
    {
      return value != nullptr;
    }

    T &
    operator*()
    {
      if (!value)
        value = std::make_unique<T>();
      return *value;
    }
    const T &
    operator*() const
    {
      static const T by_default{};
      return value ? *value : by_default;
    }

    T *
    operator->()
    {
      return &**this;
    }
    const T *
    operator->() const
    {
      return &**this;
    }

  private:
    std::unique_ptr<T> value;
  };
} // namespace Touchstone

#endif
