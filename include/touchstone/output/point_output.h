// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_point_output_h
#define touchstone_output_point_output_h

#include <touchstone/output/file_series.h>
#include <touchstone/solid/solid.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace Touchstone
{
  /** @brief A cloud of points with values in the form that deal.II's writers take. */
  class PointCloudData : public dealii::DataOutInterface<0, 3>
  {
  public:
    /** @param names   Of each component; equal ones that follow one another are a vector (3) or a
     *                tensor (9).
     * @param format  Whether it has tensors, of which components have names otherwise, and doubles.
     */
    PointCloudData(std::vector<std::string> names, const FileSeries &format);

    /** @brief Add a point with a value for each name. */
    void
    add(const dealii::Point<dim> &position, const std::vector<double> &values);

    const std::vector<dealii::DataOutBase::Patch<0, 3>> &
    get_patches() const override;

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    std::vector<std::string>                      names;
    const bool                                    tensors, with_rests;
    std::vector<dealii::DataOutBase::Patch<0, 3>> patches;
  };

  /**
   * @brief Output of what the quadrature points of the bodies have, points.pvd: nothing is averaged
   * or extrapolated.
   *
   * Fields: displacement (length), Cauchy stress and von_mises (force per area), volume
   * (length cubed; with it as weight a field is integrated over the present volume), body, and
   * equivalent_plastic_strain where there is plastic flow. Positions are those of the reference
   * state.
   */
  class PointOutput
  {
  public:
    /** @param solid, folder Must outlive this object. */
    PointOutput(const Solid &solid, const OutputFolder &folder, ResultFormat format);

    /** @brief Write the file of one step. @param displacement With ghosts.
     * @throws OutputError on all ranks. Collective. */
    void
    write(const Vector &displacement, unsigned int step, double time);

    /** @brief The files so far, which a resumed run adds to. */
    FileSeries &
    series()
    {
      return *files;
    }

  private:
    const Solid                &solid;
    std::unique_ptr<FileSeries> files;
  };
} // namespace Touchstone

#endif
