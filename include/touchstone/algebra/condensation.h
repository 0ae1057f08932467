#ifndef touchstone_algebra_condensation_h
#define touchstone_algebra_condensation_h

#include <touchstone/algebra/linear_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <deque>
#include <unordered_map>
#include <utility>
#include <vector>

namespace Touchstone
{
  /** @brief Entries of a sparse row, by local number. */
  using SparseRow = std::vector<std::pair<int, double>>;

  /** @brief Local numbers: those of a map, then those met later, in the order in
   * which they are met. */
  class LocalNumbers
  {
  public:
    explicit LocalNumbers(const Epetra_Map &map)
      : map(map)
      , all(map.MyGlobalElements(), map.MyGlobalElements() + map.NumMyElements())
    {
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

    /** @brief Global numbers in the order of the local ones. */
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

  /**
   * @brief The lines of x = T y + g that are not those of the identity, by local
   * number.
   *
   * A constrained unknown is a combination of others. One whose basis is changed
   * is a combination of others plus itself, which now counts its deviation from
   * them.
   */
  class Expansion
  {
  public:
    struct Line
    {
      SparseRow entries;
      double    shift = 0.;
    };

    Expansion(const dealii::AffineConstraints<double> &constraints,
              const dealii::AffineConstraints<double> &basis_change,
              const Index                              n_displacements,
              LocalNumbers                            &numbers)
      : constraints(constraints)
      , basis_change(basis_change)
      , n_displacements(n_displacements)
      , numbers(numbers)
    {
    }

    /** @brief The line of an unknown; null if it is a plain one. */
    const Line *
    line(int local);

  private:
    const dealii::AffineConstraints<double> &constraints, &basis_change;
    const Index                              n_displacements;
    LocalNumbers                            &numbers;
    /** Which line an unknown has: -2 not known yet, -1 none. */
    std::vector<int> which;
    std::deque<Line> lines;

    void
    append(Index global, double factor, Line &line);
  };

  /** @brief A sparse row under construction: entries of equal number add up. */
  class Accumulator
  {
  public:
    void
    add(const int number, const double value)
    {
      if (static_cast<std::size_t>(number) >= place.size())
        place.resize(2 * static_cast<std::size_t>(number) + 64, -1);
      if (place[number] < 0)
        {
          place[number] = static_cast<int>(row.size());
          row.emplace_back(number, value);
        }
      else
        row[place[number]].second += value;
    }

    /** @brief The row so far, in ascending order; begin a new one. */
    SparseRow
    take();

  private:
    std::vector<int> place;
    SparseRow        row;
  };

  /**
   * @brief The rows of S^T A T that differ from the stiffness's own, and the
   * right-hand side S^T (b - A g).
   *
   * A T is formed row by row, where a row of the stiffness meets a constrained
   * column and for contact terms; then each row of S^T (A T) gathers the rows that
   * it stands for. Nothing is summed up twice, and what goes to other ranks is
   * summed up before.
   */
  class Condensation
  {
  public:
    /** @param rows    Numbers of the rows: those of this rank, extra unknowns
     *                 included, come first.
     *  @param columns Numbers of the columns: those of the stiffness come first. */
    Condensation(const LinearSystem &system, const Epetra_Map &rows, LocalNumbers &columns);

    /** The row that replaces that of the stiffness, by local number, or null: the others are
     * as they were. */
    const SparseRow *
    row(const int i) const
    {
      return places[i] < 0 ? nullptr : &rows[places[i]];
    }

    /** Right-hand side of this rank's rows. */
    std::vector<double> values;

  private:
    /** Part of the product: row @p source times @p factor goes to row @p target. */
    struct Part
    {
      int    target, source;
      double factor;
    };

    const LinearSystem &system;
    const Epetra_Map   &row_map;
    LocalNumbers        row_numbers;
    LocalNumbers       &columns;
    Expansion           motion, test;
    Accumulator         accumulator;

    /** What row() gives: where, by local number, in which rows. */
    std::vector<int>       places;
    std::vector<SparseRow> rows;

    std::vector<SparseRow> sources;
    std::vector<double>    source_values;
    std::vector<Part>      parts;
    std::vector<char>      replaced;

    SparseRow &
    new_row(const int i)
    {
      if (places[i] < 0)
        {
          places[i] = static_cast<int>(rows.size());
          rows.emplace_back();
        }
      return rows[places[i]];
    }
    /** Which nodes' rows meet an unknown that is not a plain one. */
    std::vector<char>
    touched_nodes();
    void
    add_stiffness();
    void
    add_terms();
    /** Take the present row of the accumulator for one side of a term, without what has
     * cancelled out: where the stretch of a spring is an unknown nothing else is left. */
    SparseRow
    take_what_is_left();
    /** Take the present row of the accumulator for row @p row of A T. */
    void
    add_source(int row, double value);
    /** Right-multiply an entry by T; returns its part of A g. */
    double
    expand(int column, double value);
    void
    exchange();
    void
    gather();
    /** Sum up the parts from @p begin to those of the next target. */
    std::size_t
    sum(std::size_t begin, double &value);
  };
} // namespace Touchstone

#endif
