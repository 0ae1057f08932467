// SPDX-License-Identifier: LGPL-2.1-or-later
// Element stiffness of all types: patch test on distorted cells, symmetry, six
// motions without energy and no more.

#include <touchstone/solid/element_kernel.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include "mesh_common.h"

using namespace Touchstone;
using namespace dealii;

namespace
{
  /** Eight cells whose inner vertex is off the centre, with oblique edges. */
  void
  make_mesh(Triangulation<dim> &triangulation)
  {
    GridGenerator::hyper_cube(triangulation);
    triangulation.refine_global(1);
    std::set<unsigned int> moved;
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        if (moved.insert(cell->vertex_index(v)).second)
          {
            Point<dim>  &x = cell->vertex(v);
            const double a = x[0], b = x[1], c = x[2];
            const double bubble = a * (1. - a) * b * (1. - b) * c * (1. - c);
            x[0]                = 1.2 * a + 0.2 * b * c + 9. * bubble;
            x[1]                = b - 0.15 * a * c - 7. * bubble + 0.1 * a;
            x[2]                = 0.8 * c + 0.2 * a * b + 5. * bubble + 0.1 * b;
          }
  }



  /** The largest figures of all cells. */
  struct Figures
  {
    double       stress = 0., force = 0., asymmetry = 0., rigid = 0., volume = 0., at_once = 0.;
    unsigned int zero = 0, cells = 0;
  };



  /** Patch test: a displacement that is linear in space gives the exact stress at all points. */
  void
  check_stress(ElementKernel                 &kernel,
               const std::vector<double>     &u,
               const SymmetricTensor<2, dim> &exact,
               Figures                       &figures)
  {
    kernel.set_displacement(u);
    for (unsigned int q = 0; q < kernel.n_quadrature_points(); ++q)
      {
        figures.stress = std::max(figures.stress, (kernel.stress(q) - exact).norm() / exact.norm());
        figures.volume += kernel.volume(q);
      }
  }



  /** Rigid motions: none of the six needs a force. */
  void
  check_rigid_motions(const ElementKernel           &kernel,
                      const ElementStiffness<1>     &k,
                      const std::vector<Point<dim>> &support,
                      const std::vector<Index>      &dofs,
                      const double                   largest,
                      Figures                       &figures)
  {
    const unsigned int n = kernel.n_dofs();
    for (unsigned int m = 0; m < 6; ++m)
      {
        Tensor<1, dim> e;
        e[m % dim] = 1.;
        std::vector<double> r(n);
        for (unsigned int i = 0; i < n; ++i)
          {
            const Tensor<1, dim> x = support[dofs[kernel.local_dof(i / dim, 0)]];
            r[i]                   = (m < dim ? e : cross_product_3d(e, x))[i % dim];
          }
        for (unsigned int i = 0; i < n; ++i)
          {
            double sum = 0.;
            for (unsigned int j = 0; j < n; ++j)
              sum += k(i, j) * r[j];
            figures.rigid = std::max(figures.rigid, std::abs(sum) / largest);
          }
      }
  }



  /** Number of motions without energy: eigenvalues of zero. */
  unsigned int
  n_motions_without_energy(const ElementStiffness<1> &k, const unsigned int n, const double largest)
  {
    LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = k(i, j) / largest;
    dealii::Vector<double> eigenvalues;
    FullMatrix<double>     eigenvectors;
    matrix.compute_eigenvalues_symmetric(-1e3, 1e-9, 1e-14, eigenvalues, eigenvectors);
    return eigenvalues.size();
  }



