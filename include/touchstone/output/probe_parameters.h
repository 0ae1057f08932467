// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_output_probe_parameters_h
#define touchstone_output_probe_parameters_h

#include <touchstone/base/keyword.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace Touchstone
{
  /** @brief Section "Probe NAME": where the history of a result is wanted. */
  struct ProbeParameters
  {
    enum class Place
    {
      point,
      line,
      boundary
    };

    std::string    name;
    std::string    body;
    Keyword<Place> place{Place::point,
                         {{"point", Place::point},
                          {"line", Place::line},
                          {"boundary", Place::boundary}}};
    /** Reference positions, length: the point, or the ends of the line. */
    dealii::Tensor<1, 3> point, end;
    /** Of a line, its ends included. */
    unsigned int n_points = 11;
    /** Name or number. */
    std::string boundary;

    /** @brief "Probe NAME". */
    std::string
    section() const;
    void
    declare(dealii::ParameterHandler &prm);
    /** @throws InputError */
    void
    check() const;
  };
} // namespace Touchstone

#endif
