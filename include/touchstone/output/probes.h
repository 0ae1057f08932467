// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_probes_h
#define touchstone_output_probes_h

#include <touchstone/base/folder.h>
#include <touchstone/mesh/forest.h>
#include <touchstone/output/probe_parameters.h>
#include <touchstone/output/volume_output.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Histories of displacement and stress at points, along lines and on boundaries, a file
   * probe_NAME.csv for each.
   *
   * Points keep their material: positions are those before deformation. Stress is that of the VTU
   * files, averaged to the nodes and interpolated between them, and hence the same from whichever
   * cell at a point. All functions are collective.
   */
  class Probes
  {
  public:
    /** @brief Find the points. @throws InputError for a point outside of its body, and a boundary
     * that it does not have. */
    Probes(const std::vector<ProbeParameters> &parameters,
           const Forest                       &forest,
           const Solid                        &solid);

    /** @brief The mesh has changed. */
    void
    reinit();

    /** @brief Add the values of a time to the histories and write them.
     * @param displacement With ghosts. @throws OutputError */
    void
    record(const OutputFolder &folder,
           VolumeOutput       &volume,
           const Vector       &displacement,
           double              time);

    /** @brief The histories so far, by name, for checkpoints. */
    using Histories = std::map<std::string, std::string>;
    const Histories &
    histories() const
    {
      return texts;
    }
    void
    restore(const Histories &before)
    {
      texts = before;
    }

  private:
    /** Displacement; stress xx, yy, zz; stress xy, yz, xz. */
    static constexpr unsigned int n_values = 9;
    using Values                           = std::array<double, n_values>;

    struct Point
    {
      dealii::Point<dim> position;
      /** On one rank only, else there is no cell. */
      dealii::DoFHandler<dim>::active_cell_iterator cell;
      dealii::Point<dim>                            unit;
      bool                                          here = false;
    };
    struct Probe
    {
      const ProbeParameters *parameters;
      unsigned int           body;
      std::vector<Point>     points;
      BoundaryIds            boundary;
    };

    const Solid       &solid;
    std::vector<Probe> probes;
    Histories          texts;

    void
    find(const Probe &probe, Point &point) const;
    std::vector<Values>
    at_points(const Probe &probe, const std::array<const Vector *, 3> &fields) const;
    /** The means, and the area. */
    std::pair<Values, double>
    on_boundary(const Probe &probe, const std::array<const Vector *, 3> &fields) const;
  };
} // namespace Touchstone

#endif
