// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/preview.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

// The drawing of a preview: parallel projections from two opposite sides, faces from back to front,
// and a list of the boundaries by colour. It needs no program but one that shows SVG.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr double panel = 460., margin = 20., line_height = 20.;

    /** Hues that differ from those before, whatever their number. */
    std::string
    colour(const unsigned int number, const double light)
    {
      char text[50];
      std::snprintf(text,
                    sizeof(text),
                    "hsl(%.0f,%d%%,%.0f%%)",
                    std::fmod(137.508 * number + 210., 360.),
                    number % 2 == 0 ? 65 : 45,
                    100. * light);
      return text;
    }



    std::string
    escaped(const std::string &text)
    {
      std::string result;
      for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
      return result;
    }



    std::string
    label(const double x, const double y, const std::string &text, const int size = 14)
    {
      char place[100];
      std::snprintf(
        place, sizeof(place), "<text x=\"%.1f\" y=\"%.1f\" font-size=\"%d\">", x, y, size);
      return place + escaped(text) + "</text>\n";
    }



    /** A face as it is drawn. */
    struct Drawn
    {
      double       depth;
      unsigned int part;
      /** Of the light. */
      double                               brightness;
      std::array<std::array<double, 2>, 4> corners;
    };



    /** The faces that look to the viewer, from back to front, within the panel at @p left. */
    std::vector<Drawn>
    project(const std::vector<PreviewPart> &parts, const Tensor<1, 3> &towards, const double left)
    {
      const Tensor<1, 3> up({0., 0., 1.});
      const Tensor<1, 3> e     = towards / towards.norm();
      Tensor<1, 3>       right = cross_product_3d(up, e);
      right /= right.norm();
      const Tensor<1, 3> above = cross_product_3d(e, right);

      double low[2]  = {std::numeric_limits<double>::max(), std::numeric_limits<double>::max()},
             high[2] = {-low[0], -low[0]};
      for (const PreviewPart &part : parts)
        for (const Point<3> &x : part.points)
          for (unsigned int d = 0; d < 2; ++d)
            {
              const double at = x * (d == 0 ? right : above);
              low[d]          = std::min(low[d], at);
              high[d]         = std::max(high[d], at);
            }
      const double scale =
        (panel - 2. * margin) / std::max({high[0] - low[0], high[1] - low[1], 1e-300});

      std::vector<Drawn> result;
      for (unsigned int p = 0; p < parts.size(); ++p)
        for (const auto &quad : parts[p].quads)
          {
            const auto        &x = parts[p].points;
            const Tensor<1, 3> normal =
              cross_product_3d(x[quad[2]] - x[quad[0]], x[quad[3]] - x[quad[1]]);
            // Obstacles are seen from both sides.
            const double facing = normal.norm() > 0. ? normal * e / normal.norm() : 0.;
            if (facing <= 0. && !parts[p].body.empty())
              continue;
            Drawn drawn;
            drawn.part       = p;
            drawn.brightness = 0.45 + 0.3 * std::abs(facing);
            drawn.depth      = 0.;
            for (unsigned int v = 0; v < 4; ++v)
              {
                drawn.depth += x[quad[v]] * e / 4.;
                drawn.corners[v] = {
                  {left + margin + scale * (x[quad[v]] * right - low[0]),
                   margin + line_height + scale * (high[1] - x[quad[v]] * above)}};
              }
            result.push_back(drawn);
          }
      std::stable_sort(result.begin(), result.end(), [](const Drawn &a, const Drawn &b) {
        return a.depth < b.depth;
      });
      return result;
    }
  } // namespace



  std::string
  draw_preview(const std::string &title, const std::vector<PreviewPart> &parts)
  {
    // Slave faces have red edges, master faces blue ones.
    const auto edge = [](const PreviewPart &part) {
      for (const std::string &role : part.roles)
        return role.compare(0, 5, "slave") == 0 ? "#c00000" : "#0000c0";
      return part.body.empty() ? "#808080" : "#404040";
    };
    const double height = std::max(panel + line_height, (parts.size() + 4) * line_height);
    char         text[200];
    std::snprintf(text,
                  sizeof(text),
                  "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
                  "font-family=\"sans-serif\">\n",
                  2. * panel + 480.,
                  height);
    std::string result = text;
    result += "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    result += label(margin, line_height, title, 16);
    const Tensor<1, 3> sides[2] = {Tensor<1, 3>({0.7, -1.2, 0.7}), Tensor<1, 3>({-0.7, 1.2, -0.7})};
    for (unsigned int side = 0; side < 2; ++side)
      {
        for (const Drawn &drawn : project(parts, sides[side], side * panel))
          {
            const PreviewPart &part = parts[drawn.part];
            result += "<path d=\"";
            for (unsigned int v = 0; v < 4; ++v)
              {
                std::snprintf(text,
                              sizeof(text),
                              "%c%.1f %.1f",
                              v == 0 ? 'M' : 'L',
                              drawn.corners[v][0],
                              drawn.corners[v][1]);
                result += text;
              }
            result += "Z\" fill=\"";
            result += part.body.empty() ? "#d0d0d0" : colour(drawn.part, drawn.brightness);
            result += "\" fill-opacity=\"";
            result += part.body.empty() ? "0.35" : "1";
            result += "\" stroke=\"" + std::string(edge(part)) + "\" stroke-width=\"0.5\"/>\n";
          }
        result += label(side * panel + margin,
                        panel + line_height - 4.,
                        side == 0 ? "from the right, front and above (x, -y, z)"
                                  : "from the left, back and below (-x, y, -z)",
                        12);
      }
    double y = 2. * line_height;
    for (unsigned int p = 0; p < parts.size(); ++p, y += line_height)
      {
        std::string name = parts[p].title();
        for (const std::string &role : parts[p].roles)
          name += ", " + role;
        std::snprintf(text,
                      sizeof(text),
                      "<rect x=\"%.0f\" y=\"%.0f\" width=\"14\" height=\"14\" fill=\"%s\" "
                      "stroke=\"%s\"/>\n",
                      2. * panel + margin,
                      y - 12.,
                      parts[p].body.empty() ? "#d0d0d0" : colour(p, 0.6).c_str(),
                      edge(parts[p]));
        result += text;
        result += label(2. * panel + margin + 20., y, name);
      }
    result += label(2. * panel + margin,
                    y + line_height / 2.,
                    "red edges: slave, blue edges: master of a contact pair",
                    12);
    return result + "</svg>\n";
  }
} // namespace Touchstone
