#include <touchstone/contact/geometry/overlap.h>
#include <touchstone/contact/pairing/averaged_derivative.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace Touchstone
{
  using namespace dealii;

  namespace
  {
    /** Columns of Q that are not master shapes: area, gap, normal. */
    constexpr unsigned int n_fixed = 1 + 2 * dim;

    /** The smallest of some gaps, with its derivatives as OverlapPointDerivative numbers
     * them, and with respect to nodal normals of both faces. */
    template <unsigned int n>
    struct Closest
    {
      double                                       gap = std::numeric_limits<double>::max();
      typename OverlapPointDerivative<n>::Gradient d;
      Tensor<1, dim>                               normal[n], slave_normal[n];
    };

    /** The integrals over the overlap of a slave face with one master face, and
     * their derivatives as OverlapPointDerivative numbers them. */
    template <unsigned int n>
    struct Integrals
    {
      using Gradient                           = typename OverlapPointDerivative<n>::Gradient;
      static constexpr unsigned int n_columns  = n_fixed + n;
      static constexpr unsigned int n_variable = OverlapPointDerivative<n>::n_variables;

      double   mass[n][n] = {}, q[n][n_columns] = {};
      Gradient d_mass[n][n] = {}, d_q[n][n_columns] = {};
      /** Of normal and gap with respect to the nodal normals of the master face, and
       * of the gap with respect to those of the slave face. */
      Tensor<2, dim> normal_normal[n][n], gap_normal[n][n], gap_slave_normal[n][n];
      /** The smallest gap at any point, and at the nodes. */
      Closest<n> least, own[n];

      /** @param master_face And its differentiation at the point. */
      void
      add(const FaceDifferentiator        &slave,
          const OverlapPointDerivative<n> &point,
          const FaceGeometry              &master_face,
          const FaceDerivative            &master);
    };

    /** The weight of a point as the inclination of the surfaces reduces it: changes @p weight and
     * @p d_weight, numbered as OverlapPointDerivative does. @return false if nothing is left. */
    template <unsigned int n>
    bool
    take_facing_part(const Face                                   &slave,
                     const OverlapPointDerivative<n>              &point,
                     const FaceGeometry                           &master,
                     const Tensor<1, dim>                         &normal,
                     double                                       &weight,
                     typename OverlapPointDerivative<n>::Gradient &d_weight)
    {
      const Tensor<1, dim> plane = plane_normal(slave);
      const FacingPart     part(
        facing_cosine(plane, normal, master.face(), master.exact_surface(), point.master));
      if (part.by_cosine == 0.)
        return part.value > 0.;
      const FaceShapes     shapes(master.face().degree, point.master);
      const FacePoint      x       = evaluate(master.face(), master.exact_surface(), point.master);
      const Tensor<1, dim> product = cross_product_3d(x.tangents[0], x.tangents[1]);
      const double         sign    = product * normal < 0. ? 1. : -1.;
      const Tensor<1, dim> own     = sign * product / product.norm();
      const Tensor<1, dim> by_product = sign * (plane * normalisation_derivative(product));
      // d cosine by the tangents of the master surface.
      const Tensor<1, dim>          by_t[2] = {cross_product_3d(x.tangents[1], by_product),
                                               cross_product_3d(by_product, x.tangents[0])};
      std::array<Tensor<1, dim>, 3> second;
      if (master.exact_surface() != nullptr)
        second = master.second_derivatives(point.master);
      else
        {
          const auto hessians = shape_hessians(master.face().degree, point.master);
          for (unsigned int m = 0; m < n; ++m)
            for (unsigned int s = 0; s < 3; ++s)
              second[s] +=
                hessians[m][s] * (master.face().reference[m] + master.face().displacement[m]);
        }
      const double by_xi[2] = {by_t[0] * second[0] + by_t[1] * second[1],
                               by_t[0] * second[1] + by_t[1] * second[2]};
      const auto   by_slave = plane_normal_derivatives(slave);

      typename OverlapPointDerivative<n>::Gradient d_cosine;
      for (unsigned int v = 0; v < OverlapPointDerivative<n>::n_variables; ++v)
        d_cosine[v] = by_xi[0] * point.d_master[0][v] + by_xi[1] * point.d_master[1][v];
      for (unsigned int m = 0; m < n; ++m)
        for (unsigned int e = 0; e < dim; ++e)
          {
            d_cosine[dim * m + e] += (own * by_slave[m])[e];
            d_cosine[dim * (n + m) + e] +=
              shapes.gradient[m][0] * by_t[0][e] + shapes.gradient[m][1] * by_t[1][e];
          }
      for (unsigned int v = 0; v < OverlapPointDerivative<n>::n_variables; ++v)
        d_weight[v] = part.value * d_weight[v] + weight * part.by_cosine * d_cosine[v];
      weight *= part.value;
      return part.value > 0.;
    }



    template <unsigned int n>
    void
    Integrals<n>::add(const FaceDifferentiator        &slave,
                      const OverlapPointDerivative<n> &point,
                      const FaceGeometry              &master_face,
                      const FaceDerivative            &master)
    {
      const bool         smooth   = master_face.smooth();
      const FacePosition on_slave = slave.position(point.slave);
      const FaceShapes  &shapes   = on_slave.shapes;
      double             w        = point.weight;
      Gradient           d_w      = point.d_weight;
      if (!take_facing_part<n>(slave.geometry.face(), point, master_face, master.normal, w, d_w))
        return;

      // The integrands q and their derivatives.
      double   value[n_columns];
      Gradient d_value[n_columns];
      value[0] = 1.;
      for (unsigned int d = 0; d < dim; ++d)
        {
          value[1 + d]       = on_slave.point.x[d] - master.point.x[d];
          value[1 + dim + d] = master.normal[d];
          Gradient &gap = d_value[1 + d], &normal = d_value[1 + dim + d];
          for (unsigned int v = 0; v < n_variable; ++v)
            {
              gap[v]    = 0.;
              normal[v] = 0.;
              for (unsigned int a = 0; a < 2; ++a)
                {
                  gap[v] += on_slave.point.tangents[a][d] * point.d_slave[a][v] -
                            master.point.tangents[a][d] * point.d_master[a][v];
                  normal[v] += master.normal_xi[a][d] * point.d_master[a][v];
                }
            }
          for (unsigned int m = 0; m < n; ++m)
            {
              for (unsigned int e = 0; e < dim; ++e)
                {
                  gap[dim * m + e] += on_slave.x_position[m][d][e];
                  gap[dim * (n + m) + e] -= master.x_position[m][d][e];
                  normal[dim * (n + m) + e] += master.normal_position[m][d][e];
                }
            }
        }
      for (unsigned int m = 0; m < n; ++m)
        {
          value[n_fixed + m] = master.shapes.value[m];
          for (unsigned int v = 0; v < n_variable; ++v)
            d_value[n_fixed + m][v] = master.shapes.gradient[m][0] * point.d_master[0][v] +
                                      master.shapes.gradient[m][1] * point.d_master[1][v];
        }

      const Tensor<1, dim> gap({value[1], value[2], value[3]});
      const auto           offer = [&](Closest<n> &closest) {
        if (gap * master.normal >= closest.gap)
          return;
        closest.gap = gap * master.normal;
        for (unsigned int v = 0; v < n_variable; ++v)
          {
            closest.d[v] = 0.;
            for (unsigned int d = 0; d < dim; ++d)
              closest.d[v] +=
                d_value[1 + d][v] * master.normal[d] + gap[d] * d_value[1 + dim + d][v];
          }
        for (unsigned int m = 0; m < n; ++m)
          {
            closest.normal[m] = gap * master.normal_normal[m];
            if (smooth)
              closest.normal[m] -= master.normal * master.x_normal[m];
            closest.slave_normal[m] = Tensor<1, dim>();
            if (slave.geometry.smooth())
              closest.slave_normal[m] = master.normal * on_slave.x_normal[m];
          }
      };
      offer(least);
      for (unsigned int j = 0; j < n; ++j)
        if (w == 0. && is_node(shapes.value[j]))
          offer(own[j]);
      if (w == 0.)
        return;

      Gradient d_shape[n];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int v = 0; v < n_variable; ++v)
          d_shape[j][v] = shapes.gradient[j][0] * point.d_slave[0][v] +
                          shapes.gradient[j][1] * point.d_slave[1][v];
      for (unsigned int j = 0; j < n; ++j)
        {
          const double wn = w * shapes.value[j];
          Gradient     d_wn;
          for (unsigned int v = 0; v < n_variable; ++v)
            d_wn[v] = shapes.value[j] * d_w[v] + w * d_shape[j][v];
          for (unsigned int k = 0; k <= j; ++k)
            {
              mass[j][k] += wn * shapes.value[k];
              for (unsigned int v = 0; v < n_variable; ++v)
                d_mass[j][k][v] += d_wn[v] * shapes.value[k] + wn * d_shape[k][v];
            }
          q[j][0] += wn;
          for (unsigned int v = 0; v < n_variable; ++v)
            d_q[j][0][v] += d_wn[v];
          for (unsigned int c = 1; c < n_columns; ++c)
            {
              q[j][c] += wn * value[c];
              for (unsigned int v = 0; v < n_variable; ++v)
                d_q[j][c][v] += d_wn[v] * value[c] + wn * d_value[c][v];
            }
          for (unsigned int m = 0; m < n; ++m)
            {
              normal_normal[j][m] += wn * master.normal_normal[m];
              if (smooth)
                gap_normal[j][m] -= wn * master.x_normal[m];
              if (slave.geometry.smooth())
                gap_slave_normal[j][m] += wn * on_slave.x_normal[m];
            }
        }
    }

    /** Multiply the first index of all integrals, and the second of the mass matrix,
     * by the transposed weights of a basis: integrals with its functions. */
    void
    to_trace_basis(const TraceBasis    &basis,
                   FullMatrix<double>  &mass,
                   FullMatrix<double>  &q,
                   std::vector<double> &d_mass,
                   std::vector<double> &d_q,
                   const unsigned int   n_variables)
    {
      const unsigned int  n = basis.n, n_columns = q.n();
      std::vector<double> result;
      // [block][j][column], rows first.
      const auto rows = [&](double *const block, const unsigned int columns) {
        result.assign(n * columns, 0.);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int p = 0; p < n; ++p)
            if (basis.weights[j][p] != 0.)
              for (unsigned int c = 0; c < columns; ++c)
                result[p * columns + c] += basis.weights[j][p] * block[j * columns + c];
        std::copy(result.begin(), result.end(), block);
      };
      const auto columns = [&](double *const block) {
        result.assign(n * n, 0.);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int k = 0; k < n; ++k)
            for (unsigned int p = 0; p < n; ++p)
              result[j * n + p] += basis.weights[k][p] * block[j * n + k];
        std::copy(result.begin(), result.end(), block);
      };
      rows(&mass(0, 0), n);
      columns(&mass(0, 0));
      rows(&q(0, 0), n_columns);
      for (unsigned int v = 0; v < n_variables; ++v)
        {
          rows(&d_mass[v * n * n], n);
          columns(&d_mass[v * n * n]);
          rows(&d_q[v * n * n_columns], n_columns);
        }
    }
  } // namespace



  void
  AveragedDerivative::add_row(const ContactRow &row, const CoverSums &sums)
  {
    Row &entry = rows
                   .emplace(row.slave,
                            Row{&row,
                                &sums,
                                GapCorrection(sums, sums.gap / sums.area * row.normal, row.size),
                                RowDerivativeBuilder(row.stencil.size()),
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                {},
                                {}})
                   .first->second;
    for (unsigned int m = 0; m < row.stencil.size(); ++m)
      entry.stencil[row.stencil[m].node] = m;
  }



  bool
  AveragedDerivative::wants(const Face &slave, const TraceBasis *basis) const
  {
    const auto &nodes = basis ? basis->nodes : slave.nodes;
    return std::any_of(nodes.begin(), nodes.begin() + slave.n_nodes(), [this](const Index node) {
      return rows.count(node) > 0;
    });
  }



  void
  AveragedDerivative::add_face(const FaceGeometry              &slave,
                               const TraceBasis                *basis,
                               const std::vector<const Face *> &near)
  {
    if (slave.face().degree == 1)
      add<4>(slave, basis, near);
    else
      add<9>(slave, basis, near);
  }



  template <unsigned int n>
  void
  AveragedDerivative::add(const FaceGeometry              &geometry,
                          const TraceBasis                *basis,
                          const std::vector<const Face *> &near)
  {
    const Face              &slave = geometry.face();
    const FaceDifferentiator on_slave(geometry);
    // Integrals per master face, and all master nodes, each once.
    std::list<std::pair<const Face *, Integrals<n>>> parts;
    std::vector<Index>                               nodes;
    for (const Face *face : near)
      {
        const auto points = differentiated_overlap<n>(slave, *face);
        if (points.empty())
          continue;
        const Master &master = masters.try_emplace(face, search.geometry(*face)).first->second;
        auto         &part   = parts.emplace_back(face, Integrals<n>()).second;
        for (const auto &point : points)
          part.add(on_slave, point, master.geometry, master.differentiator.at(point.master));
        nodes.insert(nodes.end(), face->nodes.begin(), face->nodes.begin() + n);
      }
    if (parts.empty())
      return;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());

    // Sums over the master faces. Variables: slave nodes, then master nodes.
    const unsigned int n_columns   = n_fixed + nodes.size();
    const unsigned int n_variables = dim * (n + nodes.size());
    FullMatrix<double> mass(n, n), q(n, n_columns);
    // [variable][j][column], and the same of the mass matrix.
    std::vector<double> d_q(n_variables * n * n_columns), d_mass(n_variables * n * n);
    const auto          place = [&](const Index node) {
      return std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
    };
    for (const auto &[face, part] : parts)
      {
        unsigned int variable[2 * n * dim], column[n_fixed + n];
        for (unsigned int v = 0; v < n * dim; ++v)
          {
            variable[v]           = v;
            variable[n * dim + v] = dim * (n + place(face->nodes[v / dim])) + v % dim;
          }
        for (unsigned int c = 0; c < n_fixed + n; ++c)
          column[c] = c < n_fixed ? c : n_fixed + place(face->nodes[c - n_fixed]);
        for (unsigned int j = 0; j < n; ++j)
          {
            for (unsigned int k = 0; k <= j; ++k)
              {
                mass(j, k) += part.mass[j][k];
                for (unsigned int v = 0; v < 2 * n * dim; ++v)
                  d_mass[(variable[v] * n + j) * n + k] += part.d_mass[j][k][v];
              }
            for (unsigned int c = 0; c < n_fixed + n; ++c)
              {
                q(j, column[c]) += part.q[j][c];
                for (unsigned int v = 0; v < 2 * n * dim; ++v)
                  d_q[(variable[v] * n + j) * n_columns + column[c]] += part.d_q[j][c][v];
              }
          }
      }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < j; ++k)
        {
          mass(k, j) = mass(j, k);
          for (unsigned int v = 0; v < n_variables; ++v)
            d_mass[(v * n + k) * n + j] = d_mass[(v * n + j) * n + k];
        }
    double total = 0.;
    for (unsigned int j = 0; j < n; ++j)
      total += q(j, 0);
    if (total <= 0.)
      return; // nothing faces the face
    if (basis)
      to_trace_basis(*basis, mass, q, d_mass, d_q, n_variables);
    // What the rows of its nodes take of the covered part.
    const std::vector<Index> own =
      basis ? std::vector<Index>(basis->nodes.begin(), basis->nodes.begin() + n)
            : std::vector<Index>(slave.nodes.begin(), slave.nodes.begin() + n);
    std::array<double, Face::max_nodes> areas{};
    for (unsigned int i = 0; i < n; ++i)
      areas[i] = q(i, 0);
    const auto               whole = whole_areas(slave, basis, /*reference=*/true);
    const CoverShares        shares(n, areas, whole, gradual, /*with_derivative=*/true);
    const FullMatrix<double> weights = shares.weights(mass);
    FullMatrix<double>       solution(n, n_columns); // M^-1 Q
    mass.mmult(solution, q);
    // A hanging node moves with those that it follows: if its row referred to
    // it, conditions would depend on each other in a cycle.
    const auto moved = [&](const unsigned int k) {
      return k >= n  ? Stencil{{nodes[k - n], 1.}}
             : basis ? basis->stencil(k)
                     : Stencil{{slave.nodes[k], 1.}};
    };

    // The area of a row is that part of the reference area which is covered now; where all of it
    // is, it stays so.
    const auto present      = whole_areas(slave, basis, /*reference=*/false);
    const auto d_present    = whole_area_derivatives(slave, basis);
    const auto area_changes = [&](const unsigned int k) {
      return rows.at(own[k]).row->friction &&
             std::abs(shares.share[k][k] - present[k]) > 1e-10 * present[k];
    };

    std::vector<double> d(n_columns);
    for (unsigned int k = 0; k < n; ++k)
      {
        const auto wanted = rows.find(own[k]);
        if (wanted == rows.end())
          continue;
        Row                      &row    = wanted->second;
        RowDerivative            &result = *row.builder.result;
        std::vector<unsigned int> stencil;
        for (const std::vector<Index> *list : {&std::as_const(nodes), &own})
          for (const Index node : *list)
            {
              const auto entry = row.stencil.find(node);
              stencil.push_back(entry == row.stencil.end() ? numbers::invalid_unsigned_int
                                                           : entry->second);
            }
        const bool covered_in_part = area_changes(k);
        // The weight function in the shape functions, psi'_k = sum_j dual_j N_j.
        double dual[n];
        for (unsigned int j = 0; j < n; ++j)
          dual[j] = weights(k, j);
        for (unsigned int v = 0; v < n_variables; ++v)
          {
            double d_share[n] = {};
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int l = 0; l < n; ++l)
                d_share[i] += shares.derivative[k][i][l] * d_q[(v * n + l) * n_columns];
            // d (sum_i T_ki a_i (M^-1 Q)_i)
            std::fill(d.begin(), d.end(), 0.);
            for (unsigned int i = 0; i < n; ++i)
              if (d_share[i] != 0.)
                for (unsigned int c = 0; c < n_columns; ++c)
                  d[c] += d_share[i] * solution(i, c);
            for (unsigned int j = 0; j < n; ++j)
              {
                double        taken = 0.;
                const double *dq    = &d_q[(v * n + j) * n_columns];
                for (unsigned int i = 0; i < n; ++i)
                  taken += dual[i] * d_mass[(v * n + i) * n + j];
                for (unsigned int c = 0; c < n_columns; ++c)
                  d[c] += dual[j] * dq[c] - taken * solution(j, c);
              }
            const double d_given     = d_q[(v * n + k) * n_columns] - d_share[k];
            double       d_reference = 0.;
            if (covered_in_part)
              d_reference = whole[k] / present[k] *
                            (d_share[k] - (v / dim < n ? shares.share[k][k] / present[k] *
                                                           d_present[v / dim][v % dim][k]
                                                       : 0.));
            for (const auto &[node, weight] : moved(v / dim))
              {
                const unsigned int e  = v % dim;
                const std::size_t  to = row.builder.index(node);
                for (auto *list : {&row.d_area, &row.d_kept, &row.d_given})
                  list->resize(result.nodes.size());
                row.d_area[to][e] += weight * d[0];
                row.d_kept[to][e] += weight * d_share[k];
                row.d_given[to][e] += weight * d_given;
                if (covered_in_part)
                  {
                    result.area.resize(result.nodes.size());
                    result.area[to][e] += weight * d_reference;
                  }
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    result.gap_vector[to][c][e] += weight * d[1 + c];
                    result.normal[to][c][e] += weight * d[1 + dim + c];
                  }
                for (unsigned int m = 0; m < nodes.size(); ++m)
                  if (stencil[m] != numbers::invalid_unsigned_int)
                    result.weights[stencil[m]][to][e] += weight * d[n_fixed + m];
                for (unsigned int i = 0; i < n; ++i)
                  if (stencil[nodes.size() + i] != numbers::invalid_unsigned_int)
                    result.weights[stencil[nodes.size() + i]][to][e] -= weight * d_share[i];
              }
          }
        for (const auto &[face, part] : parts)
          {
            ByNormals &by_normals = row.by_normals[face];
            for (unsigned int m = 0; m < n; ++m)
              for (unsigned int j = 0; j < n; ++j)
                {
                  by_normals.normal[m] += dual[j] * part.normal_normal[j][m];
                  by_normals.gap[m] += dual[j] * part.gap_normal[j][m];
                  if (geometry.smooth())
                    row.by_slave_normals[slave.key][m] += dual[j] * part.gap_slave_normal[j][m];
                }
            const auto take = [&, face = face](std::optional<Least> &closest,
                                               const Closest<n>     &gap) {
              if (gap.gap == std::numeric_limits<double>::max() ||
                  (closest && closest->gap <= gap.gap))
                return;
              closest.emplace(Least{gap.gap, face, slave.key, {}, {}, {}});
              std::copy(gap.normal, gap.normal + n, closest->by_normals.begin());
              std::copy(gap.slave_normal, gap.slave_normal + n, closest->by_slave_normals.begin());
              for (unsigned int m = 0; m < 2 * n; ++m)
                for (const auto &[node, weight] : moved(m < n ? m : n + place(face->nodes[m - n])))
                  closest->by_nodes.emplace_back(node,
                                                 weight * Tensor<1, dim>({gap.d[dim * m],
                                                                          gap.d[dim * m + 1],
                                                                          gap.d[dim * m + 2]}));
            };
            if (row.correction.by_least != 0.)
              take(row.least, part.least);
            if (row.correction.by_own != 0.)
              take(row.own, part.own[k]);
          }
      }
  }



  std::vector<Tensor<1, dim>>
  AveragedDerivative::derivative(const Least                         &least,
                                 RowDerivativeBuilder                &builder,
                                 const std::vector<NormalDerivative> *of_master,
                                 const std::vector<NormalDerivative> *of_slave)
  {
    std::vector<Tensor<1, dim>> result;
    const auto                  add = [&](const Index node, const Tensor<1, dim> &value) {
      const std::size_t to = builder.index(node);
      result.resize(builder.result->nodes.size());
      result[to] += value;
    };
    for (const auto &[node, value] : least.by_nodes)
      add(node, value);
    if (of_master)
      for (const NormalDerivative &d : *of_master)
        add(d.node, least.by_normals[d.m] * d.value);
    if (of_slave)
      for (const NormalDerivative &d : *of_slave)
        add(d.node, least.by_slave_normals[d.m] * d.value);
    return result;
  }



  void
  AveragedDerivative::finish()
  {
    std::vector<const Face *> needed;
    for (const auto &[face, master] : masters)
      needed.push_back(face);
    const auto normal_derivatives = search.normal_derivatives(needed);
    needed.clear();
    if (slave_search)
      for (const auto &[node, row] : rows)
        for (const auto &[key, by_normals] : row.by_slave_normals)
          needed.push_back(slave_search->face(key));
    const auto slave_derivatives =
      slave_search ? slave_search->normal_derivatives(needed) : decltype(normal_derivatives)();
    for (auto &[node, row] : rows)
      {
        RowDerivative &result = *row.builder.result;
        for (const auto &[key, by_normals] : row.by_slave_normals)
          for (const NormalDerivative &d : slave_derivatives.at(slave_search->face(key)))
            {
              const std::size_t to = row.builder.index(d.node);
              result.gap_vector[to] += by_normals[d.m] * d.value;
            }
        for (const auto &[face, by_normals] : row.by_normals)
          {
            const auto derivatives = normal_derivatives.find(face);
            if (derivatives == normal_derivatives.end())
              continue;
            const bool smooth = masters.at(face).geometry.smooth();
            for (const NormalDerivative &d : derivatives->second)
              {
                const std::size_t to = row.builder.index(d.node);
                result.normal[to] += by_normals.normal[d.m] * d.value;
                if (smooth)
                  result.gap_vector[to] += by_normals.gap[d.m] * d.value;
              }
          }
        for (auto [least, d] :
             {std::make_pair(&row.least, &row.d_least), std::make_pair(&row.own, &row.d_own)})
          if (*least)
            {
              const auto of_master = normal_derivatives.find((*least)->master);
              *d                   = derivative(**least,
                              row.builder,
                              of_master == normal_derivatives.end() ? nullptr : &of_master->second,
                              row.by_slave_normals.count((*least)->slave) > 0
                                                  ? &slave_derivatives.at(slave_search->face((*least)->slave))
                                                  : nullptr);
            }
        to_means(row);
      }
  }



  void
  AveragedDerivative::to_means(Row &row)
  {
    RowDerivative       &result     = *row.builder.result;
    const CoverSums     &sums       = *row.sums;
    const Tensor<1, dim> n          = row.row->normal;
    const Tensor<2, dim> direction  = normalisation_derivative(sums.normal);
    const Tensor<1, dim> mean       = sums.gap / sums.area;
    const GapCorrection &correction = row.correction;
    for (auto *list : {&row.d_area, &row.d_kept, &row.d_given, &row.d_least, &row.d_own})
      list->resize(result.nodes.size());
    if (!result.area.empty())
      result.area.resize(result.nodes.size());
    for (std::size_t a = 0; a < result.nodes.size(); ++a)
      {
        result.normal[a] = direction * result.normal[a];
        // Of the mean gap, of what is added to it, and of the share of both.
        const Tensor<2, dim> d_mean =
          (result.gap_vector[a] - outer_product(mean, row.d_area[a])) / sums.area;
        const Tensor<1, dim> d_value =
          correction.by_mean * (n * d_mean + mean * result.normal[a]) +
          correction.by_least * row.d_least[a] + correction.by_own * row.d_own[a] +
          correction.by_kept * row.d_kept[a] + correction.by_given * row.d_given[a];
        const Tensor<1, dim> d_share =
          (row.d_area[a] - sums.area / sums.kept * row.d_kept[a]) / sums.kept;
        result.gap_vector[a] =
          outer_product(mean + correction.value * n, d_share) +
          sums.area / sums.kept *
            (d_mean + outer_product(n, d_value) + correction.value * result.normal[a]);
        for (std::size_t m = 0; m < result.weights.size(); ++m)
          result.weights[m][a] =
            (result.weights[m][a] - row.row->stencil[m].weight * row.d_kept[a]) / sums.kept;
      }
  }
} // namespace Touchstone
