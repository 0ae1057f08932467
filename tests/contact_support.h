// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_tests_contact_support_h
#define touchstone_tests_contact_support_h

#include <touchstone/contact/contact.h>
#include <touchstone/scene/pair_input.h>
#include <touchstone/scene/scene.h>
#include <touchstone/solid/boundary_conditions.h>

#include <deal.II/base/mpi.h>

#include "mesh_common.h"
#include <cmath>
#include <functional>

namespace Touchstone
{
  /** A body of a scene; the material does not matter. @param geometry Lines. */
  inline std::string
  body_section(const std::string &name, const std::string &geometry)
  {
    return "subsection Body " + name +
           "\n  subsection Material\n    set Young modulus = 1\n  end\n  subsection Geometry\n" +
           geometry + "\n  end\nend\n";
  }

  /** A scene of two bodies with the contact pair "pair". @param pair Its lines. */
  inline std::string
  two_bodies(const std::string &first,
             const std::string &geometry_of_first,
             const std::string &second,
             const std::string &geometry_of_second,
             const std::string &pair)
  {
    return "set Bodies = " + first + ", " + second + "\nset Contact pairs = pair\n" +
           body_section(first, geometry_of_first) + body_section(second, geometry_of_second) +
           "subsection Contact pair pair\n" + pair + "\nend\n";
  }

  /** The lines of a contact pair. */
  inline std::string
  slave_and_master(const std::string &slave,
                   const std::string &slave_boundaries,
                   const std::string &master,
                   const std::string &master_boundaries)
  {
    return "set Slave body = " + slave + "\nset Slave boundaries = " + slave_boundaries +
           "\nset Master body = " + master + "\nset Master boundaries = " + master_boundaries;
  }

  /** A body and its boundaries as master, with a slave that is far away. */
  inline std::string
  master_only(const std::string &geometry, const std::string &boundaries, const std::string &more)
  {
    return two_bodies("body",
                      geometry,
                      "other",
                      "set Lower corner = 5, 5, 5\nset Upper corner = 6, 6, 6",
                      slave_and_master("other", "bottom", "body", boundaries) + "\n" + more);
  }

  /** A block that stands over the edges and a corner of another one. */
  inline const std::string overhang =
    two_bodies("lower",
               "set Cells = 3, 4, 2",
               "upper",
               "set Lower corner = 0.57, 0.61, 1\n"
               "set Upper corner = 1.13, 1.15, 2\n"
               "set Cells        = 4, 5, 2",
               slave_and_master("upper", "bottom", "lower", "top, right, back"));

  /** The first contact pair of a scene, without the rest of the program: rows as its pairing
   * makes them. */
  class PairOfScene
  {
  public:
    PairOfScene(const std::string &text, const std::vector<std::string> &overrides = {})
      : scene(text, "scene.prm", overrides)
      , forest(scene.forest_input(), "", MPI_COMM_WORLD)
      , solid(scene.bodies, scene.discretisation.degree, forest, MPI_COMM_WORLD)
      , pair(pair_input(scene, forest, solid, 0))
      , slave(&pair.slave())
      , master(pair.master())
      , pairing(&pair.pairing())
      , rows(pair.rows())
    {
      pair.set_planes_of_symmetry(BoundaryConditions(forest, solid).mirrors());
    }

    /** A displacement given by a formula of the reference position and the body. */
    Vector
    displacement(const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &,
                                                            unsigned int body)> &formula) const
    {
      using namespace dealii;
      Vector u(solid.owned, solid.communicator);
      for (const auto &cell : solid.dof_handler.active_cell_iterators())
        if (!cell->is_artificial())
          {
            std::vector<Index> dofs(solid.fe.n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            for (unsigned int i = 0; i < dofs.size(); ++i)
              if (solid.owned.is_element(dofs[i]))
                {
                  const Point<dim> x =
                    solid.mapping.transform_unit_to_real_cell(cell, solid.fe.unit_support_point(i));
                  u(dofs[i]) =
                    formula(x, cell->material_id())[solid.fe.system_to_component_index(i).first];
                }
          }
      u.compress(VectorOperation::insert);
      return u;
    }

    /** Move the surfaces to a displacement (with ghosts). */
    void
    move_surfaces(const Vector &ghosted) const
    {
      pair.move_surfaces(ghosted);
    }

    /** Make the rows for a displacement (without ghosts). */
    void
    update(const Vector &u)
    {
      Vector ghosted(solid.owned, solid.relevant, solid.communicator);
      ghosted = u;
      move_surfaces(ghosted);
      pairing->update(ghosted, 0., rows);
      for (ContactRow &row : rows)
        row.was_active = row.was_active && row.has_partner;
    }

    /** Take every row that has a partner as active, and differentiate. */
    void
    differentiate(const Vector &u)
    {
      for (ContactRow &row : rows)
        row.was_active = row.has_partner;
      Vector ghosted(solid.owned, solid.relevant, solid.communicator);
      ghosted = u;
      pairing->differentiate(ghosted, 0., rows);
    }

    const Scene          scene;
    const Forest         forest;
    const Solid          solid;
    mutable ContactPair  pair;
    const Surface *const slave, *const master;
    Pairing *const          pairing;
    std::vector<ContactRow> rows;
  };

  /** A number between -1 and 1 that has nothing to do with those of neighbours. */
  inline double
  scatter(const dealii::Point<dim> &x, const unsigned int seed)
  {
    return std::sin(37.1 * x[0] + 71.3 * x[1] + 53.7 * x[2] + 2.4 * seed);
  }

  inline dealii::Tensor<1, dim>
  scattered(const dealii::Point<dim> &x, const unsigned int seed)
  {
    return dealii::Tensor<1, dim>(
      {scatter(x, 3 * seed), scatter(x, 3 * seed + 1), scatter(x, 3 * seed + 2)});
  }
} // namespace Touchstone

#endif
