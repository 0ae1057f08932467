// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exact_sum.h>
#include <touchstone/explicit/impulse_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Conjugate gradients on the face that sweeps have found, as in impulse_faces.cc, where forces act
// along the normals of all rows (doc/explicit.md, section 9.2): what impulses of a direction change
// is a product with the mobilities alone, without the velocities that are there.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Its impulse may change on the face. */
    bool
    may_change(const NormalRows::Row &row)
    {
      return row.mobility > 0. && row.impulse > 0.;
    }
  } // namespace



  void
  ImpulseSolver::respond_normal(double NormalRows::Row::*const impulse)
  {
    normal_rows.sum(impulse);
    sum_shared_entries(impulse);
    normal_rows.respond(nodes.n_owned());
    if (!nodes.alone())
      nodes.forward(normal_rows.velocity);
  }



  // As long as it stays on the face and has not come to the minimum there. Of the impulses that
  // sweeps go on from nothing is needed meanwhile: they are the direction and the residual.
  void
  ImpulseSolver::explore_normal_face(const ImpulseControl &control,
                                     const double          tolerance,
                                     ImpulseCounts        &counts)
  {
    using Part                                 = double           NormalRows::Row::*;
    constexpr Part                direction    = &NormalRows::Row::extrapolated;
    constexpr Part                residual     = &NormalRows::Row::present;
    const MPI_Comm                communicator = nodes.communicator();
    const unsigned int            n            = normal_rows.size();
    std::vector<NormalRows::Row> &acting       = normal_rows.rows;
    const auto                    dot          = [&](const auto &term) {
      ExactSum sum;
      for (unsigned int i = 0; i < n; ++i)
        sum.add(term(i));
      return sum.value(communicator);
    };
    apply_normal(&NormalRows::Row::impulse);
    normal_rows.along_normals(along);
    scaled.resize(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        NormalRows::Row &row = acting[i];
        row.*residual        = may_change(row) ? -(row.allowed - row.drive + along[i]) : 0.;
        row.*direction = scaled[i] = may_change(row) ? row.*residual / row.mobility : 0.;
      }
    double size = dot([&](const unsigned int i) { return acting[i].*residual * scaled[i]; });
    for (unsigned int k = 0; k < control.sweeps && size > 0.; ++k)
      {
        ++counts.on_faces;
        respond_normal(direction);
        normal_rows.along_normals(along);
        for (unsigned int i = 0; i < n; ++i)
          if (!may_change(acting[i]))
            along[i] = 0.;
        const double curvature =
          dot([&](const unsigned int i) { return acting[i].*direction * along[i]; });
        if (!(curvature > 0.))
          break;
        const double step = size / curvature;
        double       most = std::numeric_limits<double>::max(), left = 0.;
        for (unsigned int i = 0; i < n; ++i)
          if (acting[i].*direction < 0.)
            most = std::min(most, acting[i].impulse / -(acting[i].*direction));
        const double allowed = std::min(step, Utilities::MPI::min(most, communicator));
        for (unsigned int i = 0; i < n; ++i)
          {
            acting[i].impulse += allowed * (acting[i].*direction);
            acting[i].*residual -= allowed * along[i];
            left = std::max(left, std::abs(acting[i].*residual));
          }
        if (allowed < step || Utilities::MPI::max(left, communicator) <= 0.1 * tolerance)
          break; // at the edge of the face, or at the minimum
        for (unsigned int i = 0; i < n; ++i)
          scaled[i] = may_change(acting[i]) ? acting[i].*residual / acting[i].mobility : 0.;
        const double next =
          dot([&](const unsigned int i) { return acting[i].*residual * scaled[i]; });
        for (unsigned int i = 0; i < n; ++i)
          acting[i].*direction = scaled[i] + (next / size) * (acting[i].*direction);
        size = next;
      }
    for (NormalRows::Row &row : acting)
      row.extrapolated = row.present = row.impulse;
  }
} // namespace Touchstone
