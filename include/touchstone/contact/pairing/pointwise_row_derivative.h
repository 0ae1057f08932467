// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_contact_pairing_pointwise_row_derivative_h
#define touchstone_contact_pairing_pointwise_row_derivative_h

#include <touchstone/contact/geometry/face_derivative.h>
#include <touchstone/contact/row.h>
#include <touchstone/contact/search/search.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  class RowDerivativeBuilder;

  /** @brief Derivative of the coordinates xi of a closest point by the position (or normal) of one
   * node. */
  using CoordinateDerivative = std::array<dealii::Tensor<1, dim>, 2>;

  /**
   * @brief The implicit derivative of the closest point: t_a . r = 0 gives
   * (t_a . t_b - r . x,ab) d xi_b = t_a . d r + r . d t_a at a fixed xi (doc/theory.md 4,
   * equation (9)). A coordinate that is held at an edge does not change.
   */
  class ClosestPointDerivative
  {
  public:
    ClosestPointDerivative(const FaceGeometry           &geometry,
                           const std::array<double, 2>  &xi,
                           const FacePoint              &point,
                           const dealii::Tensor<1, dim> &r);

    CoordinateDerivative
    operator()(const dealii::Tensor<1, dim> &right_0, const dealii::Tensor<1, dim> &right_1) const
    {
      return {{inverse[0][0] * right_0 + inverse[0][1] * right_1,
               inverse[1][0] * right_0 + inverse[1][1] * right_1}};
    }

  private:
    double inverse[2][2] = {{0., 0.}, {0., 0.}};
  };

  /**
   * @brief The derivative of the row of a point against its closest point on a face: each node has
   * a direct effect on gap vector and normal at a fixed xi, and one through the coordinates xi of
   * the closest point (doc/theory.md 4, "Derivatives of rows").
   */
  class PointwiseRowDerivative
  {
  public:
    /** @param geometry, partner Must live as long.
     * @param master     The point that the partner is, with the normal of the row.
     * @param gap_vector r, length. */
    PointwiseRowDerivative(const FaceGeometry           &geometry,
                           const ContactPartner         &partner,
                           const FaceDerivative         &master,
                           const dealii::Tensor<1, dim> &gap_vector);

    /** @brief Whether the weight of node @p m of the face changes with the point. */
    bool
    weight_changes(const unsigned int m) const
    {
      return (master.shapes.gradient[m][0] * by_slave[0] +
              master.shapes.gradient[m][1] * by_slave[1])
               .norm() > 0.;
    }

    /** @brief Add this derivative times @p part. @param slave The node at the point.
     * @param stencil Nodes of the face, and maybe others.
     * @param of_normals Derivatives of the nodal normals of the face, or null. */
    void
    compute(Index                                slave,
            const Stencil                       &stencil,
            double                               part,
            const std::vector<NormalDerivative> *of_normals,
            RowDerivativeBuilder                &builder) const;

  private:
    const FaceGeometry          &geometry;
    const ContactPartner        &partner;
    const dealii::Tensor<1, dim> r;
    const FaceDerivative         master;
    const ClosestPointDerivative closest;
    const CoordinateDerivative   by_slave;
    /** Over an edge the normal is the direction of the gap vector; zero elsewhere. */
    const dealii::Tensor<2, dim> by_gap_vector;

    /** d xi, where the point at a fixed xi moves by @p x and its tangents by the others. */
    CoordinateDerivative
    coordinates(const dealii::Tensor<2, dim> &x,
                const dealii::Tensor<2, dim> &t_0,
                const dealii::Tensor<2, dim> &t_1) const
    {
      const auto &t = master.point.tangents;
      return closest(r * t_0 - t[0] * x, r * t_1 - t[1] * x);
    }

    /** Add the effect of a node: that on gap vector and normal at a fixed xi, and that on xi.
     * @param local Numbers on the face of the nodes of the stencil.
     * @param chain What the node moves, by its position; null for itself. */
    void
    add(Index                            node,
        const dealii::Tensor<2, dim>    &gap_vector,
        const dealii::Tensor<2, dim>    &normal,
        const CoordinateDerivative      &xi,
        const dealii::Tensor<2, dim>    *chain,
        const std::vector<unsigned int> &local,
        double                           part,
        RowDerivativeBuilder            &builder) const;
  };
} // namespace Touchstone

#endif
