// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/ask_owners.h>
#include <touchstone/output/contact_output.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

/**
 * @file
 * Output of the contact surfaces with the results at their nodes. Results of slaves belong to rows,
 * which live on the rank that owns the slave node, while faces live on the rank that owns the cell:
 * values of nodes at the border of partitions are fetched first, then each rank writes the faces
 * that it owns.
 */

namespace Touchstone
{
  namespace
  {
    /** Nodes of a face of FE_Q: (degree + 1)^2. */
    unsigned int
    nodes_per_face(const ContactFace &face)
    {
      return (face.degree + 1) * (face.degree + 1);
    }



    /**
     * The values at a hanging node, which has no row (doc/theory.md 11, "Hanging nodes"):
     * interpolated from the nodes that it follows; integers, such as the status, are those of the
     * node with the largest weight. None if the value of one of them is not known.
     */
    std::optional<ContactNode>
    interpolate(const ContactFieldList         &fields,
                const unsigned int              pair,
                const ContactFace::HangingNode &hanging,
                const ContactNodeMap           &map)
    {
      // Of degree 2 in the middle of an edge: another node at the place of the one that it follows.
      // Who takes each place once, to sum up forces, must not lose what is there.
      constexpr double round_off = 1e-12;
      if (hanging.follows.size() == 1 && std::abs(hanging.follows[0].weight - 1.) < round_off)
        if (const auto found = map.find({pair, hanging.follows[0].node}); found != map.end())
          return found->second;
      ContactNode result{hanging.reference_position, std::vector<double>(fields.n_values())};
      double      largest = 0.;
      for (const auto &[node, weight] : hanging.follows)
        {
          const auto found = map.find({pair, node});
          if (found == map.end())
            return {};
          for (const ContactFieldList::Entry &entry : fields.entries())
            for (unsigned int i = entry.first; i < entry.first + entry.field->n_components(); ++i)
              if (entry.field->summed())
                result.values[i] = 0.;
              else if (entry.field->interpolated())
                result.values[i] += weight * found->second.values[i];
              else if (weight > largest)
                result.values[i] = found->second.values[i];
          largest = std::max(largest, weight);
        }
      return result;
    }
  } // namespace



  namespace
  {
    using Key = ContactNodeMap::key_type;

    /** A node of a pair that its owner is asked about. */
    struct NodeOfPair
    {
      unsigned int pair;
      Index        node;
    };

    /** The nodes among @p missing that have results, from their owners. Collective. */
    void
    add_from_owners(const std::set<Key>    &missing,
                    const std::size_t       n_values,
                    const dealii::IndexSet &owned,
                    const MPI_Comm          communicator,
                    ContactNodeMap         &map)
    {
      std::vector<NodeOfPair> asked;
      for (const auto &[pair, node] : missing)
        asked.push_back({pair, node});
      const auto questions = records_by_owner(asked, owned, communicator, [](const NodeOfPair &of) {
        return dim * of.node;
      });
      // Of each node that is asked for whether it has results, its position and values.
      const std::size_t                           n = 1 + dim + n_values;
      std::map<unsigned int, std::vector<double>> answers;
      for (const auto &[rank, list] : exchange_records(questions, communicator))
        for (const NodeOfPair &of : list)
          {
            std::vector<double> &answer = answers[rank];
            const auto           found  = map.find({of.pair, of.node});
            answer.resize(answer.size() + n);
            if (found == map.end())
              continue;
            double *const begin = &answer[answer.size() - n];
            begin[0]            = 1.;
            std::copy(found->second.reference_position.begin_raw(),
                      found->second.reference_position.end_raw(),
                      begin + 1);
            std::copy(found->second.values.begin(), found->second.values.end(), begin + 1 + dim);
          }
      for (const auto &[rank, answer] : exchange_records(answers, communicator))
        for (std::size_t k = 0; k < answer.size() / n; ++k)
          if (const double *const begin = &answer[k * n]; begin[0] == 1.)
            {
              const NodeOfPair &of    = questions.at(rank)[k];
              map[{of.pair, of.node}] = {dealii::Point<dim>(begin[1], begin[2], begin[3]),
                                         {begin + 1 + dim, begin + n}};
            }
    }
  } // namespace



  ContactNodeMap
  collect_contact_nodes(const ContactFieldList          &fields,
                        const std::vector<ContactFace>  &faces,
                        const std::vector<ContactPoint> &points,
                        const dealii::IndexSet          &owned,
                        const MPI_Comm                   communicator)
  {
    // Keyed by pair and node: a node can be slave of several pairs and has results in each.
    ContactNodeMap map;
    for (const ContactPoint &point : points)
      map[{point.pair, point.node}] = {point.reference_position, fields.values_at(point)};

    // Only nodes at the borders of partitions are missing.
    std::set<Key> missing;
    const auto    want = [&](const unsigned int pair, const Index node) {
      if (map.find({pair, node}) == map.end())
        missing.insert({pair, node});
    };
    for (const ContactFace &face : faces)
      {
        for (unsigned int i = 0; i < nodes_per_face(face); ++i)
          want(face.pair, face.nodes[i]);
        for (const ContactFace::HangingNode &hanging : face.hanging)
          for (const StencilEntry &entry : hanging.follows)
            want(face.pair, entry.node);
      }
    add_from_owners(missing, fields.n_values(), owned, communicator, map);

    for (const ContactFace &face : faces)
      for (const ContactFace::HangingNode &hanging : face.hanging)
        // After the exchange, since the nodes it follows may be on other ranks.
        if (const auto result = interpolate(fields, face.pair, hanging, map))
          map[{face.pair, hanging.node}] = *result;
    return map;
  }



