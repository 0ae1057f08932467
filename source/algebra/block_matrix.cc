// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/algebra/block_matrix.h>
#include <touchstone/base/vectorised.h>

#include <algorithm>
#include <numeric>
#include <utility>

// Square matrices in 3 x 3 blocks of nodes. Products with them bound the speed of a Krylov solver
// with multigrid, and their own bound is the memory bandwidth: of a symmetric matrix a block and
// its transpose are stored and read once, and one column index serves nine entries
// (doc/theory.md, section 7).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int block = dim * dim;

    /** Numbers of a node in padded results: three would end within the register of the next. */
    constexpr unsigned int pad = 4;

    /**
     * Numbers that are read behind a block: its last column is loaded as a register of four, of
     * which three belong to the block.
     */
    constexpr unsigned int unused = 1;

    /**
     * out += A in, the result padded. The blocks of a row from start to upper_end stand for their
     * transposes, too: such a block a of (node, j) adds a x_j to the result of the node and a^T
     * x_node to that of j, so it is loaded once for both. Blocks behind upper_end (diagonal,
     * columns of other ranks) are used once.
     */
    template <typename Number>
    __attribute__((always_inline)) inline void
    add_product(const BlockPattern &pattern,
                const Number       *entries,
                const Number       *in,
                Number             *result)
    {
      using Vector4                     = typename Simd<Number, 4>::type;
      auto *const               out     = reinterpret_cast<Vector4 *>(result);
      const unsigned int *const column  = pattern.column.data();
      const unsigned int        n_nodes = pattern.n_nodes();
      for (unsigned int node = 0; node < n_nodes; ++node)
        {
          // Three rows of the node and one that is not used: what fits into a register.
          Vector4           sums[dim] = {};
          const Number      own[dim]  = {in[dim * node], in[dim * node + 1], in[dim * node + 2]};
          const std::size_t end       = pattern.upper_end[node];
          for (std::size_t k = pattern.start[node]; k < end; ++k)
            {
              const Number *a = entries + block * k;
              const Number *y = in + dim * column[k];
              // Columns of the block, and rows of it. These from the registers: what limits
              // the speed are loads.
              const Vector4 a0 = *reinterpret_cast<const Vector4 *>(a),
                            a1 = *reinterpret_cast<const Vector4 *>(a + dim),
                            a2 = *reinterpret_cast<const Vector4 *>(a + 2 * dim);
              sums[0] += a0 * y[0];
              sums[1] += a1 * y[1];
              sums[2] += a2 * y[2];
              // The rows of the block, from its columns a0, a1, a2. The fourth numbers are
              // meaningless, and so is the fourth of out[], which multiply() never copies back.
              const Vector4 upper = TOUCHSTONE_SHUFFLE(a0, a1, 0, 4, 1, 5),
                            lower = TOUCHSTONE_SHUFFLE(a0, a1, 2, 6, 3, 7);
              out[column[k]] += TOUCHSTONE_SHUFFLE(upper, a2, 0, 1, 4, 5) * own[0] +
                                TOUCHSTONE_SHUFFLE(upper, a2, 2, 3, 5, 6) * own[1] +
                                TOUCHSTONE_SHUFFLE(lower, a2, 0, 1, 6, 7) * own[2];
            }
          for (std::size_t k = end; k < pattern.start[node + 1]; ++k)
            {
              const Number *a = entries + block * k;
              const Number *y = in + dim * column[k];
              for (unsigned int d = 0; d < dim; ++d)
                sums[d] += *reinterpret_cast<const Vector4 *>(a + dim * d) * y[d];
            }
          out[node] += sums[0] + sums[1] + sums[2];
        }
    }

    // The versions for several instruction sets are chosen at run time by the loader, which does
    // not work for templates.
    TOUCHSTONE_VECTORISED void
    product(const BlockPattern &pattern, const float *entries, const float *in, float *out)
    {
      add_product(pattern, entries, in, out);
    }

    TOUCHSTONE_VECTORISED void
    product(const BlockPattern &pattern, const double *entries, const double *in, double *out)
    {
      add_product(pattern, entries, in, out);
    }
  } // namespace



  // The transposed pattern of the strictly upper blocks, by counting sort: lengths of the rows,
  // their prefix sums as row pointers, then the blocks. The rows are visited in ascending order,
  // so each list comes out sorted.
  std::shared_ptr<const BlockPattern::TransposedBlocks>
  BlockPattern::transposed_blocks() const
  {
    if (auto known = known_transposed.lock())
      return known;
    auto result = std::make_shared<TransposedBlocks>();
    result->start.resize(n_nodes() + 1, 0);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (std::size_t k = start[node]; k < upper_end[node]; ++k)
        ++result->start[column[k] + 1];
    std::partial_sum(result->start.begin(), result->start.end(), result->start.begin());
    result->nodes.resize(result->start.back());
    std::vector<std::size_t> next(result->start);
    for (unsigned int node = 0; node < n_nodes(); ++node)
      for (std::size_t k = start[node]; k < upper_end[node]; ++k)
        result->nodes[next[column[k]]++] = node;
    known_transposed = result;
    return result;
  }



  // Pattern and entries in one pass over the rows, which may be expensive to make (Condensation,
  // Galerkin product) and are read once. 11/20 is half of the blocks and 10 % for the diagonal
  // and for columns of other ranks, which are never stored once for two.
  template <typename Number>
  BlockMatrix<Number>::BlockMatrix(BlockRows &rows, const bool symmetric)
  {
    auto made                         = std::make_shared<BlockPattern>();
    made->partitioner                 = rows.numbers();
    made->symmetric                   = symmetric;
    const unsigned int        n_owned = rows.n_nodes();
    std::vector<unsigned int> order, columns;
    const std::size_t         n_blocks = symmetric ? rows.n_blocks() * 11 / 20 : rows.n_blocks();
    // Reserved at once: growing the arrays step by step would need twice the memory for a while,
    // and the stiffness is among the largest data of a run.
    made->start.reserve(n_owned + 1);
    made->upper_end.reserve(n_owned);
    made->column.reserve(n_blocks);
    entries.reserve(block * n_blocks + unused);
    for (unsigned int node = 0; node < n_owned; ++node)
      {
        const auto &row = rows.read(node);
        order.clear();
        columns.clear();
        for (unsigned int k = 0; k < row.columns.size(); ++k)
          if (made->has(node, row.columns[k]))
            order.push_back(k);
        // Ascending columns: the look-up of a block is a binary search, and memory is read
        // forwards.
        std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
          return row.columns[a] < row.columns[b];
        });
        for (const unsigned int k : order)
          columns.push_back(row.columns[k]);
        made->add_row(columns);
        entries.resize_fast(block * made->column.size());
        for (const unsigned int k : order)
          {
            Number *to = &entries[block * made->block(node, row.columns[k])];
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int r = 0; r < dim; ++r)
                // Stored column by column, since add_product() multiplies columns by numbers.
                *to++ = static_cast<Number>(row.blocks[k][dim * r + c]);
          }
      }
    for (unsigned int k = 0; k < unused; ++k)
      entries.push_back(Number(0.));
    pattern = made;
    allocate();
  }



  template <typename Number>
  void
  BlockMatrix<Number>::allocate()
  {
    if (entries.size() == 0)
      entries.resize(block * pattern->column.size() + unused);
    imported.resize(pattern->partitioner->n_import_indices());
  }



  // The exchange of ghosts is started first, so the messages travel while the own part of x is
  // copied before them; without ghosts it is read where it is. Arrays are plain, for callers whose
  // vectors are those of Epetra or deal.II.
  template <typename Number>
  void
  BlockMatrix<Number>::multiply(Number *result, const Number *x) const
  {
    const auto        &partitioner = *pattern->partitioner;
    const unsigned int n = pattern->n_nodes(), n_ghosts = partitioner.n_ghost_indices();
    const Number      *in = x;
    padded_out.resize(pad * n);
    with_ghosts.resize(n_ghosts > 0 ? dim * n + n_ghosts : 0);
    const ArrayView<Number, MemorySpace::Host> ghosts(with_ghosts.end() - n_ghosts, n_ghosts);
    std::vector<MPI_Request>                   requests;
    partitioner.export_to_ghosted_array_start(
      0,
      ArrayView<const Number, MemorySpace::Host>(x, dim * n),
      ArrayView<Number, MemorySpace::Host>(imported.data(), imported.size()),
      ghosts,
      requests);
    if (n_ghosts > 0)
      {
        std::copy_n(x, dim * n, with_ghosts.begin());
        in = with_ghosts.data();
      }
    partitioner.export_to_ghosted_array_finish(ghosts, requests);
    std::fill(padded_out.begin(), padded_out.end(), Number(0.));
    product(*pattern, entries.data(), in, padded_out.data());
    for (unsigned int node = 0; node < n; ++node)
      std::copy_n(padded_out.data() + pad * node, dim, result + dim * node);
  }



  template <typename Number>
  typename BlockMatrix<Number>::VectorType
  BlockMatrix<Number>::inverse_diagonal() const
  {
    VectorType result;
    initialize_vector(result);
    for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
      result.local_element(i) = Number(1.) / diagonal(i);
    return result;
  }



  template <typename Number>
  std::pair<std::size_t, std::size_t>
  BlockMatrix<Number>::Rows::transposed_range(const unsigned int node)
  {
    if (!transposed)
      transposed = matrix.pattern->transposed_blocks();
    return {transposed->start[node], transposed->start[node + 1]};
  }



  template <typename Number>
  unsigned int
  BlockMatrix<Number>::Rows::length(const unsigned int node)
  {
    const auto [begin, end] = transposed_range(node);
    return end - begin + matrix.pattern->start[node + 1] - matrix.pattern->start[node];
  }



  // In ascending columns: the diagonal, the upper blocks of this rank, and those with columns of
  // other ranks.
  template <typename Number>
  void
  BlockMatrix<Number>::Rows::append_stored(const unsigned int node)
  {
    const BlockPattern &pattern = *matrix.pattern;
    const std::size_t   known = present.columns.size(), first = pattern.start[node],
                      n_own = pattern.start[node + 1] - first,
                      upper = pattern.upper_end[node] - first;
    present.columns.resize(known + n_own);
    present.blocks.resize(known + n_own);
    const auto copy = [&](const std::size_t from, const std::size_t n, const std::size_t to) {
      std::copy_n(pattern.column.begin() + first + from, n, present.columns.begin() + known + to);
      std::copy_n(matrix.entries.data() + block * (first + from),
                  block * n,
                  reinterpret_cast<Number *>(present.blocks.data() + known + to));
    };
    // The diagonal is the first of what follows the upper part. Where upper blocks follow, it
    // has to be put before them; otherwise all is in order.
    const std::size_t middle = upper > 0 ? 1 : 0;
    copy(upper, middle, 0);
    copy(0, upper, middle);
    copy(upper + middle, n_own - upper - middle, upper + middle);
  }



  template <typename Number>
  const typename BlockMatrix<Number>::Rows::Row &
  BlockMatrix<Number>::Rows::read_stored(const unsigned int node)
  {
    present_node = dealii::numbers::invalid_unsigned_int;
    present.columns.clear();
    present.blocks.clear();
    append_stored(node);
    return present;
  }



  // The whole row of a node in ascending columns: transposes of the blocks stored in earlier
  // rows, then those that it stores.
  template <typename Number>
  const typename BlockMatrix<Number>::Rows::Row &
  BlockMatrix<Number>::Rows::read(const unsigned int node)
  {
    if (node == present_node)
      return present;
    present_node            = node;
    const auto [begin, end] = transposed_range(node);
    present.columns.resize(end - begin);
    present.blocks.resize(end - begin);
    // Stored column by column: a[3 r + c] is entry (c, r), and its transpose goes to (r, c).
    for (std::size_t m = 0; m < end - begin; ++m)
      {
        const unsigned int other = transposed->nodes[begin + m];
        const Number      *a = matrix.entries.data() + block * matrix.pattern->block(other, node);
        present.columns[m]   = other;
        for (unsigned int r = 0; r < dim; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            present.blocks[m][dim * c + r] = a[dim * r + c];
      }
    append_stored(node);
    return present;
  }



  template class BlockMatrix<float>;
  template class BlockMatrix<double>;
} // namespace Touchstone
