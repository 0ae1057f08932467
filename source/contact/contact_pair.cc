// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact_pair.h>
#include <touchstone/contact/friction/shared_symmetry.h>
#include <touchstone/contact/geometry/edge_crossing.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// A contact pair: its surfaces, its pairing, and one row for each slave node (doc/theory.md 4). It
// is the only writer of rows beside its pairing; see pair_update.cc.
namespace Touchstone
{
  using namespace dealii;

  ContactPair::ContactPair(const ContactPairInput &input)
    : input(input)
    , is_tied(input.parameters.tied())
    , small(is_tied || (input.obstacle == nullptr &&
                        input.parameters.sliding == ContactPairParameters::Sliding::small))
    , slave_surface(
        make_surface(input.slave_body, input.parameters.slave_boundaries, "Slave boundaries"))
  {
    if (input.obstacle == nullptr)
      {
        master_surface =
          make_surface(input.master_body, input.parameters.master_boundaries, "Master boundaries");
        // Names and numbers, or 'all', may mean the same boundary. Ids are unique over all bodies.
        for (const types::boundary_id id : master_surface->boundaries())
          if (slave_surface->boundaries().count(id) > 0)
            input.parameters.check_shared_boundary(input.parameters.section(),
                                                   input.forest.boundary_name(id),
                                                   input.in_cycles);
      }
    plane_cut       = make_cut();
    points_meet     = find_points();
    edges_meet      = points_meet && find_edges();
    search_distance = input.parameters.search_distance;
    pairing_method  = make_pairing(search_distance);
    if (points_meet)
      point_rows =
        std::make_unique<PointRows>(pairing_input(input.parameters.search_distance), edges_meet);
    // One row for each slave node that this rank owns; hanging nodes have none. The stiffness E A /
    // h is the complementarity constant c of doc/theory.md 5 and the scale of all springs.
    // Those for what touches between the nodes follow, where there are any.
    const unsigned int kinds =
      std::max(pairing_method->rows_between_nodes(), points_meet ? 1U : 0U);
    for (unsigned int kind = 0; kind <= kinds; ++kind)
      for (const SurfaceNode &node : slave_surface->owned_nodes())
        {
          ContactRow row;
          row.between_nodes = (kind > 0);
          row.pair          = input.number;
          row.slave         = node.node;
          row.reference     = node.reference;
          row.area          = node.area;
          row.size          = node.size;
          row.body          = input.slave_body;
          row.master_body   = input.master_body;
          row.stiffness     = input.modulus * node.area / node.size;
          row.tied          = is_tied;
          present.push_back(row);
        }
    overlaps.assign(present.size(), 0.);
    number_rows(0);
    committed = present;
  }



  // Collective: all ranks make all surfaces, also those of which they own no face.
  std::unique_ptr<Surface>
  ContactPair::make_surface(const unsigned int              body,
                            const std::vector<std::string> &boundaries,
                            const std::string              &key) const
  {
    const std::string section = input.parameters.section();
    const bool        exact =
      (input.parameters.contact_geometry == ContactPairParameters::Shape::manifold);
    const auto ids     = input.forest.boundary_ids(body, boundaries, section, key);
    auto       surface = std::make_unique<Surface>(input.solid, input.forest, body, ids, exact);
    if (surface->largest_face() == 0.)
      throw InputError(section, key, "", "these boundaries have no faces", "check the mesh.");
    return surface;
  }



  std::unique_ptr<PlaneCut>
  ContactPair::make_cut() const
  {
    const ContactPairParameters &pair = input.parameters;
    if (!pair.has_pretension())
      return nullptr;
    const auto finite = [this](const unsigned int body) {
      return input.solid.bodies[body].material.finite_strain();
    };
    auto result = std::make_unique<PlaneCut>(*slave_surface,
                                             finite(input.slave_body) || finite(input.master_body),
                                             input.solid.communicator);
    // Of the size of the cut: coordinates of imported meshes are rounded.
    constexpr double plane = 1e-3;
    if (const auto [height, size] = result->height_and_size(); height > plane * size)
      {
        const bool by_force = !pair.pretension_force.empty();
        throw InputError(pair.section(),
                         by_force ? "Pretension force" : "Pretension shortening",
                         by_force ? pair.pretension_force : pair.pretension_shortening,
                         "the sides of a cut are drawn together along its normal, but the "
                         "'Slave boundaries' of this pair are not plane",
                         "cut the bolt by a plane and name the faces on both sides of it; curved "
                         "surfaces that press on each other are meshed with their interference "
                         "instead ('Initial overlap')");
      }
    return result;
  }