  ContactSurfaceData::ContactSurfaceData(const ContactFieldList         &fields,
                                         const std::vector<ContactFace> &faces,
                                         const ContactNodeMap           &all_nodes,
                                         const bool                      with_rests)
    : fields(fields)
    , with_rests(with_rests)
  {
    // Values, then the rests of all of them.
    const unsigned int n_values = fields.n_values(), n_rows = (with_rests ? 2 : 1) * n_values;
    bool               curved = false;
    for (const ContactFace &face : faces)
      {
        const unsigned int               n = face.degree + 1;
        std::vector<const ContactNode *> nodes;
        for (unsigned int i = 0; i < nodes_per_face(face); ++i)
          {
            const auto found = all_nodes.find({face.pair, face.nodes[i]});
            if (found != all_nodes.end())
              nodes.push_back(&found->second);
          }
        // Faces with a node that has no contact results are left out.
        if (nodes.size() < nodes_per_face(face))
          continue;

        dealii::DataOutBase::Patch<2, 3> patch;
        patch.patch_index = patches.size();
        // Degree 2 has three nodes per direction, i.e. two subdivisions.
        patch.n_subdivisions       = face.degree;
        patch.reference_cell       = dealii::ReferenceCells::get_hypercube<2>();
        patch.points_are_available = (face.degree > 1);
        curved |= patch.points_are_available;

        // Corners in the lexicographic numbering of n x n nodes.
        const unsigned int corners[4] = {0, n - 1, n * (n - 1), n * n - 1};
        for (unsigned int v = 0; v < 4; ++v)
          patch.vertices[v] = nodes[corners[v]]->reference_position;

        // Curved faces of degree 2 need the positions of all nodes: deal.II takes them from the
        // last rows of the data table. Positions are those of the reference state; the displacement
        // is a field.
        patch.data.reinit(n_rows + (patch.points_are_available ? dim : 0), n * n);
        for (unsigned int i = 0; i < n * n; ++i)
          {
            for (unsigned int c = 0; c < n_rows; ++c)
              patch.data(c, i) = c < n_values ? nodes[i]->values[c]
                                              : FileSeries::rest(nodes[i]->values[c - n_values]);
            if (patch.points_are_available)
              for (unsigned int d = 0; d < dim; ++d)
                patch.data(n_rows + d, i) = nodes[i]->reference_position[d];
          }
        patches.push_back(patch);
      }

    dealii::DataOutBase::VtkFlags flags;
    // Output of equal runs is equal byte by byte.
    flags.print_date_and_time      = false;
    flags.compression_level        = dealii::DataOutBase::VtkFlags::best_speed;
    flags.write_higher_order_cells = curved;
    set_flags(flags);
  }



  const std::vector<dealii::DataOutBase::Patch<2, 3>> &
  ContactSurfaceData::get_patches() const
  {
    return patches;
  }



  std::vector<std::string>
  ContactSurfaceData::get_dataset_names() const
  {
    std::vector<std::string> all;
    for (const ContactFieldList::Entry &entry : fields.entries())
      // deal.II wants a name for each component; those of a vector are the same.
      all.insert(all.end(), entry.field->n_components(), entry.name);
    if (with_rests)
      for (const ContactFieldList::Entry &entry : fields.entries())
        all.insert(all.end(), entry.field->n_components(), FileSeries::rest_name(entry.name));
    return all;
  }



  std::vector<std::tuple<unsigned int,
                         unsigned int,
                         std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>>
  ContactSurfaceData::get_nonscalar_data_ranges() const
  {
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
    for (const ContactFieldList::Entry &entry : fields.entries())
      // Three components are a vector to the viewer, which can then show arrows.
      if (entry.field->n_components() == dim)
        ranges.emplace_back(entry.first,
                            entry.first + dim - 1,
                            entry.name,
                            dealii::DataComponentInterpretation::component_is_part_of_vector);
    return ranges;
  }



  ContactOutput::ContactOutput(const OutputFolder &folder,
                               const ResultFormat  format,
                               const std::string  &name)
    : folder(folder)
    , files(FileSeries::make(format, folder, name))
  {
  }



  void
  ContactOutput::write(const std::vector<ContactFace>  &faces,
                       const std::vector<ContactPoint> &points,
                       const dealii::IndexSet          &owned,
                       const unsigned int               step,
                       const double                     time)
  {
    const ContactNodeMap nodes =
      collect_contact_nodes(fields, faces, points, owned, folder.communicator);
    const ContactSurfaceData data(fields, faces, nodes, files->has_doubles());
    // No file if no rank has a face, e.g. without contact pairs; the decision must be the same on
    // all ranks.
    const std::size_t n_patches =
      dealii::Utilities::MPI::sum(data.get_patches().size(), folder.communicator);
    if (n_patches > 0)
      files->write(data, step, time);
  }
} // namespace Touchstone
