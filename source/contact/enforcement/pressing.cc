#include <touchstone/contact/contact.h>

namespace Touchstone
{
  using namespace dealii;

  std::vector<PressingNode>
  Contact::pressing(const ConstraintGraph &supports, const double step) const
  {
    ConstraintGraph           graph(supports);
    std::vector<PressingNode> result;
    for (unsigned int p = 0; p < rows.size(); ++p)
      for (std::size_t k = 0; k < rows[p].size(); ++k)
        {
          const ContactRow &row = rows[p][k];
          if (!row.active() || row.closes_circle || !(row.lambda > 0. || row.tied))
            continue;
          PressingNode node{{}, true, p, k};
          node.condition.node           = row.slave;
          node.condition.stencil        = row.stencil;
          const Tensor<1, dim> velocity = (row.shift - committed[p][k].shift) / step;
          const auto offer = [&](const Tensor<1, dim> &direction, const Tensor<1, dim> &force) {
            node.condition.direction       = direction;
            node.condition.force_direction = force;
            node.condition.value           = direction * velocity;
            if (graph.accept(node.condition, ConstraintGraph::Treatment::multiplier))
              result.push_back(node);
          };
          const Tensor<1, dim> along_direction;
          if (row.tied)
            for (unsigned int d = 0; d < dim; ++d)
              offer(Point<dim>::unit_vector(d), along_direction);
          else
            {
              // Where it slides, less pressure is less friction.
              const bool slides = row.status == ContactStatus::slip && row.friction;
              offer(row.normal, slides ? row.force / row.lambda : along_direction);
              node.normal = false;
              if (row.status == ContactStatus::stick)
                for (const Tensor<1, dim> &tangent : row.friction->frame)
                  offer(tangent, along_direction);
            }
        }
    return result;
  }



  void
  Contact::add_jumps(const std::vector<PressingNode> &pressing, const double step)
  {
    for (const PressingNode &node : pressing)
      rows[node.pair][node.row].jump -= node.impulse / step * node.condition.force();
  }
} // namespace Touchstone
