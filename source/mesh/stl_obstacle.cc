// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/input_error.h>
#include <touchstone/mesh/facet_walls.h>
#include <touchstone/mesh/obstacle_shape.h>

#include <boost/crc.hpp>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

// A rigid tool from an STL file: reading, and what a file must be to have an inside and an outside.
// Its geometry is in facet_surface.cc.
namespace Touchstone
{
  using dealii::ParameterHandler;
  using dealii::Point;
  namespace Patterns = dealii::Patterns;

  namespace
  {
    class StlObstacle : public ObstacleShape
    {
    public:
      void
      declare(ParameterHandler &prm) override
      {
        prm.add_parameter("File",
                          file,
                          "STL file, ASCII or binary, relative to the folder of the scene file: a "
                          "closed surface whose facets look outwards.",
                          Patterns::Anything());
        prm.add_parameter("Scale",
                          scale,
                          "Factor of all its lengths, for files in other units. [no unit]",
                          Patterns::Double());
        prm.add_parameter("Side",
                          side,
                          "The bodies are 'outside' or 'inside' of the surface.",
                          Patterns::Selection("outside|inside"));
        prm.add_parameter("Walls",
                          walls_are,
                          "'whole': a node touches one place of the surface, the closest one. "
                          "'separate': for dies with corners, where a node touches several walls. "
                          "Walls that meet in sharp edges which look inwards are contact pairs of "
                          "their own, with ' wall 1', ' wall 2', ... behind the name of the pair.",
                          Patterns::Selection("whole|separate"));
      }

      void
      check(const std::string &section) const override
      {
        where = section;
        if (file.empty())
          throw InputError(section, "File", file, "there is no file name", "name an STL file");
        if (!(scale > 0.))
          throw InputError(section,
                           "Scale",
                           Patterns::Tools::to_string(scale),
                           "must be positive",
                           "give 1 for a file in the units of the scene");
      }

      void
      set_folder(const std::string &of_scene) override
      {
        folder = of_scene;
      }

      std::string
      fingerprint() const override
      {
        const std::string  text = content();
        boost::crc_32_type checksum;
        checksum.process_bytes(text.data(), text.size());
        return std::to_string(text.size()) + " bytes, checksum " +
               std::to_string(checksum.checksum());
      }

      std::shared_ptr<const AnalyticSurface>
      surface() const override
      {
        return facet_surface();
      }

      std::vector<std::shared_ptr<const AnalyticSurface>>
      walls() const override
      {
        return walls_are == "separate" ? make_walls(facet_surface())
                                       : std::vector<std::shared_ptr<const AnalyticSurface>>();
      }

      bool
      has_inner_edges() const override
      {
        return walls_are == "whole" && FacetWalls(*facet_surface()).n_walls() > 1;
      }

    private:
      std::string file, side = "outside", walls_are = "whole", folder;
      double      scale = 1.;
      /** For messages; known since check(). */
      mutable std::string where;

      std::shared_ptr<const FacetSurface>
      facet_surface() const
      {
        const std::string         text = content();
        std::vector<FacetCorners> facets;
        std::uint32_t             n = 0;
        if (text.size() >= 84)
          std::memcpy(&n, text.data() + 80, 4);
        // Binary files may begin with "solid" as well: their length tells.
        if (text.size() >= 84 && text.size() == 84 + 50 * std::size_t(n))
          read_binary(text, facets);
        else
          read_ascii(text, facets);
        for (FacetCorners &facet : facets)
          for (Point<3> &x : facet)
            x *= scale;
        try
          {
            return std::make_shared<const FacetSurface>(facets, side == "outside");
          }
        catch (const std::runtime_error &error)
          {
            refuse(error.what(), "repair the surface in a program for meshes, and write it again");
          }
      }

      [[noreturn]] void
      refuse(const std::string &problem, const std::string &remedy) const
      {
        throw InputError(where, "File", file, problem, remedy);
      }

      std::string
      content() const
      {
        std::ifstream      in(std::filesystem::path(folder) / file, std::ios::binary);
        std::ostringstream text;
        if (!in || !(text << in.rdbuf()))
          refuse("this file cannot be read or is empty",
                 "check its name, which is relative to the folder of the scene");
        return text.str();
      }

      static void
      read_binary(const std::string &text, std::vector<FacetCorners> &facets)
      {
        for (std::size_t at = 84; at < text.size(); at += 50)
          {
            float numbers[12];
            std::memcpy(numbers, text.data() + at, sizeof(numbers));
            FacetCorners facet;
            // The first three are a normal, which the corners know better.
            for (unsigned int v = 0; v < 3; ++v)
              facet[v] = Point<3>(numbers[3 + 3 * v], numbers[4 + 3 * v], numbers[5 + 3 * v]);
            facets.push_back(facet);
          }
      }

      void
      read_ascii(const std::string &text, std::vector<FacetCorners> &facets) const
      {
        std::istringstream    in(text);
        std::vector<Point<3>> corners;
        for (std::string word; in >> word;)
          if (word == "vertex")
            {
              Point<3> x;
              if (!(in >> x[0] >> x[1] >> x[2]))
                refuse("a vertex of facet " + std::to_string(facets.size() + 1) +
                         " has no three numbers",
                       "give an STL file");
              corners.push_back(x);
            }
          else if (word == "endfacet")
            {
              if (corners.size() != 3)
                refuse("facet " + std::to_string(facets.size() + 1) + " has " +
                         std::to_string(corners.size()) + " vertices",
                       "give an STL file of triangles");
              facets.push_back({{corners[0], corners[1], corners[2]}});
              corners.clear();
            }
        if (facets.empty() || !corners.empty())
          refuse("this is no STL file, or it is cut short", "give an STL file");
      }
    };

    const ObstacleShapeRegistry::Entry<StlObstacle>
      stl_obstacle("stl", "The closed surface of an STL file, with its facets as they are.");
  } // namespace
} // namespace Touchstone
