// SPDX-License-Identifier: LGPL-2.1-or-later
// The model as JSON: the whole file of the smallest scene, and for both degrees that
// every node is there once, loads are complete and faces look outward.

#include <touchstone/base/input_error.h>
#include <touchstone/output/model_export.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <boost/property_tree/json_parser.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

using namespace Touchstone;

namespace
{
  const std::string text = R"(
set Title = Two blocks
set Bodies = lower, upper
set Contact pairs = joint
subsection Body lower
  set Fixed = bottom
  subsection Geometry
    set Upper corner = 1, 1, 0.5
  end
  subsection Material
    set Young modulus = 1000
  end
end
subsection Body upper
  set Symmetry = left
  set Boundary conditions = front, top
  subsection Boundary front
    set Displacement y = 0.1 * t * x
  end
  subsection Boundary top
    set Pressure = 10 * t
    set Traction x = 4 * x
  end
  subsection Geometry
    set Lower corner = 0, 0, 0.5
  end
  subsection Material
    set Young modulus = 2000
    set Poisson ratio = 0.25
  end
end
subsection Contact pair joint
  set Slave body = lower
  set Slave boundaries = top
  set Master body = upper
  set Master boundaries = bottom
  set Behaviour = coulomb
  subsection Friction
    set Coefficient = 0.3
  end
end
subsection Load stepping
  set End time = 2
  set Steps = 2
end
)";

  using Tree = boost::property_tree::ptree;

  std::vector<double>
  numbers(const Tree &list)
  {
    std::vector<double> result;
    for (const auto &entry : list)
      result.push_back(entry.second.get_value<double>());
    return result;
  }



  dealii::Tensor<1, 3>
  node(const Tree &model, const double number)
  {
    const auto x = numbers(std::next(model.get_child("nodes").begin(), int(number))->second);
    return dealii::Tensor<1, 3>({x[0], x[1], x[2]});
  }



  /** What holds for a mesh of any degree. */
  void
  check(const Tree &model)
  {
    const unsigned int p = model.get<unsigned int>("degree"), n = p + 1;
    std::set<double>   seen;
    bool               ordered = true;
    for (const auto &body : model.get_child("bodies"))
      for (const auto &cell : body.second.get_child("cells"))
        {
          const auto nodes = numbers(cell.second);
          seen.insert(nodes.begin(), nodes.end());
          for (unsigned int i = 0; i < nodes.size(); ++i)
            for (const auto &[step, axis] : {std::pair(1u, 0u), {n, 1u}, {n * n, 2u}})
              if (i / step % n < p)
                ordered = ordered &&
                          node(model, nodes[i + step])[axis] > node(model, nodes[i])[axis] + 1e-3;
        }
    dealii::Tensor<1, 3> force;
    const Tree          &last = model.get_child("steps").back().second;
    for (const auto &entry : last.get_child("forces"))
      {
        const auto f = numbers(entry.second);
        force += dealii::Tensor<1, 3>({f[1], f[2], f[3]});
      }
    std::cout << "degree " << p << ": " << model.get_child("nodes").size() << " nodes, "
              << seen.size() << " in cells, " << (ordered ? "in order" : "NOT in order")
              << "; force " << force << " at t = " << last.get<double>("time") << '\n';
    for (const char *side : {"slave", "master"})
      for (const auto &face : model.get_child("pairs").front().second.get_child(side))
        {
          const auto nodes = numbers(face.second);
          std::cout << side << ": "
                    << cross_product_3d(node(model, nodes[p]) - node(model, nodes[0]),
                                        node(model, nodes[n * p]) - node(model, nodes[0]))
                    << '\n';
        }
  }
} // namespace



int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                        file = "model_export_test.json";
  try
    {
      for (const std::string degree : {"1", "2"})
        {
          const Scene scene(text, "test.prm", {"Discretisation/Degree=" + degree});
          export_model(scene, ".", file, MPI_COMM_WORLD);
          if (degree == "1")
            std::cout << std::ifstream(file).rdbuf();
          Tree model;
          boost::property_tree::read_json(file, model);
          std::filesystem::remove(file);
          check(model);
        }
    }
  catch (const InputError &error)
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << error.what() << std::endl;
    }
  return 0;
}
