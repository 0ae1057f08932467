#include <touchstone/archive/archive.h>
#include <touchstone/contact/contact.h>

#include <algorithm>

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
    if (history && positions.size() > 0)
      start_step();
    if (history)
      {
        committed      = rows;
        committed_time = time;
      }
  }



  namespace
  {
    /**
     * What a row has to know when a step begins, the one list of it. What is not here is
     * made by the constructor, or by each update before it is read.
     */
    template <class Row, class Visitor>
    void
    visit_state(Row &row, Visitor &&visit)
    {
      visit(row.status);
      visit(row.stencil);
      visit(row.normal);
      visit(row.gap_vector);
      visit(row.gap);
      visit(row.area);
      visit(row.position);
      visit(row.accepted);
      visit(row.refused);
      visit(row.closes_circle);
      visit(row.normal_accepted);
      visit(row.granted_gap);
      visit(row.augmented_lambda);
      visit(row.augmented);
      visit(row.force);
      visit(row.lambda);
      visit(row.shift);
      if (!row.friction)
        return;
      auto &f = *row.friction;
      visit(f.has_anchor);
      visit(f.anchor);
      visit(f.anchor_offset);
      visit(f.anchor_way);
      visit(f.anchor_gap);
      visit(f.way_to_touch);
      visit(f.stored);
      visit(f.slip_length);
      visit(f.work);
      visit(f.slip);
      visit(f.frame);
      visit(f.start);
      visit(f.hold);
      visit(f.c);
      visit(f.base);
      visit(f.carried);
      visit(f.direction);
      visit(f.last_direction);
      visit(f.slope);
      visit(f.last_slope);
      visit(f.rest);
      visit(f.coupling);
      visit(f.turn);
      visit(f.limit);
      visit(f.excess);
    }

    /** Whole numbers, flags and states fit into a double. */
    class Packer
    {
    public:
      explicit Packer(NodeRecord &record)
        : record(record)
      {
      }

      template <class Number>
      std::enable_if_t<std::is_arithmetic<Number>::value || std::is_enum<Number>::value>
      operator()(const Number &value)
      {
        record.values.push_back(static_cast<double>(value));
      }

      template <int rank>
      void
      operator()(const Tensor<rank, dim> &value)
      {
        for (unsigned int d = 0; d < dim; ++d)
          (*this)(value[d]);
      }

      template <class T, std::size_t n>
      void
      operator()(const std::array<T, n> &value)
      {
        for (const T &entry : value)
          (*this)(entry);
      }

      void
      operator()(const Stencil &stencil)
      {
        (*this)(stencil.size());
        for (const StencilEntry &entry : stencil)
          {
            record.nodes.push_back(entry.node);
            (*this)(entry.weight);
          }
      }

    private:
      NodeRecord &record;
    };

    class Unpacker
    {
    public:
      explicit Unpacker(const NodeRecord &record)
        : record(record)
      {
      }

      template <class Number>
      std::enable_if_t<std::is_arithmetic<Number>::value || std::is_enum<Number>::value>
      operator()(Number &value)
      {
        value = static_cast<Number>(
          static_cast<std::conditional_t<std::is_floating_point<Number>::value, double, long>>(
            next()));
      }

      template <int rank>
      void
      operator()(Tensor<rank, dim> &value)
      {
        for (unsigned int d = 0; d < dim; ++d)
          (*this)(value[d]);
      }

      template <class T, std::size_t n>
      void
      operator()(std::array<T, n> &value)
      {
        for (T &entry : value)
          (*this)(entry);
      }

      void
      operator()(Stencil &stencil)
      {
        stencil.resize(static_cast<std::size_t>(next()));
        for (StencilEntry &entry : stencil)
          {
            entry.node = record.nodes.at(n_nodes++);
            (*this)(entry.weight);
          }
      }

      bool
      complete() const
      {
        return n_values == record.values.size() && n_nodes == record.nodes.size();
      }

    private:
      const NodeRecord &record;
      std::size_t       n_values = 0, n_nodes = 0;

      double
      next()
      {
        if (n_values == record.values.size())
          throw ArchiveError("the state of a contact row is too short");
        return record.values[n_values++];
      }
    };
  } // namespace



  void
  Contact::save(ArchiveWriter &archive) const
  {
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        const Pair             &pair   = pairs[p];
        const PairingMemory     memory = pair.pairing->memory();
        std::vector<NodeRecord> records;
        for (std::size_t k = 0; k < committed[p].size(); ++k)
          {
            NodeRecord record;
            record.node = committed[p][k].slave;
            Packer pack(record);
            pack(pair.overlap[k]);
            visit_state(committed[p][k], pack);
            if (k < memory.of_rows.size() && memory.of_rows[k])
              record.keys.push_back(*memory.of_rows[k]);
            records.push_back(std::move(record));
          }
        archive.put_nodes(pair.parameters->section(), records);
        // In an order that does not depend on how the memory came about.
        KeyPairs faces(memory.of_faces.begin(), memory.of_faces.end());
        std::sort(faces.begin(), faces.end());
        archive.put_keys(pair.parameters->section(), faces);
      }
  }



  void
  Contact::load(const ArchiveReader &archive, const Vector &u, const double t)
  {
    time = committed_time = t;
    (*import_ghosts)(u, ghosted);
    for (unsigned int p = 0; p < pairs.size(); ++p)
      {
        Pair         &pair    = pairs[p];
        const auto   &records = archive.nodes(pair.parameters->section());
        PairingMemory memory;
        for (std::size_t k = 0; k < rows[p].size(); ++k)
          {
            const auto found = records.find(rows[p][k].slave);
            if (found == records.end())
              throw ArchiveError("a contact row of the pair '" + pair.parameters->name +
                                 "' is missing");
            Unpacker unpack(found->second);
            unpack(pair.overlap[k]);
            visit_state(rows[p][k], unpack);
            if (!unpack.complete())
              throw ArchiveError("the state of a contact row is too long");
            memory.of_rows.emplace_back();
            if (!found->second.keys.empty())
              memory.of_rows.back() = found->second.keys.front();
          }
        const KeyPairs &faces = archive.keys(pair.parameters->section());
        memory.of_faces.insert(faces.begin(), faces.end());
        if (pair.small)
          continue;
        pair.pairing->commit_positions(ghosted);
        pair.pairing->remember(memory);
      }
    if (reference_positions.size() > 0)
      {
        owned_start_positions = reference_positions;
        owned_start_positions += u;
        positions_known.clear(); // ghosts are imported by the next update
      }
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
