// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_summary_h
#define touchstone_output_summary_h

#include <touchstone/contact/results.h>
#include <touchstone/explicit/impulse_work.h>
#include <touchstone/output/json.h>
#include <touchstone/output/motion.h>
#include <touchstone/output/step_quantity.h>

#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Results and costs of a run: the contents of summary.json. */
  struct RunSummary
  {
    std::string   title, version;
    bool          converged = false;
    unsigned int  ranks     = 1;
    std::uint64_t cells     = 0;
    std::uint64_t unknowns  = 0;
    /** What contact of explicit dynamics had to do. */
    ImpulseWork contact_work;
    /** Load steps that converged. */
    unsigned int steps = 0;
    /** Cycles of explicit dynamics in them; 0 for implicit runs. */
    std::uint64_t cycles = 0;

    /** @brief A mesh on which a step was solved. */
    struct Mesh
    {
      unsigned int  step     = 0;
      std::uint64_t cells    = 0;
      std::uint64_t unknowns = 0;
      /** Relative error of the stress in the energy norm, estimated; no unit. */
      double estimated_error = 0.;

      /** @brief For checkpoints; names all members. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        auto &[number, n_cells, n_dofs, error] = *this;
        archive &number &n_cells &n_dofs &error;
      }
    };
    /** Those that were estimated, in their order; empty without refinement. */
    std::vector<Mesh> meshes;

    struct Iterations
    {
      unsigned int newton = 0;
      /** Iterations in which the contact state changed. */
      unsigned int contact = 0;
      /** Iterations of which the line search took a part only. */
      unsigned int damped       = 0;
      unsigned int linear_total = 0;
      /** Per linear solve. */
      double linear_mean = 0.;

      /** @brief For checkpoints; names all members. The mean follows from the solver. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        auto &[of_newton, of_contact, shortened, of_solver, mean] = *this;
        (void)mean;
        archive &of_newton &of_contact &shortened &of_solver;
      }
    };
    Iterations iterations;

    struct Counts
    {
      unsigned int assemblies            = 0;
      unsigned int factorisations        = 0;
      unsigned int preconditioner_setups = 0;
      unsigned int searches              = 0;
    };
    Counts counts;

    /** @brief Seconds; all are wall clock but cpu, which is summed over ranks. */
    struct Seconds
    {
      double wall          = 0.;
      double cpu           = 0.;
      double assembly      = 0.;
      double linear_solver = 0.;
      double search        = 0.;
      double output        = 0.;

      /** @brief For checkpoints; names all members. */
      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        auto &[of_clock, of_ranks, assembling, solving, searching, writing] = *this;
        archive &of_clock &of_ranks &assembling &solving &searching &writing;
      }
    };
    Seconds seconds;

    /** @brief How evenly one kind of work is spread over the ranks, in counts. */
    struct Balance
    {
      double mean = 0., max = 0.;

      /** @brief 1 is even; the number of ranks is the worst. */
      double
      imbalance() const
      {
        return mean > 0. ? max / mean : 1.;
      }
    };
    /** By phase, in the order of output. */
    std::vector<std::pair<std::string, Balance>> balance;

    /** @brief The imbalances in one line. */
    std::string
    balance_line() const;

    /** Summed over ranks, MB. */
    double peak_memory_mb = 0.;

    /** Result of each contact pair, by its name. */
    std::map<std::string, PairResult> contact;
    /** Force of the support on the body, by body and boundary. */
    std::map<std::string, std::map<std::string, dealii::Tensor<1, dim>>> reactions;
    /** Largest equivalent plastic strain of bodies that have one, by name; no unit. */
    std::map<std::string, double> plastic_strain;
    /** Those of registered StepQuantity classes at the last step. */
    std::vector<StepValue> quantities;
    /** Relative errors against the reference solution; no unit. */
    std::map<std::string, double> errors;
    /** Only where there is inertia. */
    std::optional<Motion> motion;
    /** Names of the phases of the run and when they end; none if it has one without a name. */
    std::vector<std::pair<std::string, double>> phases;
    /** What the user should know of the results. */
    std::vector<std::string> warnings;
    /** Why the run did not converge; empty if it did. */
    std::string failure;
    /** A signal has ended it. */
    bool interrupted = false;

    /** @brief For checkpoints: what is counted or known step by step; the rest is found out at
     * the end, or saved by its owner. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int version)
    {
      archive &steps &meshes &contact &reactions;
      iterations.serialize(archive, version);
      seconds.serialize(archive, version);
    }

    Json
    to_json() const;

    /**
     * @brief Print results and errors, without times, such that the text is the
     * same for any number of ranks and any solver: six digits, and what is below
     * 1e-9 of the largest force (moment) counts as zero.
     */
    void
    print_results(std::ostream &out, bool with_iterations = true) const;
  };
} // namespace Touchstone

#endif
