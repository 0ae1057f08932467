// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/contact/pairing/linear_rows.h>
#include <touchstone/contact/tolerances.h>
#include <touchstone/solid/node_positions.h>

#include <algorithm>
#include <cmath>

// Rows of tied pairs that are exact for linear displacements (doc/theory.md 4.6).
namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** The eight corners of a cell. */
    constexpr unsigned int n_corners = 8;

    /** How far means of points of the master may lie beyond its edge, as a fraction of the face:
     * weights of either sign extrapolate where the surface is curved. */
    constexpr double beyond_edge = 1.;

    void
    add_node(const Index node, IndexSet &dofs)
    {
      dofs.add_range(dim * node, dim * node + dim);
    }

    Tensor<1, dim>
    at_node(const Vector &positions, const Index node)
    {
      Tensor<1, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = positions(dim * node + d);
      return result;
    }

    /** A copy of a vector of owned dofs with further ones. Collective. */
    Vector
    with_dofs(const Solid &solid, const Vector &owned, IndexSet &dofs)
    {
      dofs.compress();
      Vector result;
      result.reinit(solid.owned, dofs, solid.communicator);
      result = owned;
      return result;
    }

    /** Positions of hanging nodes follow those of others. */
    Vector
    conforming_positions(const Solid &solid)
    {
      Vector result = node_positions(solid);
      solid.hanging.distribute(result);
      return result;
    }

    Vector
    with_stencils(const Solid &solid, const Vector &owned, const std::vector<ContactRow> &rows)
    {
      IndexSet needed = solid.relevant;
      for (const ContactRow &row : rows)
        for (const StencilEntry &entry : row.stencil)
          add_node(entry.node, needed);
      return with_dofs(solid, owned, needed);
    }



    /** Derivatives of the trilinear shape functions of a cell at a point of its face, by xi_1 and
     * xi_2 along the face and by xi_3 from the face to what lies behind it, from 0 to 1. */
    std::array<Tensor<1, dim>, n_corners>
    unit_gradients(const std::array<double, 2> &xi)
    {
      const FaceShapes                      shapes(1, xi);
      std::array<Tensor<1, dim>, n_corners> result;
      for (unsigned int m = 0; m < Face::behind; ++m)
        {
          result[m] =
            Tensor<1, dim>({shapes.gradient[m][0], shapes.gradient[m][1], -shapes.value[m]});
          result[Face::behind + m][2] = shapes.value[m];
        }
      return result;
    }



    /** A row with an offset, and the point of the master where it is. */
    struct RowWithOffset
    {
      ContactRow    &row;
      Tensor<1, dim> offset;
      ContactPartner partner;
    };

    /** Add the weights of the change of the displacement over the offset in the cell behind a face,
     * times @p part. @return whether the cell has a volume there. */
    bool
    add_gradient(const ContactPartner &at,
                 const Tensor<1, dim> &offset,
                 const double          part,
                 const Vector         &positions,
                 Stencil              &stencil)
    {
      const auto     gradients = unit_gradients(at.xi);
      Tensor<2, dim> jacobian;
      for (unsigned int c = 0; c < n_corners; ++c)
        jacobian += outer_product(at_node(positions, at.face->cell_node(c)), gradients[c]);
      if (std::abs(determinant(jacobian)) <= Tolerances::flat_cell * std::pow(jacobian.norm(), dim))
        return false;
      const Tensor<1, dim> along = invert(jacobian) * offset;
      for (unsigned int c = 0; c < n_corners; ++c)
        {
          const Index  node   = at.face->cell_node(c);
          const double weight = part * (gradients[c] * along);
          const auto   found  = std::find_if(stencil.begin(),
                                          stencil.end(),
                                          [node](const StencilEntry &e) { return e.node == node; });
          if (found != stencil.end())
            found->weight += weight;
          else if (std::abs(weight) > Tolerances::negligible_weight)
            stencil.push_back({node, weight});
        }
      return true;
    }

    /** The offset is that which the mean of the gradients in all cells carries that meet at the
     * point: of a node over a node the cells around it are equal. */
    void
    carry_offset(const RowWithOffset &of, const Vector &positions)
    {
      std::vector<ContactPartner> cells = of.partner.others;
      cells.push_back(of.partner);
      Stencil result = of.row.stencil;
      for (const ContactPartner &cell : cells)
        if (!add_gradient(cell, of.offset, 1. / cells.size(), positions, result))
          return;
      of.row.at_surface = std::make_shared<const Stencil>(of.row.stencil);
      of.row.stencil    = result;
    }



    /** Rows with an offset, each with the place of its contact point in the faces of @p search.
     * Collective. */
    std::vector<RowWithOffset>
    rows_with_offset(Search &search, const Vector &positions, std::vector<ContactRow> &rows)
    {
      std::vector<RowWithOffset> result;
      std::vector<Point<dim>>    places;
      for (ContactRow &row : rows)
        if (row.has_partner && !row.stencil.empty())
          if (const Tensor<1, dim> offset = row_offset(row, positions);
              offset.norm() > Tolerances::no_offset * row.size)
            {
              result.push_back({row, offset, {}});
              places.push_back(row.reference + row.lever - offset / row.share);
            }
      search.update(places);
      for (std::size_t k = 0; k < result.size(); ++k)
        {
          SlavePoint point;
          point.x = point.start = places[k];
          point.normal          = -result[k].row.normal;
          point.stays_at_end    = true;
          if (const auto partner = search.find(point))
            result[k].partner = *partner;
        }
      return result;
    }
  } // namespace



  Vector
  row_positions(const Solid &solid, const std::vector<ContactRow> &rows)
  {
    return with_stencils(solid, conforming_positions(solid), rows);
  }



  Tensor<1, dim>
  row_offset(const ContactRow &row, const Vector &positions)
  {
    Tensor<1, dim> result = row.reference;
    for (const StencilEntry &entry : row.stencil)
      result -= entry.weight * at_node(positions, entry.node);
    return result;
  }



  void
  make_linear(const PairingInput &input, std::vector<ContactRow> &rows)
  {
    const Solid                     &solid = *input.solid;
    const Vector                     owned = conforming_positions(solid);
    Search                           search(*input.master,
                  input.master->largest_face(),
                  beyond_edge,
                  MasterNormal::face,
                  solid.communicator);
    const std::vector<RowWithOffset> found =
      rows_with_offset(search, with_stencils(solid, owned, rows), rows);
    IndexSet needed = solid.relevant;
    for (const RowWithOffset &of : found)
      if (of.partner.face)
        {
          for (unsigned int c = 0; c < n_corners; ++c)
            add_node(of.partner.face->cell_node(c), needed);
          for (const ContactPartner &other : of.partner.others)
            for (unsigned int c = 0; c < n_corners; ++c)
              add_node(other.face->cell_node(c), needed);
        }
    const Vector of_cells = with_dofs(solid, owned, needed);
    for (const RowWithOffset &of : found)
      if (of.partner.face)
        carry_offset(of, of_cells);
  }
} // namespace Touchstone
