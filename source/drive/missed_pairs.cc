// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/contact/missed_contact.h>
#include <touchstone/drive/missed_pairs.h>

#include <cstdio>

// Contact that rows have missed is told of in the step in which it happens, and judged at the end
// of the run: until then the rows may still come to carry it.
namespace Touchstone
{
  MissedPairs::Missed
  MissedPairs::shallow(const Missed &missed)
  {
    for (const auto &[pair, found] : missed)
      if (found.deep)
        throw UnresolvedContactFailure(found.text);
    return missed;
  }



  void
  MissedPairs::end_step(const Missed &missed, Warnings &warnings)
  {
    last = missed;
    for (const auto &[pair, found] : missed)
      if (first.emplace(pair, found).second)
        warnings.add(found.text);
  }



  std::string
  MissedPairs::failure(const std::map<std::string, double> &had_contact, const bool dynamic) const
  {
    for (const auto &[pair, found] : last)
      // Bodies that bounce carry nothing now and much a moment before: the end is no result by
      // itself.
      if (found.share > MissedContact::most_share && !(dynamic && had_contact.count(pair) > 0))
        {
          char percent[20];
          std::snprintf(percent, sizeof(percent), "%.0f", 100. * found.share);
          return found.text + (found.share == 1.
                                 ? ". The pair carries nothing at the end of the run"
                                 : std::string(". At the end of the run these are ") + percent +
                                     " % of the faces that should carry the pair");
        }
    for (const auto &[pair, found] : first)
      if (had_contact.count(pair) == 0)
        return found.text + ". The pair has carried nothing in the whole run";
    return "";
  }
} // namespace Touchstone
