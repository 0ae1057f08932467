// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/collision/box_tree.h>
#include <touchstone/collision/radix_sort.h>
#include <touchstone/collision/search_grid.h>

#include <limits>

namespace Touchstone
{
  void
  BoxTree::build(const SearchBoxes &input)
  {
    numbers.resize(input.n());
    boxes.resize(input.n());
    levels.clear();
    if (input.n() == 0)
      return;
    // 2^16 cells in a direction separate what can be separated, at five passes of the sort.
    const SearchGrid      grid(input.whole, input.whole.size() / 65535.);
    std::vector<CodedBox> order(input.n()), scratch;
    for (unsigned int k = 0; k < input.n(); ++k)
      {
        const FlatBox &box = input.boxes[k];
        double         centre[dim];
        for (unsigned int d = 0; d < dim; ++d)
          centre[d] = 0.5 * (box.lower[d] + box.upper[d]);
        order[k] = {morton_code(grid.cell(centre)), k};
      }
    radix_sort(order, scratch);
    for (unsigned int k = 0; k < input.n(); ++k)
      numbers[k] = order[k].box;
    unsigned int size = (input.n() + leaf_size - 1) / leaf_size;
    levels.emplace_back(size);
    while (size > 1)
      levels.emplace_back(size = (size + 1) / 2);
    refit(input);
  }


  void
  BoxTree::refit(const SearchBoxes &input)
  {
    if (levels.empty())
      return;
    const auto set = [&](const unsigned int k) {
      return input.one_set ? 3u : numbers[k] < input.n_first ? 1u : 2u;
    };
    for (unsigned int leaf = 0; leaf < levels[0].size(); ++leaf)
      {
        const unsigned int first = leaf_size * leaf;
        boxes[first]             = input.boxes[numbers[first]];
        Node node{boxes[first], set(first)};
        for (unsigned int k = first + 1; k < std::min(first + leaf_size, n()); ++k)
          {
            boxes[k] = input.boxes[numbers[k]];
            node.box.merge(boxes[k]);
            node.sets |= set(k);
          }
        levels[0][leaf] = node;
      }
    for (unsigned int level = 1; level < levels.size(); ++level)
      for (unsigned int k = 0; k < levels[level].size(); ++k)
        {
          const std::vector<Node> &children = levels[level - 1];
          Node                     node     = children[2 * k];
          if (2 * k + 1 < children.size())
            {
              node.box.merge(children[2 * k + 1].box);
              node.sets |= children[2 * k + 1].sets;
            }
          levels[level][k] = node;
        }
  }


  double
  BoxTree::looseness() const
  {
    if (levels.empty() || levels.back()[0].box.sum_of_sides() == 0.)
      return 0.;
    double sum = 0.;
    for (const Node &leaf : levels[0])
      sum += leaf.box.sum_of_sides();
    return sum / (levels[0].size() * levels.back()[0].box.sum_of_sides());
  }


  /** Descends into pairs of nodes of the same level that meet. */
  class BoxTree::PairSearch
  {
  public:
    PairSearch(const BoxTree &tree, const SearchBoxes &input, BoxPairs &pairs)
      : tree(tree)
      , input(input)
      , pairs(pairs)
    {
    }

    /** @brief Pairs below a node. */
    void
    within(const unsigned int level, const unsigned int node) const
    {
      if (single_set(tree.levels[level][node].sets))
        return;
      if (level == 0)
        {
          const unsigned int first = leaf_size * node, end = std::min(first + leaf_size, tree.n());
          for (unsigned int i = first; i < end; ++i)
            for (unsigned int j = i + 1; j < end; ++j)
              test(i, j);
          return;
        }
      within(level - 1, 2 * node);
      if (2 * node + 1 < tree.levels[level - 1].size())
        {
          within(level - 1, 2 * node + 1);
          between(level - 1, 2 * node, 2 * node + 1);
        }
    }

  private:
    const BoxTree     &tree;
    const SearchBoxes &input;
    BoxPairs          &pairs;

