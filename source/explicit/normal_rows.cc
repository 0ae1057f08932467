// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/vectorised.h>
#include <touchstone/explicit/normal_rows.h>

#include <algorithm>
#include <cmath>

// The loops of sweeps over rows that act along their normals (doc/explicit.md, section 9.2).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    using Four = Simd<double, 4>::type;

    __attribute__((always_inline)) inline Four
    load_four(const NormalRows::Vector &values)
    {
      return *reinterpret_cast<const Four *>(values.c);
    }

    __attribute__((always_inline)) inline void
    store_four(const Four &values, NormalRows::Vector &to)
    {
      *reinterpret_cast<Four *>(to.c) = values;
    }
  } // namespace



  void
  NormalRows::clear()
  {
    rows.clear();
    entries.clear();
    nodes.clear();
    slots.clear();
  }



  void
  NormalRows::set_nodes(const std::vector<Tensor<1, dim>>          &free_velocity,
                        const std::vector<SymmetricTensor<2, dim>> &mobilities)
  {
    const std::size_t n = free_velocity.size();
    for (std::vector<Vector> *const field : {&free, &mobility, &oblique, &sums, &velocity})
      field->resize(n);
    mobility_norms.resize(n);
    any_oblique = false;
    for (std::size_t i = 0; i < n; ++i)
      {
        const Tensor<1, dim>          &v = free_velocity[i];
        const SymmetricTensor<2, dim> &m = mobilities[i];
        free[i]                          = {{v[0], v[1], v[2], 0.}};
        mobility[i]                      = {{m[0][0], m[1][1], m[2][2], 0.}};
        oblique[i]                       = {{m[1][2], m[0][2], m[0][1], 0.}};
        mobility_norms[i]                = m.norm();
        any_oblique = any_oblique || m[1][2] != 0. || m[0][2] != 0. || m[0][1] != 0.;
      }
  }



  void
  NormalRows::sum_sizes()
  {
    std::fill(sums.begin(), sums.end(), Vector{});
    for (std::size_t e = 0; e < entries.size(); ++e)
      sums[nodes[e]].c[3] += entries[e].c[3];
  }



  void
  NormalRows::set_bounds(const double immobile, const double relaxation)
  {
    for (unsigned int i = 0; i < size(); ++i)
      {
        double along = 0., whole = 0.;
        for (std::size_t e = rows[i].first; e < rows[i + 1].first; ++e)
          {
            const double *const c = entries[e].c, *const m = mobility[nodes[e]].c,
                                *const o = oblique[nodes[e]].c;
            if (!(c[3] > 0.))
              continue;
            const double part    = sums[nodes[e]].c[3];
            double       along_c = c[0] * m[0] * c[0] + c[1] * m[1] * c[1] + c[2] * m[2] * c[2];
            along_c += 2. * (o[0] * c[1] * c[2] + o[1] * c[0] * c[2] + o[2] * c[0] * c[1]);
            along += part / c[3] * along_c;
            whole += part * c[3] * mobility_norms[nodes[e]];
          }
        rows[i].mobility = along > immobile * whole ? along / relaxation : 0.;
      }
  }



  void
  NormalRows::extrapolate(const double part)
  {
    for (Row &row : rows)
      {
        row.extrapolated = row.impulse + part * (row.impulse - row.present);
        row.present      = row.impulse;
      }
  }



  std::int64_t
  NormalRows::turn(const double unit) const
  {
    const double scale = 4294967296. / unit;
    std::int64_t sum   = 0;
    for (unsigned int i = 0; i < size(); ++i)
      sum -= std::llrint(scale * (rows[i].mobility * (rows[i].impulse - rows[i].extrapolated) *
                                  (rows[i].impulse - rows[i].present)));
    return sum;
  }

  // A product that is rounded together with the sum it is added to is not the product that another
  // rank adds.
