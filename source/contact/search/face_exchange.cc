// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/base/exchange.h>
#include <touchstone/base/near_ranks.h>
#include <touchstone/contact/search/face_exchange.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// Sends each master face to the ranks whose slave nodes it may meet (doc/theory.md 4, "Search"),
// once per update of the contact rows, and derivatives of averaged normals back on request. Both
// bodies of a pair are partitioned without regard to the contact, so the master face of a slave
// node may lie on any rank.
namespace Touchstone
{
  using namespace dealii;

  FaceExchange::FaceExchange(const Surface     &surface,
                             const double       reach,
                             const MasterNormal kind,
                             const MPI_Comm     communicator,
                             const Arch         arch)
    : surface(surface)
    , reach(reach)
    , kind(kind)
    , communicator(communicator)
    , arch(arch)
  {
  }



  FaceExchange::Box
  FaceExchange::box(const Face &face, const Displacements &displacement) const
  {
    Point<dim> lower, upper;
    for (unsigned int m = 0; m < face.n_nodes(); ++m)
      {
        const Point<dim> x = face.reference[m] + displacement[m];
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = m == 0 ? x[d] : std::min(lower[d], x[d]);
            upper[d] = m == 0 ? x[d] : std::max(upper[d], x[d]);
          }
      }
    // A curved face reaches beyond its nodes: by less than half its size, or it
    // would be bent by more than a right angle.
    const bool   curved = face.degree > 1 || kind == MasterNormal::smoothed;
    const double margin = 0.25 * lower.distance(upper) * (curved ? 1. : 0.5);
    // The size of the face is the diagonal of its box, so no direction is left without a margin,
    // even if the face is plane.
    Box result({lower, upper});
    result.extend(margin);
    return result;
  }



  FaceExchange::Box
  FaceExchange::box(const Face &face) const
  {
    return box(face, face.displacement);
  }



  FaceExchange::Box
  FaceExchange::committed_box(const Face &face) const
  {
    return box(face, face.committed);
  }



  FaceExchange::Box
  FaceExchange::swept_box(const Face &face) const
  {
    Box result = box(face);
    // The box around the first and the last position has all intermediate ones, too, since nodes
    // move on straight lines.
    if (has_committed)
      result.merge_with(committed_box(face));
    return result;
  }



  void
  FaceExchange::commit(const Vector *u)
  {
    has_committed                = true;
    const std::vector<Face> &own = surface.owned_faces();
    committed.clear();
    committed.reserve(own.empty() ? 0 : own.size() * own.front().n_nodes());
    for (const Face &face : own)
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        {
          // Null: zero, the reference state.
          committed.emplace_back();
          for (unsigned int d = 0; d < dim && u != nullptr; ++d)
            committed.back()[d] = (*u)(dim * face.nodes[m] + d);
        }
  }



  Face
  FaceExchange::own_face(const std::size_t f) const
  {
    // Faces of the surface know their present displacement only.
    Face face = surface.owned_faces()[f];
    if (!committed.empty())
      std::copy_n(committed.begin() + f * face.n_nodes(), face.n_nodes(), face.committed.begin());
    return face;
  }



  void
  FaceExchange::update(const std::vector<Point<dim>> &positions)
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      keep_own_faces();
    else
      exchange_faces(positions);
    measure_motion();
  }



  void
  FaceExchange::forget()
  {
    std::vector<Face>().swap(known);
    by_key.clear();
    sent.clear();
    received.clear();
  }



  // On one rank all faces are kept in their order, without boxes. Faces are large: only what
  // changes is copied.
  void
  FaceExchange::keep_own_faces()
  {
    const std::vector<Face> &own = surface.owned_faces();
    if (known.size() != own.size())
      {
        known = own;
        by_key.clear();
      }
    for (std::size_t f = 0; f < own.size(); ++f)
      for (unsigned int m = 0; m < own[f].n_nodes(); ++m)
        {
          known[f].displacement[m] = own[f].displacement[m];
          known[f].normals[m]      = own[f].normals[m];
          known[f].edge_normals[m] = own[f].edge_normals[m];
          known[f].own_normals[m]  = own[f].own_normals[m];
          known[f].made_normals[m] = own[f].made_normals[m];
          if (!committed.empty())
            known[f].committed[m] = committed[f * own[f].n_nodes() + m];
        }
  }



  void
  FaceExchange::measure_motion()
  {
    least_moved = most_moved = Tensor<1, dim>();
    if (!has_committed)
      return;
    for (const Face &face : known)
      for (unsigned int m = 0; m < face.n_nodes(); ++m)
        for (unsigned int d = 0; d < dim; ++d)
          {
            const double moved = face.displacement[m][d] - face.committed[m][d];
            least_moved[d]     = std::min(least_moved[d], moved);
            most_moved[d]      = std::max(most_moved[d], moved);
          }
  }



  void
  FaceExchange::exchange_faces(const std::vector<Point<dim>> &positions)
  {
    known.clear();
    by_key.clear();
    sent.clear();
    received.clear();
    const unsigned int this_rank = Utilities::MPI::this_mpi_process(communicator);
    std::vector<Face>  own;
    std::vector<Box>   boxes, around_slaves;
    for (std::size_t f = 0; f < surface.owned_faces().size(); ++f)
      {
        // The swept box: also faces that were near at the start of the step are of interest.
        own.push_back(own_face(f));
        boxes.push_back(swept_box(own.back()));
      }
    for (const Point<dim> &x : positions)
      {
        around_slaves.push_back(Box({x, x}));
        around_slaves.back().extend(reach);
      }
    std::map<unsigned int, std::vector<Face>> messages;
    const auto ranks = near_ranks(around_slaves, boxes, communicator);
    for (std::size_t f = 0; f < own.size(); ++f)
      for (const unsigned int rank : ranks[f])
        {
          // The order in which faces are sent to a rank identifies them in normal_derivatives().
          sent[rank].push_back(f);
          if (rank == this_rank)
            known.push_back(own[f]);
          else
            messages[rank].push_back(own[f]);
        }
    // Faces of one rank are contiguous in "known"; "received" has where they begin.
    if (!known.empty())
      received[this_rank] = 0;
    for (const auto &[rank, faces] : messages)
      {
        ++counted.messages;
        counted.faces_sent += faces.size();
      }
    for (const auto &[rank, faces] : exchange_records(messages, communicator))
      {
        received[rank] = known.size();
        known.insert(known.end(), faces.begin(), faces.end());
      }
  }



  const Face *
  FaceExchange::face(const std::uint64_t key) const
  {
    // Built on demand, since most updates look no face up.
    if (by_key.empty())
      for (std::size_t i = 0; i < known.size(); ++i)
        by_key.emplace(known[i].key, i);
    const auto found = by_key.find(key);
    return found == by_key.end() ? nullptr : &known[found->second];
  }



  namespace
  {
    /** A NormalDerivative of a face, known by its index in what was sent to the other rank. */
    struct DerivativeOfFace
    {
      std::size_t      face;
      NormalDerivative derivative;
    };
  } // namespace



  std::unordered_map<const Face *, std::vector<NormalDerivative>>
  FaceExchange::normal_derivatives(const std::vector<const Face *> &needed) const
  {
    std::unordered_map<const Face *, std::vector<NormalDerivative>> result;
    // Each face once, also with an empty result if it has no derivative.
    for (const Face *face : needed)
      result[face];
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      {
        for (auto &[face, derivative] : result)
          derivative = surface.normal_derivative(surface.owned_faces()[index(*face)]);
        return result;
      }

    // Averaged normals at the edge of a rank depend on faces that only the owner of the face knows.
    // So each rank asks the owners for the derivatives; all ranks take part in both exchanges, also
    // those without a question.
    std::map<unsigned int, std::vector<std::size_t>> questions;
    for (const auto &[face, derivative] : result)
      {
        // The rank whose faces begin last before this one.
        const std::size_t f    = index(*face);
        auto              from = received.end();
        for (auto it = received.begin(); it != received.end(); ++it)
          if (it->second <= f && (from == received.end() || it->second > from->second))
            from = it;
        // The index among the faces that this rank has sent.
        questions[from->first].push_back(f - from->second);
      }
    // Owners answer by the index in what they have sent.
    std::map<unsigned int, std::vector<DerivativeOfFace>> answers;
    for (const auto &[rank, faces] : exchange_records(questions, communicator))
      for (const std::size_t f : faces)
        for (const NormalDerivative &derivative :
             surface.normal_derivative(surface.owned_faces()[sent.at(rank)[f]]))
          answers[rank].push_back({f, derivative});
    for (const auto &[rank, list] : exchange_records(answers, communicator))
      for (const DerivativeOfFace &answer : list)
        result[&known[received.at(rank) + answer.face]].push_back(answer.derivative);
    return result;
  }
} // namespace Touchstone
