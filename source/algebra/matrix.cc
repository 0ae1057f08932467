// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// The stiffness and the mass: pattern and operations on entries of a BlockMatrix in double
// precision that is filled cell by cell (doc/theory.md, section 7). All indices are local ones:
// nodes of this rank first, then those of others in ascending order.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int block_size = dim * dim;
  }



  // The pattern from the couplings of nodes, a third of the rows and columns of a pattern of
  // dofs. Maps of Epetra in the same numbering are for the condensed matrix, whose first columns
  // are these.
  void
  Matrix::reinit(const IndexSet               &owned,
                 const DynamicSparsityPattern &couplings,
                 const MPI_Comm                communicator,
                 const bool                    symmetric)
  {
    const Index n_nodes = owned.n_elements() / dim;
    const Index first   = n_nodes > 0 ? owned.nth_index_in_set(0) / dim : 0;
    const auto  mine    = [&](const Index node) { return node >= first && node < first + n_nodes; };

    // Local indices are those of this rank, then the others in ascending order.
    std::vector<Index> far;
    for (Index node = first; node < first + n_nodes; ++node)
      for (auto entry = couplings.begin(node); entry != couplings.end(node); ++entry)
        if (!mine(entry->column()))
          far.push_back(entry->column());
    std::sort(far.begin(), far.end());
    far.erase(std::unique(far.begin(), far.end()), far.end());
    row_map = std::make_shared<Epetra_Map>(owned.make_trilinos_map(communicator, false));
    std::vector<int> numbers;
    numbers.reserve(dim * (n_nodes + far.size()));
    for (Index i = dim * first; i < dim * (first + n_nodes); ++i)
      numbers.push_back(static_cast<int>(i));
    for (const Index node : far)
      for (unsigned int d = 0; d < dim; ++d)
        numbers.push_back(static_cast<int>(dim * node + d));
    column_map = row_map;
    if (Utilities::MPI::max(far.empty() ? 0 : 1, communicator) == 1)
      column_map = std::make_shared<Epetra_Map>(
        -1, static_cast<int>(numbers.size()), numbers.data(), 0, row_map->Comm());

    auto made         = std::make_shared<BlockPattern>();
    made->partitioner = BlockRows::number(*row_map, numbers.data(), numbers.size());
    made->symmetric   = symmetric;
    made->start.reserve(n_nodes + 1);
    made->upper_end.reserve(n_nodes);
    std::size_t n_blocks = 0;
    for (Index node = first; node < first + n_nodes; ++node)
      n_blocks += couplings.row_length(node);
    made->column.reserve(symmetric ? n_blocks * 11 / 20 : n_blocks);
    std::vector<unsigned int> of_row, of_others;
    for (Index node = first; node < first + n_nodes; ++node)
      {
        of_row.clear();
        of_others.clear();
        for (auto entry = couplings.begin(node); entry != couplings.end(node); ++entry)
          if (const Index other = entry->column(); !mine(other))
            of_others.push_back(n_nodes +
                                (std::lower_bound(far.begin(), far.end(), other) - far.begin()));
          else if (made->has(node - first, other - first))
            of_row.push_back(other - first);
        // In ascending order, as add_row() wants it: own columns, then those of others, whose
        // local indices are higher.
        of_row.insert(of_row.end(), of_others.begin(), of_others.end());
        made->add_row(of_row);
      }
    pattern = made;
    entries.clear();
    allocate();
  }



  // Patterns are shared and never changed, so matrices on one mesh, such as stiffness and mass,
  // hold it once.
  void
  Matrix::reinit(const Matrix &other)
  {
    pattern    = other.pattern;
    row_map    = other.row_map;
    column_map = other.column_map;
    entries.clear();
    allocate();
  }



  Matrix &
  Matrix::operator=(const double value)
  {
    std::fill(entries.begin(), entries.end(), value);
    return *this;
  }



  Matrix &
  Matrix::operator*=(const double factor)
  {
    for (double &entry : entries)
      entry *= factor;
    return *this;
  }



  void
  Matrix::copy_from(const Matrix &other)
  {
    if (pattern != other.pattern)
      reinit(other);
    std::copy(other.entries.begin(), other.entries.end(), entries.begin());
  }



  // Factors differ from body to body only, and the continuum does not couple bodies: a factor of
  // the row is also that of the column, so rows of a symmetric matrix stored by halves can be
  // scaled.
  void
  Matrix::add(const Vector &factors, const Matrix &added)
  {
    AssertThrow(pattern == added.pattern || pattern->column == added.pattern->column,
                ExcMessage("The matrices have different patterns."));
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (std::size_t k = pattern->start[node]; k < pattern->start[node + 1]; ++k)
        for (unsigned int e = 0; e < block_size; ++e)
          entries[block_size * k + e] +=
            factors.begin()[dim * node + e % dim] * added.entries[block_size * k + e];
  }



  // The diagonal block is stored once in either kind of pattern; its diagonal entries are 0, 4
  // and 8.
  void
  Matrix::add_to_diagonal(const Vector &values)
  {
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (unsigned int d = 0; d < dim; ++d)
        entries[block_size * pattern->diagonal(node) + (dim + 1) * d] +=
          values.begin()[dim * node + d];
  }



  // Blocks of the node's row only; with symmetric storage the transposes that other rows store
  // stay.
  void
  Matrix::clear_node(const int row)
  {
    std::fill(entries.begin() + block_size * pattern->start[row / dim],
              entries.begin() + block_size * pattern->start[row / dim + 1],
              0.);
  }



  // Sums by rows of |a_ij| (force per length), with which Solid estimates the round-off of the
  // forces A u. A block above the diagonal is also, transposed, in the row of its column.
  std::vector<double>
  Matrix::absolute_row_sums() const
  {
    std::vector<double> sums(dim * n_nodes(), 0.);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (std::size_t k = pattern->start[node]; k < pattern->start[node + 1]; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int r = 0; r < dim; ++r)
            {
              const double value = std::abs(entries[block_size * k + dim * c + r]);
              sums[dim * node + r] += value;
              if (k < pattern->upper_end[node])
                sums[dim * pattern->column[k] + c] += value;
            }
    return sums;
  }



  // Blocks that stand for their transposes count twice.
  double
  Matrix::frobenius_norm() const
  {
    double sum = 0.;
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (std::size_t k = pattern->start[node]; k < pattern->start[node + 1]; ++k)
        for (unsigned int e = 0; e < block_size; ++e)
          sum += (k < pattern->upper_end[node] ? 2. : 1.) * entries[block_size * k + e] *
                 entries[block_size * k + e];
    return std::sqrt(Utilities::MPI::sum(sum, pattern->partitioner->get_mpi_communicator()));
  }
} // namespace Touchstone
