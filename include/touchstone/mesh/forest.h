// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_mesh_forest_h
#define touchstone_mesh_forest_h

#include <touchstone/base/types.h>
#include <touchstone/mesh/discretisation_parameters.h>
#include <touchstone/mesh/geometry.h>

#include <deal.II/distributed/tria_base.h>
#include <deal.II/grid/cell_id.h>

#include <array>
#include <map>
#include <set>

namespace Touchstone
{
  /** @brief Boundary ids of the faces of a boundary, or of several. */
  using BoundaryIds = std::set<dealii::types::boundary_id>;

  /** @brief What a forest is made from. */
  struct ForestInput
  {
    struct Body
    {
      std::string               name;
      std::shared_ptr<Geometry> geometry;
      /** Of a cell, relative to those of other bodies, for partitions. */
      unsigned int work = 1;
      /** Names of boundaries that are planes of symmetry, which 'all' leaves out. */
      std::vector<std::string> symmetry;
    };
    /** Boundaries that meet: for partitions, and for warnings of flat faces. */
    struct Pair
    {
      /** For messages. */
      std::string              section;
      unsigned int             slave_body = 0;
      std::vector<std::string> slave_boundaries;
      /** Without meaning if there are no master boundaries. */
      unsigned int             master_body = 0;
      std::vector<std::string> master_boundaries;
      /** Flat faces are the surface, instead of smooth patches over them. */
      bool takes_facets = true;
    };
    std::vector<Body>        bodies;
    std::vector<Pair>        pairs;
    DiscretisationParameters discretisation;
    /** The mesh is going to be refined during the run. */
    bool refines = false;
    /** Ranks compute all cells that have a node of theirs, and nodes between ranks belong to the
     * lower one, as in explicit dynamics. */
    bool computes_ghosts = false;
  };

  /**
   * @brief All bodies of a scene in one distributed triangulation.
   *
   * The bodies' coarse meshes are concatenated, never merged, so bodies that
   * touch stay apart. The material id of a cell is the number of its body;
   * boundary ids are unique over all bodies.
   */
  class Forest
  {
    // In this order: the mesh is made with the names, and the reference below is to it.
    /** Boundary names of each body, with ids that are unique in the forest. */
    std::vector<std::map<std::string, BoundaryIds>> names;
    /** Sets of nodes of each body. */
    std::vector<std::map<std::string, std::set<std::array<double, dim>>>> node_sets;
    /** Those of each body that are no planes of symmetry. */
    std::vector<BoundaryIds>                                                     all_ids;
    std::map<dealii::types::boundary_id, std::shared_ptr<const AnalyticSurface>> surfaces;
    unsigned int                                                                 level = 0;
    bool                     has_weights                                               = false;
    std::vector<std::string> notices;
    /** Its class depends on the partitioner. */
    std::unique_ptr<dealii::parallel::TriangulationBase<dim>> mesh;

  public:
    /** @throws InputError for bad meshes and boundaries that do not exist. */
    Forest(const ForestInput &input, const std::string &scene_folder, MPI_Comm communicator);

    /** @brief From p4est it can be refined, from other partitioners it cannot. */
    dealii::parallel::TriangulationBase<dim> &triangulation;

    /** @brief Level of the cells that the scene asks for; cells are not coarsened
     * beyond it. */
    unsigned int
    first_level() const
    {
      return level;
    }

    /** @brief Refine @p cells, and their children that are among them, and so on: a
     * mesh that the run had before. Nothing may refer to the present one. Collective. */
    void
    refine(const std::set<dealii::CellId::binary_type> &cells);

    /** @brief Whether p4est balances weights that differ between cells. */
    bool
    weighted() const
    {
      return has_weights;
    }

    /** @brief Repartition the present cells. Collective. */
    void
    repartition();

    unsigned int
    n_bodies() const;

    /** @brief What the user should know of the meshes, as sentences. */
    const std::vector<std::string> &
    warnings() const
    {
      return notices;
    }

    /**
     * @brief The boundary ids of the faces of a boundary, by its name or its number: more
     * than one if other boundaries share some of its faces.
     * @throws InputError in the name of @p section and @p key, which lists the
     * boundaries that the body has.
     */
    BoundaryIds
    boundary(unsigned int       body,
             const std::string &name,
             const std::string &section,
             const std::string &key) const;

    /**
     * @brief The boundaries in a list, in its order.
     * @throws InputError in the name of @p section and @p key if the body has no such
     * boundary, or if two entries, a name and a number perhaps, mean the same.
     */
    std::vector<BoundaryIds>
    boundaries(unsigned int                    body,
               const std::vector<std::string> &names,
               const std::string              &section,
               const std::string              &key) const;

    /** Corners of coarse cells, by their coordinates. */
    using NodeSet = std::set<std::array<double, dim>>;

    /** @brief Whether a name is that of a set of nodes of the body, and of no boundary. */
    bool
    has_node_set(const unsigned int body, const std::string &name) const
    {
      return names[body].count(name) == 0 && node_sets[body].count(name) > 0;
    }

    /** @brief The names of the sets of nodes of a body. */
    std::vector<std::string>
    names_of_node_sets(unsigned int body) const;

    /** @brief A set of nodes: what a node of the mesh file is in, and what lies between nodes that
     * are. Refinement moves no corner of a coarse cell, so that coordinates tell them. */
    const NodeSet &
    node_set(const unsigned int body, const std::string &name) const
    {
      return node_sets[body].at(name);
    }

    /** @brief A corner of cells of a body has been moved: sets that it is in have it at its new
     * place, too. */
    void
    vertex_has_moved(unsigned int              body,
                     const dealii::Point<dim> &before,
                     const dealii::Point<dim> &after);

    /** @brief The boundary ids of all of them together. Where no boundary has the name, 'all' are
     * those that are no planes of symmetry. */
    BoundaryIds
    boundary_ids(unsigned int                    body,
                 const std::vector<std::string> &names,
                 const std::string              &section,
                 const std::string              &key) const;

    /** @brief A name of a boundary, or its number if it has no name. */
    std::string
    boundary_name(dealii::types::boundary_id id) const;

    /** @brief The boundaries of a body with their names, or numbers if they have no names. */
    std::map<BoundaryIds, std::string>
    names_of_boundaries(unsigned int body) const;

    /** @brief Exact shape of a boundary, or null where only the mesh is known. */
    std::shared_ptr<const AnalyticSurface>
    surface(dealii::types::boundary_id id) const;

  private:
    std::unique_ptr<dealii::parallel::TriangulationBase<dim>>
    make(const ForestInput &input, const std::string &scene_folder, MPI_Comm communicator);

    /** Add the names and exact surfaces of the next body. @param ids In the forest, by those of
     * @p mesh. @param symmetry Names of its planes of symmetry. */
    void
    add_boundaries(const BodyMesh                                                         &mesh,
                   const std::map<dealii::types::boundary_id, dealii::types::boundary_id> &ids,
                   const std::vector<std::string> &symmetry);

    void
    notice_facets(const BodyMesh    &all,
                  const BoundaryIds &ids,
                  const std::string &body,
                  const std::string &section);
  };
} // namespace Touchstone

#endif
