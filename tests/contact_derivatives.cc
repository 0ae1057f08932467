// SPDX-License-Identifier: LGPL-2.1-or-later
// Derivatives of contact rows against central differences in scattered directions,
// in which every node moves on its own: a node that is forgotten is noticed.

#include "contact_support.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  const std::string blocks = two_bodies("lower",
                                        "set Cells = 4, 3, 2",
                                        "upper",
                                        "set Lower corner = 0.07, 0.03, 1\n"
                                        "set Upper corner = 0.93, 0.95, 2\n"
                                        "set Cells        = 5, 4, 2",
                                        slave_and_master("upper", "bottom", "lower", "top"));

  const std::string tubes = two_bodies("outer",
                                       "set Type         = tube\n"
                                       "set Axis         = x\n"
                                       "set Start        = 0.1\n"
                                       "set End          = 0.9\n"
                                       "set Inner radius = 1\n"
                                       "set Outer radius = 1.5\n"
                                       "set Cells        = 1, 5, 4",
                                       "inner",
                                       "set Type         = tube\n"
                                       "set Axis         = x\n"
                                       "set Start        = 0\n"
                                       "set End          = 1\n"
                                       "set Inner radius = 0.5\n"
                                       "set Outer radius = 1\n"
                                       "set Outer slope  = 0.01\n"
                                       "set Cells        = 1, 6, 3",
                                       slave_and_master("outer", "inner", "inner", "outer"));

  // A plate over half a ball, whose flanks are too steep to face it.
  const std::string ball = two_bodies("lower",
                                      "set Type   = ball\n"
                                      "set Centre = 0.5, 0.45, 0\n"
                                      "set Radius = 1\n"
                                      "set Keep   = both, both, +\n"
                                      "set Cells  = 2, 3",
                                      "upper",
                                      "set Lower corner = -0.9, -0.7, 1\n"
                                      "set Upper corner = 1.7, 1.8, 2\n"
                                      "set Cells        = 3, 4, 1",
                                      slave_and_master("upper", "bottom", "lower", "surface"));

  // Two blocks that meet in one edge.
  const std::string edges =
    two_bodies("lower",
               "set Cells = 3, 4, 2",
               "upper",
               "set Lower corner = 1, 0.03, 1\n"
               "set Upper corner = 2, 0.95, 2\n"
               "set Cells        = 2, 5, 3",
               slave_and_master("upper", "bottom, left", "lower", "top, right") +
                 "\nset Pairing = pointwise");

  // Two blocks whose sides are flush: half of the nodes on edges come to lie beyond them.
  const std::string flush = two_bodies("lower",
                                       "set Cells = 3, 4, 2",
                                       "upper",
                                       "set Lower corner = 0, 0, 1\n"
                                       "set Upper corner = 1, 1, 2\n"
                                       "set Cells        = 2, 5, 3",
                                       slave_and_master("upper",
                                                        "bottom, left, right, front, back",
                                                        "lower",
                                                        "top, left, right, front, back"));

  // A ring with a slit: its ends meet, with slaves on one side alone.
  const std::string slit =
    "set Bodies = ring\nset Contact pairs = pair\n" +
    body_section("ring",
                 "set Type         = tube\n"
                 "set Inner radius = 1\n"
                 "set Outer radius = 2\n"
                 "set Start        = 0\n"
                 "set End          = 1\n"
                 "set First angle  = 4\n"
                 "set Angle        = 352\n"
                 "set Cells        = 3, 8, 2") +
    "subsection Contact pair pair\n" +
    slave_and_master("ring", "first cut, second cut", "ring", "first cut, second cut") +
    "\nset Pairing = pointwise\nend\n";

  // Quarters of two coarse caps, as in checks/quarter_of_caps.prm.
  const std::string cap = "set Type           = cap\n"
                          "set Apex           = 0, 0, 0\n"
                          "set Part           = quarter\n"
                          "set Width          = 1.5\n"
                          "set Height         = 1.5\n"
                          "set Contact width  = 0.8\n"
                          "set Outer cells    = 1\n"
                          "set Contact layers = 1\n"
                          "set Outer layers   = 1\n";
  const std::string quarter =
    two_bodies("lower",
               cap + "set Radius = 4\nset Contact side = top\nset Contact cells = 3",
               "upper",
               cap + "set Radius = 3\nset Contact side = bottom\nset Contact cells = 2",
               slave_and_master("upper", "contact", "lower", "contact"));
  const std::vector<std::string> symmetric{"Body lower/Symmetry=x cut, y cut",
                                           "Body upper/Symmetry=x cut, y cut",
                                           "Contact pair pair/Contact geometry=faceted"};

  const std::string obstacle = R"(
