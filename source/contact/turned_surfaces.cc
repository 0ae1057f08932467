// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/contact/geometry/measured_face.h>
#include <touchstone/contact/pairing/linear_rows.h>
#include <touchstone/contact/turned_surfaces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

// What does not turn with the surfaces of a pair: arches over facets and distances of tied pairs
// (doc/theory.md 4.6).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Errors that are reported: of the gap and, with friction, of a place on the surface, relative
     * to the size of the face; of the distance that a tied pair keeps, in the same way; and of the
     * moment of its forces, relative to these times the size of faces. */
    constexpr double of_gap = 2e-4, of_place = 5e-3, of_distance = 1e-3, of_moment = 1e-2;

    /** An error, length, at a place, with the angle by which the surface has turned there and the
     * length that has not. The largest first, of equal ones that with the largest coordinates. */
    struct Error
    {
      /** Relative to the error that is reported. */
      double     part = 0.;
      double     size = 0., length = 0., angle = 0.;
      Point<dim> x;

      bool
      operator>(const Error &other) const
      {
        return part != other.part
                 ? part > other.part
                 : std::lexicographical_compare(&other.x[0], &other.x[0] + dim, &x[0], &x[0] + dim);
      }
    };

    Error
    largest(const Error &own, const MPI_Comm communicator)
    {
      Error result;
      for (const Error &error :
           gather_all(own.part > 1. ? std::vector<Error>{own} : std::vector<Error>(), communicator))
        if (error > result)
          result = error;
      return result;
    }



    /** Tangents and normal at the middle of a facet, as columns. */
    Tensor<2, dim>
    frame(const Face &face)
    {
      const FacePoint      middle = evaluate(face, nullptr, {{0., 0.}});
      const Tensor<1, dim> normal = middle.normal();
      Tensor<2, dim>       result;
      for (unsigned int d = 0; d < dim; ++d)
        {
          result[d][0] = middle.tangents[0][d];
          result[d][1] = middle.tangents[1][d];
          result[d][2] = normal[d];
        }
      return result;
    }

    /** How a facet has turned since the reference state. */
    Tensor<2, dim>
    rotation(const Face &face)
    {
      return project_onto_orthogonal_tensors(frame(face) *
                                             invert(frame(MeasuredFace::in_reference(face))));
    }

    /** A face with the displacement @p u: surfaces of tied pairs are not moved. */
    Face
    displaced(Face face, const Vector &u)
    {
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        for (unsigned int d = 0; d < dim; ++d)
          face.displacement[m][d] = u(dim * face.nodes[m] + d);
      return face;
    }

    double
    angle(const Tensor<2, dim> &rotation)
    {
      return std::acos(std::clamp(0.5 * (trace(rotation) - 1.), -1., 1.)) * 180. / numbers::PI;
    }

    /** What has not turned with a length. */
    Tensor<1, dim>
    missed(const Tensor<2, dim> &rotation, const Tensor<1, dim> &length)
    {
      return rotation * length - length;
    }



    /** Marks the nodes of rows of a pair that carry a force, also those of other ranks: their first
     * dofs are not zero. Collective. */
    Vector
    loaded_nodes(const Contact &contact, const ContactPair &pair)
    {
      std::vector<Index> dofs;
      for (const ContactRow &row : pair.rows())
        if (row.has_partner && contact.state(row).force.norm() > 0.)
          {
            dofs.push_back(dim * row.slave);
            for (const StencilEntry &entry : row.stencil)
              dofs.push_back(dim * entry.node);
          }
      Vector result = contact.solid_model().zero_vector();
      result.add(dofs, std::vector<double>(dofs.size(), 1.));
      result.compress(VectorOperation::add);
      return contact.with_ghosts(result);
    }

    /** The largest error of the arches over the faces of a surface that carry a force. */
    Error
    error_of_arches(const Surface &surface, const Vector &loaded, const bool friction)
    {
      Error worst;
      for (const Face &face : surface.owned_faces())
        {
          const AnalyticSurface *const exact = surface.exact_surface(face);
          if (exact == nullptr ||
              std::none_of(face.nodes.begin(),
                           face.nodes.begin() + face.n_nodes(),
                           [&](const Index node) { return loaded(dim * node) != 0.; }))
            continue;
          const Face           reference = MeasuredFace::in_reference(face);
          const FacePoint      middle    = evaluate(face, nullptr, {{0., 0.}});
          const Tensor<2, dim> turn      = rotation(face);
          const double         size =
            2. * std::sqrt(cross_product_3d(middle.tangents[0], middle.tangents[1]).norm());
          for (const std::array<double, 2> &xi : std::array<std::array<double, 2>, 5>{
                 {{{0., 0.}}, {{-1., 0.}}, {{1., 0.}}, {{0., -1.}}, {{0., 1.}}}})
            {
              const Point<dim>     facet = evaluate(reference, nullptr, xi).x;
              const Tensor<1, dim> arch = exact->project(facet) - facet, error = missed(turn, arch);
              const double         normal = std::abs(error * middle.normal()), along = error.norm();
              const double         part =
                std::max(normal / of_gap, friction ? along / of_place : 0.) / size;
              const Error here{part, friction ? along : normal, arch.norm(), angle(turn), middle.x};
              if (here > worst)
                worst = here;
            }
        }
      return worst;
    }

    std::string
    described(const Error &error)
    {
      char text[160];
      std::snprintf(text,
                    sizeof(text),
                    " at (%.3g, %.3g, %.3g) has turned by %.3g degrees",
                    error.x[0] + 0.,
                    error.x[1] + 0.,
                    error.x[2] + 0.,
                    error.angle);
      return std::string("its surface") + text;
    }

    std::string
    number(const double value)
    {
      char text[24];
      std::snprintf(text, sizeof(text), "%.3g", value);
      return text;
    }

    void
    tell_of_arches(const Contact &contact, const ContactPair &pair, std::vector<std::string> &told)
    {
      const auto  &rows     = pair.rows();
      const bool   friction = std::any_of(rows.begin(), rows.end(), [](const ContactRow &row) {
        return row.friction != nullptr;
      });
      const Vector loaded   = loaded_nodes(contact, pair);
      const Error  worst    = largest(std::max(error_of_arches(pair.slave(), loaded, friction),
                                           error_of_arches(*pair.master(), loaded, friction),
                                           [](const Error &a, const Error &b) { return b > a; }),
                                  contact.communicator());
      if (worst.part == 0.)
        return;
      told.push_back("contact pair '" + pair.parameters().name + "': " + described(worst) +
                     ", but the exact surface over its faces, whose arches are up to " +
                     number(worst.length) + " high, does not turn with them: gaps" +
                     (friction ? " and slips" : "") + " are off by up to " + number(worst.size) +
                     ". Use 'Contact geometry = faceted' with 'Master normal = smoothed', which "
                     "turn, or a finer mesh");
    }



    void
    tell_of_distance(const Contact            &contact,
                     const ContactPair        &pair,
                     std::vector<std::string> &told)
    {
      Error               worst;
      Tensor<1, dim>      moment;
      double              forces    = 0.;
      const Surface      &slave     = pair.slave();
      const Vector       &u         = contact.ghosted_displacement();
      const Vector        positions = row_positions(contact.solid_model(), pair.rows());
      std::vector<double> lengths{0.};
      for (const ContactRow &row : pair.rows())
        {
          if (!row.has_partner)
            continue;
          const Tensor<1, dim> distance = row_offset(row, positions),
                               force    = contact.state(row).force;
          moment += cross_product_3d(distance, force);
          forces += force.norm() * row.size;
          lengths.push_back(distance.norm());
          const Tensor<2, dim> turn =
            rotation(displaced(*slave.faces_around(row.slave).front().first, u));
          const double error = missed(turn, distance).norm();
          const Error  here{
            error / (of_distance * row.size), error, distance.norm(), angle(turn), row.position};
          if (here > worst)
            worst = here;
        }
      const MPI_Comm communicator = contact.communicator();
      worst                       = largest(worst, communicator);
      moment                      = Utilities::MPI::sum(moment, communicator);
      forces                      = Utilities::MPI::sum(forces, communicator);
      const double longest =
        Utilities::MPI::max(*std::max_element(lengths.begin(), lengths.end()), communicator);
      const std::string name = "tied pair '" + pair.parameters().name + "': ",
                        remedy =
                          ". Place the bodies so that nodes lie on the other surface: matching or "
                          "finer meshes where it is curved, no gap";
      if (worst.part > 0.)
        told.push_back(name + described(worst) + ", but the distance of up to " +
                       number(worst.length) +
                       " that its surfaces are placed with does not turn with it: they are held "
                       "up to " +
                       number(worst.size) + " from where they must be" + remedy);
      else if (moment.norm() > of_moment * forces)
        told.push_back(name + "its forces pass the distance of up to " + number(longest) +
                       " that its surfaces are placed with without their moment: " +
                       number(moment.norm()) + " is missing in the balance of moments" + remedy);
    }
  } // namespace



  std::vector<std::string>
  turned_surfaces(const Contact &contact)
  {
    std::vector<std::string> result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (!pair.master())
          continue;
        if (pair.tied())
          tell_of_distance(contact, pair, result);
        else if (!pair.small_sliding())
          tell_of_arches(contact, pair, result);
      }
    return result;
  }
} // namespace Touchstone
