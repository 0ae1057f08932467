// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_base_stateful_h
#define touchstone_base_stateful_h

namespace Touchstone
{
  class ArchiveReader;
  class ArchiveWriter;

  /**
   * @brief An object with history: a step that has converged is committed, one that is
   * repeated is rolled back, and the committed state is written to checkpoints.
   *
   * An owner of several such objects keeps them in one list, so that no call omits one.
   */
  class Stateful
  {
  public:
    virtual ~Stateful() = default;

    /** @brief Keep the present state: the step has converged. */
    virtual void
    commit() = 0;

    /** @brief Return to the last committed state: the step is repeated. */
    virtual void
    rollback() = 0;

    /** @brief Put the committed state into a checkpoint. Collective. */
    virtual void
    save(ArchiveWriter &archive) const = 0;

    /** @brief Take the committed state from a checkpoint. Collective. @throws ArchiveError */
    virtual void
    load(const ArchiveReader &archive) = 0;
  };
} // namespace Touchstone

#endif
