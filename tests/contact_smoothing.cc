// SPDX-License-Identifier: LGPL-2.1-or-later
// A point slides over a faceted cylinder and a faceted sphere: jumps of normal and
// gap between steps, and how far the gap is from that to the exact surface.

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  struct Ride
  {
    double normal_jump = 0., gap_jump = 0., weight_jump = 0., gap_error = 0.;
  };

  /** @param path Point of the exact unit surface at s in [0,1]. */
  Ride
  ride(const PairOfScene                               &pair,
       const MasterNormal                               kind,
       const std::function<Tensor<1, dim>(double)>     &path,
       const std::function<double(const Point<dim> &)> &distance,
       const unsigned int                               n_steps,
       const double                                     height)
  {
    std::vector<Point<dim>> points;
    for (unsigned int i = 0; i <= n_steps; ++i)
      {
        const Tensor<1, dim> on = path(double(i) / n_steps);
        Tensor<1, dim>       up = on;
        if (pair.scene.bodies[0].geometry_type.name == "tube")
          up[0] = 0.;
        points.emplace_back(on + height * up);
      }
    Search search(*pair.master, 0.5, 0.01, kind, MPI_COMM_WORLD);
    search.update(points);
    Ride                    result;
    Tensor<1, dim>          normal;
    double                  gap = 0.;
    std::map<Index, double> weights;
    for (unsigned int i = 0; i <= n_steps; ++i)
      {
        const auto partner =
          search.find({points[i], points[i], -1. * path(double(i) / n_steps), false, {}});
        if (!partner)
          {
            std::cout << "no partner FAILED\n";
            continue;
          }
        const double            g = (points[i] - partner->x) * partner->normal;
        std::map<Index, double> w;
        const FaceShapes        shapes(1, partner->xi);
        for (unsigned int m = 0; m < 4; ++m)
          w[partner->face->nodes[m]] = shapes.value[m];
        if (i > 0)
          {
            result.normal_jump = std::max(result.normal_jump, (partner->normal - normal).norm());
            result.gap_jump    = std::max(result.gap_jump, std::abs(g - gap));
            for (const auto &[node, weight] : w)
              weights[node] -= weight;
            for (const auto &[node, weight] : weights)
              result.weight_jump = std::max(result.weight_jump, std::abs(weight));
          }
        result.gap_error = std::max(result.gap_error, std::abs(g - distance(points[i])));
        normal           = partner->normal;
        gap              = g;
        weights          = w;
      }
    return result;
  }



  void
  check(const std::string                               &name,
        const std::function<std::string(unsigned int)>  &geometry,
        const std::string                               &boundary,
        const std::function<Tensor<1, dim>(double)>     &path,
        const std::function<double(const Point<dim> &)> &distance,
        const double                                     height)
  {
    const bool first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    if (first)
      std::cout << name << '\n';
    std::map<MasterNormal, double> coarse;
    for (const unsigned int cells : {1, 2, 4})
      {
        const PairOfScene pair(
          master_only(geometry(cells), boundary, "set Contact geometry = faceted"));
        Touchstone::Vector zero(pair.solid.owned, pair.solid.relevant, MPI_COMM_WORLD);
        pair.move_surfaces(zero);
        for (const std::string kind : {"face", "averaged", "smoothed"})
          {
            const unsigned int    n_steps = 1000;
            Keyword<MasterNormal> k       = ContactPairParameters().master_normal;
            k                             = kind;
            const Ride r                  = ride(pair, k, path, distance, n_steps, height);
            // A jump is what does not become smaller with the steps.
            const Ride fine = ride(pair, k, path, distance, 10 * n_steps, height);
            const auto jump = [](const double a, const double b) {
              return a < 1e-12 || b < 0.2 * a ? "no" : "a";
            };
            std::ostringstream out;
            out << "  " << cells << ", " << kind << ": " << jump(r.normal_jump, fine.normal_jump)
                << " jump of the normal, " << jump(r.gap_jump, fine.gap_jump) << " of the gap, "
                << jump(r.weight_jump, fine.weight_jump) << " of weights";
            if (cells > 1)
              {
                const double order = std::log2(coarse[k] / r.gap_error);
                out << "; order of the gap "
                    << (order > 3.5   ? "4"
                        : order > 2.3 ? "> 2.3"
                        : order > 1.8 ? "2"
                                      : "< 1.8 FAILED");
              }
            else
              out << "; gap off by " << (r.gap_error < 1e-3 ? "< 1e-3" : "> 1e-3");
            if (first)
              std::cout << out.str() << std::endl;
            coarse[k] = r.gap_error;
          }
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const double height : {0.02, -0.02})
    {
      check(
        std::string("cylinder, ") + (height > 0. ? "above" : "below"),
        [](const unsigned int n) {
          return "set Type = tube\nset Axis = x\nset Start = 0\nset End = 1\nset Inner radius = 0.5\n"
                 "set Outer radius = 1\nset Cells = 1, " +
                 std::to_string(6 * n) + ", " + std::to_string(3 * n);
        },
        "outer",
        [](const double s) {
          const double angle = 0.35 + 0.8 * s;
          return Tensor<1, dim>({0.11 + 0.7 * s, std::cos(angle), std::sin(angle)});
        },
        [](const Point<dim> &x) { return std::hypot(x[1], x[2]) - 1.; },
        height);
      check(
        std::string("sphere, ") + (height > 0. ? "above" : "below"),
        [](const unsigned int n) {
          return "set Type = ball\nset Radius = 1\nset Cells = " + std::to_string(3 * n) + ", " +
                 std::to_string(2 * n);
        },
        "surface",
        [](const double s) {
          const double a = 0.3 + 0.9 * s, b = 0.7 - 0.2 * s;
          return Tensor<1, dim>(
            {std::cos(a) * std::cos(b), std::sin(a) * std::cos(b), std::sin(b)});
        },
        [](const Point<dim> &x) { return x.norm() - 1.; },
        height);
    }
  return 0;
}
