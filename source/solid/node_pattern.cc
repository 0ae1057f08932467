#include <touchstone/solid/node_pattern.h>

#include <Epetra_CrsGraph.h>
#include <algorithm>

namespace Touchstone
{
  using namespace dealii;

  void
  reinit_by_nodes(Matrix                       &matrix,
                  const IndexSet               &owned,
                  const DynamicSparsityPattern &couplings,
                  const MPI_Comm                communicator)
  {
    const Index n_nodes = owned.n_elements() / dim;
    const Index first   = n_nodes > 0 ? owned.nth_index_in_set(0) / dim : 0;
    const auto  mine    = [&](const Index node) { return node >= first && node < first + n_nodes; };

    // Columns: those of this rank, then the others in ascending order, and thus by ranks.
    std::vector<Index> far;
    for (Index node = first; node < first + n_nodes; ++node)
      for (auto entry = couplings.begin(node); entry != couplings.end(node); ++entry)
        if (!mine(entry->column()))
          far.push_back(entry->column());
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    std::vector<int> numbers;
    numbers.reserve(dim * (n_nodes + far.size()));
    for (Index i = dim * first; i < dim * (first + n_nodes); ++i)
      numbers.push_back(static_cast<int>(i));
    for (const Index node : far)
      for (unsigned int d = 0; d < dim; ++d)
        numbers.push_back(static_cast<int>(dim * node + d));
    const Epetra_Map rows = owned.make_trilinos_map(communicator, false);
    const Epetra_Map columns(-1, static_cast<int>(numbers.size()), numbers.data(), 0, rows.Comm());

    std::vector<int> lengths;
    lengths.reserve(dim * n_nodes);
    for (Index node = first; node < first + n_nodes; ++node)
      lengths.insert(lengths.end(), dim, static_cast<int>(dim * couplings.row_length(node)));
    Epetra_CrsGraph  graph(Copy, rows, columns, lengths.data(), true);
    std::vector<int> of_row, of_others;
    for (Index node = first; node < first + n_nodes; ++node)
      {
        of_row.clear();
        of_others.clear();
        for (auto entry = couplings.begin(node); entry != couplings.end(node); ++entry)
          {
            const Index other = entry->column();
            const Index local =
              mine(other)
                ? other - first
                : n_nodes + (std::lower_bound(far.begin(), far.end(), other) - far.begin());
            for (unsigned int d = 0; d < dim; ++d)
              (mine(other) ? of_row : of_others).push_back(static_cast<int>(dim * local + d));
          }
        of_row.insert(of_row.end(), of_others.begin(), of_others.end());
        for (unsigned int d = 0; d < dim; ++d)
          graph.InsertMyIndices(static_cast<int>(dim * (node - first) + d),
                                static_cast<int>(of_row.size()),
                                of_row.data());
      }
    graph.FillComplete(rows, rows);
    graph.OptimizeStorage();
    // A matrix without values, of which deal.II takes the graph.
    matrix.reinit(Epetra_CrsMatrix(View, graph), false);
  }
} // namespace Touchstone
