// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/verification/reference_solution.h>

#include <cmath>
#include <cstdio>

namespace Touchstone
{
  namespace
  {
    /** The reference solution of a scene without one. */
    class NoReference : public ReferenceSolution
    {
    public:
      explicit NoReference(const Scene &scene)
      {
        ReferenceValues(scene.reference.values).finish();
      }

      ReferenceComparison
      compare(const ReferenceInput &) const override
      {
        return {};
      }
    };

    const ReferenceRegistry::Entry<NoReference> reference_solution_entry("none", "No comparison.");



    /** Text of a relative error; NaN stands for no comparison. */
    std::string
    describe(const double error)
    {
      if (!std::isfinite(error))
        return "nothing to compare";
      char text[32];
      std::snprintf(text, sizeof(text), "error %.2e", error);
      return text;
    }
  } // namespace



  void
  ReferenceComparison::add(const std::string &name,
                           const std::string &what,
                           const double       computed,
                           const double       exact)
  {
    // An error relative to an exact value of zero is not defined: NaN, which prints as "nothing to
    // compare".
    const double error = exact != 0. ? std::abs(computed - exact) / std::abs(exact) : std::nan("");
    errors[name]       = error;

    char numbers[64];
    std::snprintf(numbers, sizeof(numbers), ": computed %.6g, exact %.6g, ", computed, exact);
    lines.push_back(what + numbers + describe(error));
  }



  void
  ReferenceComparison::add(const std::string &name, const std::string &what, const double error)
  {
    errors[name] = error;
    lines.push_back(what + ": " + describe(error));
  }



  std::map<std::string, double>
  ReferenceSolution::errors(const ReferenceInput &input) const
  {
    return compare(input).errors;
  }



  unsigned int
  reference_pair(const Scene &scene)
  {
    if (scene.reference.pair.empty())
      return 0;
    for (unsigned int i = 0; i < scene.pairs.size(); ++i)
      if (scene.pairs[i].name == scene.reference.pair)
        return i;
    throw InputError("Reference solution",
                     "Pair",
                     scene.reference.pair,
                     "There is no contact pair of this name.",
                     "Take a name from the list \"Contact pairs\".");
  }



  std::vector<ContactPoint>
  points_of_pair(const std::vector<ContactPoint> &points, const unsigned int pair)
  {
    std::vector<ContactPoint> result;
    for (const ContactPoint &point : points)
      // Nodes without a tributary area (beside the master surface) carry no pressure.
      if (point.pair == pair && point.area > 0.)
        result.push_back(point);
    return result;
  }
} // namespace Touchstone
