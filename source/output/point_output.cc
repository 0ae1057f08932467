// SPDX-License-Identifier: LGPL-2.1-or-later

#include <touchstone/output/point_output.h>
#include <touchstone/output/von_mises.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <utility>

namespace Touchstone
{
  PointCloudData::PointCloudData(std::vector<std::string> names, const FileSeries &format)
    : names(std::move(names))
    , tensors(format.has_tensors())
    , with_rests(format.has_doubles())
  {
    dealii::DataOutBase::VtkFlags flags;
    // Output of equal runs is equal byte by byte.
    flags.print_date_and_time = false;
    flags.compression_level   = dealii::DataOutBase::VtkFlags::best_speed;
    set_flags(flags);
  }



  void
  PointCloudData::add(const dealii::Point<dim> &position, const std::vector<double> &values)
  {
    AssertDimension(values.size(), names.size());
    dealii::DataOutBase::Patch<0, 3> patch;
    patch.vertices[0] = position;
    patch.patch_index = patches.size();
    patch.data.reinit((with_rests ? 2 : 1) * values.size(), 1);
    for (unsigned int c = 0; c < values.size(); ++c)
      {
        patch.data(c, 0) = values[c];
        if (with_rests)
          patch.data(values.size() + c, 0) = FileSeries::rest(values[c]);
      }
    patches.push_back(patch);
  }



  const std::vector<dealii::DataOutBase::Patch<0, 3>> &
  PointCloudData::get_patches() const
  {
    return patches;
  }



  std::vector<std::string>
  PointCloudData::get_dataset_names() const
  {
    std::vector<std::string> result = names;
    if (!tensors)
      for (unsigned int first = 0, last = 0; first < names.size(); first = last)
        {
          while (last < names.size() && names[last] == names[first])
            ++last;
          if (last - first == dim * dim)
            for (unsigned int c = 0; c < dim * dim; ++c)
              result[first + c] += std::string("_") + "xyz"[c / dim] + "xyz"[c % dim];
        }
    for (unsigned int c = 0; with_rests && c < names.size(); ++c)
      result.push_back(FileSeries::rest_name(result[c]));
    return result;
  }



  std::vector<std::tuple<unsigned int,
                         unsigned int,
                         std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>>
  PointCloudData::get_nonscalar_data_ranges() const
  {
    namespace Interpretation = dealii::DataComponentInterpretation;
    std::vector<
      std::
        tuple<unsigned int, unsigned int, std::string, Interpretation::DataComponentInterpretation>>
                                   result;
    const std::vector<std::string> all = get_dataset_names();
    for (unsigned int first = 0, last = 0; first < all.size(); first = last)
      {
        while (last < all.size() && all[last] == all[first])
          ++last;
        if (last - first > 1)
          result.emplace_back(first,
                              last - 1,
                              all[first],
                              last - first == dim ? Interpretation::component_is_part_of_vector
                                                  : Interpretation::component_is_part_of_tensor);
      }
    return result;
  }



  PointOutput::PointOutput(const Solid        &solid,
                           const OutputFolder &folder,
                           const ResultFormat  format)
    : solid(solid)
    , files(FileSeries::make(format, folder, "points"))
  {
  }



  void
  PointOutput::write(const Vector &displacement, const unsigned int step, const double time)
  {
    std::vector<std::string> names(dim, "displacement");
    names.insert(names.end(), dim * dim, "stress");
    names.insert(names.end(), {"von_mises", "volume", "body"});
    const std::vector<double> strain = solid.point_plastic_strain();
    if (solid.plastic())
      names.push_back("equivalent_plastic_strain");
    PointCloudData data(names, *files);

    // Points in the order of for_each_stress(): cell by cell, those of the Gauss formula.
    const dealii::QGauss<dim>           quadrature(solid.fe.degree + 1);
    std::vector<dealii::Tensor<1, dim>> moved, of_cell(quadrature.size());
    dealii::FEValues<dim> shapes(solid.mapping, solid.fe, quadrature, dealii::update_values);
    const dealii::FEValuesExtractors::Vector all(0);
    for (const auto &cell : solid.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          shapes.reinit(cell);
          shapes[all].get_function_values(displacement, of_cell);
          moved.insert(moved.end(), of_cell.begin(), of_cell.end());
        }
    std::size_t         q = 0;
    std::vector<double> values;
    solid.for_each_stress(displacement,
                          [&](const unsigned int                     body,
                              const dealii::Point<dim>              &x,
                              const dealii::SymmetricTensor<2, dim> &stress,
                              const double                           volume) {
                            values.clear();
                            for (unsigned int d = 0; d < dim; ++d)
                              values.push_back(moved[q][d]);
                            for (unsigned int i = 0; i < dim; ++i)
                              for (unsigned int j = 0; j < dim; ++j)
                                values.push_back(stress[i][j]);
                            values.insert(values.end(), {von_mises(stress), volume, double(body)});
                            if (solid.plastic())
                              values.push_back(strain[q]);
                            data.add(x, values);
                            ++q;
                          });
    files->write(data, step, time);
  }
} // namespace Touchstone
