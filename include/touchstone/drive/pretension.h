// SPDX-License-Identifier: LGPL-2.1-or-later

#ifndef touchstone_drive_pretension_h
#define touchstone_drive_pretension_h

#include <touchstone/base/formula.h>
#include <touchstone/base/stateful.h>
#include <touchstone/contact/contact.h>
#include <touchstone/drive/load_stepping_parameters.h>

#include <deal.II/base/tensor.h>

#include <memory>
#include <vector>

namespace Touchstone
{
  /**
   * @brief Bolts that are tightened: tied pairs across plane cuts whose sides are drawn together.
   *
   * A cut is shortened by a length, which is given or such that its tension has a given force; once
   * locked it keeps the length that it has, and the force follows from what else acts. The lengths
   * of cuts with a force are the unknowns of Broyden's method (1965, Math. Comp. 19) around
   * Newton's: a few more solutions in a step, for any number of bolts that share a joint.
   */
  class Pretension : public Stateful
  {
  public:
    /** @throws InputError */
    Pretension(const std::vector<ContactPairParameters> &pairs,
               const LoadSteppingParameters             &load_stepping,
               Contact                                  &contact);

    /** @brief Set the shortenings with which a step to time @p t is first solved. Collective. */
    void
    begin_step(double t);

    /**
     * @brief Change the shortenings if the forces in the state that has been found, of the
     * displacement @p u with ghosts, are not those that are given. Collective.
     * @return whether they were changed, so that the state has to be found anew.
     * @throws NotBalanced after too many changes.
     */
    bool
    correct(const Vector &u);

    /** @brief Shortening and tension by name of the pair: length, force. Of the last correct(). */
    const std::map<std::string, std::pair<double, double>> &
    results() const
    {
      return found;
    }

    /** @brief Whether the tension of a cut is given at present, which then has no length of its
     * own.
     */
    bool
    by_force() const;

    void
    commit() override;
    void
    rollback() override;
    void
    save(ArchiveWriter &archive) const override;
    void
    load(const ArchiveReader &archive) override;

  private:
    /** A cut. */
    struct Cut
    {
      /** Number and name of its pair. */
      unsigned int pair;
      std::string  name;
      /** One of both. */
      std::shared_ptr<const Formula> force, shortening;
      /** End of the phase after which it is locked; infinite if never. */
      double lock;
    };

    /** What is known of the cuts at the end of a step. */
    struct State
    {
      std::vector<double> shortening, tension;
      /** Change of each shortening by each tension, row by row: an approximation. */
      std::vector<double> compliance;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &shortening &tension &compliance;
      }
    };

    Contact         &contact;
    Formulas         formulas;
    std::vector<Cut> cuts;
    State            present, committed;
    double           time      = 0.;
    unsigned int     n_changes = 0;
    /** Shortenings and residuals of the last correct() of this step. */
    std::vector<double>                              last_shortening, last_residual;
    std::map<std::string, std::pair<double, double>> found;

    /** Whether the tension of the cut is given at present. */
    bool
    by_force(const Cut &cut) const
    {
      return cut.force && time <= cut.lock;
    }
    void
    apply();
    /** Tension of each cut, and its area. Collective. */
    std::vector<std::pair<double, double>>
    tensions(const Vector &u) const;
    /** Broyden's update of the compliance. */
    void
    learn(const std::vector<double> &residual);
  };
} // namespace Touchstone

#endif
