#ifndef touchstone_output_statistics_h
#define touchstone_output_statistics_h

#include <touchstone/base/folder.h>
#include <touchstone/contact/results.h>

#include <deal.II/base/table_handler.h>

#include <map>
#include <optional>
#include <string>

namespace Touchstone
{
  /** @brief What the table has to say about a converged load step. */
  struct StepRecord
  {
    unsigned int step              = 0;
    double       time              = 0.;
    double       step_size         = 0.;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    /** How often the step was cut before it converged. */
    unsigned int cuts = 0;
    /** By name of the contact pair. */
    std::map<std::string, PairResult> pairs;
    /** Reaction forces, by any name, e.g. "BODY/BOUNDARY". */
    std::map<std::string, dealii::Tensor<1, dim>> reactions;
    /** Energies by name, force times length. */
    std::map<std::string, double> energies;
    /** Where there is inertia: momentum, and angular momentum about the origin. */
    std::optional<dealii::Tensor<1, dim>> momentum, angular_momentum;
  };

  /**
   * @brief The table `statistics`: a row for each converged step.
   *
   * The columns are described in lines that begin with '#', so that gnuplot and
   * numpy.loadtxt read the file as it is.
   */
  class Statistics
  {
  public:
    /** @param folder Must outlive this object. */
    explicit Statistics(const OutputFolder &folder);

    /** @brief Add a row and write the file. Collective; the record of rank 0
     * counts. @throws OutputError */
    void
    add_step(const StepRecord &record);

    /** @brief The table as it is, for restore(). */
    const dealii::TableHandler &
    rows() const
    {
      return table;
    }

    /** @brief Go on from rows that were written before. Collective; those of rank 0
     * count. @throws OutputError */
    void
    restore(const dealii::TableHandler &rows);

  private:
    const OutputFolder  &folder;
    dealii::TableHandler table;

    /** @brief Add a value with the format of all real numbers of the table. */
    void
    add(const std::string &column, double value);

    void
    write() const;

    /** @brief Add the three columns of a vector. */
    void
    add(const std::string &column, const dealii::Tensor<1, dim> &value);
  };
} // namespace Touchstone

#endif
