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

// What does not turn with the surfaces of a pair: distances of tied pairs (doc/theory.md 4.6), and
// normals of small sliding.
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Errors that are reported: of the distance that a tied pair keeps, relative to the size of
     * the face, and of the moment of its forces, relative to these times the size of faces. */
    constexpr double of_distance = 1e-3, of_moment = 1e-2;

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
    rounded(const double value)
    {
      char text[24];
      std::snprintf(text, sizeof(text), "%.3g", value);
      return text;
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
            rotation(MeasuredFace::displaced(*slave.faces_around(row.slave).front().first, u));
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
                       rounded(worst.length) +
                       " that its surfaces are placed with does not turn with it: they are held "
                       "up to " +
                       rounded(worst.size) + " from where they must be" + remedy);
      else if (moment.norm() > of_moment * forces)
        told.push_back(name + "its forces pass the distance of up to " + rounded(longest) +
                       " that its surfaces are placed with without their moment: " +
                       rounded(moment.norm()) + " is missing in the balance of moments" + remedy);
    }



    /** Mean of 1 - cos(theta) over the normal forces of a pair, with theta the angle by which the
     * slave surface has turned. Collective. */
    double
    part_lost_by_turning(const Contact &contact, const ContactPair &pair)
    {
      const Surface &slave = pair.slave();
      const Vector  &u     = contact.ghosted_displacement();
      double         lost = 0., forces = 0.;
      for (const ContactRow &row : pair.rows())
        if (const RowState &state = contact.state(row);
            state.active() && state.lambda > 0. && !slave.faces_around(row.slave).empty())
          {
            const Tensor<2, dim> turn =
              rotation(MeasuredFace::displaced(*slave.faces_around(row.slave).front().first, u));
            // What turns about the normal keeps it.
            lost += state.lambda * (1. - row.normal * (turn * row.normal));
            forces += state.lambda;
          }
      lost   = Utilities::MPI::sum(lost, contact.communicator());
      forces = Utilities::MPI::sum(forces, contact.communicator());
      return forces > 0. ? lost / forces : 0.;
    }

    void
    tell_of_normals(const Contact &contact, const ContactPair &pair, EndFindings &told)
    {
      constexpr double tells_from = 1e-3, fails_from = 0.1;
      const double     part = part_lost_by_turning(contact, pair);
      if (part <= tells_from)
        return;
      const std::string what =
        "contact pair '" + pair.parameters().name + "': its slave surface has turned by " +
        rounded(std::acos(std::max(-1., 1. - part)) * 180. / numbers::PI) +
        " degrees on average, and with 'Sliding = small' normals and partners are those of the "
        "reference state. Take 'Sliding = finite'";
      told.add(what, part > fails_from);
    }
  } // namespace



  EndFindings
  turned_surfaces(const Contact &contact)
  {
    EndFindings result;
    for (unsigned int p = 0; p < contact.n_pairs(); ++p)
      {
        const ContactPair &pair = contact.pair(p);
        if (pair.master() && pair.tied())
          tell_of_distance(contact, pair, result.warnings);
        else if (pair.master() && pair.small_sliding())
          tell_of_normals(contact, pair, result);
      }
    return result;
  }
} // namespace Touchstone
