// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/drive/missed_pairs.h>

// Contact that rows have missed is told of in the step in which it happens, and judged at the end
// of the run: until then the rows may still come to carry it.
namespace Touchstone
{
  MissedPairs::Texts
  MissedPairs::shallow(const std::map<std::string, MissedByRows> &missed)
  {
    Texts result;
    for (const auto &[pair, found] : missed)
      {
        if (found.deep)
          throw UnresolvedContactFailure(found.text);
        result[pair] = found.text;
      }
    return result;
  }



  void
  MissedPairs::end_step(const Texts &missed, Warnings &warnings)
  {
    last = missed;
    for (const auto &[pair, text] : missed)
      if (first.emplace(pair, text).second)
        warnings.add(text);
  }



  std::string
  MissedPairs::failure(const std::map<std::string, PairResult> &results,
                       const std::map<std::string, double>     &had_contact) const
  {
    for (const auto &[pair, text] : first)
      {
        const auto now   = last.find(pair);
        const auto found = results.find(pair);
        if (now != last.end() && (found == results.end() || found->second.active == 0))
          return now->second + ". The pair carries nothing at the end of the run";
        if (had_contact.count(pair) == 0)
          return text + ". The pair has carried nothing in the whole run";
      }
    return "";
  }
} // namespace Touchstone
