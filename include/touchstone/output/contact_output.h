// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_contact_output_h
#define touchstone_output_contact_output_h

#include <touchstone/contact/results.h>
#include <touchstone/output/contact_field.h>
#include <touchstone/output/vtu_series.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief What the VTU files show at a node of a slave face. */
  struct ContactNode
  {
    dealii::Point<dim> reference_position;
    /** Of all fields, in the order of ContactFieldList. */
    std::vector<double> values;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &reference_position &values;
    }
  };

  /** @brief Nodes by the number of the pair and of the node. */
  using ContactNodeMap = std::map<std::pair<unsigned int, Index>, ContactNode>;

  /**
   * @brief The values of @p fields at all nodes of this rank's @p faces, wherever the nodes
   * are owned. Collective.
   * @param faces  Slave faces of this rank.
   * @param points Results at the slave nodes that this rank owns.
   */
  ContactNodeMap
  collect_contact_nodes(const ContactFieldList          &fields,
                        const std::vector<ContactFace>  &faces,
                        const std::vector<ContactPoint> &points,
                        MPI_Comm                         communicator);

  /** @brief One set of slave faces in the form that deal.II's writers take. */
  class ContactSurfaceData : public dealii::DataOutInterface<2, 3>
  {
  public:
    /** @brief Faces with a node that is missing from @p nodes are left out. */
    ContactSurfaceData(const ContactFieldList         &fields,
                       const std::vector<ContactFace> &faces,
                       const ContactNodeMap           &nodes);

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
    const ContactFieldList                       &fields;
    std::vector<dealii::DataOutBase::Patch<2, 3>> patches;
  };

  /** @brief VTU output of the contact surfaces: contact.pvd, with all registered
   * ContactField classes on the undeformed slave faces. */
  class ContactOutput
  {
  public:
    /** @param folder Must outlive this object. */
    explicit ContactOutput(const OutputFolder &folder);

    /** @brief Write the file of one step, unless no rank has any face.
     * Collective. @throws OutputError on all ranks. */
    void
    write(const std::vector<ContactFace>  &faces,
          const std::vector<ContactPoint> &points,
          unsigned int                     step,
          double                           time);

    /** @brief The files so far, which a resumed run adds to. */
    VtuSeries &
    series()
    {
      return files;
    }

  private:
    const OutputFolder    &folder;
    const ContactFieldList fields;
    VtuSeries              files;
  };
} // namespace Touchstone

#endif