set Bodies        = upper
set Obstacles     = rigid
set Contact pairs = pair
subsection Body upper
  subsection Material
    set Young modulus = 1
  end
  subsection Geometry
    set Cells = 3, 3, 2
  end
end
subsection Obstacle rigid
  set Point = 0.4, 0.45, -2
end
subsection Contact pair pair
  set Slave body       = upper
  set Slave boundaries = bottom
  set Obstacle         = rigid
end
)";

  double
  largest(const double x)
  {
    return Utilities::MPI::max(x, MPI_COMM_WORLD);
  }

  /** Largest errors and sizes of normals, gap vectors and weights of rows. */
  struct RowErrors
  {
    double       errors[3] = {}, sizes[3] = {};
    unsigned int count = 0, changed = 0;
  };



  /** The derivative of an active row in a direction, against the difference of the row
   * @p h before and behind it. */
  void
  compare(const ContactRow         &row,
          const ContactRow         &plus,
          const ContactRow         &minus,
          const double              h,
          const Touchstone::Vector &direction,
          RowErrors                &all)
  {
    const RowDerivative &d = *row.derivative;
    ++all.count;
    Tensor<1, dim>      normal, gap_vector;
    std::vector<double> weights(row.stencil.size());
    for (std::size_t a = 0; a < d.nodes.size(); ++a)
      {
        Tensor<1, dim> v;
        for (unsigned int c = 0; c < dim; ++c)
          v[c] = direction(dim * d.nodes[a] + c);
        normal += d.normal[a] * v;
        gap_vector += d.gap_vector[a] * v;
        for (std::size_t m = 0; m < weights.size(); ++m)
          weights[m] += d.weights[m][a] * v;
      }
    std::map<Index, double> difference;
    for (const StencilEntry &entry : plus.stencil)
      difference[entry.node] += entry.weight / (2. * h);
    for (const StencilEntry &entry : minus.stencil)
      difference[entry.node] -= entry.weight / (2. * h);
    for (std::size_t m = 0; m < weights.size(); ++m)
      {
        all.sizes[2] = std::max(all.sizes[2], std::abs(weights[m]));
        difference[row.stencil[m].node] -= weights[m];
      }
    for (const auto &[node, error] : difference)
      all.errors[2] = std::max(all.errors[2], std::abs(error));
    const auto add = [&](const unsigned int i, const Tensor<1, dim> &a, const Tensor<1, dim> &b) {
      all.errors[i] = std::max(all.errors[i], (a - b).norm());
      all.sizes[i]  = std::max(all.sizes[i], a.norm());
    };
    add(0, normal, (plus.normal - minus.normal) / (2. * h));
    add(1, gap_vector, (plus.gap_vector - minus.gap_vector) / (2. * h));
    all.changed += (plus.stencil.size() != minus.stencil.size());
  }



  /** How the contact points lie: the number of active rows with stencils of each size. */
  std::string
  stencil_sizes(const std::vector<ContactRow> &rows)
  {
    std::map<unsigned int, unsigned int> stencils;
    for (const ContactRow &row : rows)
      if (row.was_active)
        ++stencils[std::min<std::size_t>(row.stencil.size(), 19)];
    std::ostringstream text;
    for (unsigned int size = 0; size < 20; ++size)
      if (const unsigned int n = Utilities::MPI::sum(stencils[size], MPI_COMM_WORLD))
        text << ' ' << size << ": " << n << ',';
    return text.str();
  }



  void
  check(const std::string              &name,
        const std::string              &text,
        const std::vector<std::string> &overrides,
        const double                    gap,
        const double                    warp      = 0.02,
        const double                    tolerance = 1e-6)
  {
    PairOfScene pair(text, overrides);
    const auto  start = [&](const Point<dim> &x, const unsigned int body) {
      Tensor<1, dim> u = warp * scattered(x, 7);
      if (body == 1)
        u[2] += gap;
      return u;
    };
    const Touchstone::Vector u = pair.displacement(start);
    pair.update(u);
    pair.differentiate(u);
    const std::vector<ContactRow> rows = pair.rows;

    IndexSet needed = pair.solid.relevant;
    for (const ContactRow &row : rows)
      if (row.derivative)
        for (const Index node : row.derivative->nodes)
          needed.add_range(dim * node, dim * node + dim);
    needed.compress();

    RowErrors all;
    for (const unsigned int seed : {1, 2, 3})
      {
        const Touchstone::Vector direction =
          pair.displacement([&](const Point<dim> &x, unsigned int) { return scattered(x, seed); });
        Touchstone::Vector ghosted(pair.solid.owned, needed, pair.solid.communicator);
        ghosted              = direction;
        const double       h = 1e-7; // slivers of coverage bend much
        Touchstone::Vector plus(u), minus(u);
        plus.add(h, direction);
        minus.add(-h, direction);
        pair.update(plus);
        const std::vector<ContactRow> rows_plus = pair.rows;
        pair.update(minus);
        const std::vector<ContactRow> rows_minus = pair.rows;

        for (std::size_t k = 0; k < rows.size(); ++k)
          {
            if (!rows[k].was_active)
              {
                if (rows[k].derivative)
                  std::cout << "derivative of a row that is not active FAILED\n";
                continue;
              }
            compare(rows[k], rows_plus[k], rows_minus[k], h, ghosted, all);
          }
      }
    const std::string  stencils = stencil_sizes(rows);
    std::ostringstream out;
    const char *const  names[3] = {"normal", "gap vector", "weights"};
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double size = largest(all.sizes[i]), error = largest(all.errors[i]);
        out << (i == 0 ? " " : ", ") << names[i] << ' '
            << (size == 0. && error == 0. ? std::string("constant")
                                          : small(error / size, tolerance));
      }
    const unsigned int count = Utilities::MPI::sum(all.count, MPI_COMM_WORLD);
    if (Utilities::MPI::sum(all.changed, MPI_COMM_WORLD) > 0)
      out << ", contact points at a kink: another place is needed FAILED";
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << name << ": " << count / 3 << " rows (stencils" << stencils << ")\n " << out.str()
                << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const auto                       set = [](const std::string &key, const std::string &value) {
    return "Contact pair pair/" + key + "=" + value;
  };
  const std::string averaged = set("Pairing", "averaged"),
                    faceted  = set("Contact geometry", "faceted");
  const std::string degree_2 = "Discretisation/Degree=2";
  for (const std::string kind : {"face", "averaged", "smoothed"})
    {
      const std::string normal = set("Master normal", kind);
      for (const std::string pairing : {"pointwise", "averaged"})
        {
          const std::string with = set("Pairing", pairing);
          const std::string name = pairing + ", " + kind;
          check(name + ", warped faces", blocks, {normal, with}, -0.01);
          check(name + ", over edges and a corner", overhang, {normal, with}, 0.05);
          check(name + ", tubes", tubes, {normal, with}, 0.);
          check(name + ", faceted tubes", tubes, {normal, with, faceted}, 0.);
          if (kind != "smoothed")
            {
              check(name + ", degree 2", blocks, {normal, with, degree_2}, -0.01, 0.005);
              // Nodes with little coverage have weights that depend much on it.
              check(name + ", over edges, degree 2",
                    overhang,
                    {normal, with, degree_2, "Body upper/Geometry/Upper corner=1.21,1.33,2"},
                    0.05,
                    0.005,
                    pairing == "averaged" ? 1e-3 : 1e-6);
              check(name + ", tubes, degree 2", tubes, {normal, with, degree_2}, 0., 0.005);
            }
        }
    }
  for (const std::string kind : {"averaged", "smoothed"})
    {
      check("steep flanks, " + kind, ball, {set("Master normal", kind), averaged}, 0., 0.005);
      check("steep flanks of facets, " + kind,
            ball,
            {set("Master normal", kind), averaged, faceted},
            0.,
            0.005);
    }
  // Narrow contact, where gaps follow the shape of the surfaces.
  check("steep flanks, degree 2", ball, {averaged, degree_2}, 0., 0.005);
  // Between surfaces that nearly fit the arches of patches matter, which follow normals at nodes.
  check(
    "averaged, smoothed, faceted tubes that nearly fit",
    tubes,
    {set("Master normal", "smoothed"), averaged, faceted, "Body inner/Geometry/Outer radius=0.99"},
    0.,
    0.002);
  check("smoothed, within the other body",
        tubes,
        {set("Master normal", "smoothed"), set("Pairing", "pointwise"), faceted},
        0.03);
  for (const std::string kind : {"face", "averaged", "smoothed"})
    check("slit, " + kind, slit, {set("Master normal", kind)}, 0.);
  // Beside the edge by less than a thousandth of a face.
  for (const std::string kind : {"face", "averaged", "smoothed"})
    check("edge on edge, " + kind, edges, {set("Master normal", kind)}, 0., 5e-5);
  check("edge over the end of an edge",
        edges,
        {"Body upper/Geometry/Upper corner=2, 1.15, 2"},
        0.,
        5e-5);
  for (const std::string kind : {"face", "averaged", "smoothed"})
    check("flush edges, " + kind,
          flush,
          {set("Pairing", "pointwise"), set("Master normal", kind)},
          0.,
          0.002);
  check("flush edges, inside-outside", flush, {set("Pairing", "inside-outside")}, 0., 0.002);
  // Normals on planes of symmetry are those of the whole body.
  for (const std::string pairing : {"pointwise", "averaged", "inside-outside"})
    for (const std::string kind : {"averaged", "smoothed"})
      {
        std::vector<std::string> overrides = symmetric;
        overrides.push_back(set("Pairing", pairing));
        overrides.push_back(set("Master normal", kind));
        check("planes of symmetry, " + pairing + ", " + kind, quarter, overrides, -0.05, 0.005);
      }
  // The direction is that of the slave, on its sharp edges that of one side.
  const std::string inside_outside = set("Pairing", "inside-outside");
  check("inside-outside, warped faces", blocks, {inside_outside}, -0.01);
  check("inside-outside, over edges and a corner", overhang, {inside_outside}, 0.05);
  check("inside-outside, with the sides of the slave",
        blocks,
        {inside_outside, set("Slave boundaries", "bottom, left, right, front, back")},
        -0.01);
  check("inside-outside, tubes", tubes, {inside_outside}, 0.);
  check("inside-outside, faceted tubes", tubes, {inside_outside, faceted}, 0.);
  check("inside-outside, smoothed tubes",
        tubes,
        {inside_outside, faceted, set("Master normal", "smoothed")},
        0.);
  check("inside-outside, degree 2", blocks, {inside_outside, degree_2}, -0.01, 0.005);
  check("inside-outside, tubes, degree 2", tubes, {inside_outside, degree_2}, 0., 0.005);
  // Each shape has keys of its own.
  const std::string direction = "Obstacle rigid/Direction=0.2,1,0.3",
                    radius    = "Obstacle rigid/Radius=2";
  check("plane", obstacle, {"Obstacle rigid/Shape=plane", direction}, 0.);
  check("sphere", obstacle, {"Obstacle rigid/Shape=sphere", radius}, 0.);
  check("cylinder", obstacle, {"Obstacle rigid/Shape=cylinder", direction, radius}, 0.);
  return 0;
}
