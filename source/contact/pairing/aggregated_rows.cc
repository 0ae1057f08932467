// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/ask_owners.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/pairing/aggregated_rows.h>
#include <touchstone/contact/tolerances.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

// Edges where pairs meet (doc/theory.md 3.1) with pairings that have one point for each slave node.
// A node and those that take its part may belong to different ranks: owners say what nodes face.
namespace Touchstone
{
  using namespace dealii;

  AggregatedRows::AggregatedRows(const PairingInput &input)
    : input(input)
  {
    std::set<Index> nodes;
    for (const auto *const list : {&input.slave->owned_faces(), &input.slave->neighbour_faces()})
      for (const Face &face : *list)
        if (std::count(face.without_row.begin(), face.without_row.end(), true) > 0)
          {
            const TraceBasis *const basis = input.slave->trace(face);
            faces.push_back({face.n_nodes(),
                             basis ? basis->nodes : face.nodes,
                             face.without_row,
                             whole_areas(face, basis, /*reference=*/true)});
            nodes.insert(faces.back().nodes.begin(), faces.back().nodes.begin() + face.n_nodes());
          }
    const std::vector<SurfaceNode> &owned = input.slave->owned_nodes();
    for (std::size_t k = 0; k < owned.size(); ++k)
      if (nodes.count(owned[k].node) > 0)
        rows_of_nodes.emplace(owned[k].node, k);
    for (const Index node : nodes)
      known.emplace(node, RowOfNode());
    anywhere = Utilities::MPI::max(static_cast<int>(!faces.empty()), input.solid->communicator) > 0;
  }



  void
  AggregatedRows::ask_for_rows(const std::vector<ContactRow> &rows)
  {
    std::vector<Index> nodes;
    for (const auto &entry : known)
      nodes.push_back(entry.first);
    const std::vector<RowOfNode> answers = ask_owners<RowOfNode>(
      nodes,
      input.solid->owned,
      input.solid->communicator,
      [](const Index node) { return dim * node; },
      [&](const Index node) -> RowOfNode {
        const ContactRow &row = rows[rows_of_nodes.at(node)];
        return {row.has_partner,
                static_cast<unsigned int>(row.stencil.size()),
                row.normal,
                row.gap_vector,
                row.position};
      });
    for (std::size_t i = 0; i < nodes.size(); ++i)
      known[nodes[i]] = answers[i];
  }



  std::map<std::size_t, double>
  AggregatedRows::divide_areas()
  {
    std::map<std::size_t, double> left;
    parts.clear();
    for (const FaceOfNodes &face : faces)
      {
        // Nodes that face nothing can take no part.
        const auto receives = [&](const unsigned int k) {
          return !face.without_row[k] && face.areas[k] > 0. && known.at(face.nodes[k]).has_partner;
        };
        double sum = 0.;
        for (unsigned int k = 0; k < face.n; ++k)
          if (receives(k))
            sum += face.areas[k];
        for (unsigned int i = 0; i < face.n && sum > 0.; ++i)
          {
            const RowOfNode &given = known.at(face.nodes[i]);
            if (!face.without_row[i] || !given.has_partner)
              continue;
            if (const auto row = rows_of_nodes.find(face.nodes[i]); row != rows_of_nodes.end())
              left[row->second] += face.areas[i];
            for (unsigned int k = 0; k < face.n; ++k)
              if (const auto row = rows_of_nodes.find(face.nodes[k]);
                  receives(k) && row != rows_of_nodes.end())
                {
                  Part &part = parts[row->second][face.nodes[i]];
                  part.ratio += face.areas[i] * face.areas[k] /
                                (sum * input.slave->owned_nodes()[row->second].area);
                  part.row = &given;
                }
          }
      }
    return left;
  }



  void
  AggregatedRows::ask_for_stencils(const std::vector<ContactRow> &rows)
  {
    struct NumberOfEntry
    {
      Index        node;
      unsigned int number;
    };
    std::map<Index, Stencil> stencils;
    for (const auto &of_row : parts)
      for (const auto &part : of_row.second)
        stencils.emplace(part.first, Stencil());
    std::vector<NumberOfEntry> asked;
    for (const auto &[node, stencil] : stencils)
      for (unsigned int m = 0; m < known.at(node).n_entries; ++m)
        asked.push_back({node, m});
    const std::vector<StencilEntry> answers = ask_owners<StencilEntry>(
      asked,
      input.solid->owned,
      input.solid->communicator,
      [](const NumberOfEntry &of) { return dim * of.node; },
      [&](const NumberOfEntry &of) { return rows[rows_of_nodes.at(of.node)].stencil[of.number]; });
    for (std::size_t i = 0; i < asked.size(); ++i)
      stencils[asked[i].node].push_back(answers[i]);
    for (auto &of_row : parts)
      for (auto &[node, part] : of_row.second)
        part.stencil = stencils[node];
  }



  void
  AggregatedRows::add(const std::map<Index, Part> &parts, ContactRow &row)
  {
    const auto weight_of = [&row](const Index node) -> double & {
      for (StencilEntry &entry : row.stencil)
        if (entry.node == node)
          return entry.weight;
      return row.stencil.emplace_back(StencilEntry{node, 0.}).weight;
    };
    for (const auto &[node, part] : parts)
      {
        weight_of(node) -= part.ratio;
        for (const StencilEntry &entry : part.stencil)
          weight_of(entry.node) += part.ratio * entry.weight;
        row.normal += part.ratio * part.row->normal;
        row.gap_vector += part.ratio * part.row->gap_vector;
        row.lever += part.ratio * (part.row->position - row.position);
        row.share += part.ratio;
      }
    row.normal /= row.normal.norm();
    row.lever /= row.share;
    row.gap = row.gap_vector * row.normal;
  }



  void
  AggregatedRows::aggregate(std::vector<ContactRow> &rows)
  {
    if (!anywhere)
      return;
    ask_for_rows(rows);
    const std::map<std::size_t, double> left = divide_areas();
    ask_for_stencils(rows);
    for (const auto &[k, of_row] : parts)
      add(of_row, rows[k]);
    for (const auto &[k, area] : left)
      {
        // A face all of whose nodes are such nodes remains theirs.
        ContactRow &row = rows[k];
        row.area -= area;
        if (row.area > Tolerances::fully_covered * area)
          continue;
        row.has_partner = false;
        row.gap = row.area = row.away = 0.;
        row.stencil.clear();
      }
  }



  void
  AggregatedRows::differentiate(std::vector<ContactRow> &rows) const
  {
    for (const auto &[k, of_row] : parts)
      {
        if (!rows[k].derivative)
          continue;
        auto       derivative = std::make_shared<RowDerivative>(*rows[k].derivative);
        const auto add        = [&](const Index node, const double weight) {
          std::size_t a = std::find(derivative->nodes.begin(), derivative->nodes.end(), node) -
                          derivative->nodes.begin();
          if (a == derivative->nodes.size())
            {
              derivative->nodes.push_back(node);
              derivative->normal.emplace_back();
              derivative->gap_vector.emplace_back();
              for (auto &of_entry : derivative->weights)
                of_entry.emplace_back();
            }
          derivative->gap_vector[a] += weight * Tensor<2, dim>(unit_symmetric_tensor<dim>());
        };
        for (const auto &[node, part] : of_row)
          {
            add(node, part.ratio);
            for (const StencilEntry &entry : part.stencil)
              add(entry.node, -part.ratio * entry.weight);
          }
        rows[k].derivative = derivative;
      }
  }
} // namespace Touchstone
