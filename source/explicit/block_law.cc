// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/explicit/block_law.h>
#include <touchstone/explicit/one_point_kernels.h>
#include <touchstone/solid/finite_strain_kernel.h>
#include <touchstone/solid/hardening_law.h>
#include <touchstone/solid/small_strain_kernel.h>

#include <algorithm>

// Stresses of eight cells (doc/explicit.md, section 5).
namespace Touchstone
{
  using namespace dealii;

  BlockLaw::BlockLaw(const BodyParameters &body)
    : finite(body.material.finite_strain())
    , formulas(body.material.linear() ? Formulas::linear_elastic
               : body.material.law.name == "neo-Hookean" && !body.material.thermal()
                 ? Formulas::neo_hookean
                 : Formulas::any_law)
    , constants{body.material.shear_modulus(), body.material.bulk_modulus(), 0., 0.}
  {
    // The law that the elements of implicit runs have.
    if (finite)
      of_points = FiniteStrainKernel(1, ElementType::full, body.material).material();
    else if (!body.material.linear())
      of_points = SmallStrainKernel(1, ElementType::full, body.material).material();
    // The formulas for eight cells are those of constant and of linear isotropic hardening.
    const std::string &hardening = body.material.hardening_type.name;
    if (finite && of_points->n_state() > 0 && of_points->plastic() && !body.material.thermal() &&
        body.material.kinematic_modulus == 0. && (hardening == "none" || hardening == "linear"))
      {
        formulas                = Formulas::von_mises;
        const YieldStress yield = body.material.hardening->at(0.);
        constants.yield_stress  = yield.value;
        constants.hardening     = yield.slope;
      }
    if (of_points)
      {
        before.resize(of_points->n_state());
        after.resize(of_points->n_state());
      }
  }



  unsigned int
  BlockLaw::respond(const double (*gradient)[n_lanes],
                    const double       step,
                    const unsigned int n_used,
                    double (*state)[n_lanes],
                    double (*stress)[n_lanes])
  {
    double marks[n_lanes];
    switch (formulas)
      {
        case Formulas::linear_elastic:
          OnePointKernels::linear_elastic(constants.kappa - 2. / 3. * constants.mu,
                                          constants.mu,
                                          gradient,
                                          stress);
          return n_lanes;
        case Formulas::neo_hookean:
          OnePointKernels::neo_hookean(constants.kappa, constants.mu, gradient, stress, marks);
          for (unsigned int lane = 0; lane < n_used; ++lane)
            if (!(marks[lane] > 0.))
              return lane;
          return n_lanes;
        case Formulas::von_mises:
          // Cells beyond the series of the formulas are few; failures show there.
          von_mises_cycle(constants, gradient, state, stress, marks);
          if (std::any_of(marks, marks + n_lanes, [](const double mark) { return mark != 0.; }))
            return respond_singly(gradient, step, n_used, state, stress, marks);
          return n_lanes;
        case Formulas::any_law:
          break;
      }
    return respond_singly(gradient, step, n_used, state, stress, nullptr);
  }



  unsigned int
  BlockLaw::respond_singly(const double (*gradient)[n_lanes],
                           const double       step,
                           const unsigned int n_used,
                           double (*state)[n_lanes],
                           double (*stress)[n_lanes],
                           const double *marked)
  {
    unsigned int     failed = n_lanes;
    MaterialResponse response;
    for (unsigned int lane = 0; lane < n_used; ++lane)
      {
        if (marked != nullptr && marked[lane] == 0.)
          continue;
        Tensor<2, dim> F;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            F[i][j] = gradient[dim * i + j][lane] + (finite && i == j ? 1. : 0.);
        for (unsigned int k = 0; k < before.size(); ++k)
          before[k] = state[k][lane];
        response.solved = !finite || determinant(F) > 0.;
        response.solved = response.solved && of_points->admits({F, before.data(), step});
        if (response.solved)
          of_points->respond({F, before.data(), step}, Demand::stress, response, after.data());
        if (response.solved)
          for (unsigned int k = 0; k < after.size(); ++k)
            state[k][lane] = after[k];
        else
          failed = std::min(failed, lane);
        for (unsigned int k = 0; k < dim * dim; ++k)
          stress[k][lane] = response.solved ? response.stress[k / dim][k % dim] : 0.;
      }
    return failed;
  }
} // namespace Touchstone
