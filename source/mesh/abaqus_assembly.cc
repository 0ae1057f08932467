// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/mesh/abaqus_assembly.h>
#include <touchstone/mesh/abaqus_lines.h>
#include <touchstone/mesh/mesh_text.h>
#include <touchstone/mesh/rotation.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <istream>

namespace Touchstone
{
  using namespace dealii;

  AbaqusAssembly::AbaqusAssembly(std::istream &in)
  {
    for (std::string line; std::getline(in, line);)
      file.push_back(line);

    std::string  part;
    unsigned int instance = 0, data_line = 0;
    bool         places_instance = false;
    for (unsigned int number = 1; number <= file.size(); ++number)
      try
        {
          const std::string &line       = file[number - 1];
          const bool         is_keyword = line[0] == '*' && line.compare(0, 2, "**") != 0;
          const auto         keyword    = is_keyword ? AbaqusKeyword(line) : AbaqusKeyword();
          places_instance               = places_instance && !is_keyword;
          if (keyword.name == "*PART")
            parts[part = in_capitals(keyword.value("NAME"))];
          else if (keyword.name == "*END PART")
            part.clear();
          else if (keyword.name == "*INSTANCE")
            {
              add_instance(keyword.value("NAME"), keyword.value("PART"));
              instance        = instances.size();
              places_instance = true;
              data_line       = 0;
            }
          else if (keyword.name == "*END INSTANCE")
            instance = 0;
          else if (!part.empty())
            parts[part].push_back(number);
          else if (places_instance && line.compare(0, 2, "**") != 0)
            place_instance(line, data_line++);
          else
            order.push_back({number, instance});
        }
      catch (const MeshFileError &error)
        {
          throw MeshFileError(number, error.what(), error.remedy);
        }
    if (instances.empty())
      for (const auto &part : parts)
        add_instance(part.first, part.first);
  }



  void
  AbaqusAssembly::add_instance(const std::string &name, const std::string &part)
  {
    const auto found = parts.find(in_capitals(part));
    if (found == parts.end())
      throw MeshFileError("There is no part '" + part + "' before its instance '" + name + "'.",
                          "write *PART before *ASSEMBLY, or save the model as one flat input");
    instances.push_back({name, {}, {}, unit_symmetric_tensor<3>()});
    for (const unsigned int number : found->second)
      order.push_back({number, n_instances()});
  }



  /** The nodes of a part are translated by the first line, and then rotated by an angle in degrees
   * about the axis from the first to the second point of the second line. */
  void
  AbaqusAssembly::place_instance(const std::string &line, const unsigned int data_line)
  {
    std::vector<double> x;
    for (const std::string &word : split_abaqus(line))
      x.push_back(word.empty() ? 0. : finite_number(word));
    Instance &instance = instances.back();
    if (data_line == 0 && x.size() <= 3)
      for (unsigned int d = 0; d < x.size(); ++d)
        instance.translation[d] = x[d];
    else if (data_line == 1 && x.size() == 7)
      {
        instance.point          = Point<3>(x[0], x[1], x[2]);
        const Tensor<1, 3> axis = Point<3>(x[3], x[4], x[5]) - instance.point;
        if (axis.norm() == 0)
          throw MeshFileError("The axis of an instance's rotation has no length.",
                              "write two points that differ, or leave the line out");
        instance.rotation = Touchstone::rotation(axis / axis.norm(), x[6]);
      }
    else
      throw MeshFileError("The file is damaged in *INSTANCE.");
  }



  std::string
  AbaqusAssembly::name(const unsigned int instance) const
  {
    return instance == 0 ? "" : instances[instance - 1].name;
  }



  Point<3>
  AbaqusAssembly::place(const Point<3> &point, const unsigned int instance) const
  {
    if (instance == 0)
      return point;
    const Instance &i = instances[instance - 1];
    return i.point + i.rotation * (point + i.translation - i.point);
  }



  unsigned int
  AbaqusAssembly::instance(const std::string &name) const
  {
    for (unsigned int i = 1; i <= n_instances(); ++i)
      if (in_capitals(this->name(i)) == in_capitals(name))
        return i;
    throw MeshFileError("There is no instance '" + name + "'.", "correct the name");
  }



  AbaqusName
  AbaqusAssembly::outer_name(const std::string &word) const
  {
    for (unsigned int i = 1; i <= n_instances(); ++i)
      if (const std::string prefix = name(i) + ".";
          in_capitals(word.substr(0, prefix.size())) == in_capitals(prefix))
        return {i, word.substr(prefix.size())};
    return {0, word};
  }



  std::string
  AbaqusAssembly::short_name(const AbaqusName &name, const std::vector<AbaqusName> &all) const
  {
    const bool is_unique = std::none_of(all.begin(), all.end(), [&name](const AbaqusName &other) {
      return other.second == name.second && other.first != name.first;
    });
    return name.first == 0 || is_unique ? name.second : this->name(name.first) + "." + name.second;
  }



  std::optional<AbaqusNumber>
  AbaqusAssembly::number(const std::string &word, const unsigned int instance) const
  {
    const AbaqusName outer = outer_name(word);
    if (outer.second.empty() || outer.second.size() > 17 ||
        outer.second.find_first_not_of("0123456789") != std::string::npos)
      return {};
    return AbaqusNumber(outer.first > 0 ? outer.first : instance, whole_number(outer.second));
  }
} // namespace Touchstone
