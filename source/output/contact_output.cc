#include <touchstone/output/contact_output.h>

#include <array>
#include <optional>
#include <set>

namespace Touchstone
{
  namespace
  {
    /** Values at a node: 5 scalars, then 4 vectors. */
    constexpr unsigned int n_scalars = 5, n_vectors = 4;
    constexpr unsigned int n_values = n_scalars + dim * n_vectors;

    const std::array<std::string, n_scalars + n_vectors> names = {{"status",
                                                                   "gap",
                                                                   "pressure",
                                                                   "pair",
                                                                   "slip_length",
                                                                   "normal",
                                                                   "traction",
                                                                   "slip",
                                                                   "displacement"}};

    std::array<double, n_values>
    values_at(const ContactPoint &point)
    {
      std::array<double, n_values> values = {{static_cast<double>(static_cast<int>(point.status)),
                                              point.gap,
                                              point.pressure,
                                              static_cast<double>(point.pair),
                                              point.slip_length}};
      for (unsigned int d = 0; d < dim; ++d)
        {
          values[n_scalars + d]           = point.normal[d];
          values[n_scalars + dim + d]     = point.traction[d];
          values[n_scalars + 2 * dim + d] = point.slip[d];
          values[n_scalars + 3 * dim + d] = point.displacement[d];
        }
      return values;
    }



    unsigned int
    nodes_per_face(const ContactFace &face)
    {
      return (face.degree + 1) * (face.degree + 1);
    }



    /** What MPI::all_gather can send: position, area and values of a point. */
    using Parcel = std::array<double, n_values + dim + 1>;

    Parcel
    pack(const ContactPoint &point)
    {
      Parcel     parcel;
      const auto values = values_at(point);
      std::copy(values.begin(), values.end(), parcel.begin());
      for (unsigned int d = 0; d < dim; ++d)
        parcel[n_values + d] = point.reference_position[d];
      parcel[n_values + dim] = point.area;
      return parcel;
    }



    ContactPoint
    unpack(const Index node, const Parcel &parcel)
    {
      ContactPoint point;
      point.node        = node;
      point.status      = static_cast<ContactStatus>(static_cast<int>(parcel[0]));
      point.gap         = parcel[1];
      point.pressure    = parcel[2];
      point.pair        = static_cast<unsigned int>(parcel[3]);
      point.slip_length = parcel[4];
      for (unsigned int d = 0; d < dim; ++d)
        {
          point.normal[d]             = parcel[n_scalars + d];
          point.traction[d]           = parcel[n_scalars + dim + d];
          point.slip[d]               = parcel[n_scalars + 2 * dim + d];
          point.displacement[d]       = parcel[n_scalars + 3 * dim + d];
          point.reference_position[d] = parcel[n_values + d];
        }
      point.area = parcel[n_values + dim];
      return point;
    }
    /** The result at a hanging node, if those that it follows are known. */
    std::optional<ContactPoint>
    followed(const unsigned int              pair,
             const ContactFace::HangingNode &hanging,
             const ContactPointMap          &map)
    {
      ContactPoint result{};
      double       largest = 0.;
      for (const auto &[node, weight] : hanging.follows)
        {
          const auto found = map.find({pair, node});
          if (found == map.end())
            return {};
          const ContactPoint &point = found->second;
          result.displacement += weight * point.displacement;
          result.normal += weight * point.normal;
          result.gap += weight * point.gap;
          result.pressure += weight * point.pressure;
          result.traction += weight * point.traction;
          result.slip += weight * point.slip;
          if (weight > largest)
            result.status = point.status;
          largest = std::max(largest, weight);
        }
      result.pair               = pair;
      result.node               = hanging.node;
      result.reference_position = hanging.reference_position;
      return result;
    }
  } // namespace



