// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/faceted_boundary.h>
#include <touchstone/mesh/forest.h>

#include <algorithm>
#include <array>
#include <iomanip>
#include <map>
#include <sstream>

// The boundaries and sets of nodes of all bodies: users refer to them by names or by the numbers of
// a mesh file, which are translated here into ids of the mesh, with messages that list what there
// is.
namespace Touchstone
{
  using namespace dealii;

  std::vector<std::string>
  Forest::names_of_node_sets(const unsigned int body) const
  {
    std::vector<std::string> result;
    for (const auto &[name, members] : node_sets[body])
      if (has_node_set(body, name))
        result.push_back(name);
    return result;
  }



  void
  Forest::vertex_has_moved(const unsigned int body,
                           const Point<dim>  &before,
                           const Point<dim>  &after)
  {
    const auto coordinates = [](const Point<dim> &x) {
      return std::array<double, dim>{{x[0], x[1], x[2]}};
    };
    for (auto &[name, members] : node_sets[body])
      if (members.count(coordinates(before)) > 0)
        members.insert(coordinates(after));
  }



  void
  Forest::add_boundaries(const BodyMesh                                         &mesh,
                         const std::map<types::boundary_id, types::boundary_id> &ids,
                         const std::vector<std::string>                         &symmetry)
  {
    names.emplace_back();
    node_sets.emplace_back();
    for (const auto &[name, members] : mesh.node_sets)
      for (const unsigned int v : members)
        node_sets.back()[name].insert(
          std::array<double, dim>{{mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]}});
    // A face of a mesh file can belong to several boundaries; such faces have an id of their
    // own, which each of those boundaries includes. So a boundary is a set of ids.
    std::map<types::boundary_id, BoundaryIds> ids_of;
    for (const auto &[own, id] : ids)
      if (const auto shared = mesh.shared.find(own); shared != mesh.shared.end())
        for (const types::boundary_id of : shared->second)
          ids_of[of].insert(id);
      else
        ids_of[own].insert(id);
    for (const auto &[own, list] : ids_of)
      names.back()[std::to_string(own)] = list;
    for (const auto &[name, own] : mesh.boundary_names)
      if (ids_of.count(own) > 0)
        names.back()[name] = ids_of.at(own);
    for (const auto &[own, surface] : mesh.surfaces)
      if (ids.count(own) > 0)
        surfaces[ids.at(own)] = surface;
    all_ids.emplace_back();
    for (const auto &[own, id] : ids)
      all_ids.back().insert(id);
    // Names that do not exist are refused where the planes are made.
    for (const std::string &name : symmetry)
      if (const auto found = names.back().find(name); found != names.back().end())
        for (const types::boundary_id id : found->second)
          all_ids.back().erase(id);
  }



  unsigned int
  Forest::n_bodies() const
  {
    return names.size();
  }



  BoundaryIds
  Forest::boundary(const unsigned int body,
                   const std::string &name,
                   const std::string &section,
                   const std::string &key) const
  {
    const auto found = names[body].find(name);
    if (found != names[body].end())
      return found->second;

    if (has_node_set(body, name))
      throw InputError(section,
                       key,
                       name,
                       "is a set of nodes, but faces are needed here",
                       "name a boundary; sets of nodes are for 'Fixed' and 'Boundary conditions'");
    // The message lists the names and numbers that would be accepted.
    std::string available;
    for (const auto &[other, id] : names[body])
      available += (available.empty() ? "'" : ", '") + other + "'";
    std::string sets;
    for (const auto &[other, members] : node_sets[body])
      sets += (sets.empty() ? ", and the sets of nodes '" : ", '") + other + "'";
    throw InputError(section,
                     key,
                     name,
                     "the body has no boundary of this name or number",
                     "it has " + available + sets + ".");
  }



  std::vector<BoundaryIds>
  Forest::boundaries(const unsigned int              body,
                     const std::vector<std::string> &names,
                     const std::string              &section,
                     const std::string              &key) const
  {
    // The same boundary under two names would get two conditions or be in contact twice.
    std::vector<BoundaryIds>           result;
    std::map<BoundaryIds, std::string> seen;
    for (const std::string &name : names)
      {
        result.push_back(boundary(body, name, section, key));
        const auto [other, is_new] = seen.insert({result.back(), name});
        if (!is_new)
          throw InputError(section,
                           key,
                           name,
                           other->second == name
                             ? "this boundary is listed twice"
                             : "this is the boundary that the list also calls '" + other->second +
                                 "'",
                           "name each boundary once");
      }
    return result;
  }



  BoundaryIds
  Forest::boundary_ids(const unsigned int              body,
                       const std::vector<std::string> &names,
                       const std::string              &section,
                       const std::string              &key) const
  {
    if (names == std::vector<std::string>{"all"} && this->names[body].count("all") == 0)
      return all_ids[body];
    BoundaryIds result;
    for (const BoundaryIds &ids : boundaries(body, names, section, key))
      result.insert(ids.begin(), ids.end());
    return result;
  }



  /** The name of a boundary id for messages and output. */
  std::string
  Forest::boundary_name(const types::boundary_id id) const
  {
    std::string result = std::to_string(id);
    for (const auto &of_body : names)
      for (const auto &[name, ids] : of_body)
        // Numbers come before letters, a name is better.
        if (ids.count(id) > 0)
          result = name;
    return result;
  }



  std::map<BoundaryIds, std::string>
  Forest::names_of_boundaries(const unsigned int body) const
  {
    std::map<BoundaryIds, std::string> result;
    // Numbers come before letters, a name is better.
    for (const auto &[name, ids] : names[body])
      result[ids] = name;
    return result;
  }



  std::shared_ptr<const AnalyticSurface>
  Forest::surface(const types::boundary_id id) const
  {
    // Null means that contact knows the facets of the mesh alone (doc/theory.md, section 4).
    const auto found = surfaces.find(id);
    return found != surfaces.end() ? found->second : nullptr;
  }



  /** Say so where contact takes the faces of boundaries for a curved surface that they divide. */
  void
  Forest::notice_facets(const BodyMesh    &all,
                        const BoundaryIds &ids,
                        const std::string &body,
                        const std::string &section)
  {
    const FacetedBoundary found = find_facets(all, ids, [this](const CellData<2> &face) {
      return face.manifold_id == numbers::flat_manifold_id && surfaces.count(face.boundary_id) == 0;
    });
    if (found.rise == 0.)
      return;
    std::ostringstream text;
    text << std::setprecision(3) << "Boundary '" << boundary_name(found.boundary) << "' of body '"
         << body << "' has flat faces that bend by " << found.bend
         << " degrees from one to the next, and contact takes them for the surface: a smooth one "
            "would rise by "
         << found.rise
         << " over them. If a smooth one is meant, and the other side does not have the same "
            "faces, give its shape by 'Exact surfaces' or by nodes in the middle of edges (20 or "
            "27 a cell), or set 'Master normal = smoothed' in "
            "section '"
         << section << "'.";
    if (std::find(notices.begin(), notices.end(), text.str()) == notices.end())
      notices.push_back(text.str());
  }
} // namespace Touchstone
