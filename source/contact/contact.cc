#include <touchstone/base/input_error.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/start_check.h>
#include <touchstone/contact/unresolved_contact.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/vector_tools_interpolate.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A surface that just touches, up to this fraction of a face, starts in
     * contact: otherwise a body that only rests on another would have no support
     * in the first iteration. */
    constexpr double touching_gap = 1e-6;

    Tensor<1, dim>
    part_of_force(const ContactRow &row, const Contact::Part part)
    {
      const Tensor<1, dim> normal = (row.force * row.normal) * row.normal;
      switch (part)
        {
          case Contact::Part::normal:
            return normal;
          case Contact::Part::tangential:
            return row.force - normal;
          default:
            return row.force;
        }
    }
  } // namespace



  Contact::Contact(const Scene   &scene,
                   const Forest  &forest,
                   const Solid   &solid,
                   const Mirrors &mirrors)
    : solid(solid)
    , scene(scene)
    , ghosted(solid.owned, solid.relevant, solid.communicator)
    , end_time(scene.load_stepping.end_time)
  {
    for (const ContactPairParameters &parameters : scene.pairs)
      {
        const std::string section = "Contact pair " + parameters.name;
        const bool        exact   = (parameters.contact_geometry == "manifold");
        const auto        make    = [&](const std::string              &body,
                              const std::vector<std::string> &boundaries,
                              const std::string              &key) {
          const auto ids = forest.boundary_ids(scene.body_index(body), boundaries, section, key);
          auto       surface =
            std::make_unique<Surface>(solid, forest, scene.body_index(body), ids, exact);
          if (surface->largest_face() == 0.)
            throw InputError(section, key, "", "these boundaries have no faces", "check the mesh.");
          return surface;
        };

        Pair pair;
        pair.parameters = &parameters;
        pair.slave_body = scene.body_index(parameters.slave_body);
        pair.modulus    = scene.bodies[pair.slave_body].material.young_modulus;
        pair.tied       = parameters.tied();
        pair.slave = make(parameters.slave_body, parameters.slave_boundaries, "Slave boundaries");
        const ObstacleParameters *obstacle = nullptr;
        for (const ObstacleParameters &o : scene.obstacles)
          if (o.name == parameters.obstacle)
            obstacle = &o;
        pair.master_body = numbers::invalid_unsigned_int;
        if (obstacle == nullptr)
          {
            pair.master_body = scene.body_index(parameters.master_body);
            // A force is small or large by what the softer body makes of it.
            pair.modulus =
              std::min(pair.modulus, scene.bodies[pair.master_body].material.young_modulus);
            pair.master =
              make(parameters.master_body, parameters.master_boundaries, "Master boundaries");
            for (const types::boundary_id id : pair.master->boundaries())
              if (pair.slave->boundaries().count(id) > 0)
                throw InputError(section,
                                 "Master boundaries",
                                 forest.boundary_name(id),
                                 "this boundary of '" + parameters.master_body +
                                   "' is slave and master at the same time",
                                 "let different boundaries be slave and master");
          }
        pair.small   = pair.tied || (obstacle == nullptr && parameters.sliding == "small");
        pair.pairing = make_pairing({&parameters,
                                     obstacle,
                                     &solid,
                                     pair.slave.get(),
                                     pair.master.get(),
                                     parameters.search_distance});

        std::vector<ContactRow> pair_rows;
        for (const SurfaceNode &node : pair.slave->owned_nodes())
          {
            ContactRow row;
            row.pair        = pairs.size();
            row.slave       = node.node;
            row.area        = node.area;
            row.size        = node.size;
            row.body        = pair.slave_body;
            row.master_body = pair.master_body;
            row.stiffness   = pair.modulus * node.area / node.size;
            row.tied        = pair.tied;
            if (parameters.friction)
              {
                row.friction.emplace();
                row.friction->law = parameters.friction.get();
                if (const auto found = mirrors.find(node.node); found != mirrors.end())
                  row.friction->mirrors = found->second;
                row.friction->exact = (scene.contact.friction == "exact");
                row.friction->alpha = 10. * scene.contact.tangential_factor * row.stiffness;
              }
            pair_rows.push_back(row);
          }
        pair.overlap.assign(pair_rows.size(), 0.);
        if (parameters.friction)
          pair.tangents = pair.slave->material_tangents();
        rows.push_back(pair_rows);
        pairs.push_back(std::move(pair));
      }
    find_circles();
    IndexSet seen = solid.relevant;
    for (const Pair &pair : pairs)
      seen.add_indices(pair.slave->far_unknowns().begin(), pair.slave->far_unknowns().end());
    for (const Pair &pair : pairs)
      if (pair.master)
        seen.add_indices(pair.master->far_unknowns().begin(), pair.master->far_unknowns().end());
    seen.compress();
    ghosted.reinit(solid.owned, seen, solid.communicator);
    import_ghosts.emplace(Vector(solid.owned, solid.communicator), ghosted);
    committed = rows;
    if (scene.has_friction())
      {
        reference_positions.reinit(solid.owned, solid.communicator);
        VectorTools::get_position_vector(solid.mapping, solid.dof_handler, reference_positions);
        owned_start_positions = reference_positions;
      }
  }



  void
  Contact::make_reference(Pair &pair, std::vector<ContactRow> &pair_rows, const double time)
  {
    Vector zero;
    zero.reinit(ghosted);
    pair.slave->move(zero);
    if (pair.master)
      pair.master->move(zero);
    pair.pairing->update(zero, time, pair_rows);
    ++searches;
    check_start(pair, pair_rows, zero, time);
    pair.reference = pair_rows;

    // Stencils may refer to unknowns that are not in the ghost layer.
    IndexSet needed = solid.relevant;
    for (const Pair &p : pairs)
      for (const ContactRow &row : p.reference)
        for (const StencilEntry &entry : row.stencil)
          needed.add_range(dim * entry.node, dim * entry.node + dim);
    needed.compress();
    stencil_values.reinit(solid.owned, needed, solid.communicator);
  }



  void
  Contact::check_start(Pair                    &pair,
                       std::vector<ContactRow> &pair_rows,
                       const Vector            &u,
                       const double             time)
  {
    const StartCheck check(solid,
                           *pair.parameters,
                           *pair.slave,
                           pair.master.get(),
                           pair.slave_body,
                           pair.master_body,
                           u,
                           pair_rows);
    // An interference deeper than the distance that the size of the faces suggests.
    const double depth = pair.parameters->search_distance > 0. ? 0. : check.depth_of_overlap();
    const double face =
      pair.master ? std::max(pair.slave->largest_face(), pair.master->largest_face()) : 0.;
    if (depth > face)
      {
        const double distance = std::max(depth + 2. * face, 4. * face);
        pair.pairing          = make_pairing(
          {pair.parameters, nullptr, &solid, pair.slave.get(), pair.master.get(), distance});
        pair.pairing->update(u, time, pair_rows);
        ++searches;
      }
    check.check_facing();
  }



  void
  Contact::update_small(Pair &pair, std::vector<ContactRow> &pair_rows, const Vector &u)
  {
    stencil_values = u;
    for (std::size_t k = 0; k < pair_rows.size(); ++k)
      {
        ContactRow &row = pair_rows[k];
        if (row.status == ContactStatus::no_partner)
          continue;
        row.gap_vector = pair.tied ? Tensor<1, dim>() : pair.reference[k].gap_vector;
        for (unsigned int d = 0; d < dim; ++d)
          {
            row.gap_vector[d] += stencil_values(dim * row.slave + d);
            for (const StencilEntry &entry : row.stencil)
              row.gap_vector[d] -= entry.weight * stencil_values(dim * entry.node + d);
          }
        row.gap = row.gap_vector * row.normal;
      }
  }



  void
  Contact::update(const Vector &u, const double t)
  {
    time = t;
    (*import_ghosts)(u, ghosted);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        Pair &pair = pairs[p];
        if (pair.small)
          {
            if (!started)
              make_reference(pair, rows[p], time);
          }
        else
          {
            pair.slave->move(ghosted);
            if (pair.master)
              pair.master->move(ghosted);
            pair.pairing->update(ghosted, time, rows[p]);
            ++searches;
            if (!started)
              check_start(pair, rows[p], ghosted, time);
          }
      }
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (pairs[p].small)
        update_small(pairs[p], rows[p], u);

    for (auto &pair_rows : rows)
      for (unsigned int k = 0; k < pair_rows.size(); ++k)
        {
          ContactRow &row  = pair_rows[k];
          Pair       &pair = pairs[row.pair];
          row.jump         = Tensor<1, dim>();
          for (unsigned int d = 0; d < dim; ++d)
            row.position[d] = ghosted(dim * row.slave + d);
          row.position += pair.slave->owned_nodes()[k].reference;
          if (!started && row.status == ContactStatus::open)
            {
              if (row.tied)
                row.status = ContactStatus::tied;
              else if (row.gap < touching_gap * row.size)
                row.status = ContactStatus::slip;
              if (pair.parameters->initial_overlap != "interference")
                pair.overlap[k] = std::min(row.gap, 0.);
            }
          if (pair.overlap[k] < 0. && row.status != ContactStatus::no_partner)
            {
              const double part = pair.parameters->initial_overlap == "ramp"
                                    ? std::max(0., 1. - time / end_time)
                                    : 1.;
              row.gap -= part * pair.overlap[k];
              row.gap_vector -= part * pair.overlap[k] * row.normal;
            }
        }
    started = true;
    if (reference_positions.size() > 0)
      update_slip(u);
  }



  void
  Contact::add_forces(Vector &force, const Part part) const
  {
    std::vector<Index>  unknowns;
    std::vector<double> values;
    for (const auto &pair_rows : rows)
      for (const ContactRow &row : pair_rows)
        if (row.active())
          {
            const Tensor<1, dim> f = part_of_force(row, part);
            for (unsigned int d = 0; d < dim; ++d)
              if (f[d] != 0.)
                {
                  unknowns.push_back(dim * row.slave + d);
                  values.push_back(f[d]);
                  for (const StencilEntry &entry : row.stencil)
                    {
                      unknowns.push_back(dim * entry.node + d);
                      values.push_back(-entry.weight * f[d]);
                    }
                }
          }
    force.add(unknowns, values);
    force.compress(VectorOperation::add);
    solid.condense(force); // master nodes can hang
  }



  double
  Contact::work_of_obstacles(const Part part) const
  {
    double work = 0.;
    for (unsigned int p = 0; p < rows.size(); ++p)
      for (std::size_t k = 0; k < rows[p].size(); ++k)
        if (rows[p][k].active())
          work += part_of_force(rows[p][k], part) * (rows[p][k].shift - committed[p][k].shift);
    return Utilities::MPI::sum(work, solid.communicator);
  }



  double
  Contact::part_to_touch() const
  {
    double part = 1.;
    for (unsigned int p = 0; p < rows.size(); ++p)
      for (std::size_t k = 0; k < rows[p].size(); ++k)
        {
          const ContactRow &before = committed[p][k], &now = rows[p][k];
          if (before.status == ContactStatus::open && now.status != ContactStatus::no_partner &&
              before.gap > 0. && now.gap < 0.)
            part = std::min(part, before.gap / (before.gap - now.gap));
        }
    return Utilities::MPI::min(part, solid.communicator);
  }



  void
  Contact::commit()
  {
    for (auto &pair_rows : rows)
      for (ContactRow &row : pair_rows)
        if (row.friction)
          commit_friction(row);
    for (Pair &pair : pairs)
      if (!pair.small)
        pair.pairing->commit_positions(ghosted);
    // What belongs to the linearisation is made anew in each iteration.
    for (auto &pair_rows : rows)
      for (ContactRow &row : pair_rows)
        {
          row.derivative.reset();
          if (row.friction)
            {
              row.friction->slip_gradient.clear();
              row.friction->spin_gradient.clear();
            }
        }
    if (positions.size() > 0)
      start_step();
    committed      = rows;
    committed_time = time;
  }



  void
  Contact::rollback()
  {
    rows = committed;
  }



  std::vector<ContactPoint>
  Contact::points(const Vector &u) const
  {
    std::vector<ContactPoint> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (unsigned int k = 0; k < rows[p].size(); ++k)
        {
          const ContactRow &row = rows[p][k];
          ContactPoint      point;
          point.pair               = p;
          point.node               = row.slave;
          point.reference_position = pairs[p].slave->owned_nodes()[k].reference;
          for (unsigned int d = 0; d < dim; ++d)
            point.displacement[d] = u(dim * row.slave + d);
          point.normal = row.normal;
          // What round-off leaves of positions is none.
          point.gap      = std::abs(row.gap) > 1e-14 * row.size ? row.gap / row.share : 0.;
          point.area     = row.area * row.share;
          point.pressure = (row.lambda + row.jump * row.normal) / row.area;
          point.traction = (row.force + row.jump) / row.area;
          point.lever    = row.lever;
          point.status   = row.status;
          if (row.friction)
            {
              point.slip          = row.friction->slip;
              point.slip_length   = row.friction->slip_length;
              point.friction_work = row.friction->work;
            }
          result.push_back(point);
        }
    return result;
  }



  std::vector<ContactFace>
  Contact::faces() const
  {
    std::vector<ContactFace> result;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (const Face &face : pairs[p].slave->owned_faces())
        {
          result.push_back({p, face.degree, face.nodes});
          if (const TraceBasis *basis = pairs[p].slave->trace(face))
            for (unsigned int m = 0; m < face.n_nodes(); ++m)
              {
                const Stencil follows = basis->stencil(m);
                if (follows.size() != 1 || follows[0].node != face.nodes[m])
                  result.back().hanging.push_back({face.nodes[m], face.reference[m], follows});
              }
        }
    return result;
  }



  std::vector<PairResult>
  Contact::results(const Vector &u) const
  {
    std::vector<PairResult> all(pairs.size());
    for (const ContactPoint &point : points(u))
      {
        PairResult &result = all[point.pair];
        result.friction_work += point.friction_work;
        if (point.status != ContactStatus::no_partner && point.status != ContactStatus::tied)
          result.max_penetration = std::max(result.max_penetration, -point.gap);
        if (point.status < ContactStatus::slip)
          continue;
        const Tensor<1, dim> force = point.area * point.traction;
        result.force += force;
        result.moment +=
          cross_product_3d(point.reference_position + point.displacement + point.lever, force);
        result.area += point.area;
        result.max_pressure = std::max(result.max_pressure, point.pressure);
        ++result.active;
        ++(point.status == ContactStatus::slip ? result.slip : result.stick);
      }
    for (PairResult &result : all)
      {
        result.force           = Utilities::MPI::sum(result.force, solid.communicator);
        result.moment          = Utilities::MPI::sum(result.moment, solid.communicator);
        result.area            = Utilities::MPI::sum(result.area, solid.communicator);
        result.max_pressure    = Utilities::MPI::max(result.max_pressure, solid.communicator);
        result.max_penetration = Utilities::MPI::max(result.max_penetration, solid.communicator);
        result.active          = Utilities::MPI::sum(result.active, solid.communicator);
        result.slip            = Utilities::MPI::sum(result.slip, solid.communicator);
        result.friction_work   = Utilities::MPI::sum(result.friction_work, solid.communicator);
        result.stick           = Utilities::MPI::sum(result.stick, solid.communicator);
      }
    return all;
  }



  Contact::Work
  Contact::work() const
  {
    Work sum;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        sum.slave_rows += rows[p].size();
        if (pairs[p].master)
          sum.master_faces += pairs[p].master->owned_faces().size();
        sum.search += pairs[p].pairing->search_work();
      }
    return sum;
  }



  std::string
  Contact::unresolved() const
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (const std::string text = pairs[p].tied ? "" : unresolved(p); !text.empty())
        return "contact pair '" + pairs[p].parameters->name + "': " + text +
               ". Rows of slave nodes cannot describe this contact: refine the slave surface" +
               (pairs[p].master ? ", exchange slave and master, or round the edges" : "");
    return "";
  }



  std::string
  Contact::unresolved(const unsigned int p) const
  {
    const Pair &pair = pairs[p];
    Vector      owned(solid.owned, solid.communicator), forces;
    for (const ContactRow &row : rows[p])
      if (row.active() && row.lambda > 0.)
        for (unsigned int d = 0; d < dim; ++d)
          owned(dim * row.slave + d) = row.lambda * row.normal[d];
    owned.compress(VectorOperation::insert);
    forces.reinit(ghosted);
    (*import_ghosts)(owned, forces);
    // Overlaps can be meant.
    const bool overlaps = pair.parameters->initial_overlap == "interference";
    if (!pair.master)
      return overlaps ? obstacle_within_face(solid,
                                             *pair.parameters,
                                             *pair.slave,
                                             forces,
                                             [&](const Point<dim> &x) {
                                               return pair.pairing->distance(x, time);
                                             })
                      : "";
    const UnresolvedContact check(solid,
                                  *pair.parameters,
                                  *pair.slave,
                                  *pair.master,
                                  pair.slave_body,
                                  pair.master_body,
                                  ghosted,
                                  forces);
    // Surfaces of small sliding stay where they are.
    const std::string text = overlaps && !pair.small ? check.overlap() : "";
    return text.empty() ? check.oblique_force() : text;
  }



  std::vector<std::string>
  Contact::start_report() const
  {
    std::vector<std::string> lines;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        double       lowest = std::numeric_limits<double>::max(), size = 0.;
        unsigned int partner = 0, overlapping = 0;
        for (std::size_t k = 0; k < rows[p].size(); ++k)
          {
            const ContactRow &row = rows[p][k];
            if (row.status == ContactStatus::no_partner)
              continue;
            // As the bodies are placed.
            const double gap = (row.gap + pairs[p].overlap[k]) / row.share;
            ++partner;
            lowest = std::min(lowest, gap);
            size   = std::max(size, row.size);
            overlapping += (gap < -touching_gap * row.size);
          }
        const unsigned int total     = Utilities::MPI::sum(rows[p].size(), solid.communicator);
        lowest                       = Utilities::MPI::min(lowest, solid.communicator);
        size                         = Utilities::MPI::max(size, solid.communicator);
        partner                      = Utilities::MPI::sum(partner, solid.communicator);
        overlapping                  = Utilities::MPI::sum(overlapping, solid.communicator);
        const std::string &treatment = pairs[p].parameters->initial_overlap;
        const std::string  overlap   = std::string(": an initial overlap") +
                                    (lowest < -size ? " larger than a face" : "") + ", " +
                                    (treatment == "adjust" ? "adjusted to no gap"
                                     : treatment == "ramp" ? "an interference that grows with time"
                                                           : "taken as interference");
        char text[300];
        if (partner == 0)
          std::snprintf(text,
                        sizeof(text),
                        "no master face within reach of any of %u slave nodes",
                        total);
        else
          std::snprintf(text,
                        sizeof(text),
                        "%u slave nodes, %u face the master surface, smallest gap %.4g%s",
                        total,
                        partner,
                        lowest,
                        overlapping == 0 ? "" : overlap.c_str());
        lines.push_back("contact pair " + pairs[p].parameters->name + ": " + text);
      }
    return lines;
  }
} // namespace Touchstone
