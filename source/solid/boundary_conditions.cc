// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>

#include <set>

// Displacements, supports, tractions, pressures and body forces of all bodies. The constructor,
// here, translates the boundary names of the input to nodes and faces of the mesh; afterwards
// prescribe() and reactions() (supports.cc) give the displacements to the ConstraintGraph and
// attribute the unbalanced forces of supported nodes, and external_force() (external_force.cc)
// integrates the loads. The stiffness matrix knows none of this: it is assembled without conditions
// (doc/theory.md, sections 2.1 and 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    Tensor<1, dim>
    axis(const unsigned int d)
    {
      Tensor<1, dim> e;
      e[d] = 1.;
      return e;
    }

    /** Refuse entries of a boundary that 'Fixed' or 'Symmetry' would override. The
     * normal of the symmetry plane is zero where there is none. */
    void
    check_not_held(const std::string        &section,
                   const BoundaryParameters &condition,
                   const bool                fixed,
                   const Tensor<1, dim>     &plane)
    {
      // Along a plane that is oblique to the axes every component can be prescribed.
      constexpr double parallel = 0.999;
      for (const auto &[key, text] : condition.formulas())
        {
          const std::size_t d = std::string("xyz").find(key.back());
          // The pressure, and moments but that about the normal, push across.
          const bool about  = key.rfind("Moment", 0) == 0;
          const bool across = d != std::string::npos && about
                                ? plane.norm() > 0. && std::abs(plane[d]) <= parallel
                              : d != std::string::npos ? std::abs(plane[d]) > parallel
                                                       : plane.norm() > 0.;
          if (!text.empty() && (fixed || across))
            throw InputError(section,
                             key,
                             text,
                             std::string("this boundary is held in this direction by '") +
                               (fixed ? "Fixed" : "Symmetry") + "' of the body",
                             "remove this entry or take the boundary from that list");
        }
    }



    /** Names of boundaries, and those of sets of nodes. */
    std::pair<std::vector<std::string>, std::vector<std::string>>
    divide(const Forest &forest, const unsigned int body, const std::vector<std::string> &names)
    {
      std::pair<std::vector<std::string>, std::vector<std::string>> result;
      for (const std::string &name : names)
        (forest.has_node_set(body, name) ? result.second : result.first).push_back(name);
      return result;
    }
  } // namespace



  /** Visit each node of a boundary that this rank knows once, hanging ones as well, with a
   * function that computes its position. Ghost cells are visited, too, since a rank can own
   * a node whose boundary face belongs to a cell of another rank. */
  template <typename Visit>
  void
  BoundaryConditions::for_each_node_on(const BoundaryIds &boundary, const Visit &visit) const
  {
    const auto        &fe = solid.fe;
    std::set<Index>    seen;
    std::vector<Index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (!cell->is_artificial())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              cell->get_dof_indices(dofs);
              for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
                if (fe.system_to_component_index(i).first == 0 && fe.has_support_on_face(i, f) &&
                    seen.insert(dofs[i]).second)
                  visit(dofs[i] / dim, [&] {
                    return solid.mapping.transform_unit_to_real_cell(cell,
                                                                     fe.unit_support_point(i));
                  });
            }
  }



  BoundaryConditions::BoundaryConditions(const Forest &forest, const Solid &solid)
    : solid(solid)
    , following(solid)
    , springs(solid)
  {
    for (unsigned int b = 0; b < solid.bodies.size(); ++b)
      {
        // The order of the conditions of a body is their precedence, for the ConstraintGraph
        // drops a condition that earlier ones of the same node already imply: fixed boundaries,
        // then symmetry, then displacements.
        const BodyParameters &body    = solid.bodies[b];
        const std::string     section = "Body " + body.name;
        // Each list once, under whatever name: a name and a number can mean the same.
        // Sets of nodes come behind boundaries.
        const auto [fixed, fixed_sets]         = divide(forest, b, body.fixed);
        const auto [of_faces, conditions_sets] = divide(forest, b, body.conditions);
        Supported  supported{forest.boundaries(b, fixed, section, "Fixed"), {}};
        const auto symmetry   = forest.boundaries(b, body.symmetry, section, "Symmetry");
        const auto conditions = forest.boundaries(b, of_faces, section, "Boundary conditions");
        for (std::size_t k = 0; k < supported.fixed.size(); ++k)
          {
            supports.push_back({body.name, fixed[k], Tensor<1, dim>()});
            for (unsigned int d = 0; d < dim; ++d)
              prescribe_on(supported.fixed[k], axis(d), nullptr, b, supports.size() - 1);
          }
        for (const std::string &name : fixed_sets)
          {
            supports.push_back({body.name, name, Tensor<1, dim>()});
            for (const SetNode &node : nodes_of_set(forest, solid, b, name))
              for (unsigned int d = 0; d < dim; ++d)
                prescribed.push_back({node.node,
                                      axis(d),
                                      nullptr,
                                      node.position,
                                      b,
                                      static_cast<unsigned int>(supports.size() - 1)});
          }
        for (std::size_t k = 0; k < symmetry.size(); ++k)
          add_symmetry(b, symmetry[k], body.symmetry[k], supported);
        for (std::size_t k = 0; k < conditions.size(); ++k)
          add_condition(b, conditions[k], of_faces[k], supported);
        for (const std::string &name : conditions_sets)
          add_set_condition(forest, b, name);
        body_forces.push_back({{formulas.add(section, "Body force x", body.body_force[0]),
                                formulas.add(section, "Body force y", body.body_force[1]),
                                formulas.add(section, "Body force z", body.body_force[2])}});
      }
    // Without any body force an empty list saves the loop over all cells at each evaluation.
    if (std::none_of(body_forces.begin(), body_forces.end(), [](const auto &force) {
          return force[0] || force[1] || force[2];
        }))
      body_forces.clear();
  }



  void
  BoundaryConditions::add_symmetry(const unsigned int b,
                                   const BoundaryIds &id,
                                   const std::string &name,
                                   Supported         &supported)
  {
    const BodyParameters &body    = solid.bodies[b];
    const std::string     section = "Body " + body.name;
    if (supported.is_fixed(id))
      throw InputError(section,
                       "Symmetry",
                       name,
                       "this boundary is also in the list 'Fixed'",
                       "name it once: a fixed boundary needs no symmetry");
    supports.push_back({body.name, name, Tensor<1, dim>()});
    supported.planes[id] = plane_normal(id, section, name);
    prescribe_on(id, supported.planes[id], nullptr, b, supports.size() - 1);
    // Contact surfaces average their normals with what lies beyond planes of symmetry, also at
    // hanging nodes and those of other ranks: the planes of each node are kept.
    for_each_node_on(id, [&](const Index node, const auto &) {
      mirror_normals[node].push_back(supported.planes[id]);
    });
  }



  void
  BoundaryConditions::add_condition(const unsigned int b,
                                    const BoundaryIds &id,
                                    const std::string &name,
                                    const Supported   &supported)
  {
    const BodyParameters     &body      = solid.bodies[b];
    const BoundaryParameters &condition = body.boundaries.at(name);
    const std::string         section   = "Body " + body.name + "/Boundary " + name;
    const auto                plane     = supported.planes.find(id);
    check_not_held(section,
                   condition,
                   supported.is_fixed(id),
                   plane != supported.planes.end() ? plane->second : Tensor<1, dim>());
    for (const auto &[key, value] :
         {std::make_pair("Spring stiffness normal", condition.spring_normal),
          std::make_pair("Spring stiffness tangential", condition.spring_tangential)})
      if (value > 0. && supported.is_fixed(id))
        throw InputError(section,
                         key,
                         Patterns::Tools::to_string(value),
                         "has no effect: 'Fixed' of the body holds this boundary",
                         "remove this entry or take the boundary from that list");
    if (condition.spring_normal > 0. && plane != supported.planes.end())
      throw InputError(section,
                       "Spring stiffness normal",
                       Patterns::Tools::to_string(condition.spring_normal),
                       "has no effect: 'Symmetry' of the body holds this boundary along its normal",
                       "remove this entry or take the boundary from that list");
    const auto parse = [&](const std::string &key, const std::string &text) {
      return formulas.add(section, key, text);
    };
    const std::array<Function, dim> displacement = {
      {parse("Displacement x", condition.displacement_x),
       parse("Displacement y", condition.displacement_y),
       parse("Displacement z", condition.displacement_z)}};
    if (displacement[0] || displacement[1] || displacement[2])
      supports.push_back({body.name, name, Tensor<1, dim>()});
    for (unsigned int d = 0; d < dim; ++d)
      if (displacement[d])
        prescribe_on(id, axis(d), displacement[d], b, supports.size() - 1);
    const auto pressure = parse("Pressure", condition.pressure);
    const bool follows  = pressure && condition.follows(body.material);
    // A pressure on the deformed surface depends on the displacement and has a stiffness
    // (doc/theory.md 2.3); one on the reference surface is a dead load.
    if (follows)
      following.add(id, pressure);
    const Load load{id,
                    {{parse("Traction x", condition.traction_x),
                      parse("Traction y", condition.traction_y),
                      parse("Traction z", condition.traction_z)}},
                    follows ? nullptr : pressure,
                    make_resultant(b, id, condition, section)};
    if (condition.spring_normal > 0. || condition.spring_tangential > 0.)
      springs.add({id, condition.spring_normal, condition.spring_tangential});
    if (load.resultant || load.pressure || load.traction[0] || load.traction[1] || load.traction[2])
      loads.push_back(load);
  }



  void
  BoundaryConditions::add_set_condition(const Forest      &forest,
                                        const unsigned int b,
                                        const std::string &name)
  {
    const BodyParameters     &body      = solid.bodies[b];
    const BoundaryParameters &condition = body.boundaries.at(name);
    const std::string         section   = "Body " + body.name + "/Boundary " + name;
    check_for_node_set(condition, section);
    std::vector<SetNode> nodes           = nodes_of_set(forest, solid, b, name);
    const std::string   *displacements[] = {&condition.displacement_x,
                                            &condition.displacement_y,
                                            &condition.displacement_z};
    bool                 moved           = false;
    for (unsigned int d = 0; d < dim; ++d)
      if (const Function value =
            formulas.add(section, "Displacement " + std::string(1, "xyz"[d]), *displacements[d]))
        {
          if (!moved)
            supports.push_back({body.name, name, Tensor<1, dim>()});
          moved = true;
          for (const SetNode &node : nodes)
            prescribed.push_back({node.node,
                                  axis(d),
                                  value,
                                  node.position,
                                  b,
                                  static_cast<unsigned int>(supports.size() - 1)});
        }
    if (!condition.has_resultant())
      return;
    NodeSetLoad load;
    for (unsigned int d = 0; d < dim; ++d)
      load.force[d] =
        formulas.add(section, "Force " + std::string(1, "xyz"[d]), condition.force[d]);
    set_shares(solid, forest, b, name, section, nodes);
    load.nodes = nodes;
    set_loads.push_back(load);
  }



  std::shared_ptr<const ResultantLoad>
  BoundaryConditions::make_resultant(const unsigned int        b,
                                     const BoundaryIds        &id,
                                     const BoundaryParameters &condition,
                                     const std::string        &section)
  {
    if (!condition.has_resultant())
      return nullptr;
    ResultantLoad::Functions functions;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const std::string letter(1, "xyz"[d]);
        functions[d]       = formulas.add(section, "Force " + letter, condition.force[d]);
        functions[dim + d] = formulas.add(section, "Moment " + letter, condition.moment[d]);
      }
    const std::vector<double> &x     = condition.reference_point;
    const Point<dim>           point = x.empty() ? Point<dim>() : Point<dim>(x[0], x[1], x[2]);
    return std::make_shared<ResultantLoad>(
      solid, id, functions, x.empty() ? nullptr : &point, solid.bodies[b].material.finite_strain());
  }



  /** The unit outward normal of a boundary that must be plane. The integral of the normal is as
   * long as the area only if all normals agree, by the triangle inequality; a relative deviation
   * of 1e-8 admits round-off of the mesh, e.g. of coordinates read from a file, and corresponds
   * to angles of about 1e-4. Collective. */
  Tensor<1, dim>
  BoundaryConditions::plane_normal(const BoundaryIds &boundary,
                                   const std::string &section,
                                   const std::string &name) const
  {
    const FE_Q<dim>   scalar_fe(1);
    FEFaceValues<dim> values(solid.mapping,
                             scalar_fe,
                             QGauss<dim - 1>(2),
                             update_normal_vectors | update_JxW_values);
    Tensor<1, dim>    sum;
    double            area = 0.;
    for (const auto &cell : solid.dof_handler.get_triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->at_boundary(f) && boundary.count(cell->face(f)->boundary_id()) > 0)
            {
              values.reinit(cell, f);
              for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
                {
                  sum += values.JxW(q) * values.normal_vector(q);
                  area += values.JxW(q);
                }
            }
    sum  = Utilities::MPI::sum(sum, solid.communicator);
    area = Utilities::MPI::sum(area, solid.communicator);
    if (sum.norm() < (1. - 1e-8) * area)
      throw InputError(section,
                       "Symmetry",
                       name,
                       "this boundary is not plane, so it cannot be a plane of symmetry",
                       "prescribe displacement components in a section 'Boundary " + name +
                         "' instead.");
    sum /= sum.norm();
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(std::abs(sum[d]) - 1.) < 1e-12)
        return sum[d] * axis(d); // without the round-off of the other components
    return sum;
  }



  /** Prescribe the displacement along @p direction for all locally owned nodes of a boundary. A
   * hanging node follows its parents, which lie on the same boundary, and gets no condition of its
   * own: it would be a second, dependent one. */
  void
  BoundaryConditions::prescribe_on(const BoundaryIds    &boundary,
                                   const Tensor<1, dim> &direction,
                                   const Function       &value,
                                   const unsigned int    body,
                                   const unsigned int    support)
  {
    for_each_node_on(boundary, [&](const Index node, const auto &position) {
      if (solid.owned.is_element(dim * node) && !solid.hanging.is_constrained(dim * node))
        prescribed.push_back({node, direction, value, position(), body, support});
    });
  }
} // namespace Touchstone