    static bool
    single_set(const unsigned int sets)
    {
      return sets != 3u;
    }

    void
    test(const unsigned int i, const unsigned int j) const
    {
      if (tree.boxes[i].meets(tree.boxes[j]) && input.sought(tree.numbers[i], tree.numbers[j]))
        pairs.emplace_back(tree.numbers[i], tree.numbers[j]);
    }

    /** @brief Pairs of a box below node @p m and one below node @p n. */
    void
    between(const unsigned int level, const unsigned int m, const unsigned int n) const
    {
      const Node &first = tree.levels[level][m], &second = tree.levels[level][n];
      if (!first.box.meets(second.box) || single_set(first.sets | second.sets))
        return;
      if (level == 0)
        {
          const unsigned int end_i = std::min(leaf_size * (m + 1), tree.n()),
                             end_j = std::min(leaf_size * (n + 1), tree.n());
          for (unsigned int i = leaf_size * m; i < end_i; ++i)
            if (tree.boxes[i].meets(second.box))
              for (unsigned int j = leaf_size * n; j < end_j; ++j)
                test(i, j);
          return;
        }
      const unsigned int size = tree.levels[level - 1].size();
      for (unsigned int i = 2 * m; i < std::min(2 * m + 2, size); ++i)
        for (unsigned int j = 2 * n; j < std::min(2 * n + 2, size); ++j)
          between(level - 1, i, j);
    }
  };


  void
  BoxTree::pairs(const SearchBoxes &input, BoxPairs &pairs) const
  {
    if (!levels.empty())
      PairSearch(*this, input, pairs).within(levels.size() - 1, 0);
  }


  void
  BoxTree::meeting(const FlatBox &box, std::vector<unsigned int> &result) const
  {
    if (!levels.empty())
      meeting(box, levels.size() - 1, 0, result);
  }


  void
  BoxTree::meeting(const FlatBox             &box,
                   const unsigned int         level,
                   const unsigned int         node,
                   std::vector<unsigned int> &result) const
  {
    if (!levels[level][node].box.meets(box))
      return;
    if (level == 0)
      {
        for (unsigned int k = leaf_size * node; k < std::min(leaf_size * (node + 1), n()); ++k)
          if (boxes[k].meets(box))
            result.push_back(numbers[k]);
        return;
      }
    for (unsigned int k = 2 * node;
         k < std::min<unsigned int>(2 * node + 2, levels[level - 1].size());
         ++k)
      meeting(box, level - 1, k, result);
  }


  void
  BoxTree::nearest(const dealii::Point<dim>                  &x,
                   const std::function<double(unsigned int)> &look_at) const
  {
    if (!levels.empty())
      nearest(x, std::numeric_limits<double>::max(), levels.size() - 1, 0, look_at);
  }


  double
  BoxTree::nearest(const dealii::Point<dim>                  &x,
                   double                                     reach,
                   const unsigned int                         level,
                   const unsigned int                         node,
                   const std::function<double(unsigned int)> &look_at) const
  {
    if (level == 0)
      {
        for (unsigned int k = leaf_size * node; k < std::min(leaf_size * (node + 1), n()); ++k)
          if (boxes[k].distance_square(x) <= reach)
            {
              const double distance = look_at(numbers[k]);
              // Boxes in the same distance but for round-off are visited, too.
              reach = distance * distance * (1. + 1e-12);
            }
        return reach;
      }
    unsigned int below[2] = {2 * node, 2 * node + 1};
    const auto   away     = [&](const unsigned int child) {
      return child < levels[level - 1].size() ? levels[level - 1][child].box.distance_square(x)
                                                    : std::numeric_limits<double>::infinity();
    };
    if (away(below[1]) < away(below[0]))
      std::swap(below[0], below[1]);
    for (const unsigned int child : below)
      if (away(child) <= reach)
        reach = nearest(x, reach, level - 1, child, look_at);
    return reach;
  }
} // namespace Touchstone
