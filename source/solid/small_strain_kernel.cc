// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/small_strain_kernel.h>
#include <touchstone/solid/thermal_strain.h>

#include <algorithm>

// Cells of small strain with an arbitrary law, e.g. plasticity: full integration or B-bar
// (doc/theory.md 2.1), as the linear case of the same scheme that FiniteStrainKernel uses, with
// the mean dilatation t for theta.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Hooke's law, for bodies that are not assembled once because of their thermal strain. */
    class Hooke : public SmallStrainLaw
    {
    public:
      explicit Hooke(const MaterialParameters &material)
        : mu(material.shear_modulus())
        , lambda(material.bulk_modulus() - 2. / 3. * mu)
      {
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double *) const override
      {
        const SymmetricTensor<2, dim> strain = symmetrize(input.deformation);
        const SymmetricTensor<2, dim> stress =
          lambda * trace(strain) * unit_symmetric_tensor<dim>() + 2. * mu * strain;
        response.energy = response.elastic_energy = 0.5 * (stress * strain);
        response.stress                           = stress;
        if (demand == Demand::tangent)
          response.tangent = Tensor<4, dim>(
            lambda * outer_product(unit_symmetric_tensor<dim>(), unit_symmetric_tensor<dim>()) +
            2. * mu * identity_tensor<dim>());
      }

    private:
      const double mu, lambda;
    };

    std::shared_ptr<const MaterialLaw>
    make_small_strain_law(const MaterialParameters &material)
    {
      if (SmallStrainRegistry::knows(material.law.name))
        return material.law.make<SmallStrainRegistry>(material);
      return std::make_shared<Hooke>(material);
    }
  } // namespace



  SmallStrainKernel::SmallStrainKernel(const unsigned int        degree,
                                       const ElementType         type,
                                       const MaterialParameters &material)
    : CellKernel(degree,
                 with_thermal_strain(material, make_small_strain_law(material)),
                 type == ElementType::b_bar)
  {
    Assert(type != ElementType::f_bar && type != ElementType::incompatible_modes,
           ExcNotImplemented());
  }



  /** The mean of div u over the cell, by which B-bar replaces the dilatation of each point. Cells
   * of small strain cannot be inverted, hence 1 for the determinant. */
  double
  SmallStrainKernel::deform()
  {
    mean_dilatation = 0.;
    if (averaged)
      for (const PointData &point : points)
        mean_dilatation += point.weight / cell_volume * trace(point.gradient);
    return 1.;
  }



  Tensor<2, dim>
  SmallStrainKernel::deformation(const unsigned int q) const
  {
    // The spherical part of the gradient is changed such that its trace is the mean dilatation;
    // its skew part does not matter to the law.
    Tensor<2, dim> gradient = points[q].gradient;
    if (averaged)
      {
        const double change = (mean_dilatation - trace(gradient)) / dim;
        for (unsigned int d = 0; d < dim; ++d)
          gradient[d][d] += change;
      }
    return gradient;
  }



  /** dt/du: the volume-weighted mean of the shape gradients. */
  void
  SmallStrainKernel::set_mean_gradient()
  {
    std::fill(mean_gradient.begin(), mean_gradient.end(), 0.);
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          mean_gradient[dim * a + i] +=
            points[q].weight / cell_volume * shape_gradient(q)[i * n_nodes + a];
  }



  /** Stress at fixed t: only its deviator does work on the displacements of the point; a third of
   * its trace does work on t, and is summed up over the cell. */
  Tensor<2, dim>
  SmallStrainKernel::point_stress(const unsigned int q, double &pressure) const
  {
    Tensor<2, dim> stress = points[q].response.stress;
    if (averaged)
      {
        const double third = trace(stress) / dim;
        pressure += points[q].weight * third;
        for (unsigned int d = 0; d < dim; ++d)
          stress[d][d] -= third;
      }
    return stress;
  }



  CellKernel::MeanTerms
  SmallStrainKernel::modify_tangent(const unsigned int, const double, Tensor<4, dim> &A) const
  {
    // The strain is dev(grad u) + t I / 3: with S = A : I / 3 and T = I : A / 3 the
    // second derivatives are, by grad u twice, A - S x I - I x T + s I x I, mixed
    // S - s I and T - s I, and by t twice s = I : A : I / 9.
    MeanTerms terms;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          {
            terms.left[i][j] += A[i][j][k][k] / dim;
            terms.right[i][j] += A[k][k][i][j] / dim;
          }
    terms.second = trace(terms.left) / dim;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          {
            A[i][j][k][k] -= terms.left[i][j];
            A[k][k][i][j] -= terms.right[i][j];
          }
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int k = 0; k < dim; ++k)
        A[i][i][k][k] += terms.second;
    for (unsigned int d = 0; d < dim; ++d)
      {
        terms.left[d][d] -= terms.second;
        terms.right[d][d] -= terms.second;
      }
    return terms;
  }



  SymmetricTensor<2, dim>
  SmallStrainKernel::stress(const unsigned int q)
  {
    if (!has_stress)
      respond(Demand::stress);
    return symmetrize(points[q].response.stress);
  }
} // namespace Touchstone
