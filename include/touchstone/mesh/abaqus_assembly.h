// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_abaqus_assembly_h
#define touchstone_mesh_abaqus_assembly_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Number of a node or element, or name of a set, and the instance that has it: 0 is the
   * file or its assembly itself. */
  using AbaqusNumber = std::pair<unsigned int, unsigned long>;
  using AbaqusName   = std::pair<unsigned int, std::string>;

  /**
   * @brief The lines of an Abaqus file with the lines of each part (*PART) at the places of its
   * instances (*INSTANCE), as if all instances were written out.
   *
   * Parts number their nodes and elements and name their sets each for itself. Outside, "X.5" and
   * "X.set" are those of the instance X. A file whose parts have no instances is read as if each
   * had one of its own name, where it is.
   */
  class AbaqusAssembly
  {
  public:
    /** @brief A line of the file, counted from one, and the instance for which it is read. */
    struct Line
    {
      unsigned int number;
      unsigned int instance;
    };

    /** @throws MeshFileError for instances of parts that are not there, and what places them. */
    explicit AbaqusAssembly(std::istream &in);

    const std::vector<Line> &
    lines() const
    {
      return order;
    }

    const std::string &
    text(const Line &line) const
    {
      return file[line.number - 1];
    }

    /** @brief Number of instances, which are counted from one. */
    unsigned int
    n_instances() const
    {
      return instances.size();
    }

    /** @brief Name of an instance, empty for 0. */
    std::string
    name(unsigned int instance) const;

    /** @brief A point of the part where the instance has it. */
    dealii::Point<3>
    place(const dealii::Point<3> &point, unsigned int instance) const;

    /** @brief The instance that a keyword's parameter INSTANCE names.
     * @throws MeshFileError if there is none */
    unsigned int
    instance(const std::string &name) const;

    /** @brief "X.rest" is (X, rest) if X is an instance, else @p word is (0, word). */
    AbaqusName
    outer_name(const std::string &word) const;

    /** @brief The name alone if none of @p all but this one has it, else with its instance,
     * "X.name". */
    std::string
    short_name(const AbaqusName &name, const std::vector<AbaqusName> &all) const;

    /** @brief "5" in an instance, or "X.5"; nothing if the word is no number. */
    std::optional<AbaqusNumber>
    number(const std::string &word, unsigned int instance) const;

  private:
    /** *INSTANCE: translated, then rotated. */
    struct Instance
    {
      std::string          name;
      dealii::Tensor<1, 3> translation;
      /** Rotation by an angle about the axis through a point. */
      dealii::Point<3>     point;
      dealii::Tensor<2, 3> rotation;
    };

    /** Read the first or second data line of *INSTANCE. */
    void
    place_instance(const std::string &line, unsigned int data_line);
    /** Add an instance with the lines of its part. */
    void
    add_instance(const std::string &name, const std::string &part);

    std::vector<std::string> file;
    std::vector<Line>        order;
    std::vector<Instance>    instances;
    /** Numbers of the lines of each part, by its name in capitals. */
    std::map<std::string, std::vector<unsigned int>> parts;
  };
} // namespace Touchstone

#endif
