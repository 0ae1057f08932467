// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/thermal_strain.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Cells of finite strain, total Lagrangian: full integration or F-bar in its form with an energy
// (doc/theory.md 2.2, equation (1)), in which the tangent is symmetric. Loops and sums are those
// of CellKernel; here are the deformation that the law is given at each point and the derivatives
// of the mean dilatation.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** A law without history. */
    class Hyperelastic : public MaterialLaw
    {
    public:
      explicit Hyperelastic(const MaterialParameters &material)
        : law(material.law.make<HyperelasticRegistry>(material))
      {
      }

      bool
      admits(const MaterialInput &input) const override
      {
        return law->admits(input.deformation);
      }

      void
      respond(const MaterialInput &input,
              const Demand         demand,
              MaterialResponse    &response,
              double *) const override
      {
        const Tensor<2, dim> &F = input.deformation;
        if (demand == Demand::energy)
          response.energy = response.elastic_energy = law->energy(F);
        else
          response.stress = law->stress(F);
        if (demand == Demand::tangent)
          response.tangent = law->tangent(F);
      }

    private:
      const std::shared_ptr<HyperelasticLaw> law;
    };

    /** Laws with history are registered as MaterialLaw, hyperelastic ones by their energy alone;
     * the kernel sees both through the same interface. */
    std::shared_ptr<const MaterialLaw>
    make_finite_strain_law(const MaterialParameters &material)
    {
      if (FiniteStrainRegistry::knows(material.law.name))
        return with_thermal_strain(material, material.law.make<FiniteStrainRegistry>(material));
      return with_thermal_strain(material, std::make_shared<Hyperelastic>(material));
    }
  } // namespace



  FiniteStrainKernel::FiniteStrainKernel(const unsigned int        degree,
                                         const ElementType         type,
                                         const MaterialParameters &material)
    : CellKernel(degree, make_finite_strain_law(material), type == ElementType::f_bar)
    , kinematics(n_points)
  {
    Assert(type != ElementType::b_bar && type != ElementType::incompatible_modes,
           ExcNotImplemented());
  }



  /** Kinematics of all points from the displacement gradient: F, J, and with F-bar the modified
   * gradient F_bar = (J_mean / J)^(1/3) F, J_mean the present volume of the cell over that in the
   * reference state. Returns the smallest J: if it is not positive, the cell is inverted at that
   * point and no law is evaluated. */
  double
  FiniteStrainKernel::deform()
  {
    double smallest = std::numeric_limits<double>::max(), present_volume = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        Kinematics &point = kinematics[q];
        point.F           = points[q].gradient;
        for (unsigned int d = 0; d < dim; ++d)
          point.F[d][d] += 1.;
        point.J = determinant(point.F);
        present_volume += points[q].weight * point.J;
        smallest = std::min(smallest, point.J);
      }
    // False for what is not a number, too.
    if (!(smallest > 0.))
      return std::isnan(smallest) ? 0. : smallest;

    mean_J = present_volume / cell_volume;
    for (Kinematics &point : kinematics)
      {
        point.H     = transpose(invert(point.F));
        point.alpha = averaged ? std::cbrt(mean_J / point.J) : 1.;
        point.F_bar = point.alpha * point.F;
      }
    return admitted() ? smallest : 0.;
  }



  void
  FiniteStrainKernel::set_mean_gradient()
  {
    // d theta/du of equation (1), with theta = ln J_mean:
    // v = sum_q w J and dJ = J H : dF.
    std::fill(mean_gradient.begin(), mean_gradient.end(), 0.);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const Kinematics &point  = kinematics[q];
        const double     *g      = shape_gradient(q);
        const double      factor = points[q].weight * point.J / (mean_J * cell_volume);
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int d = 0; d < dim; ++d)
              mean_gradient[dim * a + i] += factor * point.H[i][d] * g[d * n_nodes + a];
      }
  }



  Tensor<2, dim>
  FiniteStrainKernel::point_stress(const unsigned int q, double &pressure) const
  {
    // Stress at fixed theta, alpha P - p H of equation (1); the point's share w p of the sum that
    // multiplies d theta/du is added to @p pressure.
    // dFbar = alpha dF + Fbar (d ln Jbar - d ln J) / 3.
    const Tensor<2, dim> &P = points[q].response.stress;
    if (!averaged)
      return P;
    const Kinematics &point = kinematics[q];
    const double      third = scalar_product(P, point.F_bar) / 3.;
    pressure += points[q].weight * third;
    return point.alpha * P - third * point.H;
  }



  CellKernel::MeanTerms
  FiniteStrainKernel::modify_tangent(const unsigned int q,
                                     const double       pressure,
                                     Tensor<4, dim>    &A) const
  {
    // With R = A : Fbar, S = P + R and p = P : Fbar / 3 the energy W(Fbar) as a function
    // of F and t = ln Jbar has the second derivatives
    //   FF: alpha^2 A - alpha/3 (S x H + H x S) + (S : Fbar)/9 H x H + p X,
    //   Ft: alpha/3 S - (S : Fbar)/9 H,    tt: (S : Fbar)/9,
    // where X_iJkL = H_iL H_kJ. To FF comes the share of the second derivative of t
    // itself, as a function of the displacements: J/(Jbar V) (H x H - X) - dt dt. If A is
    // not symmetric there is a second S, with Fbar : A.
    const Kinematics     &point = kinematics[q];
    const Tensor<2, dim> &P     = points[q].response.stress;
    Tensor<2, dim>        S = P, T = P;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        {
          S[i][j] += scalar_product(A[i][j], point.F_bar);
          T += point.F_bar[i][j] * A[i][j];
        }
    const double second   = scalar_product(S, point.F_bar) / 9.;
    const double dilation = pressure * point.J / (mean_J * cell_volume);
    const double product  = second + dilation;
    const double exchange = scalar_product(P, point.F_bar) / 3. - dilation;
    const double square   = point.alpha * point.alpha;
    S *= point.alpha / 3.;
    T *= point.alpha / 3.;
    const Tensor<2, dim> &H = point.H;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            A[i][j][k][l] = square * A[i][j][k][l] - S[i][j] * H[k][l] - H[i][j] * T[k][l] +
                            product * H[i][j] * H[k][l] + exchange * H[i][l] * H[k][j];
    return {S - second * H, T - second * H, second};
  }



  /** Cauchy stress P_bar F_bar^T / J_bar. It is that of the modified deformation, which the law
   * has seen: the pressure of the unmodified one would oscillate from point to point in nearly
   * incompressible material. */
  SymmetricTensor<2, dim>
  FiniteStrainKernel::stress(const unsigned int q)
  {
    if (!has_stress)
      respond(Demand::stress);
    const Kinematics &point = kinematics[q];
    return symmetrize(points[q].response.stress * transpose(point.F_bar)) /
           determinant(point.F_bar);
  }
} // namespace Touchstone
