// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/suggestion.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace Touchstone
{
  namespace
  {
    /** Upper and lower case are no reason for a distance. */
    std::string
    lower_case(std::string word)
    {
      std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) {
        return std::tolower(c);
      });
      return word;
    }

    /**
     * Levenshtein's edit distance (insertions, deletions, replacements), by dynamic programming
     * that keeps one row of the table.
     */
    std::size_t
    edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t replace = diagonal + (a[i] == b[j] ? 0 : 1);
              diagonal                  = row[j + 1];
              row[j + 1]                = std::min({replace, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace



  std::string
  closest(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::string best;
    // The limit of a third of the letters (at least two) keeps suggestions that would confuse more
    // than help out of messages; the distance must also be less than replacing all letters.
    std::size_t limit = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string &candidate : candidates)
      {
        const std::size_t distance = edit_distance(lower_case(word), lower_case(candidate));
        if (distance < limit && distance < std::max(word.size(), candidate.size()))
          {
            limit = distance;
            best  = candidate;
          }
      }
    return best;
  }



  std::string
  did_you_mean(const std::string &word, const std::vector<std::string> &candidates)
  {
    const std::string best = closest(word, candidates);
    return best.empty() ? "" : ", did you mean '" + best + "'?";
  }



  std::string
  quoted_list(const std::vector<std::string> &names)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "'" : ", '") + name + "'";
    return text;
  }
} // namespace Touchstone
