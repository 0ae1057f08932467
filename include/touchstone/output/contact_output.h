// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_contact_output_h
#define touchstone_output_contact_output_h

#include <touchstone/contact/results.h>
#include <touchstone/output/contact_field.h>
#include <touchstone/output/file_series.h>

#include <deal.II/base/index_set.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief What the files show at a node of a contact surface. */
  struct ContactNode
  {
    dealii::Point<dim> reference_position;
    /** Of all fields, in the order of ContactFieldList. */
    std::vector<double> values;
  };

  /** @brief Nodes by the number of the pair and of the node. */
  using ContactNodeMap = std::map<std::pair<unsigned int, Index>, ContactNode>;

  /**
   * @brief The values of @p fields at all nodes of this rank's @p faces, wherever the nodes
   * are owned. Collective.
   * @param faces  Slave or master faces of this rank.
   * @param points Results at the nodes of this side that this rank owns.
   * @param owned  Dofs of this rank: whom others ask for the values of their nodes.
   */
  ContactNodeMap
  collect_contact_nodes(const ContactFieldList          &fields,
                        const std::vector<ContactFace>  &faces,
                        const std::vector<ContactPoint> &points,
                        const dealii::IndexSet          &owned,
                        MPI_Comm                         communicator);

  /** @brief One set of faces in the form that deal.II's writers take. */
  class ContactSurfaceData : public dealii::DataOutInterface<2, 3>
  {
  public:
    /** @brief Faces with a node that is missing from @p nodes are left out.
     * @param with_rests Add what single precision leaves of the numbers, see FileSeries. */
    ContactSurfaceData(const ContactFieldList         &fields,
                       const std::vector<ContactFace> &faces,
                       const ContactNodeMap           &nodes,
                       bool                            with_rests = false);

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
    const bool                                    with_rests;
    std::vector<dealii::DataOutBase::Patch<2, 3>> patches;
  };

  /** @brief Output of one side of the contact surfaces: contact.pvd or master_contact.pvd, with all
   * registered ContactField classes on the undeformed faces. */
  class ContactOutput
  {
  public:
    /** @param folder Must outlive this object.
     * @param name   Common beginning of the file names. */
    explicit ContactOutput(const OutputFolder &folder,
                           ResultFormat        format = ResultFormat::vtu,
                           const std::string  &name   = "contact");

    /** @brief Write the file of one step, unless no rank has any face. Parameters as of
     * collect_contact_nodes(). Collective. @throws OutputError on all ranks. */
    void
    write(const std::vector<ContactFace>  &faces,
          const std::vector<ContactPoint> &points,
          const dealii::IndexSet          &owned,
          unsigned int                     step,
          double                           time);

    /** @brief The files so far, which a resumed run adds to. */
    FileSeries &
    series()
    {
      return *files;
    }

  private:
    const OutputFolder         &folder;
    const ContactFieldList      fields;
    std::unique_ptr<FileSeries> files;
  };
} // namespace Touchstone

#endif
