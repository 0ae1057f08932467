#include <touchstone/algebra/constraint_graph.h>
#include <touchstone/contact/contact.h>
#include <touchstone/contact/enforcement/row_terms.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/strong_components.hpp>
#include <cmath>
#include <map>
#include <set>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The unknowns of the slave node that a row determines, and those that it
     * determines them by. */
    struct Dependence
    {
      Index              slave;
      std::vector<Index> unknowns, on;
    };

    void
    add_components(const Index           node,
                   const Tensor<1, dim> &coefficients,
                   const double          threshold,
                   std::vector<Index>   &unknowns)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (std::abs(coefficients[d]) > threshold)
          unknowns.push_back(dim * node + d);
    }

    /** @param free The part of the normal that the slave node can move along.
     * @param threshold Smaller coefficients do not count. */
    Dependence
    dependence(const ContactRow &row, const Tensor<1, dim> &free, const double threshold)
    {
      Dependence           result{row.slave, {}, {}};
      const Tensor<1, dim> all({1., 1., 1.});
      add_components(row.slave, row.held() ? all : free / free.norm(), threshold, result.unknowns);
      for (const StencilEntry &entry : row.stencil)
        add_components(entry.node, row.held() ? all : row.normal, threshold, result.on);
      if (row.derivative)
        for (const auto &[node, coefficients] : gap_gradient(row))
          add_components(node, coefficients, threshold, result.on);
      if (row.friction && row.held())
        for (const auto &[node, matrix] : row.friction->slip_gradient)
          for (unsigned int d = 0; d < dim; ++d)
            add_components(node, matrix[d], threshold, result.on);
      return result;
    }

    using Edges = std::vector<std::pair<unsigned int, unsigned int>>;

    /** Which vertices of a directed graph lie on a circle of two or more. */
    std::vector<bool>
    on_circles(const unsigned int n_vertices, const Edges &edges)
    {
      std::vector<bool> result(n_vertices, false);
      if (edges.empty())
        return result;
      const boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS> graph(edges.begin(),
                                                                                    edges.end(),
                                                                                    n_vertices);
      std::vector<unsigned int> component(n_vertices), size(n_vertices, 0);
      boost::strong_components(graph,
                               boost::make_iterator_property_map(
                                 component.begin(), boost::get(boost::vertex_index, graph)));
      for (const unsigned int c : component)
        ++size[c];
      for (unsigned int i = 0; i < n_vertices; ++i)
        result[i] = size[component[i]] > 1;
      return result;
    }

    /** Slave nodes with unknowns that depend on themselves. */
    std::set<Index>
    in_circles(const std::vector<Dependence> &rows)
    {
      std::map<Index, unsigned int> numbers;
      const auto                    number = [&](const Index unknown) {
        return numbers.emplace(unknown, numbers.size()).first->second;
      };
      Edges edges;
      for (const Dependence &row : rows)
        for (const Index from : row.unknowns)
          for (const Index to : row.on)
            edges.emplace_back(number(from), number(to));
      const std::vector<bool> circular = on_circles(numbers.size(), edges);
      std::set<Index>         result;
      for (const Dependence &row : rows)
        for (const Index from : row.unknowns)
          if (numbers.count(from) > 0 && circular[numbers.at(from)])
            result.insert(row.slave);
      return result;
    }
  } // namespace



  void
  Contact::find_circles()
  {
    // Pair p leads to pair q if master nodes of p are slave nodes of q.
    Edges edges;
    for (unsigned int p = 0; p < pairs.size(); ++p)
      for (unsigned int q = 0; q < pairs.size(); ++q)
        {
          int shared = 0;
          if (p != q && pairs[p].master)
            {
              std::set<Index> slaves;
              for (const SurfaceNode &node : pairs[q].slave->owned_nodes())
                slaves.insert(node.node);
              for (const Face &face : pairs[p].master->owned_faces())
                for (unsigned int m = 0; m < face.n_nodes(); ++m)
                  shared |= slaves.count(face.nodes[m]);
            }
          if (Utilities::MPI::max(shared, solid.communicator))
            edges.emplace_back(p, q);
        }
    const std::vector<bool> circle = on_circles(pairs.size(), edges);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      if (circle[p])
        circular.push_back(p);
  }



  void
  Contact::drop_circles(const ConstraintGraph &graph, const double threshold)
  {
    // Pair by pair: with the rows of earlier pairs, all of this pair that lie on a
    // circle go. So the order of nodes, which depends on the partition, does not
    // matter.
    std::vector<Dependence> kept;
    for (const unsigned int p : circular)
      {
        std::vector<Index> mine; // slave, numbers of unknowns and of others, both lists
        for (ContactRow &row : rows[p])
          {
            row.closes_circle         = false;
            const Tensor<1, dim> free = graph.free_part(row.slave, row.normal);
            if (!row.active() || free.norm() < 1e-3)
              continue;
            const Dependence d = dependence(row, free, threshold);
            mine.push_back(row.slave);
            mine.push_back(d.unknowns.size());
            mine.push_back(d.on.size());
            mine.insert(mine.end(), d.unknowns.begin(), d.unknowns.end());
            mine.insert(mine.end(), d.on.begin(), d.on.end());
          }
        std::vector<Dependence> of_pair;
        std::set<Index>         slaves;
        for (const auto &list : Utilities::MPI::all_gather(solid.communicator, mine))
          for (auto i = list.begin(); i != list.end(); i += 3 + i[1] + i[2])
            {
              of_pair.push_back({i[0], {i + 3, i + 3 + i[1]}, {i + 3 + i[1], i + 3 + i[1] + i[2]}});
              slaves.insert(i[0]);
            }
        // How slave nodes depend on their neighbours is for the enforcement to see to.
        for (Dependence &d : of_pair)
          d.on.erase(std::remove_if(d.on.begin(),
                                    d.on.end(),
                                    [&](const Index unknown) {
                                      return slaves.count(unknown / dim) > 0;
                                    }),
                     d.on.end());
        std::vector<Dependence> all(kept);
        all.insert(all.end(), of_pair.begin(), of_pair.end());
        const std::set<Index> circle = in_circles(all);
        for (const Dependence &d : of_pair)
          if (circle.count(d.slave) == 0)
            kept.push_back(d);
        for (ContactRow &row : rows[p])
          if (row.active() && circle.count(row.slave) > 0)
            {
              row.closes_circle = true;
              row.clear_force();
            }
      }
  }
} // namespace Touchstone
