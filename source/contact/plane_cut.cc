// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/base/exchange.h>
#include <touchstone/contact/geometry/face_area.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/plane_cut.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// The normal along which the sides of a bolt are drawn together (doc/theory.md 4.3).
namespace Touchstone
{
  using namespace dealii;

  PlaneCut::PlaneCut(const Surface &slave, const bool turns, const MPI_Comm communicator)
    : slave(slave)
    , turns(turns)
    , communicator(communicator)
    , reference(area_vector(nullptr))
  {
    ExactSum sum;
    for (const Face &face : slave.owned_faces())
      sum.add(face_area(MeasuredFace::in_reference(face)));
    area = sum.value(communicator);
  }



  Tensor<1, dim>
  PlaneCut::area_vector(const Vector *u) const
  {
    // The same bits on all ranks, however many there are: the normal decides where all nodes go.
    std::array<ExactSum, dim> sum;
    for (const Face &face : slave.owned_faces())
      {
        const Tensor<1, dim> of_face = Touchstone::area_vector(
          u != nullptr ? MeasuredFace::displaced(face, *u) : MeasuredFace::in_reference(face));
        for (unsigned int d = 0; d < dim; ++d)
          sum[d].add(of_face[d]);
      }
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = sum[d].value(communicator);
    return result;
  }



  std::pair<double, double>
  PlaneCut::height_and_size() const
  {
    constexpr double            infinity = std::numeric_limits<double>::infinity();
    std::array<double, 1 + dim> low, high;
    const double                length = reference.norm();
    low.fill(infinity);
    high.fill(-infinity);
    for (const SurfaceNode &node : slave.owned_nodes())
      for (unsigned int k = 0; k <= dim; ++k)
        {
          const double x =
            k < dim ? node.reference[k] : reference * Tensor<1, dim>(node.reference) / length;
          low[k]  = std::min(low[k], x);
          high[k] = std::max(high[k], x);
        }
    double size = 0.;
    for (unsigned int k = 0; k <= dim; ++k)
      {
        low[k]  = Utilities::MPI::min(low[k], communicator);
        high[k] = Utilities::MPI::max(high[k], communicator);
        size += k < dim ? std::pow(high[k] - low[k], 2) : 0.;
      }
    // Of a closed surface the sum vanishes up to round-off, of a slot with two sides as well.
    return {length < 0.5 * area ? infinity : high[dim] - low[dim], std::sqrt(size)};
  }



  void
  PlaneCut::set_planes_of_symmetry(const std::vector<Tensor<1, dim>> &planes)
  {
    // Planes that the cut is not at right angles to have another cut behind them.
    constexpr double            right_angle = 1e-3;
    std::vector<Tensor<1, dim>> all         = gather_all(planes, communicator);
    std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
      return std::lexicographical_compare(a.begin_raw(), a.end_raw(), b.begin_raw(), b.end_raw());
    });
    across.clear();
    for (Tensor<1, dim> plane : all)
      {
        if (std::abs(plane * reference) > right_angle * reference.norm())
          continue;
        for (const Tensor<1, dim> &direction : across)
          plane -= (plane * direction) * direction;
        if (plane.norm() > right_angle)
          across.push_back(plane / plane.norm());
      }
  }



  Tensor<1, dim>
  PlaneCut::normal(const Vector &u) const
  {
    Tensor<1, dim> result = turns ? area_vector(&u) : reference;
    for (const Tensor<1, dim> &direction : across)
      result -= (result * direction) * direction;
    return -result / result.norm();
  }



  bool
  PlaneCut::Layer::contains(const Point<dim> &x) const
  {
    constexpr double beside = 0.5;
    const double     height = (x - place) * normal;
    return height >= -beside * thickness && height <= (1. + beside) * thickness;
  }



  PlaneCut::Layer
  PlaneCut::taken_out(const Vector &u) const
  {
    std::array<ExactSum, dim + 1> sum;
    for (const SurfaceNode &node : slave.owned_nodes())
      {
        for (unsigned int d = 0; d < dim; ++d)
          sum[d].add(node.reference[d] + u(dim * node.node + d));
        sum[dim].add(1.);
      }
    const double n = sum[dim].value(communicator);
    Layer        result;
    for (unsigned int d = 0; d < dim; ++d)
      result.place[d] = sum[d].value(communicator) / n;
    result.normal    = normal(u);
    result.thickness = shortening;
    return result;
  }
} // namespace Touchstone
