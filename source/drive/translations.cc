// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/drive/translations.h>
#include <touchstone/solid/bodies.h>

#include <deal.II/base/symmetric_tensor.h>

// Least squares for translations of bodies.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int n_sums = dim * dim + dim;
  }



  Translations::Translations(const unsigned int n_bodies)
    : sums(n_sums * n_bodies)
  {
  }



  void
  Translations::add(const unsigned int body, const Tensor<1, dim> &direction, const double motion)
  {
    double *const sum = &sums[n_sums * body];
    for (unsigned int i = 0; i < dim; ++i)
      {
        for (unsigned int j = 0; j < dim; ++j)
          sum[dim * i + j] += direction[i] * direction[j];
        sum[dim * dim + i] += direction[i] * motion;
      }
  }



  void
  Translations::complete(const MPI_Comm communicator)
  {
    Utilities::MPI::sum(sums, communicator, sums);
  }



  Tensor<1, dim>
  Translations::closest(const unsigned int body) const
  {
    const double *const     sum = &sums[n_sums * body];
    SymmetricTensor<2, dim> directions;
    Tensor<1, dim>          missing;
    for (unsigned int i = 0; i < dim; ++i)
      {
        missing[i] = sum[dim * dim + i];
        for (unsigned int j = 0; j <= i; ++j)
          directions[i][j] = sum[dim * i + j];
      }
    constexpr double given = 1e-10;
    const auto       axes  = eigenvectors(directions);
    Tensor<1, dim>   result;
    for (const auto &[value, axis] : axes)
      if (value > given * axes[0].first)
        result += (axis * missing) / value * axis;
    return result;
  }



  void
  translate_bodies(const Solid &solid, const std::vector<Tensor<1, dim>> &motions, Vector &u)
  {
    const std::vector<unsigned int> bodies = bodies_of_unknowns(solid);
    for (std::size_t k = 0; k < bodies.size(); ++k)
      u.begin()[k] += motions[bodies[k]][solid.owned.nth_index_in_set(k) % dim];
  }
} // namespace Touchstone
