#ifndef touchstone_output_contact_output_h
#define touchstone_output_contact_output_h

#include <touchstone/contact/results.h>
#include <touchstone/output/picture_series.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Contact results by pair and node. */
  using ContactPointMap = std::map<std::pair<unsigned int, Index>, ContactPoint>;

  /**
   * @brief The results at all nodes of this rank's @p faces, wherever the nodes
   * are owned. Collective.
   * @param faces  Slave faces of this rank.
   * @param points Results at the slave nodes that this rank owns.
   */
  ContactPointMap
  collect_contact_points(const std::vector<ContactFace>  &faces,
                         const std::vector<ContactPoint> &points,
                         MPI_Comm                         communicator);

  /** @brief One set of slave faces in the form that deal.II's writers take. */
  class ContactPicture : public dealii::DataOutInterface<2, 3>
  {
  public:
    /** @brief Faces with a node that is missing from @p points are left out. */
    ContactPicture(const std::vector<ContactFace> &faces, const ContactPointMap &points);

    const std::vector<dealii::DataOutBase::Patch<2, 3>> &
    get_patches() const override;

    std::vector<std::string>
    get_dataset_names() const override;

    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
    get_nonscalar_data_ranges() const override;

  private:
    std::vector<dealii::DataOutBase::Patch<2, 3>> patches;
  };

  /**
   * @brief Pictures of the contact surfaces: contact.pvd.
   *
   * Shown on the undeformed slave faces: status (see ContactStatus), gap,
   * pressure, pair number, length of the slip path, normal, traction, slip of the
   * last step and displacement.
   */
  class ContactOutput
  {
  public:
    /** @param folder Must outlive this object. */
    explicit ContactOutput(const OutputFolder &folder);

    /** @brief Write the picture of one step, unless no rank has any face.
     * Collective. @throws OutputError on all ranks. */
    void
    write(const std::vector<ContactFace>  &faces,
          const std::vector<ContactPoint> &points,
          unsigned int                     step,
          double                           time);

    /** @brief The pictures so far, which a run that goes on adds to. */
    PictureSeries &
    series()
    {
      return pictures;
    }

  private:
    const OutputFolder &folder;
    PictureSeries       pictures;
  };
} // namespace Touchstone

#endif