#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC push_options
#  pragma GCC optimize("fp-contract=off")
#endif



  TOUCHSTONE_VECTORISED void
  NormalRows::sum(double Row::*const impulse)
  {
    // Stores may change anything, but not these.
    Vector *const             at   = sums.data();
    const Vector             *of   = entries.data();
    const unsigned int       *node = nodes.data();
    const Row                *row  = rows.data();
    const unsigned int *const end  = node + nodes.size();
    const Four                zero = {};
    for (std::size_t i = 0; i < sums.size(); ++i)
      store_four(zero, at[i]);
    for (const unsigned int *next; node != end; ++row)
      {
        const double p = row->*impulse;
        for (next = nodes.data() + row[1].first; node != next; ++node, ++of)
          {
            const Four product = p * load_four(*of);
            store_four(load_four(at[*node]) + product, at[*node]);
          }
      }
  }



  TOUCHSTONE_VECTORISED void
  NormalRows::move(const unsigned int n)
  {
    for (unsigned int i = 0; i < n; ++i)
      store_four(load_four(free[i]) + load_four(mobility[i]) * load_four(sums[i]), velocity[i]);
    add_oblique(n);
  }



  TOUCHSTONE_VECTORISED void
  NormalRows::respond(const unsigned int n)
  {
    for (unsigned int i = 0; i < n; ++i)
      store_four(load_four(mobility[i]) * load_four(sums[i]), velocity[i]);
    add_oblique(n);
  }



  void
  NormalRows::add_oblique(const unsigned int n)
  {
    if (any_oblique)
      for (unsigned int i = 0; i < n; ++i)
        {
          const double *const o = oblique[i].c, *const s = sums[i].c;
          velocity[i].c[0] += o[2] * s[1] + o[1] * s[2];
          velocity[i].c[1] += o[2] * s[0] + o[0] * s[2];
          velocity[i].c[2] += o[1] * s[0] + o[0] * s[1];
        }
  }



  TOUCHSTONE_VECTORISED void
  NormalRows::along_normals(std::vector<double> &result) const
  {
    result.resize(size());
    double *const       to = result.data();
    const Vector *const v = velocity.data(), *of = entries.data();
    const unsigned int *node = nodes.data();
    for (unsigned int i = 0; i < size(); ++i)
      {
        Four sum = {};
        for (const unsigned int *const next = nodes.data() + rows[i + 1].first; node != next;
             ++node, ++of)
          sum += load_four(*of) * load_four(v[*node]);
        to[i] = sum[0] + sum[1] + sum[2];
      }
  }



  TOUCHSTONE_VECTORISED double
  NormalRows::relative_velocity(const unsigned int i) const
  {
    Four sum = {};
    for (std::size_t e = rows[i].first; e < rows[i + 1].first; ++e)
      sum += load_four(entries[e]) * load_four(velocity[nodes[e]]);
    return sum[0] + sum[1] + sum[2];
  }



  TOUCHSTONE_VECTORISED void
  NormalRows::improve(double (&largest)[2])
  {
    double              change = 0., move = 0.;
    const Vector *const v = velocity.data(), *of = entries.data();
    const unsigned int *node = nodes.data();
    const unsigned int  n    = size();
    for (unsigned int i = 0; i < n; ++i)
      {
        Row &row = rows[i];
        Four sum = {};
        for (const unsigned int *const next = nodes.data() + rows[i + 1].first; node != next;
             ++node, ++of)
          sum += load_four(*of) * load_four(v[*node]);
        const double excess = row.allowed - row.drive + (sum[0] + sum[1] + sum[2]);
        row.impulse =
          row.mobility > 0. ? std::max(0., row.extrapolated - excess / row.mobility) : 0.;
        change = std::max(change, row.mobility * std::abs(row.impulse - row.extrapolated));
        move   = std::max(move, std::abs(row.impulse - row.present));
      }
    largest[0] = change;
    largest[1] = move;
  }

#if defined(__GNUC__) && !defined(__clang__)
#  pragma GCC pop_options
#endif
} // namespace Touchstone