  PairingInput
  ContactPair::pairing_input(const double search_distance) const
  {
    return {&input.parameters,
            input.obstacle,
            &input.solid,
            slave_surface.get(),
            master_surface.get(),
            search_distance,
            input.one_of_several,
            input.slave_body,
            input.master_body};
  }



  std::shared_ptr<Pairing>
  ContactPair::make_pairing(const double search_distance) const
  {
    const PairingInput pairing  = pairing_input(search_distance);
    const auto         of_nodes = Touchstone::make_pairing(pairing);
    return edges_meet ? make_edge_pairing(pairing, of_nodes) : of_nodes;
  }



  bool
  ContactPair::find_points() const
  {
    // Rows of small sliding are those of the reference state. Surfaces of one body share edges and
    // faces, which touch themselves.
    return input.edges && !small && input.slave_body != input.master_body;
  }



  // Collective.
  bool
  ContactPair::find_edges() const
  {
    // Edges of degree 2 are curved.
    if (!master_surface || input.solid.fe.degree > 1)
      return false;
    const bool sharp =
      !sharp_edges(master_surface->owned_faces(), master_surface->neighbour_faces()).empty();
    return Utilities::MPI::max(static_cast<int>(sharp), input.solid.communicator) == 1;
  }



  void
  ContactPair::number_rows(const std::size_t first_index)
  {
    for (std::size_t k = 0; k < present.size(); ++k)
      present[k].index = first_index + k;
    committed = present;
  }



  void
  ContactPair::set_friction(const std::function<const FrictionRow *(std::size_t)> &friction)
  {
    for (ContactRow &row : present)
      row.friction = friction(row.index);
    committed = present;
  }



  void
  ContactPair::set_planes_of_symmetry(const Mirrors &of_nodes)
  {
    const auto add_planes = [&](Surface &surface, const SharedSymmetry &symmetry) {
      Mirrors shared;
      for (const SurfaceNode &node : surface.all_nodes())
        if (const auto found = of_nodes.find(node.node); found != of_nodes.end())
          for (const Tensor<1, dim> &plane : found->second)
            if (symmetry.holds(node, plane))
              shared[node.node].push_back(plane);
      surface.set_planes_of_symmetry(shared);
      planes.merge(shared);
    };
    planes.clear();
    if (!master_surface)
      {
        add_planes(*slave_surface, SharedSymmetry(*pairing_method, *input.obstacle, input.run_end));
        return;
      }
    // Each side has planes of its own, and asks for those of the other.
    const MPI_Comm communicator = input.solid.communicator;
    add_planes(*slave_surface, SharedSymmetry(*master_surface, of_nodes, communicator));
    add_planes(*master_surface, SharedSymmetry(*slave_surface, of_nodes, communicator));
    if (plane_cut)
      {
        std::vector<Tensor<1, dim>> of_cut;
        for (const SurfaceNode &node : slave_surface->owned_nodes())
          if (const auto found = planes.find(node.node); found != planes.end())
            of_cut.insert(of_cut.end(), found->second.begin(), found->second.end());
        plane_cut->set_planes_of_symmetry(of_cut);
      }
  }



  std::vector<FrictionRow>
  ContactPair::friction_rows(const ContactParameters &contact) const
  {
    std::vector<FrictionRow> result(present.size());
    if (!input.parameters.friction)
      return result;
    const std::vector<std::array<Stencil, 2>> tangents = slave_surface->material_tangents();
    const std::vector<SurfaceNode>           &nodes    = slave_surface->owned_nodes();
    for (std::size_t k = 0; k < result.size(); ++k)
      {
        FrictionRow &row = result[k];
        row.law          = input.parameters.friction.get();
        // Rows between nodes follow those of the nodes.
        if (const auto found = planes.find(nodes[k % nodes.size()].node); found != planes.end())
          row.mirrors = found->second;
        row.material_tangents = tangents[k % tangents.size()];
        row.small             = small;
        row.exact             = (contact.friction == ContactParameters::Stick::exact);
        // alpha_t = 10 E A / h times the factor of the scene, doc/theory.md 6.1.
        row.alpha = 10. * contact.tangential_factor * present[k].stiffness;
      }
    return result;
  }
} // namespace Touchstone
