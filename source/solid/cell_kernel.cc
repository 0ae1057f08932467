// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/solid/cell_kernel.h>
#include <touchstone/solid/cell_loops.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>

#include <algorithm>

// Force and stiffness of one cell from an arbitrary material law, with or without averaging of
// the volume change over the cell (B-bar at small strain, F-bar at finite strain; doc/theory.md
// 2.1 and 2.2). What depends on the strain measure is left to SmallStrainKernel and
// FiniteStrainKernel; NonlinearCells loops over the cells.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Replace A by its part with major symmetry, A_iJkL = A_kLiJ. Solvers for symmetric systems
     * use it where the tangent is unsymmetric (recovery of the back stress, doc/materials.md):
     * Newton's method may then take more iterations, but the solution is the same, for the residual
     * is unchanged. */
    void
    symmetrise(Tensor<4, dim> &A)
    {
      for (unsigned int r = 0; r < dim * dim; ++r)
        for (unsigned int s = 0; s < r; ++s)
          {
            double &x = A[r / dim][r % dim][s / dim][s % dim];
            double &y = A[s / dim][s % dim][r / dim][r % dim];
            x = y = 0.5 * (x + y);
          }
    }

    /** Add the nodal forces stress . grad N_a to @p sum. */
    void
    add_product(const Tensor<2, dim> &stress,
                const double         *g,
                const unsigned int    n_nodes,
                std::vector<double>  &sum)
    {
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < dim; ++i)
          sum[dim * a + i] +=
            stress[i][0] * g[a] + stress[i][1] * g[n_nodes + a] + stress[i][2] * g[2 * n_nodes + a];
    }
  } // namespace



  CellKernel::CellKernel(const unsigned int                 degree,
                         std::shared_ptr<const MaterialLaw> material_law,
                         const bool                         averaged)
    : law(std::move(material_law))
    , averaged(averaged)
    , n_nodes(Utilities::pow(degree + 1, dim))
    , n_points(Utilities::pow(degree + 1, dim))
    , points(n_points)
    , mean_gradient(dim * n_nodes)
    , place((dim + 1) * dim * n_points)
    , motion(place.size())
    , virgin(n_points * law->n_state())
    , present_state(virgin.size())
    , nodal_force(dim * n_nodes)
    , blocks(dim * dim * n_nodes * n_nodes)
    , matrix(dim * dim * n_nodes * n_nodes)
    , left(dim * n_nodes)
    , right(dim * n_nodes)
  {
    // Shapes and gradients on the unit cell are the same for all cells and are tabulated once, in
    // the orders that the loops need.
    const QGauss<dim> quadrature(degree + 1);
    const FE_Q<dim>   fe(degree);
    unit_weights = quadrature.get_weights();
    gradients.resize(n_points * dim * n_nodes);
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int d = 0; d <= dim; ++d)
        for (unsigned int q = 0; q < n_points; ++q)
          tables.push_back(d < dim ? fe.shape_grad(a, quadrature.point(q))[d]
                                   : fe.shape_value(a, quadrature.point(q)));
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int a = 0; a < n_nodes; ++a)
          unit_gradients.push_back(fe.shape_grad(a, quadrature.point(q))[d]);
    start(virgin.data());
  }



  void
  CellKernel::start(double *state) const
  {
    for (unsigned int q = 0; q < n_points; ++q)
      law->start(state + q * law->n_state());
  }



  /** Set the geometry and the displacement of a cell: shape gradients with respect to reference
   * coordinates, displacement gradients and integration weights. Returns the smallest det F of
   * its points, 1 at small strain, by which the caller recognises inverted cells. Without
   * committed state the cell is in its virgin state. */
  double
  CellKernel::reinit(const double *positions, const double *displacement, const double *committed)
  {
    committed_state = committed ? committed : virgin.data();
    has_stress      = false;
    cell_volume     = 0.;
    // dX/dxi and X, du/dxi and u at all points: the cell is isoparametric.
    CellLoops::nodal_sums(n_nodes, positions, tables.data(), place.data());
    CellLoops::nodal_sums(n_nodes, displacement, tables.data(), motion.data());
    for (unsigned int q = 0; q < n_points; ++q)
      {
        PointData     &point = points[q];
        Tensor<2, dim> jacobian, unit_gradient;
        for (unsigned int i = 0; i < dim; ++i)
          {
            for (unsigned int d = 0; d < dim; ++d)
              {
                jacobian[i][d]      = place[((dim + 1) * i + d) * n_points + q];
                unit_gradient[i][d] = motion[((dim + 1) * i + d) * n_points + q];
              }
            point.position[i] = place[((dim + 1) * i + dim) * n_points + q];
          }
        const Tensor<2, dim> inverse = invert(jacobian);
        CellLoops::shape_gradients(n_nodes,
                                   &unit_gradients[q * dim * n_nodes],
                                   inverse,
                                   shape_gradient(q));
        point.weight   = unit_weights[q] * determinant(jacobian);
        point.gradient = unit_gradient * inverse;
        cell_volume += point.weight;
      }
    return deform();
  }



  bool
  CellKernel::admitted() const
  {
    for (unsigned int q = 0; q < n_points; ++q)
      if (const Tensor<2, dim> gradient = deformation(q);
          !law->admits({gradient, committed_state, step_length, points[q].position, time}))
        return false;
    return true;
  }



  /** Evaluate the law at all points from the committed state. The committed state is not touched,
   * so any number of evaluations gives the same answer: line search and repeated iterations leave
   * no trace in the history. */
  void
  CellKernel::respond(const Demand demand)
  {
    all_solved = true;
    has_stress = has_stress || demand != Demand::energy;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const unsigned int at = q * law->n_state();
        // Laws need to tell of failures only; that of another cell or attempt must not stay.
        points[q].response.solved = true;
        law->respond({deformation(q), committed_state + at, step_length, points[q].position, time},
                     demand,
                     points[q].response,
                     present_state.data() + at);
        all_solved = all_solved && points[q].response.solved;
      }
  }



  /** The energy whose derivative is force(): stored energy and, with plasticity, the plastic work
   * of the step (doc/materials.md, "Equations"); energy. */
  double
  CellKernel::energy()
  {
    respond(Demand::energy);
    double sum = 0.;
    for (const PointData &point : points)
      sum += point.weight * point.response.energy;
    return sum;
  }



  double
  CellKernel::elastic_energy()
  {
    respond(Demand::energy);
    double sum = 0.;
    for (const PointData &point : points)
      sum += point.weight * point.response.elastic_energy;
    return sum;
  }



  /** Internal forces of the nodes, f = int P : grad N dV. With averaging the mean volume change
   * theta of the cell is a variable of its own that depends on all nodes: points contribute to
   * the derivative by F at fixed theta, and the sum of their pressures multiplies d theta/du,
   * doc/theory.md 2.2, equation (1). */
  const std::vector<double> &
  CellKernel::force()
  {
    respond(Demand::stress);
    std::fill(nodal_force.begin(), nodal_force.end(), 0.);
    double pressure = 0.;
    for (unsigned int q = 0; q < n_points; ++q)
      add_product(points[q].weight * point_stress(q, pressure),
                  shape_gradient(q),
                  n_nodes,
                  nodal_force);
    if (averaged)
      {
        set_mean_gradient();
        for (unsigned int i = 0; i < n_dofs(); ++i)
          nodal_force[i] += pressure * mean_gradient[i];
      }
    return nodal_force;
  }



  /** The derivative of force(). With averaging it is, in the notation of doc/theory.md 2.2, the
   * sum of the blocks (F, F), (F, theta) and (theta, theta): the first is local to each point,
   * the others are products of the vector d theta/du ('mean_gradient') with point sums ('left',
   * 'right') and a scalar ('second'), and so are added after the loop over points instead of in
   * each of them. */
  const std::vector<double> &
  CellKernel::stiffness(const bool symmetric)
  {
    respond(Demand::tangent);
    const bool mirrored = symmetric || law->symmetric();
    std::fill(blocks.begin(), blocks.end(), 0.);
    double pressure = 0., second = 0.;
    if (averaged)
      {
        set_mean_gradient();
        std::fill(left.begin(), left.end(), 0.);
        std::fill(right.begin(), right.end(), 0.);
        // The second derivative of theta is multiplied by the pressure of the whole cell, so all
        // point pressures are summed before any tangent is modified.
        for (unsigned int q = 0; q < n_points; ++q)
          point_stress(q, pressure);
        second = mean_curvature(pressure);
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double    weight = points[q].weight;
        const double   *g      = shape_gradient(q);
        Tensor<4, dim> &A      = points[q].response.tangent;
        if (symmetric && !law->symmetric())
          symmetrise(A);
        if (averaged)
          {
            const MeanTerms terms = modify_tangent(q, pressure, A);
            add_product(weight * terms.left, g, n_nodes, left);
            add_product(weight * terms.right, g, n_nodes, right);
            second += weight * terms.second;
          }
        CellLoops::add_tangent(n_nodes, g, weight, A, mirrored, blocks.data());
      }
    // The blocks are reordered to a matrix by rows; where it is symmetric only node pairs a <= b
    // were computed.
    const unsigned int n = n_dofs();
    for (unsigned int a = 0; a < n_nodes; ++a)
      for (unsigned int b = mirrored ? a : 0; b < n_nodes; ++b)
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int k = 0; k < dim; ++k)
            {
              double value = blocks[((a * dim + i) * dim + k) * n_nodes + b];
              if (averaged)
                value += left[dim * a + i] * mean_gradient[dim * b + k] +
                         mean_gradient[dim * a + i] * right[dim * b + k] +
                         second * mean_gradient[dim * a + i] * mean_gradient[dim * b + k];
              matrix[(dim * a + i) * n + dim * b + k] = value;
              if (mirrored)
                matrix[(dim * b + k) * n + dim * a + i] = value;
            }
    return matrix;
  }
} // namespace Touchstone
