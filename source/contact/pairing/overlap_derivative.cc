// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/opposite_point.h>
#include <touchstone/contact/pairing/overlap_derivative.h>

// Adds quadrature points to the integrals of one slave and one master face with derivatives. Those
// by node positions are carried by the numbers (PositionFad); those by averaged nodal normals are
// kept apart, because the nodes around the face on which they depend are not variables of this pair
// of faces.
namespace Touchstone
{
  using namespace dealii;

  template <unsigned int n>
  void
  OverlapDerivative<n>::add(const OverlapPointDerivative<n> &of_facets,
                            const FaceDifferentiator        &on_slave,
                            const FaceDifferentiator        &on_master)
  {
    const FacePosition        slave_point = on_slave.position(of_facets.slave);
    OverlapPointDerivative<n> point       = of_facets;
    if (!differentiate_opposite_point<n>(on_slave.geometry, slave_point, on_master, point))
      return;
    const FaceDerivative             master_point = on_master.at(point.master);
    OverlapSample<n, PositionFad<n>> sample;
    if (!differentiate<n>(
          point, on_slave.geometry, slave_point, on_master.geometry, master_point, sample))
      return;
    // To see whether this point becomes the one with the smallest gap, whose dependence on normals
    // is then stored.
    const double          least_before = this->least.val();
    std::array<double, n> own_before;
    for (unsigned int j = 0; j < n; ++j)
      own_before[j] = this->own[j].val();
    OverlapIntegrals<n, PositionFad<n>>::add(sample);

    // The normal depends on nodal normals; positions do only where the surfaces are smooth patches.
    const bool slave_smooth = on_slave.geometry.smooth();
    const auto by_normals   = [&]() {
      const Tensor<1, dim> gap({sample.gap[0].val(), sample.gap[1].val(), sample.gap[2].val()});
      ByNormals            result;
      for (unsigned int m = 0; m < n; ++m)
        {
          // Of g = n . (x_s - x_m): by n directly, and by the points where these depend on nodal
          // normals.
          result.master[m] = gap * master_point.normal_normal[m];
          if (master_smooth)
            result.master[m] -= master_point.normal * master_point.x_normal[m];
          if (slave_smooth)
            result.slave[m] = master_point.normal * slave_point.x_normal[m];
        }
      return result;
    };
    if (this->least.val() < least_before)
      least_by_normals = by_normals();
    for (unsigned int j = 0; j < n; ++j)
      if (this->own[j].val() < own_before[j])
        own_by_normals[j] = by_normals();

    // A corner takes part in the smallest gaps only.
    if (sample.weight.val() == 0.)
      return;
    // A patch bulges with the normals of its nodes.
    Tensor<1, dim> bulge;
    if (slave_smooth && sample.arch.val() > 0.)
      {
        bulge = slave_point.point.x;
        for (unsigned int m = 0; m < n; ++m)
          bulge -= slave_point.shapes.value[m] * on_slave.geometry.face().position(m);
        bulge /= sample.arch.val();
      }
    for (unsigned int j = 0; j < n; ++j)
      {
        const double weight = sample.weight.val() * sample.slave_shape[j].val();
        for (unsigned int m = 0; m < n; ++m)
          {
            normal_normal[j][m] += weight * master_point.normal_normal[m];
            if (master_smooth)
              gap_normal[j][m] -= weight * master_point.x_normal[m];
            if (slave_smooth)
              {
                gap_slave_normal[j][m] += weight * slave_point.x_normal[m];
                arch_slave_normal[j][m] += weight * bulge * slave_point.x_normal[m];
              }
          }
      }
  }



  template struct OverlapDerivative<4>;
  template struct OverlapDerivative<9>;
} // namespace Touchstone
