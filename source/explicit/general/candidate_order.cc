// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/general/contact_candidates.h>

#include <algorithm>
#include <numeric>

// The order of the pairs that general contact looks at: each is kept once, sorted by keys and by
// the pairs of faces that they belong to, and found there (doc/general_contact.md, section 2).
namespace Touchstone
{
  using namespace dealii;

  // Keys are sorted, not the faces that have them.
  void
  ContactCandidates::keep_each_once(const std::vector<MovingFace> &all)
  {
    const auto unify = [](auto &pairs, const auto &key) {
      std::vector<std::pair<decltype(key(pairs[0])), std::size_t>> keyed;
      for (const auto &pair : pairs)
        keyed.emplace_back(key(pair), keyed.size());
      std::sort(keyed.begin(), keyed.end());
      std::decay_t<decltype(pairs)> unique;
      for (std::size_t k = 0; k < keyed.size(); ++k)
        if (k == 0 || keyed[k].first != keyed[k - 1].first)
          unique.push_back(pairs[keyed[k].second]);
      pairs.swap(unique);
    };
    unify(node_faces, [&](const NodeFace &p) {
      return std::make_pair(slot_key(all, p.node), all[p.face].face.key);
    });
    unify(edge_pairs, [&](const EdgePair &p) {
      return std::make_pair(edge_key(all, p.one), edge_key(all, p.other));
    });
    unify(inner_edges, [&](const InnerEdge &p) {
      return std::make_pair(edge_key(all, p.edge), all[p.face].face.key);
    });
  }



  std::size_t
  ContactCandidates::find_node(const std::uint64_t of) const
  {
    const auto found = std::lower_bound(node_faces.begin(),
                                        node_faces.end(),
                                        of,
                                        [&](const NodeFace &pair, const std::uint64_t wanted) {
                                          return key(pair.node) < wanted;
                                        });
    return found != node_faces.end() && key(found->node) == of ? found - node_faces.begin()
                                                               : node_faces.size();
  }



  std::size_t
  ContactCandidates::find_edges(const std::array<std::uint64_t, 4> &keys) const
  {
    const auto keys_of = [&](const EdgePair &pair) {
      const auto a = std::minmax({key(pair.one), key(next(pair.one))}),
                 b = std::minmax({key(pair.other), key(next(pair.other))});
      return std::array<std::uint64_t, 4>{{a.first, a.second, b.first, b.second}};
    };
    const auto found = std::lower_bound(edge_pairs.begin(),
                                        edge_pairs.end(),
                                        keys,
                                        [&](const EdgePair &pair, const auto &wanted) {
                                          return keys_of(pair) < wanted;
                                        });
    return found != edge_pairs.end() && keys_of(*found) == keys ? found - edge_pairs.begin()
                                                                : edge_pairs.size();
  }



  void
  ContactCandidates::keep_used_faces(const std::vector<MovingFace> &all)
  {
    constexpr unsigned int    unused = numbers::invalid_unsigned_int;
    std::vector<unsigned int> number(all.size(), unused);
    const auto                use = [&](const std::size_t face) { number[face] = 0; };
    for (const NodeFace &pair : node_faces)
      {
        use(pair.node / 4);
        use(pair.face);
      }
    for (const EdgePair &pair : edge_pairs)
      {
        use(pair.one / 4);
        use(pair.other / 4);
      }
    for (const FacePair &pair : face_pairs)
      {
        use(pair.one);
        use(pair.other);
      }
    faces.clear();
    std::vector<std::pair<Index, RowKey>> slots;
    for (std::size_t f = 0; f < all.size(); ++f)
      if (number[f] != unused)
        {
          number[f] = faces.size();
          faces.push_back(all[f].face);
          for (const Index dof : all[f].face.dofs)
            slots.push_back({dof, {0, all[f].face.key}});
        }
    const auto renumber = [&](std::size_t &slot) { slot = 4 * number[slot / 4] + slot % 4; };
    for (NodeFace &pair : node_faces)
      {
        renumber(pair.node);
        pair.face = number[pair.face];
      }
    for (EdgePair &pair : edge_pairs)
      {
        renumber(pair.one);
        renumber(pair.other);
      }
    for (FacePair &pair : face_pairs)
      {
        pair.one   = number[pair.one];
        pair.other = number[pair.other];
      }
    at_slots.reinit(owned, slots);
  }



  void
  ContactCandidates::sort_by_faces()
  {
    const auto sort = [&](const auto &pairs, ByFaces &by_faces) {
      by_faces.begin.assign(face_pairs.size() + 1, 0);
      for (const auto &pair : pairs)
        ++by_faces.begin[pair.of_faces + 1];
      std::partial_sum(by_faces.begin.begin(), by_faces.begin.end(), by_faces.begin.begin());
      std::vector<unsigned int> next(by_faces.begin);
      by_faces.numbers.resize(pairs.size());
      for (unsigned int i = 0; i < pairs.size(); ++i)
        by_faces.numbers[next[pairs[i].of_faces]++] = i;
    };
    sort(node_faces, nodes_by_faces);
    sort(edge_pairs, edges_by_faces);
  }
} // namespace Touchstone