  /** All cells of the mesh, one by one and at once, under one displacement gradient.
   * @param exact The stress that belongs to it. */
  Figures
  check_cells(ElementKernel                 &kernel,
              const DoFHandler<dim>         &dof_handler,
              const MappingQ<dim>           &mapping,
              const Tensor<2, dim>          &gradient,
              const SymmetricTensor<2, dim> &exact)
  {
    std::vector<Point<dim>> support(dof_handler.n_dofs());
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, support);
    const unsigned int               n = kernel.n_dofs();
    dealii::Vector<double>           residual(dof_handler.n_dofs());
    std::vector<Index>               dofs(dof_handler.get_fe().n_dofs_per_cell());
    std::vector<double>              u(n);
    std::vector<std::vector<double>> one_by_one;
    ElementStiffness<8>              eight = kernel.stiffness_of_cells();
    Figures                          figures;
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        kernel.reinit(cell);
        kernel.become(figures.cells, eight);
        cell->get_dof_indices(dofs);
        const ElementStiffness<1> &k = kernel.stiffness();
        for (unsigned int a = 0; a < kernel.nodes_per_cell(); ++a)
          for (unsigned int d = 0; d < dim; ++d)
            u[dim * a + d] = gradient[d] * support[dofs[kernel.local_dof(a, d)]];
        check_stress(kernel, u, exact, figures);

        double largest = 0.;
        one_by_one.emplace_back();
        for (unsigned int i = 0; i < n; ++i)
          {
            double sum = 0.;
            for (unsigned int j = 0; j < n; ++j)
              {
                sum += k(i, j) * u[j];
                one_by_one.back().push_back(k(i, j));
                largest           = std::max(largest, std::abs(k(i, j)));
                figures.asymmetry = std::max(figures.asymmetry, std::abs(k(i, j) - k(j, i)));
              }
            residual[dofs[kernel.local_dof(i / dim, i % dim)]] += sum;
          }
        check_rigid_motions(kernel, k, support, dofs, largest, figures);
        figures.zero += n_motions_without_energy(k, n, largest);
        ++figures.cells;
      }
    eight.compute();
    for (unsigned int c = 0; c < 8; ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          figures.at_once =
            std::max(figures.at_once,
                     std::abs(eight(i, j, c) - one_by_one[c][n * i + j]) / exact.norm());
    // Forces on nodes inside are in balance.
    for (const auto i : DoFTools::extract_boundary_dofs(dof_handler))
      residual[i] = 0.;
    for (unsigned int i = 0; i < residual.size(); ++i)
      figures.force = std::max(figures.force, std::abs(residual[i]) / exact.norm());
    return figures;
  }



  void
  check(const std::string &name, const unsigned int degree, const ElementType type, const double nu)
  {
    Triangulation<dim> triangulation;
    make_mesh(triangulation);
    const FESystem<dim> fe(FE_Q<dim>(degree), dim);
    const MappingQ<dim> mapping(degree);
    DoFHandler<dim>     dof_handler(triangulation);
    dof_handler.distribute_dofs(fe);

    MaterialParameters material;
    material.young_modulus = 2.;
    material.poisson_ratio = nu;
    ElementKernel kernel(mapping, fe, type, material);

    const double   lambda = 2. * nu / ((1. + nu) * (1. - 2. * nu)), mu = 1. / (1. + nu);
    Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[i][j] = 0.3 + 0.1 * i - 0.25 * j + 0.2 * i * j;
    const SymmetricTensor<2, dim> strain = symmetrize(gradient);
    const SymmetricTensor<2, dim> exact =
      2. * mu * strain + lambda * trace(strain) * unit_symmetric_tensor<dim>();

    const Figures figures = check_cells(kernel, dof_handler, mapping, gradient, exact);
    std::cout << name << ", nu = " << nu << ": volume " << figures.volume << ", patch test: stress "
              << small(figures.stress) << ", forces inside " << small(figures.force)
              << ", asymmetry " << small(figures.asymmetry / exact.norm(), 1e-11)
              << ", eight at once " << small(figures.at_once, 1e-11) << ", rigid motions "
              << small(figures.rigid) << ", " << double(figures.zero) / figures.cells
              << " motions without energy" << std::endl;
  }
} // namespace

int
main()
{
  for (const double nu : {0., 0.3, 0.49})
    {
      check("full", 1, ElementType::full, nu);
      check("B-bar", 1, ElementType::b_bar, nu);
      check("incompatible modes", 1, ElementType::incompatible_modes, nu);
      check("degree 2", 2, ElementType::full, nu);
    }
  return 0;
}
