#include <touchstone/contact/geometry/surface.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A number for the face of a cell that does not depend on the partition:
     * the path to the cell in the forest, in 30 bits for ten levels; the level, which
     * tells a cell from its first child; and the face. */
    std::uint64_t
    face_key(const CellId &id, const unsigned int face)
    {
      constexpr unsigned int max_level = 10;
      const auto             path      = id.get_child_indices();
      AssertThrow(path.size() <= max_level && id.get_coarse_cell_id() < (1u << 27),
                  ExcMessage("The mesh has more than 10 levels or 2^27 coarse cells."));
      std::uint64_t key = id.get_coarse_cell_id();
      for (unsigned int level = 0; level < max_level; ++level)
        key = key * 8 + (level < path.size() ? path[level] : 0);
      return (key * 16 + path.size()) * 8 + face;
    }

    /** A node of a face of a cell: its first unknown there, its number on the face, and its
     * place in the unit cell. */
    struct NodeOnFace
    {
      unsigned int dof, m;
      Point<dim>   unit;
    };

    std::array<std::vector<NodeOnFace>, 6>
    nodes_on_faces(const FiniteElement<dim> &fe)
    {
      std::array<std::vector<NodeOnFace>, 6> result;
      for (unsigned int f = 0; f < result.size(); ++f)
        {
          // Axes of the face such that their cross product points outward: the
          // position of a node on the unit cell tells where it stands.
          const unsigned int normal_axis = f / 2;
          const unsigned int axes[2]     = {(normal_axis + (f % 2 == 1 ? 1 : 2)) % 3,
                                            (normal_axis + (f % 2 == 1 ? 2 : 1)) % 3};
          for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
            if (fe.system_to_component_index(i).first == 0 && fe.has_support_on_face(i, f))
              {
                const Point<dim> unit  = fe.unit_support_point(i);
                const auto       along = [&](const unsigned int axis) {
                  return static_cast<unsigned int>(std::lround(unit[axis] * fe.degree));
                };
                result[f].push_back({i, along(axes[0]) + (fe.degree + 1) * along(axes[1]), unit});
              }
        }
      return result;
    }

    /** Area of the face's shape functions, by Gauss quadrature on the facet. */
    std::array<double, Face::max_nodes>
    nodal_areas(const Face &face)
    {
      static const QGauss<2>              quadrature(3);
      std::array<double, Face::max_nodes> areas{};
      for (unsigned int q = 0; q < quadrature.size(); ++q)
        {
          const std::array<double, 2> xi{
            {2. * quadrature.point(q)[0] - 1., 2. * quadrature.point(q)[1] - 1.}};
          const FaceShapes shapes(face.degree, xi);
          const FacePoint  point = evaluate(face, nullptr, xi);
          const double     jxw   = 4. * quadrature.weight(q) *
                             cross_product_3d(point.tangents[0], point.tangents[1]).norm();
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            areas[m] += shapes.value[m] * jxw;
        }
      return areas;
    }

    /** A face takes its share of the average only from faces that it meets in
     * less than a sharp edge: those that meet at more than 50 degrees meet in an
     * edge of the body. */
    bool
    averaged_with(const Tensor<1, dim> &unit_normal, const Tensor<1, dim> &own)
    {
      constexpr double cosine_of_sharp_edge = 0.64;
      return unit_normal * own > cosine_of_sharp_edge;
    }
  } // namespace



  std::vector<Surface::Place>::const_iterator
  Surface::place(const Index node) const
  {
    const auto found =
      std::lower_bound(places.begin(), places.end(), node, [](const Place &a, const Index b) {
        return a.node < b;
      });
    AssertThrow(found != places.end() && found->node == node, ExcInternalError());
    return found;
  }



  std::array<Surface::Edge, 4>
  Surface::edges(const Face &face)
  {
    // In the order of the bits of Face::outer_edges.
    const unsigned int p    = face.degree;
    const Index        c[4] = {face.nodes[0],
                               face.nodes[p],
                               face.nodes[(p + 1) * p],
                               face.nodes[(p + 1) * (p + 1) - 1]};
    const auto         pair = [](const Index a, const Index b) {
      return std::make_pair(std::min(a, b), std::max(a, b));
    };
    return {{pair(c[0], c[2]), pair(c[1], c[3]), pair(c[0], c[1]), pair(c[2], c[3])}};
  }



  Surface::Surface(const Solid                        &solid,
                   const Forest                       &forest,
                   const unsigned int                  body,
                   const std::set<types::boundary_id> &boundaries,
                   const bool                          exact)
    : forest(forest)
    , ids(boundaries)
    , exact(exact)
  {
    const unsigned int                                p = solid.fe.degree;
    std::vector<Index>                                dofs(solid.fe.n_dofs_per_cell());
    const auto                                        nodes_of_faces = nodes_on_faces(solid.fe);
    std::vector<std::pair<Edge, std::array<Edge, 2>>> halves;
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial() || cell->material_id() != body)
          continue;
        for (const unsigned int f : cell->face_indices())
          {
            if (!cell->at_boundary(f) || boundaries.count(cell->face(f)->boundary_id()) == 0)
              continue;
            cell->get_dof_indices(dofs);
            Face face;
            face.key      = face_key(cell->id(), f);
            face.degree   = p;
            face.boundary = cell->face(f)->boundary_id();
            face.body     = body;
            for (const NodeOnFace &on_face : nodes_of_faces[f])
              {
                face.nodes[on_face.m] = dofs[on_face.dof] / dim;
                face.reference[on_face.m] =
                  solid.mapping.transform_unit_to_real_cell(cell, on_face.unit);
              }
            if (TraceBasis::needed(face, solid.hanging))
              traces.emplace(face.key, TraceBasis(face, solid.hanging));
            (cell->is_locally_owned() ? faces : ghost_faces).push_back(face);

            for (unsigned int l = 0; l < GeometryInfo<2>::lines_per_cell; ++l)
              {
                const auto line = cell->face(f)->line(l);
                if (!line->has_children())
                  continue;
                const auto node = [](const auto &line, const unsigned int v) {
                  return line->vertex_dof_index(v, 0) / dim;
                };
                const Index a = node(line, 0), b = node(line, 1), m = node(line->child(0), 1);
                halves.push_back(
                  {{std::min(a, b), std::max(a, b)},
                   {{{std::min(a, m), std::max(a, m)}, {std::min(m, b), std::max(m, b)}}}});
              }
          }
      }
    mark_outer_edges(halves);
    if (solid.has_hanging_nodes())
      exchange_far_faces(solid);

    std::map<Index, std::vector<std::pair<Face *, unsigned int>>> around;
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          {
            around[face.nodes[m]].emplace_back(&face, m);
            reference_tangents.push_back(
              evaluate(face, exact_surface(face), node_coordinates(face, m)).tangents);
          }
    for (auto &[node, list] : around)
      places.push_back({node, {}, std::move(list)});

    std::map<Index, SurfaceNode> found;
    shortest = std::numeric_limits<double>::max();
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        {
          auto   areas = nodal_areas(face);
          double area  = 0.;
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            area += areas[m];
          const TraceBasis *basis = trace(face);
          if (basis)
            areas = basis->apply(areas);
          for (unsigned int m = 0; m < face.n_nodes(); ++m)
            {
              const Index index = basis ? basis->nodes[m] : face.nodes[m];
              if (!solid.owned.is_element(dim * index))
                continue;
              SurfaceNode &node = found[index];
              node.node         = index;
              node.area += areas[m];
              if (index != face.nodes[m])
                continue; // the place of a node that this face does not have
              node.reference = face.reference[m];
              node.size      = std::max(node.size, std::sqrt(area) / p);
            }
          const unsigned int last = face.n_nodes() - 1;
          diagonal                = std::max({diagonal,
                                              face.reference[0].distance(face.reference[last]),
                                              face.reference[p].distance(face.reference[last - p])});
          for (const unsigned int corner : {p, last - p})
            for (const unsigned int end : {0u, last})
              shortest = std::min(shortest, face.reference[corner].distance(face.reference[end]));
        }
    for (const auto &entry : found)
      nodes.push_back(entry.second);
    diagonal = Utilities::MPI::max(diagonal, solid.communicator);
    shortest = Utilities::MPI::min(shortest, solid.communicator);
  }



  void
  Surface::mark_outer_edges(const std::vector<std::pair<Edge, std::array<Edge, 2>>> &halves)
  {
    std::map<Edge, unsigned int> count;
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        for (const Edge &edge : edges(face))
          ++count[edge];
    // A larger face and its two neighbours on one side of it meet without sharing
    // an edge.
    for (const auto &[whole, parts] : halves)
      for (const Edge &part : parts)
        {
          const auto found = count.find(part);
          if (found == count.end())
            continue;
          ++found->second;
          ++count[whole];
        }
    for (Face &face : faces)
      {
        const auto all = edges(face);
        for (unsigned int e = 0; e < 4; ++e)
          if (count[all[e]] == 1)
            face.outer_edges |= 1u << e;
      }
  }



  void
  Surface::exchange_far_faces(const Solid &solid)
  {
    if (Utilities::MPI::n_mpi_processes(solid.communicator) == 1)
      return;
    // Nodes of other ranks that hanging nodes of this rank's faces follow.
    const auto for_each_foreign = [&](const auto &visit) {
      for (const Face &face : faces)
        if (const TraceBasis *basis = trace(face))
          for (unsigned int m = 0; m < basis->n; ++m)
            if (basis->nodes[m] != face.nodes[m] && !solid.owned.is_element(dim * basis->nodes[m]))
              visit(face, *basis, dim * basis->nodes[m]);
    };
    IndexSet foreign(solid.owned.size());
    for_each_foreign(
      [&](const Face &, const TraceBasis &, const Index unknown) { foreign.add_index(unknown); });
    const std::vector<unsigned int> owners =
      Utilities::MPI::compute_index_owner(solid.owned, foreign, solid.communicator);

    struct Package
    {
      Face       face;
      TraceBasis basis;
    };
    std::map<unsigned int, std::vector<char>>        packages;
    std::set<std::pair<unsigned int, std::uint64_t>> sent;
    for_each_foreign([&](const Face &face, const TraceBasis &basis, const Index unknown) {
      const unsigned int rank = owners[foreign.index_within_set(unknown)];
      if (!sent.emplace(rank, face.key).second)
        return;
      const Package     package{face, basis};
      auto             &to   = packages[rank];
      const std::size_t size = to.size();
      to.resize(size + sizeof(Package));
      std::memcpy(to.data() + size, static_cast<const void *>(&package), sizeof(Package));
    });

    std::set<std::uint64_t> known;
    for (const Face &face : ghost_faces)
      known.insert(face.key);
    for (const auto &[rank, data] : Utilities::MPI::some_to_some(solid.communicator, packages))
      for (std::size_t at = 0; at < data.size(); at += sizeof(Package))
        {
          Package package;
          std::memcpy(static_cast<void *>(&package), data.data() + at, sizeof(Package));
          // This rank may see the face, but not all that its nodes follow.
          traces[package.face.key] = package.basis;
          if (!known.insert(package.face.key).second)
            continue;
          ghost_faces.push_back(package.face);
          for (unsigned int m = 0; m < package.face.n_nodes(); ++m)
            for (unsigned int d = 0; d < dim; ++d)
              far.push_back(dim * package.face.nodes[m] + d);
        }
  }



  const AnalyticSurface *
  Surface::exact_surface(const Face &face) const
  {
    return exact ? forest.surface(face.boundary).get() : nullptr;
  }



  std::vector<std::array<Stencil, 2>>
  Surface::material_tangents() const
  {
    // In the order of keys, so that every partition sums up the same.
    std::unordered_map<Index, std::vector<std::pair<const Face *, unsigned int>>> around;
    for (const auto *list : {&faces, &ghost_faces})
      for (const Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m)
          around[face.nodes[m]].emplace_back(&face, m);
    for (auto &entry : around)
      std::sort(entry.second.begin(), entry.second.end(), [](const auto &a, const auto &b) {
        return a.first->key < b.first->key;
      });

    std::vector<std::array<Stencil, 2>> result;
    for (const SurfaceNode &node : nodes)
      {
        const auto &list = around.at(node.node);
        // Tangents of the faces at the node in the reference state.
        std::vector<std::array<Tensor<1, dim>, 2>> tangents;
        Tensor<1, dim>                             normal;
        for (const auto &[face, corner] : list)
          {
            const FaceShapes              shapes(face->degree, node_coordinates(*face, corner));
            std::array<Tensor<1, dim>, 2> t;
            for (unsigned int m = 0; m < face->n_nodes(); ++m)
              for (unsigned int b = 0; b < 2; ++b)
                t[b] += shapes.gradient[m][b] * face->reference[m];
            tangents.push_back(t);
            normal += cross_product_3d(t[0], t[1]);
          }
        normal /= normal.norm();
        // Any direction across the normal will do; the longest avoids round-off at sharp edges.
        std::array<Tensor<1, dim>, 2> directions;
        for (const auto &t : tangents)
          for (const Tensor<1, dim> &tangent : t)
            {
              const Tensor<1, dim> across =
                (tangent - (tangent * normal) * normal) / tangent.norm();
              if (across.norm() > 1.1 * directions[0].norm())
                directions[0] = across;
            }
        directions[0] /= directions[0].norm();
        directions[1] = -cross_product_3d(normal, directions[0]);

        std::array<std::map<Index, double>, 2> sum;
        for (std::size_t f = 0; f < list.size(); ++f)
          {
            const auto &[face, corner] = list[f];
            const auto      &t         = tangents[f];
            const FaceShapes shapes(face->degree, node_coordinates(*face, corner));
            const double     g00 = t[0] * t[0], g01 = t[0] * t[1], g11 = t[1] * t[1];
            const double     area = std::sqrt(g00 * g11 - g01 * g01);
            for (unsigned int a = 0; a < 2; ++a)
              {
                // The part of the direction in the face, by its tangents; times the area, which
                // makes faces count as they do in averaged normals.
                const double r0 = t[0] * directions[a], r1 = t[1] * directions[a];
                const double c0 = (g11 * r0 - g01 * r1) / area, c1 = (g00 * r1 - g01 * r0) / area;
                std::array<double, Face::max_nodes> weights{};
                for (unsigned int m = 0; m < face->n_nodes(); ++m)
                  weights[m] = c0 * shapes.gradient[m][0] + c1 * shapes.gradient[m][1];
                // Conditions on the slip must not refer to nodes that follow the slave node.
                const TraceBasis *basis = trace(*face);
                if (basis)
                  weights = basis->apply(weights);
                for (unsigned int m = 0; m < face->n_nodes(); ++m)
                  if (weights[m] != 0.)
                    sum[a][basis ? basis->nodes[m] : face->nodes[m]] += weights[m];
              }
          }
        result.emplace_back();
        for (unsigned int a = 0; a < 2; ++a)
          for (const auto &[index, weight] : sum[a])
            result.back()[a].push_back({index, weight});
      }
    return result;
  }



  Point<dim>
  Surface::position(const SurfaceNode &node, const Vector &u) const
  {
    Point<dim> x = node.reference;
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += u(dim * node.node + d);
    return x;
  }



  void
  Surface::move(const Vector &u)
  {
    for (const Place &place : places)
      {
        Tensor<1, dim> displacement;
        for (unsigned int d = 0; d < dim; ++d)
          displacement[d] = u(dim * place.node + d);
        for (const auto &[face, m] : place.faces)
          face->displacement[m] = displacement;
      }
    // Normals of the faces at their nodes, in length weighted by the area that
    // the face has around the node.
    std::vector<FaceShapes> at_nodes;
    auto                    tangents = reference_tangents.begin();
    for (auto *list : {&faces, &ghost_faces})
      for (Face &face : *list)
        for (unsigned int m = 0; m < face.n_nodes(); ++m, ++tangents)
          {
            // All faces are of one degree.
            if (at_nodes.size() == m)
              at_nodes.emplace_back(face.degree, node_coordinates(face, m));
            auto t = *tangents;
            for (unsigned int l = 0; l < face.n_nodes(); ++l)
              for (unsigned int a = 0; a < 2; ++a)
                t[a] += at_nodes[m].gradient[l][a] * face.displacement[l];
            face.normals[m]     = cross_product_3d(t[0], t[1]);
            const double length = face.normals[m].norm();
            face.own_normals[m] = length > 0. ? face.normals[m] / length : face.normals[m];
          }
    std::vector<Tensor<1, dim>> parts, units;
    for (auto &[node, all, list] : places)
      {
        parts.clear();
        units.clear();
        all         = Tensor<1, dim>();
        bool smooth = true;
        for (const auto &[face, m] : list)
          {
            parts.push_back(face->normals[m]);
            all += parts.back();
            for (const Tensor<1, dim> &other : units)
              smooth = smooth && averaged_with(other, face->own_normals[m]);
            units.push_back(face->own_normals[m]);
          }
        if (const double length = all.norm(); length > 0.)
          all /= length;
        for (std::size_t k = 0; k < list.size(); ++k)
          {
            const auto &[face, m] = list[k];
            face->edge_normals[m] = face->normals[m] = all;
            if (smooth)
              continue;
            Tensor<1, dim> sum;
            for (std::size_t i = 0; i < parts.size(); ++i)
              if (averaged_with(units[i], units[k]))
                sum += parts[i];
            if (const double length = sum.norm(); length > 0.)
              face->normals[m] = sum / length;
          }
      }
  }



  std::vector<NormalDerivative>
  Surface::normal_derivative(const Face &face) const
  {
    const auto tangents = [this](const Face &f, const unsigned int m) {
      return evaluate(f, exact_surface(f), node_coordinates(f, m)).tangents;
    };
    std::vector<NormalDerivative> result;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const std::size_t first = result.size();
        Tensor<1, dim>    sum;
        for (const auto &[f, k] : place(face.nodes[m])->faces)
          {
            const auto           t    = tangents(*f, k);
            const Tensor<1, dim> part = cross_product_3d(t[0], t[1]);
            if (!averaged_with(f->own_normals[k], face.own_normals[m]))
              continue;
            sum += part;
            // d (t_0 x t_1), where the tangents are linear in the displacements.
            const Tensor<2, dim> by_first  = -1. * cross_matrix(t[1]),
                                 by_second = cross_matrix(t[0]);
            const FaceShapes shapes(f->degree, node_coordinates(*f, k));
            for (unsigned int l = 0; l < f->n_nodes(); ++l)
              {
                const auto &gradient = shapes.gradient[l];
                if (gradient[0] == 0. && gradient[1] == 0.)
                  continue;
                auto entry =
                  std::find_if(result.begin() + first,
                               result.end(),
                               [&](const NormalDerivative &d) { return d.node == f->nodes[l]; });
                if (entry == result.end())
                  entry = result.insert(entry, {m, f->nodes[l], Tensor<2, dim>()});
                entry->value += gradient[0] * by_first + gradient[1] * by_second;
              }
          }
        const Tensor<2, dim> direction = normalisation_derivative(sum);
        for (auto entry = result.begin() + first; entry != result.end(); ++entry)
          entry->value = direction * entry->value;
      }
    return result;
  }
} // namespace Touchstone
