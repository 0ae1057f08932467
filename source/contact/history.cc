#include <touchstone/contact/contact.h>

namespace Touchstone
{
  using namespace dealii;

  std::vector<Vector>
  Contact::fields(const bool of_committed) const
  {
    const auto         &all = of_committed ? committed : rows;
    std::vector<Vector> result(n_fields * pairs.size(), Vector(solid.owned, solid.communicator));
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        Vector *const field = &result[n_fields * p];
        for (const ContactRow &row : all[p])
          if (row.active() && row.area > 0.)
            for (unsigned int d = 0; d < dim; ++d)
              field[0](dim * row.slave + d) = row.force[d] / row.area;
        for (const ContactRow &row : all[p])
          {
            field[1](dim * row.slave)     = row.active();
            field[1](dim * row.slave + 1) = (row.status == ContactStatus::stick);
            if (row.friction && row.area > 0.)
              {
                field[2](dim * row.slave)     = row.friction->slip_length;
                field[2](dim * row.slave + 1) = row.friction->work / row.area;
              }
          }
      }
    for (Vector &field : result)
      field.compress(VectorOperation::insert);
    return result;
  }



  void
  Contact::adopt(const std::vector<Vector> &fields, const bool history)
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const Vector *const field = &fields[n_fields * p];
        for (ContactRow &row : rows[p])
          {
            row.clear_force();
            FrictionState *const f = row.friction ? &*row.friction : nullptr;
            if (row.status == ContactStatus::no_partner)
              {
                if (f && history)
                  f->has_anchor = false;
                continue;
              }
            if (!row.tied)
              row.status = field[1](dim * row.slave) < 0.5             ? ContactStatus::open
                           : f && field[1](dim * row.slave + 1) >= 0.5 ? ContactStatus::stick
                                                                       : ContactStatus::slip;
            Tensor<1, dim> tangential;
            if (row.active())
              {
                for (unsigned int d = 0; d < dim; ++d)
                  row.force[d] = row.area * field[0](dim * row.slave + d);
                row.lambda           = row.force * row.normal;
                tangential           = row.force - row.lambda * row.normal;
                row.augmented        = row.tied ? row.force : tangential;
                row.augmented_lambda = row.lambda;
              }
            if (!f)
              continue;
            f->base = tangential;
            if (row.status == ContactStatus::slip && tangential.norm() > 0.)
              f->last_direction = tangential / tangential.norm();
            if (history)
              {
                f->stored      = {{tangential * f->frame[0], tangential * f->frame[1]}};
                f->start       = tangential;
                f->slip        = Tensor<1, dim>();
                f->slip_length = field[2](dim * row.slave);
                f->work        = row.area * field[2](dim * row.slave + 1);
                set_anchor(row);
              }
          }
        if (history && !pairs[p].small)
          pairs[p].pairing->commit_positions(ghosted);
      }
    if (history)
      committed = rows;
  }



  std::vector<Contact::PairBoundaries>
  Contact::boundaries() const
  {
    std::vector<PairBoundaries> result;
    for (const Pair &pair : pairs)
      result.push_back({pair.slave_body,
                        pair.master_body,
                        pair.slave->boundaries(),
                        pair.master ? pair.master->boundaries() : std::set<types::boundary_id>()});
    return result;
  }
} // namespace Touchstone
