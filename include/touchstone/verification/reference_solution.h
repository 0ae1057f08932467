// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_verification_reference_solution_h
#define touchstone_verification_reference_solution_h

#include <touchstone/base/registry.h>
#include <touchstone/contact/results.h>
#include <touchstone/output/motion.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/solid.h>
#include <touchstone/verification/reference_values.h>

#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /** @brief The results that are compared with a reference solution. */
  struct ReferenceInput
  {
    const Solid *solid = nullptr;
    /** With ghosts. */
    const Vector *displacement = nullptr;
    /** Slave nodes of this rank; those of other pairs are passed over. */
    std::vector<ContactPoint> points;
    /** In the order of the scene's pairs. */
    std::vector<PairResult> pair_results;
    /** In the order of the scene's pairs; empty where traction fields are not asked for. */
    std::vector<PairBoundaries> boundaries;
    /** Null without inertia. */
    const Motion *motion       = nullptr;
    MPI_Comm      communicator = MPI_COMM_SELF;
  };

  /** @brief The outcome of a comparison, the same on all ranks. */
  struct ReferenceComparison
  {
    /** Relative errors by name; NaN where there is nothing to compare. */
    std::map<std::string, double> errors;
    /** The same as text, a line for each quantity. */
    std::vector<std::string> lines;

    /** @brief Add an error, and a line "WHAT: computed A, exact B, error C". */
    void
    add(const std::string &name, const std::string &what, double computed, double exact);

    /** @brief Add an error, and a line "WHAT: error C". */
    void
    add(const std::string &name, const std::string &what, double error);
  };

  /**
   * @brief The exact answer of a scene. Registered by name with a constructor
   * that takes the scene and throws InputError for bad values.
   */
  class ReferenceSolution
  {
  public:
    virtual ~ReferenceSolution() = default;

    /** @brief Before the run: whether the mesh has what is compared. Collective.
     * @throws InputError on all ranks */
    virtual void
    check_mesh(const Solid &) const
    {
    }

    /** @brief Compare the result of the last step. Collective. */
    virtual ReferenceComparison
    compare(const ReferenceInput &input) const = 0;

    /** @brief The errors of compare() alone. Collective. */
    std::map<std::string, double>
    errors(const ReferenceInput &input) const;
  };

  using ReferenceRegistry = Registry<ReferenceSolution, const Scene &>;

  /** @brief Number of the pair that the scene names for comparison, or 0.
   * @throws InputError if there is no such pair. */
  unsigned int
  reference_pair(const Scene &scene);

  /** @brief The points that belong to @p pair and have an area. */
  std::vector<ContactPoint>
  points_of_pair(const std::vector<ContactPoint> &points, unsigned int pair);
} // namespace Touchstone

#endif
