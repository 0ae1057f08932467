// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_algebra_transformation_h
#define touchstone_algebra_transformation_h

#include <touchstone/algebra/linear_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Entries of a sparse row, by local index. */
  using SparseRow = std::vector<std::pair<int, double>>;

  /** @brief Local indices: those of a map, then those of other dofs in the order in which
   * local() is first called for them. */
  class LocalIndices
  {
  public:
    explicit LocalIndices(const Epetra_Map &map)
      : map(map)
    {
      // One by one: the map would keep a list of its own.
      all.reserve(map.NumMyElements());
      for (int i = 0; i < map.NumMyElements(); ++i)
        all.push_back(map.GID(i));
    }

    int
    local(const Index global)
    {
      const int known = map.LID(static_cast<int>(global));
      if (known >= 0)
        return known;
      const auto [found, inserted] = others.emplace(global, all.size());
      if (inserted)
        all.push_back(static_cast<int>(global));
      return found->second;
    }

    /** @brief Global indices in the order of the local ones. */
    const std::vector<int> &
    global() const
    {
      return all;
    }

  private:
    const Epetra_Map              &map;
    std::vector<int>               all;
    std::unordered_map<Index, int> others;
  };

  /** @brief A distributed matrix of any number of rows on each rank, to be
   * multiplied by vectors of the dofs @p domain. Collective.
   * @param indices Those by which the rows go; begin with those of @p domain. */
  std::unique_ptr<Epetra_CrsMatrix>
  make_matrix(const std::vector<SparseRow> &rows,
              const LocalIndices           &indices,
              const Epetra_Map             &domain);

  /**
   * @brief The substitution x = T y + g by which constraints are condensed out of
   * a linear system (doc/theory.md, section 7).
   *
   * T = C B D: the constraints C and their inhomogeneities g, the change of basis
   * B (a dof becomes the elongation of a spring) and the units D of such dofs.
   * All rows are those of the identity but for constrained dofs and those of
   * changed basis. Test functions are substituted in the same way, by T or by
   * another such object S.
   */
  class Transformation
  {
  public:
    /** @brief A row of C B: coefficients of dofs and the entry of g. */
    struct Row
    {
      LinearForm entries;
      double     inhomogeneity = 0.;
    };

    /**
     * @param constraints,basis_change Must live as long; know the lines of all
     * dofs of this rank, and of those to which row() is applied.
     * @param dofs                     Dofs of this rank, multipliers last; must
     * live as long.
     * @param n_displacements          Dofs that are not multipliers, of all
     * ranks.
     * @param units                    The diagonal of D, other than one at dofs
     * of changed basis only; null: one. Must live as long.
     */
    Transformation(const dealii::AffineConstraints<double> &constraints,
                   const dealii::AffineConstraints<double> &basis_change,
                   const Epetra_Map                        &dofs,
                   Index                                    n_displacements,
                   const Epetra_Vector                     *units);

    /** @brief The row of C B, without units, of any dof whose lines are known;
     * none if it is that of the identity. */
    std::optional<Row>
    row(Index dof) const;

    /** @brief result = T y. Collective. */
    void
    apply(const Epetra_Vector &y, Epetra_Vector &result) const;

    /** @brief x = T^T x. @param work Work space. Collective. */
    void
    apply_transposed(Epetra_Vector &x, Epetra_Vector &work) const;

    /** @brief result = T y + g. Collective. */
    void
    expand(const Epetra_Vector &y, Epetra_Vector &result) const;

    /** @brief g. Collective. */
    Epetra_Vector
    inhomogeneity() const;

  private:
    const dealii::AffineConstraints<double> &constraints, &basis_change;
    const Epetra_Map                        &dofs;
    const Index                              n_displacements;
    const Epetra_Vector *const               units;

    /** The rows of this rank that are not those of the identity, with units: made
     * when first asked for, as a system that is assembled and factorised needs
     * them late or never. */
    struct OwnRows
    {
      std::vector<int>                  rows;
      std::unique_ptr<Epetra_CrsMatrix> entries;
      std::unique_ptr<Epetra_Vector>    values; // of the rows, work space
      std::vector<double>               inhomogeneities;
    };
    mutable std::unique_ptr<OwnRows> made;

    const OwnRows &
    own_rows() const;

    void
    append(Index dof, double factor, LinearForm &entries) const;
  };
} // namespace Touchstone

#endif