  ContactPointMap
  collect_contact_points(const std::vector<ContactFace>  &faces,
                         const std::vector<ContactPoint> &points,
                         const MPI_Comm                   communicator)
  {
    ContactPointMap map;
    for (const ContactPoint &point : points)
      map[{point.pair, point.node}] = point;

    // Only nodes at the edges of the partitions are missing, so that it does not
    // hurt to ask everybody and to tell everybody.
    std::set<std::pair<unsigned int, Index>> missing;
    const auto                               want = [&](const unsigned int pair, const Index node) {
      if (map.find({pair, node}) == map.end())
        missing.insert({pair, node});
    };
    for (const ContactFace &face : faces)
      {
        for (unsigned int i = 0; i < nodes_per_face(face); ++i)
          want(face.pair, face.nodes[i]);
        for (const ContactFace::HangingNode &hanging : face.hanging)
          for (const StencilEntry &entry : hanging.follows)
            want(face.pair, entry.node);
      }

    const auto requests = dealii::Utilities::MPI::all_gather(
      communicator, std::vector<std::pair<unsigned int, Index>>(missing.begin(), missing.end()));

    std::set<std::pair<unsigned int, Index>> requested;
    for (const auto &of_rank : requests)
      requested.insert(of_rank.begin(), of_rank.end());

    std::vector<std::pair<Index, Parcel>> answer;
    for (const ContactPoint &point : points)
      if (requested.count({point.pair, point.node}) > 0)
        answer.emplace_back(point.node, pack(point));

    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, answer))
      for (const auto &[node, parcel] : of_rank)
        {
          const ContactPoint point = unpack(node, parcel);
          if (missing.count({point.pair, node}) > 0)
            map[{point.pair, node}] = point;
        }
    for (const ContactFace &face : faces)
      for (const ContactFace::HangingNode &hanging : face.hanging)
        {
          const auto result = followed(face.pair, hanging, map);
          if (result)
            map[{face.pair, hanging.node}] = *result;
        }
    return map;
  }



  ContactPicture::ContactPicture(const std::vector<ContactFace> &faces,
                                 const ContactPointMap          &points)
  {
    bool curved = false;
    for (const ContactFace &face : faces)
      {
        const unsigned int                n = face.degree + 1;
        std::vector<const ContactPoint *> nodes;
        for (unsigned int i = 0; i < nodes_per_face(face); ++i)
          {
            const auto found = points.find({face.pair, face.nodes[i]});
            if (found != points.end())
              nodes.push_back(&found->second);
          }
        if (nodes.size() < nodes_per_face(face))
          continue;

        dealii::DataOutBase::Patch<2, 3> patch;
        patch.patch_index          = patches.size();
        patch.n_subdivisions       = face.degree;
        patch.reference_cell       = dealii::ReferenceCells::get_hypercube<2>();
        patch.points_are_available = (face.degree > 1);
        curved |= patch.points_are_available;

        const unsigned int corners[4] = {0, n - 1, n * (n - 1), n * n - 1};
        for (unsigned int v = 0; v < 4; ++v)
          patch.vertices[v] = nodes[corners[v]]->reference_position;

        // Where points are available, they are the last rows of the table.
        patch.data.reinit(n_values + (patch.points_are_available ? dim : 0), n * n);
        for (unsigned int i = 0; i < n * n; ++i)
          {
            const auto values = values_at(*nodes[i]);
            for (unsigned int c = 0; c < n_values; ++c)
              patch.data(c, i) = values[c];
            if (patch.points_are_available)
              for (unsigned int d = 0; d < dim; ++d)
                patch.data(n_values + d, i) = nodes[i]->reference_position[d];
          }
        patches.push_back(patch);
      }

    dealii::DataOutBase::VtkFlags flags;
    flags.print_date_and_time      = false;
    flags.compression_level        = dealii::DataOutBase::VtkFlags::best_speed;
    flags.write_higher_order_cells = curved;
    set_flags(flags);
  }



  const std::vector<dealii::DataOutBase::Patch<2, 3>> &
  ContactPicture::get_patches() const
  {
    return patches;
  }



  std::vector<std::string>
  ContactPicture::get_dataset_names() const
  {
    std::vector<std::string> all(names.begin(), names.begin() + n_scalars);
    for (unsigned int v = 0; v < n_vectors; ++v)
      all.insert(all.end(), dim, names[n_scalars + v]);
    return all;
  }



  std::vector<std::tuple<unsigned int,
                         unsigned int,
                         std::string,
                         dealii::DataComponentInterpretation::DataComponentInterpretation>>
  ContactPicture::get_nonscalar_data_ranges() const
  {
    std::vector<std::tuple<unsigned int,
                           unsigned int,
                           std::string,
                           dealii::DataComponentInterpretation::DataComponentInterpretation>>
      ranges;
    for (unsigned int v = 0; v < n_vectors; ++v)
      ranges.emplace_back(n_scalars + dim * v,
                          n_scalars + dim * v + dim - 1,
                          names[n_scalars + v],
                          dealii::DataComponentInterpretation::component_is_part_of_vector);
    return ranges;
  }



  ContactOutput::ContactOutput(const OutputFolder &folder)
    : folder(folder)
    , pictures(folder, "contact")
  {
  }



  void
  ContactOutput::write(const std::vector<ContactFace>  &faces,
                       const std::vector<ContactPoint> &points,
                       const unsigned int               step,
                       const double                     time)
  {
    const auto map = collect_contact_points(faces, points, folder.communicator);

    const ContactPicture picture(faces, map);
    const std::size_t    n_patches =
      dealii::Utilities::MPI::sum(picture.get_patches().size(), folder.communicator);
    if (n_patches > 0)
      pictures.write(picture, step, time);
  }
} // namespace Touchstone
