// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/pairing/averaged_row.h>
#include <touchstone/contact/pairing/smooth_step.h>
#include <touchstone/contact/tolerances.h>

#include <Sacado.hpp>
#include <algorithm>
#include <limits>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The mean of an integral with N~_k, zero where that has no positive area. */
    double
    mean_of(const CoverSums &sums, const double integral)
    {
      return sums.shape_area > 0. ? integral / sums.shape_area : 0.;
    }

    /** r of equation (6). @param inclined Mean of OverlapSample::inclined. */
    template <typename Number>
    Number
    loss(const Number &given, const Number &kept, const Number &inclined)
    {
      return (given / kept + inclined) / (1. - inclined);
    }
  } // namespace



  double
  CoverSums::loss() const
  {
    return Touchstone::loss(given, kept, mean_of(*this, inclined));
  }



  bool
  CoverSums::suffices(const double whole) const
  {
    // A row needs some covered area of its own, at most r = 3 of it lost (doc/theory.md 3.1),
    // and a normal. Without the rows of parts that are kept as a whole a pressure would be lost.
    // What a node that leaves its row to others comes to touch within a step, beyond the edge of
    // its faces, is a sliver without a row until the step ends.
    return kept >= Tolerances::least_cover * whole &&
           Tolerances::most_lost >= (1. - shared) * loss() &&
           Tolerances::most_lost * kept >= left_to_others && normal.norm_square() > 0.;
  }



  namespace
  {
    /** What the correction depends on, with derivatives. */
    using Number = Sacado::Fad::SFad<double, 16>;
    enum class Of
    {
      mean_gap,
      least,
      own,
      beside,
      kept,
      given,
      area,
      moved,
      arch,
      inclined,
      face_mean,
      face_positive,
      face_own,
      face_beside,
      face_least,
      face_area
    };

    Number
    variable(const Of which, const double value)
    {
      return Number(16, static_cast<int>(which), value);
    }

    /** Displacement at the node less the mean. */
    Tensor<1, dim>
    relative_motion(const CoverSums &sums)
    {
      return sums.own_moved - sums.moved / sums.area;
    }



    /** What one face takes from g_s, equation (7); length.
     * @param at_node g_s. @param above The same less the mean gap, of the row. @param beside 0
     * where the node is covered, 1 where it clearly is not. @param whole Area of the row. */
    Number
    flattened(const FaceShare      &face,
              const Tensor<1, dim> &normal,
              const double          length,
              const Number         &at_node,
              const Number         &above,
              const Number         &beside,
              const Number         &whole)
    {
      if (face.own == std::numeric_limits<double>::max() || face.shape_area <= 0. ||
          face.area <= 0.)
        return 0.;
      const Number mean = variable(Of::face_mean, face.gap * normal / face.area),
                   positive =
                     variable(Of::face_positive, face.shape_gap * normal / face.shape_area),
                   sagitta = variable(Of::face_own, face.own) -
                             length * variable(Of::face_beside, face.beside) - mean;
      // A face counts if it has a fair part of what the mean of the row is below its node.
      Number weight =
        variable(Of::face_area, face.area) * sagitta / (Tolerances::fair_part * whole * above);
      if (weight <= 0.)
        return 0.;
      if (weight > 1.)
        weight = 1.;
      const Number left = 0.5 * (positive - mean) / sagitta + Tolerances::odd_curvature;
      if (left >= 1.)
        return 0.;
      // 3/2 (1 - kappa)^2 up to the slope 3/2, from there on straight, and half as steep on faces
      // that are pressed beyond flat: of the sagitta of the row, or of so much of that of the face
      // that the node keeps a part of its own motion.
      constexpr double flat    = Tolerances::odd_curvature;
      const Number     part    = left >= 0.5    ? Number(1.5 * (1. - left) * (1. - left))
                                 : left >= flat ? Number(1.125 - 1.5 * left)
                                                : Number(1.125 - 0.75 * (flat + left));
      const Number     of_face = Tolerances::most_of_sagitta * sagitta;
      Number           taken   = part * (of_face < above ? of_face : above);
      if (taken > above)
        taken = above;
      taken *= weight;
      // Beside the node the mean is extrapolated: no more than the surfaces come closer on this
      // face than at the point next to the node.
      if (beside.val() == 0.)
        return taken;
      const Number most =
        (1. - Tolerances::above_least) * (at_node - variable(Of::face_least, face.least)) +
        above * (1. - beside);
      return taken < most ? taken : most;
    }
  } // namespace



  GapCorrection::GapCorrection(const CoverSums      &sums,
                               const Tensor<1, dim> &normal,
                               const double          mean,
                               const double          size)
  {
    // The corrections of equations (6) and (7) with derivatives by all that they depend on.
    const Number at_mean = variable(Of::mean_gap, mean), at_least = variable(Of::least, sums.least),
                 at_kept     = variable(Of::kept, sums.kept),
                 at_given    = variable(Of::given, sums.given),
                 at_inclined = variable(Of::inclined, mean_of(sums, sums.inclined));
    Number result            = 0.;
    // chi of section 3.1: whether anything near the node is covered.
    const Number from_node = variable(Of::beside, sums.beside);
    const Number near = 1. - smooth_step(from_node, Tolerances::near_node, Tolerances::far_of_node);
    const Number beside  = smooth_step(from_node, 0., Tolerances::clearly_beside);
    const Number at_node = variable(Of::own, sums.own) - sums.length * from_node;
    // On plane faces all gaps are the mean up to round-off, and the quotients below would be noise.
    const double noise = Tolerances::equal_gaps * size;
    if (const Number above = at_node - at_mean; near > 0. && above > noise)
      {
        Number most = 0.;
        for (const FaceShare &share : sums.faces)
          if (const Number taken = flattened(
                share, normal, sums.length, at_node, above, beside, variable(Of::area, sums.area));
              taken > most)
            {
              most = taken;
              face = &share;
            }
        // How much of the difference is due to the shape of the surfaces: displacements, which
        // meshes that do not match interpolate differently, make such differences all over a
        // contact, and rows that followed them would depend on their neighbours there.
        const Number shape = above - variable(Of::moved, normal * relative_motion(sums)),
                     arch  = variable(Of::arch, mean_of(sums, sums.arch)) +
                            (Tolerances::flat_arch * (1. - beside) +
                             Tolerances::flat_arch_beside * beside) *
                              size;
        const Number curved =
          smooth_step(Number(shape / arch), Tolerances::hardly_curved, Tolerances::well_curved);
        result += near * curved * (above - most);
      }
    if (const Number above = at_least - at_mean - result; above > noise)
      result +=
        above *
        smooth_step(Number(at_least / size), Tolerances::hardly_open, Tolerances::well_open);
    // 0.01 h r^4 of equation (6): the row opens before its area vanishes. Where other pairs cover
    // the rest it need not: parts are kept as a whole or not at all.
    if (const Number lost = loss(at_given, at_kept, at_inclined); lost > 0. && sums.shared < 1.)
      result += (1. - sums.shared) * Tolerances::gap_growth * size * lost * lost * lost * lost;
    const auto by    = [&result](const Of which) { return result.dx(static_cast<int>(which)); };
    value            = result.val();
    by_mean          = by(Of::mean_gap);
    by_least         = by(Of::least);
    by_own           = by(Of::own);
    by_beside        = by(Of::beside);
    by_kept          = by(Of::kept);
    by_given         = by(Of::given);
    by_area          = by(Of::area);
    by_moved         = by(Of::moved);
    by_arch          = by(Of::arch);
    by_inclined      = by(Of::inclined);
    by_face_mean     = by(Of::face_mean);
    by_face_positive = by(Of::face_positive);
    by_face_own      = by(Of::face_own);
    by_face_beside   = by(Of::face_beside);
    by_face_least    = by(Of::face_least);
    by_face_area     = by(Of::face_area);
  }



  AveragedRow::AveragedRow(const CoverSums &sums, const double size)
    : share(sums.area / sums.kept)
    , normal(sums.images * sums.normal / (sums.images * sums.normal).norm())
    , area(sums.area)
    , kept(sums.kept)
    , shape_area(sums.shape_area)
    , mean(sums.gap / sums.area)
    , normal_sum(sums.images * sums.normal)
    , images(sums.images)
    , own_moved(sums.own_moved)
    , moved(relative_motion(sums))
    , arch(mean_of(sums, sums.arch))
    , inclined(mean_of(sums, sums.inclined))
    , correction(sums, normal, mean * normal, size)
  {
    // Normalised by D_kk and not by D, like the weights of the stencil, so that gap and stencil
    // belong to the same constraint.
    gap_vector = share * (mean + correction.value * normal);
  }



  void
  AveragedRow::differentiate(const CoverSumsDerivative &d,
                             Tensor<2, dim>            &d_normal,
                             Tensor<2, dim>            &d_gap_vector) const
  {
    // n = N/|N|.
    d_normal = normalisation_derivative(normal_sum) * (images * d.normal);
    // Derivatives of the mean gap vector G/D, of the correction, and of the share D/D_kk by which
    // both are multiplied.
    const Tensor<2, dim> d_mean  = (d.gap - outer_product(mean, d.area)) / area;
    Tensor<1, dim>       d_value = correction.by_mean * (normal * d_mean + mean * d_normal) +
                             correction.by_least * d.least + correction.by_own * d.own +
                             correction.by_beside * d.beside + correction.by_kept * d.kept +
                             correction.by_given * d.given;
    d_value += correction.by_area * d.area;
    if (needs_shape())
      {
        const Tensor<1, dim> mean_moved = own_moved - moved;
        d_value += correction.by_moved *
                   (normal * (d.own_moved - (d.moved - outer_product(mean_moved, d.area)) / area) +
                    moved * d_normal);
        // Without a positive area the arch is taken as zero.
        if (shape_area > 0.)
          d_value += correction.by_arch * (d.arch - arch * d.shape_area) / shape_area;
      }
    if (shape_area > 0.)
      d_value += correction.by_inclined * (d.inclined - inclined * d.shape_area) / shape_area;
    if (const FaceShare *face = correction.face)
      {
        // Means of the face are quotients, too.
        const Tensor<1, dim> of_face  = face->gap / face->area,
                             positive = face->shape_gap / face->shape_area;
        d_value += correction.by_face_mean *
                   (normal * (d.face.gap - outer_product(of_face, d.face.area)) / face->area +
                    of_face * d_normal);
        d_value += correction.by_face_positive *
                   (normal * (d.face.shape_gap - outer_product(positive, d.face.shape_area)) /
                      face->shape_area +
                    positive * d_normal);
        d_value += correction.by_face_own * d.face.own + correction.by_face_beside * d.face.beside +
                   correction.by_face_least * d.face.least + correction.by_face_area * d.face.area;
      }
    const Tensor<1, dim> d_share = (d.area - share * d.kept) / kept;
    d_gap_vector                 = outer_product(mean + correction.value * normal, d_share) +
                   share * (d_mean + outer_product(normal, d_value) + correction.value * d_normal);
  }



  Tensor<1, dim>
  AveragedRow::weight_derivative(const double               weight,
                                 const Tensor<1, dim>      &d_integral,
                                 const CoverSumsDerivative &d) const
  {
    return (d_integral - weight * d.kept) / kept;
  }
} // namespace Touchstone
