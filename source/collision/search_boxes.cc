// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/non_convergence.h>
#include <touchstone/collision/search_boxes.h>

#include <sstream>

namespace Touchstone
{
  namespace
  {
    // Lengths beyond would overflow in products and differences, and are none in any unit.
    constexpr double largest_coordinate = 1e150;

    [[noreturn]] void
    refuse(const FlatBox &box, const unsigned int index, const std::string &name)
    {
      std::ostringstream message;
      message << "Box " << index << " of " << name << " of a contact search reaches from ("
              << box.lower[0] << ", " << box.lower[1] << ", " << box.lower[2] << ") to ("
              << box.upper[0] << ", " << box.upper[1] << ", " << box.upper[2]
              << "): it must be finite, and not inverted.";
      throw ExplicitFailure(message.str());
    }
  } // namespace


  void
  SearchBoxes::clear()
  {
    boxes.clear();
    n_first = 0;
    one_set = true;
  }


  void
  SearchBoxes::append(const std::vector<dealii::BoundingBox<dim>> &set, const std::string &name)
  {
    boxes.reserve(boxes.size() + set.size());
    for (unsigned int k = 0; k < set.size(); ++k)
      {
        const auto &[lower, upper] = set[k].get_boundary_points();
        FlatBox box;
        // Comparisons with NaN are false.
        bool good = true;
        for (unsigned int d = 0; d < dim; ++d)
          {
            box.lower[d] = lower[d];
            box.upper[d] = upper[d];
            good &= (-largest_coordinate < lower[d]) & (lower[d] <= upper[d]) &
                    (upper[d] < largest_coordinate);
          }
        if (!good)
          refuse(box, k, name);
        if (boxes.empty())
          whole = box;
        else
          whole.merge(box);
        boxes.push_back(box);
      }
  }


  double
  SearchBoxes::median_size() const
  {
    if (boxes.empty())
      return 0.;
    // Of a sample: the median chooses cells, on which no result depends.
    const std::size_t   step = std::max<std::size_t>(1, boxes.size() / 4096);
    std::vector<double> sizes;
    for (std::size_t k = 0; k < boxes.size(); k += step)
      sizes.push_back(boxes[k].size());
    const auto middle = sizes.begin() + sizes.size() / 2;
    std::nth_element(sizes.begin(), middle, sizes.end());
    return *middle;
  }
} // namespace Touchstone
