// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/input_error.h>
#include <touchstone/explicit/general/general_contact.h>

#include <algorithm>
#include <cstdio>

// Surfaces that cross each other as the bodies are placed, and a failure to keep them apart
// (doc/general_contact.md, section 6).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Where an edge passes through a face. */
    struct Place
    {
      std::uint64_t key;
      unsigned int  body, other;
      Point<dim>    position;
    };

    std::string
    text_of(const Place &place, const std::vector<std::string> &bodies)
    {
      char position[100];
      std::snprintf(position,
                    sizeof(position),
                    " near (%.5g, %.5g, %.5g)",
                    place.position[0],
                    place.position[1],
                    place.position[2]);
      return (place.body == place.other
                ? "'" + bodies[place.body] + "' itself"
                : "'" + bodies[place.body] + "' and '" + bodies[place.other] + "'") +
             position;
    }
  } // namespace



  void
  GeneralContact::check_start(const NodeField &u, const std::vector<std::string> &bodies)
  {
    if (surface.n_faces() == 0)
      throw InputError(parameters.section(),
                       "Slave boundaries",
                       parameters.boundaries.front(),
                       "no face takes part in the general contact",
                       "name boundaries of the bodies, or write 'all'");
    const std::string text = crossings_at(u, inset, bodies);
    if (!text.empty())
      throw InputError(
        parameters.section(),
        "",
        "",
        "surfaces cross each other at the start, " + text,
        parameters.initial_overlap == GeneralContactParameters::Overlap::adjust
          ? "'Initial overlap = adjust' moves what overlaps by less than a quarter of "
            "a face: move the bodies apart"
          : "move the bodies apart, take a finer mesh where round surfaces touch, or "
            "set 'Initial overlap' to 'adjust'");
  }



  std::string
  GeneralContact::crossings_at(const NodeField                &u,
                               const double                    inwards,
                               const std::vector<std::string> &bodies)
  {
    look_at(u, inwards, least_margin * smallest);
    std::vector<Place>                    places;
    std::pair<unsigned int, unsigned int> last(numbers::invalid_unsigned_int, 0);
    for_each_crossing([&](const unsigned int of, const unsigned int a, const unsigned int face) {
      // One place for two faces.
      if (last == std::make_pair(of, face))
        return;
      last = {of, face};
      places.push_back(
        {candidates.faces[of].key,
         candidates.faces[of].body,
         candidates.faces[face].body,
         Point<dim>(0.5 * (moving.inner_position(moving.corner(of, a), false) +
                           moving.inner_position(moving.corner(of, a + 1), false)))});
    });
    const auto by_key = [](const Place &a, const Place &b) { return a.key < b.key; };
    std::sort(places.begin(), places.end(), by_key);
    const std::uint64_t n = Utilities::MPI::sum<std::uint64_t>(places.size(), nodes.communicator());
    if (n == 0)
      return "";
    constexpr std::size_t shown = 3;
    places.resize(std::min(shown, places.size()));
    std::vector<Place> all = gather_all(places, nodes.communicator());
    std::sort(all.begin(), all.end(), by_key);
    all.resize(std::min(shown, all.size()));
    std::string text;
    for (const Place &place : all)
      text += (text.empty() ? "" : ", ") + text_of(place, bodies);
    return "at " + std::to_string(n) + " faces: " + text;
  }



  std::string
  GeneralContact::failure(const double time) const
  {
    char text[200];
    std::snprintf(text,
                  sizeof(text),
                  "surfaces could not be kept from crossing each other at time %.6g",
                  time);
    std::string result = text;
    // The row of the lowest key that took part last.
    Place place{std::numeric_limits<std::uint64_t>::max(), 0, 0, {}};
    for (const Row &row : rows)
      if (row.used && row.key.slave < place.key)
        place = {row.key.slave, 0, 0, Point<dim>(moving.at(row.sides[0].slots[0]).x)};
    for (const std::vector<Place> &of_rank :
         gather_records(std::vector<Place>{place}, nodes.communicator()))
      if (of_rank.front().key < place.key)
        place = of_rank.front();
    if (place.key != std::numeric_limits<std::uint64_t>::max())
      {
        std::snprintf(text,
                      sizeof(text),
                      " near (%.5g, %.5g, %.5g)",
                      place.position[0],
                      place.position[1],
                      place.position[2]);
        result += text;
      }
    return result + "; bodies may be pressed together by supports, or move too fast for the cycle: "
                    "take a finer mesh there, or a smaller 'Courant factor'";
  }
} // namespace Touchstone
